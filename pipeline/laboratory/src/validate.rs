//! Whether computed peaks are distributed as measured ones (Section 6.8): two tables joined, tested group by group.

mod doubts;
mod group;
mod join;
mod options;
mod peaks;
mod report;
mod run;
mod write;

pub use group::{Censored, GroupReport};
pub use join::Unmatched;
pub use options::{PRule, ValidateOptions};
pub use peaks::PeakValue;
pub use report::ValidateReport;
pub use run::validate;
