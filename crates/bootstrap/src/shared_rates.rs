//! The rates that records, or earthquakes, bring where they do not count alike.

use uplift_instructions::{Instructions, Vectors, Work};
use uplift_risk::RunWeights;

use crate::SkewedMean;
use crate::calibration::Calibration;
use crate::skewed_mean::{adjustment, sums};
use crate::unit_rates::unit_of;

/// How units deviate from the rate λ(c) of all of them, summed while the displacement c moves.
///
/// Level j, with the weight w, is exceeded by the share F of its records, each of which counts for its share p of the
/// level: λ(c) = Σ w F over the levels, F = Σ p 1(u > c) over the records. A sample that draws a record more often has
/// the more of it at every level that it belongs to, and the shares of a sample are made to add up to 1 again: F is a
/// ratio. Linearised, one of U units deviates by U Σ w Σ p (1(u > c) − F), over the levels and the records of the unit.
/// Shares that are all alike give the deviations of [`inferred_mean`](crate::inferred_mean).
///
/// [Of weights](Self::of_weights) the scatter counts as known from as many units as carry λ alike
/// ([`SkewedMean::carried_by`]), and is what these leave of it ([`Calibration`]). A unit that has more of a
/// level than others hides its own deviation, since F follows it. With [`with_leverage`](Self::with_leverage) it
/// deviates by (1 − 1/U)/(1 − h) of that, h its share: what λ becomes without it (the jackknife of clusters).
///
/// # Source
/// J. G. `MacKinnon`, M. Ø. Nielsen, M. D. Webb, J. Appl. Econometrics 38 (2023), 671–694: the jackknife where clusters
/// are few and not alike.
#[derive(Debug, Clone)]
pub(crate) struct SharedRates {
    /// The unit of each record.
    unit_of: Vec<usize>,
    /// Share of each record, `[level, record]`.
    shares: Vec<f64>,
    /// How many units there are.
    units: usize,
    /// Sum of the shares of the records of a unit, `[level, unit]`, each level filled up with zeros to whole
    /// [`LANES`]; so are the other lists of units.
    of_units: Vec<f64>,
    /// By what the deviation of a unit is multiplied, `[level, unit]`.
    leverage: Vec<f64>,
    /// What each unit carries of λ, 1/yr.
    carried: Vec<f64>,
    /// Whether the scatter is known from as many units as carry λ alike.
    is_carried: bool,
    /// λ, 1/yr.
    per_year: f64,
    /// The deviation of each unit, 1/yr.
    deviations: Vec<f64>,
    /// Σ of the second, third and fourth power of the deviations, and of the second and fourth of what units carry.
    powers: [f64; POWERS],
    /// That of the skewness.
    adjustment: f64,
    /// What weights hold; none where they hold nothing.
    calibration: Option<Box<Calibration>>,
    instructions: Instructions,
}

const POWERS: usize = 5;

/// Units for the processor to do at once.
const LANES: usize = 8;

impl SharedRates {
    /// Of the records of each unit, `[unit]`, with their `shares` `[level, record]`; nothing is exceeded yet.
    pub(crate) fn new(units: &[Vec<usize>], shares: &[f64]) -> Self {
        let (unit_of, row) = (unit_of(units), units.len().max(1).next_multiple_of(LANES));
        let of_level = |level: &[f64]| {
            let mut of_units = vec![0.0; row];
            level.iter().zip(&unit_of).for_each(|(share, &unit)| of_units[unit] += share);
            of_units
        };
        let of_units: Vec<f64> = shares.chunks_exact(unit_of.len().max(1)).flat_map(of_level).collect();
        Self {
            unit_of,
            shares: shares.to_vec(),
            units: units.len(),
            leverage: vec![1.0; of_units.len()],
            of_units,
            carried: vec![0.0; row],
            is_carried: false,
            per_year: 0.0,
            deviations: vec![0.0; row],
            powers: [0.0; POWERS],
            adjustment: adjustment(units.len()),
            calibration: None,
            instructions: Instructions::chosen(),
        }
    }

    /// Of the records of each unit, `[unit]`, by the weights of a repair: the scatter is known from fewer units than
    /// there are, and is what the repair leaves of it.
    pub(crate) fn of_weights(units: &[Vec<usize>], weights: &RunWeights) -> Self {
        let rates = Self::new(units, weights.shares());
        let calibration = Calibration::new(units, weights.calibration(), rates.deviations.len()).map(Box::new);
        Self { is_carried: true, calibration, ..rates }
    }

    /// The same of units of which one may have a level nearly alone.
    pub(crate) fn with_leverage(mut self) -> Self {
        let alike = 1.0 - 1.0 / self.units as f64;
        // of a level that a unit has alone nothing is known without it: its ratio is its own
        let of = |&share: &f64| if share < 1.0 - 1e-9 { alike / (1.0 - share) } else { 1.0 };
        self.leverage = self.of_units.iter().map(of).collect();
        self.is_carried = true;
        self
    }

    /// To how many units that count alike they amount: one over the mean of Σ p² over the levels, p being the share of
    /// a unit.
    pub(crate) fn equivalent_units(&self) -> f64 {
        let levels = self.of_units.len() / self.deviations.len();
        let found = levels as f64 / self.of_units.iter().map(|share| share * share).sum::<f64>();
        // 12 units that count alike are 12, whatever rounding leaves
        if (found - found.round()).abs() < 1e-9 * found { found.round() } else { found }
    }

    /// What the run of `record` at `level` adds to the rate of all, over what its stripe weighs.
    pub(crate) fn share(&self, record: usize, level: usize) -> f64 {
        self.shares[level * self.unit_of.len() + record]
    }

    /// Just these runs are exceeded: of the record, at the level, whose stripe weighs so much, 1/yr.
    pub(crate) fn start(&mut self, runs: impl Iterator<Item = (usize, usize, f64)>) {
        let row = self.deviations.len();
        let mut of_levels = vec![0.0; self.of_units.len() / row];
        self.per_year = 0.0;
        self.deviations.fill(0.0);
        for (record, level, per_year) in runs {
            let (own, unit) = (per_year * self.share(record, level), self.unit_of[record]);
            of_levels[level] += own;
            self.deviations[unit] += own * self.units as f64 * self.leverage[level * row + unit];
        }
        self.carried.fill(0.0);
        self.all_deviate(0, &of_levels);
    }

    /// The run of `record` at `level`, whose stripe weighs `per_year`, 1/yr, is exceeded too; negative where it is
    /// exceeded no more.
    pub(crate) fn add(&mut self, record: usize, level: usize, per_year: f64) {
        let (own, row, unit) = (per_year * self.share(record, level), self.deviations.len(), self.unit_of[record]);
        self.deviations[unit] += own * self.units as f64 * self.leverage[level * row + unit];
        self.all_deviate(level, &[own]);
    }

    /// λ grows by so much each, 1/yr, at the levels from the `first` on: every unit deviates by its share of that.
    fn all_deviate(&mut self, first: usize, of_levels: &[f64]) {
        self.instructions.run(AllDeviate { rates: self, first, of_levels });
    }

    /// The rate of all records, 1/yr, with the scatter of the units.
    pub(crate) fn mean(&self) -> SkewedMean {
        let [second, third, fourth, carried @ ..] = self.powers;
        let moments = [second, third, fourth].map(|sum| sum / self.units as f64);
        let mean = SkewedMean::with_adjustment(self.per_year, moments, (self.units, self.adjustment));
        let mean = if self.is_carried { mean.carried_by(carried) } else { mean };
        let Some(calibration) = &self.calibration else { return mean };
        let left = calibration.variance_left(self.instructions, (&self.deviations, second), mean.effective_units);
        SkewedMean { deviation: mean.deviation * left.sqrt(), ..mean }
    }
}

/// See [`SharedRates::all_deviate`].
struct AllDeviate<'a> {
    rates: &'a mut SharedRates,
    first: usize,
    of_levels: &'a [f64],
}

impl Work for AllDeviate<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vectors>(self, _: V) -> Self::Output {
        let SharedRates { units, of_units, leverage, carried, deviations, per_year, .. } = self.rates;
        let rows = of_units.chunks_exact(deviations.len()).zip(leverage.chunks_exact(deviations.len()));
        for (own, (shares, leverage)) in self.of_levels.iter().zip(rows.skip(self.first)) {
            *per_year += own;
            let all = own * *units as f64;
            for (((deviation, carried), share), leverage) in
                deviations.iter_mut().zip(carried.iter_mut()).zip(shares).zip(leverage)
            {
                *carried += own * share;
                *deviation -= all * share * leverage;
            }
        }
        self.rates.powers = sums([deviations, carried], |[deviation, carried]| {
            let (square, of_carried) = (deviation * deviation, carried * carried);
            [square, deviation * square, square * square, of_carried, of_carried * of_carried]
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inferred::mean_of;

    #[test]
    fn shares_that_are_alike_give_the_rates_of_units() {
        let units = [vec![0, 3], vec![1], vec![2, 4, 5]];
        let per_year = [0.1, 0.05, 0.2];
        let mut shared = SharedRates::new(&units, &[1.0 / 6.0; 18]);
        let mut contributions = [0.0; 6];
        for (record, level) in [(0, 0), (4, 2), (1, 1), (0, 2), (2, 1), (5, 0)] {
            contributions[record] += per_year[level];
            shared.add(record, level, per_year[level]);
        }
        let (alike, shared) = (mean_of(&contributions, &units).unwrap(), shared.mean());
        assert!((alike.mean - shared.mean).abs() < 1e-15, "{alike:?} {shared:?}");
        assert!((alike.deviation - shared.deviation).abs() < 1e-13, "{alike:?} {shared:?}");
        assert!((alike.skewness - shared.skewness).abs() < 1e-9 && (alike.kurtosis - shared.kurtosis).abs() < 1e-9);
    }

    // Earthquakes of 3, 1 and 1 records with W = 0.3, 0.1, 0: λ = 0.08. Without the first λ is 0.05, without the second
    // 0.3/4, without the third 0.4/4: 3 (λ − λ without it) times 2/3, as of the jackknife.
    #[test]
    fn with_leverage_units_deviate_as_when_they_are_left_out() {
        let mut rates = SharedRates::new(&[vec![0, 1, 2], vec![3], vec![4]], &[0.2; 5]).with_leverage();
        for (record, per_year) in [(0, 0.2), (1, 0.1), (3, 0.1)] {
            rates.add(record, 0, per_year);
        }
        assert!((rates.per_year - 0.08).abs() < 1e-15);
        for (found, without) in rates.deviations.iter().zip([0.05, 0.075, 0.1]) {
            assert!((found - 3.0 * (0.08 - without) * 2.0 / 3.0).abs() < 1e-15, "{:?}", rates.deviations);
        }
        // they carry 3 : 1 : 1
        assert!((rates.mean().effective_units - 121.0 / 83.0).abs() < 1e-12);
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
