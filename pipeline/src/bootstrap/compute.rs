//! The bands of all strengths by all measures; what is finished outlives an interruption.

use std::time::{Duration, Instant};

use rayon::prelude::*;
use uplift_bootstrap::ResamplingPlan;
use uplift_ida::Watch;

use super::bands::{BandSettings, Bands, StrengthBands, bands_of_strength, gather_bands};
use super::checkpoint::{Checkpoint, Finished};
use crate::error::UpliftError;
use crate::events::{Events, Progress};
use crate::result::StoredStripes;

/// Strengths done between two looks at the clock and at whoever may stop the job, a thread.
const BATCH: usize = 16;
/// What is finished is kept so often.
const KEPT_EVERY: Duration = Duration::from_secs(30);

/// The bands of all measures.
pub(super) fn compute(
    stored: &StoredStripes,
    plan: &ResamplingPlan,
    settings: &BandSettings,
    checkpoint: &Checkpoint,
    events: &dyn Events,
) -> Result<Vec<Bands>, UpliftError> {
    let mut finished = finished_before(stored, plan, settings, checkpoint);
    if !finished.is_empty() {
        events.remark("resumed", &format!("{} strengths from {}", finished.len(), checkpoint.path().display()));
    }
    let start = Instant::now();
    let strengths = stored.strengths.len();
    let per_strength = (stored.sites.len() * stored.poes.len() * plan.samples().len()) as u64;
    for measure in &stored.measures {
        let key = measure.measure.key();
        let left: Vec<usize> = (0..strengths).filter(|&strength| !finished.contains_key(&(key, strength))).collect();
        let total = per_strength * left.len() as u64;
        let progress = Progress::begin(events, measure.measure.label(), "ordinates", total);
        let mut kept = Instant::now();
        for batch in left.chunks(BATCH * rayon::current_num_threads()) {
            let done: Vec<Option<(usize, StrengthBands)>> = batch
                .par_iter()
                .map(|&strength| {
                    if progress.cancelled() {
                        return Ok(None);
                    }
                    let bands = bands_of_strength(stored, measure, strength, plan, settings)
                        .map_err(|error| error.in_file(&stored.path))?;
                    progress.finished(per_strength);
                    Ok(Some((strength, bands)))
                })
                .collect::<Result<_, UpliftError>>()?;
            finished.extend(done.into_iter().flatten().map(|(strength, bands)| ((key, strength), bands)));
            let stopped = events.cancelled();
            if stopped || kept.elapsed() > KEPT_EVERY {
                checkpoint.save(&finished)?;
                kept = Instant::now();
            }
            if stopped {
                return Err(UpliftError::Paused {
                    what: "strengths",
                    done: finished.len() as u64,
                    total: (strengths * stored.measures.len()) as u64,
                    path: checkpoint.path().to_owned(),
                });
            }
        }
    }
    if start.elapsed() > KEPT_EVERY {
        // the result may not be writable, on a disk that has filled up for instance
        checkpoint.save(&finished)?;
    }
    let of_measure = |measure: &crate::result::StoredMeasure| {
        let key = measure.measure.key();
        let own: Vec<&StrengthBands> = finished.range((key, 0)..=(key, usize::MAX)).map(|(_, bands)| bands).collect();
        gather_bands(stored, measure, plan, settings, &own)
    };
    Ok(stored.measures.iter().map(of_measure).collect())
}

/// What the checkpoint has; a damaged file may hold anything.
fn finished_before(
    stored: &StoredStripes,
    plan: &ResamplingPlan,
    settings: &BandSettings,
    checkpoint: &Checkpoint,
) -> Finished {
    let keys: Vec<&'static str> = stored.measures.iter().map(|measure| measure.measure.key()).collect();
    let mut finished = checkpoint.load(&keys);
    finished.retain(|(key, strength), done| {
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
    finished
}
