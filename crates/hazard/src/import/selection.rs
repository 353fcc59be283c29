//! One site out of many.

use super::entry::Entry;
use super::{ExportedCurve, SitePlace};
use crate::error::HazardError;
use crate::text::excerpt;

/// Which site to read.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum SiteSelection {
    /// Every site.
    #[default]
    All,
    /// The site of this name, exactly as the export writes it.
    Name(String),
    /// The site nearest to a place.
    Nearest {
        /// Longitude, degrees, east positive.
        longitude_deg: f64,
        /// Latitude, degrees, north positive.
        latitude_deg: f64,
    },
}

/// Mean radius of the earth, km.
const EARTH_RADIUS_KM: f64 = 6371.0;
/// Names that a message lists.
const NAMES_LISTED: usize = 8;

/// The curves of the site of that name.
pub(super) fn by_name(
    entries: impl Iterator<Item = Result<Entry, HazardError>>,
    wanted: &str,
    file: &str,
) -> Result<Vec<ExportedCurve>, HazardError> {
    let wanted = wanted.trim();
    let mut names = KnownNames::default();
    let mut kept = Kept::default();
    for entry in entries {
        let entry = entry?;
        if entry.site.name.as_deref() == Some(wanted) {
            kept.push(entry)?;
        } else {
            names.note(&entry.site, wanted);
        }
    }
    if kept.0.is_empty() {
        return Err(HazardError::SiteNotFound {
            file: file.to_owned(),
            wanted: excerpt(wanted),
            known: names.to_string(),
        });
    }
    kept.0.into_iter().map(Entry::curve).collect()
}

/// The curves of the site nearest to a place, the first one of several equally near.
pub(super) fn nearest(
    entries: impl Iterator<Item = Result<Entry, HazardError>>,
    longitude_deg: f64,
    latitude_deg: f64,
) -> Result<Vec<ExportedCurve>, HazardError> {
    for (what, value, largest, must_be) in [
        ("longitude [degrees]", longitude_deg, 360.0, "from -360 to 360"),
        ("latitude [degrees]", latitude_deg, 90.0, "from -90 to 90"),
    ] {
        if !(value.abs() <= largest) {
            return Err(HazardError::Argument { what, value, must_be });
        }
    }
    let mut least_km = f64::INFINITY;
    let mut kept = Kept::default();
    for entry in entries {
        let entry = entry?;
        let site = &entry.site;
        let km = distance_km((longitude_deg, latitude_deg), (site.longitude_deg, site.latitude_deg));
        if km < least_km {
            least_km = km;
            kept.0.clear();
        }
        let same_place = |other: &Entry| {
            other.site.longitude_deg == site.longitude_deg && other.site.latitude_deg == site.latitude_deg
        };
        if kept.0.first().is_none_or(same_place) {
            kept.push(entry)?;
        }
    }
    let curves = kept.0.into_iter().map(Entry::curve);
    curves.map(|curve| curve.map(|curve| ExportedCurve { distance_km: Some(least_km), ..curve })).collect()
}

/// Curves of one site, none of them twice.
#[derive(Default)]
struct Kept(Vec<Entry>);

impl Kept {
    fn push(&mut self, entry: Entry) -> Result<(), HazardError> {
        if let Some(earlier) = self.0.iter().find(|earlier| earlier.repeats(&entry)) {
            return Err(entry.duplicate(earlier.line));
        }
        self.0.push(entry);
        Ok(())
    }
}

/// Names to suggest: those like the one asked for, else the first ones.
#[derive(Default)]
struct KnownNames {
    like: Vec<String>,
    first: Vec<String>,
    sites: usize,
    named: usize,
}

impl KnownNames {
    fn note(&mut self, site: &SitePlace, wanted: &str) {
        self.sites += 1;
        let Some(name) = &site.name else {
            return;
        };
        self.named += 1;
        let (lower, wanted) = (name.to_lowercase(), wanted.to_lowercase());
        let like = !wanted.is_empty() && (lower.contains(&wanted) || wanted.contains(&lower));
        let list = if like { &mut self.like } else { &mut self.first };
        if list.len() < NAMES_LISTED && !list.iter().any(|known| known == name) {
            list.push(name.clone());
        }
    }
}

impl std::fmt::Display for KnownNames {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.named == 0 {
            return write!(f, "none of its {} sites has a name: select by longitude and latitude", self.sites);
        }
        let quoted = |names: &[String]| names.iter().map(|name| excerpt(name)).collect::<Vec<_>>().join(", ");
        if self.like.is_empty() {
            let more = if self.named > self.first.len() { ", ..." } else { "" };
            write!(f, "it names {}{more} ({} sites)", quoted(&self.first), self.sites)
        } else {
            write!(f, "did you mean {}?", quoted(&self.like))
        }
    }
}

/// Great-circle distance between two places (longitude, latitude) in degrees, km, by the haversine formula.
pub(super) fn distance_km((lon0, lat0): (f64, f64), (lon1, lat1): (f64, f64)) -> f64 {
    let half_sine_squared = |degrees: f64| (0.5 * degrees).to_radians().sin().powi(2);
    let h = half_sine_squared(lat1 - lat0)
        + lat0.to_radians().cos() * lat1.to_radians().cos() * half_sine_squared(lon1 - lon0);
    2.0 * EARTH_RADIUS_KM * h.sqrt().min(1.0).asin()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_distances() {
        let quarter_km = EARTH_RADIUS_KM * std::f64::consts::FRAC_PI_2;
        for (a, b, expected_km) in [
            ((0.0, 0.0), (90.0, 0.0), quarter_km),
            ((10.0, 0.0), (77.0, 90.0), quarter_km),
            ((0.0, 0.0), (180.0, 0.0), 2.0 * quarter_km),
            // across the date line, and with both ways to count longitudes
            ((179.5, 0.0), (-179.5, 0.0), quarter_km / 90.0),
            ((359.5, 0.0), (0.5, 0.0), quarter_km / 90.0),
            // on the 60th parallel: haversine of 1 degree by hand
            ((0.0, 60.0), (1.0, 60.0), 2.0 * EARTH_RADIUS_KM * (0.5 * 0.5_f64.to_radians().sin()).asin()),
        ] {
            assert!((distance_km(a, b) - expected_km).abs() < 1e-9 * expected_km, "{a:?} {b:?}");
        }
    }

    proptest! {
        #[test]
        fn a_metric(
            a in (-180.0..180.0_f64, -90.0..90.0_f64),
            b in (-180.0..180.0_f64, -90.0..90.0_f64),
            c in (-180.0..180.0_f64, -90.0..90.0_f64),
        ) {
            prop_assert_eq!(distance_km(a, a), 0.0);
            prop_assert!((distance_km(a, b) - distance_km(b, a)).abs() < 1e-9);
            prop_assert!(distance_km(a, c) <= distance_km(a, b) + distance_km(b, c) + 1e-6);
            prop_assert!(distance_km(a, b) <= EARTH_RADIUS_KM * std::f64::consts::PI + 1e-9);
        }
    }
}
