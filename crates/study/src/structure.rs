//! A structure file: a rocking structure as TOML, checked as a study is.
//!
//! Which keys belong to which kind is reported in [`uplift_structure::description`], and those of its table
//! `[restrainer]` in [`uplift_statics::description`]. A restrained frame gives `tendon_stiffness_n_m` and
//! `tendon_anchorage`, a linear restrainer, or that table: then the equivalent oscillator gets the stiffness with which
//! it has the displacement capacity of the exact law, and the same file serves statics, design and risk. `column_shape`
//! and `f_cd_pa` are of the columns' section. A table `[uncertainty]` says what of the equivalent oscillator is not
//! known exactly.

use std::path::{Path, PathBuf};

pub use uplift_frame::ColumnShape;
use uplift_statics::RestrainedColumns;
use uplift_structure::{EquivalentSystem, Kind, RotatingBlock, StructureDescription, UncertainQuantity};

use crate::error::StudyError;
use crate::reading::findings::refused;
use crate::reading::other_file::Wanted;
use crate::reading::text::{parse_table, read_text};
use crate::reading::{Finding, Findings, Origin, Section, Table, Value};
use crate::sections::uncertainty::{self, Described, Doubt, Uncertainty};
use crate::warning::Warning;
pub(crate) use keys::KEYS;
use keys::read;
use resolve::Mistake;
pub use restrainer::RestrainerFile;

mod keys;
mod resolve;
mod restrainer;
mod rocking;
mod varied;

/// A structure with the oscillator that it is equivalent to.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// The file it was read from.
    pub file: PathBuf,
    /// What stands in it.
    pub text: String,
    /// As written.
    pub description: StructureDescription,
    /// The equivalent oscillator (Table 3.1).
    pub system: EquivalentSystem,
    /// The solitary block that rotates exactly as the structure; none for one with tendons or curved ends.
    pub block: Option<RotatingBlock>,
    /// Columns and restrainers, by exact statics; none for a point mass, a body of any shape and curved ends.
    pub columns: Option<RestrainedColumns>,
    /// Section of the columns; a square if the file does not say.
    pub column_shape: ColumnShape,
    /// Design strength of the columns' concrete, Pa.
    pub f_cd_pa: Option<f64>,
    /// Tilt whose energy is that of a wobbling frame at rest, rad; that of the model where none is given.
    pub rest_amplitude_rad: Option<f64>,
    /// Velocity of a wobbling frame after passing the upright over the one before; 1, no loss, where none is given.
    pub wobbling_restitution: Option<f64>,
    /// What of the equivalent oscillator is not known exactly; none where all of it is.
    pub uncertainty: Option<Uncertainty>,
    /// What is allowed but probably not meant.
    pub warnings: Vec<Warning>,
}

impl Structure {
    /// Reads the structure file `file`.
    ///
    /// # Errors
    /// [`StudyError`] with every mistake of the file; those of TOML syntax come alone, and one that takes several
    /// correct quantities to see, such as a capacity below the uplift displacement, is found once those are mended.
    pub fn load(file: &Path) -> Result<Self, StudyError> {
        Self::parse(file, read_text(file, Wanted::Structure)?)
    }

    /// Parses the `text` of a structure file whose name is, or would be, `file`.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(file: &Path, text: String) -> Result<Self, StudyError> {
        let document = parse_table(file, &text)?;
        if let Some(reason) = Wanted::Structure.refusal_of_table(&document) {
            return Err(StudyError::unreadable(file, reason));
        }
        let findings = Findings::default();
        let read = read(Section::root(&document, &findings));
        let mut findings = findings.into_vec();
        let resolved = read.map(|read| read.resolve(file));
        let (uncertainty, of_uncertainty, doubts) = read_uncertainty(&document, resolved.as_ref());
        findings.extend(of_uncertainty);
        if let Some(resolved) = resolved {
            match resolved {
                Ok(mut structure) if findings.is_empty() => {
                    structure.warnings.extend(doubts.iter().map(|doubt| asked_about(doubt, &text)));
                    return Ok(Self { text, uncertainty, ..structure });
                }
                Ok(_) => {}
                Err(mistakes) => {
                    let judged =
                        mistakes.iter().filter_map(|mistake| mistake.finding(&document, &findings)).collect::<Vec<_>>();
                    findings.extend(judged);
                }
            }
        }
        Err(refused(file, text, findings, &[]))
    }

    /// Whether `file` is TOML of a structure, right or wrong, by the kind that it says.
    pub fn is_written_in(file: &Path) -> bool {
        let document = read_text(file, Wanted::Structure).and_then(|text| parse_table(file, &text));
        document.is_ok_and(|document| {
            let kind = document.get("kind").map(|entry| &entry.node.value);
            Kind::ALL.iter().any(|known| matches!(kind, Some(Value::Text(kind)) if kind == known.name()))
        })
    }

    /// Name for people: that of the file.
    pub fn name(&self) -> String {
        self.file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// Reads `[uncertainty]`, what is wrong with it, and what is doubtful; the means that are not given are those of the
/// structure.
fn read_uncertainty(
    document: &Table,
    resolved: Option<&Result<Structure, Vec<Mistake>>>,
) -> (Option<Uncertainty>, Vec<Finding>, Vec<Doubt>) {
    let described = |quantity: UncertainQuantity| {
        let Some(Ok(structure)) = resolved else { return Described::Mistaken };
        let is_assumed =
            quantity == UncertainQuantity::UpliftDisplacement && structure.description.assumes_uplift_displacement();
        match quantity.value(&structure.system, structure.description.restitution) {
            Some(value) if is_assumed => Described::Assumed(value),
            Some(value) => Described::As(value),
            None if quantity == UncertainQuantity::Capacity => Described::NoCapacity,
            None => Described::Open,
        }
    };
    let (findings, mut doubts) = (Findings::default(), Vec::new());
    let table = document.get("uncertainty").filter(|entry| entry.node.table().is_some());
    let read = table.and_then(|_| {
        let section = Section::root(document, &findings).section("uncertainty");
        uncertainty::read(section, &described, &mut doubts)
    });
    (read, findings.into_vec(), doubts)
}

/// A doubtful number with its line in the `text` of the file.
fn asked_about(doubt: &Doubt, text: &str) -> Warning {
    let place = match &doubt.origin {
        Origin::File(span) => format!("line {}, ", text[..span.start].lines().count().max(1)),
        Origin::Override(_) | Origin::Study => String::new(),
    };
    let Doubt { key, what, .. } = doubt;
    Warning {
        unlikely: true,
        ..Warning::new(format!("{place}{key}{what}"), format!("correct {key}, or leave it if it is meant"))
    }
}
