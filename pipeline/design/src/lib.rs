//! A structure under the records and the hazard of a result: its design by the spectrum, its own risk, its overturning,
//! and what it must be for a target risk.

mod certainty;
mod collapse;
mod demand;
mod design;
mod error;
mod finding;
mod frame_risk;
mod hazard;
mod limit;
mod limits;
mod lognormal;
mod models;
mod opening;
mod overturning;
mod own_structure;
mod pairs;
mod report;
mod risk;
mod risk_columns;
mod rules;
mod sensitivity;
mod shaken;
mod spectrum;
mod sweep;
mod tables;
mod target;
mod uncertain;

pub use certainty::{Bands, DemandBands};
pub use demand::ExactDemand;
pub use design::{DesignOptions, DesignReport, design, design_shard};
pub use error::DesignError;
pub use finding::keep;
pub use frame_risk::{
    Banded, DirectionEffect, EventReport, FrameOverturning, FrameRiskOptions, FrameRiskReport, ModelDemand, RiskPoint,
    StateAtDemand, frame_model, frame_risk, frame_risk_shard,
};
pub use limit::{FrameLimit, LimitEvent, LimitRisk};
pub use limits::{CAPACITY_SHARE, LimitOptions, LimitState, LimitStripes, independent_records, limit_stripes};
pub use overturning::{
    CollapseReport, ModelReport, OverturningOptions, OverturningReport, SiteRisk, overturning, overturning_shard,
};
pub use own_structure::{OwnModel, OwnReport};
pub use report::{ReportSource, StructureReport};
pub use rules::{MeasureVerdict, OwnCheck, RuleCheck, RuleOutcome, verdict_word};
pub use sensitivity::{DemandNoise, DemandRounding, RuleRanges, Sensitivity};
pub use spectrum::SpectrumDemand;
pub use target::{
    Crossing, Exceeded, FoundSystem, GenericTarget, LevelShare, TargetBand, TargetByMeasure, TargetEvent, TargetModel,
    TargetOptions, TargetOwn, TargetReport, TargetUncertainty, TriedOwn, TriedValue, target,
};
pub use uncertain::{
    AleatoryResult, EpistemicResult, QuantityReport, Spread, UncertainFinding, UncertainResult, UncertaintyReport,
    VarianceShare,
};
pub use uplift_ida::{OSCILLATOR, PLANAR_FRAME, WOBBLING_FRAME};
