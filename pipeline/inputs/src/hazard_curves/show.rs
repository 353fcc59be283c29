//! What a curve file or an export holds.

use std::path::PathBuf;

use serde::Serialize;
use uplift_hazard::{HazardCurve, rate_from_probability};
use uplift_job::events::Events;
use uplift_job::text::{distinct, per_cent, rounded};
use uplift_motion::IntensityMeasure;
use uplift_study::usual_top_level;

use super::NamedCurve;
use super::read::{CurveOptions, read_file};
use crate::error::InputsError;
use crate::hardly_possible::hardly_possible;
use crate::levelling_off::levelling_off;

/// Probabilities at which levels are reported.
const PROBABILITIES: [f64; 5] = [0.5, 0.2, 0.1, 0.05, 0.02];
/// What to do with a file of probabilities that calls them rates.
const POE_HEAD: &str = "Write poe for maf in its head, and give --years";
/// Years that they refer to.
const YEARS: f64 = 50.0;

/// The curves of one or several files.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HazardReport {
    /// Probabilities at which the levels of the curves are reported.
    pub probabilities: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// The curves.
    pub curves: Vec<ShownCurve>,
    /// What is wrong with files that hold none.
    pub mistakes: Vec<String>,
}

/// A curve in a few numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShownCurve {
    /// Site and statistic, or folder and file.
    pub name: String,
    /// Its intensity measure.
    pub measure: String,
    /// Unit of its levels.
    pub unit: String,
    /// Levels that are exceeded with the probabilities of the report; none where the curve does not reach.
    pub levels: Vec<Option<f64>>,
    /// Number of levels of the curve.
    pub points: usize,
    /// What the second column of a table was taken for; none of an export.
    pub read_as: Option<String>,
    /// Its lowest level.
    pub lowest: f64,
    /// Its highest level.
    pub highest: f64,
    /// How horizontal components are combined; none where that is not said.
    pub component: Option<String>,
    /// Where it comes from, in lines.
    pub source: String,
    /// What is hardly possible or unusual of the curve: its unit is probably another; none where all is usual.
    pub warning: Option<String>,
}

/// Looks at the curves of `files`.
///
/// # Errors
/// No file from which a curve can be read; what is wrong with the first.
pub fn show(files: &[PathBuf], options: &CurveOptions, events: &dyn Events) -> Result<HazardReport, InputsError> {
    let (mut curves, mut errors) = (Vec::new(), Vec::new());
    for file in distinct(files) {
        match read_file(file, options, events) {
            Ok(read) => curves.extend(read.iter().map(shown)),
            Err(error) => errors.push(error),
        }
    }
    if curves.is_empty() && !errors.is_empty() {
        return Err(errors.swap_remove(0));
    }
    let mistakes = errors.iter().map(ToString::to_string).collect();
    Ok(HazardReport { probabilities: PROBABILITIES.to_vec(), years: YEARS, curves, mistakes })
}

fn shown(NamedCurve { name, curve, read_as }: &NamedCurve) -> ShownCurve {
    ShownCurve {
        name: name.clone(),
        measure: curve.measure().to_owned(),
        unit: curve.unit().to_string(),
        levels: PROBABILITIES.iter().map(|&probability| level(curve, probability)).collect(),
        points: curve.len(),
        read_as: read_as.clone(),
        lowest: curve.first().im,
        highest: curve.last().im,
        component: curve.component().map(|component| component.to_string()),
        source: curve.source().to_owned(),
        warning: warning(curve),
    }
}

/// What is hardly possible or unusual of the curve, if its measure and unit are those of a study.
fn warning(curve: &HazardCurve) -> Option<String> {
    let measure: IntensityMeasure =
        curve.measure().parse().ok().filter(|known: &IntensityMeasure| curve.unit() == known.unit())?;
    let unusual_end = || {
        let (_, usual) = usual_top_level(measure)?;
        Some(usual.unlikely("the last level", curve.last().im)?.to_string())
    };
    let probabilities =
        || Some(format!("its rates {}: is it a curve of probabilities? {POE_HEAD}", levelling_off(curve)?));
    let hardly_possible = || hardly_possible(curve, measure).map(|found| found.to_string());
    probabilities().or_else(hardly_possible).or_else(unusual_end).or_else(|| cut_short(curve))
}

/// What to say of a curve that ends before the rarest level of the report, as one does that lost its last rows.
fn cut_short(curve: &HazardCurve) -> Option<String> {
    let rarest = PROBABILITIES.into_iter().fold(1.0, f64::min);
    let rate_per_year = rate_from_probability(rarest, YEARS).ok()?;
    (curve.last().maf > rate_per_year).then(|| {
        format!(
            "the curve ends at {} {}, exceeded more often than {} in {YEARS} years: is it cut short?",
            rounded(curve.last().im, 4),
            curve.unit(),
            per_cent(rarest)
        )
    })
}

fn level(curve: &HazardCurve, probability: f64) -> Option<f64> {
    rate_from_probability(probability, YEARS).and_then(|rate| curve.im_at_rate(rate)).ok()
}
