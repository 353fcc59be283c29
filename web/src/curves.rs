//! Hazard curves that are dropped or pasted: two-column tables, and the exports of hazard engines.

use std::io::Cursor;

use serde_json::{Value, json};
use uplift_hazard::{CsvOptions, Declared, ExportedCurves, HazardCurve, SiteSelection, read_csv};
use uplift_motion::IntensityMeasure;

use crate::calculator::{Answer, refused};

/// Most curves that are taken from a file.
const MOST_CURVES: usize = 500;

/// A curve, and what of its file it is.
pub(crate) struct DroppedCurve {
    label: String,
    pub(crate) curve: HazardCurve,
}

impl DroppedCurve {
    /// The curves of a file: an export of `OpenQuake`, NRML or the USGS, or a table, of this `measure` where the table
    /// does not say it.
    pub(crate) fn read(bytes: &[u8], name: &str, measure: Option<&str>) -> Answer<Vec<Self>> {
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let is_export = start.starts_with(b"<")
            || start.starts_with(b"{")
            || start.starts_with(b"[")
            || start.starts_with(b"\x1f\x8b")
            || start.starts_with(b"#,")
            || start.starts_with(b"lon,");
        if is_export {
            let curves = ExportedCurves::from_reader(Cursor::new(bytes.to_vec()), name)
                .and_then(|curves| curves.select(&SiteSelection::All))
                .map_err(refused)?;
            if curves.len() > MOST_CURVES {
                return Err(format!("{name}: {} curves; the page takes {MOST_CURVES} at most", curves.len()));
            }
            let label = |own: &uplift_hazard::ExportedCurve| {
                let (lon, lat) = (own.site.longitude_deg, own.site.latitude_deg);
                let site = own.site.name.clone().unwrap_or_else(|| format!("{lon}, {lat}"));
                format!("{site}: {} of {}", own.kind, own.curve.measure())
            };
            return Ok(curves.into_iter().map(|own| Self { label: label(&own), curve: own.curve }).collect());
        }
        let text = std::str::from_utf8(bytes).map_err(|_| format!("{name}: is no text (UTF-8)"))?;
        let declared = match (Declared::in_table(text), measure) {
            (Some(declared), _) => declared,
            (None, Some(key)) => {
                let measure: IntensityMeasure = key.parse().map_err(refused)?;
                Declared { measure: measure.label().to_owned(), unit: measure.unit_key().to_owned() }
            }
            (None, None) => return Err(format!("{name}: does not say measure and unit: choose the measure")),
        };
        let options = CsvOptions { declared, second_column: None, years: None };
        let read = read_csv(text, name, &options).map_err(refused)?;
        Ok(vec![Self { label: format!("{name}: {}", read.curve.measure()), curve: read.curve }])
    }

    /// What the page shows of it.
    pub(crate) fn about(&self, place: usize) -> Value {
        let measure: Option<IntensityMeasure> = self.curve.measure().parse().ok();
        json!({
            "place": place,
            "label": self.label,
            "measure": measure.map(IntensityMeasure::key),
            "unit": self.curve.unit(),
            "points": self.curve.len(),
        })
    }
}
