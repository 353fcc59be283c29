//! How sure the spectra are: confidence bands from resampled records (Section 4.5, Table 4.1).

mod asked;
mod bands;
mod checkpoint;
mod compute;
mod draws;
mod job;
mod joint;
mod options;
mod plain;
mod repaired;
mod report;
mod source;
mod write;

pub use asked::{resampled, resampling_plan};
pub use checkpoint::{finished_strengths, part_path};
pub use job::bootstrap;
pub use options::BootstrapOptions;
pub use report::{BootstrapReport, BootstrapRow, Initiation, ReferenceRow, RepairedFigures, read_reference};
pub use uplift_uniform_risk::MANY_FAILED;
