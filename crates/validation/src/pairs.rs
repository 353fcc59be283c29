//! Motion by motion: measured and computed peaks of the same motions.

use crate::error::ValidationError;

/// Collapses of pairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Collapses {
    /// In test and model.
    pub both: usize,
    /// In the test alone.
    pub measured_only: usize,
    /// In the model alone.
    pub computed_only: usize,
    /// In neither.
    pub none: usize,
}

/// Statistics of pairs.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Pairs {
    /// Pairs of which both are finite and above 0: those that the logarithms are of.
    pub finite: usize,
    /// Bias, the mean of `ln(computed/measured)` of these; none without one.
    pub log_bias: Option<f64>,
    /// Dispersion, their standard deviation with `n − 1`; none with fewer than two.
    pub log_dispersion: Option<f64>,
    /// Pearson's correlation of the values of finite pairs; none where one of them does not vary.
    pub pearson: Option<f64>,
    /// Spearman's correlation, of the ranks of all pairs, collapses the largest.
    pub spearman: Option<f64>,
    /// Part of all pairs whose ratio lies within 1.5, either way; two collapses agree.
    pub within_1_5: f64,
    /// The same within 2.
    pub within_2: f64,
    /// Collapses.
    pub collapses: Collapses,
}

impl Pairs {
    /// Of values in the order of their motions, collapses +∞.
    ///
    /// # Errors
    /// As many of each, at least one; none NaN or −∞.
    pub fn from_peaks(measured: &[f64], computed: &[f64]) -> Result<Self, ValidationError> {
        check(measured, computed)?;
        let pairs = || measured.iter().copied().zip(computed.iter().copied());
        let (of_measured, of_computed): (Vec<f64>, Vec<f64>) =
            pairs().filter(|(m, c)| m.is_finite() && c.is_finite()).unzip();
        let logarithms = log_ratios(pairs());
        let within = |factor: f64| {
            let agrees = |(m, c): &(f64, f64)| m == c || (c / m <= factor && m / c <= factor);
            pairs().filter(agrees).count() as f64 / measured.len() as f64
        };
        let mut collapses = Collapses::default();
        for (m, c) in pairs() {
            match (m.is_infinite(), c.is_infinite()) {
                (true, true) => collapses.both += 1,
                (true, false) => collapses.measured_only += 1,
                (false, true) => collapses.computed_only += 1,
                (false, false) => collapses.none += 1,
            }
        }
        let (log_bias, log_dispersion) = mean_and_deviation(&logarithms);
        Ok(Self {
            finite: logarithms.len(),
            log_bias,
            log_dispersion,
            pearson: correlation(&of_measured, &of_computed),
            spearman: spearman(measured, computed),
            within_1_5: within(1.5),
            within_2: within(2.0),
            collapses,
        })
    }
}

/// Spearman's correlation: Pearson's of midranks; none where one side does not vary. +∞ has the largest rank.
pub fn spearman(one: &[f64], other: &[f64]) -> Option<f64> {
    correlation(&midranks(one), &midranks(other))
}

/// `ln(computed/measured)` of pairs of which both are finite and above 0.
pub(crate) fn log_ratios(pairs: impl Iterator<Item = (f64, f64)>) -> Vec<f64> {
    let is_usable = |value: f64| value.is_finite() && value > 0.0;
    pairs.filter(|(m, c)| is_usable(*m) && is_usable(*c)).map(|(m, c)| (c / m).ln()).collect()
}

/// Mean, and standard deviation with `n − 1`.
pub(crate) fn mean_and_deviation(values: &[f64]) -> (Option<f64>, Option<f64>) {
    let n = values.len() as f64;
    if values.is_empty() {
        return (None, None);
    }
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (Some(mean), (values.len() > 1).then(|| (squares / (n - 1.0)).sqrt()))
}

pub(crate) fn check(measured: &[f64], computed: &[f64]) -> Result<(), ValidationError> {
    if measured.is_empty() {
        return Err(ValidationError::Empty);
    }
    if measured.len() != computed.len() {
        return Err(ValidationError::Unpaired { measured: measured.len(), computed: computed.len() });
    }
    for values in [measured, computed] {
        if let Some((index, &value)) = values.iter().enumerate().find(|(_, v)| v.is_nan() || **v == f64::NEG_INFINITY) {
            return Err(ValidationError::Value { index, value });
        }
    }
    Ok(())
}

fn correlation(one: &[f64], other: &[f64]) -> Option<f64> {
    let n = one.len() as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / n;
    let (a, b) = (mean(one), mean(other));
    let sum = |f: &dyn Fn(f64, f64) -> f64| one.iter().zip(other).map(|(x, y)| f(x - a, y - b)).sum::<f64>();
    let scale = (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt();
    (scale > 0.0).then(|| (sum(&|x, y| x * y) / scale).clamp(-1.0, 1.0))
}

fn midranks(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    values
        .iter()
        .map(|value| {
            let below = sorted.partition_point(|other| other < value);
            let equal = sorted.partition_point(|other| other <= value) - below;
            below as f64 + 0.5 * (equal + 1) as f64
        })
        .collect()
}
