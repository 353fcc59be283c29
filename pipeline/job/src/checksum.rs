//! Checksums of inputs and of what is computed from them: SHA-256, in hexadecimal digits.

use std::io::Read;
use std::path::Path;

use sha2::{Digest, Sha256};
use uplift_atomic_file::{FileError, io_error, open_file};
use uplift_labelled::hexadecimal;
use uplift_motion::Accelerogram;

/// SHA-256 of a file of any size, as hexadecimal digits.
///
/// # Errors
/// A file that cannot be read.
pub fn checksum_of_file(path: &Path) -> Result<String, FileError> {
    let mut file = open_file(path)?;
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer).map_err(io_error(path, "read the file"))? {
            0 => return Ok(hexadecimal(&hasher.finalize())),
            count => hasher.update(&buffer[..count]),
        }
    }
}

/// SHA-256 of some bytes, as hexadecimal digits.
pub fn checksum(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// SHA-256 of a motion's time step and samples, as hexadecimal digits.
pub fn motion_key(motion: &Accelerogram) -> String {
    let mut hash = Sha256::new();
    hash.update(motion.dt_s().to_le_bytes());
    for sample in motion.acceleration_m_s2() {
        hash.update(sample.to_le_bytes());
    }
    hexadecimal(&hash.finalize())
}
