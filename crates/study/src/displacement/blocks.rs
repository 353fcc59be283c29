//! The sections `[block]` and `[slenderness]`: families of rigid blocks.

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_plausible::LENGTH;

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys, Special, grid, special};
use crate::reading::{Rule, Section, Value, ZERO_TO_ONE};

pub(super) const KEYS: SectionKeys = SectionKeys::new("block", &[&HEIGHT_M, &RESTITUTION]);
/// By default those of Figures 2.9 to 2.12.
const HEIGHT_M: Key<GridRule> = grid("height_m", GridRule { unit: "m", each: HEIGHT, least_count: 1 })
    .with_default(&["2", "4", "10", "20", "80", "1000"])
    .meaning("heights 2H, a grid, m");
const RESTITUTION: Key<Special> =
    special("restitution", || json!({ "anyOf": [{ "enum": [HOUSNER] }, ZERO_TO_ONE.schema()] }))
        .without_default("`\"Housner\"`")
        .meaning("`\"Housner\"` (Eq. 2.3), or angular velocity after an impact divided by the one before")
        .note("0 to 1");

pub(super) const SLENDERNESS_KEYS: SectionKeys = SectionKeys::new("slenderness", &[&SLENDERNESSES]);
/// By default closer where the blocks are slender.
const SLENDERNESSES: Key<GridRule> = grid("values", GridRule { unit: "", each: SLENDERNESS, least_count: 1 })
    .with_default(&["0.005:0.005:0.1", "0.11:0.01:0.6"])
    .meaning("slendernesses tan α, a grid");

/// The word for Eq. 2.3.
const HOUSNER: &str = "Housner";

/// What the height of a block \[m\] must be.
pub(super) const HEIGHT: Rule = Rule::Within(LENGTH);
const SLENDERNESS: Rule =
    Rule::From(1e-5, 1.4, "from 1e-5 to 1.4; a stockier block does not rock (Eq. 2.3 is negative)");

/// Blocks of every height and slenderness of these.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BlockFamily {
    /// Heights 2H \[m\].
    pub height_m: Grid,
    /// Coefficient of restitution of the angular velocity at each impact \[-\]; Housner's (Eq. 2.3) if none.
    #[serde(serialize_with = "write_restitution")]
    pub restitution: Option<f64>,
    /// Slendernesses tan α \[-\]; the section `[slenderness]`.
    #[serde(skip)]
    pub slendernesses: Grid,
}

#[allow(clippy::ref_option)] // as serde calls it
fn write_restitution<S: Serializer>(restitution: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    match restitution {
        Some(number) => serializer.serialize_f64(*number),
        None => serializer.serialize_str(HOUSNER),
    }
}

/// Reads the section with `[slenderness]`.
pub(super) fn read(mut section: Section<'_>, mut slenderness: Section<'_>) -> Option<BlockFamily> {
    let height = section.read(&HEIGHT_M);
    let restitution = section.given(&RESTITUTION).map_or(Some(None), |field| match field.node.value {
        Value::Text(_) => field.choice(&[(HOUSNER, None)]),
        _ => field.number("", ZERO_TO_ONE).map(Some),
    });
    section.finish();
    let values = slenderness.read(&SLENDERNESSES);
    slenderness.finish();
    Some(BlockFamily { height_m: height?, restitution: restitution?, slendernesses: values? })
}
