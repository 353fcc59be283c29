//! What outlives a run: finished pieces of the stripes, keyed by all that they depend on.
//!
//! | room | what is in it |
//! |---|---|
//! | `key` | from record, oscillator and levels to the key of a piece |
//! | `piece_file` | finished pieces, appended as they come: the journal of a run, or the shard of one machine |
//! | `earlier` | the stripes of an earlier result |
//! | `lock` | one run at a time for one result |
//!
//! A piece is one record through one oscillator at all levels. Its key is a hash of the motion, its intensity, the oscillator, the levels and the
//! version of the solver's numbers: a key that is known again has the same numbers, whatever else of a study has changed.

mod earlier;
mod key;
mod lock;
mod piece_file;

pub use earlier::EarlierStripes;
pub use key::{PieceKey, StripeKeys, motion_key, oscillator_key};
pub use lock::ResultLock;
pub use piece_file::{Finding, KeptPieces, PieceFile, PieceFileHead, journal_path};
