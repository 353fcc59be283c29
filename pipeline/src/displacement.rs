//! Studies of displacement spectra: what record sets ask of rocking structures, without any hazard.

mod csv;
mod design_example;
mod design_rows;
mod plan;
mod report;
mod run;
mod spectra;
mod write;

pub use crate::result::{DesignRow, RULES};
pub use csv::{displacement_csv_paths, write_displacement_csv};
pub use design_example::{Designs, design_analyses, design_examples, strength};
pub use plan::Plan;
pub(crate) use plan::plan;
pub use report::{RunReport, SetReport, SpectraReport};
pub(crate) use run::run;
pub use spectra::{SetSpectra, analyses, set_spectra, shake, structures};
pub use write::{DisplacementOutcome, write_displacements};
