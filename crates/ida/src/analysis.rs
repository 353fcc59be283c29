//! The plan carried out on all cores.

use rayon::prelude::*;
use uplift_oscillator::{GroundMotion, Sweep};

use crate::cells::{Cells, Part, Piece};
use crate::edp::EdpArray;
use crate::error::IdaError;
use crate::plan::{Plan, excitation};
use crate::watch::Watch;

/// Carry out `plan` on the threads of the current rayon pool.
///
/// The work is cut into one piece a record and strength. Each piece has its own place in the result and depends on nothing else,
/// so the numbers are the same for any number of threads. Memory: 13 bytes an analysis, and a level's worth of scratch a piece.
///
/// # Errors
/// [`IdaError::Cancelled`] if `watch` says so.
pub fn analyse(plan: &Plan<'_>, watch: &dyn Watch) -> Result<EdpArray, IdaError> {
    let cells = complete(plan, Cells::unknown(plan), Part::WHOLE, watch, &|_| {})?;
    Ok(cells.edp)
}

/// Carry out what `cells` lacks of one `part` of `plan`, and hand every piece to `keep` when it is finished, from any thread.
///
/// A cell depends on its record, strength and level alone: whatever was known before, the numbers are those of an undisturbed
/// [`analyse`], to the bit. A piece of which everything is known is not handed over again.
///
/// # Errors
/// [`IdaError::Cancelled`] if `watch` says so; what `keep` was given is finished all the same.
pub fn complete(
    plan: &Plan<'_>,
    mut cells: Cells,
    part: Part,
    watch: &dyn Watch,
    keep: &(dyn Fn(&Piece<'_>) + Sync),
) -> Result<Cells, IdaError> {
    let (strengths, levels) = (plan.oscillators.len(), plan.levels.len());
    // a ground motion is made ready only if something of it is missing
    let ground_motions = plan
        .records
        .iter()
        .enumerate()
        .map(|(record, stripe)| {
            let missing =
                |strength: usize| part.contains(record, strength, strengths) && !cells.is_row_known(record, strength);
            (0..strengths).any(missing).then(|| excitation(stripe).map(GroundMotion::new)).transpose()
        })
        .collect::<Result<Vec<_>, _>>()?;
    let edp_m = cells.edp.edp_m.par_chunks_mut(levels);
    let impacts = cells.edp.impacts.par_chunks_mut(levels);
    edp_m.zip(impacts).zip(cells.known.par_chunks_mut(levels)).enumerate().try_for_each(
        |(piece, ((edp_m, impacts), known))| {
            let (record, strength) = (piece / strengths, piece % strengths);
            if watch.cancelled() {
                return Err(IdaError::Cancelled);
            }
            if !part.contains(record, strength, strengths) {
                return Ok(());
            }
            if let (Some(ground_motion), true) = (&ground_motions[record], known.iter().any(|known| !known)) {
                let sweep = Sweep::new(&plan.oscillators[strength], ground_motion, plan.with_free_peak);
                let intensity = plan.records[record].intensity;
                let missing: Vec<usize> = (0..levels).filter(|level| !known[*level]).collect();
                let scales: Vec<f64> = missing.iter().map(|level| plan.levels[*level] / intensity).collect();
                for (level, peak) in missing.into_iter().zip(sweep.peaks(&scales)) {
                    edp_m[level] = peak.displacement_m;
                    impacts[level] = peak.impacts;
                }
                known.fill(true);
                keep(&Piece { record, strength, edp_m, impacts });
            }
            watch.finished(levels as u64);
            Ok(())
        },
    )?;
    Ok(cells)
}
