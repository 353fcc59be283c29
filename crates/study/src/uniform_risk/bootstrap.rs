//! The section `[bootstrap]`: confidence bands from resampled records.

use serde::{Serialize, Serializer};
use uplift_bootstrap::{Interval, Unit};
use uplift_plausible::STRENGTH;

use crate::keys::{Key, SectionKeys};
use crate::reading::{Field, Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys {
    section: "bootstrap",
    keys: &[
        Key {
            names: &["sizes"],
            meaning: "records in a sample, a list",
            default: "20, 40, 60, 80 as far as the set has more, and the whole set",
            range: "1 to 100 000, each once",
        },
        Key { names: &["replicates"], meaning: "samples of each size", default: "1000", range: "1 to 1 000 000" },
        Key {
            names: &["confidence"],
            meaning: "share of the replicates between the limits",
            default: "0.9",
            range: "above 0, below 1",
        },
        Key {
            names: &["interval"],
            meaning: "`\"percentile\"`, or `\"bca\"`: bias-corrected and accelerated",
            default: "`\"percentile\"`",
            range: "",
        },
        Key {
            names: &["unit"],
            meaning: "what is drawn: `\"record\"`, or with all their records `\"pair\"` or `\"event\"`, earthquakes: \
                      as many as have so many records on average",
            default: "`\"record\"`; `\"pair\"` where each azimuth of a pair is a record",
            range: "",
        },
        Key {
            names: &["simultaneous"],
            meaning: "also bands that hold whole spectra; keeps all replicates in memory, 8 bytes an ordinate",
            default: "false",
            range: "",
        },
        Key {
            names: &["strength_above"],
            meaning: "only strengths above this count in e_median and r_90CI",
            default: "0",
            range: "0 to 100",
        },
    ],
};

/// Most replicates of one size.
const MOST_REPLICATES: u64 = 1_000_000;
/// Largest sample.
const LARGEST_SIZE: u64 = 100_000;
/// Most sizes.
const MOST_SIZES: usize = 100;

const CONFIDENCE: Rule =
    Rule::Is { holds: |value| value > 0.0 && value < 1.0, words: "above 0 and below 1 (90 % is 0.9)" };

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
    /// What is drawn; not written where it is records, as in studies of before.
    #[serde(serialize_with = "write_unit", skip_serializing_if = "is_record")]
    pub unit: Unit,
    /// Whether bands that hold whole spectra are made too.
    pub simultaneous: bool,
    /// Only strengths above this count in Eq. 4.9 and 4.10 \[-\].
    pub strength_above: f64,
}

impl Default for Bootstrap {
    /// As in Section 4.5: 1000 replicates, 90 % between the limits, percentiles.
    fn default() -> Self {
        Self {
            sizes: None,
            replicates: 1000,
            confidence: 0.9,
            interval: Interval::Percentile,
            unit: Unit::Record,
            simultaneous: false,
            strength_above: 0.0,
        }
    }
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
    let default = Bootstrap::default();
    let sizes = section.field("sizes").map_or(Some(default.sizes), |field| sizes(&field).map(Some));
    let replicates = section.integer_or("replicates", 1..=MOST_REPLICATES, default.replicates);
    let confidence = section.number_or("confidence", "", CONFIDENCE, default.confidence);
    let intervals = Interval::ALL.map(|interval| (interval.key(), interval));
    let interval = section.choice_or("interval", &intervals, default.interval);
    let unit = section.choice_or("unit", &Unit::ALL.map(|unit| (unit.key(), unit)), default.unit);
    let simultaneous = section.boolean_or("simultaneous", default.simultaneous);
    let strength_above = section.number_or("strength_above", "", Rule::Within(STRENGTH), default.strength_above);
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
