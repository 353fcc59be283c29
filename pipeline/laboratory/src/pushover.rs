//! Columns pushed sideways: force, sections and events over the displacement (Chapters 5 and 6).

mod measured;
mod protocol;
mod report;
mod run;
mod tables;

pub use measured::{MeasuredCurve, SideOfLoop};
pub use protocol::{ProtocolOptions, ProtocolReport, protocol};
pub use report::{CapacityReport, CyclicReport, LinearCurve, PushoverReport};
pub(crate) use run::anchorage_word;
pub use run::{PushoverOptions, axial_load_ratio, capacity, pushed, pushover};
pub(crate) use tables::check_rows;
