//! The table `[restrainer]` of a structure file, and a file that has nothing else.

use std::path::{Path, PathBuf};

use uplift_statics::{
    Restrainer, RestrainerDescription, RestrainerKind, StopperDescription, TendonAnchorage, TendonPath, WhenFlat,
};
use uplift_structure::{Kind, StructureDescription};

use super::{ANY, Mistake};
use crate::error::StudyError;
use crate::reading::findings::refused;
use crate::reading::other_file::Wanted;
use crate::reading::text::{parse_table, read_text};
use crate::reading::{Findings, Section};

const WHEN_FLAT: [(&str, WhenFlat); 2] = [("tendon", WhenFlat::Tendon), ("stop", WhenFlat::Stop)];
/// Most discs of a stack, in either sense; more is a slip.
const MOST_DISCS: u64 = 10_000;

/// The table as read; what does not go together is judged by the description.
pub(super) struct ReadRestrainer {
    /// None where the table does not say of what kind it is.
    pub(super) description: Option<RestrainerDescription>,
}

/// A restrainer by itself: a file with the table `[restrainer]`, of a structure or alone.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainerFile {
    /// The file it was read from.
    pub file: PathBuf,
    /// As written.
    pub description: RestrainerDescription,
    /// What it is.
    pub restrainer: Restrainer,
    /// Where its tendon runs.
    pub path: TendonPath,
}

impl RestrainerFile {
    /// Reads the table `[restrainer]` of `file`, whatever else stands there.
    ///
    /// # Errors
    /// [`StudyError`] with every mistake of the table.
    pub fn load(file: &Path) -> Result<Self, StudyError> {
        let text = read_text(file, Wanted::Structure)?;
        let document = parse_table(file, &text)?;
        let findings = Findings::default();
        let mut root = Section::root(&document, &findings);
        let section = root.section("restrainer");
        if !section.is_present() && root.field("restrainer").is_none() {
            if root.field("tendon_stiffness_n_m").is_some() {
                let help = "to see its line, write [restrainer], kind = \"linear\" and stiffness_n_m in their place";
                let found = "the file has no table [restrainer]: its tendons are told by `tendon_stiffness_n_m`";
                root.mistake("tendon_stiffness_n_m", found, help);
            } else {
                let help = "write [restrainer] and its kind: \"linear\", \"tendon\" or \"disc-springs\"";
                root.mistake("restrainer", "the file has no restrainer", help);
            }
        }
        let description = read_section(section);
        let mut findings = findings.into_vec();
        match description.map(|description| (description, description.resolve())) {
            Some((description, Ok(Some((restrainer, path))))) if findings.is_empty() => {
                return Ok(Self { file: file.to_owned(), description, restrainer, path });
            }
            Some((_, Ok(None))) if findings.is_empty() => {
                return Err(StudyError::unreadable(
                    file,
                    crate::Unreadable::Other {
                        found: "a structure without a restrainer",
                        wanted: "a restrainer",
                        advice: "its kind is \"none\": write \"linear\", \"tendon\" or \"disc-springs\"",
                    },
                ));
            }
            Some((_, Err(mistakes))) => {
                let judged: Vec<_> = mistakes
                    .into_iter()
                    .filter_map(|mistake| Mistake::Restrainer(mistake).finding(&document, &findings))
                    .collect();
                findings.extend(judged);
            }
            _ => {}
        }
        Err(refused(file, text, findings, &[]))
    }

    /// Name for people: that of the file.
    pub fn name(&self) -> String {
        self.file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// Reads `[restrainer]`; none where there is none, or the structure is of a kind without.
pub(super) fn read(root: &mut Section<'_>, structure: &StructureDescription) -> Option<ReadRestrainer> {
    let section = root.section("restrainer");
    if !section.is_present() {
        return None;
    }
    if structure.kind != Kind::RestrainedFrame {
        section.mistake(
            "",
            format!("a restrainer means nothing for kind \"{}\"", structure.kind.name()),
            "write kind = \"restrained-frame\", or leave the table out",
        );
    }
    for (key, given) in [
        ("tendon_stiffness_n_m", structure.tendon_stiffness_n_m.is_some()),
        ("tendon_anchorage", structure.tendon_anchorage.is_some()),
    ] {
        if given {
            root.mistake(
                key,
                format!("`{key}` says what the table [restrainer] says"),
                "leave it out: in the table it is stiffness_n_m of kind \"linear\", and anchorage",
            );
        }
    }
    // of another kind its keys are read nonetheless, so that those that are none are told too
    let description = read_section(section);
    (structure.kind == Kind::RestrainedFrame).then_some(ReadRestrainer { description })
}

fn read_section(mut section: Section<'_>) -> Option<RestrainerDescription> {
    if !section.is_present() {
        return None;
    }
    let kinds = RestrainerKind::ALL.map(|kind| (kind.name(), kind));
    let kind = if let Some(field) = section.field("kind") {
        field.choice(&kinds)
    } else {
        let words = kinds.map(|(word, _)| word).join("\", \"");
        section.mistake("kind", "what kind of restrainer is this?", format!("write kind = and one of \"{words}\""));
        None
    };
    let mut number = |key, unit| section.field(key).and_then(|field| field.number(unit, ANY));
    let mut description = RestrainerDescription {
        kind: kind.unwrap_or_default(),
        stiffness_n_m: number("stiffness_n_m", "N/m"),
        outer_diameter_m: number("outer_diameter_m", "m"),
        inner_diameter_m: number("inner_diameter_m", "m"),
        thickness_m: number("thickness_m", "m"),
        cone_height_m: number("cone_height_m", "m"),
        free_height_m: number("free_height_m", "m"),
        reduced_thickness_m: number("reduced_thickness_m", "m"),
        young_modulus_pa: number("young_modulus_pa", "Pa"),
        poisson: number("poisson", ""),
        tendon_stiffness_n_m: number("tendon_stiffness_n_m", "N/m"),
        tendon_area_m2: number("tendon_area_m2", "m2"),
        tendon_young_modulus_pa: number("tendon_young_modulus_pa", "Pa"),
        tendon_length_m: number("tendon_length_m", "m"),
        tendon_yield_n: number("tendon_yield_n", "N"),
        tendon_failure_n: number("tendon_failure_n", "N"),
        prestress_n: number("prestress_n", "N"),
        slack_m: number("slack_m", "m"),
        duct_gap_m: number("duct_gap_m", "m"),
        ..RestrainerDescription::default()
    };
    let mut count = |key| {
        let field = section.field(key)?;
        u32::try_from(field.integer(1, MOST_DISCS)?).ok()
    };
    description.springs = count("springs");
    description.parallel = count("parallel");
    description.when_flat = section.field("when_flat").and_then(|field| field.choice(&WHEN_FLAT));
    description.anchorage = section.field("anchorage").and_then(|field| field.choice(&TendonAnchorage::ALL));
    description.stopper = stopper(section.section("stopper"));
    section.finish();
    kind.map(|_| description)
}

fn stopper(mut section: Section<'_>) -> Option<StopperDescription> {
    if !section.is_present() {
        return None;
    }
    let mut number = |key, unit| section.field(key).map(|field| field.number(unit, ANY));
    let [gap, stiffness, yields] = [number("gap_m", "m"), number("stiffness_n_m", "N/m"), number("yield_n", "N")];
    for (key, given) in [("gap_m", gap.is_some()), ("stiffness_n_m", stiffness.is_some())] {
        if !given {
            let what = if key == "gap_m" {
                "the deformation of the springs at which it engages, in m"
            } else {
                "EA/L of its rods, in N/m"
            };
            section.mistake(key, format!("a stopper needs `{key}`"), format!("give {what}"));
        }
    }
    section.finish();
    Some(StopperDescription { gap_m: gap??, stiffness_n_m: stiffness??, yield_n: yields.flatten() })
}
