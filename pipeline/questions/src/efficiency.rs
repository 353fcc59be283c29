//! Which intensity measure to trust: efficiency and sufficiency.

mod factors_to_reach;
mod job;
mod of_measure;
mod report;
mod restated;
mod write;

pub use job::{EfficiencyOptions, efficiency};
pub use of_measure::{Covariate, MeasureEfficiency, covariates, efficiency_by};
pub use report::{EfficiencyReport, EfficiencyRow, Miss, Trend};
