//! The section `[strengths]`: how strong the oscillators are.

use serde::Serializer;
use uplift_plausible::STRENGTH;

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys, grid};
use crate::reading::{Rule, Section};

pub(crate) const KEYS: SectionKeys = SectionKeys::new("strengths", &[&VALUES]);
const VALUES: Key<GridRule> =
    grid("values", RULE).with_default(&["0:1/300:1"]).meaning("uplift strengths η = f_up/(m g), a grid");

/// What a grid of strengths must be.
pub(crate) const RULE: GridRule = GridRule { unit: "", each: Rule::Within(STRENGTH), least_count: 1 };

/// Reads the section.
pub(crate) fn read(mut section: Section<'_>) -> Option<Grid> {
    let strengths = section.read(&VALUES);
    section.finish();
    strengths
}

/// A section whose only key is `values`, as a study file has it.
pub(crate) fn write<S: Serializer>(values: &Grid, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map([(VALUES.name, values)])
}
