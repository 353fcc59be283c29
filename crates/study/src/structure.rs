//! A structure file: a rocking structure as TOML, checked as a study is.
//!
//! Which keys belong to which kind is told in [`uplift_structure::description`], and those of its table `[restrainer]`
//! in [`uplift_statics::description`]. A restrained frame gives `tendon_stiffness_n_m` and `tendon_anchorage`, a linear
//! restrainer, or that table: then the equivalent oscillator gets the stiffness with which it has the displacement
//! capacity of the exact law, and the same file serves statics, design and risk. `column_shape` and `f_cd_pa` are of
//! the columns' section. A table `[uncertainty]` says what of the equivalent oscillator is not known exactly.

use std::path::{Path, PathBuf};

use uplift_plausible::{CONCRETE_STRENGTH, UPLIFT_DISPLACEMENT};
use uplift_statics::{Parts, RestrainedColumns, Restrainer, StaticsError, TendonPath};
use uplift_structure::{
    Anchorage, EquivalentSystem, Kind, Reference, RotatingBlock, StructureDescription, StructureError,
    UncertainQuantity,
};

use crate::error::StudyError;
use crate::reading::findings::refused;
use crate::reading::other_file::Wanted;
use crate::reading::text::{parse_table, read_text};
use crate::reading::{Field, Finding, Findings, Origin, Rule, Section, Table, Value};
use crate::sections::uncertainty::{self, Described, Doubt, Uncertainty};
use crate::warning::Warning;
use restrainer::ReadRestrainer;
pub use restrainer::RestrainerFile;

mod restrainer;
mod rocking;

/// What a number must be is judged by the description.
const ANY: Rule = Rule::Is { holds: |_| true, words: "finite" };
const REFERENCES: [(&str, Reference); 2] = [("top", Reference::Top), ("centre", Reference::Centre)];
const SHAPES: [(&str, ColumnShape); 2] = [("cylinder", ColumnShape::Cylinder), ("rectangle", ColumnShape::Rectangle)];
const ANCHORAGES: [(&str, Anchorage); 2] = [("foundation", Anchorage::Foundation), ("column", Anchorage::Column)];

/// Section of a column whose width is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColumnShape {
    /// A circle of that diameter.
    Cylinder,
    /// A square.
    #[default]
    Rectangle,
}

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

/// A mistake of the description, or of its restrainer.
enum Mistake {
    Structure(StructureError),
    Restrainer(StaticsError),
}

impl Mistake {
    /// The mistake with its place; none where its cause is among those `found`.
    fn finding(&self, document: &Table, found: &[Finding]) -> Option<Finding> {
        let table = |of: &Table, key: &str| of.get(key).and_then(|entry| entry.node.table()).cloned();
        let restrainer = || table(document, "restrainer");
        let (keys, message, places) = match self {
            Self::Structure(mistake) => (mistake.keys(), mistake.to_string(), vec![(String::new(), document.clone())]),
            Self::Restrainer(mistake) => {
                let stopper = restrainer().and_then(|within| table(&within, "stopper"));
                let mut places = Vec::new();
                // a key of the stopper may have the name of one of the restrainer: then it is the stopper's gap or rods
                places.extend(stopper.map(|within| ("restrainer.stopper.".to_owned(), within)));
                places.extend(restrainer().map(|within| ("restrainer.".to_owned(), within)));
                places.push((String::new(), document.clone()));
                (mistake.keys(), mistake.to_string(), places)
            }
        };
        let told = |key: &&str| {
            places.iter().any(|(path, _)| found.iter().any(|finding| finding.key == format!("{path}{key}")))
        };
        if keys.iter().any(told) {
            return None;
        }
        let place = keys.first().and_then(|key| places.iter().find_map(|(_, within)| within.get(key)));
        let header = matches!(self, Self::Restrainer(_)).then(|| document.get("restrainer")).flatten();
        let origin = place
            .map(|entry| entry.node.origin.clone())
            .or(header.map(|entry| entry.key_origin.clone()))
            .unwrap_or(Origin::Study);
        Some(Finding { key: String::new(), origin, message, help: None })
    }
}

/// Everything that a file says, before it is judged.
struct ReadStructure {
    description: StructureDescription,
    restrainer: Option<ReadRestrainer>,
    column_shape: ColumnShape,
    f_cd_pa: Option<f64>,
}

impl ReadStructure {
    fn resolve(mut self, file: &Path) -> Result<Structure, Vec<Mistake>> {
        let mut mistakes = Vec::new();
        let held = self.restrainer.as_ref().and_then(|restrainer| restrainer.description).map(|of| of.resolve());
        let held = match held.transpose() {
            Ok(held) => held.flatten(),
            Err(found) => {
                mistakes.extend(found.into_iter().map(Mistake::Restrainer));
                None
            }
        };
        let mut columns = None;
        if self.restrainer.is_some() {
            // a stiffness that passes until the law has one
            self.description.tendon_stiffness_n_m = Some(0.0);
            self.description.tendon_anchorage = Some(match held.as_ref().map(|(_, path)| path) {
                Some(TendonPath::Foundation) => Anchorage::Foundation,
                _ => Anchorage::Column,
            });
            match held.and_then(|held| self.restrained(held)).transpose() {
                Ok(Some((held, stiffness_n_m))) => {
                    columns = Some(held);
                    self.description.tendon_stiffness_n_m = Some(stiffness_n_m);
                }
                Ok(None) => {}
                Err(mistake) => mistakes.push(Mistake::Restrainer(mistake)),
            }
        }
        let system = self.description.resolve();
        let block = self.description.rotating_block();
        let (system, block) = match (system, block) {
            (Ok(system), Ok(block)) if mistakes.is_empty() => (system, block),
            (system, block) => {
                let found = system.err().or(block.err().map(|mistake| vec![mistake]));
                mistakes.extend(found.into_iter().flatten().map(Mistake::Structure));
                return Err(mistakes);
            }
        };
        let columns = match columns {
            None => self.linearly_restrained().map_err(|mistake| vec![Mistake::Restrainer(mistake)])?,
            columns => columns,
        };
        Ok(Structure {
            file: file.to_owned(),
            text: String::new(),
            warnings: self.description.unlikely().iter().map(Warning::unlikely).collect(),
            description: self.description,
            system,
            block,
            columns,
            column_shape: self.column_shape,
            f_cd_pa: self.f_cd_pa,
            uncertainty: None,
        })
    }

    /// The columns with their restrainer, and the stiffness of the equivalent linear one; none where the columns
    /// themselves are not yet right.
    fn restrained(
        &self,
        (restrainer, path): (Restrainer, TendonPath),
    ) -> Option<Result<(RestrainedColumns, f64), StaticsError>> {
        let free = self.free_columns()?;
        let held = free.and_then(|free| free.with_restrainer(restrainer, path));
        Some(held.and_then(|held| {
            let stiffness_n_m = held.equivalent_stiffness_n_m()?;
            Ok((held, stiffness_n_m))
        }))
    }

    /// Columns of a free frame, of one with a linear restrainer, or the one column that a block is; none for what has
    /// no columns.
    fn linearly_restrained(&self) -> Result<Option<RestrainedColumns>, StaticsError> {
        let Some(free) = self.free_columns().transpose()? else { return Ok(None) };
        match (self.description.tendon_stiffness_n_m, self.description.tendon_anchorage) {
            (Some(stiffness_n_m), Some(anchorage)) => {
                let path = match anchorage {
                    Anchorage::Foundation => TendonPath::Foundation,
                    Anchorage::Column => TendonPath::Column,
                };
                free.with_restrainer(Restrainer::new(Parts::linear(stiffness_n_m))?, path).map(Some)
            }
            _ => Ok(Some(free)),
        }
    }

    /// The columns without restrainers: `P` is the share of the deck's weight. A block is one column that carries
    /// nothing. None for another structure, and where a number is missing.
    fn free_columns(&self) -> Option<Result<RestrainedColumns, StaticsError>> {
        let of = &self.description;
        let gravity_m_s2 = of.gravity_m_s2.unwrap_or(uplift_oscillator::STANDARD_GRAVITY_M_S2);
        let geometry = of.geometry().ok()?;
        let (columns, deck_kg, column_kg) = match of.kind {
            Kind::Block if of.displacement_of != Some(Reference::Centre) => (1, 0.0, of.mass_kg?),
            Kind::Frame | Kind::RestrainedFrame => {
                (of.columns.filter(|&columns| columns > 0)?, of.deck_mass_kg?, of.column_mass_kg?)
            }
            _ => return None,
        };
        let top_load_n = deck_kg * gravity_m_s2 / f64::from(columns);
        Some(RestrainedColumns::new(geometry, columns, top_load_n, column_kg * gravity_m_s2))
    }
}

/// Reads every key; none where the kind is missing or unknown. A value of the wrong type counts as not given.
fn read(mut root: Section<'_>) -> Option<ReadStructure> {
    let kinds = Kind::ALL.map(|kind| (kind.name(), kind));
    let kind = if let Some(field) = root.field("kind") {
        field.choice(&kinds)
    } else {
        let words: Vec<&str> = kinds.iter().map(|(word, _)| *word).collect();
        root.mistake(
            "kind",
            "what kind of structure is this?",
            format!("write kind = and one of \"{}\"", words.join("\", \"")),
        );
        None
    };
    let mut number = |key, unit| root.field(key).and_then(|field: Field<'_>| field.number(unit, ANY));
    let description = StructureDescription {
        kind: kind.unwrap_or(Kind::Block),
        width_m: number("width_m", "m"),
        height_m: number("height_m", "m"),
        centre_height_m: number("centre_height_m", "m"),
        slenderness_rad: number("slenderness_rad", "rad"),
        slenderness_deg: number("slenderness_deg", "degrees"),
        size_m: number("size_m", "m"),
        mass_kg: number("mass_kg", "kg"),
        moment_of_inertia_kg_m2: number("moment_of_inertia_kg_m2", "kg m2"),
        column_mass_kg: number("column_mass_kg", "kg"),
        deck_mass_kg: number("deck_mass_kg", "kg"),
        tendon_stiffness_n_m: number("tendon_stiffness_n_m", "N/m"),
        curvature_radius_m: number("curvature_radius_m", "m"),
        extended_width_m: number("extended_width_m", "m"),
        gravity_m_s2: number("gravity_m_s2", "m/s2"),
        restitution: number("restitution", ""),
        uplift_displacement_m: root
            .field("uplift_displacement_m")
            .and_then(|field| field.number("m", Rule::Within(UPLIFT_DISPLACEMENT))),
        columns: root
            .field("columns")
            .and_then(|field| field.integer(0, u64::from(u32::MAX)))
            .and_then(|columns| u32::try_from(columns).ok()),
        displacement_of: root.field("displacement_of").and_then(|field| field.choice(&REFERENCES)),
        tendon_anchorage: root.field("tendon_anchorage").and_then(|field| field.choice(&ANCHORAGES)),
    };
    let restrainer = restrainer::read(&mut root, &description);
    let column_shape = root.choice_or("column_shape", &SHAPES, ColumnShape::default()).unwrap_or_default();
    let f_cd_pa = root.field("f_cd_pa").and_then(|field| field.number("Pa", Rule::Within(CONCRETE_STRENGTH)));
    // it is read when the structure is known, whose values are its means
    root.section("uncertainty");
    root.finish();
    kind.map(|_| ReadStructure { description, restrainer, column_shape, f_cd_pa })
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
            quantity == UncertainQuantity::UpliftDisplacement && structure.description.uplift_displacement_m.is_none();
        match quantity.value(&structure.system, structure.description.restitution) {
            Some(value) if is_assumed => Described::Assumed(value),
            Some(value) => Described::As(value),
            None if quantity == UncertainQuantity::Capacity => {
                Described::Impossible("the force of this structure does not fall after uplift: it has no capacity")
            }
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
