//! Which intensity measure to trust: efficiency and sufficiency.

mod factors_to_reach;
mod job;
mod measure_efficiency;
mod report;
mod restated;
mod write;

pub use job::{EfficiencyOptions, efficiency};
pub use measure_efficiency::{Covariate, MeasureEfficiency, covariates, efficiency_by};
pub use report::{EfficiencyReport, EfficiencyRow, Miss, Trend};
