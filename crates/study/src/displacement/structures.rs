//! What a study of displacement spectra shakes: oscillators or blocks.

use super::super::document::Value;
use super::super::grid::{Grid, GridRule};
use super::super::reader::{ABOVE_ZERO, Ledger, Rule, Section, ZERO_OR_MORE, ZERO_TO_ONE, quantity};
use super::super::resolve::{STRENGTHS, UPLIFT_DISPLACEMENT};
use super::lists::capacities;
use super::{BlockFamily, Designed, OscillatorFamily, Structures};

/// Heights 2H \[m\] of Figures 2.9 to 2.12.
const HEIGHTS_M: [&str; 6] = ["2", "4", "10", "20", "80", "1000"];
/// 70 slendernesses tan α, closer where the blocks are slender.
const SLENDERNESSES: [&str; 2] = ["0.005:0.005:0.1", "0.11:0.01:0.6"];
/// The word for Eq. 2.3.
pub(super) const HOUSNER: &str = "Housner";
/// Most structures under each motion; more is a slip of a step.
const MOST_STRUCTURES: usize = 1_000_000;

const HEIGHT: Rule = Rule { holds: |value| (1e-3..=1e6).contains(&value), words: "from 0.001 to 1e6 m" };
const SLENDERNESS: Rule = Rule {
    holds: |value| (1e-5..=1.4).contains(&value),
    words: "from 1e-5 to 1.4; a stockier block does not rock (Eq. 2.3 is negative)",
};

/// Reads `[oscillator]` with `[strengths]`, or `[block]` with `[slenderness]`.
pub(super) fn structures(root: &mut Section<'_>, ledger: &Ledger) -> Option<Structures> {
    let (oscillator, strengths) = (root.section("oscillator"), root.section("strengths"));
    let (block, slenderness) = (root.section("block"), root.section("slenderness"));
    let structures = match (oscillator.is_present(), block.is_present()) {
        (true, true) => {
            block.mistake("", "a study has oscillators or blocks, not both", "keep [oscillator] or [block]");
            return None;
        }
        (false, false) => {
            root.mistake(
                "",
                "the study has nothing to shake",
                "add a section [oscillator] (Chapter 3) or [block] (Chapter 2); it may be empty",
            );
            return None;
        }
        (true, false) => {
            if slenderness.is_present() {
                slenderness.mistake("", "oscillators have no slenderness", "their abscissa is [strengths]");
            }
            Structures::Oscillators(oscillators(oscillator, strengths, ledger)?)
        }
        (false, true) => {
            if strengths.is_present() {
                strengths.mistake("", "blocks have no strength", "their abscissa is [slenderness], tan(alpha)");
            }
            Structures::Blocks(blocks(block, slenderness, ledger)?)
        }
    };
    let count = structures.lines().saturating_mul(structures.abscissa().len());
    if count > MOST_STRUCTURES {
        root.mistake(
            "",
            format!("the lists and grids make {count} structures"),
            format!("take larger steps: at most {MOST_STRUCTURES}"),
        );
        return None;
    }
    Some(structures)
}

fn oscillators(mut section: Section<'_>, mut strengths: Section<'_>, ledger: &Ledger) -> Option<OscillatorFamily> {
    let rule = GridRule { unit: "m", each: UPLIFT_DISPLACEMENT, least_count: 1 };
    let uplift = Grid::of_key(&mut section, "uplift_displacement_m", rule, &["0.0005"], ledger);
    let largest = uplift.as_ref().and_then(|grid| grid.last().copied());
    let capacity = section.field("capacity_m").map_or(Some(vec![f64::INFINITY]), |field| capacities(&field, largest));
    let restitution = section.number_or("restitution", "", ZERO_TO_ONE, 0.95);
    let free_vibration = section.boolean_or("free_vibration", true);
    section.finish();
    let rule = GridRule { unit: "", each: ZERO_OR_MORE, least_count: 1 };
    let values = Grid::of_key(&mut strengths, "values", rule, &STRENGTHS, ledger);
    strengths.finish();
    Some(OscillatorFamily {
        uplift_displacement_m: uplift?,
        capacity_m: capacity?,
        restitution: restitution?,
        free_vibration: free_vibration?,
        strengths: values?,
    })
}

fn blocks(mut section: Section<'_>, mut slenderness: Section<'_>, ledger: &Ledger) -> Option<BlockFamily> {
    let rule = GridRule { unit: "m", each: HEIGHT, least_count: 1 };
    let height = Grid::of_key(&mut section, "height_m", rule, &HEIGHTS_M, ledger);
    let restitution = section.field("restitution").map_or(Some(None), |field| match field.node.value {
        Value::Text(_) => field.choice(&[(HOUSNER, None)]),
        _ => field.number("", ZERO_TO_ONE).map(Some),
    });
    section.finish();
    let rule = GridRule { unit: "", each: SLENDERNESS, least_count: 1 };
    let values = Grid::of_key(&mut slenderness, "values", rule, &SLENDERNESSES, ledger);
    slenderness.finish();
    Some(BlockFamily { height_m: height?, restitution: restitution?, slendernesses: values? })
}

/// What the section `[design]` designs: the columns of Section 3.4.5 and the block of Section 2.4.3 unless it says otherwise.
pub(super) fn designed(
    section: &mut Section<'_>,
    of_blocks: bool,
    structures: Option<&Structures>,
) -> Option<Designed> {
    if of_blocks {
        let height = section.number_or("height_m", "m", HEIGHT, 10.0);
        let endless = section.number_or("endless_height_m", "m", HEIGHT, 1000.0);
        return Some(Designed::Block { height_m: height?, endless_height_m: endless? });
    }
    let width = section.number_or("width_m", "m", ABOVE_ZERO, 1.6);
    let height = section.number_or("height_m", "m", ABOVE_ZERO, 9.6);
    let (width_m, height_m) = (width?, height?);
    if width_m >= height_m {
        section.mistake(
            "width_m",
            format!("a column {} wide and {} high does not rock", quantity(width_m, "m"), quantity(height_m, "m")),
            "give a column that is higher than wide: its strength is tan(width/height)",
        );
        return None;
    }
    if let Some(Structures::Oscillators(family)) = structures
        && width_m <= family.uplift_displacement_m[0]
    {
        section.mistake(
            "width_m",
            format!(
                "a column of width {}, its capacity, is not above the uplift displacement {}",
                quantity(width_m, "m"),
                quantity(family.uplift_displacement_m[0], "m")
            ),
            "the width of a column is of the order of a metre",
        );
        return None;
    }
    Some(Designed::Bridge { width_m, height_m })
}
