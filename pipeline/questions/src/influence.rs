//! Which records carry the spectra, and which intensities.

mod change;
mod job;
mod report;
mod write;

pub use change::{CHANGES, Change, RecordInfluence, level_of_share, rank_records};
pub use job::{InfluenceOptions, influence};
pub use report::{InfluenceReport, IntensityShares, RecordChange};
