//! A structure file: a rocking structure as TOML, checked as a study is.
//!
//! Which keys belong to which kind is told in [`uplift_structure::description`].

use std::path::{Path, PathBuf};

use uplift_plausible::UPLIFT_DISPLACEMENT;
use uplift_structure::{
    Anchorage, EquivalentSystem, Kind, Reference, RotatingBlock, StructureDescription, StructureError,
};

use crate::error::StudyError;
use crate::reading::findings::refused;
use crate::reading::other_file::Wanted;
use crate::reading::text::{parse_table, read_text};
use crate::reading::{Field, Finding, Findings, Origin, Rule, Section, Table};
use crate::warning::Warning;

/// What a number must be is judged by the description.
const ANY: Rule = Rule::Is { holds: |_| true, words: "finite" };
const REFERENCES: [(&str, Reference); 2] = [("top", Reference::Top), ("centre", Reference::Centre)];
const ANCHORAGES: [(&str, Anchorage); 2] = [("foundation", Anchorage::Foundation), ("column", Anchorage::Column)];

/// A structure with the oscillator that it is equivalent to.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// The file it was read from.
    pub file: PathBuf,
    /// As written.
    pub description: StructureDescription,
    /// The equivalent oscillator (Table 3.1).
    pub system: EquivalentSystem,
    /// The solitary block that rotates exactly as the structure; none for one with tendons or curved ends.
    pub block: Option<RotatingBlock>,
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
        let text = read_text(file, Wanted::Structure)?;
        let document = parse_table(file, &text)?;
        if let Some(reason) = Wanted::Structure.refusal_of_table(&document) {
            return Err(StudyError::unreadable(file, reason));
        }
        let findings = Findings::default();
        let description = read(Section::root(&document, &findings));
        let mut findings = findings.into_vec();
        if let Some(description) = description {
            match resolve(&description) {
                Ok((system, block)) if findings.is_empty() => {
                    let warnings = description.unlikely().iter().map(Warning::unlikely).collect();
                    return Ok(Self { file: file.to_owned(), description, system, block, warnings });
                }
                Ok(_) => {}
                Err(mistakes) => {
                    let judged = mistakes
                        .iter()
                        .filter_map(|mistake| finding(mistake, &document, &findings))
                        .collect::<Vec<_>>();
                    findings.extend(judged);
                }
            }
        }
        Err(refused(file, text, findings, &[]))
    }

    /// Name for people: that of the file.
    pub fn name(&self) -> String {
        self.file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }
}

fn resolve(
    description: &StructureDescription,
) -> Result<(EquivalentSystem, Option<RotatingBlock>), Vec<StructureError>> {
    let system = description.resolve()?;
    let block = description.rotating_block().map_err(|mistake| vec![mistake])?;
    Ok((system, block))
}

/// Reads every key; none where the kind is missing or unknown. A value of the wrong type counts as not given.
fn read(mut root: Section<'_>) -> Option<StructureDescription> {
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
    root.finish();
    kind.map(|_| description)
}

/// A mistake of the description with its place; none where its cause is among those `found`.
fn finding(mistake: &StructureError, document: &Table, found: &[Finding]) -> Option<Finding> {
    let keys = mistake.keys();
    let wrong = |key: &&str| found.iter().any(|finding| finding.key == **key);
    if keys.iter().any(wrong) {
        return None;
    }
    let origin =
        keys.first().and_then(|key| document.get(key)).map_or(Origin::Study, |entry| entry.node.origin.clone());
    Some(Finding { key: String::new(), origin, message: mistake.to_string(), help: None })
}
