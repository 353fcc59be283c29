//! Analyses carried out: a plan, whole or as one of several shards, each finished row kept in a checkpoint.

pub mod analysis;
pub mod checkpoint;
mod error;

pub use error::EngineError;
