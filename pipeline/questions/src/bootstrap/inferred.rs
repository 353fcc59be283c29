//! What the records say of the spectra of all records there could be, and of those of another set.

use rayon::prelude::*;
use uplift_bootstrap::{InferredLimits, ResamplingPlan, Unit, inferred_limits, units, units_in_sample};
use uplift_job::Array;
use uplift_result::InferredBands;
use uplift_uniform_risk::{StoredMeasure, StoredStripes};

use crate::error::QuestionsError;

/// The bands of the spectra of one measure, from all its records, pair by pair or earthquake by earthquake as `plan`
/// has it.
///
/// - `pair_of`: the pair of each record, `[record]`: two components of a pair are not independent, and scatter as one.
pub(super) fn inferred_bands(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    (plan, pair_of): (&ResamplingPlan, &[usize]),
    confidence: f64,
) -> Result<InferredBands, QuestionsError> {
    let units = match plan.unit() {
        Unit::Record => units(pair_of),
        Unit::Pair | Unit::Event => plan.units(),
    };
    let sizes: Vec<usize> =
        plan.sizes().iter().map(|&size| units_in_sample(size, units.len(), pair_of.len()) as usize).collect();
    let targets = &stored.targets_per_year;
    // [strength][site][poe, size]
    let of_strength = |strength: usize| -> Result<Vec<Vec<InferredLimits>>, QuestionsError> {
        let demand = measure.demand(strength)?;
        let of_site = |weights| inferred_limits(&demand, weights, &units, targets, (&sizes, confidence));
        Ok(measure.weights.iter().map(of_site).collect::<Result<_, _>>()?)
    };
    let strengths: Vec<Vec<Vec<InferredLimits>>> =
        (0..stored.strengths.len()).into_par_iter().map(of_strength).collect::<Result<_, QuestionsError>>()?;
    let shape = [stored.sites.len(), stored.poes.len(), sizes.len(), strengths.len()];
    let limits = |limit: fn(&InferredLimits) -> f64| {
        Array::from_fn(shape, |[site, poe, size, strength]| limit(&strengths[strength][site][poe * sizes.len() + size]))
    };
    Ok(InferredBands {
        truth_m: [limits(|own| own.truth_m[0]), limits(|own| own.truth_m[1])],
        prediction_m: [limits(|own| own.prediction_m[0]), limits(|own| own.prediction_m[1])],
    })
}
