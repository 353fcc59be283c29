//! What a number must satisfy.

use uplift_plausible::{PROBABILITY as PLAUSIBLE_PROBABILITY, RESTITUTION, Range};

/// What a number must satisfy.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rule {
    /// To be plausible.
    Within(Range),
    /// Something else, as a test and in words.
    Is { holds: fn(f64) -> bool, words: &'static str },
}

impl Rule {
    /// Whether a finite `value` satisfies it.
    pub(crate) fn holds(&self, value: f64) -> bool {
        match self {
            Self::Within(range) => range.contains(value),
            Self::Is { holds, .. } => holds(value),
        }
    }

    /// What a number must be, in words.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Within(range) => range.to_string(),
            Self::Is { words, .. } => (*words).to_owned(),
        }
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
