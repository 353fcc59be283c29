//! What stands at the top of a study file, before its sections.

use uplift_motion::STANDARD_GRAVITY_M_S2;

use crate::keys::Key;
use crate::reading::{Rule, Section};

pub(crate) const KIND: Key = Key {
    names: &["kind"],
    meaning: "what the study is of",
    default: "`\"uniform risk spectra\"`",
    range: "that, `\"displacement spectra\"` or `\"shake table\"`",
};
pub(crate) const TITLE: Key =
    Key { names: &["title"], meaning: "free text, carried into the results", default: "empty", range: "" };
pub(crate) const GRAVITY: Key = Key {
    names: &["gravity_m_s2"],
    meaning: "acceleration of gravity, m/s²",
    default: "9.80665",
    range: "0.1 to 2000; a warning unless 9.7 to 9.9",
};

/// Reads `title`; empty where it is not given.
pub(crate) fn title(root: &mut Section<'_>) -> Option<String> {
    root.field("title").map_or(Some(String::new()), |field| field.text().map(str::to_owned))
}

/// Reads `gravity_m_s2` \[m/s²\].
pub(crate) fn gravity(root: &mut Section<'_>) -> Option<f64> {
    root.number_or("gravity_m_s2", "m/s2", Rule::Within(uplift_plausible::GRAVITY), STANDARD_GRAVITY_M_S2)
}
