//! What is known of the result of a plan before and after a part of the work.

use std::ops::Range;

use crate::peaks::{Axes, Peaks};
use crate::plan::Plan;

/// Version of the numbers: raised whenever a change of the solver or of the order of its arithmetic changes any of
/// them, so that what an earlier version computed is not mixed with what this one computes. A test holds both
/// together.
pub const NUMERICS: u32 = 3;

/// The result of a plan, each cell known or not.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    pub(crate) peaks: Peaks,
    /// As the cells of the result.
    pub(crate) known: Vec<bool>,
    /// Time histories behind each peak.
    histories_per_peak: usize,
}

impl Cells {
    /// The result of `plan`, of which nothing is known but where there is no run: there the peak is NaN.
    pub fn unknown(plan: &Plan<'_>) -> Self {
        let axes = plan.axes();
        let total = axes.cells();
        let peaks = Peaks { axes, displacement_m: vec![0.0; total], impacts: vec![0; total] };
        let histories_per_peak = plan.histories_per_peak();
        let mut cells = Self { peaks, known: vec![false; total], histories_per_peak };
        for (motion, scaled) in plan.motions().iter().enumerate() {
            for (scale, _) in scaled.scales.iter().enumerate().filter(|(_, factor)| factor.is_nan()) {
                (0..axes.systems).for_each(|system| cells.set([motion, system, scale], f64::NAN, 0));
            }
        }
        cells
    }

    /// Lengths of the axes.
    pub fn axes(&self) -> Axes {
        self.peaks.axes
    }

    /// Puts in what is known of the cell `[motion, system, scale]`.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn set(&mut self, cell: [usize; 3], displacement_m: f64, impacts: u32) {
        let index = self.peaks.axes.cell(cell);
        self.peaks.displacement_m[index] = displacement_m;
        self.peaks.impacts[index] = impacts;
        self.known[index] = true;
    }

    /// Puts in a row that is known; false, and nothing is put in, if it is of another length.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn set_row(&mut self, row: &AnalysisRow<'_>) -> bool {
        let scales = self.peaks.axes.scales;
        if row.displacement_m.len() != scales || row.impacts.len() != scales {
            return false;
        }
        let cells = self.peaks.axes.cells_of(row.motion, row.system);
        self.peaks.displacement_m[cells.clone()].copy_from_slice(row.displacement_m);
        self.peaks.impacts[cells.clone()].copy_from_slice(row.impacts);
        self.known[cells].fill(true);
        true
    }

    /// Number of time histories known of the row of a motion and system.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn known_in_row(&self, motion: usize, system: usize) -> usize {
        self.known_runs(self.peaks.axes.cells_of(motion, system))
    }

    /// Number of time histories known.
    pub fn count(&self) -> u64 {
        self.known_runs(0..self.known.len()) as u64
    }

    /// Number of time histories known among `cells`: what is NaN is no run.
    fn known_runs(&self, cells: Range<usize>) -> usize {
        let known = self.known[cells.clone()].iter().zip(&self.peaks.displacement_m[cells]);
        known.filter(|(known, displacement_m)| **known && !displacement_m.is_nan()).count() * self.histories_per_peak
    }

    /// Whether the whole row of a motion and system is known.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn is_row_known(&self, motion: usize, system: usize) -> bool {
        self.known[self.peaks.axes.cells_of(motion, system)].iter().all(|known| *known)
    }

    /// The result, once every cell is known.
    pub fn complete(self) -> Option<Peaks> {
        self.known.iter().all(|known| *known).then_some(self.peaks)
    }
}

/// The row of one motion and system over all scale factors, finished: what outlives a run that stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnalysisRow<'a> {
    /// Index of the motion.
    pub motion: usize,
    /// Index of the system.
    pub system: usize,
    /// Peak displacements over the scales, m; `+∞` where overturned, NaN where there is no run.
    pub displacement_m: &'a [f64],
    /// Impacts over the scales.
    pub impacts: &'a [u32],
}
