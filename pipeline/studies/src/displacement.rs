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

pub use csv::tables;
pub use csv::{displacement_csv_paths, write_displacement_csv};
pub use design_example::carry_out_designs;
pub use design_example::{Designs, Doubted, design_analyses, strength};
pub use plan::Plan;
pub use plan::{needs, plan};
pub use report::{RunReport, SetReport, SpectraReport};
pub use rounding::printed;
pub use run::run;
pub use spectra::{set_spectra, structures};
pub use uplift_result::{DesignRow, RULES};
pub use work::{Inputs, KeyedMotions, run_shard};
pub use write::{DisplacementOutcome, write_displacements};
