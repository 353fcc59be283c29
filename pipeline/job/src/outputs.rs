//! Where a job may write: one rule for every output of every job.
//!
//! A file is written where nothing is, where a file of this program of the same kind is, and of the same result where
//! both say of which, or where whoever asks for it forces it. A file that a job reads is never written over. All this
//! is known before anything is computed.

mod metadata;

use std::fmt::Display;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use uplift_atomic_file::{AtomicFile, io_error};
use uplift_labelled::LabelledReader;

use crate::error::JobError;
pub use metadata::{metadata_path, metadata_text};

/// How names of files end that this program reads and writes; of none else that it makes.
const FILE_ENDINGS: [&str; 13] =
    ["h5", "toml", "csv", "json", "geojson", "mat", "xlsx", "svg", "png", "html", "xml", "txt", "AT2"];
/// Bytes of a file in which this program names itself, where it wrote it.
const HEAD: u64 = 4096;

/// How this program names itself in a JSON file, but for spaces.
const JSON_MARK: &[u8] = b"\"provenance\":\"uplift";
const MATLAB_MARK: &[u8] = b"MATLAB 5.0 MAT-file, uplift ";
const WORKBOOK_MARK: &[u8] = b"<dc:description>uplift ";
/// Without the zero that stands in it, see [`head_of`].
const PNG_MARK: &[u8] = b"tEXtSoftwareuplift ";
const SVG_MARK: &[u8] = b"<desc>uplift ";
const PAGE_MARK: &[u8] = b"<meta name=\"generator\" content=\"uplift ";
const NRML_MARK: &[u8] = b"<description>uplift ";
/// Of remarks, and of tables once.
const TEXT_MARK: &[u8] = b"# uplift ";
/// All in which spaces count.
const MARKS: [&[u8]; 7] = [MATLAB_MARK, WORKBOOK_MARK, PNG_MARK, SVG_MARK, PAGE_MARK, NRML_MARK, TEXT_MARK];

/// The ending of the file with the arrays of a table of sites.
pub const SITE_ARRAYS: &str = "sites.h5";
/// The ending of the table with their spectra.
pub const SITE_SPECTRA: &str = "sites.csv";
/// The ending of the table with their coefficients and verdicts.
pub const SITE_COEFFICIENTS: &str = "sites.coefficients.csv";
/// The attribute `kind` of a file with the numbers of many sites.
pub const SITES_KIND: &str = "sites";

/// What a file is: how its name ends, and by what one of this program's is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputKind {
    /// A table with a column of this name; beside it stands where it comes from.
    Table(&'static str),
    /// Spectra and coefficients as JSON.
    Json,
    /// The same as a MATLAB file.
    Matlab,
    /// The same as a workbook of Excel.
    Workbook,
    /// A fragility model in NRML.
    Nrml,
    /// A map of many sites.
    GeoJson,
    /// The numbers of many sites as arrays.
    Sites,
    /// A figure, as its name ends.
    Figure,
    /// The page of a report.
    Page,
    /// A table that its reader completes by hand, so that none is overwritten.
    Manifest,
    /// What an import remarks.
    Remarks,
    /// A synthetic record, which studies may use by now.
    Record,
    /// A hazard curve, which others may use by now.
    Curve,
}

/// A file that a job is about to write.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    path: PathBuf,
    kind: OutputKind,
    result: Option<String>,
}

impl Output {
    /// A file of some kind at `path`.
    pub fn new(path: impl Into<PathBuf>, kind: OutputKind) -> Self {
        Self { path: path.into(), kind, result: None }
    }

    /// Where it is written.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The same, of which the file says that it is of the result, or the structure, at `result`.
    #[must_use]
    pub fn with_result(mut self, result: &Path) -> Self {
        // a name with other characters may stand there in other words
        let plain = |name: &&str| name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"._- ".contains(&byte));
        self.result = result.file_name().and_then(|name| name.to_str()).filter(plain).map(str::to_owned);
        self
    }

    /// Why it may not be written; none where it may.
    fn refusal(&self, inputs: &[&Path], force: bool) -> Option<String> {
        let name = self.path.display();
        if let Some(reason) = wrong_ending(&self.path, self.kind.endings()) {
            return Some(reason);
        }
        if let Some(folder) = self.path.parent().filter(|folder| !folder.exists())
            && let Some(ending) = file_ending(folder)
        {
            return Some(format!("{}: a folder would be made: give a name without .{ending}", folder.display()));
        }
        let beside = matches!(self.kind, OutputKind::Table(_)).then(|| metadata_path(&self.path));
        for path in std::iter::once(&self.path).chain(&beside) {
            if inputs.iter().any(|input| is_same_file(path, input)) {
                return Some(format!("{} would overwrite an input: give another name", path.display()));
            }
        }
        if force {
            return None;
        }
        let told = beside.as_deref().and_then(head_of);
        if let (Some(beside), Some(told)) = (&beside, &told)
            && !is_metadata(told)
        {
            let beside = beside.display();
            return Some(format!(
                "{beside} exists and is not from this program: give another name, or --force to overwrite it"
            ));
        }
        let head = self.kind.head_of(&self.path)?;
        if !self.kind.is_ours(&self.path, &head, told.is_some()) {
            let why = match self.kind {
                OutputKind::Manifest => ", perhaps with columns of yours",
                OutputKind::Curve => ", with another curve",
                OutputKind::Record => ", and studies may use it",
                _ => ", and is not the same kind of file from this program",
            };
            return Some(format!("{name} already exists{why}: give another name, or --force to replace it"));
        }
        let words = told.unwrap_or(head);
        let other = self.result.as_ref().filter(|result| !names_result(&words, result));
        other.map(|result| format!("{name} is not of {result}: give another name, or --force to replace it"))
    }
}

impl OutputKind {
    fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Table(_) | Self::Manifest | Self::Curve => &["csv"],
            Self::Json => &["json"],
            Self::Matlab => &["mat"],
            Self::Workbook => &["xlsx"],
            Self::Nrml => &["xml"],
            Self::GeoJson => &["geojson"],
            Self::Sites => &["h5"],
            Self::Figure => &["svg", "png"],
            Self::Page => &["html"],
            Self::Remarks => &["txt"],
            Self::Record => &["AT2"],
        }
    }

    /// What the file at `path` says of itself; none where there is no file.
    fn head_of(self, path: &Path) -> Option<Vec<u8>> {
        let head = head_of(path)?;
        Some(if self == Self::Workbook { workbook_properties(path).unwrap_or_default() } else { head })
    }

    /// Whether a file with this `head` is one of this program; `told` of a table that this stands beside it.
    fn is_ours(self, path: &Path, head: &[u8], told: bool) -> bool {
        match self {
            Self::Table(column) => {
                let mut lines = head.split(|&byte| byte == b'\n');
                let names = if told {
                    lines.next()
                } else {
                    // tables said so in their first line once
                    lines.next().filter(|line| line.starts_with(TEXT_MARK)).and_then(|_| lines.next())
                };
                names.is_some_and(|names| names.split(|&byte| byte == b',').any(|name| name == column.as_bytes()))
            }
            Self::Json | Self::GeoJson => head.starts_with(b"{") && contains(&without_spaces(head), JSON_MARK),
            Self::Matlab => head.starts_with(MATLAB_MARK),
            Self::Workbook => contains(head, WORKBOOK_MARK),
            Self::Figure if path.extension().is_some_and(|extension| extension == "png") => {
                head.starts_with(b"\x89PNG") && contains(head, PNG_MARK)
            }
            Self::Figure => contains(head, b"<svg") && contains(head, SVG_MARK),
            Self::Page => contains(head, PAGE_MARK),
            Self::Nrml => contains(head, NRML_MARK),
            Self::Remarks => head.starts_with(TEXT_MARK),
            Self::Sites => is_sites(path),
            Self::Manifest | Self::Curve | Self::Record => false,
        }
    }
}

/// Whether the file at `path` holds the numbers of many sites as arrays.
pub fn is_sites(path: &Path) -> bool {
    let kind = LabelledReader::open(path).and_then(|reader| reader.attribute::<String>("/", "kind"));
    kind.is_ok_and(|kind| kind == SITES_KIND)
}

/// Refuses `outputs` that would replace one of the `inputs`, or without `force` something else than an earlier output
/// of the same kind; all of them at once. Places that cannot be written are found; nothing is made.
///
/// # Errors
/// [`JobError::Usage`] for these; [`JobError::File`] where nothing can be written.
pub fn check(outputs: &[Output], inputs: &[impl AsRef<Path>], force: bool) -> Result<(), JobError> {
    let inputs: Vec<&Path> = inputs.iter().map(AsRef::as_ref).collect();
    let refused: Vec<String> = outputs.iter().filter_map(|output| output.refusal(&inputs, force)).collect();
    if !refused.is_empty() {
        return Err(JobError::Usage(refused.join("\n")));
    }
    for output in outputs {
        AtomicFile::reserve(&place_to_try(&output.path))?;
    }
    Ok(())
}

/// Where to try whether a file can be written at `path`: there, or above it where its folder is still to be made.
pub fn place_to_try(path: &Path) -> PathBuf {
    let above = |folder: &&Path| folder.as_os_str().is_empty() || folder.exists();
    let folder = path.ancestors().skip(1).find(above).unwrap_or(Path::new(""));
    folder.join(path.file_name().unwrap_or_default())
}

/// What to say of a name that does not tell what is written.
pub fn wrong_ending(path: &Path, endings: &[&str]) -> Option<String> {
    let fits = |ending: &&str| path.extension().is_some_and(|extension| extension == *ending);
    // of a folder it is said later that it is one
    if path.is_dir() || endings.iter().any(fits) {
        return None;
    }
    let all: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
    let example = path.with_extension(endings.first().copied().unwrap_or_default());
    let example = example.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Some(format!("{}: give a name that ends in {}, e.g. {example}", path.display(), all.join(" or ")))
}

/// How a name ends that says of a file what it is.
fn file_ending(path: &Path) -> Option<&'static str> {
    let ending = path.extension()?;
    FILE_ENDINGS.into_iter().find(|known| ending.eq_ignore_ascii_case(known))
}

/// Refuses a name for a shard that says that it is something else.
///
/// # Errors
/// [`JobError::Usage`] for such a name.
pub fn check_shard_name(path: &Path) -> Result<(), JobError> {
    file_ending(path).map_or(Ok(()), |ending| {
        let name = path.display();
        Err(JobError::Usage(format!(
            "{name}: a shard is a file of analysis rows: give a name that does not end in .{ending}"
        )))
    })
}

/// Whether both paths lead to one file, by whatever names and links.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    let same = matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other);
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let identity = |path: &Path| std::fs::metadata(path).map(|metadata| (metadata.dev(), metadata.ino())).ok();
        same || identity(one).is_some_and(|one| identity(other) == Some(one))
    }
    #[cfg(not(unix))]
    same
}

/// A file beside the result at `result` and named after it: `site.h5` and `urs.csv` make `site.urs.csv`. Of a result
/// that was given another ending the whole name stays: `site.v2` does not write where `site.h5` does.
pub fn beside(result: &Path, ending: &str) -> PathBuf {
    if result.extension().is_some_and(|extension| extension == "h5") {
        return result.with_extension(ending);
    }
    let mut name = result.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{ending}"));
    result.with_file_name(name)
}

/// What this program says of itself in a file.
pub fn mark() -> String {
    format!("uplift {}", crate::VERSION_AND_COMMIT)
}

/// [`mark`] and a description of what a file holds, without line breaks.
pub fn marked(what: impl Display) -> String {
    format!("{}; {what}", mark()).replace(['\n', '\r'], " ")
}

/// Makes a folder for what is to be written, and those above it.
///
/// # Errors
/// A place where no folder can be.
pub fn provide_folder(folder: &Path) -> Result<(), JobError> {
    std::fs::create_dir_all(folder).map_err(|error| io_error(folder, "create the folder")(error).into())
}

/// Whether the file at `path` says that this program made it of the result at `result`, or of one that lay there.
pub fn is_of_result(path: &Path, result: &Path) -> bool {
    let Some(name) = result.file_name().and_then(|name| name.to_str()) else { return false };
    let escaped = name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    said_of(path).is_some_and(|said| {
        let spaceless = without_spaces(&said);
        let ours = MARKS.iter().any(|mark| contains(&said, mark))
            || [JSON_MARK, metadata::MARK].iter().any(|mark| contains(&spaceless, mark));
        ours && (names_result(&said, name) || names_result(&said, &escaped))
    })
}

/// Whether the file at `path` says that it has the numbers of a study of this digest.
pub fn is_of_digest(path: &Path, digest: &str) -> bool {
    said_of(path).is_some_and(|said| contains(&said, format!("study digest {digest}").as_bytes()))
}

/// The digest of the study whose numbers the file at `path` has, where it says so.
pub fn digest_said(path: &Path) -> Option<String> {
    const WORDS: &[u8] = b"study digest ";
    let said = said_of(path)?;
    let at = said.windows(WORDS.len()).position(|window| window == WORDS)?;
    let digest = said[at + WORDS.len()..].iter().take_while(|byte| byte.is_ascii_hexdigit());
    Some(digest.map(|&byte| char::from(byte)).collect::<String>()).filter(|digest| !digest.is_empty())
}

/// What the file at `path` says of itself, and what stands beside it if it is a table.
fn said_of(path: &Path) -> Option<Vec<u8>> {
    let head = head_of(path)?;
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("xlsx") => workbook_properties(path),
        Some("csv") => Some([head, head_of(&metadata_path(path)).unwrap_or_default()].concat()),
        _ => Some(head),
    }
}

/// The first bytes of the file at `path`, those of texts of two bytes a letter without the second; none where there is
/// no file.
fn head_of(path: &Path) -> Option<Vec<u8>> {
    // of a folder or a device it is said later that nothing can be written there
    std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file)?;
    let mut head = Vec::new();
    // what cannot be read is nobody's that is known
    let _ = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    head.retain(|byte| *byte != 0);
    Some(head)
}

/// The properties of the workbook at `path`, as text; none where it has none.
fn workbook_properties(path: &Path) -> Option<Vec<u8>> {
    let mut archive = zip::ZipArchive::new(File::open(path).ok()?).ok()?;
    let mut text = Vec::new();
    archive.by_name("docProps/core.xml").ok()?.take(HEAD).read_to_end(&mut text).ok()?;
    Some(text)
}

/// Whether a head says that its file is of this result, and not of one whose name merely ends or begins alike.
fn names_result(head: &[u8], result: &str) -> bool {
    ["; ", "result ", "structure ", "/", "\\"].iter().any(|before| {
        let words = [before.as_bytes(), result.as_bytes()].concat();
        let ends = |at: usize| match head.get(at + words.len()) {
            // in a PNG a checksum follows, which may look like anything
            _ if head.starts_with(b"\x89PNG") => true,
            None => true,
            Some(byte) => !(byte.is_ascii_alphanumeric() || b"._-".contains(byte)),
        };
        head.windows(words.len()).enumerate().any(|(at, window)| window == words && ends(at))
    })
}

/// Whether the first bytes of a file are those of one that this program put beside a table.
fn is_metadata(head: &[u8]) -> bool {
    let text = without_spaces(head);
    text.starts_with(b"{") && contains(&text, metadata::MARK)
}

fn contains(head: &[u8], words: &[u8]) -> bool {
    head.windows(words.len()).any(|window| window == words)
}

fn without_spaces(head: &[u8]) -> Vec<u8> {
    head.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect()
}

#[cfg(test)]
mod tests;
