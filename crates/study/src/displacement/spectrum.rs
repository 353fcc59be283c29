//! The section `[spectrum]`: which percentiles.

use serde::Serializer;

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys, grid};
use crate::reading::{Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys::new("spectrum", &[&PERCENTILES]);
/// By default the median, one standard deviation of a normal distribution, and that of Chapter 3.
const PERCENTILES: Key<GridRule> = grid("percentiles", GridRule { unit: "%", each: PERCENT, least_count: 1 })
    .with_default(&["16", "50", "84", "90"])
    .meaning("percentiles, a grid");

/// What a percentile must be.
pub(super) const PERCENT: Rule = Rule::From(0.0, 100.0, "from 0 to 100 (the median is 50)");

/// The section as a study file has it.
pub(super) fn write<S: Serializer>(percentiles: &Grid, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map([(PERCENTILES.name, percentiles)])
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Grid> {
    let percentiles = section.read(&PERCENTILES);
    section.finish();
    percentiles
}
