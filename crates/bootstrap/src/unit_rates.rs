//! The rates that single records, or earthquakes of equally many, bring.

use crate::SkewedMean;
use crate::skewed_mean::{adjustment, sums};

/// The rates of the units above a displacement that moves, with the sums that their mean and scatter need. All units
/// are of equally many records.
#[derive(Debug, Clone)]
pub(crate) struct UnitRates {
    /// The unit of each record.
    unit_of: Vec<usize>,
    /// One over the number of records in a unit.
    per_record: f64,
    /// Rate W of each unit, the mean of its records, 1/yr.
    rates: Vec<f64>,
    /// Σ W^p for p from 1 to 4.
    sums: [f64; 4],
    /// That of the skewness.
    adjustment: f64,
}

impl UnitRates {
    /// Of the records of each unit, `[unit]`; nothing is exceeded yet.
    pub(crate) fn new(units: &[Vec<usize>]) -> Self {
        let records = units.first().map_or(1, Vec::len);
        debug_assert!(units.iter().all(|unit| unit.len() == records), "units of equally many records");
        Self {
            unit_of: unit_of(units),
            per_record: 1.0 / records as f64,
            rates: vec![0.0; units.len()],
            sums: [0.0; 4],
            adjustment: adjustment(units.len()),
        }
    }

    /// Just these runs are exceeded: of the record, whose stripe weighs so much, 1/yr.
    pub(crate) fn start(&mut self, runs: impl Iterator<Item = (usize, f64)>) {
        self.rates.fill(0.0);
        runs.for_each(|(record, per_year)| self.rates[self.unit_of[record]] += per_year * self.per_record);
        self.sums = sums([&self.rates], |[own]| {
            let square = own * own;
            [own, square, own * square, square * square]
        });
    }

    /// A run of `record` is exceeded too: its stripe weighs `per_year`, 1/yr; negative where it is exceeded no more.
    pub(crate) fn add(&mut self, record: usize, per_year: f64) {
        let rate = &mut self.rates[self.unit_of[record]];
        let (before, after) = (*rate, *rate + per_year * self.per_record);
        let (mut power_before, mut power_after) = (1.0, 1.0);
        for sum in &mut self.sums {
            power_before *= before;
            power_after *= after;
            *sum += power_after - power_before;
        }
        *rate = after;
    }

    /// How many units.
    pub(crate) fn units(&self) -> usize {
        self.rates.len()
    }

    /// What a run adds to the rate of all, over what its stripe weighs.
    pub(crate) fn share(&self) -> f64 {
        self.per_record / self.rates.len() as f64
    }

    /// The rate of all records, 1/yr, with the scatter of the units.
    pub(crate) fn mean(&self) -> SkewedMean {
        let (mean, units) = (self.sums[0] / self.rates.len() as f64, self.rates.len());
        SkewedMean::with_adjustment(mean, self.central(mean).map(|sum| sum / units as f64), (units, self.adjustment))
    }

    /// Σ (W − mean)^p for p from 2 to 4, by the binomial theorem.
    fn central(&self, mean: f64) -> [f64; 3] {
        let [w, w2, w3, w4] = self.sums;
        [
            w2 - mean * w,
            w3 - mean * (3.0 * w2 - 2.0 * mean * w),
            w4 - mean * (4.0 * w3 - mean * (6.0 * w2 - 3.0 * mean * w)),
        ]
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

    // two earthquakes of two records, and the records by themselves
    #[test]
    fn sums_are_those_of_the_units_written_out() {
        let added = [(0, 0.1), (3, 0.3), (1, 0.05), (0, 0.2), (2, 0.01)];
        for (units, of_unit) in [
            (vec![vec![0, 3], vec![1, 2]], vec![0.3, 0.03]),
            (vec![vec![0], vec![1], vec![2], vec![3]], vec![0.3, 0.05, 0.01, 0.3]),
        ] {
            let mut rates = UnitRates::new(&units);
            for (record, per_year) in added {
                rates.add(record, per_year);
            }
            let (found, n) = (rates.mean(), of_unit.len() as f64);
            let mean = 0.66 / 4.0;
            assert!((found.mean - mean).abs() < 1e-15);
            let moment = |power: i32| of_unit.iter().map(|own: &f64| (own - mean).powi(power)).sum::<f64>() / n;
            let expected = SkewedMean::new(mean, [2, 3, 4].map(moment), units.len());
            assert!((found.deviation - expected.deviation).abs() < 1e-14, "{found:?} {expected:?}");
            assert!((found.skewness - expected.skewness).abs() < 1e-9, "{found:?} {expected:?}");
            assert!((found.kurtosis - expected.kurtosis).abs() < 1e-9, "{found:?} {expected:?}");
        }
    }
}
