//! How the level scatters at which records bring the structure to a displacement: what ranks measures fairly, for all
//! are compared at the same displacements of the same runs.

use rayon::prelude::*;
use uplift_fragility::{Stripes, quantile, standard_deviation};
use uplift_uniform_risk::{StoredMeasure, StoredStripes};

use super::restated::Measured;
use crate::error::QuestionsError;

/// Displacements at which measures are compared.
const DISPLACEMENTS: usize = 20;

/// By what each record is multiplied until it brings the structure to a displacement.
pub(super) struct FactorsToReach {
    /// The largest displacement, m: the largest that every record reaches; none of a strength where some record does
    /// not lift the structure, `[strength]`.
    pub(super) up_to_m: Vec<Option<f64>>,
    /// ln of the scale factor, `[strength][displacement][record]`; no displacement where there is no largest one.
    ln_factors: Vec<Vec<Vec<f64>>>,
}

impl FactorsToReach {
    /// Of the runs of `own`, which the records were scaled to as `measured` says.
    pub(super) fn new(
        stored: &StoredStripes,
        own: &StoredMeasure,
        measured: Measured<'_>,
    ) -> Result<Self, QuestionsError> {
        let of_strength = |strength: usize| -> Result<(Option<f64>, Vec<Vec<f64>>), QuestionsError> {
            let stripes = own.stripes(strength)?;
            let uplift_m = stored.uplift_displacement_m;
            let Some(most_m) = reached_by_all(&stripes).filter(|&most_m| most_m > uplift_m) else {
                return Ok((None, Vec::new()));
            };
            let displacement_m = |step: usize| uplift_m * (most_m / uplift_m).powf(step as f64 / DISPLACEMENTS as f64);
            let ln_factors = |step: usize| {
                let level = |record| first_level(own, stripes.record(record), displacement_m(step));
                (0..stripes.record_count()).map(|record| measured.factor(record, level(record)).ln()).collect()
            };
            Ok((Some(most_m), (1..=DISPLACEMENTS).map(ln_factors).collect()))
        };
        let strengths = (0..stored.strengths.len()).into_par_iter();
        let of_strengths = strengths.map(of_strength).collect::<Result<Vec<_>, QuestionsError>>()?;
        let (up_to_m, ln_factors) = of_strengths.into_iter().unzip();
        Ok(Self { up_to_m, ln_factors })
    }

    /// Standard deviation over the records of the logarithm of the level of a measure (of its root, for one that grows
    /// with the square of the factor) at which the structure comes to a displacement: the median over the
    /// displacements, `[strength]`; NaN where there are none.
    pub(super) fn scatter(&self, measured: Measured<'_>) -> Vec<f64> {
        let ln_amplitude = |record: usize| measured.amplitude(record).ln();
        let of_displacement = |of_records: &Vec<f64>| {
            let levels: Vec<f64> =
                of_records.iter().enumerate().map(|(record, factor)| factor + ln_amplitude(record)).collect();
            standard_deviation(&levels)
        };
        let of_strength = |of_displacements: &Vec<Vec<f64>>| {
            let mut scatter: Vec<f64> = of_displacements.iter().map(of_displacement).collect();
            scatter.sort_by(f64::total_cmp);
            quantile(&scatter, 0.5)
        };
        self.ln_factors.iter().map(of_strength).collect()
    }
}

/// The largest displacement that every record brings the structure to, m; none where there is none.
fn reached_by_all(stripes: &Stripes<'_>) -> Option<f64> {
    let largest = |record| stripes.record(record).iter().copied().fold(0.0, f64::max);
    // where all overturn somewhere, as far as any comes that stands
    let standing =
        |record| stripes.record(record).iter().copied().filter(|demand| demand.is_finite()).fold(0.0, f64::max);
    let least = (0..stripes.record_count()).map(largest).fold(f64::INFINITY, f64::min);
    let most = (0..stripes.record_count()).map(standing).fold(f64::INFINITY, f64::min);
    Some(if least.is_finite() { least } else { most }).filter(|most_m| most_m.is_finite())
}

/// The first level at which a record brings the structure to `displacement_m`: on a straight line of logarithms between
/// the stripes before and at it; in the middle where one has no logarithm.
fn first_level(own: &StoredMeasure, demands_m: &[f64], displacement_m: f64) -> f64 {
    let Some(at) = demands_m.iter().position(|&demand| demand >= displacement_m) else { return f64::NAN };
    let Some(before) = at.checked_sub(1) else { return own.levels[0] };
    let (low, high) = (demands_m[before], demands_m[at]);
    let share = if low > 0.0 && high.is_finite() { (displacement_m / low).ln() / (high / low).ln() } else { 0.5 };
    own.levels[before] * (own.levels[at] / own.levels[before]).powf(share)
}
