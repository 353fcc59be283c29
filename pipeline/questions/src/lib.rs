//! What is asked of a result after its run, each answer added to it.

pub mod bootstrap;
pub mod consistency;
pub mod efficiency;
mod error;
pub mod influence;

pub use error::QuestionsError;
