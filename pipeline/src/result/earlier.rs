//! What a run replaces is not lost, and not left where it would be taken for the new: an earlier result that holds more
//! than a run writes, and the tables, pages and figures that were made of it.

use std::path::{Path, PathBuf};

use super::file::ResultFile;
use super::head::Overview;
use crate::error::UpliftError;
use crate::events::Events;
use crate::outputs::{beside, is_of_digest, is_of_result, provide_folder};

/// How the names of the files end that are made of a result.
const ENDINGS: [&str; 8] = ["csv", "json", "mat", "xlsx", "geojson", "html", "svg", "png"];

/// The earlier result in the place of a new one, and what was made of it.
pub(crate) struct Earlier {
    result: PathBuf,
    digest: String,
    folder: PathBuf,
    kept: usize,
}

impl Earlier {
    /// Keeps the earlier result at `result`, which another with the numbers of `digest` is about to replace, where it
    /// holds what a run does not write again (bands, influence, measures), or other files were made of it. It is in its
    /// place still.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub(crate) fn keep(result: &Path, digest: &str) -> Result<Self, UpliftError> {
        let name = match ResultFile::open(result).and_then(|file| Ok((file.head()?.study_digest(), file.overview()?))) {
            _ if !result.exists() => None,
            Ok((of, overview)) => {
                let added = matches!(overview, Overview::UniformRisk { added, .. } if !added.is_empty());
                (added || !made_of(result, digest).is_empty()).then_some(of)
            }
            // what of it is sound is nobody's to throw away
            Err(_) => Some("damaged".to_owned()),
        };
        let folder = free_folder(&beside(result, "earlier"), name.as_deref().unwrap_or(digest));
        let mut earlier = Self { result: result.to_owned(), digest: digest.to_owned(), folder, kept: 0 };
        if name.is_some() {
            // a link is followed, as by the writer of the new one
            let file = result.canonicalize().unwrap_or_else(|_| result.to_owned());
            earlier
                .take(&file, |from, to| std::fs::hard_link(from, to).or_else(|_| std::fs::copy(from, to).map(drop)))?;
        }
        Ok(earlier)
    }

    /// Moves what was made of the earlier result to it, now that the new one is there, and says so.
    ///
    /// # Errors
    /// A file that cannot be moved.
    pub(crate) fn set_aside(mut self, events: &dyn Events) -> Result<(), UpliftError> {
        for file in made_of(&self.result, &self.digest) {
            self.take(&file, |from, to| std::fs::rename(from, to))?;
        }
        // left where every figure went
        let _ = std::fs::remove_dir(beside(&self.result, "figures"));
        if self.kept > 0 {
            events
                .remark("earlier", &format!("{} file(s) of the earlier result: {}", self.kept, self.folder.display()));
        }
        Ok(())
    }

    fn take(&mut self, file: &Path, how: impl Fn(&Path, &Path) -> std::io::Result<()>) -> Result<(), UpliftError> {
        let figures = beside(&self.result, "figures");
        let folder = match file.parent() {
            Some(parent) if parent == figures => self.folder.join(figures.file_name().unwrap_or_default()),
            _ => self.folder.clone(),
        };
        provide_folder(&folder)?;
        let to = folder.join(file.file_name().unwrap_or_default());
        how(file, &to).map_err(|error| {
            UpliftError::input(format!("{} cannot be kept as {}: {error}", file.display(), to.display()))
        })?;
        self.kept += 1;
        Ok(())
    }
}

/// A folder of this name within `all`, or of the name with a number behind it, that is not there yet: what was kept
/// before is not replaced.
fn free_folder(all: &Path, name: &str) -> PathBuf {
    let numbered = (2..).map(|number| all.join(format!("{name}-{number}")));
    let mut candidates = std::iter::once(all.join(name)).chain(numbered);
    candidates.find(|folder| !folder.exists()).unwrap_or_else(|| all.join(name))
}

/// The files beside the result, and in the folder of its figures, that were made of a result of this name with other
/// numbers than those of `digest`.
pub(crate) fn made_of(result: &Path, digest: &str) -> Vec<PathBuf> {
    let start = beside(result, "").file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = result.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let files = |folder: &Path, start: &str| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let named = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(start));
        // without the dot of a folder that has no name
        let path = |entry: std::fs::DirEntry| entry.path().strip_prefix(".").map_or(entry.path(), Path::to_owned);
        named.map(path).filter(|path| path.is_file()).collect()
    };
    let mut found = files(folder, &start);
    found.extend(files(&beside(result, "figures"), ""));
    found.retain(|path| {
        let ends = path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending == *known));
        ends && is_of_result(path, result) && !is_of_digest(path, digest)
    });
    found.sort();
    found
}
