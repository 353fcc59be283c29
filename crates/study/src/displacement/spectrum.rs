//! The section `[spectrum]`: which percentiles.

use serde::Serializer;

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys};
use crate::reading::{Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys {
    section: "spectrum",
    keys: &[Key {
        names: &["percentiles"],
        meaning: "percentiles, a grid",
        default: "`[16, 50, 84, 90]`",
        range: "0 to 100",
    }],
};

/// Percentiles \[%\], unless a study says otherwise: the median, one standard deviation of a normal distribution, and
/// that of Chapter 3.
const PERCENTILES: [&str; 4] = ["16", "50", "84", "90"];

/// What a percentile must be.
pub(super) const PERCENT: Rule =
    Rule::Is { holds: |value| (0.0..=100.0).contains(&value), words: "from 0 to 100 (the median is 50)" };

/// The section as a study file has it.
pub(super) fn write<S: Serializer>(percentiles: &Grid, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map([("percentiles", percentiles)])
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Grid> {
    let rule = GridRule { unit: "%", each: PERCENT, least_count: 1 };
    let percentiles = Grid::of_key(&mut section, "percentiles", rule, &PERCENTILES);
    section.finish();
    percentiles
}
