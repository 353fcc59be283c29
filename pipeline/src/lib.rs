//! The program `uplift`: study file → inputs → stages → one result file.
//!
//! | room | what is in it |
//! |---|---|
//! | [`study`] | the study file, checked as a whole |
//! | [`import`] | record files found in a folder, paired, measured and listed in a manifest |
//! | [`inputs`] | records and hazard curves, read and checked before anything is computed |
//! | [`stages`] | stripes, spectra, coefficients, bands: each takes what the one before returned |
//! | [`result`](mod@result) | the HDF5 file and the tables beside it, written and read |
//! | [`kept`] | what outlives a run: finished pieces by their keys, journals, shards, the lock |
//! | [`labelled`] | HDF5 files of labelled arrays, free of science |
//! | [`pulses`] | rocking spectra under wavelets, which need no study |
//! | [`figures`] | what figures show |
//! | [`report`](mod@report) | the HTML report |
//! | `export` | tables for other programs |
//! | [`plot`] | figures, free of science |
//! | [`command`] | what the user can type |
//! | [`progress`] | the progress bar, or plain lines |
//!
//! Only this package knows files, terminals and HDF5; the science is in the crates below it.

/// A line on standard error. Where nobody listens any more, a closed pipe or a full disk, it is lost, and the work goes on.
macro_rules! tell {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($text)*);
    }};
}

/// As `tell!`, without the end of the line.
macro_rules! tell_on {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = write!(std::io::stderr(), $($text)*);
    }};
}

pub mod command;
mod error;
mod export;
pub mod figures;
pub mod import;
pub mod inputs;
pub mod kept;
pub mod labelled;
pub mod plot;
pub mod progress;
pub mod pulses;
pub mod report;
pub mod result;
pub mod stages;
pub mod study;
mod table;

pub use error::UpliftError;

/// Version of the program, and the commit it was built from where that is known.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Commit the program was built from, or `unknown`.
pub const COMMIT: &str = env!("UPLIFT_COMMIT");
