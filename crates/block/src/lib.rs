//! The rigid rocking block of Chapter 2 of Reggiani Manzo's dissertation: its full nonlinear motion under records and
//! Ricker pulses, free rocking, and nondimensional rocking spectra.
//!
//! | module | what is in it |
//! |---|---|
//! | [`block`] | the block: size, slenderness, restitution |
//! | [`excitation`] | what shakes it: a record, or a pulse |
//! | [`ricker`] | the symmetric and antisymmetric Ricker wavelets |
//! | [`response`] | peak response, overturning, free rocking |
//! | `side_by_side` | peak responses to one record at many scale factors |
//! | [`observer`] | the motion in time |
//! | [`spectrum`] | rocking spectra on a grid |
//!
//! # What is computed
//! Between impacts Eq. 2.1 as it stands, with no small-angle simplification; at an impact θ̇ falls by r (Eq. 2.3), at
//! once; a block at rest uplifts when |üg| exceeds g tan α. A block that chatters rests when it is certain that it
//! will, not below a threshold. Records are linear between samples, pulses analytic.
//!
//! # How
//! By Taylor series of the motion itself, step by step: within a sample interval or a sixteenth of a pulse's period, no
//! longer than 0.5/p, and cut at uplift and impact. The coefficients follow from a recurrence (one sine and cosine a
//! step), to the order at which two terms are below 2⁻⁵³ of the largest: 5 to 10 for a record of dt = 0.01 s, up to 24.
//! The series is its own dense output. Impacts, uplifts and peaks are roots of it, isolated by Descartes' rule of signs
//! in Bernstein form, so that none is passed over between two steps, and solved to rounding.
//!
//! General integrators were considered. `ode_solvers` (0.6) can stop after a step, but locates no event.
//! `differential-equations` (0.7) and `diffsol` (0.18) do; they look for a change of sign between accepted steps,
//! which misses two crossings within one, and the records' corners and the impacts, several in a sample interval,
//! restart them all the time. For one equation with a recurrence as short as this a series is the smaller code, and
//! accurate to rounding.
//!
//! # Accuracy and cost
//! On the reference cases of the tests the peak rotation, its time, the peak displacement and the time of uplift
//! deviate by about 2e-15 at most, relatively; energy between impacts is constant to 1e-15. A rocking block takes about
//! 6 to 11 µs per second of record at dt = 0.01 s on one core, a quarter to a third of that where 32 scale factors are
//! followed [side by side](respond_at_scales), a block at rest next to nothing, a point of a pulse spectrum about 30
//! µs.
//!
//! The motion itself is sensitive: it amplifies roundings along with everything else, and close to a block that just
//! overturns there are blocks that do not.

pub mod block;
mod error;
pub mod excitation;
mod motion;
pub mod observer;
pub mod response;
mod rest;
pub mod ricker;
mod series;
mod side_by_side;
mod sine;
pub mod spectrum;

pub use block::{LYING_RAD, RockingBlock, housner_restitution};
pub use error::BlockError;
pub use excitation::Excitation;
pub use observer::{History, HistoryRow, Moment};
pub use response::{BlockResponse, FreeRocking, Overturning, respond, respond_with_history, rock_freely};
pub use ricker::{BETA_R, RickerPulse, RickerShape};
pub use side_by_side::respond_at_scales;
pub use spectrum::{PulseSpectrum, PulseSpectrumPlan, SizeMeasure, SpectrumPoint, pulse_spectrum};

/// Version of the block's numbers: raised whenever a change of its arithmetic changes any of them, so that unfinished
/// work of an earlier version is not gone on with.
pub const NUMERICS: u32 = 2;
