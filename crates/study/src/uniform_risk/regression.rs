//! The section `[regression]`: the fit of Eq. 4.11.

use serde::Serialize;
use uplift_plausible::STRENGTH;

use crate::keys::{Key, Number, SectionKeys, number};
use crate::reading::{Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys::new("regression", &[&STRENGTH_ABOVE]);
const STRENGTH_ABOVE: Key<Number> = number("strength_above", "", Rule::Within(STRENGTH))
    .with_default(0.05)
    .meaning("only strengths above this take part in the fit of Eq. 4.11")
    .note("a warning if fewer than 4 strengths are left");

/// The fit of Eq. 4.11.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Regression {
    /// Only strengths above this take part \[-\].
    pub strength_above: f64,
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Regression> {
    let strength_above = section.read(&STRENGTH_ABOVE);
    section.finish();
    Some(Regression { strength_above: strength_above? })
}
