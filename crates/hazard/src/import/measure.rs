//! The intensity measures of the engines: names and the units that the engines fix for them.

use crate::error::{HazardError, Place};
use crate::text::excerpt;

/// Unit of the levels of a measure that `OpenQuake` names.
///
/// # Errors
/// [`HazardError::Row`] for a measure whose unit is not known here.
///
/// # Source
/// `OpenQuake` engine, module `hazardlib.imt`.
pub(super) fn openquake_unit(measure: &str, place: impl FnOnce() -> Place) -> Result<&'static str, HazardError> {
    match measure {
        "PGA" | "AvgSA" => Ok("g"),
        "PGV" => Ok("cm/s"),
        "PGD" => Ok("cm"),
        "IA" => Ok("m/s"),
        "CAV" => Ok("g s"),
        _ if measure.starts_with("SA(") => Ok("g"),
        _ => Err(unknown(measure, place())),
    }
}

/// Name and unit of a measure that the USGS names: `PGA`, `PGV`, `SA0P2` (0.2 s), or `0.2 s`.
///
/// # Errors
/// [`HazardError::Row`] for another measure.
///
/// # Source
/// nshmp-haz, class `Imt`.
pub(super) fn usgs_measure(name: &str, place: impl FnOnce() -> Place) -> Result<(String, &'static str), HazardError> {
    match name {
        "PGA" => return Ok((name.to_owned(), "g")),
        "PGV" => return Ok((name.to_owned(), "cm/s")),
        _ => {}
    }
    let period = name
        .strip_prefix("SA")
        .map(|period| period.replace('P', "."))
        .or_else(|| name.strip_suffix('s').map(|period| period.trim_end().to_owned()));
    match period.and_then(|period| period.parse::<f64>().ok()) {
        Some(period) if period.is_finite() && period > 0.0 => Ok((spectral_acceleration(period), "g")),
        _ => Err(unknown(name, place())),
    }
}

/// Name of the spectral acceleration at a period, s.
pub(super) fn spectral_acceleration(period_s: f64) -> String {
    format!("SA({period_s:?})")
}

fn unknown(measure: &str, place: Place) -> HazardError {
    let reason = format!(
        "the unit of intensity measure {} is not known; export PGA, PGV or SA, or write two columns yourself",
        excerpt(measure)
    );
    HazardError::Row { place, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_the_usgs() {
        for (name, expected) in [
            ("PGA", Some(("PGA", "g"))),
            ("PGV", Some(("PGV", "cm/s"))),
            ("SA0P2", Some(("SA(0.2)", "g"))),
            ("SA0P075", Some(("SA(0.075)", "g"))),
            ("SA10P0", Some(("SA(10.0)", "g"))),
            ("1.0 s", Some(("SA(1.0)", "g"))),
            ("SA", None),
            ("s", None),
            ("SAinf", None),
            ("AI", None),
        ] {
            let found = usgs_measure(name, || Place::Point(0)).ok();
            assert_eq!(found, expected.map(|(measure, unit)| (measure.to_owned(), unit)), "{name}");
        }
    }
}
