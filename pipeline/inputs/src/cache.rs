//! The synthetic record set, kept in the user's cache folder so that it is generated once.
//!
//! The folder is `$UPLIFT_CACHE`, or `uplift` in `$XDG_CACHE_HOME` or `~/.cache`. A file holds a JSON header, the
//! samples as they are in memory, and a checksum; whatever is not as it should be is generated again. A folder that
//! cannot be written or is full is no error. Beyond [`LARGEST_CACHE`] the sets that were used longest ago go.

use std::collections::BTreeMap;
use std::fs::{File, Metadata};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};
use uplift_atomic_file::{read_file, write_whole};
use uplift_job::checksum::checksum;
use uplift_job::events::Events;
use uplift_motion::synthetic::SyntheticSetOptions;
use uplift_motion::{Accelerogram, RecordPair};

use super::made::made_pairs;
use crate::error::InputsError;

/// The most that the sets take together, bytes: some 150 sets of 105 pairs.
const LARGEST_CACHE: u64 = 2 << 30;
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
pub(super) fn synthetic_set(
    options: &SyntheticSetOptions,
    events: &dyn Events,
) -> Result<Vec<RecordPair>, InputsError> {
    let path = folder().map(|folder| folder.join(file_name(options)));
    if let Some(path) = &path
        && let Some(set) = load(path).filter(|set| set.len() == options.pairs)
    {
        // it was used now; a file that is not ours to touch stays as old as it is
        let _ = File::options().append(true).open(path).and_then(|file| file.set_modified(SystemTime::now()));
        return Ok(set);
    }
    let set = made_pairs(options, events)?;
    if let Some(path) = path {
        store(&path, &set);
        shrink(&path, LARGEST_CACHE);
    }
    Ok(set)
}

/// Removes what was used longest ago from the folder of the set at `newest`, until all take at most `limit_bytes`; that
/// one stays unless it is too large alone.
fn shrink(newest: &Path, limit_bytes: u64) {
    let entries = newest.parent().and_then(|folder| folder.read_dir().ok()).into_iter().flatten().flatten();
    let is_set = |name: &str| name.starts_with(PREFIX) && name.ends_with(ENDING);
    let mut sets: Vec<(bool, SystemTime, u64, PathBuf)> = entries
        .filter(|entry| entry.file_name().to_str().is_some_and(is_set))
        .filter_map(|entry| {
            let metadata = entry.metadata().ok().filter(Metadata::is_file)?;
            let path = entry.path();
            Some((path == newest, metadata.modified().ok()?, metadata.len(), path))
        })
        .collect();
    sets.sort_unstable_by(|one, other| other.cmp(one));
    let mut bytes = 0;
    for (_, _, length, path) in sets {
        bytes += length;
        if bytes > limit_bytes {
            let _ = std::fs::remove_file(path);
        }
    }
}

fn folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    variable("UPLIFT_CACHE").or_else(|| {
        let base = variable("XDG_CACHE_HOME").or_else(|| variable("HOME").map(|home| home.join(".cache")))?;
        Some(base.join("uplift"))
    })
}

const PREFIX: &str = "synthetic-";
const ENDING: &str = ".bin";

/// Another version of the program may make another set.
fn file_name(options: &SyntheticSetOptions) -> String {
    let key = format!("{} {} {options:?}", uplift_job::VERSION, uplift_job::COMMIT);
    format!("{PREFIX}{}{ENDING}", &checksum(key.as_bytes())[..16])
}

fn load(path: &Path) -> Option<Vec<RecordPair>> {
    let bytes = read_file(path, LARGEST_CACHE).ok()?;
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
    use uplift_motion::synthetic::generate;

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

    #[test]
    fn what_was_used_longest_ago_goes() {
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        for (age_s, name) in [(40, "a"), (30, "b"), (20, "c"), (10, "d")] {
            let path = place(&format!("synthetic-{name}.bin"));
            std::fs::write(&path, [0; 100]).unwrap();
            let used = SystemTime::now() - std::time::Duration::from_secs(age_s);
            File::options().append(true).open(&path).unwrap().set_modified(used).unwrap();
        }
        std::fs::write(place("of another program.bin"), [0; 1000]).unwrap();
        let left = || ["a", "b", "c", "d"].map(|name| place(&format!("synthetic-{name}.bin")).exists());
        shrink(&place("synthetic-a.bin"), 400);
        assert_eq!(left(), [true; 4]);
        // the set that was just made stays, whatever its clock says
        shrink(&place("synthetic-a.bin"), 250);
        assert_eq!(left(), [true, false, false, true]);
        shrink(&place("synthetic-a.bin"), 99);
        assert_eq!(left(), [false; 4]);
        assert!(place("of another program.bin").exists());
        shrink(&place("absent/synthetic-a.bin"), 0);
    }
}
