//! Studies of displacement spectra: what record sets ask of rocking structures, without any hazard.

mod csv;
mod design_example;
mod design_rows;
mod inputs;
mod plan;
mod report;
mod rounding;
mod run;
mod spectra;
mod work;
mod write;

pub use csv::{csv_tables, tables};
pub(crate) use design_example::carry_out_designs;
pub use design_example::{Designs, Doubted, design_analyses, strength};
pub use inputs::{Inputs, KeyedMotions};
pub use plan::{Plan, needs, plan};
pub use report::{RunReport, SetReport, SpectraReport};
pub use rounding::printed;
pub use run::{is_of_records, run};
pub(crate) use spectra::set_spectra;
pub use spectra::structures;
pub use uplift_result::{DesignRow, RULES};
pub use work::run_shard;
pub use write::DisplacementOutcome;
pub(crate) use write::write_displacements;
