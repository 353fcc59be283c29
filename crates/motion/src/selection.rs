//! Records that a tool selected for one level of a measure, as the tool writes them.
//!
//! | tool | file | level | record |
//! |---|---|---|---|
//! | haselREC | `…_summary_selection.txt` | its first line | RSN; event and station of ESM |
//! | `CS_Selection` | `Output_File.dat` | not in it | names of its files |
//! | `EzGM` | `GMR_H1_names.txt` or `GMR_names.txt`, `GMR_sf_used.txt` beside it | not in it | names of its files |
//! | Djura | `records_….json` | column of the measure in `Scaled_IMs` | names of its files |

mod cs_selection;
mod djura;
mod ezgm;
mod haselrec;

use std::fmt;
use std::path::Path;

use crate::error::MotionError;
use crate::measure::IntensityMeasure;
use crate::pair::Horizontal;
use crate::read::{bytes_of, decode, excerpt};

/// Largest file of a selection \[bytes\]: one of 1000 records by Djura, which tell the most, has 13 MB.
const LARGEST_FILE_BYTES: u64 = 16 * 1024 * 1024;

/// A tool whose files are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SelectionTool {
    /// haselREC, conditional spectra.
    HaselRec,
    /// `CS_Selection`, conditional spectra.
    CsSelection,
    /// `EzGM`, conditional spectra and code spectra.
    EzGm,
    /// Djura, generalised conditional intensity measures.
    Djura,
}

impl fmt::Display for SelectionTool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::HaselRec => "haselREC",
            Self::CsSelection => "CS_Selection",
            Self::EzGm => "EzGM",
            Self::Djura => "Djura",
        })
    }
}

/// The records of one level.
#[derive(Debug, Clone, PartialEq)]
pub struct SelectedSet {
    /// The tool that wrote the file.
    pub tool: SelectionTool,
    /// The level, in the unit of the measure; none where the file does not say it.
    pub level: Option<f64>,
    /// The records, in the order of the file; at least one.
    pub records: Vec<SelectedRecord>,
}

/// A record of a selection.
#[derive(Debug, Clone, PartialEq)]
pub struct SelectedRecord {
    /// Its line in the file; its place in the lists of a JSON file. Both count from one.
    pub position: usize,
    /// What names it.
    pub name: SelectedName,
    /// Which of its components were selected.
    pub component: SelectedComponent,
    /// What it is multiplied by: a number above zero, with the digits of the file, which say how far it was rounded.
    pub factor: String,
}

/// By what a tool names a record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SelectedName {
    /// Files of its horizontal components, perhaps with folders; one or two.
    Files(Vec<String>),
    /// Record sequence number of PEER.
    SequenceNumber(u64),
    /// Event and station, as ESM calls them.
    EventStation {
        /// The event.
        event: String,
        /// The station's code.
        station: String,
    },
    /// A name of the database.
    Name(String),
}

/// Shortened where it is too long for a message.
impl fmt::Display for SelectedName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Files(files) => f.write_str(&excerpt(&files.join(", "))),
            Self::SequenceNumber(rsn) => write!(f, "RSN {rsn}"),
            Self::EventStation { event, station } => write!(f, "{} at {}", excerpt(event), excerpt(station)),
            Self::Name(name) => f.write_str(&excerpt(name)),
        }
    }
}

/// Which components of a record were selected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SelectedComponent {
    /// Both: the pair.
    Pair,
    /// The one whose file is named.
    OfFile,
    /// One, by its number in the tool's database.
    Numbered(Horizontal),
}

/// Reads the selection at `path` for a level of `measure`, and what lies beside it.
///
/// # Errors
///
/// [`MotionError::Unreadable`], and as [`selection_from`], also above 16 MiB.
pub fn read_selection(path: &Path, measure: IntensityMeasure) -> Result<SelectedSet, MotionError> {
    let bytes = content(path)?;
    let name = path.display().to_string();
    let Some(components) = ezgm::components(path) else { return selection_from(&bytes, &name, measure) };
    let factors = ezgm::factors_beside(path)?;
    let of_factors = content(&factors)?;
    ezgm_selection_from([&bytes, &of_factors], [&name, &factors.display().to_string()], components)
}

fn content(path: &Path) -> Result<Vec<u8>, MotionError> {
    bytes_of(path, LARGEST_FILE_BYTES).map_err(|error| match error {
        MotionError::TooLarge { name, limit_bytes } => {
            wrong(&name, None, format!("more than {limit_bytes} bytes; this cannot be the selection for one level"))
        }
        other => other,
    })
}

/// The selection in `bytes` of one file, told by its content; `name` is the file.
///
/// # Errors
///
/// [`MotionError::Selection`] for what none of the tools writes, numbers that are none, and a file without a record.
pub fn selection_from(bytes: &[u8], name: &str, measure: IntensityMeasure) -> Result<SelectedSet, MotionError> {
    let text = decode(bytes);
    let set = if text.trim_start().starts_with('{') {
        djura::parse(&text, name, measure)
    } else if let Some(header) = text.lines().position(haselrec::is_header) {
        haselrec::parse(&text, name, header)
    } else if let Some(header) = text.lines().position(cs_selection::is_header) {
        cs_selection::parse(&text, name, header)
    } else {
        Err(wrong(
            name,
            None,
            "unknown format; supported: haselREC's …_summary_selection.txt, CS_Selection's Output_File.dat, EzGM's \
             GMR_H1_names.txt or GMR_names.txt, Djura's records_….json",
        ))
    }?;
    with_records(set, name)
}

/// The selection in `EzGM`'s file of names and its file of factors, line by line; `names` are the two files.
///
/// # Errors
///
/// [`MotionError::Selection`] as [`selection_from`], and where one has more lines than the other.
pub fn ezgm_selection_from(
    bytes: [&[u8]; 2],
    names: [&str; 2],
    component: SelectedComponent,
) -> Result<SelectedSet, MotionError> {
    with_records(ezgm::parse(bytes.map(decode), names, component)?, names[0])
}

fn with_records(set: SelectedSet, name: &str) -> Result<SelectedSet, MotionError> {
    if set.records.is_empty() { Err(wrong(name, None, "it names no record")) } else { Ok(set) }
}

fn wrong(name: &str, line: Option<usize>, reason: impl Into<String>) -> MotionError {
    MotionError::Selection { name: name.to_owned(), line, reason: reason.into() }
}

/// `text`, which is a factor of the file `name`, unless it is no number above zero.
fn factor(text: &str, name: &str, line: usize) -> Result<String, MotionError> {
    let text = text.trim();
    if text.parse::<f64>().is_ok_and(|factor| factor.is_finite() && factor > 0.0) {
        return Ok(text.to_owned());
    }
    Err(wrong(name, Some(line), format!("the scale factor is {:?}: a number above 0 is needed", excerpt(text))))
}
