//! What a set of records says where it is not known either which hazard curve holds.

use statrs::distribution::{ContinuousCDF, StudentsT};
use uplift_risk::{PooledDemand, RiskError, StripeWeights, check_target};

use crate::inferred::mean_of;
use crate::inversion::Inversion;
use crate::rates::Rates;
use crate::skewed_mean::{SampleQuantiles, SkewedMean, StudentQuantiles, by_side};
use crate::weighted_quantile;

/// Limits of the rate at which `threshold_m` is exceeded, 1/yr, by all records there could be and by one of several
/// hazard curves.
///
/// Each curve b has a confidence distribution `C_b(x)`, the confidence with which the rate is at most x by all records
/// and that curve, which its interval ([`inferred_rate`](crate::inferred_rate)) cuts at both ends. With weights w the
/// confidence with all curves is `Σ w_b C_b(x)`, and the band cuts that. NaN of a single unit, and of no curve.
///
/// - `curves`: weight and stripe weights of each hazard curve; the weights need not add up to 1.
/// - `units`: the records of each unit, `[unit]`, by their positions; each record in one of them.
///
/// # Errors
/// Demand and weights with different numbers of levels or units of other records.
///
/// # Source
/// Confidence distributions: M. Xie and K. Singh, Int. Stat. Rev. 81 (2013), 3–39.
pub fn inferred_rate_over_curves(
    demand: &PooledDemand,
    curves: &[(f64, StripeWeights)],
    units: &[Vec<usize>],
    (threshold_m, confidence): (f64, f64),
) -> Result<[f64; 2], RiskError> {
    let rates = rates_of(demand, curves, units)?;
    if units.len() < 2 || curves.is_empty() {
        return Ok([f64::NAN; 2]);
    }
    let mixture = Mixture::new(weights_of(curves), units, confidence);
    Ok(Inversion::new(demand, rates).rate_limits(threshold_m, |means| mixture.interval(means)))
}

/// Limits of the exact ordinate of `target_per_year` \[1/yr\] by all records there could be and by one of several
/// hazard curves, m: a displacement belongs to the band where the confidence that it is exceeded less often than the
/// target is neither too small nor too large, as in [`inferred_limits`](crate::inferred_limits) by one curve.
///
/// # Errors
/// As [`inferred_rate_over_curves`]; a target that is not positive and finite.
pub fn inferred_limits_over_curves(
    demand: &PooledDemand,
    curves: &[(f64, StripeWeights)],
    units: &[Vec<usize>],
    (target_per_year, confidence): (f64, f64),
) -> Result<[f64; 2], RiskError> {
    check_target(target_per_year)?;
    let rates = rates_of(demand, curves, units)?;
    if units.len() < 2 || curves.is_empty() {
        return Ok([f64::NAN; 2]);
    }
    let mut inversion = Inversion::new(demand, rates);
    let mixture = Mixture::new(weights_of(curves), units, confidence);
    // in the middle of those by each curve the target is neither surely too large nor too small
    let mut ordinates_m: Vec<(f64, f64)> =
        inversion.ordinates_m(target_per_year).into_iter().zip(weights_of(curves)).collect();
    ordinates_m.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let ordinate_m = weighted_quantile(&ordinates_m, 0.5);
    Ok(inversion.limits_m(ordinate_m, &[1.0], |_, means| mixture.place(means, target_per_year))[0])
}

/// The rates by each curve.
fn rates_of(
    demand: &PooledDemand,
    curves: &[(f64, StripeWeights)],
    units: &[Vec<usize>],
) -> Result<Vec<Rates>, RiskError> {
    curves.iter().map(|(_, weights)| Rates::new(demand, weights.into(), units)).collect()
}

/// Limits of the rate, 1/yr, where each record contributes so much by each of several alternatives, hazard curves or
/// structures, of which one holds: what [`inferred_mean`](crate::inferred_mean) tells of one. NaN of a single unit, and
/// of no alternative.
///
/// - `alternatives`: weight of each, and what every record contributes by it, 1/yr, `[record]`; the weights need not
///   add up to 1.
///
/// # Errors
/// Units of other records.
pub fn inferred_mean_over_alternatives(
    alternatives: &[(f64, Vec<f64>)],
    units: &[Vec<usize>],
    confidence: f64,
) -> Result<[f64; 2], RiskError> {
    let means = alternatives.iter().map(|(_, of)| mean_of(of, units)).collect::<Result<Vec<_>, _>>()?;
    Ok(Mixture::new(weights_of(alternatives), units, confidence).interval(&means))
}

fn weights_of<T>(weighted: &[(f64, T)]) -> impl Iterator<Item = f64> + Clone {
    weighted.iter().map(|(weight, _)| *weight)
}

/// The confidence of several curves together.
struct Mixture {
    /// Of each curve; they add up to 1.
    weights: Vec<f64>,
    /// What the band leaves on either side.
    tail: f64,
    quantiles: StudentQuantiles,
    /// The same for as many units as the set has.
    of_set: SampleQuantiles,
    /// Student's distributions of 1, 2, … degrees of freedom.
    students: Vec<StudentsT>,
}

impl Mixture {
    fn new(weights: impl Iterator<Item = f64> + Clone, units: &[Vec<usize>], confidence: f64) -> Self {
        let total: f64 = weights.clone().sum();
        let students = (1..=units.len().max(1)).map_while(|freedom| StudentsT::new(0.0, 1.0, freedom as f64).ok());
        let quantiles = StudentQuantiles::new(confidence, units.len());
        Self {
            weights: weights.map(|weight| weight / total).collect(),
            tail: 0.5 * (1.0 - confidence),
            of_set: SampleQuantiles::new(units.len(), 1.0, &quantiles),
            quantiles,
            students: students.collect(),
        }
    }

    /// The confidence with which the rate is at most `value`, 0 to 1.
    fn confidence(&self, means: &[SkewedMean], value: f64) -> f64 {
        let of_curve = |mean: &SkewedMean| {
            if mean.deviation == 0.0 {
                return f64::from(u8::from(mean.mean <= value));
            }
            let deviate = mean.deviate(value, mean.units);
            let freedom = by_side(mean.degrees_of_freedom(mean.units), deviate);
            self.students[freedom.min(self.students.len()) - 1].cdf(-deviate)
        };
        self.weights.iter().zip(means).map(|(weight, mean)| weight * of_curve(mean)).sum()
    }

    /// Where a target rate lies in what `means` leave open: within −1 and 1 where it may be the truth, above 1 where
    /// they are too large for it.
    fn place(&self, means: &[SkewedMean], target_per_year: f64) -> f64 {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for place in means.iter().map(|mean| mean.place(target_per_year, &self.of_set)) {
            (least, most) = (least.min(place), most.max(place));
        }
        // where all curves agree there is nothing to weigh
        if least > 1.0 || most < -1.0 || (least >= -1.0 && most <= 1.0) {
            return if least > 1.0 { least } else { most };
        }
        match self.confidence(means, target_per_year) {
            confidence if confidence < self.tail => 2.0,
            confidence if confidence > 1.0 - self.tail => -2.0,
            _ => 0.0,
        }
    }

    /// The band of the rate; NaN of a single unit, and of no curve.
    fn interval(&self, means: &[SkewedMean]) -> [f64; 2] {
        if means.is_empty() || means.iter().any(|mean| mean.units < 2) {
            return [f64::NAN; 2];
        }
        let of_curves: Vec<[f64; 2]> = means.iter().map(|mean| mean.interval(&self.quantiles)).collect();
        [(0, self.tail), (1, 1.0 - self.tail)].map(|(end, level)| {
            let limits = || of_curves.iter().map(|interval| interval[end]);
            let (mut low, mut high) = (limits().fold(f64::INFINITY, f64::min), limits().fold(0.0, f64::max));
            if self.confidence(means, low) >= level {
                return low;
            }
            // at the highest limit every curve has the confidence: halved down to two numbers that follow each other
            loop {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    return high;
                }
                if self.confidence(means, middle) < level { low = middle } else { high = middle }
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use uplift_random::{Rng, stream};

    use super::*;
    use crate::skewed_mean::tests::mean_of;

    fn mixture(weights: &[f64], units: usize) -> Mixture {
        Mixture::new(weights.iter().copied(), &vec![vec![0]; units], 0.9)
    }

    // Records that do not scatter: what is left is which curve holds.
    #[test]
    fn without_scatter_it_is_the_quantile_of_the_curves() {
        let known = |rate: f64| mean_of(&[rate; 4]);
        let means = [known(1.0), known(2.0), known(3.0)];
        assert_eq!(mixture(&[0.25, 0.5, 0.25], 4).interval(&means), [1.0, 3.0]);
        // what 4 % of the weight is left for lies outside
        assert_eq!(mixture(&[0.04, 0.92, 0.04], 4).interval(&means), [2.0, 2.0]);
        assert_eq!(mixture(&[4.0, 92.0, 6.0], 4).interval(&means), [2.0, 3.0]);
    }

    #[test]
    fn one_curve_given_twice_is_that_curve() {
        let of_curve = mean_of(&[0.1, 0.2, 0.25, 0.4, 2.0, 0.3]);
        let twice = mixture(&[0.3, 0.7], 6);
        let interval = of_curve.interval(&StudentQuantiles::new(0.9, 6));
        for (found, expected) in twice.interval(&[of_curve; 2]).into_iter().zip(interval) {
            assert!((found - expected).abs() <= 1e-12 * expected, "{found} {expected}");
        }
        for target in [0.05, 0.2, 0.5, 1.0, 4.0] {
            let alone = of_curve.place(target, &twice.of_set);
            assert_eq!(twice.place(&[of_curve; 2], target).abs() <= 1.0, alone.abs() <= 1.0, "{target}");
        }
    }

    // Student's: of two curves whose rates are 1 ± 0.1 and 2 ± 0.1 the band leaves 5 % of both together, so the lower
    // limit is where the first has 10 %: 1 − 0.1 t(0.9), with 9 degrees of freedom t = 1.383029.
    #[test]
    fn curves_far_apart_share_the_tails() {
        let unit = [0.316_227_766_016_838; 5].into_iter().chain([-0.316_227_766_016_838; 5]);
        let values: Vec<f64> = unit.map(|of| of * 0.948_683_298_050_514).collect();
        let at = |mean: f64| mean_of(&values.iter().map(|value| mean + value).collect::<Vec<_>>());
        let [lower, upper] = mixture(&[1.0, 1.0], 10).interval(&[at(1.0), at(2.0)]);
        assert!((lower - (1.0 - 0.138_302_9)).abs() < 1e-6, "{lower}");
        assert!((upper - (2.0 + 0.138_302_9)).abs() < 1e-6, "{upper}");
    }

    /// A target may be the truth just where the band of the rate holds it; below the band the means are too large.
    #[test]
    fn the_place_of_a_target_is_that_in_the_band() {
        let known = |rate: f64| mean_of(&[rate; 4]);
        let scattered = |rate: f64| mean_of(&[0.6, 0.9, 1.0, 1.1, 1.4].map(|share| rate * share));
        for (weights, means) in [
            (vec![1.0, 1.0], vec![scattered(1.0), scattered(3.0)]),
            (vec![0.04, 0.92, 0.04], vec![scattered(0.2), scattered(1.0), scattered(9.0)]),
            (vec![0.3, 0.7], vec![known(1.0), scattered(2.0)]),
        ] {
            let mixture = mixture(&weights, means[1].units);
            let [lower, upper] = mixture.interval(&means);
            for (target, expected) in [(0.999 * lower, 1.0), (1.001 * lower, 0.0), (0.999 * upper, 0.0)] {
                let place = mixture.place(&means, target);
                let found = if place.abs() <= 1.0 { 0.0 } else { place.signum() };
                assert_eq!(found, expected, "{weights:?}: {target} of {lower} to {upper}");
            }
            assert!(mixture.place(&means, 1.001 * upper) < -1.0, "{weights:?}");
        }
    }

    // A truth that is known: one of three curves holds, drawn by their weights, and records contribute exponentially.
    #[test]
    fn it_holds_the_rate_of_the_curve_that_holds() {
        const UNITS: usize = 40;
        const RUNS: usize = 3000;
        let factors = [0.6, 1.0, 1.6];
        let weights = [0.25, 0.5, 0.25];
        let mixture = mixture(&weights, UNITS);
        let mut random = stream(b"uplift bootstrap  a test", 7, 0);
        let mut uniform = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let (mut held, mut beyond) = (0, [0, 0]);
        for _ in 0..RUNS {
            let which = uniform();
            let truth = factors[usize::from(which > 0.25) + usize::from(which > 0.75)];
            let drawn: Vec<f64> = (0..UNITS).map(|_| -(1.0 - uniform()).ln()).collect();
            let means = factors.map(|factor| mean_of(&drawn.iter().map(|value| factor * value).collect::<Vec<_>>()));
            let [lower, upper] = mixture.interval(&means);
            held += usize::from(lower <= truth && truth <= upper);
            beyond[0] += usize::from(truth < lower);
            beyond[1] += usize::from(truth > upper);
        }
        let share = |count: usize| count as f64 / RUNS as f64;
        // 90, 5 and 5 per cent promised
        assert!((0.88..=0.92).contains(&share(held)), "{}", share(held));
        assert!(beyond.iter().all(|&count| (0.04..=0.06).contains(&share(count))), "{beyond:?}");
    }
}
