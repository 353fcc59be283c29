//! The sections `[[levels]]`: how strongly the table shakes.

use serde::Serialize;

use crate::keys::{Key, Number, SectionKeys, Shape, Text, number};
use crate::reading::{Field, Rule, Section};
use crate::sections::name;

pub(super) const KEYS: SectionKeys = SectionKeys::new("levels", &[&NAME, &PGV_SRSS_M_S]).shape(Shape::List);
const NAME: Key<Text> = name::KEY.meaning("name of the level").note("each once");
const PGV_SRSS_M_S: Key<Number> = number("pgv_srss_m_s", "m/s", LEVEL).meaning(
    "$\\sqrt{PGV_x^2 + PGV_y^2}$ of both components on the table, m/s (Eq. 6.9); not the geometric mean of other \
     studies",
);

/// As `uplift-frame` takes it.
const LEVEL: Rule =
    Rule::From(1e-6, 1e3, "from 1e-6 to 1000 m/s (in m/s, not in cm/s: the dissertation has 0.1675 and 0.335)");
/// Most levels in one study.
const MOST_LEVELS: usize = 100;

/// A level of shaking.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelPlan {
    /// Its name, of no other level.
    pub name: String,
    /// Root of the sum of squares of both peak velocities on the table \[m/s\] (Eq. 6.9).
    pub pgv_srss_m_s: f64,
}

/// Reads the sections.
pub(super) fn read(root: &mut Section<'_>) -> Option<Vec<LevelPlan>> {
    let Some(field) = root.field("levels") else {
        return root.refuse(
            "levels",
            "how strongly does the table shake?",
            "add a section [[levels]] with name = \"high\" and pgv_srss_m_s = 0.335; or several",
        );
    };
    let mut names = Vec::new();
    field.sections("level", 1..=MOST_LEVELS, |item| level(&item, &mut names))
}

fn level(item: &Field<'_>, names: &mut Vec<String>) -> Option<LevelPlan> {
    let mut section = item.section();
    if !section.is_present() {
        return None;
    }
    let name = name::read(&mut section, "level", "high", names);
    let help = "add pgv_srss_m_s = 0.335, in m/s";
    let pgv = section.read_needed(&PGV_SRSS_M_S, "the level has no velocity", help);
    section.finish();
    Some(LevelPlan { name: name?, pgv_srss_m_s: pgv? })
}
