//! The result of an analysis.

use std::ops::Range;

/// Lengths of the axes of an analysis. Cells lie motion after motion, in each system after system, in each scale after
/// scale; all scales of a motion and system are a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axes {
    /// Ground motions.
    pub motions: usize,
    /// Systems.
    pub systems: usize,
    /// Scale factors of each motion; levels, where these are stripes.
    pub scales: usize,
}

impl Axes {
    /// Number of rows.
    pub fn rows(self) -> usize {
        self.motions * self.systems
    }

    /// Number of cells.
    pub fn cells(self) -> usize {
        self.rows() * self.scales
    }

    /// Where the row of a motion and system stands among the rows.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn row(self, motion: usize, system: usize) -> usize {
        assert!(motion < self.motions && system < self.systems, "row [{motion}, {system}] of {self:?}");
        motion * self.systems + system
    }

    /// Motion and system of a row.
    pub fn motion_and_system(self, row: usize) -> (usize, usize) {
        (row / self.systems, row % self.systems)
    }

    /// The cells of a row.
    pub(crate) fn cells_of(self, motion: usize, system: usize) -> Range<usize> {
        let first = self.row(motion, system) * self.scales;
        first..first + self.scales
    }

    /// Where the cell `[motion, system, scale]` is.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn cell(self, [motion, system, scale]: [usize; 3]) -> usize {
        assert!(scale < self.scales, "scale {scale} of {self:?}");
        self.row(motion, system) * self.scales + scale
    }
}

/// Peak displacements and impact counts over `[motion, system, scale]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Peaks {
    pub(crate) axes: Axes,
    pub(crate) displacement_m: Vec<f64>,
    pub(crate) impacts: Vec<u32>,
}

impl Peaks {
    /// Lengths of the axes.
    pub fn axes(&self) -> Axes {
        self.axes
    }

    /// Peak displacements, m, row-major; `+∞` where the system overturned, NaN where there is no run.
    pub fn displacement_m(&self) -> &[f64] {
        &self.displacement_m
    }

    /// Impacts of each run, row-major.
    pub fn impacts(&self) -> &[u32] {
        &self.impacts
    }

    /// The peak displacement of the cell `[motion, system, scale]`, m.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn at_m(&self, cell: [usize; 3]) -> f64 {
        self.displacement_m[self.axes.cell(cell)]
    }

    /// The peaks of a motion and system over the scales, m.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn row_m(&self, motion: usize, system: usize) -> &[f64] {
        &self.displacement_m[self.axes.cells_of(motion, system)]
    }

    /// The peaks of one system over `[motion, scale]`, row-major, m.
    ///
    /// # Panics
    /// If the system is out of range, which is a bug of the caller.
    pub fn system_m(&self, system: usize) -> Vec<f64> {
        (0..self.axes.motions).flat_map(|motion| self.row_m(motion, system).iter().copied()).collect()
    }

    /// The peaks of one system at one of the scales, one a motion, m: the sample that a percentile is taken of.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn over_motions_m(&self, system: usize, scale: usize) -> Vec<f64> {
        (0..self.axes.motions).map(|motion| self.at_m([motion, system, scale])).collect()
    }
}
