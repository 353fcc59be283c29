//! A result beside a reference, and for other programs.

mod error;
pub mod export;
pub mod fragility;
pub mod table;

pub use error::ExportsError;
