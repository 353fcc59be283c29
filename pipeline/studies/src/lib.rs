//! The kinds of study, each from its plan to its result file, with the same files in its folder.

pub mod displacement;
mod error;
pub mod shake_table;
pub mod uniform_risk;

pub use error::StudiesError;
