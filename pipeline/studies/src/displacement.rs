//! Studies of displacement spectra: what record sets ask of rocking structures, without any hazard.

mod csv;
mod design_example;
mod design_rows;
mod plan;
mod report;
mod rounding;
mod run;
mod spectra;
mod work;
mod write;

pub use csv::{displacement_csv_paths, tables, write_displacement_csv};
pub use design_example::{Designs, Doubted, carry_out_designs, design_analyses, strength};
pub use plan::{Plan, needs, plan};
pub use report::{RunReport, SetReport, SpectraReport};
pub use rounding::printed;
pub use run::{is_of_records, run};
pub use spectra::{set_spectra, structures};
pub use uplift_result::{DesignRow, RULES};
pub use work::{Inputs, KeyedMotions, run_shard};
pub use write::{DisplacementOutcome, write_displacements};
