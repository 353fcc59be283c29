//! Displacement spectra of record sets: what a set of ground motions asks of rocking structures, without any hazard.
//!
//! Chapters 2 and 3 of Reggiani Manzo's dissertation take every horizontal component of a record set as an independent
//! motion, scale all of them in one way, and draw a percentile of the peak displacements against the slenderness of a
//! block or the strength of an oscillator.
//!
//! | module | what is in it |
//! |---|---|
//! | [`motion_set`] | the components of a set, with the peaks that scaling refers to (Eq. 2.16, 2.17) |
//! | [`scaling`] | unscaled, or to a multiple of the set's median PGA or PGV, by component or by record |
//! | [`demand`] | what a set scaled in one way asks of systems |
//! | [`statistics`] | percentiles, and where a line of a figure begins |
//! | [`noise`] | how much a value moves in a small sweep around its point |
//! | [`restrained`] | the design example of Section 3.4.5: both rules beside the time histories (Tables 3.2–3.7) |
//! | [`solitary`] | the design example of Section 2.4.3: the size-independent spectrum (Tables 2.1–2.3) |
//!
//! The systems are shaken by [`uplift_ida`]: [`MotionSet::plan`] says by what.
//!
//! A displacement of a system that overturns is `+∞`, in percentiles too. Units are SI unless a name says otherwise.

pub mod demand;
mod error;
pub mod motion_set;
pub mod noise;
pub mod restrained;
pub mod scaling;
pub mod solitary;
pub mod statistics;

pub use demand::{CarryOut, Case};
pub use error::SpectraError;
pub use motion_set::{Motion, MotionSet, RecordOfSet};
pub use noise::{NUDGES, NoiseSweep, Noisy, ROUNDING, nudges};
pub use restrained::{RestrainedDesign, RestrainedExample};
pub use scaling::{ScaledBy, Scaling};
pub use solitary::{SolitaryDesign, SolitaryExample};
pub use statistics::{critical, percentile};
