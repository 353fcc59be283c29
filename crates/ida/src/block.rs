//! The stripes of rigid rocking blocks: their full nonlinear motion (Eq. 2.1 to 2.3) in place of the piecewise-linear oscillator.

use rayon::prelude::*;
use uplift_block::{FreeRocking, RockingBlock, respond};

use crate::edp::EdpArray;
use crate::error::IdaError;
use crate::plan::{StripeRecord, check_axes};
use crate::watch::Watch;

/// A checked plan of block stripes.
#[derive(Debug, Clone)]
pub struct BlockPlan<'a> {
    records: Vec<StripeRecord<'a>>,
    blocks: &'a [RockingBlock],
    levels: &'a [f64],
    with_free_peak: bool,
}

impl<'a> BlockPlan<'a> {
    /// Plan the stripes.
    ///
    /// * `records` — with their unscaled intensities
    /// * `blocks` — in the order of the second axis of the array
    /// * `levels` — intensity levels of the stripes, ascending, in the unit of the records' intensities
    /// * `with_free_peak` — whether the first peak of the free rocking after a record counts
    ///
    /// # Errors
    /// An empty axis, levels that do not ascend, a record of zero intensity.
    pub fn new(
        records: Vec<StripeRecord<'a>>,
        blocks: &'a [RockingBlock],
        levels: &'a [f64],
        with_free_peak: bool,
    ) -> Result<Self, IdaError> {
        check_axes(&records, ("blocks", blocks.len()), levels)?;
        Ok(Self { records, blocks, levels, with_free_peak })
    }

    /// Number of nonlinear time histories in the plan.
    pub fn analyses(&self) -> u64 {
        (self.records.len() * self.blocks.len() * self.levels.len()) as u64
    }
}

/// Carry out `plan` on the threads of the current rayon pool: peak displacements of the top (Eq. 2.10) over `[record, block, level]`, m, `+∞` where
/// the block overturned.
///
/// Every run depends on its own record, block and level alone: the numbers are the same for any number of threads. A run costs
/// microseconds a second of record while the block rocks, next to nothing while it rests.
///
/// # Errors
/// [`IdaError::Cancelled`] if `watch` says so; [`IdaError::Block`] for a motion that is not computed.
pub fn analyse_blocks(plan: &BlockPlan<'_>, watch: &dyn Watch) -> Result<EdpArray, IdaError> {
    let (blocks, levels) = (plan.blocks.len(), plan.levels.len());
    let free = if plan.with_free_peak { FreeRocking::FirstPeak } else { FreeRocking::Lasting { duration_s: 0.0 } };
    let run = |cell: usize| -> Result<(f64, u32), IdaError> {
        if watch.cancelled() {
            return Err(IdaError::Cancelled);
        }
        let record = &plan.records[cell / (blocks * levels)];
        let fail = |reason: String| IdaError::Block { record: record.id.to_owned(), reason };
        let scale = plan.levels[cell % levels] / record.intensity;
        let ground = record.accelerogram.scaled(scale).map_err(|error| fail(error.to_string()))?;
        let block = &plan.blocks[cell / levels % blocks];
        let response = respond(block, &ground, free).map_err(|error| fail(error.to_string()))?;
        watch.finished(1);
        Ok((response.displacement_m, u32::try_from(response.impacts).unwrap_or(u32::MAX)))
    };
    let shape = [plan.records.len(), blocks, levels];
    let (edp_m, impacts) =
        (0..shape.iter().product()).into_par_iter().map(run).collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
    Ok(EdpArray { shape, edp_m, impacts })
}
