//! A hazard curve of a site: its file, and what its numbers mean.

use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_hazard::{CurveUnit, Declared, table_text, years_in_table};
use uplift_motion::IntensityMeasure;
use uplift_plausible::YEARS;

use super::branches::{self, Branch, MOST_BRANCHES};
use super::measures::MeasureKeys;
use crate::keys::{self, Choice, File, Key, Number, Special, choice, file, number, special};
use crate::reading::{Field, Paths, Rule, Section, Value};

pub(super) const KEYS: &[&dyn keys::Declared] = &[&FILE, &UNIT, &KIND, &OF_YEARS, &BRANCHES];
pub(super) const FILE: Key<File> =
    file("file").without_default("needed without `branches`").meaning("the curve").note("existing file");
const UNIT: Key<Special> = special("unit", || json!({ "type": "string", "minLength": 1 }))
    .without_default(
        "as the file says, else `\"cm/s\"` for PGV, CAV and the Arias intensity, `\"g\"` for PGA and spectral \
         accelerations, `\"cm\"` for PGD and SI",
    )
    .meaning("unit of its levels")
    .note("`\"cm/s\"`, `\"m/s\"`, `\"g s\"` (CAV); `\"g\"`, `\"m/s2\"`, `\"cm/s2\"`; `\"cm\"`, `\"m\"`");
const KIND: Key<Choice<bool>> = choice("kind", &[false, true], |is_poe| if is_poe { "poe" } else { "maf" })
    .with_default(false)
    .meaning("what it gives: `\"maf\"`, mean annual frequencies, 1/yr; `\"poe\"`, probabilities of exceedance");
const OF_YEARS: Key<Number> = number("years", "yr", Rule::Within(YEARS))
    .without_default("needed for `\"poe\"`")
    .meaning("time that the probabilities refer to, yr")
    .note("only for `\"poe\"`");
pub(super) const BRANCHES: Key<Special> = special("branches", || json!({ "minItems": 2, "maxItems": MOST_BRANCHES }))
    .without_default("none")
    .meaning(
        "epistemic uncertainty: a list of weighted curves, realizations of a logic tree for instance, of the same \
         kind",
    )
    .note("2 to 1000");

/// A file with a hazard curve, and what its numbers mean.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CurveFile {
    /// The measure.
    #[serde(skip)]
    pub measure: IntensityMeasure,
    /// The file, absolute; none where the mean of the branches is taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Unit of its levels, and of those of the branches that have none of their own.
    #[serde(serialize_with = "write_unit")]
    pub unit: CurveUnit,
    /// What it gives for each level.
    #[serde(flatten)]
    pub kind: CurveKind,
    /// Epistemic uncertainty: weighted alternatives to the curve; none, or two and more whose weights add up to 1.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub branches: Vec<Branch>,
}

impl CurveFile {
    /// Every file with numbers of this curve.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.file.iter().chain(self.branches.iter().map(|branch| &branch.file)).map(PathBuf::as_path)
    }

    /// Unit of the levels in its file at `path`.
    pub fn unit_of(&self, path: &Path) -> CurveUnit {
        self.branches.iter().find(|branch| branch.file == path).and_then(|branch| branch.unit).unwrap_or(self.unit)
    }

    /// The other units that a curve of its measure may have.
    pub fn other_units(&self) -> impl Iterator<Item = CurveUnit> {
        MeasureKeys::from_measure(self.measure).units.iter().copied().filter(|unit| *unit != self.unit)
    }
}

/// What a file gives for each level.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum CurveKind {
    /// The mean annual frequency of exceedance \[1/yr\].
    Maf,
    /// The probability of exceedance \[-\].
    Poe {
        /// Time that it refers to \[yr\].
        years: f64,
    },
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
pub(super) fn write_unit<S: Serializer>(unit: &CurveUnit, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(unit.symbol())
}

/// Reads a curve: a path, or a table.
pub(super) fn read(field: &Field<'_>, measure: IntensityMeasure, paths: &Paths) -> Option<CurveFile> {
    let units = MeasureKeys::from_measure(measure).units;
    match field.node.value {
        Value::Text(_) => {
            let file = paths.input(field)?;
            let (unit, kind) = said(Some(&file), units);
            return Some(CurveFile { measure, file: Some(file), unit, kind, branches: Vec::new() });
        }
        Value::Table(_) => {}
        _ => {
            return field.wrong_type(
                "the path of a hazard curve",
                "write \"path\", or { file = \"path\", unit = …, kind = … }",
            );
        }
    }
    let mut section = field.section();
    let branches = section.given(&BRANCHES).map_or(Some(Vec::new()), |field| branches::read(&field, units, paths));
    let file = match (section.given(&FILE), &branches) {
        (Some(field), _) => paths.input(&field).map(Some),
        // branches with mistakes are still branches
        (None, None) => Some(None),
        (None, Some(branches)) if !branches.is_empty() => Some(None),
        (None, Some(_)) => section.refuse("file", "the curve has no file", "add file = \"path\", or branches = [ … ]"),
    };
    let given = section.given(&UNIT).map(|field| read_unit(&field, units));
    let of_file = file.iter().flatten().next();
    let first = of_file.or(branches.iter().flatten().map(|branch| &branch.file).next()).cloned();
    let (unit_said, kind_said) = said(first.as_deref(), units);
    let kind = kind(&mut section, kind_said);
    section.finish();
    let (file, mut branches, is_given) = (file?, branches?, given.is_some());
    let unit = given.unwrap_or(Some(unit_said))?;
    for branch in &mut branches {
        // where the study says a unit, a file that says another is refused as it is alone
        let own = branch.unit.or_else(|| unit_in(&branch.file, units).filter(|_| !is_given));
        branch.unit = own.filter(|own| *own != unit);
    }
    if let Some(twice) = in_two_units(file.as_deref(), unit, &branches) {
        let file = twice.file.display();
        return field.refuse(format!("{file} is given in two units"), "write one unit for all branches of a file");
    }
    Some(CurveFile { measure, file, unit, kind: kind?, branches })
}

/// A branch whose file is given in another unit elsewhere in the curve.
fn in_two_units<'a>(file: Option<&Path>, unit: CurveUnit, branches: &'a [Branch]) -> Option<&'a Branch> {
    let of = |branch: &Branch| branch.unit.unwrap_or(unit);
    let is_other = |own: &Branch, path: &Path, unit: CurveUnit| own.file == path && of(own) != unit;
    branches.iter().find(|own| {
        file.is_some_and(|file| is_other(own, file, unit))
            || branches.iter().any(|other| is_other(own, &other.file, of(other)))
    })
}

/// Unit and kind that a file says itself, else the unit of the measure and annual rates; what is wrong with the file is
/// said where it is read.
fn said(file: Option<&Path>, units: &[CurveUnit]) -> (CurveUnit, CurveKind) {
    let Some(text) = file.and_then(|file| table_text(file).ok()) else { return (units[0], CurveKind::Maf) };
    let unit = unit_in_table(&text, units);
    let years = years_in_table(&text).filter(|years| YEARS.contains(*years));
    let kind = years.map_or(CurveKind::Maf, |years| CurveKind::Poe { years });
    (unit.unwrap_or(units[0]), kind)
}

/// The one of these `units` that a file says itself.
fn unit_in(file: &Path, units: &[CurveUnit]) -> Option<CurveUnit> {
    unit_in_table(&table_text(file).ok()?, units)
}

fn unit_in_table(text: &str, units: &[CurveUnit]) -> Option<CurveUnit> {
    CurveUnit::parse(&Declared::in_table(text).1?).filter(|unit| units.contains(unit))
}

/// A unit as people write it, gal for cm/s2. What is spelt nearly as one is no suggestion: mm/s is not m/s.
pub(super) fn read_unit(field: &Field<'_>, units: &[CurveUnit]) -> Option<CurveUnit> {
    let text = field.text()?;
    CurveUnit::parse(text).filter(|unit| units.contains(unit)).or_else(|| {
        let known: Vec<&str> = units.iter().map(|unit| unit.symbol()).collect();
        let help = format!("it is one of {}: convert levels that are in another", known.join(", "));
        field.refuse(format!("levels in \"{text}\" are not read"), help)
    })
}

/// What the section says, else what the file itself has `said`.
fn kind(section: &mut Section<'_>, said: CurveKind) -> Option<CurveKind> {
    let years_field = section.given(&OF_YEARS);
    let years = years_field.as_ref().map(|field| OF_YEARS.read(field));
    let is_poe = match section.given(&KIND) {
        Some(field) => KIND.read(&field)?,
        None if years.is_none() => return Some(said),
        None => false,
    };
    match (is_poe, years) {
        (true, Some(years)) => Some(CurveKind::Poe { years: years? }),
        (true, None) if said != CurveKind::Maf => Some(said),
        (true, None) => section.refuse(
            "years",
            "the curve gives probabilities, of exceedance in how many years?",
            "add years = 1 or years = 50, as the file says",
        ),
        (false, None) => Some(CurveKind::Maf),
        (false, Some(_)) => years_field?
            .refuse("annual frequencies have no time", "write kind = \"poe\" for probabilities, or leave `years` out"),
    }
}
