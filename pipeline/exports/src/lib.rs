//! A result beside a reference, and for other programs.

mod demand;
mod error;
pub mod export;
mod fragility;
mod options;
mod report;
pub mod table;

pub use error::ExportsError;
