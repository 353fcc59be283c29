//! Statics of rocking columns held by tendons, disc springs and stoppers.
//!
//! Equations, tables and figures are those of Reggiani Manzo's dissertation, Chapters 5 and 6; what was found wrong in
//! them stands in `docs/errata.md`.
//!
//! | module | what is in it |
//! |---|---|
//! | [`disc`] | a disc spring, with and without contact flats (Almen and Laszlo; DIN 2093) |
//! | [`stack`] | discs in series and in parallel |
//! | [`parts`] | spring, stopper, tendon |
//! | [`restrainer`] | their force over the elongation: smooth pieces with thresholds known beforehand, and the energy |
//! | [`path`] | how far a tendon is stretched: at the column, in the foundation, shifted in its duct (Eq. A2.6, A2.7) |
//! | [`tilt`] | travel and rise of the deck over the rotation |
//! | [`columns`] | force, sections and energy of columns under a deck (Eq. 5.1, 5.5–5.7, A2.5) |
//! | [`capacity`] | neutral equilibrium |
//! | [`events`] | uplift, touch, stopper, yield, flat springs, and where |
//! | [`linear`] | the linearised law (Eq. 5.2–5.7, 6.1, 6.2) |
//! | [`protocol`] | cyclic loading (Fig. 5.11), and the columns under it |
//! | [`hysteresis`] | measured loops: energy, equivalent damping, slope |
//! | [`selection`] | stacks out of a catalogue for a target; stoppers |
//! | [`tolerance`] | what slack, duct, softer springs and the loss of a tendon do to the capacity |
//! | [`description`] | a restrainer as written in a file |
//!
//! ```
//! use uplift_statics::{Parts, Restrainer, RestrainedColumns, TendonPath};
//! use uplift_structure::Geometry;
//! // column J of Chapter 5 with the stiffness that it was designed for: twice the free column's capacity
//! let column = Geometry::from_width_and_height(0.2578, 1.45)?;
//! let free = RestrainedColumns::new(column, 1, 52.2e3, 1.89e3)?;
//! assert!((free.capacity().unwrap().displacement_m - 0.2578).abs() < 1e-12);
//! let held = free.with_restrainer(Restrainer::new(Parts::linear(2302e3))?, TendonPath::Column)?;
//! assert!((held.capacity().unwrap().displacement_m / (2.0 * 0.2578) - 1.0).abs() < 0.04);
//! # Ok::<(), uplift_statics::StaticsError>(())
//! ```

pub mod capacity;
pub mod columns;
mod cubic;
pub mod description;
pub mod disc;
mod error;
pub mod events;
pub mod hysteresis;
pub mod linear;
pub mod parts;
pub mod path;
pub mod protocol;
pub mod restrainer;
mod root;
pub mod selection;
pub mod stack;
pub mod tilt;
pub mod tolerance;

pub use capacity::Capacity;
pub use columns::{PushoverState, RestrainedColumns, Sections};
pub use cubic::Cubic;
pub use description::{RestrainerDescription, RestrainerKind, StopperDescription, TendonAnchorage};
pub use disc::{DiscDimensions, DiscSpring, SPRING_STEEL_YOUNG_MODULUS_PA, STEEL_POISSON};
pub use error::StaticsError;
pub use events::{Event, EventKind};
pub use hysteresis::{LoopCycle, MeasuredLoop};
pub use linear::{LinearLaw, LinearState};
pub use parts::{Parts, Spring, Stopper, Tendon, WhenFlat};
pub use path::{Elongation, TendonPath};
pub use protocol::{CyclicState, LoadingProtocol, ProtocolPoint};
pub use restrainer::{Piece, PieceLaw, Restrainer, RestrainerState, Threshold};
pub use selection::{Candidate, CatalogueDisc, Limits, Ranking, Target};
pub use stack::DiscStack;
pub use tolerance::{Imperfections, Tolerance};
