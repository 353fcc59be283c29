//! What holds for every export: written and read again it is the same, and damage never panics.

use std::fmt::Write;
use std::io::Cursor;

use proptest::prelude::*;
use proptest::sample::Index;
use serde_json::json;
use uplift_hazard::{ExportedCurve, ExportedCurves, HazardError, SiteSelection, probability_from_rate};

#[derive(Debug, Clone)]
struct Site {
    longitude_deg: f64,
    latitude_deg: f64,
    /// Probabilities, falling strictly.
    poes: Vec<f64>,
}

#[derive(Debug, Clone)]
struct Export {
    years: f64,
    levels: Vec<f64>,
    sites: Vec<Site>,
    certain: usize,
    zeros: usize,
}

/// Exports of 1 to 6 sites: `certain` levels of probability 1, then 2 to 20 others, then `zeros`.
fn exports() -> impl Strategy<Value = Export> {
    let inside = 2..20_usize;
    (inside, 0..3_usize, 0..3_usize, 0.5..100.0_f64).prop_flat_map(|(inside, certain, zeros, years)| {
        let count = certain + inside + zeros;
        let site = (-180.0..180.0_f64, -90.0..90.0_f64, prop::collection::vec(0.01..2.0_f64, inside));
        (prop::collection::vec(0.01..1.0_f64, count), prop::collection::vec(site, 1..6)).prop_map(
            move |(steps, sites)| {
                let mut level = -6.0_f64;
                let levels = steps.iter().map(|step| {
                    level += step;
                    level.exp()
                });
                let sites = sites.into_iter().map(|(longitude_deg, latitude_deg, drops)| {
                    let mut rate = 0.7 / years;
                    let inner = drops.into_iter().map(|drop| {
                        rate *= (-drop).exp();
                        probability_from_rate(rate, years).unwrap()
                    });
                    let poes = std::iter::repeat_n(1.0, certain).chain(inner).chain(std::iter::repeat_n(0.0, zeros));
                    Site { longitude_deg, latitude_deg, poes: poes.collect() }
                });
                Export { years, levels: levels.collect(), sites: sites.collect(), certain, zeros }
            },
        )
    })
}

impl Export {
    fn csv(&self) -> String {
        let mut text =
            format!("#,,\"kind='mean', investigation_time={:?}, imt='PGA'\"\ncustom_site_id,lon,lat", self.years);
        self.levels.iter().for_each(|level| write!(text, ",poe-{level:?}").unwrap());
        for (number, site) in self.sites.iter().enumerate() {
            write!(text, "\ns{number},{:?},{:?}", site.longitude_deg, site.latitude_deg).unwrap();
            site.poes.iter().for_each(|poe| write!(text, ",{poe:e}").unwrap());
        }
        text + "\n"
    }

    fn nrml(&self) -> String {
        let list = |values: &[f64]| values.iter().map(|value| format!("{value:e}")).collect::<Vec<_>>().join(" ");
        let mut text = format!(
            "<nrml xmlns:gml=\"g\" xmlns=\"n\">\
             <hazardCurves IMT=\"PGA\" statistics=\"mean\" investigationTime=\"{:?}\">\n\
             <IMLs>{}</IMLs>\n",
            self.years,
            list(&self.levels)
        );
        for site in &self.sites {
            writeln!(
                text,
                "<hazardCurve><gml:Point><gml:pos>{:?} {:?}</gml:pos></gml:Point><poEs>{}</poEs></hazardCurve>",
                site.longitude_deg,
                site.latitude_deg,
                list(&site.poes)
            )
            .unwrap();
        }
        text + "</hazardCurves></nrml>"
    }

    /// Annual rates of the first site as the USGS would give them.
    fn json(&self) -> String {
        let site = &self.sites[0];
        let range = self.certain..self.levels.len();
        let ys: Vec<f64> = site.poes[range.clone()].iter().map(|&poe| rate(poe, self.years)).collect();
        json!({"status": "success",
            "request": {"longitude": site.longitude_deg, "latitude": site.latitude_deg, "vs30": 760},
            "response": {"hazardCurves": [{"imt": {"value": "PGA"}, "data": [
                {"component": "Total", "values": {"xs": &self.levels[range], "ys": ys}}]}]}})
        .to_string()
    }

    fn matches(&self, site: &Site, read: &ExportedCurve) -> bool {
        let range = self.certain..self.levels.len() - self.zeros;
        let rates: Vec<f64> = site.poes[range.clone()].iter().map(|&poe| rate(poe, self.years)).collect();
        (read.site.longitude_deg, read.site.latitude_deg) == (site.longitude_deg, site.latitude_deg)
            && (read.curve.im(), read.curve.maf()) == (&self.levels[range], &rates[..])
            && read.dropped_zeros == self.zeros
    }
}

fn rate(poe: f64, years: f64) -> f64 {
    -(-poe).ln_1p() / years
}

fn select(text: impl Into<Vec<u8>>, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
    ExportedCurves::from_reader(Cursor::new(text.into()), "t")?.select(selection)
}

/// Reads what may be damaged in every way there is; only that it returns is asked, and that curves are curves.
fn survive(text: &[u8]) -> Result<(), TestCaseError> {
    let nearest = SiteSelection::Nearest { longitude_deg: 10.0, latitude_deg: 50.0 };
    for selection in [SiteSelection::All, SiteSelection::Name("s0".to_owned()), nearest] {
        match select(text, &selection) {
            Ok(curves) => prop_assert!(curves.iter().all(|curve| curve.curve.len() >= 2)),
            Err(error) => prop_assert!(error.to_string().len() < 1000, "{}", error),
        }
    }
    if let Ok(curves) = ExportedCurves::from_reader(Cursor::new(text.to_vec()), "t") {
        // An iteration that does not end would have more items than the text has lines.
        prop_assert!(curves.take(text.len() + 2).count() <= text.len() + 1);
    }
    Ok(())
}

proptest! {
    #[test]
    fn csv_is_read_back(export in exports()) {
        let read = select(export.csv(), &SiteSelection::All)?;
        prop_assert_eq!(read.len(), export.sites.len());
        for (site, read) in export.sites.iter().zip(&read) {
            prop_assert!(export.matches(site, read) && read.dropped_certain == export.certain, "{:?}", read);
        }
        let one = select(export.csv(), &SiteSelection::Name("s0".to_owned()))?;
        prop_assert_eq!(&one[..], &read[..1]);
    }

    #[test]
    fn nrml_is_read_back(export in exports()) {
        let read = select(export.nrml(), &SiteSelection::All)?;
        prop_assert_eq!(read.len(), export.sites.len());
        for (site, read) in export.sites.iter().zip(&read) {
            prop_assert!(export.matches(site, read) && read.dropped_certain == export.certain, "{:?}", read);
        }
    }

    #[test]
    fn json_is_read_back(export in exports()) {
        let read = select(export.json(), &SiteSelection::All)?;
        prop_assert_eq!(read.len(), 1);
        prop_assert!(export.matches(&export.sites[0], &read[0]), "{:?}", read);
    }

    /// The nearest site of a file is the one that a search through all distances finds.
    #[test]
    fn nearest_is_nearest(export in exports(), longitude_deg in -180.0..180.0_f64, latitude_deg in -90.0..90.0_f64) {
        let near = &select(export.csv(), &SiteSelection::Nearest { longitude_deg, latitude_deg })?[0];
        let unit = |lon: f64, lat: f64| {
            let (lon, lat) = (lon.to_radians(), lat.to_radians());
            [lat.cos() * lon.cos(), lat.cos() * lon.sin(), lat.sin()]
        };
        let chord = |site: &Site| {
            let (a, b) = (unit(longitude_deg, latitude_deg), unit(site.longitude_deg, site.latitude_deg));
            a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
        };
        let least = export.sites.iter().map(chord).fold(f64::INFINITY, f64::min);
        let expected_km = 2.0 * 6371.0 * (0.5 * least).min(1.0).asin();
        prop_assert!((near.distance_km.unwrap() - expected_km).abs() < 1e-3, "{:?} {}", near.distance_km, expected_km);
    }

    #[test]
    fn damaged_exports_never_panic(
        export in exports(), kind in 0..3_usize, cut in any::<Index>(), at in any::<Index>(), byte in any::<u8>(),
    ) {
        let mut bytes = [export.csv(), export.nrml(), export.json()][kind].clone().into_bytes();
        let index = at.index(bytes.len());
        bytes[index] = byte;
        survive(&bytes)?;
        bytes.truncate(cut.index(bytes.len()));
        survive(&bytes)?;
    }

    #[test]
    fn shuffled_fragments_never_panic(start in 0..4_usize, fragments in prop::collection::vec(prop::sample::select(vec![
        "#", "kind='mean'", "imt='PGA'", "investigation_time=1.0", "lon", "lat", "poe-0.1", "poe-0.2", "custom_site_id",
        ",", ";", "\n", "\"", "'", "1", "0.5", "0", "-1", "nan", "1e999", "é", "\u{feff}", "<", ">", "</",
        "hazardCurves", "/>", "hazardCurve", "IMLs", "poEs", "pos", " IMT=\"PGA\"", "<!--", "{", "}", "[", "]", ":",
        "\"response\"", "\"imt\"", "\"data\"", "\"xs\"", "\"ys\"", "\"values\"", "\"Total\"",
    ]), 0..80)) {
        let start = ["", "# kind='mean', investigation_time=1.0, imt='PGA'\nlon,lat,poe-1,poe-2\n", "<a>", "{"][start];
        survive(format!("{start}{}", fragments.concat()).as_bytes())?;
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300), packed in any::<bool>()) {
        let head: &[u8] = if packed { b"\x1f\x8b\x08" } else { b"" };
        survive(&[head, &bytes].concat())?;
    }
}
