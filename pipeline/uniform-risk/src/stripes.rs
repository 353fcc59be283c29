//! The stripes of one intensity measure: records × strengths × levels.

use uplift_engine::analysis::Analysed;
use uplift_ida::{Peaks, Plan, ScaledMotion, StripeRecord, System};
use uplift_inputs::RecordSet;
use uplift_inputs::at_level::AtLevel;
use uplift_job::JobError;
use uplift_motion::{Accelerogram, Direction, IntensityMeasure};
use uplift_oscillator::Oscillator;
use uplift_study::{MeasurePlan, UniformRiskStudy};

use crate::error::UniformRiskError;

/// The analysed stripes of one measure.
#[derive(Debug, Clone)]
pub struct Stripes {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Its levels, cm/s or g.
    pub levels: Vec<f64>,
    /// Peaks over `[record, strength, level]`; NaN where a record does not belong to a level.
    pub peaks: Peaks,
    /// Which record is run at which level; none where every record is, scaled to it.
    pub at_level: Option<AtLevel>,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Those of them that were not known from an earlier run.
    pub computed: u64,
    /// Wall time for these, s.
    pub seconds: f64,
}

impl Stripes {
    /// The stripes of `measure`, analysed with the records of `set`.
    pub fn new(measure: &MeasurePlan, set: &RecordSet, analysed: Analysed) -> Self {
        let Analysed { peaks, analyses, computed, seconds } = analysed;
        let (levels, at_level) = (measure.levels.to_vec(), set.at_level.clone());
        Self { measure: measure.measure, levels, peaks, at_level, analyses, computed, seconds }
    }
}

/// The oscillators of a study, one a strength.
///
/// # Errors
/// A parameter that the study file's check let through: none is known.
pub fn systems(study: &UniformRiskStudy) -> Result<Vec<System>, UniformRiskError> {
    let parameters = &study.oscillator;
    study
        .strengths
        .iter()
        .map(|&strength| {
            let (u_up, restitution) = (parameters.uplift_displacement_m, parameters.restitution);
            let post_uplift = parameters.post_uplift;
            // it comes from a study, so it is not said to be typed as an oscillator's own error would be
            Oscillator::new(strength, study.gravity_m_s2, u_up, restitution, post_uplift)
                .map(System::Oscillator)
                .map_err(|error| JobError::input(error.to_string()).into())
        })
        .collect()
}

/// The oscillators that the records of `set` shake: those of the study, one a strength, for all of them; or as many of
/// each record's own, where they are not known exactly.
///
/// # Errors
/// A structure that cannot be.
pub fn systems_under(study: &UniformRiskStudy, set: &RecordSet) -> Result<Vec<System>, UniformRiskError> {
    if set.records.iter().all(|record| record.structure.is_none()) {
        return systems(study);
    }
    let drawn = set.records.iter().filter_map(|record| record.structure.as_ref());
    drawn
        .flat_map(|structure| study.strengths.iter().map(move |&strength| structure.oscillator(study, strength)))
        .map(|oscillator| Ok(System::Oscillator(oscillator?)))
        .collect()
}

/// The plan of the study's own stripes: [`plan_stripes`] of [`systems_under`] the same set.
///
/// # Errors
/// As [`plan_stripes`].
pub fn plan_own_stripes<'a>(
    study: &UniformRiskStudy,
    measure: &MeasurePlan,
    set: &'a RecordSet,
    systems: &'a [System],
) -> Result<Plan<'a>, UniformRiskError> {
    let plan = plan_stripes(study, measure, set, systems)?;
    let is_drawn = set.records.iter().any(|record| record.structure.is_some());
    if is_drawn { Ok(plan.with_own_systems()?) } else { Ok(plan) }
}

/// The plan of the stripes of `measure`, of systems that need not be those of `study`.
///
/// # Errors
/// A record that cannot be scaled.
pub fn plan_stripes<'a>(
    study: &UniformRiskStudy,
    measure: &MeasurePlan,
    set: &'a RecordSet,
    systems: &'a [System],
) -> Result<Plan<'a>, UniformRiskError> {
    if let Some(at_level) = &set.at_level {
        let motions = set.records.iter().enumerate().map(|(index, record)| ScaledMotion {
            id: &record.id,
            accelerogram: &record.accelerogram,
            scales: at_level.factors_of(index, measure.levels.len()).to_vec(),
        });
        return with_components(Plan::selected(motions.collect(), systems, study.oscillator.free_vibration)?, set);
    }
    plan_levels(study, (measure.measure, &measure.levels), set, systems)
}

/// The plan of stripes at any `levels` of a measure, in its unit, ascending; of a set that is the same at all of them.
///
/// # Errors
/// As [`plan_stripes`].
pub fn plan_levels<'a>(
    study: &UniformRiskStudy,
    (measure, levels): (IntensityMeasure, &[f64]),
    set: &'a RecordSet,
    systems: &'a [System],
) -> Result<Plan<'a>, UniformRiskError> {
    let amplitude = |value: f64| measure.amplitude(value);
    let records = set.records.iter().map(|record| StripeRecord {
        id: &record.id,
        accelerogram: &record.accelerogram,
        intensity: amplitude(record.intensity(measure)),
    });
    with_components(plan_motions((measure, levels), records.collect(), systems, study.oscillator.free_vibration)?, set)
}

/// The same `plan` of the records of `set` from all azimuths that these have, and with their vertical components where
/// a system feels them.
///
/// # Errors
/// Records whose ground falls as fast as gravity.
pub fn with_components<'a>(plan: Plan<'a>, set: &'a RecordSet) -> Result<Plan<'a>, UniformRiskError> {
    let plan = match set.records.first().map(|record| record.direction) {
        Some(Direction::Percentile { percentile, .. }) => {
            let others = set.records.iter().map(|record| record.other_azimuths.as_slice());
            plan.from_azimuths(others.collect(), percentile)?
        }
        _ => plan,
    };
    let verticals = set.records.iter().filter_map(|record| record.vertical.as_ref());
    with_verticals(plan, verticals.map(|vertical| &vertical.accelerogram).collect())
}

/// The same `plan` with these vertical components, one a motion or none, where a system feels them.
///
/// # Errors
/// As [`with_components`].
pub fn with_verticals<'a>(plan: Plan<'a>, verticals: Vec<&'a Accelerogram>) -> Result<Plan<'a>, UniformRiskError> {
    let feels = plan.systems().iter().any(|system| system.gravity_m_s2().is_some());
    if feels && !verticals.is_empty() { Ok(plan.upwards(verticals)?) } else { Ok(plan) }
}

/// The plan of the stripes at `levels` of a measure of other motions than the records of a study, with the intensities
/// that their amplitudes are scaled by.
///
/// # Errors
/// A motion that cannot be scaled.
pub fn plan_motions<'a>(
    (measure, levels): (IntensityMeasure, &[f64]),
    motions: Vec<StripeRecord<'a>>,
    systems: &'a [System],
    with_free_peak: bool,
) -> Result<Plan<'a>, UniformRiskError> {
    let levels: Vec<f64> = levels.iter().map(|&level| measure.amplitude(level)).collect();
    Ok(Plan::stripes(motions, systems, &levels, with_free_peak)?)
}
