//! Records and hazard curves, read and checked before anything is computed.

mod cache;
mod hazard;
pub mod manifest;
pub mod pairs;
mod record_set;
mod record_sets;
pub mod selection;
mod site_table;

pub use hazard::{BranchHazard, HazardInput, SiteHazard, read_hazard};
pub use record_set::{Record, RecordSet, read_records};
pub use record_sets::{NamedSet, RecordSets, SetRecord, read_record_sets};
pub use site_table::{BatchSite, ListedSite, SiteCurves, SiteExport, SiteList, read_site_list};

use std::io::Read;
use std::path::Path;

use sha2::{Digest, Sha256};
use uplift_labelled::hexadecimal;

/// SHA-256 of a file of any size, as hexadecimal digits.
pub fn checksum_of_file(path: &Path) -> std::io::Result<String> {
    let mut file = std::fs::File::open(path)?;
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(hexadecimal(&hasher.finalize())),
            count => hasher.update(&buffer[..count]),
        }
    }
}

/// SHA-256 of some bytes, as hexadecimal digits.
pub fn checksum(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}
