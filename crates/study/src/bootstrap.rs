//! The section `[bootstrap]`.

use super::form::INTERVALS;
use super::reader::{Field, Rule, Section, ZERO_OR_MORE};
use super::resolved::Bootstrap;

/// Most replicates of one size.
const MOST_REPLICATES: u64 = 1_000_000;
/// Largest sample.
const LARGEST_SIZE: u64 = 100_000;
/// Most sizes.
const MOST_SIZES: usize = 100;

const CONFIDENCE_RULE: Rule =
    Rule { holds: |value| value > 0.0 && value < 1.0, words: "above 0 and below 1 (90 % is 0.9)" };

pub(super) fn read(mut section: Section<'_>) -> Option<Bootstrap> {
    let default = Bootstrap::default();
    let sizes = section.field("sizes").map_or(Some(default.sizes), |field| sizes(&field).map(Some));
    let replicates =
        section.field("replicates").map_or(Some(default.replicates), |field| field.integer(1, MOST_REPLICATES));
    let confidence = section.number_or("confidence", "", CONFIDENCE_RULE, default.confidence);
    let interval = section.field("interval").map_or(Some(default.interval), |field| field.choice(&INTERVALS));
    let simultaneous = section.boolean_or("simultaneous", default.simultaneous);
    let strength_above = section.number_or("strength_above", "", ZERO_OR_MORE, default.strength_above);
    section.finish();
    Some(Bootstrap {
        sizes: sizes?,
        replicates: replicates?,
        confidence: confidence?,
        interval: interval?,
        simultaneous: simultaneous?,
        strength_above: strength_above?,
    })
}

fn sizes(field: &Field<'_>) -> Option<Vec<u32>> {
    let items = field.items();
    if items.is_empty() || items.len() > MOST_SIZES {
        field.mistake(
            format!("the list has {} sample sizes", items.len()),
            format!("give 1 to {MOST_SIZES}, e.g. [20, 40, 60]"),
        );
        return None;
    }
    let mut sizes = Some(Vec::new());
    for item in &items {
        let size = item.integer(1, LARGEST_SIZE).and_then(|size| u32::try_from(size).ok());
        match (&mut sizes, size) {
            (Some(known), Some(size)) if known.contains(&size) => {
                item.mistake(format!("{size} is given twice"), "give each sample size once");
                sizes = None;
            }
            (Some(known), Some(size)) => known.push(size),
            (_, None) => sizes = None,
            (None, Some(_)) => {}
        }
    }
    sizes
}
