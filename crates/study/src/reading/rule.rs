//! What a number must satisfy.

/// What a number must satisfy, as a test and in words.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rule {
    pub(crate) holds: fn(f64) -> bool,
    pub(crate) words: &'static str,
}

pub(crate) const ABOVE_ZERO: Rule = Rule { holds: |value| value > 0.0, words: "above zero" };
pub(crate) const ZERO_OR_MORE: Rule = Rule { holds: |value| value >= 0.0, words: "zero or above" };
pub(crate) const ZERO_TO_ONE: Rule = Rule { holds: |value| (0.0..=1.0).contains(&value), words: "between 0 and 1" };
pub(crate) const PROBABILITY: Rule =
    Rule { holds: |value| value > 0.0 && value < 1.0, words: "above 0 and below 1 (10 % is 0.1)" };
/// A micrometre: less is no structure, and an oscillator so stiff that no motion resolves it.
pub(crate) const UPLIFT_DISPLACEMENT: Rule = Rule { holds: |value| value >= 1e-6, words: "1e-6 m or above" };

/// A number with its unit, for messages.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-6..1e15).contains(&value.abs());
    let number = if plain { value.to_string() } else { format!("{value:e}") };
    format!("{number} {unit}").trim_end().to_owned()
}
