//! The kinds of study, each from its plan to its result file, with the same files in its folder.

pub mod displacement;
mod error;
pub mod shake_table;
pub mod uniform_risk;

use std::path::Path;

pub use error::StudiesError;
use uplift_job::events::Events;

/// Says, where the tables beside the result at `path` cannot be written, that nothing is lost.
pub(crate) fn complete_result<'a, E>(path: &'a Path, events: &'a dyn Events) -> impl FnOnce(&E) + 'a {
    |_| events.note(&format!("{} is complete: only the tables beside it are missing", path.display()))
}
