//! The section `[consistency]`: whether the records bring the site's hazard in the other measure, and what is done
//! about it.

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_motion::IntensityMeasure;

use super::measures::cannot_be_scaled_to;
use crate::keys::{Choice, Integer, Key, List, Number, SectionKeys, Special, choice, integer, number, special};
use crate::reading::{Field, Rule, Section, optional};

pub(super) const KEYS: SectionKeys =
    SectionKeys::new("consistency", &[&REPAIR, &AGAINST, &SMOOTHNESS, &LEAST_EFFECTIVE, &SCALE_FACTORS]);
const REPAIR: Key<Choice<Repair>> = choice("repair", &Repair::ALL, Repair::key).with_default(DEFAULT.repair).meaning(
    "`\"weights\"`: spectra with weights of the records by which the set has both hazard curves of a site, beside the \
     plain ones; `\"none\"`: the consistency is checked and not repaired",
);
const AGAINST: Key<Special> = special("against", || json!({ "type": "string", "minLength": 1 }))
    .without_default("PGV, for records scaled to it PGA; where no site has a curve of it, the first measure with one")
    .meaning(
        "the measure whose hazard is compared with what records scaled to another bring, and which a repair honours \
         as well",
    )
    .note("a measure with a curve at a site");
const SMOOTHNESS: Key<Number> = number("smoothness", "", Rule::From(0.001, 10.0, "0.001 to 10 (0.05 is usual)"))
    .with_default(DEFAULT.smoothness)
    .meaning("how much a bend of the weights' exponent over the level counts against the fit");
const LEAST_EFFECTIVE: Key<Integer> = integer("least_effective", 1, MOST_RECORDS)
    .with_default(DEFAULT.least_effective)
    .meaning("effective records below which a repaired spectrum gets a warning");
const SCALE_FACTORS: Key<List<Number>> = number("scale_factors", "", SCALE_FACTOR)
    .list()
    .with_default(&DEFAULT.scale_factors)
    .meaning("scale factors outside of these two are counted; nothing is left out")
    .note("the smaller first");

/// What holds where a study says nothing.
const DEFAULT: Consistency = Consistency {
    repair: Repair::None,
    against: None,
    smoothness: 0.05,
    least_effective: 20,
    scale_factors: [0.2, 5.0],
};

const SCALE_FACTOR: Rule = Rule::From(1e-6, 1e6, "1e-6 to 1e6");
/// Most records of an analysis.
const MOST_RECORDS: u64 = 65_535;

/// What is asked of the records, and done about it (docs/method.md, "Hazard consistency").
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Consistency {
    /// What is done where the records miss the hazard of the other measure.
    pub repair: Repair,
    /// The measure whose hazard is compared where records are scaled to another; none where the study does not say.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "write_measure")]
    pub against: Option<IntensityMeasure>,
    /// Weight of the second differences of the exponent in the fit \[-\].
    pub smoothness: f64,
    /// Effective records below which a warning is raised.
    pub least_effective: u64,
    /// Least and largest scale factor that are not counted as large \[-\].
    pub scale_factors: [f64; 2],
}

/// What is done where the records miss the hazard of the other measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Repair {
    /// Nothing: it is reported.
    None,
    /// Spectra with weights of the records, beside the plain ones.
    Weights,
}

impl Repair {
    /// Every way.
    pub const ALL: [Self; 2] = [Self::None, Self::Weights];

    /// Its word in files and keys: none, weights.
    pub fn key(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Weights => "weights",
        }
    }
}

#[allow(clippy::ref_option, clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_measure<S: Serializer>(measure: &Option<IntensityMeasure>, serializer: S) -> Result<S::Ok, S::Error> {
    measure.map(IntensityMeasure::key).serialize(serializer)
}

impl Default for Consistency {
    fn default() -> Self {
        DEFAULT
    }
}

impl Consistency {
    /// Whether the study says no more than is so without the section: it is then left out where the study is kept, as
    /// it was before there was such a section.
    pub(super) fn is_default(&self) -> bool {
        *self == DEFAULT
    }

    /// The keys besides `repair` whose values differ from those of `other`.
    pub fn differing_keys(&self, other: &Self) -> Vec<&'static str> {
        let keys = [
            ("against", self.against == other.against),
            ("smoothness", self.smoothness.to_bits() == other.smoothness.to_bits()),
            ("least_effective", self.least_effective == other.least_effective),
            ("scale_factors", self.scale_factors.map(f64::to_bits) == other.scale_factors.map(f64::to_bits)),
        ];
        keys.into_iter().filter(|(_, same)| !same).map(|(key, _)| key).collect()
    }
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Consistency> {
    let repair = section.read(&REPAIR);
    let against = optional(section.given(&AGAINST).as_ref(), measure);
    let smoothness = section.read(&SMOOTHNESS);
    let least_effective = section.read(&LEAST_EFFECTIVE);
    let scale_factors =
        section.given(&SCALE_FACTORS).map_or(Some(DEFAULT.scale_factors), |field| scale_factors(&field));
    section.finish();
    Some(Consistency {
        repair: repair?,
        against: against?,
        smoothness: smoothness?,
        least_effective: least_effective?,
        scale_factors: scale_factors?,
    })
}

fn measure(field: &Field<'_>) -> Option<IntensityMeasure> {
    let text = field.filled_text()?;
    match text.parse::<IntensityMeasure>() {
        Ok(measure) if measure.can_be_scaled_to() => Some(measure),
        Ok(measure) => field.refuse(cannot_be_scaled_to(measure), "name another measure"),
        Err(error) => field.refuse(error.to_string(), "write e.g. against = \"sa_1s\""),
    }
}

fn scale_factors(field: &Field<'_>) -> Option<[f64; 2]> {
    let items = field.items();
    let numbers: Vec<f64> = items.iter().filter_map(|item| item.number("", SCALE_FACTOR)).collect();
    if numbers.len() < items.len() {
        return None;
    }
    match numbers[..] {
        [least, largest] if least < largest => Some([least, largest]),
        _ => field.refuse("two factors are needed, the smaller first", "write e.g. scale_factors = [0.2, 5]"),
    }
}
