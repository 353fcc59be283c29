//! What every job of the pipeline is made with: who hears of it, what it writes and locks, what room it has.
//!
//! | module | what is in it |
//! |---|---|
//! | [`events`] | what a job tells while it works, and how it is stopped |
//! | [`outputs`], [`lock`] | files that a job writes, and what they may replace; one run at a time for a result |
//! | [`machine`] | what a job needs of memory and disk, and what there is |
//! | [`alarm`] | what to know before the numbers of a result are used |
//! | [`table`], [`text_table`] | tables as CSV, written and read |
//! | [`text`], [`checksum`] | tables and numbers for people; SHA-256 of files and motions |
//! | [`typed`] | numbers and words as they are typed for the options of jobs |
//! | [`study_run`] | the options of a run, and the heads of what plans and runs report |

pub mod alarm;
mod array;
pub mod checksum;
mod clock;
mod error;
pub mod events;
pub mod lock;
pub mod machine;
pub mod outputs;
mod reference_table;
pub mod study_run;
pub mod table;
pub mod text;
pub mod text_table;
pub mod typed;

pub use array::{Array, ShapeError};
pub use clock::now;
pub use error::{JobError, cause, in_file, is_stopped, list};
pub use reference_table::ReferenceTable;

/// Version of the program, and the commit it was built from where that is known.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Commit the program was built from, or `unknown`.
pub const COMMIT: &str = env!("UPLIFT_COMMIT");

/// Version and commit in one.
pub const VERSION_AND_COMMIT: &str = concat!(env!("CARGO_PKG_VERSION"), " (", env!("UPLIFT_COMMIT"), ")");
