//! Studies of uniform risk: stripes, spectra and their coefficients, for sites with hazard curves.

mod computed;
mod csv;
mod earlier;
mod levels;
mod plan;
mod report;
mod run;
pub mod site_table;
mod work;
mod write;
mod write_hazard;

pub use computed::ComputedStudy;
pub use csv::{band_columns, csv_tables, quoted_bands_m, spectra_table, tables};
pub use earlier::{EarlierStripes, is_of_records};
pub use levels::{LevelCheck, LevelProposal};
pub use plan::{Plan, needs, plan};
pub use report::{BranchReport, CoefficientsReport, MeasureReport, RunReport};
pub use run::run;
pub use work::{Inputs, run_shard};
pub(crate) use write::write_result;
