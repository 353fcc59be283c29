//! Exact piecewise-linear oscillators that uplift: the zero-stiffness bilinear elastic system (ZSBE), the
//! negative-stiffness one (NSBE) and systems with a positive post-uplift stiffness.
//!
//! The equation of motion, normalised by the mass, is `ü + r(u) = −a_g(t)` (Eq. 3.1–3.3, 4.1–4.3 of Reggiani
//! Manzo's dissertation), from rest, with the ground acceleration `a_g` linear between its samples. Every branch of
//! `r` is linear, so inside a sample interval the motion is known in closed form and there is no time-step error.
//! The one nonlinearity is the event: uplift (free of loss) and impact, where the velocity is multiplied by the
//! coefficient of restitution.
//!
//! | module | what is in it |
//! |---|---|
//! | [`oscillator`] | parameters of a system, checked once |
//! | [`excitation`] | a ground acceleration history and its scale |
//! | [`stumpff`] | the four functions that solve every branch |
//! | [`branch`] | one linear branch and the motion on it |
//! | [`nodes`] | the instants between which a motion is monotone: the safe ground for finding events |
//! | [`reference`](mod@reference) | the readable solver: interval by interval, event by event |
//! | [`free_vibration`] | the first peak after the record, in closed form |
//! | [`response`] | what a run returns |
//! | [`sweep`] | one record at many scales |
//! | [`history`] | the full time history, on demand |
//! | [`problems`] | named problems with known answers, shared by docs, tests and benchmarks |
//!
//! Units are SI: metres, seconds, m/s². A displacement is relative to the ground.

mod ahead;
mod attached;
pub mod branch;
mod crossings;
mod elastic;
mod error;
mod events;
pub mod excitation;
pub mod free_vibration;
pub mod ground_motion;
pub mod history;
mod instructions;
pub mod nodes;
mod nonzero_stiffness;
pub mod oscillator;
mod particular;
pub mod problems;
pub mod reference;
pub mod response;
mod run;
mod side_by_side;
pub mod stumpff;
pub mod sweep;
mod uplifted;
mod zero_stiffness;

pub use error::OscillatorError;
pub use excitation::Excitation;
pub use ground_motion::GroundMotion;
pub use history::{Event, EventKind, History, Sample};
pub use oscillator::{Oscillator, PostUplift, STANDARD_GRAVITY_M_S2};
pub use reference::{respond, respond_with_history};
pub use response::{FreeVibration, Response};
pub use sweep::{Peak, Sweep};
