//! Whether computed peaks are distributed as measured ones (Section 6.8): two tables joined, tested group by group.

mod group;
mod join;
mod peaks;
mod run;
mod write;

pub use group::{Censored, GroupReport};
pub use join::Unmatched;
pub use peaks::PeakValue;
pub use run::{PRule, ValidateOptions, ValidateReport, validate};
