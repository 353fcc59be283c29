//! The synthetic record set, kept in the user's cache folder so that it is generated once.
//!
//! The folder is `$UPLIFT_CACHE`, or `uplift` in `$XDG_CACHE_HOME` or `~/.cache`. A file holds a JSON header, the
//! samples as they are in memory, and a checksum; whatever is not as it should be is generated again, and a folder that
//! cannot be written is no error.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use uplift_atomic_file::write_whole;
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{Accelerogram, MotionError, RecordPair};

use crate::checksum::checksum;

/// Hexadecimal digits of the checksum at the end of a file.
const CHECKSUM_LENGTH: usize = 64;

#[derive(Serialize, Deserialize)]
struct Header {
    id: String,
    dt_s: f64,
    samples: [usize; 2],
    metadata: BTreeMap<String, String>,
}

/// The set that `options` make, from the cache if it is there.
pub(super) fn synthetic_set(options: &SyntheticSetOptions) -> Result<Vec<RecordPair>, MotionError> {
    let path = folder().map(|folder| folder.join(file_name(options)));
    if let Some(set) = path.as_deref().and_then(load).filter(|set| set.len() == options.pairs) {
        return Ok(set);
    }
    let set = generate(options)?;
    if let Some(path) = path {
        store(&path, &set);
    }
    Ok(set)
}

fn folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    variable("UPLIFT_CACHE").or_else(|| {
        let base = variable("XDG_CACHE_HOME").or_else(|| variable("HOME").map(|home| home.join(".cache")))?;
        Some(base.join("uplift"))
    })
}

/// Another version of the program may make another set.
fn file_name(options: &SyntheticSetOptions) -> String {
    let key = format!("{} {} {options:?}", crate::VERSION, crate::COMMIT);
    format!("synthetic-{}.bin", &checksum(key.as_bytes())[..16])
}

fn load(path: &Path) -> Option<Vec<RecordPair>> {
    let bytes = std::fs::read(path).ok()?;
    let (content, stored) = bytes.split_at_checked(bytes.len().checked_sub(CHECKSUM_LENGTH)?)?;
    if checksum(content).as_bytes() != stored {
        return None;
    }
    let end = content.iter().position(|&byte| byte == b'\n')?;
    let headers: Vec<Header> = serde_json::from_slice(&content[..end]).ok()?;
    let mut samples = content[end + 1..].chunks_exact(8).map(|chunk| {
        f64::from_le_bytes([chunk[0], chunk[1], chunk[2], chunk[3], chunk[4], chunk[5], chunk[6], chunk[7]])
    });
    headers
        .into_iter()
        .map(|Header { id, dt_s, samples: [n1, n2], metadata }| {
            let h1 = Accelerogram::new(dt_s, samples.by_ref().take(n1).collect()).ok()?;
            let h2 = Accelerogram::new(dt_s, samples.by_ref().take(n2).collect()).ok()?;
            Some(RecordPair { id, h1, h2, metadata })
        })
        .collect()
}

fn store(path: &Path, set: &[RecordPair]) {
    let headers: Vec<Header> = set
        .iter()
        .map(|pair| Header {
            id: pair.id.clone(),
            dt_s: pair.h1.dt_s(),
            samples: [pair.h1.len(), pair.h2.len()],
            metadata: pair.metadata.clone(),
        })
        .collect();
    let Ok(mut content) = serde_json::to_vec(&headers) else { return };
    content.push(b'\n');
    for pair in set {
        for component in [&pair.h1, &pair.h2] {
            content.extend(component.acceleration_m_s2().iter().flat_map(|a| a.to_le_bytes()));
        }
    }
    let stored = checksum(&content);
    content.extend(stored.as_bytes());
    // two programs may store the same set at the same time; a folder that cannot be written is no error
    let _ = write_whole(path, &content);
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn what_is_stored_is_loaded_to_the_bit_and_damage_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/set.bin");
        let set = generate(&SyntheticSetOptions { pairs: 2, ..SyntheticSetOptions::default() }).unwrap();
        assert!(load(&path).is_none());
        store(&path, &set);
        assert_eq!(load(&path).unwrap(), set);

        let mut bytes = std::fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        std::fs::write(&path, &bytes).unwrap();
        assert!(load(&path).is_none());
        std::fs::write(&path, &bytes[..10]).unwrap();
        assert!(load(&path).is_none());
    }
}
