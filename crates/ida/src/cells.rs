//! What is known of an array of engineering demand parameters before and after a part of the work.

use crate::edp::EdpArray;
use crate::plan::Plan;

/// Version of the numbers: raised whenever a change of the solver or of the order of its arithmetic changes any of
/// them, so that what an earlier version computed is not mixed with what this one computes. A test holds both
/// together.
pub const NUMERICS: u32 = 3;

/// The array of a plan, each cell known or not.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    pub(crate) edp: EdpArray,
    /// Row-major as the array.
    pub(crate) known: Vec<bool>,
}

impl Cells {
    /// The array of `plan`, of which nothing is known.
    pub fn unknown(plan: &Plan<'_>) -> Self {
        let shape = [plan.records.len(), plan.oscillators.len(), plan.levels.len()];
        let total = shape.iter().product();
        Self { edp: EdpArray { shape, edp_m: vec![0.0; total], impacts: vec![0; total] }, known: vec![false; total] }
    }

    /// Puts in what is known of the cell `[record, strength, level]`.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn set(&mut self, [record, strength, level]: [usize; 3], edp_m: f64, impacts: u32) {
        let [records, strengths, levels] = self.edp.shape;
        assert!(record < records && strength < strengths && level < levels, "cell out of range");
        let index = (record * strengths + strength) * levels + level;
        self.edp.edp_m[index] = edp_m;
        self.edp.impacts[index] = impacts;
        self.known[index] = true;
    }

    /// Number of levels in a row.
    pub fn levels(&self) -> usize {
        self.edp.shape[2]
    }

    /// Number of cells known of the row of a record and strength.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn known_in_row(&self, record: usize, strength: usize) -> usize {
        let [_, strengths, levels] = self.edp.shape;
        let start = (record * strengths + strength) * levels;
        self.known[start..start + levels].iter().filter(|known| **known).count()
    }

    /// Number of cells known.
    pub fn count(&self) -> u64 {
        self.known.iter().filter(|known| **known).count() as u64
    }

    /// Whether the whole row of a record and strength is known.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn is_row_known(&self, record: usize, strength: usize) -> bool {
        self.known_in_row(record, strength) == self.levels()
    }

    /// The array, once every cell is known.
    pub fn complete(self) -> Option<EdpArray> {
        self.known.iter().all(|known| *known).then_some(self.edp)
    }
}

/// The row of one record and strength, finished.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece<'a> {
    /// Index of the record.
    pub record: usize,
    /// Index of the strength.
    pub strength: usize,
    /// Peak displacements over the levels, m; `+∞` where overturned.
    pub edp_m: &'a [f64],
    /// Impacts over the levels.
    pub impacts: &'a [u32],
}

/// One of several parts that a plan is cut into, each for a machine of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Which, from 0.
    pub index: u64,
    /// Of how many, at least 1.
    pub count: u64,
}

impl Part {
    /// The whole.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Whether the piece of `record` and `strength` belongs to this part: pieces are dealt like cards, strength after
    /// strength, so that parts cost about the same.
    pub fn contains(self, record: usize, strength: usize, strengths: usize) -> bool {
        (record as u64 * strengths as u64 + strength as u64) % self.count == self.index
    }
}
