//! A range, and a number outside of it.

use std::fmt;

/// From which value to which a quantity is plausible, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The smallest plausible value.
    pub least: f64,
    /// The largest.
    pub most: f64,
    /// Unit of both; empty for a pure number.
    pub unit: &'static str,
    /// What a value outside was probably meant to be, or why it cannot be.
    pub hint: &'static str,
}

/// A number outside of its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Implausible {
    /// What it is called where it was given.
    pub name: &'static str,
    /// The value.
    pub value: f64,
    /// What it may be.
    pub range: Range,
}

/// A number that can be, but is outside of what is usual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unlikely {
    /// What it is called where it was given.
    pub name: &'static str,
    /// The value.
    pub value: f64,
    /// What is usual.
    pub usual: Range,
    /// Of what is no input itself, the inputs that it follows from: `width_m or height_m`.
    pub inputs: Option<&'static str>,
}

impl Range {
    /// Whether `value` lies within; NaN never does.
    pub fn contains(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// `value` if it lies within; `name` is what it is called where it was given.
    ///
    /// # Errors
    /// [`Implausible`] if it does not.
    pub fn check(&self, name: &'static str, value: f64) -> Result<f64, Implausible> {
        if self.contains(value) { Ok(value) } else { Err(Implausible { name, value, range: *self }) }
    }

    /// What is to be said of `value` where this is the usual range and it lies outside.
    pub fn unlikely(&self, name: &'static str, value: f64) -> Option<Unlikely> {
        (!self.contains(value)).then_some(Unlikely { name, value, usual: *self, inputs: None })
    }
}

impl Unlikely {
    /// The same of a number that nobody gives, but that follows from `inputs`: these can be corrected.
    #[must_use]
    pub fn from_inputs(self, inputs: &'static str) -> Self {
        Self { inputs: Some(inputs), ..self }
    }

    /// `correct gravity_m_s2, or leave it if it is meant`; of `the largest of strengths.values` and of `mass_kg over a
    /// volume` the key alone.
    pub fn what_to_do(&self) -> String {
        if let Some(inputs) = self.inputs {
            return format!("correct {inputs}, or leave them if they are meant");
        }
        let key = self.name.rsplit(" of ").next().unwrap_or(self.name);
        let key = key.split(" over ").next().unwrap_or(key);
        format!("correct {key}, or leave it if it is meant")
    }
}

impl fmt::Display for Range {
    /// `from 0.1 to 2000 m/s2 (9.81 on Earth)`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (least, most) = (short_number(self.least), short_number(self.most));
        write!(formatter, "from {least} to {most}{} ({})", after_value(self.unit), self.hint)
    }
}

impl fmt::Display for Implausible {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, range } = self;
        write!(formatter, "{name} is {}{}: it must be {range}", short_number(*value), after_value(range.unit))
    }
}

impl std::error::Error for Implausible {}

impl fmt::Display for Unlikely {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, usual, .. } = self;
        write!(formatter, "{name} is {}{}; usual is {usual}", short_number(*value), after_value(usual.unit))
    }
}

/// A unit as it follows a number: ` m`; nothing of a pure number.
pub fn after_value(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// The shorter of the two ways to write a number: `0.0005`, `1e-6`.
pub fn short_number(value: f64) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-3..1e6).contains(&value.abs());
    if plain { value.to_string() } else { format!("{value:e}") }
}

/// A number of things, named in the singular: `1 level`, `2 levels`.
pub fn counted(count: usize, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGE: Range = Range { least: 0.5, most: 2e7, unit: "m", hint: "millimetres?" };

    #[test]
    fn the_ends_belong_to_it_and_nan_does_not() {
        assert!([0.5, 1.0, 2e7].into_iter().all(|value| RANGE.contains(value)));
        for value in [0.499, 2.001e7, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!RANGE.contains(value) && RANGE.check("width_m", value).is_err(), "{value}");
        }
    }

    #[test]
    fn the_message_names_the_key_to_correct() {
        for (name, key) in [("width_m", "width_m"), ("the largest of strengths.values", "strengths.values")] {
            let told = RANGE.unlikely(name, 0.1).map(|found| found.what_to_do());
            assert_eq!(told, Some(format!("correct {key}, or leave it if it is meant")));
        }
    }

    #[test]
    fn what_is_no_input_is_not_to_be_corrected() {
        let found = RANGE.unlikely("the rotation", 0.1).map(|found| found.from_inputs("width_m or height_m"));
        let told = found.map(|found| found.what_to_do());
        assert_eq!(told.as_deref(), Some("correct width_m or height_m, or leave them if they are meant"));
    }

    #[test]
    fn a_refusal_has_range_value_unit_and_hint() {
        let refused = Implausible { name: "width_m", value: 1e-9, range: RANGE };
        assert_eq!(refused.to_string(), "width_m is 1e-9 m: it must be from 0.5 to 2e7 m (millimetres?)");
    }
}
