//! What a restrainer is made of: a spring, a stopper beside it, a tendon behind both.

use crate::error::{StaticsError, not_negative, positive};
use crate::stack::DiscStack;

/// The spring of a restrainer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spring {
    /// No spring: the tendon alone.
    Rigid,
    /// A spring that stays linear and never ends.
    Linear {
        /// Stiffness, N/m; 0 is none at all.
        stiffness_n_m: f64,
    },
    /// A stack of disc springs.
    Discs(DiscStack),
}

/// Rods beside the spring that engage once it has closed a gap: `min(k (d − gap), F_y)` for `d > gap`
/// (Section 6.3.4).
///
/// Beyond `gap + F_y/k` the rods stretch plastically. They unload along their stiffness, and engage anew at a gap that
/// has grown by the plastic part: see [`Restrainer::after_yielding`](crate::Restrainer::after_yielding).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stopper {
    /// Deformation of the spring at which the stopper engages, m.
    pub gap_m: f64,
    /// Stiffness `EA/L` of all rods together, N/m.
    pub stiffness_n_m: f64,
    /// Force at which they yield, N; none where they never do.
    pub yield_n: Option<f64>,
}

impl Stopper {
    /// The stopper, if its numbers can be.
    pub(crate) fn checked(self) -> Result<Self, StaticsError> {
        not_negative("gap_m", self.gap_m, "m")?;
        positive("stiffness_n_m", self.stiffness_n_m, "N/m")?;
        if let Some(yield_n) = self.yield_n {
            positive("yield_n", yield_n, "N")?;
        }
        Ok(self)
    }

    /// Deformation at which it yields, `gap + F_y/k`, m.
    pub fn yields_at_m(&self) -> Option<f64> {
        self.yield_n.map(|yield_n| self.gap_m + yield_n / self.stiffness_n_m)
    }

    /// Plastic way of its rods once the spring was pressed by `largest_deformation_m` (m) at most, m.
    pub(crate) fn plastic_m(&self, largest_deformation_m: f64) -> f64 {
        self.yields_at_m().map_or(0.0, |yields_m| (largest_deformation_m - yields_m).max(0.0))
    }

    /// Energy that it has dissipated once the spring was pressed by `largest_deformation_m` (m) at most, J: its force
    /// times its plastic way.
    pub fn dissipated_j(&self, largest_deformation_m: f64) -> f64 {
        self.yield_n.unwrap_or(0.0) * self.plastic_m(largest_deformation_m)
    }
}

/// The tendon in series with the spring: linear until it yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tendon {
    /// Stiffness `EA/L`, N/m.
    pub stiffness_n_m: f64,
    /// Force at which it yields, N.
    pub yield_n: Option<f64>,
    /// Force at which it, or its socket, fails, N.
    pub failure_n: Option<f64>,
}

impl Tendon {
    /// The tendon, if its numbers can be.
    pub(crate) fn checked(self) -> Result<Self, StaticsError> {
        positive("tendon_stiffness_n_m", self.stiffness_n_m, "N/m")?;
        for (key, value) in [("tendon_yield_n", self.yield_n), ("tendon_failure_n", self.failure_n)] {
            if let Some(value) = value {
                positive(key, value, "N")?;
            }
        }
        Ok(self)
    }
}

/// What happens once the springs are flat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhenFlat {
    /// Only the tendon stretches on.
    #[default]
    Tendon,
    /// The column is stopped there: the law ends.
    Stop,
}

/// A restrainer as it is put together; [`Restrainer::new`](crate::Restrainer::new) checks it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts {
    /// Spring.
    pub spring: Spring,
    /// Stopper beside the spring.
    pub stopper: Option<Stopper>,
    /// Tendon behind both; without one the spring takes all of the elongation.
    pub tendon: Option<Tendon>,
    /// Force of the tendon before the column tilts, N.
    pub prestress_n: f64,
    /// Elongation that a loose nut lets pass, m.
    pub slack_m: f64,
    /// What happens once the springs are flat.
    pub when_flat: WhenFlat,
}

impl Parts {
    /// A spring of constant stiffness (N/m), tendon included, and nothing else.
    pub fn linear(stiffness_n_m: f64) -> Self {
        Self::from_spring(Spring::Linear { stiffness_n_m })
    }

    /// A stack of disc springs in series with a tendon of stiffness `EA/L` (N/m).
    pub fn discs(stack: DiscStack, tendon_stiffness_n_m: f64) -> Self {
        let tendon = Tendon { stiffness_n_m: tendon_stiffness_n_m, yield_n: None, failure_n: None };
        Self { tendon: Some(tendon), ..Self::from_spring(Spring::Discs(stack)) }
    }

    /// A spring and nothing else.
    pub fn from_spring(spring: Spring) -> Self {
        Self { spring, stopper: None, tendon: None, prestress_n: 0.0, slack_m: 0.0, when_flat: WhenFlat::default() }
    }

    /// All that its force depends on, as numbers; −1 stands for what is not there.
    pub fn identity(&self) -> Vec<f64> {
        let mut numbers = match self.spring {
            Spring::Rigid => vec![0.0],
            Spring::Linear { stiffness_n_m } => vec![1.0, stiffness_n_m],
            Spring::Discs(stack) => {
                let [c1, c2, c3] = stack.law().coefficients();
                vec![2.0, stack.flat_deformation_m(), c1, c2, c3]
            }
        };
        let stopper = self.stopper.map(|of| [of.gap_m, of.stiffness_n_m, of.yield_n.unwrap_or(-1.0)]);
        numbers.extend(stopper.unwrap_or([-1.0; 3]));
        numbers.push(self.tendon.map_or(-1.0, |tendon| tendon.stiffness_n_m));
        numbers.extend([self.prestress_n, self.slack_m]);
        numbers.push(match self.when_flat {
            WhenFlat::Tendon => 0.0,
            WhenFlat::Stop => 1.0,
        });
        numbers
    }
}
