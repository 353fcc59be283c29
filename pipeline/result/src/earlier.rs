//! What a run replaces is not lost, and not left where it would be taken for the new: an earlier result that holds more
//! than a run writes, and the tables, pages and figures that were made of it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use uplift_atomic_file::folder_of;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{beside, digest_said, is_of_digest, is_of_result, provide_folder};
use uplift_job::text::counted;
use uplift_labelled::LabelledReader;

use super::file::ResultFile;
use super::head::Overview;
use super::kept_groups::KeptGroups;
use super::layout::LAYOUT;
use super::layout::attribute::root;
use crate::error::ResultError;

/// How the names of the files end that are made of a result.
const ENDINGS: [&str; 8] = ["csv", "json", "mat", "xlsx", "geojson", "html", "svg", "png"];

/// The folder of files of which nothing says what result they are of.
const UNKNOWN: &str = "unknown";

/// The earlier result in the place of a new one, and what was made of it.
pub struct Earlier {
    result: PathBuf,
    /// Of the new one.
    digest: String,
    /// The folder of the earlier one within `<result>.earlier`, which files go to that do not say another.
    own: Option<PathBuf>,
    /// By what the earlier one is known.
    own_digest: Option<String>,
    kept: usize,
    /// Where something went to.
    folders: BTreeSet<PathBuf>,
}

impl Earlier {
    /// Keeps the earlier result at `result`, which another with the numbers of `digest` is about to replace, where it
    /// holds additions (bands, influence, measures) that are not among those `carried_over`, or other files were made
    /// of it. It is in its place still.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn keep(result: &Path, digest: &str, carried_over: Option<&KeptGroups>) -> Result<Self, ResultError> {
        let opened = ResultFile::open(result).and_then(|file| Ok((file.head()?.study_digest(), file.overview()?)));
        let own_digest = opened.as_ref().ok().map(|(of, _)| of.clone());
        let name = match opened {
            _ if !result.exists() => None,
            Ok((of, overview)) => {
                let is_lost = |name: &&str| !carried_over.is_some_and(|additions| additions.has(name));
                let lost = matches!(overview, Overview::UniformRisk { added, .. } if added.iter().any(is_lost));
                // what an interrupted run left of a result before that one is none of its own
                let own = |file: &PathBuf| digest_said(file).is_none_or(|said| said == of);
                (lost || made_of(result, digest).iter().any(own)).then_some(of)
            }
            // what of it is sound is nobody's to throw away; one of another layout is sound as a whole
            Err(_) => Some(match other_layout(result) {
                Some(layout) => format!("layout-{layout}"),
                None => "damaged".to_owned(),
            }),
        };
        let own = name.map(|name| free_folder(&beside(result, "earlier"), &name, Path::new("")));
        let mut earlier = Self { own, own_digest, ..Self::replaced(result, digest) };
        if let Some(folder) = earlier.own.clone() {
            // a link is followed, as by the writer of the new one
            let file = result.canonicalize().unwrap_or_else(|_| result.to_owned());
            let linked =
                |from: &Path, to: &Path| std::fs::hard_link(from, to).or_else(|_| std::fs::copy(from, to).map(drop));
            earlier.take(&file, &folder, linked)?;
        }
        Ok(earlier)
    }

    /// Of an earlier result that the one of `digest` at `result` has replaced already: its run was killed before it
    /// moved what was made of the earlier one.
    pub fn replaced(result: &Path, digest: &str) -> Self {
        let (result, digest) = (result.to_owned(), digest.to_owned());
        Self { result, digest, own: None, own_digest: None, kept: 0, folders: BTreeSet::new() }
    }

    /// Moves what was made of the earlier result to it, now that the new one is there, and says so. What says that it
    /// is of yet another, as an interrupted run may leave it, goes to that.
    ///
    /// # Errors
    /// A file that cannot be moved.
    pub fn set_aside(mut self, events: &dyn Events) -> Result<(), ResultError> {
        let all = beside(&self.result, "earlier");
        for file in made_of(&self.result, &self.digest) {
            let said = digest_said(&file);
            let is_own = said.is_none() || said == self.own_digest;
            let folder = match &self.own {
                Some(own) if is_own => own.clone(),
                _ => free_folder(&all, said.as_deref().unwrap_or(UNKNOWN), &self.within(&file)),
            };
            self.take(&file, &folder, |from, to| std::fs::rename(from, to))?;
        }
        // left where every figure went
        let _ = std::fs::remove_dir(beside(&self.result, "figures"));
        if self.kept > 0 {
            let folders: Vec<String> = self.folders.iter().map(|folder| folder.display().to_string()).collect();
            events.remark(
                "earlier",
                &format!("{} of the earlier result: {}", counted(self.kept, "file"), folders.join(", ")),
            );
        }
        Ok(())
    }

    /// The place of a file in the folder of its result: figures have one of their own.
    fn within(&self, file: &Path) -> PathBuf {
        let figures = beside(&self.result, "figures");
        let name = Path::new(file.file_name().unwrap_or_default());
        match file.parent() {
            Some(parent) if parent == figures => Path::new(figures.file_name().unwrap_or_default()).join(name),
            _ => name.to_owned(),
        }
    }

    fn take(
        &mut self,
        file: &Path,
        folder: &Path,
        how: impl Fn(&Path, &Path) -> std::io::Result<()>,
    ) -> Result<(), ResultError> {
        let to = folder.join(self.within(file));
        provide_folder(to.parent().unwrap_or(folder))?;
        how(file, &to).map_err(|error| {
            JobError::input(format!("{} cannot be kept as {}: {error}", file.display(), to.display()))
        })?;
        self.kept += 1;
        self.folders.insert(folder.to_owned());
        Ok(())
    }
}

impl ResultFile {
    /// Says which files beside this result were made of another result of its name, and so have other numbers.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn tell_made_of_another(&self, events: &dyn Events) -> Result<(), ResultError> {
        let others = made_of(self.path(), &self.head()?.study_digest());
        // what stands beside a table goes with it
        let others = others.iter().filter(|path| !path.to_string_lossy().ends_with("-metadata.json"));
        let names: Vec<String> = others.map(|path| path.display().to_string()).collect();
        if let [first, rest @ ..] = &names[..] {
            let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
            events.note(&format!(
                "{first}{more} beside {} is from another result of that name: write it again, or remove it (uplift \
                 status lists all)",
                self.path().display()
            ));
        }
        Ok(())
    }
}

/// The layout of the result at `path`, where it is another than this program's.
fn other_layout(path: &Path) -> Option<i64> {
    let layout = root::LAYOUT.read(&LabelledReader::open(path).ok()?, &[]).ok()?;
    (layout != LAYOUT).then_some(layout)
}

/// A folder of this name within `all`, or of the name with a number behind it, in which there is nothing of the name
/// `within` yet; none of the folder itself where that is empty. What was kept before is not replaced.
fn free_folder(all: &Path, name: &str, within: &Path) -> PathBuf {
    let numbered = (2..).map(|number| all.join(format!("{name}-{number}")));
    let mut candidates = std::iter::once(all.join(name)).chain(numbered);
    candidates.find(|folder| !folder.join(within).exists()).unwrap_or_else(|| all.join(name))
}

/// The files beside the result, and in the folder of its figures, that were made of a result of this name with other
/// numbers than those of `digest`.
pub fn made_of(result: &Path, digest: &str) -> Vec<PathBuf> {
    let start = beside(result, "").file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = folder_of(result);
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
