//! A result beside a reference, and for other programs.

pub mod demand;
mod error;
pub mod export;
pub mod fragility;
pub mod table;

pub use error::ExportsError;
