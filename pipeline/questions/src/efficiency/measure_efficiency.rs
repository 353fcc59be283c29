//! Which intensity measure to trust: efficiency and sufficiency (Section 4.5; Luco and Cornell, 2007).

use rayon::prelude::*;
use uplift_fragility::{Dispersion, mean_residuals, standard_deviation, uplift_levels};
use uplift_regression::{Line, fit_line};
use uplift_result::{StoredEfficiency, StoredRecords, StoredTrend};
use uplift_uniform_risk::{StoredMeasure, StoredStripes};

use super::restated::Restated;
use crate::error::QuestionsError;

/// What is known of each record that a demand may depend on beside the measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Covariate {
    /// Name in files, e.g. `magnitude`.
    pub key: &'static str,
    /// What it is.
    pub long_name: &'static str,
    /// Its value of each record, in the form it enters the line; NaN where it is not known.
    pub values: Vec<f64>,
}

/// Efficiency and sufficiency of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureEfficiency {
    /// What a result has of it.
    pub own: StoredEfficiency,
    /// Levels of the measure, `[level]`.
    pub levels: Vec<f64>,
    /// Scatter of the demand over `[strength, level]`.
    pub dispersions: Vec<Dispersion>,
}

/// The place of the scatter `of` a measure among those of all at the strength `index`, the smallest first; none where
/// there is no such number.
pub(super) fn rank(measures: &[MeasureEfficiency], of: &StoredEfficiency, index: usize) -> Option<u32> {
    let smaller = |other: &&MeasureEfficiency| other.own.reaching[index] < of.reaching[index];
    let place = || u32::try_from(1 + measures.iter().filter(smaller).count()).unwrap_or(u32::MAX);
    of.reaching[index].is_finite().then(place)
}

/// One strength: scatter of each level, levels at first uplift, a line for each covariate.
type OfStrength = (Vec<Dispersion>, Vec<f64>, Vec<Option<Line>>);

/// Efficiency and sufficiency of `measure`.
///
/// # Errors
/// Numbers that do not fit together, in a file that was changed.
pub fn efficiency_by(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    covariates: &[Covariate],
) -> Result<MeasureEfficiency, QuestionsError> {
    efficiency_of(stored, measure, None, covariates)
}

/// Efficiency and sufficiency of the measure that the runs `own` are told by.
pub(super) fn efficiency_restated(
    stored: &StoredStripes,
    own: &StoredMeasure,
    restated: &Restated,
    covariates: &[Covariate],
) -> Result<MeasureEfficiency, QuestionsError> {
    let mut found = efficiency_of(stored, &restated.stripes, Some(&restated.uplift_levels), covariates)?;
    found.own.scaled_to = own.measure;
    Ok(found)
}

/// Efficiency and sufficiency of stripes, whose levels at first uplift are found unless they are given,
/// `[strength][record]`.
fn efficiency_of(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    uplift: Option<&[Vec<f64>]>,
    covariates: &[Covariate],
) -> Result<MeasureEfficiency, QuestionsError> {
    let u_up = stored.uplift_displacement_m;
    let of_strength = |strength: usize| -> Result<OfStrength, QuestionsError> {
        let stripes = measure.stripes(strength)?;
        let dispersions = (0..measure.levels.len()).map(|level| Dispersion::from_stripes(&stripes, level)).collect();
        let uplift = uplift.map_or_else(|| uplift_levels(&stripes, u_up), |of| of[strength].clone());
        let uplift: Vec<f64> = uplift.into_iter().filter(|level| level.is_finite()).collect();
        let residuals = mean_residuals(&stripes, u_up);
        let lines = covariates.iter().map(|covariate| line(&covariate.values, &residuals)).collect();
        Ok((dispersions, uplift, lines))
    };
    let by_strength = (0..stored.strengths.len())
        .into_par_iter()
        .map(of_strength)
        .collect::<Result<Vec<OfStrength>, _>>()
        .map_err(|error| uplift_job::in_file(error, &stored.path))?;
    let (mut rocking, mut undefined, mut initiation, mut initiation_records) = (vec![], vec![], vec![], vec![]);
    for (dispersions, uplift, _) in &by_strength {
        let all: Vec<f64> = dispersions
            .iter()
            .filter(|scatter| scatter.median_m > u_up)
            .map(|scatter| scatter.by_percentiles)
            .collect();
        let mut defined: Vec<f64> = all.iter().copied().filter(|dispersion| dispersion.is_finite()).collect();
        defined.sort_by(f64::total_cmp);
        rocking.push(uplift_fragility::quantile(&defined, 0.5));
        undefined.push(if all.is_empty() { f64::NAN } else { 1.0 - defined.len() as f64 / all.len() as f64 });
        let amplitudes = uplift.iter().map(|&level| measure.measure.amplitude(level).ln());
        initiation.push(standard_deviation(&amplitudes.collect::<Vec<_>>()));
        initiation_records.push(u32::try_from(uplift.len()).unwrap_or(u32::MAX));
    }
    let trend = |(place, covariate): (usize, &Covariate)| {
        let lines: Vec<Option<Line>> = by_strength.iter().map(|(.., lines)| lines[place]).collect();
        StoredTrend::new(covariate.key, &lines)
    };
    Ok(MeasureEfficiency {
        own: StoredEfficiency {
            measure: measure.measure,
            scaled_to: measure.measure,
            reaching: vec![f64::NAN; stored.strengths.len()],
            rocking,
            undefined,
            initiation,
            initiation_records,
            trends: covariates.iter().enumerate().map(trend).collect(),
        },
        levels: measure.levels.clone(),
        dispersions: by_strength.into_iter().flat_map(|(dispersions, ..)| dispersions).collect(),
    })
}

/// The line of the residuals over the records whose covariate is known.
fn line(values: &[f64], residuals: &[f64]) -> Option<Line> {
    let (x, y): (Vec<f64>, Vec<f64>) = values
        .iter()
        .zip(residuals)
        .filter(|(value, _)| value.is_finite())
        .map(|(&value, &residual)| (value, residual))
        .unzip();
    fit_line(&x, &y).ok()
}

/// What a result knows of its records, in the form in which a demand may depend on it: magnitude, the logarithm of the
/// distance, the logarithm of the significant duration. What is known of fewer than three records is left out.
pub fn covariates(records: &StoredRecords) -> Vec<Covariate> {
    let ln = |values: &[f64]| values.iter().map(|value| value.ln()).collect();
    let all = [
        Covariate { key: "magnitude", long_name: "moment magnitude", values: records.magnitude.clone() },
        Covariate { key: "ln_rrup", long_name: "logarithm of the distance in km", values: ln(&records.rrup_km) },
        Covariate {
            key: "ln_duration",
            long_name: "logarithm of the significant duration D5-95 in s",
            values: ln(&records.duration_5_95_s),
        },
    ];
    let is_known = |covariate: &Covariate| covariate.values.iter().filter(|value| value.is_finite()).count() >= 3;
    all.into_iter().filter(is_known).collect()
}
