//! The answers of design, overturning, target and risk as a result keeps them: numbers with a name and a unit, in one
//! form for all.

mod keep;
mod of_design;
mod of_overturning;
mod of_risk;
mod of_target;

use serde::Serialize;
use uplift_study::Structure;

use super::certainty::Bands;
use super::uncertain::{AleatoryResult, EpistemicResult, UncertainFinding, UncertaintyReport};
use crate::error::DesignError;
pub use keep::keep;
use uplift_job::JobError;
use uplift_result::{Finding, FindingRow, Inquiry};
use uplift_uniform_risk::EventRisk;

/// What was asked of which structure, under which result.
struct Question<'a> {
    inquiry: Inquiry,
    structure: &'a Structure,
    /// Of the result.
    study_digest: &'a str,
    request: Vec<(&'static str, String)>,
}

impl Question<'_> {
    /// The answer, of which `report` is what `--json` prints.
    ///
    /// # Errors
    /// None for the reports of this program.
    fn answered(self, rows: Vec<FindingRow>, report: &impl Serialize) -> Result<Finding, DesignError> {
        let Self { inquiry, structure, study_digest, request } = self;
        let document = serde_json::to_string(report)
            .map_err(|error| JobError::input(format!("the answer cannot be written as JSON: {error}")))?;
        Ok(Finding {
            structure: structure.name(),
            structure_file: structure.file.display().to_string(),
            structure_toml: structure.text.clone(),
            inquiry,
            request: request.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
            study_digest: study_digest.to_owned(),
            rows,
            document,
        })
    }
}

/// A number with its band as the records tell it, and again with those of their earthquakes and of the hazard's curves
/// where these are known.
fn banded(row: &FindingRow, bands: Option<Bands>) -> Vec<FindingRow> {
    let Some(bands) = bands else { return vec![row.clone()] };
    let told = bands.each().into_iter().zip(bands.words());
    told.filter_map(|(limits, of)| Some(row.clone().within(limits?, of))).collect()
}

/// How often something happens, 1/yr, with its bands; where no run shows it, what it is at most.
fn rate(what: &str, risk: &EventRisk, bands: Option<Bands>, [site, im]: [&str; 2]) -> Vec<FindingRow> {
    let row = FindingRow::new(what, risk.per_year, "1/yr").at(site, im);
    if let Some(bound) = risk.at_most_per_year {
        return vec![row.within([f64::NAN, bound], "at most")];
    }
    banded(&row, bands)
}

/// What follows for a structure that is not known exactly.
fn uncertain(report: Option<&UncertaintyReport>) -> Vec<FindingRow> {
    let mut rows = Vec::new();
    for result in report.into_iter().flat_map(|report| &report.results) {
        let row = |value: f64| {
            let what = format!("{}, structure not known exactly", result.of);
            FindingRow::new(what, value, result.unit).at(&result.site, result.im)
        };
        match &result.found {
            UncertainFinding::Epistemic(EpistemicResult { by_structure, by_all, .. }) => {
                if let Some(bound) = by_structure.at_most_per_year {
                    rows.push(row(by_structure.mean).within([f64::NAN, bound], "at most"));
                    continue;
                }
                for (spread, band) in [(by_structure, "structure"), (by_all, "structure, records and hazard")] {
                    let [lower, .., upper] = spread.percentiles;
                    rows.push(row(spread.mean).within([lower, upper], band));
                }
            }
            UncertainFinding::Aleatory(AleatoryResult { value, at_most_per_year: Some(bound), .. }) => {
                rows.push(row(*value).within([f64::NAN, *bound], "at most"));
            }
            UncertainFinding::Aleatory(AleatoryResult { value, by_record, by_earthquake, with_hazard, .. }) => {
                let bands = by_record.map(|by_record| Bands {
                    by_record,
                    by_earthquake: *by_earthquake,
                    with_hazard: *with_hazard,
                });
                rows.extend(banded(&row(*value), bands));
            }
        }
    }
    rows
}
