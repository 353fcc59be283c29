//! Uniform risk spectra for rocking structures: studies run from the first record to the result file.
//!
//! | module | what is in it |
//! |---|---|
//! | [`events`] | what a job tells while it works, and how it is stopped |
//! | [`inputs`] | records and hazard curves, read and checked before anything is computed |
//! | [`import`] | record files found in a folder, paired, measured and listed in a manifest |
//! | [`shard`] | a study shared among machines |
//! | [`uniform_risk`] | studies of uniform risk: stripes, spectra, coefficients |
//! | [`displacement`] | studies of displacement spectra of record sets |
//! | [`bootstrap`], [`influence`], [`efficiency`] | how sure a spectrum is, and what carries it |
//! | [`structure`] | a structure under the records and hazard of a result |
//! | [`analysis`] | plans carried out with a checkpoint, whole or in shards |
//! | [`checkpoint`] | finished rows of the analysis by their keys: what outlives a stopped run |
//! | [`result`](mod@result) | the HDF5 file and the tables beside it, written and read |
//! | [`status`](mod@status), [`verify`](mod@verify) | how far a run is, and whether a result is as it was written |
//! | [`table`](mod@table), [`export`](mod@export) | a result beside a reference, and for other programs |
//! | [`records`], [`hazard_curves`] | record sets and hazard curves looked at, chosen from, made and imported |
//! | [`response`](mod@response) | one record through one oscillator |
//! | [`pulses`] | rocking spectra under wavelets, which need no study |
//! | [`reference`](mod@reference) | tables of papers to compare with |
//! | [`outputs`] | files that a job is asked to write: what may give way to them |
//! | [`text`] | numbers in words |
//!
//! The science is in the crates below this one, the command line and the report in those above it. Nothing here prints,
//! reads arguments or handles signals.

pub mod analysis;
mod array;
pub mod bootstrap;
pub mod checkpoint;
mod checksum;
pub mod displacement;
pub mod efficiency;
mod error;
pub mod events;
pub mod export;
pub mod hazard_curves;
pub mod import;
pub mod influence;
pub mod inputs;
pub mod outputs;
pub mod plan;
pub mod pulses;
pub mod records;
pub mod response;
pub mod result;
pub mod run;
pub mod shard;
pub mod status;
pub mod structure;
pub mod table;
pub mod text;
pub mod uniform_risk;
pub mod verify;

pub use array::{Array, ShapeError};
pub use error::UpliftError;
pub use events::{Events, Phase, Silent};
pub use plan::{Plan, plan};
pub use run::{RunOptions, RunReport, run};
pub use shard::{check_inputs, merge, run_shard};
pub use uplift_study as study;

/// Version of the program, and the commit it was built from where that is known.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Commit the program was built from, or `unknown`.
pub const COMMIT: &str = env!("UPLIFT_COMMIT");

/// Version and commit in one.
pub const VERSION_AND_COMMIT: &str = concat!(env!("CARGO_PKG_VERSION"), " (", env!("UPLIFT_COMMIT"), ")");
