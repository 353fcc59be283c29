//! The restrained rocking frame of Chapter 6 of Reggiani Manzo's dissertation: planar, and wobbling in space.
//!
//! | module | what is in it |
//! |---|---|
//! | [`frame`] | columns, deck, restrainers, inertia, energy |
//! | [`ground`] | what shakes it: up to three components, records or pulses |
//! | [`pulse`] | sine, cosine, half sine and Ricker pulses |
//! | [`response`] | peaks, events, survival; the motion in time |
//! | [`rolling`] | what a wobbling frame loses |
//! | [`history`] | rows of a motion in time |
//! | [`sections`] | forces on the ends of a column at such a row |
//! | [`shake_table`] | records in the scale of a model, at a level of PGV (Section 6.4) |
//!
//! # What is computed
//! In a plane Eq. 6.3 as it stands with any restrainer of `uplift-statics`, an impact at `θ = 0` (Eq. 6.5); in space
//! Eq. 6.6 and 6.7 as corrected (`docs/errata.md`), in `θ`, `φ`, `ω` and the momentum `L = J φ̇`. Gravity carries the
//! vertical shaking, `g + ẅ_g`. Columns neither slide nor twist, and the deck does not turn about the vertical: torsion
//! is outside the model.
//!
//! The upright position is the apex of a cone, not a point: passing close by it, `φ` turns by `π/κ`, `κ = √(c/M) < 1`,
//! to the side that the sign of `L` says. Below 1e-10 rad that passage is a straight line in the developed cone,
//! exactly; above it the steps of the series shrink with the distance. Shaking along one line from rest stays in its
//! plane, and is computed so. The wobbling model of the dissertation loses nothing; with a restitution below 1 it loses
//! by [`rolling`]. A frame whose energy falls below that of `rest_amplitude_rad` while the ground does not lift it is
//! taken to rest.
//!
//! # How
//! By Taylor series, as `uplift-block` does and for its reasons: accuracy to rounding for the price of a dozen products
//! of short series, its own dense output, and every peak, impact and threshold a root of it that cannot be missed. What
//! is not analytic, slack, touch, stoppers, yield and flat springs, happens at rotations known beforehand, where a step
//! ends ([`frame`] and the restrainer's pieces).
//!
//! After the record energy and momentum are constants: whether the frame survives is one root, not an integration. A
//! frame that loses energy by rolling is followed to its next peak.
//!
//! ```
//! use uplift_frame::{ColumnShape, GroundMotion, Model, Options, Pulse, PulseShape, RockingFrame, Shaking, respond};
//! use uplift_statics::{Parts, Restrainer, TendonPath};
//! use uplift_structure::Geometry;
//! // the frame of the shaking table with the stiffness of its restrainers, under two pulses
//! let column = Geometry::from_width_and_height(0.197, 1.45)?;
//! let frame = RockingFrame::new(column, 4, 124.4, 9435.0, ColumnShape::Cylinder, 9.81)?
//!     .with_restrainer(Restrainer::new(Parts::linear(1720e3))?, TendonPath::Column)?;
//! let pulse = |shape, amplitude, period, start| Pulse::new(shape, amplitude, period, start).map(Shaking::Pulse);
//! let ground = GroundMotion {
//!     x: Some(pulse(PulseShape::Sine, 2.6, 0.55, 0.1)?),
//!     y: Some(pulse(PulseShape::Cosine, 1.6, 0.7, 0.25)?),
//!     z: None,
//! };
//! let response = respond(&frame, &ground, Model::Wobbling, &Options::default())?;
//! assert!(!response.overturned && response.displacement.value > 0.17);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod branch;
mod course;
mod error;
mod escape;
pub mod frame;
pub mod ground;
pub mod history;
mod motion;
pub mod peaks;
pub mod pulse;
pub mod response;
pub mod rolling;
pub mod sections;
mod series;
pub mod shake_table;
mod side_by_side;
mod uplift;

/// Version of the frame's numbers: raised whenever a change of its arithmetic changes any of them, so that unfinished
/// work of an earlier version is not gone on with.
pub const NUMERICS: u32 = 2;

pub use error::FrameError;
pub use frame::{ColumnShape, RockingFrame};
pub use ground::{GroundMotion, Shaking};
pub use history::{History, HistoryRow, Moment};
pub use peaks::Peak;
pub use pulse::{Pulse, PulseShape};
pub use response::{
    FrameDemand, FrameEvent, FrameResponse, FrameState, Model, Options, Start, Until, respond, respond_with_history,
};
pub use shake_table::{TableLevel, srss};
pub use side_by_side::demands;
