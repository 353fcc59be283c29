//! Uniform risk spectra for rocking structures: studies run from the first record to the result file.
//!
//! Every job is one call: what it works on, its options, and somebody to tell ([`Events`]; [`Silent`] for nobody) go
//! in, a plain report comes out, which serialises. Options are declared once, as `clap::Args`: a command line flattens
//! them. Nothing here prints or handles signals; a job that [`Events::cancelled`] stops keeps what is finished, and the
//! same call goes on from there.
//!
//! # In this order
//!
//! 1. [`load_study`] reads and checks a study file, all mistakes at once.
//! 2. [`plan()`] says what the study would cost, [`run()`] carries it out and leaves a result file.
//!    Several machines share it by [`run_shard`] and [`merge`].
//! 3. [`result::ResultFile`] opens that file, and returns what is in it as plain values with named axes.
//! 4. How sure it is: [`bootstrap::bootstrap`], [`influence::influence`], [`efficiency::efficiency`] ask the result,
//!    and add their arrays to it.
//! 5. From a spectrum to a structure: [`structure::design`], [`structure::overturning`] and [`structure::target`]; the
//!    risk of a frame itself: [`structure::frame_risk`]. [`structure::keep`] leaves the answers in the result.
//! 6. Pushed rather than shaken: [`pushover::pushover`], [`restrainer::curve`], [`restrainer::design`].
//! 7. Computed peaks beside measured ones: [`validate::validate`].
//! 8. For others: [`export::export`] here; figures and the page are made by the crate `uplift_report`.
//!
//! ```no_run
//! use std::path::Path;
//!
//! use uplift::bootstrap::{BootstrapOptions, bootstrap};
//! use uplift::result::ResultFile;
//! use uplift::{RunOptions, Silent, load_study, run};
//!
//! let file = Path::new("configs/quick.toml");
//! let study = load_study(file, &["risk.years=100".to_owned()])?;
//! let options = RunOptions { study_file: file.to_owned(), ..RunOptions::default() };
//! let report = run(&study, &options, &Silent)?;
//!
//! let result = &report.head().files[0];
//! bootstrap(result, &BootstrapOptions::default(), &Silent)?;
//! for spectrum in ResultFile::open(result)?.spectra()?.rows() {
//!     println!("{}, {} by {}: {:?} m", spectrum.site, spectrum.poe, spectrum.measure, spectrum.u_m);
//! }
//! # Ok::<(), uplift::UpliftError>(())
//! ```
//!
//! Whoever wants no files at all, with records, curves or a system of their own, starts from the science crates below:
//! `examples/urs.rs`, `examples/own_system.rs`.
//!
//! | module | what is in it |
//! |---|---|
//! | [`run`](mod@run), [`plan`](mod@plan), [`shard`] | a study of any kind carried out, planned, shared |
//! | [`init`](mod@init) | a small study to start from |
//! | [`study_run`], [`lock`](mod@lock) | what the kinds of study share; one run at a time for one result |
//! | [`events`] | what a job tells while it works, and how it is stopped |
//! | [`uniform_risk`] | studies of uniform risk: stripes, spectra, coefficients |
//! | [`mod@spectrum`] | displacements with confidence bands, read off a result at any strength and return period |
//! | [`displacement`] | studies of displacement spectra of record sets |
//! | [`mod@shake_table`] | studies of a shaking table: its tests, and what a frame does in them |
//! | [`bootstrap`], [`influence`], [`efficiency`] | how sure a spectrum is, and what carries it |
//! | [`mod@consistency`] | whether the records bring the hazard of the other measure, and weights by which they do |
//! | [`mod@sweep`] | variants of a study run and compared |
//! | [`structure`] | a structure under the records and hazard of a result |
//! | [`result`](mod@result) | the HDF5 file and the tables beside it, written and read |
//! | [`analysis`], [`checkpoint`] | plans carried out whole or in shards; their finished rows outlive a stop |
//! | [`inputs`] | records and hazard curves, read and checked before anything is computed |
//! | [`import`], [`records`], [`hazard_curves`] | record sets and hazard curves imported, shown, chosen from, made |
//! | [`machine`] | what a job needs of memory and disk, and what there is |
//! | [`status`], [`verify`] | how far a run is, and whether a result is as it was written |
//! | [`mod@alarms`] | what to know before the numbers of a result are used |
//! | [`table`](mod@table), [`export`] | a result compared with a reference; exported, as fragilities or demands too |
//! | [`response`], [`pulses`] | one record through one oscillator, block or frame; rocking spectra under wavelets |
//! | [`library`](mod@library) | response of blocks and oscillators over normalised intensities |
//! | [`pushover`](mod@pushover), [`restrainer`] | columns under a static force; restrainers, stacks of a catalogue |
//! | [`validate`](mod@validate) | whether computed peaks are distributed as measured ones |
//! | [`outputs`] | files that a job is asked to write, and what they may overwrite |
//! | [`text`], [`typed`] | numbers in words; numbers as they are typed |

mod error;
mod finished;
pub mod init;
pub mod plan;
mod result_of;
pub mod run;
pub mod shard;
pub mod spectrum;
pub mod status;
pub mod sweep;
pub mod verify;

pub use error::{UpliftError, root};
pub use plan::{Plan, plan};
pub use result_of::result_of;
pub use run::{RunOptions, RunReport, run};
pub use shard::{check_inputs, merge, run_shard};
pub use uplift_engine::{analysis, checkpoint};
pub use uplift_exports::{export, table};
pub use uplift_inputs::{self as inputs, hazard_curves, import, load_study, load_uniform_risk, records};
pub use uplift_job::events::{Events, Phase, Silent};
pub use uplift_job::{
    Array, COMMIT, JobError, ShapeError, VERSION, VERSION_AND_COMMIT, cause, events, lock, machine, outputs, study_run,
    text, typed,
};
pub use uplift_laboratory::{library, pulses, pushover, response, restrainer, validate};
pub use uplift_questions::{bootstrap, efficiency, influence};
pub use uplift_studies::{displacement, shake_table};
pub use uplift_study as study;

/// What to know before the numbers of a result are used.
pub mod alarms {
    pub use uplift_alarms::*;
    pub use uplift_job::alarm::{Alarm, Severity, name_result};
}

/// What the crates of the pipeline may fail with; all are [`UpliftError`]s, too.
pub mod errors {
    pub use uplift_alarms::AlarmsError;
    pub use uplift_design::DesignError;
    pub use uplift_engine::EngineError;
    pub use uplift_exports::ExportsError;
    pub use uplift_inputs::InputsError;
    pub use uplift_laboratory::LaboratoryError;
    pub use uplift_questions::QuestionsError;
    pub use uplift_result::ResultError;
    pub use uplift_studies::StudiesError;
    pub use uplift_uniform_risk::UniformRiskError;
}

/// Whether the records have the hazard of the other measure, and weights by which they do.
pub mod consistency {
    pub use uplift_questions::consistency::{ConsistencyOptions, consistency};
    pub use uplift_uniform_risk::consistency::*;
}

/// The HDF5 file and the tables beside it, written and read.
pub mod result {
    pub use uplift_job::table::{write_atomically, write_table};
    pub use uplift_result::*;
    pub use uplift_uniform_risk::{
        OneRisk, RecordUnits, SpectraOfResult, StoredMeasure, StoredStripes, StudyOfResult, TargetRisks,
        at_target_risks,
    };
}

/// A structure under the records and hazard of a result.
pub mod structure {
    pub use uplift_design::*;
    pub use uplift_uniform_risk::EventRisk;
}

/// Studies of uniform risk: stripes, spectra, coefficients.
pub mod uniform_risk {
    pub use uplift_studies::uniform_risk::*;
    pub use uplift_uniform_risk::*;
}
