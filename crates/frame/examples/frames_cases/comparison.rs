//! Ours against what is expected, with a tolerance.

use serde_json::{Map, Value};

/// What was compared, and what differs.
#[derive(Default)]
pub(crate) struct Comparison {
    /// Everything that differs, in words: quantity, ours, expected, tolerance.
    pub(crate) differences: Vec<String>,
    /// Numbers that were compared.
    pub(crate) compared: usize,
    /// Relative tolerance of [`compare`](Self::compare).
    pub(crate) tolerance: f64,
}

impl Comparison {
    /// `ours` against a number or null, by the relative tolerance.
    pub(crate) fn compare(&mut self, name: &str, ours: Option<f64>, expected: &Value) {
        self.within(name, ours, expected, 0.0, self.tolerance);
    }

    /// `ours` against a number or null, within an absolute or a relative tolerance, whichever is wider.
    pub(crate) fn within(&mut self, name: &str, ours: Option<f64>, expected: &Value, absolute: f64, relative: f64) {
        self.compared += 1;
        let agrees = match (ours, expected) {
            (None, Value::Null) => true,
            (Some(ours), expected) => expected.as_f64().is_some_and(|expected| {
                ours == expected
                    || (ours - expected).abs() <= absolute.max(relative * expected.abs().max(f64::MIN_POSITIVE))
            }),
            (None, _) => false,
        };
        if !agrees {
            let ours = ours.map_or("none".to_owned(), |ours| ours.to_string());
            let tolerance = if absolute > 0.0 { format!("{absolute:e} absolute") } else { format!("{relative:e}") };
            self.differences.push(format!("{name}: {ours} | {expected} | {tolerance}"));
        }
    }

    /// A word against another.
    pub(crate) fn same(&mut self, name: &str, ours: &str, expected: &Value) {
        self.compared += 1;
        if expected.as_str() != Some(ours) {
            self.differences.push(format!("{name}: {ours} | {expected} | the same"));
        }
    }

    /// A name that this program has nothing for.
    pub(crate) fn unknown(&mut self, name: &str) {
        self.differences.push(format!("{name}: not a quantity that is computed here"));
    }
}

/// A number of an object by its name.
pub(crate) fn number(of: &Map<String, Value>, name: &str) -> Option<f64> {
    of.get(name).and_then(Value::as_f64)
}
