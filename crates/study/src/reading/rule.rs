//! What a number must satisfy.

use serde_json::{Map, Value, json};
use uplift_plausible::{PROBABILITY as PLAUSIBLE_PROBABILITY, RESTITUTION, Range, short_number};

use crate::keys::object;

/// What a number must satisfy.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rule {
    /// To be plausible.
    Within(Range),
    /// To lie from one number to another, both included; messages say it in these words.
    From(f64, f64, &'static str),
    /// To lie between two numbers, neither included.
    Between(f64, f64, &'static str),
    /// To be finite, no more.
    Finite(&'static str),
    /// Finite when it is read; judged later by the rule of this name.
    Judged(&'static str, fn(&str) -> Rule),
}

impl Rule {
    /// Whether a finite `value` satisfies it.
    pub(crate) fn holds(&self, value: f64) -> bool {
        match *self {
            Self::Within(range) => range.contains(value),
            Self::From(least, most, _) => (least..=most).contains(&value),
            Self::Between(above, below, _) => value > above && value < below,
            Self::Finite(_) | Self::Judged(..) => true,
        }
    }

    /// What a number must be, in words for messages.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Within(range) => range.to_string(),
            Self::From(_, _, words) | Self::Between(_, _, words) | Self::Finite(words) => (*words).to_owned(),
            Self::Judged(..) => "finite".to_owned(),
        }
    }

    /// What a number must be, for the documentation.
    pub(crate) fn range(&self) -> String {
        match *self {
            Self::Within(Range { least, most, .. }) | Self::From(least, most, _) => {
                format!("{} to {}", short_number(least), short_number(most))
            }
            Self::Between(_, _, words) => words.to_owned(),
            Self::Finite(_) => String::new(),
            Self::Judged(name, rule) => rule(name).range(),
        }
    }

    /// What a number must be, as a JSON Schema.
    pub(crate) fn schema(&self) -> Map<String, Value> {
        object(match *self {
            Self::Within(Range { least, most, .. }) | Self::From(least, most, _) => {
                json!({ "type": "number", "minimum": least, "maximum": most })
            }
            Self::Between(above, below, _) => {
                json!({ "type": "number", "exclusiveMinimum": above, "exclusiveMaximum": below })
            }
            Self::Finite(_) => json!({ "type": "number" }),
            Self::Judged(name, rule) => return rule(name).schema(),
        })
    }
}

pub(crate) const ZERO_TO_ONE: Rule = Rule::Within(RESTITUTION);
pub(crate) const PROBABILITY: Rule = Rule::Within(PLAUSIBLE_PROBABILITY);

/// A number with its unit, for messages.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-6..1e15).contains(&value.abs());
    let number = if plain { value.to_string() } else { format!("{value:e}") };
    format!("{number} {unit}").trim_end().to_owned()
}
