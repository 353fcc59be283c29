//! The section `[regression]`: the fit of Eq. 4.11.

use serde::Serialize;
use uplift_plausible::STRENGTH;

use crate::keys::{Key, SectionKeys};
use crate::reading::{Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys {
    section: "regression",
    keys: &[Key {
        names: &["strength_above"],
        meaning: "only strengths above this take part in the fit of Eq. 4.11",
        default: "0.05",
        range: "0 to 100; a warning if fewer than 4 strengths are left",
    }],
};

/// The fit of Eq. 4.11.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Regression {
    /// Only strengths above this take part \[-\].
    pub strength_above: f64,
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Regression> {
    let strength_above = section.number_or("strength_above", "", Rule::Within(STRENGTH), 0.05);
    section.finish();
    Some(Regression { strength_above: strength_above? })
}
