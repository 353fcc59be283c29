//! Hazard curves that are dropped or pasted: two-column tables, and the exports of hazard engines.

use std::io::Cursor;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use uplift_hazard::{
    CsvOptions, Declared, ExportedCurves, HazardCurve, HazardError, SecondColumn, SiteSelection, read_csv,
};
use uplift_motion::IntensityMeasure;

use crate::calculator::{Answer, refused};

/// Most curves that are taken from a file.
const MOST_CURVES: usize = 500;

/// A curve, and what of its file it is.
pub(crate) struct DroppedCurve {
    label: String,
    pub(crate) curve: HazardCurve,
}

/// What a table leaves open: the page asks, and never guesses.
#[derive(Clone, Deserialize, Serialize)]
pub(crate) struct Choice {
    measure: String,
    unit: String,
    second_column: Option<Second>,
}

/// What the second column holds, where its name does not say it.
#[derive(Clone, Copy, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Second {
    Rates,
    /// Probabilities in so many years.
    Probabilities(f64),
}

impl Choice {
    fn new((measure, unit): (&str, &str), second_column: Option<Second>) -> Self {
        Self { measure: measure.to_owned(), unit: unit.to_owned(), second_column }
    }

    fn read(&self, text: &str, name: &str) -> Result<HazardCurve, HazardError> {
        let declared = Declared { measure: self.measure.clone(), unit: self.unit.clone() };
        let (second_column, years) = match self.second_column {
            None => (None, None),
            // the name of the column, where there is one, has to agree
            Some(Second::Rates) => (Some(SecondColumn::AnnualRate), None),
            Some(Second::Probabilities(years)) => (Some(SecondColumn::Probability), Some(years)),
        };
        read_csv(text, name, &CsvOptions { declared, second_column, years }).map(|read| read.curve)
    }

    /// `PGV in cm/s, annual rates`.
    fn label(&self) -> String {
        let second = match self.second_column {
            None => String::new(),
            Some(Second::Rates) => ", annual rates".to_owned(),
            Some(Second::Probabilities(1.0)) => ", probabilities in 1 year".to_owned(),
            Some(Second::Probabilities(years)) => format!(", probabilities in {years} years"),
        };
        format!("{} in {}{second}", self.measure, self.unit)
    }
}

/// What a table may hold that does not say it.
const QUANTITIES: [(&str, &str); 5] =
    [("PGV", "cm/s"), ("PGV", "m/s"), ("PGA", "g"), ("PGA", "m/s2"), ("PGA", "cm/s2")];

/// What was found in a file.
pub(crate) enum Found {
    Curves(Vec<DroppedCurve>),
    /// What it may hold; the page asks which.
    Open(Vec<Choice>),
}

impl Found {
    /// What a file holds: an export of `OpenQuake`, NRML or the USGS, or a table, of which `choice` says what it does
    /// not say itself.
    pub(crate) fn read(bytes: &[u8], name: &str, choice: Option<&Choice>) -> Answer<Self> {
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        if start.is_empty() {
            return Err(format!("{name}: the file is empty"));
        }
        let is_export = start.starts_with(b"<")
            || start.starts_with(b"{")
            || start.starts_with(b"[")
            || start.starts_with(b"\x1f\x8b")
            || start.starts_with(b"#,")
            || start.starts_with(b"lon,");
        if is_export {
            return exported(bytes, name).map(Self::Curves);
        }
        let text = std::str::from_utf8(bytes).map_err(|_| format!("{name}: the file is not a text (UTF-8)"))?;
        let table = |choice: &Choice| {
            let curve = choice.read(text, name)?;
            Ok::<_, HazardError>(vec![DroppedCurve { label: format!("{name}: {}", curve.measure()), curve }])
        };
        if let Some(choice) = choice {
            return table(choice).map(Self::Curves).map_err(refused);
        }
        let declared = Declared::in_table(text);
        let known = match &declared {
            (Some(measure), Some(unit)) => Some((&measure[..], &unit[..])),
            _ => None,
        };
        let quantities = known.map_or_else(|| QUANTITIES.to_vec(), |known| vec![known]);
        let plain = Choice::new(quantities[0], None);
        let refusal = match table(&plain) {
            Ok(curves) if known.is_some() => return Ok(Self::Curves(curves)),
            Ok(_) => None,
            Err(error) => Some(error),
        };
        let seconds = [None, Some(Second::Rates), Some(Second::Probabilities(50.0)), Some(Second::Probabilities(1.0))];
        let readable = |second: &Option<Second>| {
            let all = quantities.iter().map(|&quantity| Choice::new(quantity, *second));
            all.filter(|choice| choice.read(text, name).is_ok()).collect::<Vec<_>>()
        };
        // a column that says what it holds needs no other question
        let open = match readable(&None) {
            own if own.is_empty() => seconds[1..].iter().flat_map(readable).collect(),
            own => own,
        };
        match (refusal, open) {
            (Some(error), open) if open.is_empty() => Err(refused(error)),
            (_, open) => Ok(Self::Open(open)),
        }
    }

    /// What the page shows of it; curves are numbered from `first`.
    pub(crate) fn about(&self, first: usize) -> Value {
        match self {
            Self::Curves(curves) => {
                let curves = curves.iter().enumerate().map(|(place, curve)| curve.about(first + place));
                json!({ "curves": curves.collect::<Vec<_>>() })
            }
            Self::Open(choices) => {
                let choice = |own: &Choice| json!({ "label": own.label(), "choice": own });
                json!({ "curves": [], "open": choices.iter().map(choice).collect::<Vec<_>>() })
            }
        }
    }
}

fn exported(bytes: &[u8], name: &str) -> Answer<Vec<DroppedCurve>> {
    let curves = ExportedCurves::from_reader(Cursor::new(bytes.to_vec()), name)
        .and_then(|curves| curves.select(&SiteSelection::All))
        .map_err(refused)?;
    if curves.is_empty() {
        return Err(format!("{name}: no hazard curve in the file"));
    }
    if curves.len() > MOST_CURVES {
        return Err(format!("{name}: {} curves; the page takes {MOST_CURVES} at most", curves.len()));
    }
    let label = |own: &uplift_hazard::ExportedCurve| {
        let (lon, lat) = (own.site.longitude_deg, own.site.latitude_deg);
        let site = own.site.name.clone().unwrap_or_else(|| format!("{lon}, {lat}"));
        format!("{site}: {} of {}", own.kind, own.curve.measure())
    };
    Ok(curves.into_iter().map(|own| DroppedCurve { label: label(&own), curve: own.curve }).collect())
}

impl DroppedCurve {
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
