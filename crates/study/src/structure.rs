//! A structure file: a rocking structure as TOML, checked as a study is.
//!
//! Which keys belong to which kind is reported in [`uplift_structure::description`], and those of its table
//! `[restrainer]` in [`uplift_statics::description`]. A restrained frame gives `tendon_stiffness_n_m` and
//! `tendon_anchorage`, a linear restrainer, or that table: then the equivalent oscillator gets the stiffness with which
//! it has the displacement capacity of the exact law, and the same file serves statics, design and risk. `column_shape`
//! and `f_cd_pa` are of the columns' section. A table `[uncertainty]` says what of the equivalent oscillator is not
//! known exactly.

use std::path::{Path, PathBuf};

use serde_json::json;
use uplift_plausible::{CONCRETE_STRENGTH, UPLIFT_DISPLACEMENT};
use uplift_statics::{Parts, RestrainedColumns, Restrainer, StaticsError, TendonPath};
use uplift_structure::{
    Allowed, Anchorage, EquivalentSystem, Kind, Reference, RotatingBlock, StructureDescription, StructureError,
    UncertainQuantity,
};

use crate::error::StudyError;
use crate::keys::{self, Choice, Judged, Key, Number, SectionKeys, Special, choice, number, special};
use crate::reading::findings::refused;
use crate::reading::other_file::Wanted;
use crate::reading::text::{parse_table, read_text};
use crate::reading::{Finding, Findings, Origin, Rule, Section, Table, Value};
use crate::sections::uncertainty::{self, Described, Doubt, Uncertainty};
use crate::shake_table::REST;
use crate::warning::Warning;
use restrainer::ReadRestrainer;
pub use restrainer::RestrainerFile;

mod restrainer;
mod rocking;
mod varied;

/// The keys of a structure file, section by section.
pub(crate) const KEYS: [SectionKeys; 6] = [
    SectionKeys::new(
        "",
        &[
            &KIND,
            &WIDTH_M,
            &HEIGHT_M,
            &CENTRE_HEIGHT_M,
            &SLENDERNESS_RAD,
            &SLENDERNESS_DEG,
            &SIZE_M,
            &MASS_KG,
            &MOMENT_OF_INERTIA_KG_M2,
            &DISPLACEMENT_OF,
            &COLUMNS,
            &COLUMN_MASS_KG,
            &DECK_MASS_KG,
            &TENDON_STIFFNESS_N_M,
            &TENDON_ANCHORAGE,
            &CURVATURE_RADIUS_M,
            &EXTENDED_WIDTH_M,
            &UPLIFT_DISPLACEMENT_M,
            &PERIOD_S,
            &GRAVITY_M_S2,
            &RESTITUTION,
            &COLUMN_SHAPE,
            &F_CD_PA,
            &REST_AMPLITUDE_RAD,
            &WOBBLING_RESTITUTION,
        ],
    ),
    restrainer::KEYS,
    restrainer::STOPPER_KEYS,
    uncertainty::KEYS,
    uncertainty::QUANTITY_KEYS,
    uncertainty::CORRELATION_KEYS,
];
const KIND: Key<Choice<Kind>> = choice("kind", &Kind::ALL, Kind::name).meaning("what kind of structure it is");
const WIDTH_M: Key<Judged> = judged("width_m", "m").meaning("width 2b of the block or column, m");
const HEIGHT_M: Key<Judged> = judged("height_m", "m").meaning("height 2h of the block or column, m");
const CENTRE_HEIGHT_M: Key<Judged> = judged("centre_height_m", "m")
    .meaning("height h of the mass centre of a `point-mass` or a `body`, in place of `height_m`, m");
const SLENDERNESS_RAD: Key<Judged> =
    judged("slenderness_rad", "rad").meaning("slenderness α with one length, in place of two lengths, rad");
const SLENDERNESS_DEG: Key<Judged> =
    judged("slenderness_deg", "degrees").meaning("the same in degrees, in place of `slenderness_rad`");
const SIZE_M: Key<Judged> =
    judged("size_m", "m").meaning("distance R from the pivot corner to the mass centre, with a slenderness, m");
const MASS_KG: Key<Judged> = judged("mass_kg", "kg").meaning("mass of a `point-mass`, `block` or `body`, kg");
const MOMENT_OF_INERTIA_KG_M2: Key<Judged> = judged("moment_of_inertia_kg_m2", "kg m2")
    .meaning("moment of inertia I_o of a `body` about the pivot corner, kg m²");
const DISPLACEMENT_OF: Key<Choice<Reference>> =
    choice("displacement_of", &[Reference::Top, Reference::Centre], |reference| match reference {
        Reference::Top => "top",
        Reference::Centre => "centre",
    })
    .without_default("`\"top\"`")
    .meaning("point of a `block` whose displacement is followed");
const COLUMNS: Key<Special> =
    special("columns", || json!({ "type": "integer", "minimum": 1, "maximum": uplift_plausible::COLUMNS.most }))
        .without_default("")
        .meaning("number of columns of a frame")
        .note("1 to 1e6");
const COLUMN_MASS_KG: Key<Judged> = judged("column_mass_kg", "kg").meaning("mass of one column of a frame, kg");
const DECK_MASS_KG: Key<Judged> = judged("deck_mass_kg", "kg").meaning("mass of the deck of a frame, kg");
const TENDON_STIFFNESS_N_M: Key<Judged> = judged("tendon_stiffness_n_m", "N/m").meaning(
    "stiffness of the tendon and springs of one column of a `restrained-frame`, in series, N/m; or a table \
     `[restrainer]`",
);
const TENDON_ANCHORAGE: Key<Choice<Anchorage>> =
    choice("tendon_anchorage", &[Anchorage::Foundation, Anchorage::Column], |anchorage| match anchorage {
        Anchorage::Foundation => "foundation",
        Anchorage::Column => "column",
    })
    .without_default("")
    .meaning("where these tendons are anchored");
const CURVATURE_RADIUS_M: Key<Judged> =
    judged("curvature_radius_m", "m").meaning("radius r of the curved ends of a `curved-frame`, m");
const EXTENDED_WIDTH_M: Key<Judged> =
    judged("extended_width_m", "m").meaning("width 2b' of the end of such a column with its extensions, m");
const UPLIFT_DISPLACEMENT_M: Key<Number> = number("uplift_displacement_m", "m", Rule::Within(UPLIFT_DISPLACEMENT))
    .without_default("0.0005")
    .meaning("displacement at uplift u_up, m");
const PERIOD_S: Key<Judged> =
    judged("period_s", "s").meaning("period T with closed joints, in place of `uplift_displacement_m`, s");
const GRAVITY_M_S2: Key<Judged> =
    judged("gravity_m_s2", "m/s2").without_default("9.80665").meaning("acceleration of gravity, m/s²");
const RESTITUTION: Key<Judged> = judged("restitution", "")
    .without_default("that of the study")
    .meaning("velocity after an impact divided by the one before");
const COLUMN_SHAPE: Key<Choice<ColumnShape>> =
    choice("column_shape", &[ColumnShape::Cylinder, ColumnShape::Rectangle], |shape| match shape {
        ColumnShape::Cylinder => "cylinder",
        ColumnShape::Rectangle => "rectangle",
    })
    .with_default(ColumnShape::Rectangle)
    .meaning("section of the columns");
const F_CD_PA: Key<Number> = number("f_cd_pa", "Pa", Rule::Within(CONCRETE_STRENGTH))
    .without_default("none")
    .meaning("design strength of the columns' concrete, Pa");
const REST_AMPLITUDE_RAD: Key<Number> = number("rest_amplitude_rad", "rad", REST)
    .without_default("1e-5")
    .meaning("tilt whose energy is that of a wobbling frame at rest, rad");
const WOBBLING_RESTITUTION: Key<Number> = number("wobbling_restitution", "", Rule::From(0.5, 1.0, "from 0.5 to 1"))
    .without_default("1, no loss")
    .meaning("velocity of a wobbling frame after passing the upright divided by the one before");

/// A number that the description judges.
const fn judged(name: &'static str, unit: &'static str) -> Key<Judged> {
    keys::judged(name, unit, |key| match StructureDescription::allowed(key) {
        Some(Allowed::Plausible(range)) => Rule::Within(range),
        Some(Allowed::BelowQuarterTurn(quarter_turn, words)) => Rule::Between(0.0, quarter_turn, words),
        None => keys::ANY,
    })
}

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

/// A mistake of the description, or of its restrainer.
enum Mistake {
    Structure(StructureError),
    Restrainer(StaticsError),
}

impl std::fmt::Display for Mistake {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Structure(mistake) => mistake.fmt(f),
            Self::Restrainer(mistake) => mistake.fmt(f),
        }
    }
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
        let place = keys.iter().find_map(|key| places.iter().find_map(|(_, within)| within.get(key)));
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
    rest_amplitude_rad: Option<f64>,
    wobbling_restitution: Option<f64>,
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
            rest_amplitude_rad: self.rest_amplitude_rad,
            wobbling_restitution: self.wobbling_restitution,
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
    let kind = if let Some(field) = root.given(&KIND) {
        KIND.read(&field)
    } else {
        let words = Kind::ALL.map(Kind::name);
        root.mistake(
            "kind",
            "what kind of structure is this?",
            format!("write kind = and one of \"{}\"", words.join("\", \"")),
        );
        None
    };
    let mut number = |key: &Key<Judged>| root.optional(key).flatten();
    let description = StructureDescription {
        kind: kind.unwrap_or(Kind::Block),
        width_m: number(&WIDTH_M),
        height_m: number(&HEIGHT_M),
        centre_height_m: number(&CENTRE_HEIGHT_M),
        slenderness_rad: number(&SLENDERNESS_RAD),
        slenderness_deg: number(&SLENDERNESS_DEG),
        size_m: number(&SIZE_M),
        mass_kg: number(&MASS_KG),
        moment_of_inertia_kg_m2: number(&MOMENT_OF_INERTIA_KG_M2),
        column_mass_kg: number(&COLUMN_MASS_KG),
        deck_mass_kg: number(&DECK_MASS_KG),
        tendon_stiffness_n_m: number(&TENDON_STIFFNESS_N_M),
        curvature_radius_m: number(&CURVATURE_RADIUS_M),
        extended_width_m: number(&EXTENDED_WIDTH_M),
        period_s: number(&PERIOD_S),
        gravity_m_s2: number(&GRAVITY_M_S2),
        restitution: number(&RESTITUTION),
        uplift_displacement_m: root.optional(&UPLIFT_DISPLACEMENT_M).flatten(),
        columns: root
            .given(&COLUMNS)
            .and_then(|field| field.integer(0, u64::from(u32::MAX)))
            .and_then(|columns| u32::try_from(columns).ok()),
        displacement_of: root.optional(&DISPLACEMENT_OF).flatten(),
        tendon_anchorage: root.optional(&TENDON_ANCHORAGE).flatten(),
    };
    let restrainer = restrainer::read(&mut root, &description);
    let column_shape = root.read(&COLUMN_SHAPE).unwrap_or_default();
    let f_cd_pa = root.optional(&F_CD_PA).flatten();
    let rest_amplitude_rad = root.optional(&REST_AMPLITUDE_RAD).flatten();
    let wobbling_restitution = root.optional(&WOBBLING_RESTITUTION).flatten();
    // it is read when the structure is known, whose values are its means
    root.section("uncertainty");
    root.finish();
    kind.map(|_| ReadStructure {
        description,
        restrainer,
        column_shape,
        f_cd_pa,
        rest_amplitude_rad,
        wobbling_restitution,
    })
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
