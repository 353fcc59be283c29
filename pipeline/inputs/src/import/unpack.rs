//! A zip archive as it was downloaded, unpacked beside the manifest.
//!
//! All of it is read and judged before anything is written: an archive that is damaged, packed to burst or addressed
//! outside its folder leaves nothing behind.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Component, Path, PathBuf};

use uplift_atomic_file::{open_file, read_file};
use uplift_ida::Watch;
use uplift_job::JobError;
use uplift_job::checksum::checksum;
use uplift_job::events::{Events, Progress};
use uplift_job::outputs::provide_folder;
use uplift_job::table::write_atomically;
use zip::result::ZipError;
use zip::{CompressionMethod, ZipArchive};

use super::scan::may_be_used;
use crate::error::InputsError;

/// Files that an archive may hold: a search at PEER gives some hundreds.
const MOST_FILES: usize = 100_000;
/// The most that one of them may be unpacked, as of any record file.
const LARGEST_FILE_BYTES: u64 = 64 << 20;
/// The most that all of them may be unpacked: a hundred records of PEER have some 100 MB.
const LARGEST_BYTES: u64 = 8 << 30;

/// How a zip archive begins; the second is one without files.
const MARKS: [&[u8]; 2] = [b"PK\x03\x04", b"PK\x05\x06"];

/// Whether the file at `path` is a zip archive, whatever its name.
pub(super) fn is_archive(path: &Path) -> bool {
    let mut head = [0; 4];
    path.is_file()
        && File::open(path).and_then(|mut file| file.read_exact(&mut head)).is_ok()
        && MARKS.contains(&head.as_slice())
}

/// The folder that an archive is unpacked into: of its name, beside the manifest.
pub(super) fn folder_of(archive: &Path, manifest: &Path) -> PathBuf {
    manifest.with_file_name(archive.file_stem().unwrap_or(archive.as_os_str()))
}

/// Unpacks what could be of use in `archive` into `folder`. Files that are there already stay if they are the same, as
/// after an interruption.
///
/// # Errors
/// An archive that is damaged, encrypted or too large, or has names outside the folder; a folder with other files, or
/// that cannot be written; an interruption.
pub(super) fn unpack(archive: &Path, folder: &Path, events: &dyn Events) -> Result<(), InputsError> {
    let mut opened = Opened::open(archive)?;
    let wanted = opened.wanted()?;
    let progress = Progress::begin(events, "reading the archive", "files", wanted.len() as u64);
    let mut checksums = BTreeMap::new();
    let mut left = LARGEST_BYTES;
    for (name, index) in &wanted {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        let content = opened.content(*index, name, left)?;
        left -= content.len() as u64;
        checksums.insert(folder.join(name), checksum(&content));
        progress.finished(1);
    }
    drop(progress);
    refuse_other_files(archive, folder, &checksums)?;
    provide_folder(folder)?;
    let progress = Progress::begin(events, "unpacking", "files", wanted.len() as u64);
    for (name, index) in &wanted {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        let path = folder.join(name);
        if !path.exists() {
            path.parent().map_or(Ok(()), provide_folder)?;
            write_atomically(&path, &opened.content(*index, name, LARGEST_FILE_BYTES)?)?;
        }
        progress.finished(1);
    }
    Ok(())
}

/// An archive whose table of contents could be read.
struct Opened<'a> {
    path: &'a Path,
    archive: ZipArchive<BufReader<File>>,
}

impl<'a> Opened<'a> {
    fn open(path: &'a Path) -> Result<Self, InputsError> {
        let file = BufReader::new(open_file(path)?);
        let archive = ZipArchive::new(file).map_err(|error| refusal(path, &why(&error)))?;
        Ok(Self { path, archive })
    }

    /// Where the files that could be of use lie, by their names in the archive.
    fn wanted(&mut self) -> Result<BTreeMap<PathBuf, usize>, InputsError> {
        let path = self.path;
        if self.archive.len() > MOST_FILES {
            let count = self.archive.len();
            return Err(refusal(path, &format!("it has {count} files, more than {MOST_FILES}")));
        }
        let mut wanted = BTreeMap::new();
        for index in 0..self.archive.len() {
            let entry = self.archive.by_index_raw(index).map_err(|error| refusal(path, &why(&error)))?;
            let name = entry.name().map_err(|error| refusal(path, &why(&error)))?.replace('\\', "/");
            let Some(inside) = inside(&name) else {
                return Err(refusal(
                    path,
                    &format!("its entry \"{name}\" would lie outside the folder; no download has such names"),
                ));
            };
            if !entry.is_file() || !may_be_used(&inside) {
                continue;
            }
            if entry.encrypted() {
                return Err(refusal(path, &format!("\"{name}\" is encrypted: unpack it with its password")));
            }
            if !matches!(entry.compression(), CompressionMethod::Stored | CompressionMethod::Deflated) {
                let method = entry.compression();
                return Err(refusal(path, &format!("\"{name}\" is packed by {method}, and that is not read")));
            }
            if wanted.insert(inside, index).is_some() {
                return Err(refusal(path, &format!("it holds \"{name}\" twice")));
            }
        }
        if wanted.is_empty() {
            return Err(JobError::input(format!("{} holds no files that could be records", path.display())).into());
        }
        Ok(wanted)
    }

    /// A file of the archive, its checksum right, of at most so many bytes as are `left`.
    fn content(&mut self, index: usize, name: &Path, left: u64) -> Result<Vec<u8>, InputsError> {
        let path = self.path;
        let told = |reason: &str| refusal(path, &format!("\"{}\": {reason}", name.display()));
        let limit = left.min(LARGEST_FILE_BYTES);
        let entry = self.archive.by_index(index).map_err(|error| told(&why(&error)))?;
        let mut content = Vec::new();
        let read = entry.take(limit + 1).read_to_end(&mut content);
        if content.len() as u64 > limit {
            let [file, all] = [LARGEST_FILE_BYTES >> 20, LARGEST_BYTES >> 20];
            return Err(told(&format!("unpacked it exceeds {file} MiB a file or {all} MiB an archive")));
        }
        read.map_err(|error| told(&format!("{DAMAGED} ({error})")))?;
        Ok(content)
    }
}

/// What to do about most that is wrong.
const DAMAGED: &str = "the archive is damaged or not complete: download it again";

/// What an error of the archive means to who has it.
fn why(error: &ZipError) -> String {
    match error {
        ZipError::UnsupportedArchive(reason) => format!("it is packed in a way that is not read ({reason})"),
        other => format!("{DAMAGED} ({other})"),
    }
}

fn refusal(archive: &Path, reason: &str) -> InputsError {
    JobError::input(format!(
        "{}: {reason}. What you unpack yourself is imported as a folder: uplift records import FOLDER",
        archive.display()
    ))
    .into()
}

/// The name of an entry as a path inside a folder; none where it leads elsewhere.
fn inside(name: &str) -> Option<PathBuf> {
    // a drive of Windows, too, wherever this runs
    if name.contains(':') || name.contains('\0') {
        return None;
    }
    let mut path = PathBuf::new();
    for part in Path::new(name).components() {
        match part {
            Component::Normal(part) => path.push(part),
            Component::CurDir => {}
            _ => return None,
        }
    }
    Some(path)
}

/// Refuses a folder that holds anything but the files of the archive: they would be imported along with these.
fn refuse_other_files(archive: &Path, folder: &Path, checksums: &BTreeMap<PathBuf, String>) -> Result<(), InputsError> {
    if !folder.exists() {
        return Ok(());
    }
    let is_same = |path: &Path| {
        let known = checksums.get(path);
        known.is_some_and(|known| read_file(path, LARGEST_FILE_BYTES).is_ok_and(|bytes| checksum(&bytes) == *known))
    };
    // what is hidden is not imported, and may be what a killed import left
    let hidden = |entry: &walkdir::DirEntry| entry.depth() > 0 && entry.file_name().to_string_lossy().starts_with('.');
    for entry in walkdir::WalkDir::new(folder).into_iter().filter_entry(|entry| !hidden(entry)) {
        let entry = entry.map_err(|error| JobError::input(format!("{}: {error}", folder.display())))?;
        if !entry.file_type().is_dir() && !is_same(entry.path()) {
            return Err(JobError::Usage(format!(
                "{} would be unpacked into {}, where {} is another file than that of the archive: import that folder, \
                 or write the manifest to another folder",
                archive.display(),
                folder.display(),
                entry.path().display()
            ))
            .into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_into_the_folder_or_nowhere() {
        assert_eq!(inside("a/./b.AT2"), Some(PathBuf::from("a/b.AT2")));
        for name in ["../a.AT2", "a/../../b.AT2", "/etc/a.AT2", "C:/a.AT2", "a\0b"] {
            assert_eq!(inside(name), None, "{name}");
        }
    }
}
