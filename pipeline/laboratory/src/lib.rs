//! What needs no study: one record through one system, pulses, a library of rocking response, a column pushed, its
//! restrainer, tests and a model.

mod error;
pub mod library;
pub mod pulses;
pub mod pushover;
pub mod response;
pub mod restrainer;
pub mod validate;

pub use error::LaboratoryError;
