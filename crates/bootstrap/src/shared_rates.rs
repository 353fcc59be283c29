//! The rates that records, or earthquakes, bring where each level has records of its own.

use crate::SkewedMean;
use crate::unit_rates::unit_of;

/// How units deviate from the rate λ(c) of all of them, summed while the displacement c falls.
///
/// Level j, with the weight w, is exceeded by the share F of its records, each of which counts for its share p of the
/// level: λ(c) = Σ w F over the levels, F = Σ p 1(u > c) over the records. A sample that draws a record more often has
/// the more of it at every level that it belongs to, and the shares of a sample are made to add up to 1 again: F is a
/// ratio. Linearised, one of U units deviates by U Σ w Σ p (1(u > c) − F), over the levels and the records of the unit.
/// Shares that are all alike give the deviations of [`UnitRates`](crate::unit_rates::UnitRates).
#[derive(Debug, Clone)]
pub(crate) struct SharedRates {
    /// The unit of each record.
    unit_of: Vec<usize>,
    /// Share of each record, `[level, record]`.
    shares: Vec<f64>,
    /// Sum of the shares of the records of a unit, `[level, unit]`.
    of_units: Vec<f64>,
    /// λ so far, 1/yr.
    per_year: f64,
    /// The deviation of each unit, 1/yr.
    deviations: Vec<f64>,
}

impl SharedRates {
    /// Of the records of each unit, `[unit]`, with their `shares` `[level, record]`; nothing is exceeded yet.
    pub(crate) fn new(units: &[Vec<usize>], shares: &[f64]) -> Self {
        let unit_of = unit_of(units);
        let of_level = |level: &[f64]| {
            let mut of_units = vec![0.0; units.len()];
            level.iter().zip(&unit_of).for_each(|(share, &unit)| of_units[unit] += share);
            of_units
        };
        let of_units = shares.chunks_exact(unit_of.len().max(1)).flat_map(of_level).collect();
        Self { unit_of, shares: shares.to_vec(), of_units, per_year: 0.0, deviations: vec![0.0; units.len()] }
    }

    /// The run of `record` at `level`, whose stripe weighs `per_year`, 1/yr, is exceeded from here on.
    pub(crate) fn add(&mut self, record: usize, level: usize, per_year: f64) {
        let units = self.deviations.len();
        let own = per_year * self.shares[level * self.unit_of.len() + record];
        self.per_year += own;
        let own = own * units as f64;
        let of_level = &self.of_units[level * units..][..units];
        for (deviation, share) in self.deviations.iter_mut().zip(of_level) {
            *deviation -= own * share;
        }
        self.deviations[self.unit_of[record]] += own;
    }

    /// The rate of all records, 1/yr, with the scatter of the units.
    pub(crate) fn mean(&self) -> SkewedMean {
        let units = self.deviations.len() as f64;
        let moment = |power: i32| self.deviations.iter().map(|own| own.powi(power)).sum::<f64>() / units;
        SkewedMean::new(self.per_year, [2, 3, 4].map(moment), self.deviations.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unit_rates::UnitRates;

    #[test]
    fn shares_that_are_alike_give_the_rates_of_units() {
        let units = [vec![0, 3], vec![1], vec![2, 4, 5]];
        let per_year = [0.1, 0.05, 0.2];
        let (mut alike, mut shared) = (UnitRates::new(&units), SharedRates::new(&units, &[1.0 / 6.0; 18]));
        for (record, level) in [(0, 0), (4, 2), (1, 1), (0, 2), (2, 1), (5, 0)] {
            alike.add(record, per_year[level]);
            shared.add(record, level, per_year[level]);
        }
        let (alike, shared) = (alike.mean(), shared.mean());
        assert!((alike.mean - shared.mean).abs() < 1e-15, "{alike:?} {shared:?}");
        assert!((alike.deviation - shared.deviation).abs() < 1e-13, "{alike:?} {shared:?}");
        assert!((alike.skewness - shared.skewness).abs() < 1e-9 && (alike.kurtosis - shared.kurtosis).abs() < 1e-9);
    }

    // Level 0 has records 0 and 1 by halves, level 1 record 2 alone. Record 0 exceeds at level 0, record 2 at level 1:
    // λ = 0.4/2 + 0.1; record 2 is all of its level, so that its ratio stays 1 and it adds no scatter; records 0 and 1
    // deviate by 3 · 0.4 · ½ · (1 − ½) and −3 · 0.4 · ½ · ½.
    #[test]
    fn a_level_of_one_record_has_no_scatter() {
        let mut rates = SharedRates::new(&[vec![0], vec![1], vec![2]], &[0.5, 0.5, 0.0, 0.0, 0.0, 1.0]);
        rates.add(0, 0, 0.4);
        rates.add(2, 1, 0.1);
        assert!((rates.per_year - 0.3).abs() < 1e-15);
        for (found, expected) in rates.deviations.iter().zip([0.3, -0.3, 0.0]) {
            assert!((found - expected).abs() < 1e-15, "{:?}", rates.deviations);
        }
    }
}
