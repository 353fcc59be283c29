//! What outlives a run: finished pieces of the stripes, keyed by all that they depend on.
//!
//! | module | what is in it |
//! |---|---|
//! | `key` | from record, oscillator and levels to the key of a piece |
//! | `row_file` | finished pieces, appended as they come: the journal of a run, or the shard of one machine |
//!
//! A piece is one record through one oscillator at all levels. Its key is a hash of the motion, its intensity, the oscillator, the levels and the
//! version of the solver's numbers: a key that is known again has the same numbers, whatever else of a study has changed.

mod key;
mod row_file;

pub use key::{PieceKey, StripeKeys, motion_key, oscillator_key};
pub use row_file::{Finding, KeptPieces, PieceFile, PieceFileHead, journal_path};
