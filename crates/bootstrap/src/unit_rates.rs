//! The rates that single records, or earthquakes of equally many, bring, summed while the displacement falls.

use crate::SkewedMean;
use crate::skewed_mean::AboveInterval;

/// The rates of the units above a displacement that falls, with the sums that their mean and scatter need. All units
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
        }
    }

    /// A run of `record` is exceeded from here on: its stripe weighs `per_year`, 1/yr.
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

    /// The rate of all records, 1/yr.
    pub(crate) fn per_year(&self) -> f64 {
        self.sums[0] / self.rates.len() as f64
    }

    /// The rate of all records, 1/yr, with the scatter of the units.
    pub(crate) fn mean(&self) -> SkewedMean {
        let (mean, units) = (self.per_year(), self.rates.len());
        SkewedMean::new(mean, self.central(mean).map(|sum| sum / units as f64), units)
    }

    /// Whether `value` is surely above the interval of that `mean`.
    pub(crate) fn is_below(&self, value: f64, mean: f64, above: &AboveInterval) -> bool {
        above.has(value, mean, self.central(mean))
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
    use crate::StudentQuantiles;

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

    // what is told is true, and most of what is true is told
    #[test]
    fn values_surely_above_the_interval_are_above_it() {
        for (count, least) in [(2, 0), (3, 0), (4, 600), (20, 600)] {
            let units: Vec<Vec<usize>> = (0..count).map(|record| vec![record]).collect();
            let quantiles = StudentQuantiles::new(0.9, count);
            let (above, mut rates) = (AboveInterval::new(&quantiles, count), UnitRates::new(&units));
            let (mut told, mut known) = (0, 0);
            for step in 0..400_usize {
                rates.add((step * step + step / 7) % count, 1e-3 * (1.0 + (step % 11) as f64));
                let mean = rates.mean();
                for target in [0.5, 0.99, 1.01, 1.3, 2.0, 4.0].map(|factor| factor * mean.mean) {
                    let place = mean.place(target, &quantiles);
                    let is_told = rates.is_below(target, mean.mean, &above);
                    assert!(!is_told || place < -1.0, "{count}, {step}: {place}");
                    told += usize::from(is_told);
                    known += usize::from(place < -1.0);
                }
            }
            assert!(told >= least, "{count}: {told} of {known}");
        }
    }
}
