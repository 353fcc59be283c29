//! The result of a study: one HDF5 file, and tidy tables beside it; how both are opened, extended and read.

mod displacements;
mod extend;
mod hazard;
mod layout;
mod lock;
mod provenance;
mod read;
mod stored;
mod study_of;
mod table;
mod target;

pub use displacements::{SpectrumPlace, StoredDisplacements, StoredMotions, StoredSet, StoredStructures};
pub(crate) use extend::{extend_result, line, sign};
pub(crate) use hazard::branch_group;
pub use hazard::{axis_part, unique_axis};
pub use layout::{LAYOUT, level_axis};
pub use lock::ResultLock;
pub(crate) use provenance::Origin;
pub use provenance::Provenance;
pub use read::{Fit, Spectrum, StoredResult, holds_displacement_spectra, open_any_result, open_result};
pub use stored::{StoredMeasure, StoredStripes};
pub use study_of::{SpectraOfResult, StudyOfResult};
pub use table::{write_aside, write_table};
pub use target::{check_target, is_hdf5};
