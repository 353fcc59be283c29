//! What a set of records says of the spectrum of all records there could be, and of no other: for tables of sites.

use uplift_risk::{PooledDemand, RiskError, RunWeights, StripeWeights};

use crate::inferred::{Rates, SURELY_BELOW, Search, Step, check, check_target, fall, rising};
use crate::skewed_mean::{AboveInterval, StudentQuantiles, of_side};

/// Above this, no quantile is reached by a mean that is below the target: its deviate is at most γ/(6√n), 0.41 for
/// three units of which one alone deviates, and less for more.
const OUT_OF_REACH: f64 = 0.5;
/// Part of the target at which a mean is below it, whatever rounding leaves of γ where the units hardly scatter.
const BELOW: f64 = 1.0 - 1e-6;

/// The limits of the truth alone, m, `[target]`, to the bit those of [`inferred_limits`](crate::inferred_limits) for as
/// many units as the set has.
///
/// # Errors
/// As [`inferred_limits`](crate::inferred_limits).
pub fn truth_limits(
    demand: &PooledDemand,
    weights: &StripeWeights,
    units: &[Vec<usize>],
    targets_per_year: &[f64],
    confidence: f64,
) -> Result<Vec<[f64; 2]>, RiskError> {
    check(demand, weights, units)?;
    truths(demand, weights, (|| Rates::from_demand(demand, units), units), targets_per_year, confidence)
}

/// The same of records that count as `weights` say, repaired: those of
/// [`repaired_limits`](crate::repaired_limits).
///
/// # Errors
/// As [`inferred_limits`](crate::inferred_limits).
pub fn repaired_truth_limits(
    demand: &PooledDemand,
    weights: &RunWeights,
    units: &[Vec<usize>],
    targets_per_year: &[f64],
    confidence: f64,
) -> Result<Vec<[f64; 2]>, RiskError> {
    check(demand, weights.stripes(), units)?;
    truths(demand, weights.stripes(), (|| Rates::weighted(weights, units), units), targets_per_year, confidence)
}

fn truths(
    demand: &PooledDemand,
    weights: &StripeWeights,
    (rates, units): (impl Fn() -> Rates, &[Vec<usize>]),
    targets_per_year: &[f64],
    confidence: f64,
) -> Result<Vec<[f64; 2]>, RiskError> {
    targets_per_year.iter().try_for_each(|target| check_target(*target))?;
    if units.len() < 2 {
        return Ok(vec![[f64::NAN; 2]; targets_per_year.len()]);
    }
    let quantiles = StudentQuantiles::new(confidence, units.len());
    let is_patient = quantiles.at(units.len() - 1) > OUT_OF_REACH;
    let search = |is_patient| {
        let mut fall = Fall::new(&quantiles, units.len(), targets_per_year, is_patient);
        fall.through(demand, weights, rates());
        fall
    };
    let mut found = search(is_patient);
    if found.truths.iter().any(|own| own.is_doubtful) {
        found = search(false);
    }
    let mut limits_m = vec![[f64::NAN; 2]; targets_per_year.len()];
    found.truths.iter().for_each(|own| limits_m[own.row] = own.search.limits_m());
    Ok(limits_m)
}

/// The band of one target while a displacement falls.
struct Truth {
    target: f64,
    /// Position of the target.
    row: usize,
    search: Search,
    /// Whether steps were passed over since the last that belonged to the band.
    was_passed: bool,
    /// Whether one of these may be the last that belonged to it.
    is_doubtful: bool,
}

impl Truth {
    fn see(&mut self, deviate: f64, from_m: f64, to_m: f64) {
        self.search.see(deviate, from_m, to_m);
        self.is_doubtful |= self.was_passed && self.search.was_beyond;
        self.was_passed &= self.search.found_m.is_none_or(|found_m| found_m[0] != from_m);
    }
}

/// The bands of all targets, the least first, while a displacement falls through the runs of a set.
struct Fall<'a> {
    quantiles: &'a StudentQuantiles,
    above: AboveInterval,
    truths: Vec<Truth>,
    /// Whether steps are passed over that are within the band, or before it, and not its end: what belongs to it is
    /// seen again before the mean leaves it, or else in doubt.
    is_patient: bool,
}

impl<'a> Fall<'a> {
    fn new(quantiles: &'a StudentQuantiles, units: usize, targets_per_year: &[f64], is_patient: bool) -> Self {
        let of =
            |(target, row)| Truth { target, row, search: Search::default(), was_passed: false, is_doubtful: false };
        let above = AboveInterval::new(quantiles, units);
        let truths = rising(targets_per_year).into_iter().map(of).collect();
        Self { quantiles, above, truths, is_patient }
    }

    fn through(&mut self, demand: &PooledDemand, weights: &StripeWeights, mut rates: Rates) {
        let per_year = weights.per_year();
        fall(demand, |step| match step {
            Step::Between(from_m, to_m) => {
                // the last step is seen: nothing after it would show what belongs to the band
                (from_m > 0.0 && self.may_pass_over(&rates)) || self.see(&rates, from_m, to_m)
            }
            Step::Run { record, level } => {
                rates.add(record, level, per_year[level]);
                true
            }
        });
        self.truths.iter_mut().for_each(|own| own.is_doubtful |= own.was_passed && !own.search.was_beyond);
    }

    /// Whether it is known in a moment that no band begins or ends here.
    fn may_pass_over(&mut self, rates: &Rates) -> bool {
        let per_year = rates.per_year();
        // of the targets whose bands have not begun, the least lies lowest
        let mut is_below = false;
        let may_pass_over = self.truths.iter().filter(|own| !own.search.was_beyond).all(|own| {
            if own.search.found_m.is_some() {
                return self.is_patient && per_year <= BELOW * own.target;
            }
            is_below = is_below || rates.is_below(own.target, per_year, &self.above);
            is_below
        });
        if may_pass_over {
            self.truths.iter_mut().for_each(|own| own.was_passed |= own.search.found_m.is_some());
        }
        may_pass_over
    }

    /// Holds the mean of all displacements from `from_m` to `to_m` against every target; whether a band is open still.
    fn see(&mut self, rates: &Rates, from_m: f64, to_m: f64) -> bool {
        let mean = rates.mean();
        let deviates = mean.deviates((mean.units as f64).sqrt());
        let per_quantile = mean.quantiles(self.quantiles, mean.units).map(f64::recip);
        let mut is_open = false;
        for own in self.truths.iter_mut().filter(|own| !own.search.was_beyond) {
            let deviate = deviates.of(own.target);
            let deviate = deviate * of_side(per_quantile, deviate);
            own.see(deviate, from_m, to_m);
            is_open |= !own.search.was_beyond;
            if deviate < SURELY_BELOW {
                break;
            }
        }
        is_open
    }
}
