//! The section `[scaling]`: to what the motions of a set are scaled, and by whose peak.

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_motion::IntensityMeasure::{self, Pga, Pgv};
use uplift_plausible::MULTIPLE;
use uplift_spectra::{ScaledBy, Scaling};

use crate::keys::{Choice, Key, List, SectionKeys, Special, choice, special};
use crate::reading::{Field, Section, Value};

pub(super) const KEYS: SectionKeys = SectionKeys::new("scaling", &[&TO, &BY]);
const TO: Key<List<Special>> = special("to", || json!({ "type": "string", "pattern": TARGET }))
    .list()
    .without_default("`\"unscaled\"` and 0.5, 1, 2 of each")
    .meaning("list of `\"unscaled\"`, `\"0.5 PGA\"`, `\"1 PGV\"`: multiples of the set's median")
    .note("each once; multiples 1e-4 to 10000");
const EACH_BY: Key<Choice<ScaledBy>> = choice("by", &ScaledBy::ALL, ScaledBy::key);
const BY: Key<List<Choice<ScaledBy>>> = EACH_BY
    .list()
    .with_default(&ScaledBy::ALL)
    .meaning("whose peak meets it, one or both of `\"component\"`, `\"record\"`");
/// What is read as a target, capitals aside.
const TARGET: &str = r"^\s*([uU][nN][sS][cC][aA][lL][eE][dD]|[-+0-9.eE]+\s*[pP][gG][aAvV])\s*$";

/// How the motions of a set are scaled.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScalingPlan {
    /// To what; at least one.
    pub to: Vec<ScaledTo>,
    /// By whose peak; at least one.
    #[serde(serialize_with = "write_by")]
    pub by: Vec<ScaledBy>,
}

impl ScalingPlan {
    /// The ways of scaling that differ, and which of them each combination `[to][by]` is: motions that are not scaled
    /// are the same whosever peak it would be.
    pub fn ways(&self) -> (Vec<Scaling>, Vec<usize>) {
        let mut ways: Vec<Scaling> = Vec::new();
        let mut places = Vec::new();
        for (&to, &by) in self.to.iter().flat_map(|to| self.by.iter().map(move |by| (to, by))) {
            let way = match to {
                ScaledTo::Unscaled => Scaling::Unscaled,
                ScaledTo::Median { multiple, measure } => Scaling::To { measure, multiple, by },
            };
            places.push(ways.iter().position(|known| *known == way).unwrap_or_else(|| {
                ways.push(way);
                ways.len() - 1
            }));
        }
        (ways, places)
    }
}

/// What the motions of a set are scaled to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScaledTo {
    /// As recorded.
    Unscaled,
    /// A multiple of the set's median peak (Eq. 2.16, 2.17).
    Median {
        /// The multiple.
        multiple: f64,
        /// Of which peak.
        measure: IntensityMeasure,
    },
}

impl std::fmt::Display for ScaledTo {
    /// `unscaled`, or `0.5 PGA`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unscaled => f.write_str("unscaled"),
            Self::Median { multiple, measure } => write!(f, "{multiple} {}", measure.label()),
        }
    }
}

impl ScaledTo {
    /// Reads `unscaled`, `0.5 PGA` or `0.5PGA`, capitals aside; none for anything else.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim().to_lowercase();
        if text == "unscaled" {
            return Some(Self::Unscaled);
        }
        IntensityMeasure::OF_CHAPTER_4.into_iter().find_map(|measure| {
            let multiple: f64 = text.strip_suffix(measure.key())?.trim().parse().ok()?;
            MULTIPLE.contains(multiple).then_some(Self::Median { multiple, measure })
        })
    }
}

/// As `to` has it in a study file.
impl Serialize for ScaledTo {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

fn write_by<S: Serializer>(by: &[ScaledBy], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(by.iter().map(|by| by.key()))
}

/// The seven of Figures 2.10 to 2.12; Chapter 3 leaves the first one out.
fn default_targets() -> Vec<ScaledTo> {
    let to = |measure| [0.5, 1.0, 2.0].map(|multiple| ScaledTo::Median { multiple, measure });
    [ScaledTo::Unscaled].into_iter().chain(to(Pga)).chain(to(Pgv)).collect()
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<ScalingPlan> {
    let to = section.given(&TO).map_or_else(|| Some(default_targets()), |field| list(&field, target));
    let by = section
        .given(&BY)
        .map_or_else(|| BY.default().map(<[ScaledBy]>::to_vec), |field| list(&field, |item| EACH_BY.read(item)));
    section.finish();
    Some(ScalingPlan { to: to?, by: by? })
}

fn target(item: &Field<'_>) -> Option<ScaledTo> {
    const HELP: &str =
        "write \"unscaled\", or a multiple, 1e-4 to 10000, of the set's median peak: \"0.5 PGA\", \"1 PGV\"";
    let Value::Text(text) = &item.node.value else {
        return item.wrong_type("a scaling", HELP);
    };
    ScaledTo::parse(text).or_else(|| item.refuse(format!("{} is not a scaling", item.node.describe()), HELP))
}

/// A list of which no item is given twice.
fn list<T: PartialEq>(field: &Field<'_>, read: impl Fn(&Field<'_>) -> Option<T>) -> Option<Vec<T>> {
    let mut complete = true;
    let mut found: Vec<T> = Vec::new();
    for item in field.few_items()? {
        match read(&item) {
            Some(new) if found.contains(&new) => {
                item.mistake(format!("{} is given twice", item.node.describe()), "give each once");
                complete = false;
            }
            Some(new) => found.push(new),
            None => complete = false,
        }
    }
    complete.then_some(found)
}
