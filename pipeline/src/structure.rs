//! A structure under the records and the hazard of a result: its design by the spectrum, its own risk, its overturning.

mod design;
mod overturning;
mod risk;

pub use design::{
    DemandNoise, ExactDemand, OSCILLATORS, RuleOutcome, SpectrumReading, check_rules, exact_demand, read_spectrum,
};
pub use overturning::{Collapse, Model, collapse};
pub use risk::{EventRisk, OVERTURNING_M, demand_of, risk_of_exceeding, stripes_of};
