//! Record sets looked at, chosen from and made.
//!
//! | job | what it does |
//! |---|---|
//! | [`list`](list()) | the records of a manifest |
//! | [`show`](show()) | one record of a manifest, or what a record file holds |
//! | [`select`](select()) | which records a study takes, and a manifest of them |
//! | [`at_level`](at_level()) | a table of sets of their own at each level, from what tools of record selection write |
//! | [`synthesize`](synthesize()) | synthetic records of a scenario |
//!
//! What brings the files of a download into a manifest is [`import`](mod@crate::import).

mod at_level;
mod criteria;
mod list;
mod select;
mod show;
mod synthesize;

pub use at_level::{AtLevelOptions, AtLevelReport, LevelSet, at_level};
pub use criteria::{Criteria, range};
pub use list::{ListReport, ListedRecord, SetOptions, list};
pub use select::{SelectOptions, SelectReport, select};
pub use show::{ComponentReport, FileReport, PairPeaks, RecordReport, ShowOptions, ShowReport, VelocityPulse, show};
pub use synthesize::{Mechanism, SynthesizeOptions, SynthesizeReport, synthesize};
