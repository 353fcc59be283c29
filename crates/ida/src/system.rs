//! What is shaken.

use std::fmt;

use uplift_block::RockingBlock;
use uplift_oscillator::{Oscillator, PostUplift};

/// A system of any kind.
///
/// Another kind (a frame whose equations are integrated in time, say, at a thousand times the cost of an oscillator) is
/// a variant here, with its numbers in [`identity`](Self::identity), its peak at one scale factor beside the block's in
/// [`analysis`](crate::analysis), and `false` from [`is_swept`](Self::is_swept).
#[derive(Debug, Clone, PartialEq)]
pub enum System {
    /// An uplifting oscillator (Eq. 3.1–3.3).
    Oscillator(Oscillator),
    /// A rigid rocking block (Eq. 2.1–2.3) with its full nonlinear motion; its displacement is that of its top (Eq.
    /// 2.10).
    Block(RockingBlock),
}

impl System {
    /// Its kind, a word for tables.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Oscillator(_) => "oscillator",
            Self::Block(_) => "block",
        }
    }

    /// Whether it can overturn, so that an infinite displacement is an answer.
    pub fn can_overturn(&self) -> bool {
        match self {
            Self::Oscillator(oscillator) => matches!(oscillator.post_uplift(), PostUplift::Negative { .. }),
            Self::Block(_) => true,
        }
    }

    /// Velocity after over before an impact.
    pub fn restitution(&self) -> f64 {
        match self {
            Self::Oscillator(oscillator) => oscillator.restitution(),
            Self::Block(block) => block.restitution(),
        }
    }

    /// Whether all scale factors of a motion are followed together, at a fraction of their cost one by one. What is not
    /// swept may be stopped between any two scale factors, and shares them out among the threads.
    pub fn is_swept(&self) -> bool {
        match self {
            Self::Oscillator(_) => true,
            Self::Block(_) => false,
        }
    }

    /// All that its motion depends on but the ground's: a number for the kind, then the parameters. Systems of the same
    /// identity have the same peaks, to the bit.
    pub fn identity(&self) -> Vec<f64> {
        match self {
            Self::Oscillator(oscillator) => {
                let (slope, parameter) = match oscillator.post_uplift() {
                    PostUplift::Zero => (0.0, 0.0),
                    PostUplift::Negative { capacity_m } => (1.0, capacity_m),
                    PostUplift::Positive { stiffness_per_s2 } => (2.0, stiffness_per_s2),
                };
                vec![
                    0.0,
                    oscillator.strength(),
                    oscillator.uplift_acceleration_m_s2(),
                    oscillator.uplift_displacement_m(),
                    oscillator.restitution(),
                    slope,
                    parameter,
                ]
            }
            Self::Block(block) => {
                vec![1.0, block.size_m(), block.slenderness_rad(), block.restitution(), block.gravity_m_s2()]
            }
        }
    }
}

impl fmt::Display for System {
    /// Its kind and what sets it apart, for messages.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Oscillator(oscillator) => write!(
                formatter,
                "oscillator of strength {}, uplift at {} m",
                oscillator.strength(),
                oscillator.uplift_displacement_m()
            ),
            Self::Block(block) => {
                write!(formatter, "block of size {} m, slenderness {} rad", block.size_m(), block.slenderness_rad())
            }
        }
    }
}
