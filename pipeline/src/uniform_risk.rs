//! Studies of uniform risk: stripes, spectra and their coefficients, for sites with hazard curves.

mod coefficients;
mod csv;
mod earlier;
mod epistemic;
mod levels;
mod outcome;
mod plan;
mod precision;
mod report;
mod run;
pub mod site_table;
mod spectra;
mod stripes;
mod work;
mod write;
mod write_hazard;

pub(crate) use coefficients::fit_ordinates;
pub use coefficients::{Coefficients, fit_spectra};
pub(crate) use csv::tables;
pub use csv::{csv_paths, write_csv};
pub use earlier::EarlierStripes;
pub use epistemic::{BranchSpectra, FRACTILES};
pub use levels::{LevelCheck, LevelProposal};
pub use outcome::Outcome;
pub use plan::Plan;
pub(crate) use plan::{needs, plan};
pub use precision::Precision;
pub use report::{BranchReport, CoefficientsReport, MeasureReport, RunReport, SpectrumReport};
pub(crate) use run::run;
pub(crate) use spectra::{Reading, pooled_demand};
pub use spectra::{Spectra, uniform_risk_spectra};
pub use stripes::{Stripes, plan_stripes, systems};
pub(crate) use stripes::{plan_levels, plan_own_stripes, seen, shaken_upwards, stripes_of, systems_under};
pub(crate) use work::{Inputs, run_shard};
pub use write::write_result;
pub(crate) use write_hazard::{BRANCHES, write_branch_spectra};
