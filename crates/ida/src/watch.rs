//! Progress and cancellation.

/// Someone who watches an analysis from outside.
pub trait Watch: Sync {
    /// So many analyses have been finished since the last call. Called from every thread.
    fn finished(&self, analyses: u64);

    /// True to stop at the next chance.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn finished(&self, _: u64) {}
}
