//! A structure under the records and the hazard of a result: its design by the spectrum, its own risk, its overturning.

mod choice;
mod collapse;
mod demand;
mod design;
mod models;
mod overturning;
mod report;
mod risk;
mod rules;
mod spectrum;
mod sweep;
mod tables;

pub use demand::{DemandNoise, DemandRounding, ExactDemand, RuleErrors};
pub use design::{DesignOptions, DesignReport, design, design_shard};
pub use overturning::{
    CollapseReport, ModelReport, OverturningOptions, OverturningReport, SiteRisk, overturning, overturning_shard,
};
pub use report::StructureReport;
pub use risk::EventRisk;
pub use rules::{RuleCheck, RuleOutcome};
pub use spectrum::SpectrumDemand;

/// What is said of every number that synthetic records are behind.
const SYNTHETIC: &str = "the records are synthetic, and scatter less than real ones: not for design";
