//! Incremental dynamic analysis: every record, scaled to every intensity level, through every oscillator (Section 4.3.3
//! of Reggiani Manzo's dissertation).
//!
//! | room | what is in it |
//! |---|---|
//! | [`plan`] | records, oscillators and levels, checked |
//! | [`analysis`] | the plan carried out on all cores |
//! | [`block`] | the same for rigid rocking blocks, with their full nonlinear motion |
//! | [`cells`] | what is known of that array already, and the parts that several machines share |
//! | [`edp`] | the array of engineering demand parameters it leaves |
//! | [`estimate`](mod@estimate) | how long a plan will take here |
//! | [`watch`] | progress and cancellation |

pub mod analysis;
pub mod block;
pub mod cells;
pub mod edp;
mod error;
pub mod estimate;
pub mod plan;
pub mod watch;

pub use analysis::{analyse, complete};
pub use block::{BlockPlan, analyse_blocks};
pub use cells::{Cells, NUMERICS, Part, Piece};
pub use edp::EdpArray;
pub use error::IdaError;
pub use estimate::{Estimate, estimate};
pub use plan::{Plan, StripeRecord};
pub use watch::{Unwatched, Watch};
