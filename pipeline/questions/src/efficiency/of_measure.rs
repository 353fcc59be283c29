//! Which intensity measure to trust: efficiency and sufficiency (Section 4.5; Luco and Cornell, 2007).

use rayon::prelude::*;
use uplift_fragility::{Dispersion, mean_residuals, standard_deviation, uplift_levels};
use uplift_motion::IntensityMeasure;
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

/// Efficiency and sufficiency of one measure; arrays run over `[strength]` unless said otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureEfficiency {
    /// The measure.
    pub measure: IntensityMeasure,
    /// The measure that the records of the runs were scaled to: another one where the runs are told by `measure`.
    pub scaled_to: IntensityMeasure,
    /// Levels of the measure, `[level]`.
    pub levels: Vec<f64>,
    /// Scatter of the level at which the records bring the structure to a displacement: the standard deviation of its
    /// logarithm (of its root's, for the Arias intensity), median over the displacements from uplift to the largest
    /// that all reach in the runs of the first measure; NaN where that is not known.
    pub reaching: Vec<f64>,
    /// Scatter of the demand over `[strength, level]`.
    pub dispersions: Vec<Dispersion>,
    /// Median over the stripes that rock of the dispersion by percentiles; NaN where no stripe has one.
    pub rocking: Vec<f64>,
    /// Share of the stripes that rock whose dispersion does not exist, for too much overturning.
    pub undefined: Vec<f64>,
    /// Standard deviation of the logarithm of the level (of its root, for the Arias intensity) at which a record first
    /// lifts the structure.
    pub initiation: Vec<f64>,
    /// Records that have such a level.
    pub initiation_records: Vec<u32>,
    /// The line of the mean residuals over each covariate, `[covariate][strength]`; none where there are too few
    /// records or stripes.
    pub lines: Vec<Vec<Option<Line>>>,
}

impl MeasureEfficiency {
    /// The same as a result has it, with the trends over `covariates`.
    pub(super) fn stored(&self, covariates: &[Covariate]) -> StoredEfficiency {
        let trend = |(covariate, lines): (&Covariate, &Vec<_>)| StoredTrend::new(covariate.key, lines);
        StoredEfficiency {
            measure: self.measure,
            scaled_to: self.scaled_to,
            reaching: self.reaching.clone(),
            rocking: self.rocking.clone(),
            undefined: self.undefined.clone(),
            initiation: self.initiation.clone(),
            initiation_records: self.initiation_records.clone(),
            trends: covariates.iter().zip(&self.lines).map(trend).collect(),
        }
    }
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
    let found = efficiency_of(stored, &restated.stripes, Some(&restated.uplift_levels), covariates)?;
    Ok(MeasureEfficiency { scaled_to: own.measure, ..found })
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
    Ok(MeasureEfficiency {
        measure: measure.measure,
        scaled_to: measure.measure,
        levels: measure.levels.clone(),
        reaching: vec![f64::NAN; stored.strengths.len()],
        rocking,
        undefined,
        initiation,
        initiation_records,
        lines: (0..covariates.len())
            .map(|covariate| by_strength.iter().map(|(.., lines)| lines[covariate]).collect())
            .collect(),
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
