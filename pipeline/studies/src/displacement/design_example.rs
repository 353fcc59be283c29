//! The design examples of Sections 2.4.3 and 3.4.5 for every set and way of scaling.

use rayon::prelude::*;
use uplift_engine::checkpoint::Checkpoint;
use uplift_ida::{Plan, Shard, Watch};
use uplift_job::events::{Events, Progress};
use uplift_job::{JobError, is_stopped};
use uplift_result::RULES;
use uplift_spectra::{
    Case, MotionSet, NUDGES, RestrainedDesign, RestrainedExample, Scaling, SolitaryDesign, SolitaryExample,
    SpectraError,
};
use uplift_study::{DesignPlan, Designed, DisplacementStudy, Structures};

use super::KeyedMotions;
use super::spectra::with_free_vibration;
use crate::error::StudiesError;

/// Ratio of neighbouring slendernesses in the search for the intersection: a range in which the block does not stand
/// may be missed if it is narrower.
const SEARCH_RATIO: f64 = 1.02;
/// Halvings, at most, after that search.
const HALVINGS: u64 = 16;

/// The design examples of a study; a way of scaling is `[to, by]` of it.
#[derive(Debug, Clone)]
pub enum Designs {
    /// Restrained bridges over `[set, way, rule]`.
    Restrained(Vec<Doubted<RestrainedExample>>),
    /// Solitary blocks over `[set, way]`; none where the capacity line meets no demand.
    Solitary(Vec<Option<Doubted<SolitaryExample>>>),
}

/// A design example with its noise, and how far rounding alone moves its values.
#[derive(Debug, Clone, Copy)]
pub struct Doubted<Example> {
    /// Values with their range over the sweep.
    pub example: Example,
    /// The same values with their range over scale factors that differ by rounding.
    pub rounding: Example,
}

/// Nonlinear time histories of the design examples; for blocks, whose design is looked for, at most.
pub fn design_analyses(study: &DisplacementStudy, plan: &DesignPlan, set: &MotionSet<'_>) -> u64 {
    let points = (plan.noise_points + NUDGES) as u64;
    let each = match plan.designed {
        Designed::Bridge { .. } => 2 * 2 * points,
        Designed::Block { .. } => {
            let abscissa = study.structures.abscissa();
            let steps = (abscissa[abscissa.len() - 1] / abscissa[0]).ln() / SEARCH_RATIO.ln();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of steps")]
            let steps = steps.ceil() as u64;
            steps + HALVINGS + 3 * points
        }
    };
    each * (set.motions().len() * study.scaling.ways().0.len()) as u64
}

/// Carry out one shard of the design examples: sets scaled in one way are dealt to the shards like analysis rows. Their
/// many small plans share the `checkpoint` of the spectra, of which `analyses` are finished.
///
/// Returned, if the shard is the whole and the study asks for them, are the designs, with a note on each that does not
/// exist.
///
/// # Errors
/// [`JobError::Paused`] or [`JobError::Interrupted`] where `events` say so; what the solvers and rules refuse.
pub(crate) fn carry_out_designs(
    study: &DisplacementStudy,
    sets: &KeyedMotions<'_>,
    shard: Shard,
    (checkpoint, analyses): (&Checkpoint, u64),
    events: &dyn Events,
) -> Result<Option<(Designs, Vec<String>)>, StudiesError> {
    let Some(plan) = &study.design else { return Ok(None) };
    let examples = (sets.motions.len() * study.scaling.ways().0.len()) as u64;
    events.remark("design", &format!("{examples} examples, {} points around each value", plan.noise_points));
    let progress = Progress::begin(events, "design", "examples", examples / shard.count);
    let carrier = Carrier { sets, shard, checkpoint, watch: &progress };
    let designs = design_examples(study, plan, &carrier);
    drop(progress);
    match designs {
        Err(error) if is_stopped(&error) => Err(checkpoint.stopped(analyses, analyses).into()),
        other => {
            checkpoint.sync()?;
            other
        }
    }
}

/// What carries out the plans of the examples.
struct Carrier<'a> {
    sets: &'a KeyedMotions<'a>,
    shard: Shard,
    checkpoint: &'a Checkpoint,
    /// Told of finished examples.
    watch: &'a dyn Watch,
}

impl Carrier<'_> {
    /// `of` each set scaled in each of the `ways` that belongs to the shard, on all cores.
    fn each<T: Send>(
        &self,
        ways: &[Scaling],
        of: impl Fn(Case<'_>) -> Result<T, SpectraError> + Sync,
    ) -> Result<Vec<T>, StudiesError> {
        let places: Vec<(usize, Scaling)> =
            (0..self.sets.motions.len()).flat_map(|set| ways.iter().map(move |way| (set, *way))).collect();
        let example = |&(set, scaling): &(usize, Scaling)| {
            let carry_out = |plan: &Plan<'_>| self.checkpoint.peaks(plan, &self.sets.keys[set], &Within(self.watch));
            let example = of(Case { set: &self.sets.motions[set], scaling, nudge: 1.0, carry_out: &carry_out })?;
            self.watch.finished(1);
            Ok(example)
        };
        let places = places.par_iter().enumerate().filter(|(place, _)| self.shard.contains(*place));
        Ok(places.map(|(_, place)| example(place)).collect::<Result<Vec<T>, SpectraError>>()?)
    }
}

fn design_examples(
    study: &DisplacementStudy,
    plan: &DesignPlan,
    carrier: &Carrier<'_>,
) -> Result<Option<(Designs, Vec<String>)>, StudiesError> {
    let (ways, places) = study.scaling.ways();
    let noise = plan.noise()?;
    // what is not scaled stands under every `by`
    let everywhere = |case: usize| case / places.len() * ways.len() + places[case % places.len()];
    let all = 0..carrier.sets.motions.len() * places.len();
    match (plan.designed, &study.structures) {
        (Designed::Bridge { width_m, height_m }, Structures::Oscillators(family)) => {
            let design = RestrainedDesign {
                strength: strength(width_m, height_m),
                uplift_displacement_m: family.uplift_displacement_m[0],
                restitution: family.restitution,
                gravity_m_s2: study.gravity_m_s2,
                least_capacity_m: width_m,
                safety_factor: plan.safety_factor,
                percent: plan.percentile,
                with_free_vibration: with_free_vibration(study),
            };
            let found = carrier.each(&ways, |case| {
                let doubted = |&rule| {
                    let example = design.example(case, rule, noise)?;
                    Ok(Doubted { example, rounding: design.rounding(case, rule, &example)? })
                };
                RULES.iter().map(doubted).collect::<Result<Vec<_>, SpectraError>>()
            })?;
            let designs = || all.flat_map(|case| found[everywhere(case)].clone()).collect();
            Ok(carrier.shard.is_whole().then(|| (Designs::Restrained(designs()), Vec::new())))
        }
        (Designed::Block { height_m, endless_height_m }, Structures::Blocks(family)) => {
            let abscissa = &family.slendernesses;
            let design = SolitaryDesign {
                height_m,
                endless_height_m,
                gravity_m_s2: study.gravity_m_s2,
                restitution: family.restitution,
                safety_factor: plan.safety_factor,
                percent: plan.percentile,
                search: [abscissa[0], abscissa[abscissa.len() - 1]],
                search_ratio: SEARCH_RATIO,
            };
            let found = carrier.each(&ways, |case| match design.example(case, noise) {
                Ok(example) => Ok(Ok(Doubted { example, rounding: design.rounding(case, &example)? })),
                Err(error @ SpectraError::NoIntersection { .. }) => Ok(Err(error.to_string())),
                Err(error) => Err(error),
            })?;
            let notes = found.iter().filter_map(|example| example.as_ref().err().cloned()).collect();
            let designs = || all.map(|case| found[everywhere(case)].as_ref().ok().copied()).collect();
            Ok(carrier.shard.is_whole().then(|| (Designs::Solitary(designs()), notes)))
        }
        // the study's reader gives neither the design of the other
        (Designed::Bridge { .. }, Structures::Blocks(_)) | (Designed::Block { .. }, Structures::Oscillators(_)) => {
            Err(JobError::input("a bridge is designed with oscillators, a block with blocks").into())
        }
    }
}

/// Strength of a column that rocks, `tan(2b/2h)` as Section 3.5 writes it.
pub fn strength(width_m: f64, height_m: f64) -> f64 {
    (width_m / height_m).tan()
}

/// Passes on that the work is to stop, and nothing of its progress: that is reported example by example.
struct Within<'a>(&'a dyn Watch);

impl Watch for Within<'_> {
    fn finished(&self, _: u64) {}

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
