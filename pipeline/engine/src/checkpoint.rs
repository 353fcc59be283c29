//! What outlives a run: finished analysis rows, keyed by all that they depend on.
//!
//! | module | what is in it |
//! |---|---|
//! | `key` | from a plan to the keys of its rows |
//! | `row_file` | finished rows in a file, appended as they come: a checkpoint, or a shard; how a row is written |
//! | `open` | a checkpoint in use: what is known from it, and what is added |
//! | `error` | why one cannot be used |
//!
//! An analysis row is one motion through one system at all its scale factors. Its key is a hash of the motion, the
//! factors, the system and the version of the solver's numbers: a key that is known again has the same numbers,
//! whatever else of a study has changed, and whatever asked for it.

mod error;
mod key;
mod open;
mod row_file;

pub use error::CheckpointError;
pub(crate) use error::in_brackets;
pub use key::{RowKey, RowKeys, oscillator_key};
pub use open::Checkpoint;
pub use row_file::{Finding, FinishedRows, RowFile, RowFileHead, checkpoint_path};
