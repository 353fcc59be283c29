//! The plan carried out on all cores.

use rayon::prelude::*;
use uplift_oscillator::{GroundMotion, Sweep};

use crate::edp::EdpArray;
use crate::error::IdaError;
use crate::plan::{Plan, excitation};
use crate::watch::Watch;

/// Carry out `plan` on the threads of the current rayon pool.
///
/// The work is cut into one piece a record and strength. Each piece has its own place in the result and depends on nothing else,
/// so the numbers are the same for any number of threads. Memory: 12 bytes an analysis, and a level's worth of scratch a piece.
///
/// # Errors
/// [`IdaError::Cancelled`] if `watch` says so.
pub fn analyse(plan: &Plan<'_>, watch: &dyn Watch) -> Result<EdpArray, IdaError> {
    let (strengths, levels) = (plan.oscillators.len(), plan.levels.len());
    let shape = [plan.records.len(), strengths, levels];
    let total = shape.iter().product();
    let ground_motions =
        plan.records.iter().map(|record| excitation(record).map(GroundMotion::new)).collect::<Result<Vec<_>, _>>()?;
    let mut edp_m = vec![0.0; total];
    let mut impacts = vec![0; total];

    edp_m.par_chunks_mut(levels).zip(impacts.par_chunks_mut(levels)).enumerate().try_for_each(
        |(piece, (edp_m, impacts))| {
            if watch.cancelled() {
                return Err(IdaError::Cancelled);
            }
            let record = &plan.records[piece / strengths];
            let oscillator = &plan.oscillators[piece % strengths];
            let sweep = Sweep::new(oscillator, &ground_motions[piece / strengths], plan.with_free_peak);
            for ((level, edp_m), impacts) in plan.levels.iter().zip(edp_m.iter_mut()).zip(impacts) {
                let peak = sweep.peak(level / record.intensity);
                *edp_m = peak.displacement_m;
                *impacts = peak.impacts;
            }
            watch.finished(levels as u64);
            Ok(())
        },
    )?;
    Ok(EdpArray { shape, edp_m, impacts })
}
