//! Which records carry the spectra, and which intensities.

mod change;
mod write;

pub use change::{Influence, influence, level_of_share};
pub use write::{RecordInfluence, influence_path, record_influence, write_influence};
