//! The section `[bootstrap]`: confidence bands from resampled records.

use serde::{Serialize, Serializer};
use uplift_bootstrap::{Interval, Unit};
use uplift_plausible::STRENGTH;

use crate::keys::{Boolean, Choice, Integer, Key, List, Number, SectionKeys, boolean, choice, integer, number};
use crate::reading::{Field, Rule, Section, optional};

pub(super) const KEYS: SectionKeys = SectionKeys::new(
    "bootstrap",
    &[&SIZES, &REPLICATES, &CONFIDENCE, &INTERVAL, &UNIT, &SIMULTANEOUS, &STRENGTH_ABOVE],
);
const SIZES: Key<List<Integer>> = integer("sizes", 1, LARGEST_SIZE)
    .list()
    .without_default("20, 40, 60, 80 as far as the set has more, and the whole set")
    .meaning("records in a sample, a list")
    .note("each once");
const REPLICATES: Key<Integer> =
    integer("replicates", 1, MOST_REPLICATES).with_default(1000).meaning("samples of each size");
const CONFIDENCE: Key<Number> =
    number("confidence", "", ABOVE_0_BELOW_1).with_default(0.9).meaning("share of the replicates between the limits");
const INTERVAL: Key<Choice<Interval>> = choice("interval", &Interval::ALL, Interval::key)
    .with_default(Interval::Percentile)
    .meaning("`\"percentile\"`, or `\"bca\"`: bias-corrected and accelerated");
const UNIT: Key<Choice<Unit>> = choice("unit", &Unit::ALL, Unit::key).with_default(Unit::Record).meaning(
    "what is drawn: `\"record\"`, or with all their records `\"pair\"` or `\"event\"`, earthquakes: as many as have so \
     many records on average; where each azimuth of a pair is a record, `\"pair\"` in place of `\"record\"`",
);
const SIMULTANEOUS: Key<Boolean> = boolean("simultaneous")
    .with_default(false)
    .meaning("also bands that hold whole spectra; keeps all replicates in memory, 8 bytes an ordinate");
const STRENGTH_ABOVE: Key<Number> = number("strength_above", "", Rule::Within(STRENGTH))
    .with_default(0.0)
    .meaning("only strengths above this count in e_median and r_90CI");

/// Most replicates of one size.
const MOST_REPLICATES: u64 = 1_000_000;
/// Largest sample.
const LARGEST_SIZE: u64 = 100_000;
/// Most sizes.
const MOST_SIZES: usize = 100;

const ABOVE_0_BELOW_1: Rule = Rule::Between(0.0, 1.0, "above 0 and below 1 (90 % is 0.9)");

/// The bootstrap over records (Section 4.5).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bootstrap {
    /// Records in a sample; if none, 20, 40, 60 and 80 as far as the set has more, and the whole set.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sizes: Option<Vec<u32>>,
    /// Samples of each size.
    pub replicates: u64,
    /// Share of the replicates between the limits of a band \[-\].
    pub confidence: f64,
    /// How a limit is read from the replicates.
    #[serde(serialize_with = "write_interval")]
    pub interval: Interval,
    /// What is drawn; not written where it is records, as in studies of earlier runs.
    #[serde(serialize_with = "write_unit", skip_serializing_if = "is_record")]
    pub unit: Unit,
    /// Whether bands that hold whole spectra are made too.
    pub simultaneous: bool,
    /// Only strengths above this count in Eq. 4.9 and 4.10 \[-\].
    pub strength_above: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_interval<S: Serializer>(interval: &Interval, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(interval.key())
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_unit<S: Serializer>(unit: &Unit, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(unit.key())
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn is_record(unit: &Unit) -> bool {
    *unit == Unit::Record
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Bootstrap> {
    let sizes = optional(section.given(&SIZES).as_ref(), sizes);
    let replicates = section.read(&REPLICATES);
    let confidence = section.read(&CONFIDENCE);
    let interval = section.read(&INTERVAL);
    let unit = section.read(&UNIT);
    let simultaneous = section.read(&SIMULTANEOUS);
    let strength_above = section.read(&STRENGTH_ABOVE);
    section.finish();
    Some(Bootstrap {
        sizes: sizes?,
        replicates: replicates?,
        confidence: confidence?,
        interval: interval?,
        unit: unit?,
        simultaneous: simultaneous?,
        strength_above: strength_above?,
    })
}

fn sizes(field: &Field<'_>) -> Option<Vec<u32>> {
    let items = field.items();
    if items.is_empty() || items.len() > MOST_SIZES {
        return field.refuse(
            format!("the list has {} sample sizes", items.len()),
            format!("give 1 to {MOST_SIZES}, e.g. [20, 40, 60]"),
        );
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
