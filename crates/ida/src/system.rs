//! What is shaken.

use std::fmt;

use uplift_block::RockingBlock;
use uplift_frame::{Model, RockingFrame};
use uplift_oscillator::{Oscillator, PostUplift};

/// A system of any kind.
///
/// Another kind is a variant here, with its numbers in [`identity`](Self::identity), its peak at one scale factor
/// beside the block's in [`analysis`](crate::analysis), and `false` from [`is_swept`](Self::is_swept) where not all are
/// followed together.
#[derive(Debug, Clone, PartialEq)]
pub enum System {
    /// An uplifting oscillator (Eq. 3.1–3.3).
    Oscillator(Oscillator),
    /// A rigid rocking block (Eq. 2.1–2.3) with its full nonlinear motion; its displacement is that of its top (Eq.
    /// 2.10).
    Block(RockingBlock),
    /// A restrained rocking frame (Eq. 6.3 to 6.7); its displacement is the travel of its deck.
    Frame(Box<ShakenFrame>),
}

/// A frame, and how it is modelled.
#[derive(Debug, Clone, PartialEq)]
pub struct ShakenFrame {
    /// The frame.
    pub frame: RockingFrame,
    /// In the plane of the motion's component, or wobbling under both components ([`Plan::across`]).
    ///
    /// [`Plan::across`]: crate::Plan::across
    pub model: Model,
    /// Velocity after over before an impact.
    pub restitution: f64,
    /// Tilt whose energy is that of a frame at rest, rad; if none, that of the model
    /// ([`Options::rest_amplitude_rad`](uplift_frame::Options::rest_amplitude_rad)).
    pub rest_amplitude_rad: Option<f64>,
}

/// The kind of an oscillator, in tables.
pub const OSCILLATOR: &str = "oscillator";
/// The kind of a frame that wobbles under both components, in tables.
pub const WOBBLING_FRAME: &str = "wobbling frame";
/// The kind of a frame that rocks in a plane, in tables.
pub const PLANAR_FRAME: &str = "planar frame";

impl System {
    /// Its kind, a word for tables.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Oscillator(_) => OSCILLATOR,
            Self::Block(_) => "block",
            Self::Frame(shaken) => match shaken.model {
                Model::Planar => PLANAR_FRAME,
                Model::Wobbling => WOBBLING_FRAME,
            },
        }
    }

    /// Whether it can overturn, so that an infinite displacement is an answer.
    pub fn can_overturn(&self) -> bool {
        match self {
            Self::Oscillator(oscillator) => matches!(oscillator.post_uplift(), PostUplift::Negative { .. }),
            Self::Block(_) | Self::Frame(_) => true,
        }
    }

    /// Velocity after over before an impact.
    pub fn restitution(&self) -> f64 {
        match self {
            Self::Oscillator(oscillator) => oscillator.restitution(),
            Self::Block(block) => block.restitution(),
            Self::Frame(shaken) => shaken.restitution,
        }
    }

    /// Whether all scale factors of a motion are followed together, at a fraction of their cost one by one. Those of
    /// what is not swept are shared out among the threads, some at a time.
    pub fn is_swept(&self) -> bool {
        match self {
            Self::Oscillator(_) => true,
            Self::Block(_) | Self::Frame(_) => false,
        }
    }

    /// Acceleration of gravity on what a vertical motion shakes, m/s²; none of an oscillator, which feels none.
    pub fn gravity_m_s2(&self) -> Option<f64> {
        match self {
            Self::Oscillator(_) => None,
            Self::Block(block) => Some(block.gravity_m_s2()),
            Self::Frame(shaken) => Some(shaken.frame.gravity_m_s2()),
        }
    }

    /// All that its motion depends on but the ground's: a number for the kind, then the parameters. Systems of the same
    /// identity have the same peaks, to the bit.
    pub fn identity(&self) -> Vec<f64> {
        match self {
            Self::Oscillator(oscillator) => {
                let (slope, parameter) = oscillator.post_uplift().identity();
                vec![
                    0.0,
                    oscillator.strength(),
                    oscillator.uplift_acceleration_m_s2(),
                    oscillator.uplift_displacement_m(),
                    oscillator.restitution(),
                    f64::from(slope),
                    parameter,
                ]
            }
            Self::Block(block) => {
                let [size_m, slenderness_rad] = [block.size_m(), block.slenderness_rad()];
                // where the ground moves upwards the frame's solver follows it
                let versions = [uplift_block::NUMERICS, uplift_frame::NUMERICS].map(f64::from);
                vec![1.0, size_m, slenderness_rad, block.restitution(), block.gravity_m_s2(), versions[0], versions[1]]
            }
            Self::Frame(shaken) => {
                let model = match shaken.model {
                    Model::Planar => 0.0,
                    Model::Wobbling => 1.0,
                };
                let mut numbers = vec![2.0, model, shaken.restitution, f64::from(uplift_frame::NUMERICS)];
                numbers.extend(shaken.frame.identity());
                numbers.extend(shaken.rest_amplitude_rad);
                numbers
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
            Self::Frame(shaken) => {
                let column = shaken.frame.geometry();
                let (count, size_m) = (shaken.frame.columns().columns(), column.size_m());
                let slenderness = column.slenderness_rad();
                write!(
                    formatter,
                    "{} of {count} columns of size {size_m} m, slenderness {slenderness} rad",
                    self.kind()
                )
            }
        }
    }
}
