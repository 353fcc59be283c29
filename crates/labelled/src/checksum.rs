//! Checksums of values, as the attributes of arrays hold them.

use hdf5::types::VarLenUnicode;
use sha2::{Digest, Sha256};

/// Attribute of an array that holds its checksum.
pub(super) const CHECKSUM: &str = "sha256";

/// A value whose bytes enter a checksum.
pub(super) trait Hashed: Sized {
    fn enter(&self, hash: &mut Sha256);
}

macro_rules! hashed {
    ($($number:ty),+) => {
        $(impl Hashed for $number {
            fn enter(&self, hash: &mut Sha256) {
                hash.update(self.to_le_bytes());
            }
        })+
    };
}
hashed!(f64, f32, u32, u8, i64, u64);

impl Hashed for VarLenUnicode {
    fn enter(&self, hash: &mut Sha256) {
        self.as_str().to_owned().enter(hash);
    }
}

impl Hashed for String {
    fn enter(&self, hash: &mut Sha256) {
        hash.update(self.as_bytes());
        // no text holds it: the ends of texts count
        hash.update([0]);
    }
}

/// SHA-256 of values as little-endian bytes, of texts each with a null behind it, as hexadecimal digits.
pub(super) fn sha256<T: Hashed>(values: &[T]) -> String {
    let mut hash = Sha256::new();
    for value in values {
        value.enter(&mut hash);
    }
    hexadecimal(&hash.finalize())
}

/// Bytes as hexadecimal digits, two a byte, in lower case.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |text, byte| text + &format!("{byte:02x}"))
}
