//! The parts that several machines share.

/// One of several parts that a plan is cut into, each for a machine of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 0.
    pub index: u64,
    /// Of how many, at least 1.
    pub count: u64,
}

impl Shard {
    /// The whole.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Whether this is the whole.
    pub fn is_whole(self) -> bool {
        self.count == 1
    }

    /// Whether a row belongs to this shard, by its place among the rows of a plan: rows are dealt like cards, so that
    /// shards cost about the same.
    pub fn contains(self, row: usize) -> bool {
        row as u64 % self.count == self.index
    }
}
