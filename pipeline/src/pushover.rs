//! Columns pushed sideways: force, sections and events over the displacement (Chapters 5 and 6).

mod measured;
mod protocol;
mod run;
mod tables;

pub use measured::{MeasuredCurve, SideOfLoop};
pub use protocol::{CyclicReport, ProtocolOptions, ProtocolReport, protocol};
pub use run::{CapacityReport, LinearCurve, PushoverOptions, PushoverReport, pushover};
pub(crate) use run::{anchorage_word, axial_load_ratio, capacity, pushed};
pub(crate) use tables::check_rows;
