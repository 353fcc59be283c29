//! How sure the spectra are: confidence bands from resampled records (Section 4.5, Table 4.1).

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
mod resampled;
mod source;
mod write;

pub use checkpoint::{Interrupted, interrupted, part_path};
pub use job::bootstrap;
pub use options::BootstrapOptions;
pub use report::{BootstrapReport, BootstrapRow, Initiation, ReferenceRow, RepairedFigures, read_reference};
pub use resampled::{resampled, resampling_plan};
pub use uplift_uniform_risk::MANY_FAILED;
