//! Arguments that several commands take.

mod figures;
mod folder;
mod force;
mod keep;
mod model;
mod number;
mod probability;
mod result;
mod risk;
mod structure;
mod study;

pub(crate) use figures::FigureArguments;
pub(crate) use folder::require_folder;
pub(crate) use force::ForceArgument;
pub(crate) use keep::KeepArgument;
pub(crate) use model::model;
pub(crate) use number::number;
pub(crate) use probability::{number_or_per_cent, probability};
pub(crate) use result::ResultArguments;
pub(crate) use risk::{OneRiskArguments, RiskArguments};
pub(crate) use structure::StructureArguments;
pub(crate) use study::{StudyArguments, command_line, run_options, shard};
