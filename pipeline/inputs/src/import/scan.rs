//! The files of a folder that could be records.

use std::io::Read;
use std::path::{Path, PathBuf};

use uplift_job::JobError;

use crate::error::InputsError;

/// What lies in a folder and in the folders in it.
pub(super) struct Scan {
    /// Files that could be records, in order of their paths.
    pub(super) files: Vec<PathBuf>,
    /// Tables of metadata that come with a download from PEER.
    pub(super) search_results: Vec<PathBuf>,
}

/// Endings of files that come with downloads and hold no acceleration.
const NO_RECORDS: [&str; 20] = [
    "vt2", "dt2", "pdf", "zip", "tar", "md", "html", "htm", "json", "xml", "h5", "png", "jpg", "svg", "xlsx", "xls",
    "doc", "docx", "toml", "py",
];

/// The files of a folder and the folders in it, in order of their paths; links to folders are not followed, and what is
/// hidden is left out.
pub(super) fn scan(folder: &Path) -> Result<Scan, InputsError> {
    let mut scan = Scan { files: Vec::new(), search_results: Vec::new() };
    let hidden = |entry: &walkdir::DirEntry| {
        entry.depth() > 0 && entry.file_name().to_str().is_some_and(|name| name.starts_with('.'))
    };
    let walk = walkdir::WalkDir::new(folder).sort_by_file_name().into_iter().filter_entry(|entry| !hidden(entry));
    for entry in walk {
        let entry = entry.map_err(|error| JobError::input(format!("{}: {error}", folder.display())))?;
        let (name, ending) = name_and_ending(entry.path());
        // a link to a file counts as the file
        if entry.file_type().is_dir() || !entry.path().is_file() {
            continue;
        }
        if is_search_results(&name, &ending) {
            scan.search_results.push(entry.into_path());
            continue;
        }
        let manifest = ending == "csv" && is_manifest(entry.path());
        if !manifest && !NO_RECORDS.contains(&ending.as_str()) {
            scan.files.push(entry.into_path());
        }
    }
    if scan.files.is_empty() {
        return Err(JobError::input(format!("{} holds no files that could be records", folder.display())).into());
    }
    Ok(scan)
}

/// The name of a file in small letters, and how it ends.
fn name_and_ending(path: &Path) -> (String, String) {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_owned();
    (name, ending)
}

fn is_search_results(name: &str, ending: &str) -> bool {
    ending == "csv" && name.contains("searchresults")
}

/// Whether a file of this path in a download could be a record, or the table of a search.
pub(super) fn may_be_used(path: &Path) -> bool {
    let (name, ending) = name_and_ending(path);
    let hidden = path.iter().any(|part| part.to_string_lossy().starts_with('.'));
    !hidden && (is_search_results(&name, &ending) || !NO_RECORDS.contains(&ending.as_str()))
}

/// Whether a table lists records, as an import writes it.
fn is_manifest(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(1 << 14).read_to_end(&mut head));
    read.is_ok() && head.windows(10).any(|word| word == b"record_id,".as_slice() || word == b"record_id;".as_slice())
}
