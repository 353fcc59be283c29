//! What needs no study: one record through one system, pulses, a column pushed, its restrainer, tests and a model.

mod error;
pub mod pulses;
pub mod pushover;
pub mod response;
pub mod restrainer;
pub mod validate;

pub use error::LaboratoryError;
