//! The stripes of one intensity measure: records × strengths × levels.

use std::time::Instant;

use uplift_ida::{Cells, EdpArray, IdaError, Part, Piece, Plan, StripeRecord, Watch, complete};
use uplift_motion::IntensityMeasure;
use uplift_oscillator::Oscillator;

use crate::error::UpliftError;
use crate::inputs::RecordSet;
use uplift_study::{MeasurePlan, UniformRiskStudy};

/// The analysed stripes of one measure.
#[derive(Debug, Clone)]
pub struct Stripes {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Its levels, cm/s or g.
    pub levels: Vec<f64>,
    /// Peak displacements over `[record, strength, level]`, m.
    pub edp: EdpArray,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Those of them that were not known from an earlier run.
    pub computed: u64,
    /// Wall time for these, s.
    pub seconds: f64,
}

/// The oscillators of a study, one a strength.
///
/// # Errors
/// A parameter that the study file's check let through: none is known.
pub fn oscillators(study: &UniformRiskStudy) -> Result<Vec<Oscillator>, UpliftError> {
    let parameters = &study.oscillator;
    study
        .strengths
        .iter()
        .map(|&strength| {
            let (u_up, restitution) = (parameters.uplift_displacement_m, parameters.restitution);
            Oscillator::new(strength, study.gravity_m_s2, u_up, restitution, parameters.post_uplift)
                .map_err(|error| UpliftError::input(error.to_string()))
        })
        .collect()
}

/// The plan of the stripes of `measure`.
///
/// # Errors
/// A record that cannot be scaled.
pub fn plan_stripes<'a>(
    study: &'a UniformRiskStudy,
    measure: &'a MeasurePlan,
    set: &'a RecordSet,
    oscillators: &'a [Oscillator],
) -> Result<Plan<'a>, UpliftError> {
    let records = stripe_records(set, measure.measure);
    Plan::new(records, oscillators, &measure.levels, study.oscillator.free_vibration)
        .map_err(|error| UpliftError::input(error.to_string()))
}

/// The records with the intensities that scale them.
pub(crate) fn stripe_records(set: &RecordSet, measure: IntensityMeasure) -> Vec<StripeRecord<'_>> {
    set.records
        .iter()
        .map(|record| StripeRecord {
            id: &record.id,
            accelerogram: &record.accelerogram,
            intensity: record.intensity(measure),
        })
        .collect()
}

/// Carry out what `cells` lacks of one part of `plan` on all threads; every finished piece goes to `keep`. None unless the part is the
/// whole.
///
/// # Errors
/// [`UpliftError::Interrupted`] if `watch` says so.
pub fn analyse_stripes(
    measure: &MeasurePlan,
    plan: &Plan<'_>,
    cells: Cells,
    part: Part,
    watch: &dyn Watch,
    keep: &(dyn Fn(&Piece<'_>) + Sync),
) -> Result<Option<Stripes>, UpliftError> {
    let start = Instant::now();
    let known = cells.count();
    let cells = complete(plan, cells, part, watch, keep).map_err(|error| match error {
        IdaError::Cancelled => UpliftError::Interrupted,
        other => UpliftError::input(other.to_string()),
    })?;
    let seconds = start.elapsed().as_secs_f64();
    let analyses = plan.analyses();
    Ok(cells.complete().filter(|_| part == Part::WHOLE).map(|edp| Stripes {
        measure: measure.measure,
        levels: measure.levels.to_vec(),
        edp,
        analyses,
        computed: analyses - known,
        seconds,
    }))
}
