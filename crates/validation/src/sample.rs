//! Values of one kind: peaks, with +∞ for a collapse.

use crate::error::ValidationError;

/// Values, ascending; at least one, none of them NaN or −∞.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    sorted: Vec<f64>,
}

impl Sample {
    /// From values in any order.
    ///
    /// # Errors
    /// There must be a value; each must be finite or +∞.
    pub fn new(values: Vec<f64>) -> Result<Self, ValidationError> {
        if values.is_empty() {
            return Err(ValidationError::Empty);
        }
        if let Some((index, &value)) = values.iter().enumerate().find(|(_, v)| v.is_nan() || **v == f64::NEG_INFINITY) {
            return Err(ValidationError::Value { index, value });
        }
        let mut sorted = values;
        sorted.sort_by(f64::total_cmp);
        Ok(Self { sorted })
    }

    /// The values, ascending.
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// Number of values.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        self.sorted.len()
    }

    /// How many are at most `x`.
    pub fn count_up_to(&self, x: f64) -> usize {
        self.sorted.partition_point(|value| *value <= x)
    }

    /// Part of the values that are at most `x`: the empirical distribution function.
    pub fn cdf(&self, x: f64) -> f64 {
        self.count_up_to(x) as f64 / self.len() as f64
    }

    /// Median: the middle value, or the mean of the middle two; +∞ if one of these is.
    pub fn median(&self) -> f64 {
        median_of_sorted(&self.sorted)
    }

    /// How many are +∞.
    pub fn collapses(&self) -> usize {
        self.sorted.iter().filter(|value| value.is_infinite()).count()
    }

    /// Whether all are finite.
    pub fn is_finite(&self) -> bool {
        self.collapses() == 0
    }
}

/// Median of ascending values.
pub(crate) fn median_of_sorted(sorted: &[f64]) -> f64 {
    let n = sorted.len();
    if n % 2 == 1 { sorted[n / 2] } else { 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]) }
}

/// Distinct values of two samples, ascending, each with how many of either are equal to it.
pub(crate) fn distinct(one: &Sample, other: &Sample) -> Vec<(f64, usize, usize)> {
    let (mut i, mut j) = (0, 0);
    let (a, b) = (one.sorted(), other.sorted());
    let mut found = Vec::with_capacity(a.len() + b.len());
    while i < a.len() || j < b.len() {
        let next = match (a.get(i), b.get(j)) {
            (Some(a), Some(b)) => a.min(*b),
            (Some(only), None) | (None, Some(only)) => *only,
            (None, None) => break,
        };
        let (from_i, from_j) = (i, j);
        i += a[i..].iter().take_while(|value| **value <= next).count();
        j += b[j..].iter().take_while(|value| **value <= next).count();
        found.push((next, i - from_i, j - from_j));
    }
    found
}
