//! The rates that single records, or earthquakes, bring, summed while the displacement falls.

use crate::SkewedMean;
use crate::skewed_mean::{Deviates, QuickDeviates};

/// The rates W of the units above a displacement that falls, with the sums that their mean and scatter need.
///
/// The mean over all records is Σ W / Σ n, with n records in a unit; a unit deviates from it by (W − mean · n) over the
/// mean number of records in a unit: the linearised ratio of the cluster bootstrap.
#[derive(Debug, Clone)]
pub(crate) struct UnitRates {
    /// The unit of each record.
    unit_of: Vec<usize>,
    /// Records of each unit.
    records: Vec<f64>,
    /// Rate of each unit, 1/yr, times the number of its records.
    rates: Vec<f64>,
    /// Σ W^j n^k, `[j][k]`, for j + k up to 4.
    sums: [[f64; 5]; 5],
    quick: QuickDeviates,
}

impl UnitRates {
    /// Of the records of each unit, `[unit]`; nothing is exceeded yet.
    pub(crate) fn new(units: &[Vec<usize>]) -> Self {
        let records: Vec<f64> = units.iter().map(|records| records.len() as f64).collect();
        let mut sums = [[0.0; 5]; 5];
        for (power, sum) in (0_i32..).zip(&mut sums[0]) {
            *sum = records.iter().map(|n| n.powi(power)).sum();
        }
        let quick = QuickDeviates::new(sums[0][0] / sums[0][1], records.len());
        Self { unit_of: unit_of(units), rates: vec![0.0; records.len()], records, sums, quick }
    }

    /// How many units.
    pub(crate) fn count(&self) -> usize {
        self.records.len()
    }

    /// A run of `record` is exceeded from here on: its stripe weighs `per_year`, 1/yr.
    pub(crate) fn add(&mut self, record: usize, per_year: f64) {
        let unit = self.unit_of[record];
        let (before, n) = (self.rates[unit], self.records[unit]);
        let after = before + per_year;
        let (mut power_before, mut power_after) = (1.0, 1.0);
        for j in 1..5 {
            power_before *= before;
            power_after *= after;
            let mut change = power_after - power_before;
            for sum in &mut self.sums[j][..5 - j] {
                *sum += change;
                change *= n;
            }
        }
        self.rates[unit] = after;
    }

    /// The rate of all records, 1/yr.
    pub(crate) fn per_year(&self) -> f64 {
        self.sums[1][0] / self.sums[0][1]
    }

    /// The rate of all records, 1/yr, with the scatter of the units.
    pub(crate) fn mean(&self) -> SkewedMean {
        let sums = &self.sums;
        let (units, records, mean) = (sums[0][0], sums[0][1], self.per_year());
        // Σ (W − mean n)^p by the binomial theorem
        let power = |p: usize, choose: &[f64]| {
            let mut factor = 1.0;
            let mut sum = 0.0;
            for (k, choose) in choose.iter().enumerate() {
                sum += choose * factor * sums[p - k][k];
                factor *= -mean;
            }
            sum / units * (units / records).powi(i32::try_from(p).unwrap_or(i32::MAX))
        };
        let moments =
            [power(2, &[1.0, 2.0, 1.0]), power(3, &[1.0, 3.0, 3.0, 1.0]), power(4, &[1.0, 4.0, 6.0, 4.0, 1.0])];
        SkewedMean::new(mean, moments, self.count())
    }

    /// The deviates of that mean, to rounding, without what the kurtosis is needed for; none where hardly any unit
    /// scatters.
    pub(crate) fn deviates(&self) -> Option<Deviates> {
        let [[_, records, n2, n3, _], [w, w_n, w_n2, ..], [w2, w2_n, ..], [w3, ..], _] = self.sums;
        let mean = w / records;
        let square = mean * mean;
        // Σ (W − mean n)² and Σ (W − mean n)³
        let second = w2 - 2.0 * mean * w_n + square * n2;
        let third = w3 - mean * (3.0 * w2_n - 3.0 * mean * w_n2 + square * n3);
        self.quick.of(mean, [second, third])
    }
}

/// The unit of each record, of the records of each unit.
pub(crate) fn unit_of(units: &[Vec<usize>]) -> Vec<usize> {
    let mut unit_of = vec![0; units.iter().map(Vec::len).sum()];
    for (unit, records) in units.iter().enumerate() {
        for &record in records {
            unit_of[record] = unit;
        }
    }
    unit_of
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_the_units_written_out() {
        let units = [vec![0, 3], vec![1], vec![2, 4, 5]];
        let mut rates = UnitRates::new(&units);
        for (record, per_year) in [(0, 0.1), (4, 0.3), (1, 0.05), (0, 0.2), (2, 0.01)] {
            rates.add(record, per_year);
        }
        let (of_unit, n) = ([0.3, 0.05, 0.31], [2.0, 1.0, 3.0]);
        let mean = 0.66 / 6.0;
        let found = rates.mean();
        assert!((found.mean - mean).abs() < 1e-15);
        let deviations = [0, 1, 2].map(|unit| (of_unit[unit] - mean * n[unit]) / 2.0);
        let moment = |power: i32| deviations.iter().map(|d: &f64| d.powi(power)).sum::<f64>() / 3.0;
        let expected = SkewedMean::new(mean, [2, 3, 4].map(moment), 3);
        assert!((found.deviation - expected.deviation).abs() < 1e-14, "{found:?} {expected:?}");
        assert!((found.skewness - expected.skewness).abs() < 1e-9, "{found:?} {expected:?}");
        assert!((found.kurtosis - expected.kurtosis).abs() < 1e-9, "{found:?} {expected:?}");
    }
}
