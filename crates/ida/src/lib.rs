//! Incremental dynamic analysis: every motion, multiplied by each of its scale factors, through every system (Section
//! 4.3.3 of Reggiani Manzo's dissertation; with factors of another origin, Sections 2.4 and 3.4).
//!
//! | module | what is in it |
//! |---|---|
//! | [`system`] | what is shaken: an oscillator, a rigid block, a frame |
//! | [`plan`] | motions with their scale factors, and systems, checked |
//! | [`analysis`] | the plan carried out on all cores |
//! | [`cells`] | what is known of the result already, and rows as they are finished |
//! | [`shard`] | the parts that several machines share |
//! | [`peaks`] | the result: peak displacements and impacts over motions, systems and scales |
//! | [`estimate`](mod@estimate) | how long a plan will take here |
//! | [`watch`] | progress and cancellation |
//!
//! A number depends on its own motion, system and scale factor alone: the bits are the same for any number of threads,
//! any division into shards, and whatever was known before.

pub mod analysis;
pub mod cells;
mod error;
pub mod estimate;
pub mod peaks;
pub mod plan;
pub mod shard;
pub mod system;
pub mod watch;

pub use analysis::{analyse, complete};
pub use cells::{AnalysisRow, Cells, NUMERICS};
pub use error::IdaError;
pub use estimate::{Estimate, estimate};
pub use peaks::{Axes, Peaks};
pub use plan::{Plan, ScaledMotion, StripeRecord};
pub use shard::Shard;
pub use system::{OSCILLATOR, PLANAR_FRAME, ShakenFrame, System, WOBBLING_FRAME};
pub use watch::{Unwatched, Watch};
