//! The section `[strengths]`: how strong the oscillators are.

use serde::Serializer;
use uplift_plausible::STRENGTH;

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys};
use crate::reading::{Rule, Section};

pub(crate) const KEYS: SectionKeys = SectionKeys {
    section: "strengths",
    keys: &[Key {
        names: &["values"],
        meaning: "uplift strengths η = f_up/(m g), a grid",
        default: "`\"0:1/300:1\"`, 301 values",
        range: "0 to 100",
    }],
};

/// What a grid of strengths must be.
pub(crate) const RULE: GridRule = GridRule { unit: "", each: Rule::Within(STRENGTH), least_count: 1 };

/// Reads the section.
pub(crate) fn read(mut section: Section<'_>) -> Option<Grid> {
    let strengths = Grid::of_key(&mut section, "values", RULE, &["0:1/300:1"]);
    section.finish();
    strengths
}

/// A section whose only key is `values`, as a study file has it.
pub(crate) fn write<S: Serializer>(values: &Grid, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map([("values", values)])
}
