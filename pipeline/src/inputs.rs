//! Records and hazard curves, read and checked before anything is computed.

mod cache;
mod hazard;
pub(crate) mod manifest;
pub(crate) mod pairs;
mod record_set;
pub(crate) mod selection;

pub use hazard::{BranchHazard, HazardInput, SiteHazard, read_hazard};
pub use record_set::{Record, RecordSet, read_records};

use sha2::{Digest, Sha256};

/// SHA-256 of some bytes, as hexadecimal digits.
pub(crate) fn checksum(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |text, byte| text + &format!("{byte:02x}"))
}
