//! Columns pushed sideways: force, sections and events over the displacement (Chapters 5 and 6).

mod measured;
mod protocol;
mod run;
mod tables;

pub use measured::{MeasuredCurve, SideOfLoop};
pub use protocol::{CyclicReport, ProtocolOptions, ProtocolReport, protocol};
pub use run::{
    CapacityReport, LinearCurve, PushoverOptions, PushoverReport, anchorage_word, axial_load_ratio, capacity, pushed,
    pushover,
};
pub use tables::check_rows;
