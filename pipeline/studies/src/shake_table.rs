//! Studies of a shaking table: which tests a frame would go through, and what it would do (Sections 6.4 and 6.8).

mod csv;
mod excitations;
mod inputs;
mod plan;
mod report;
mod run;
mod spectra;
mod tests_of_table;
mod write;

pub use csv::{COLUMN as TESTS_COLUMN, columns, csv_tables, tables};
pub use inputs::Inputs;
pub use plan::{Plan, plan};
pub use report::RunReport;
pub use run::{is_of_inputs, run};
pub use tests_of_table::carry_out;
pub use uplift_result::{Excitation, ShakeTable, TableLevel, TableSpectra, TableTest};
pub use write::ShakeTableOutcome;
pub(crate) use write::write_shake_table;
