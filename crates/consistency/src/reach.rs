//! What no weights of the records can give.

use crate::solver::FIT_RATES;

/// How many of the [`FIT_RATES`] rates are out of reach, and on which side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reach {
    /// Rates at which even the records of the smallest y/x, of each stripe where these have their own, bring the site's
    /// level more often: `Σ w_i 1[x_i q_min > y_n] > ρ_n`.
    pub set_above: usize,
    /// Rates at which even the records of the largest y/x bring it less often: `Σ w_i 1[x_i q_max > y_n] < ρ_n`.
    pub set_below: usize,
}

impl Reach {
    /// Whether every rate is within reach.
    pub fn is_whole(self) -> bool {
        self.out_of_reach() == 0
    }

    /// Number of rates out of reach, of [`FIT_RATES`].
    pub fn out_of_reach(self) -> usize {
        debug_assert!(self.set_above + self.set_below <= FIT_RATES);
        self.set_above + self.set_below
    }
}
