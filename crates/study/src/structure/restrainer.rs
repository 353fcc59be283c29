//! The table `[restrainer]` of a structure file, and a file that has nothing else.

use std::path::{Path, PathBuf};

use uplift_statics::{
    Restrainer, RestrainerDescription, RestrainerKind, StopperDescription, TendonAnchorage, TendonPath, WhenFlat,
};
use uplift_structure::{Kind, StructureDescription};

use super::resolve::Mistake;
use crate::error::StudyError;
use crate::keys::{self, ANY, Choice, Integer, Key, Number, SectionKeys, choice, integer, number};
use crate::reading::findings::refused;
use crate::reading::other_file::Wanted;
use crate::reading::text::{parse_table, read_text};
use crate::reading::{Findings, Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys::new(
    "restrainer",
    &[
        &KIND,
        &STIFFNESS_N_M,
        &OUTER_DIAMETER_M,
        &INNER_DIAMETER_M,
        &THICKNESS_M,
        &CONE_HEIGHT_M,
        &FREE_HEIGHT_M,
        &REDUCED_THICKNESS_M,
        &SPRINGS,
        &PARALLEL,
        &YOUNG_MODULUS_PA,
        &POISSON,
        &TENDON_STIFFNESS_N_M,
        &TENDON_AREA_M2,
        &TENDON_LENGTH_M,
        &TENDON_YOUNG_MODULUS_PA,
        &TENDON_YIELD_N,
        &TENDON_FAILURE_N,
        &ANCHORAGE,
        &DUCT_GAP_M,
        &PRESTRESS_N,
        &SLACK_M,
        &WHEN_FLAT,
    ],
);
const KIND: Key<Choice<RestrainerKind>> = choice("kind", &RestrainerKind::ALL, RestrainerKind::name)
    .meaning("what holds each column: a spring of constant stiffness, a bare tendon, or a stack of disc springs");
const STIFFNESS_N_M: Key<Number> = judged("stiffness_n_m", "N/m").meaning("stiffness of a `linear` restrainer, N/m");
const OUTER_DIAMETER_M: Key<Number> = judged("outer_diameter_m", "m").meaning("outer diameter D_e of a disc spring, m");
const INNER_DIAMETER_M: Key<Number> = judged("inner_diameter_m", "m").meaning("inner diameter D_i, m");
const THICKNESS_M: Key<Number> = judged("thickness_m", "m").meaning("thickness t, m");
const CONE_HEIGHT_M: Key<Number> = judged("cone_height_m", "m").meaning("cone height h_0, m");
const FREE_HEIGHT_M: Key<Number> =
    judged("free_height_m", "m").meaning("free height l_0 = h_0 + t, in place of the cone height, m");
const REDUCED_THICKNESS_M: Key<Number> =
    judged("reduced_thickness_m", "m").meaning("thickness t' of discs with contact flats, m");
const YOUNG_MODULUS_PA: Key<Number> =
    judged("young_modulus_pa", "Pa").without_default("206e9").meaning("Young's modulus of the discs, Pa");
const POISSON: Key<Number> = judged("poisson", "").without_default("0.3").meaning("Poisson's ratio of the discs");
const TENDON_STIFFNESS_N_M: Key<Number> =
    judged("tendon_stiffness_n_m", "N/m").meaning("stiffness k_t = EA/ℓ of the tendon, N/m");
const TENDON_AREA_M2: Key<Number> =
    judged("tendon_area_m2", "m2").meaning("area of the tendon, with its length in place of its stiffness, m²");
const TENDON_YOUNG_MODULUS_PA: Key<Number> = judged("tendon_young_modulus_pa", "Pa")
    .without_default("190e9")
    .meaning("Young's modulus of the tendon, with its area, Pa");
const TENDON_LENGTH_M: Key<Number> =
    judged("tendon_length_m", "m").meaning("length ℓ of the tendon, with its area or where it shifts, m");
const TENDON_YIELD_N: Key<Number> =
    judged("tendon_yield_n", "N").meaning("force at which the tendon yields, reported when it is reached, N");
const TENDON_FAILURE_N: Key<Number> =
    judged("tendon_failure_n", "N").meaning("force at which the tendon or its socket fails, reported likewise, N");
const PRESTRESS_N: Key<Number> =
    judged("prestress_n", "N").without_default("0").meaning("force T_0 of the tendon before the column tilts, N");
const SLACK_M: Key<Number> = judged("slack_m", "m")
    .without_default("0")
    .meaning("elongation that a loose nut lets pass, in place of a prestress, m");
const DUCT_GAP_M: Key<Number> =
    judged("duct_gap_m", "m").meaning("where the tendon shifts: half of what the duct is wider, c, m");
const SPRINGS: Key<Integer> =
    integer("springs", 1, MOST_DISCS).without_default("").meaning("discs, or packets of them, in alternate sense, n");
const PARALLEL: Key<Integer> =
    integer("parallel", 1, MOST_DISCS).without_default("1").meaning("discs in the same sense in each packet, i");
const WHEN_FLAT: Key<Choice<WhenFlat>> =
    choice("when_flat", &[WhenFlat::Tendon, WhenFlat::Stop], |when_flat| match when_flat {
        WhenFlat::Tendon => "tendon",
        WhenFlat::Stop => "stop",
    })
    .without_default("`\"tendon\"`")
    .meaning("once the springs are flat the tendon stretches on, or the law ends");
const ANCHORAGE: Key<Choice<TendonAnchorage>> = choice("anchorage", &TendonAnchorage::ALL, TendonAnchorage::name)
    .without_default("`\"column\"`")
    .meaning("where the tendon is anchored, and whether it shifts in its duct");

pub(super) const STOPPER_KEYS: SectionKeys =
    SectionKeys::new("restrainer.stopper", &[&GAP_M, &STOPPER_STIFFNESS_N_M, &YIELD_N]);
const GAP_M: Key<Number> =
    judged("gap_m", "m").needed().meaning("deformation of the springs at which the rods beside them engage, m");
const STOPPER_STIFFNESS_N_M: Key<Number> =
    number("stiffness_n_m", "N/m", ANY).meaning("stiffness k_st = EA/L of all of these rods, N/m");
const YIELD_N: Key<Number> = judged("yield_n", "N").meaning("force F_y at which they yield, N");

/// A number that the description judges.
const fn judged(name: &'static str, unit: &'static str) -> Key<Number> {
    keys::judged(name, unit, |key| RestrainerDescription::range(key).map_or(ANY, Rule::Within))
}

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
            if root.field(TENDON_STIFFNESS_N_M.name).is_some() {
                let help = "to see its line, write [restrainer], kind = \"linear\" and stiffness_n_m in their place";
                let found = "the file has no table [restrainer]: its tendons are given by `tendon_stiffness_n_m`";
                root.mistake(TENDON_STIFFNESS_N_M.name, found, help);
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
                        advice: "its kind is \"none\": write \"linear\", \"tendon\" or \"disc-springs\"".to_owned(),
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
    // of another kind its keys are read nonetheless, so that those that are none are reported too
    let description = read_section(section);
    (structure.kind == Kind::RestrainedFrame).then_some(ReadRestrainer { description })
}

fn read_section(mut section: Section<'_>) -> Option<RestrainerDescription> {
    if !section.is_present() {
        return None;
    }
    let words = RestrainerKind::ALL.map(RestrainerKind::name).join("\", \"");
    let help = format!("write kind = and one of \"{words}\"");
    let kind = section.read_needed(&KIND, "what kind of restrainer is this?", help);
    let mut number = |key: &Key<Number>| section.optional(key).flatten();
    let mut description = RestrainerDescription {
        kind: kind.unwrap_or_default(),
        stiffness_n_m: number(&STIFFNESS_N_M),
        outer_diameter_m: number(&OUTER_DIAMETER_M),
        inner_diameter_m: number(&INNER_DIAMETER_M),
        thickness_m: number(&THICKNESS_M),
        cone_height_m: number(&CONE_HEIGHT_M),
        free_height_m: number(&FREE_HEIGHT_M),
        reduced_thickness_m: number(&REDUCED_THICKNESS_M),
        young_modulus_pa: number(&YOUNG_MODULUS_PA),
        poisson: number(&POISSON),
        tendon_stiffness_n_m: number(&TENDON_STIFFNESS_N_M),
        tendon_area_m2: number(&TENDON_AREA_M2),
        tendon_young_modulus_pa: number(&TENDON_YOUNG_MODULUS_PA),
        tendon_length_m: number(&TENDON_LENGTH_M),
        tendon_yield_n: number(&TENDON_YIELD_N),
        tendon_failure_n: number(&TENDON_FAILURE_N),
        prestress_n: number(&PRESTRESS_N),
        slack_m: number(&SLACK_M),
        duct_gap_m: number(&DUCT_GAP_M),
        ..RestrainerDescription::default()
    };
    let mut count = |key: &Key<Integer>| section.optional(key).flatten().and_then(|count| u32::try_from(count).ok());
    description.springs = count(&SPRINGS);
    description.parallel = count(&PARALLEL);
    description.when_flat = section.optional(&WHEN_FLAT).flatten();
    description.anchorage = section.optional(&ANCHORAGE).flatten();
    description.stopper = stopper(section.section("stopper"));
    section.finish();
    kind.map(|_| description)
}

fn stopper(mut section: Section<'_>) -> Option<StopperDescription> {
    if !section.is_present() {
        return None;
    }
    let help = "give the deformation of the springs at which it engages, in m";
    let gap = section.read_needed(&GAP_M, "a stopper needs `gap_m`", help);
    let help = "give EA/L of its rods, in N/m";
    let stiffness = section.read_needed(&STOPPER_STIFFNESS_N_M, "a stopper needs `stiffness_n_m`", help);
    let yields = section.optional(&YIELD_N).flatten();
    section.finish();
    Some(StopperDescription { gap_m: gap?, stiffness_n_m: stiffness?, yield_n: yields })
}
