//! A weight for every run: records that do not count alike, and not alike at every level.

use crate::error::{check_count, check_target};
use crate::fixed_point::{MAX_RATE_PER_YEAR, quanta};
use crate::{RiskError, StripeWeights};

/// Bits that the sum of all weights may take: what is left keeps a sum of rounded weights from overflowing.
const SUM_BITS: u32 = 62;

/// By how much the shares at a level may miss 1, for the rounding of whoever divided them by their sum.
const SUM_TOLERANCE: f64 = 1e-9;

/// The weight w(level) p(level, record) of every run in the risk integral, 1/yr.
///
/// w is what the site's hazard makes of the stripe ([`StripeWeights`]) and p the share of the record at it, Σ p = 1
/// over the records. Where every record counts alike, p = 1/N, this is what
/// [`RiskCurve::new`](crate::RiskCurve::new) has.
///
/// A weight is a whole number of units; a unit is a power of two of the quanta in which rates are added, the smallest
/// in which all weights together fit 62 bits: 3e-19 per year or less where the hazard curve begins below one per year.
#[derive(Debug, Clone, PartialEq)]
pub struct RunWeights {
    stripes: StripeWeights,
    record_count: usize,
    /// p, `[level, record]`.
    shares: Vec<f64>,
    /// w p in units, `[level, record]`.
    units: Vec<u64>,
    scale: UnitScale,
    calibration: Vec<Vec<f64>>,
}

impl RunWeights {
    /// From the weights of the stripes and the shares of the records at each.
    ///
    /// - `shares`: p, 0 to 1, `[level, record]` row-major; at each level they add up to 1.
    ///
    /// # Errors
    /// A number of shares that is not a multiple of the number of levels; a level at which they do not add up to 1, or
    /// at which one is negative or NaN.
    pub fn new(stripes: &StripeWeights, shares: &[f64]) -> Result<Self, RiskError> {
        let record_count = (shares.len() / stripes.level_count()).max(1);
        let scale = UnitScale::new(stripes);
        scale.check(shares, record_count)?;
        let of_level =
            |(level, row): (usize, &[f64])| row.iter().map(|&share| scale.units(level, share)).collect::<Vec<_>>();
        let units = shares.chunks_exact(record_count).enumerate().flat_map(of_level).collect();
        Ok(Self {
            stripes: stripes.clone(),
            record_count,
            shares: shares.to_vec(),
            units,
            scale,
            calibration: Vec::new(),
        })
    }

    /// The same weights, solved so that combinations of known rates hold, with how each record moves these: what a set
    /// has of them scatters no more, and what goes with them scatters less (calibrated weights).
    ///
    /// - `calibration`: the linearised deviation of each record, in any unit, `[combination][record]`.
    ///
    /// # Errors
    /// Deviations of other records.
    ///
    /// # Source
    /// J.-C. Deville, C.-E. Särndal, J. Am. Stat. Assoc. 87 (1992), 376–382.
    pub fn with_calibration(self, calibration: Vec<Vec<f64>>) -> Result<Self, RiskError> {
        for combination in &calibration {
            check_count("records of the calibration", combination.len(), self.record_count)?;
        }
        Ok(Self { calibration, ..self })
    }

    /// The weights where only the stripes at these `places` are analysed; the shares of their records stay.
    ///
    /// # Errors
    /// As [`StripeWeights::at_levels`].
    pub fn at_levels(&self, places: &[usize]) -> Result<Self, RiskError> {
        let rows: Vec<&[f64]> = self.shares.chunks(self.record_count).collect();
        let shares: Vec<f64> =
            places.iter().filter_map(|&place| rows.get(place)).flat_map(|row| row.to_vec()).collect();
        Self::new(&self.stripes.at_levels(places)?, &shares)?.with_calibration(self.calibration.clone())
    }

    /// Number of records.
    pub fn record_count(&self) -> usize {
        self.record_count
    }

    /// What the hazard makes of each stripe.
    pub fn stripes(&self) -> &StripeWeights {
        &self.stripes
    }

    /// Shares of the records, `[level, record]`.
    pub fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// How each record moves the combinations of known rates that the weights hold, `[combination][record]`; empty
    /// where they hold none.
    pub fn calibration(&self) -> &[Vec<f64>] {
        &self.calibration
    }

    /// Weights in units, `[level, record]`.
    pub(crate) fn units(&self) -> &[u64] {
        &self.units
    }

    /// Quanta of a number of units.
    pub(crate) fn quanta(&self, units: u64) -> u128 {
        u128::from(units) << self.scale.shift
    }
}

/// The units in which the runs of a site are weighed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct UnitScale {
    /// A unit is 2^shift quanta.
    shift: u32,
    /// Weight of each stripe in units, `[level]`.
    stripes: Vec<f64>,
}

impl UnitScale {
    pub(crate) fn new(stripes: &StripeWeights) -> Self {
        let total: u128 = stripes.quanta().iter().sum();
        let shift = (u128::BITS - total.leading_zeros()).saturating_sub(SUM_BITS);
        let unit = (1_u128 << shift) as f64;
        Self { shift, stripes: stripes.quanta().iter().map(|&weight| weight as f64 / unit).collect() }
    }

    /// Number of stripe levels.
    pub(crate) fn level_count(&self) -> usize {
        self.stripes.len()
    }

    /// Refuses shares, `[level, record]`, that are none.
    pub(crate) fn check(&self, shares: &[f64], record_count: usize) -> Result<(), RiskError> {
        check_count("shares of records", shares.len(), self.stripes.len() * record_count)?;
        for (level, row) in shares.chunks_exact(record_count).enumerate() {
            let sum: f64 = row.iter().sum();
            let possible = row.iter().all(|&share| share >= 0.0);
            if !(possible && (sum - 1.0).abs() <= SUM_TOLERANCE) {
                return Err(RiskError::Shares { level, sum });
            }
        }
        Ok(())
    }

    /// The weight in units of a run at `level` with a share of its runs.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 2^62")]
    #[inline(always)]
    pub(crate) fn units(&self, level: usize, share: f64) -> u64 {
        (self.stripes[level] * share).round() as u64
    }

    /// The most units that meet a target rate, 1/yr.
    pub(crate) fn limit(&self, target_per_year: f64) -> Result<u64, RiskError> {
        check_target(target_per_year)?;
        // larger targets are met by any risk: all units together fit 62 bits
        Ok(u64::try_from(quanta(target_per_year.min(MAX_RATE_PER_YEAR)) >> self.shift).unwrap_or(u64::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_add_up_to_those_of_the_stripes() {
        let stripes = StripeWeights::new(&[0.5, 0.25, 0.125], Some(1.0)).unwrap();
        let weights = RunWeights::new(&stripes, &[0.5, 0.5, 0.25, 0.75, 0.0, 1.0]).unwrap();
        for level in 0..3 {
            let of_level = weights.units()[2 * level..2 * level + 2].iter().map(|&units| weights.quanta(units));
            assert_eq!(of_level.sum::<u128>(), stripes.quanta()[level]);
        }
        assert_eq!(weights.quanta(weights.units()[2]), stripes.quanta()[1] / 4);
        assert_eq!(weights.quanta(weights.scale.limit(0.25).unwrap()), quanta(0.25));
        // the largest hazard there may be still fits
        let most = StripeWeights::new(&[1_048_576.0], None).unwrap();
        let most = RunWeights::new(&most, &[0.5, 0.5]).unwrap();
        assert_eq!(most.units().iter().sum::<u64>(), 1 << 61);
    }

    #[test]
    fn refuses_shares_that_are_none() {
        let stripes = StripeWeights::new(&[0.5, 0.25], None).unwrap();
        for shares in [&[][..], &[1.0], &[0.5, 0.5, 1.0]] {
            assert!(matches!(RunWeights::new(&stripes, shares), Err(RiskError::Count { .. })), "{shares:?}");
        }
        for row in [[0.5, 0.4], [f64::NAN, 1.0], [1.5, -0.5]] {
            let shares = [0.5, 0.5, row[0], row[1]];
            assert!(matches!(RunWeights::new(&stripes, &shares), Err(RiskError::Shares { level: 1, .. })));
        }
    }
}
