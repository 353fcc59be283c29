//! The bands of all strengths by all measures; what is finished outlives an interruption.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use uplift_bootstrap::{InferredLimits, Interval, ResamplingPlan, Unit, inferred_limits, units_in_sample};
use uplift_ida::Watch;
use uplift_job::events::{Events, Progress};
use uplift_job::{Array, JobError, is_stopped};
use uplift_motion::IntensityMeasure;
use uplift_result::{InferredBands, MeasureBands};
use uplift_risk::PooledDemand;
use uplift_uniform_risk::consistency::Reweighing;
use uplift_uniform_risk::{QuotedUnits, StoredMeasure, StoredStripes};

use super::checkpoint::{Checkpoint, Expected, Finished};
use super::joint::{JointSiteBands, gather_joint, joint_bands_of_site};
use super::plain::{StrengthBands, bands_of_strength, gather_bands};
use super::repaired::{SiteBands, SiteShape, bands_of_site, gather_repaired};
use super::source::Source;
use crate::error::QuestionsError;

/// Strengths done between two looks at the clock and at whoever may stop the job, a thread.
const BATCH: usize = 16;
/// What is finished is kept so often.
const KEPT_EVERY: Duration = Duration::from_secs(30);

/// The bands of all measures; what is finished is kept in `checkpoint`, if there is one.
///
/// # Errors
/// Numbers that do not fit together, in a file that was changed; a checkpoint that cannot be written; where `events`
/// say so [`JobError::Paused`], and [`JobError::Interrupted`] without a checkpoint.
pub(super) fn compute(
    source: &Source<'_>,
    checkpoint: Option<&Checkpoint>,
    events: &dyn Events,
) -> Result<Vec<MeasureBands>, QuestionsError> {
    let mut finished = checkpoint.map(|checkpoint| finished_before(source, checkpoint)).unwrap_or_default();
    let (strengths, sites) = (finished.strengths.len(), finished.sites.len());
    if let Some(checkpoint) = checkpoint
        && strengths + sites > 0
    {
        let of_sites = if sites > 0 { format!(" and {sites} repaired sites") } else { String::new() };
        events.remark("resumed", &format!("{strengths} strengths{of_sites} from {}", checkpoint.path().display()));
    }
    let start = Instant::now();
    let mut keeper = Keeper { checkpoint, kept: start };
    plain_bands(source, &mut finished, &mut keeper, events)?;
    repaired_bands(source, &mut finished, &mut keeper, events)?;
    // the result may not be writable, on a disk that has filled up for instance
    Keeper { checkpoint, kept: start }.keep_now_and_then(&finished)?;
    let Source { stored, plan, quoted, settings, .. } = source;
    let of_measure = |(measure, quoted): (&StoredMeasure, &QuotedUnits)| -> Result<MeasureBands, QuestionsError> {
        let key = measure.measure.key();
        let own: Vec<&StrengthBands> =
            finished.strengths.range((key, 0)..=(key, usize::MAX)).map(|(_, bands)| bands).collect();
        let inferred = |reweighing| {
            inferred_bands(stored, (measure, reweighing), (plan, quoted), settings.confidence)
                .map_err(|error| uplift_job::in_file(error, &stored.path))
        };
        let mut bands = gather_bands(stored, measure, plan, settings, (&own, inferred(None)?));
        if source.reweighing.is_some() {
            let (shape, first) = (source.site_shape(), settings.first_strength(&stored.strengths));
            let own: Vec<Option<&SiteBands>> =
                (0..stored.sites.len()).map(|site| finished.sites.get(&(key, site))).collect();
            let joint: Vec<Option<&JointSiteBands>> =
                (0..stored.sites.len()).map(|site| finished.joint.get(&(key, site))).collect();
            let inferred = inferred(source.reweighing)?;
            let mut repaired = gather_repaired((&own, inferred), shape, first, settings.simultaneous);
            repaired.bands.joint = gather_joint(&joint, shape, first);
            bands.repaired = Some(repaired);
        }
        Ok(bands)
    };
    stored.measures.iter().zip(*quoted).map(of_measure).collect()
}

/// Finishes the bands of plain spectra, a strength after the other.
fn plain_bands(
    source: &Source<'_>,
    finished: &mut Finished,
    keeper: &mut Keeper<'_>,
    events: &dyn Events,
) -> Result<(), QuestionsError> {
    let Source { stored, plan, settings, .. } = source;
    let strengths = stored.strengths.len();
    let per_strength = (stored.sites.len() * stored.poes.len() * plan.samples().len()) as u64;
    for measure in &stored.measures {
        let key = measure.measure.key();
        let left: Vec<usize> =
            (0..strengths).filter(|&strength| !finished.strengths.contains_key(&(key, strength))).collect();
        let total = per_strength * left.len() as u64;
        let progress = Progress::begin(events, measure.measure.label(), "ordinates", total);
        for batch in left.chunks(BATCH * rayon::current_num_threads()) {
            let done: Vec<Option<(usize, StrengthBands)>> = batch
                .par_iter()
                .map(|&strength| {
                    if progress.cancelled() {
                        return Ok(None);
                    }
                    let bands = bands_of_strength(stored, measure, strength, plan, settings)
                        .map_err(|error| uplift_job::in_file(error, &stored.path))?;
                    progress.finished(per_strength);
                    Ok(Some((strength, bands)))
                })
                .collect::<Result<_, QuestionsError>>()?;
            finished.strengths.extend(done.into_iter().flatten().map(|(strength, bands)| ((key, strength), bands)));
            if events.cancelled() {
                let done = ("strengths", finished.strengths.len(), strengths * stored.measures.len());
                return Err(keeper.stopped(finished, done));
            }
            keeper.keep_now_and_then(finished)?;
        }
    }
    Ok(())
}

/// Finishes the bands of repaired spectra, a site after the other: their weights are those of all strengths together.
fn repaired_bands(
    source: &Source<'_>,
    finished: &mut Finished,
    keeper: &mut Keeper<'_>,
    events: &dyn Events,
) -> Result<(), QuestionsError> {
    let stored = source.stored;
    let Some(reweighing) = source.reweighing else { return Ok(()) };
    note_unrepaired_branches(stored, reweighing, events);
    let is_left = |finished: &Finished, of @ (im, site): (IntensityMeasure, usize)| {
        let place = (im.key(), site);
        (reweighing.site(of).is_some() && !finished.sites.contains_key(&place))
            || (reweighing.branches(of).is_some() && !finished.joint.contains_key(&place))
    };
    let all: Vec<(IntensityMeasure, usize)> = (stored.measures.iter())
        .flat_map(|measure| (0..stored.sites.len()).map(|site| (measure.measure, site)))
        .filter(|&of| is_left(&Finished::default(), of))
        .collect();
    for measure in &stored.measures {
        let im = measure.measure;
        let left: Vec<usize> = (0..stored.sites.len()).filter(|&site| is_left(finished, (im, site))).collect();
        if left.is_empty() {
            continue;
        }
        let samples = left.iter().map(|&site| samples_left((reweighing, (im, site)), source, finished)).sum();
        let progress = Progress::begin(events, &format!("{} repaired", im.label()), "samples", samples);
        let demand = |strength| measure.demand(strength);
        let demands: Vec<PooledDemand> = (0..stored.strengths.len())
            .into_par_iter()
            .map(demand)
            .collect::<Result<_, _>>()
            .map_err(|error| uplift_job::in_file(error, &stored.path))?;
        for of in left.into_iter().map(|site| (im, site)) {
            match finish_site((reweighing, of), &demands, source, finished, &progress) {
                Ok(()) => {}
                Err(error) if is_stopped(&error) => {
                    let done = all.iter().filter(|&&of| !is_left(finished, of)).count();
                    return Err(keeper.stopped(finished, ("repaired sites", done, all.len())));
                }
                Err(error) => return Err(uplift_job::in_file(error, &stored.path)),
            }
            keeper.keep_now_and_then(finished)?;
        }
    }
    Ok(())
}

/// Samples that are weighed to finish a repaired site.
fn samples_left(
    (reweighing, of @ (im, site)): (&Reweighing, (IntensityMeasure, usize)),
    source: &Source<'_>,
    finished: &Finished,
) -> u64 {
    let Source { plan, settings, .. } = source;
    let place = (im.key(), site);
    let left_out = if settings.interval == Interval::Bca { plan.unit_count() } else { 0 };
    let is_left = reweighing.site(of).is_some() && !finished.sites.contains_key(&place);
    let own = if is_left { plan.samples().len() + left_out } else { 0 };
    let branches = reweighing.branches(of).filter(|_| !finished.joint.contains_key(&place)).unwrap_or_default();
    let solved = branches.iter().take_while(|branch| branch.analysis.is_ok()).count();
    (own + solved * plan.samples().len()) as u64
}

/// Finishes what is left of the bands of a repaired site.
fn finish_site(
    (reweighing, of @ (im, site)): (&Reweighing, (IntensityMeasure, usize)),
    demands: &[PooledDemand],
    source: &Source<'_>,
    finished: &mut Finished,
    watch: &dyn Watch,
) -> Result<(), QuestionsError> {
    let Source { stored, plan, settings, .. } = source;
    let (place, demands) = ((im.key(), site), (demands, &stored.targets_per_year[..]));
    if let Some(analysis) = reweighing.site(of).filter(|_| !finished.sites.contains_key(&place)) {
        finished.sites.insert(place, bands_of_site(&analysis, demands, (plan, settings), watch)?);
    }
    if let Some(branches) = reweighing.branches(of).filter(|_| !finished.joint.contains_key(&place)) {
        let how = (*plan, settings.confidence);
        finished.joint.insert(place, joint_bands_of_site(&branches, demands, how, watch)?);
    }
    Ok(())
}

/// Says where weighted hazard curves cannot be repaired, so that there is no joint band.
fn note_unrepaired_branches(stored: &StoredStripes, reweighing: &Reweighing, events: &dyn Events) {
    for (im, site) in stored.measures.iter().flat_map(|own| (0..stored.sites.len()).map(|site| (own.measure, site))) {
        for branch in reweighing.branches((im, site)).into_iter().flatten() {
            if let Err(reason) = &branch.analysis {
                events.note(&format!(
                    "{} by {}: no joint band of repaired spectra, since the hazard curve {} cannot be repaired: \
                     {reason}",
                    stored.sites[site],
                    im.label(),
                    branch.name
                ));
            }
        }
    }
}

/// Keeps what is finished, if there is a checkpoint to keep it in.
struct Keeper<'a> {
    checkpoint: Option<&'a Checkpoint>,
    /// When it was kept last.
    kept: Instant,
}

impl Keeper<'_> {
    /// Keeps it where that is long ago.
    fn keep_now_and_then(&mut self, finished: &Finished) -> Result<(), QuestionsError> {
        if let Some(checkpoint) = self.checkpoint
            && self.kept.elapsed() > KEPT_EVERY
        {
            checkpoint.save(finished)?;
            self.kept = Instant::now();
        }
        Ok(())
    }

    /// Keeps it, so much `done` of so much, before a job stops.
    fn stopped(&self, finished: &Finished, (what, done, total): (&'static str, usize, usize)) -> QuestionsError {
        let Some(checkpoint) = self.checkpoint else { return JobError::Interrupted.into() };
        match checkpoint.save(finished) {
            Ok(()) => {
                let path = checkpoint.path().to_owned();
                JobError::Paused { what, done: done as u64, total: total as u64, path }.into()
            }
            Err(error) => error,
        }
    }
}

impl Source<'_> {
    /// Shape of the bands of a repaired site.
    fn site_shape(&self) -> SiteShape {
        let Self { stored, plan, .. } = self;
        SiteShape { poes: stored.poes.len(), sizes: plan.sizes().len(), strengths: stored.strengths.len() }
    }
}

/// What the checkpoint has; a damaged file may hold anything.
fn finished_before(source: &Source<'_>, checkpoint: &Checkpoint) -> Finished {
    let Source { stored, plan, settings, .. } = source;
    let keys: Vec<&'static str> = stored.measures.iter().map(|measure| measure.measure.key()).collect();
    let expected = Expected { keys, site: source.site_shape(), simultaneous: settings.simultaneous };
    let mut finished = checkpoint.load(&expected);
    finished.strengths.retain(|(key, strength), done| {
        let measure = stored.measures.iter().find(|measure| measure.measure.key() == *key);
        let spectra = measure.map_or(0, |measure| {
            stored.sites.len() + measure.branches.iter().filter(|branches| !branches.is_empty()).count()
        });
        let replicates =
            if settings.simultaneous { stored.sites.len() * stored.poes.len() * plan.samples().len() } else { 0 };
        *strength < stored.strengths.len()
            && done.bands.len() == spectra * stored.poes.len() * plan.sizes().len()
            && done.replicates_m.len() == replicates
    });
    finished.sites.retain(|(_, site), _| *site < stored.sites.len());
    finished.joint.retain(|(_, site), _| *site < stored.sites.len());
    finished
}

/// The bands of the spectra of one measure, from all its records: by earthquake where `plan` draws them, else by the
/// `quoted` units; with `reweighing` those of its repaired spectra, NaN at sites without repair.
pub(super) fn inferred_bands(
    stored: &StoredStripes,
    (measure, reweighing): (&StoredMeasure, Option<&Reweighing>),
    (plan, quoted): (&ResamplingPlan, &QuotedUnits),
    confidence: f64,
) -> Result<InferredBands, QuestionsError> {
    let units = match plan.unit() {
        Unit::Record | Unit::Pair => quoted.records.clone(),
        Unit::Event => plan.units(),
    };
    let sizes: Vec<usize> =
        plan.sizes().iter().map(|&size| units_in_sample(size, units.len(), stored.records.len()) as usize).collect();
    let targets = &stored.targets_per_year;
    // [strength][site][poe, size]
    let of_strength = |strength: usize| -> Result<Vec<Vec<InferredLimits>>, QuestionsError> {
        let demand = measure.demand(strength)?;
        let asked = (&sizes[..], confidence);
        let none = InferredLimits { truth_m: [f64::NAN; 2], prediction_m: [f64::NAN; 2] };
        let of_site = |(site, weights)| match reweighing.map(|own| own.weights(measure.measure, site)) {
            None => inferred_limits(&demand, weights, &units, targets, asked),
            Some(Some(weights)) => inferred_limits(&demand, weights, &units, targets, asked),
            Some(None) => Ok(vec![none; targets.len() * sizes.len()]),
        };
        Ok(measure.weights.iter().enumerate().map(of_site).collect::<Result<_, _>>()?)
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
