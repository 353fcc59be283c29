//! The lognormal fragility and its maximum-likelihood fit: beside the empirical one, never instead of it.

use crate::normal::{ln_normal_cdf, ln_normal_cdf_slope, normal_cdf};
use crate::stripes::check_levels;
use crate::{FragilityError, Stripes, exceedance_counts};

/// P(exceedance | im) = Φ(ln(im/median)/dispersion).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LognormalFragility {
    median: f64,
    dispersion: f64,
}

impl LognormalFragility {
    /// From the median θ (in the unit of the intensity measure) and the dispersion β (standard deviation of ln im).
    ///
    /// # Errors
    /// A parameter that is not positive and finite.
    pub fn new(median: f64, dispersion: f64) -> Result<Self, FragilityError> {
        for (name, value) in [("median", median), ("dispersion", dispersion)] {
            if !value.is_finite() || value <= 0.0 {
                return Err(FragilityError::Parameter { name, value });
            }
        }
        Ok(Self { median, dispersion })
    }

    /// Median θ, in the unit of the intensity measure.
    pub fn median(&self) -> f64 {
        self.median
    }

    /// Dispersion β: standard deviation of ln im.
    pub fn dispersion(&self) -> f64 {
        self.dispersion
    }

    /// Probability of exceedance at intensity `im` > 0, in the unit of the median.
    pub fn probability(&self, im: f64) -> f64 {
        normal_cdf((im / self.median).ln() / self.dispersion)
    }
}

/// Exceedances counted at one stripe level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripeCount {
    /// The level, in the unit of the intensity measure.
    pub level: f64,
    /// Number of trials that exceeded the threshold.
    pub exceedances: u32,
    /// Number of trials.
    pub trials: u32,
}

/// Counts the exceedances of `threshold_m` at every level: what [`fit_lognormal`] takes.
///
/// # Errors
/// A threshold that is negative or not finite.
pub fn stripe_counts(stripes: &Stripes, threshold_m: f64) -> Result<Vec<StripeCount>, FragilityError> {
    // `Stripes` holds no more records than a `u32` counts.
    let trials = |level: usize| u32::try_from(stripes.stripe(level).count()).unwrap_or(u32::MAX);
    let counts = exceedance_counts(stripes, threshold_m)?;
    Ok(stripes
        .levels()
        .iter()
        .zip(counts)
        .enumerate()
        .map(|(index, (&level, exceedances))| StripeCount { level, exceedances, trials: trials(index) })
        .collect())
}

/// A fitted lognormal fragility.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LognormalFit {
    /// The fragility of maximum likelihood.
    pub fragility: LognormalFragility,
    /// Its log-likelihood Σ k ln p + (n − k) ln(1 − p), without the constant binomial coefficients.
    pub log_likelihood: f64,
}

/// Largest number of Newton steps; the likelihood is concave, so a handful is usual.
const MAX_ITERATIONS: usize = 100;

/// Maximum-likelihood lognormal fragility for counts of exceedance, binomial at each level.
///
/// With p = Φ(a + b x), x = ln(level) standardised, the log-likelihood is concave in (a, b): damped Newton steps reach
/// its one maximum, where it has one.
///
/// # Errors
/// Bad levels or counts; no maximum ([`FragilityError::NoExceedance`], [`FragilityError::AllExceed`],
/// [`FragilityError::Separated`]); a fit that falls with intensity.
///
/// # Source
/// J. W. Baker, "Efficient analytical fragility function fitting using dynamic structural analysis", Earthquake
/// Spectra 31 (2015).
pub fn fit_lognormal(counts: &[StripeCount]) -> Result<LognormalFit, FragilityError> {
    check_counts(counts)?;
    let scale = LogScale::new(counts);
    let (mut a, mut b) = (0.0, 1.0);
    let mut here = Likelihood::at(counts, &scale, a, b);
    for _ in 0..MAX_ITERATIONS {
        let [step_a, step_b] = here.newton_step();
        let converged = step_a.abs() <= 1e-9 * (1.0 + a.abs()) && step_b.abs() <= 1e-9 * (1.0 + b.abs());
        // Halve until the likelihood does not fall by more than its own rounding.
        let floor = here.value - 1e-13 * here.value.abs();
        let mut fraction = 1.0;
        loop {
            let there = Likelihood::at(counts, &scale, a + fraction * step_a, b + fraction * step_b);
            if converged || there.value >= floor || fraction < 1e-9 {
                (a, b, here) = (a + fraction * step_a, b + fraction * step_b, there);
                break;
            }
            fraction *= 0.5;
        }
        if converged {
            if b <= 0.0 {
                return Err(FragilityError::NotRising);
            }
            return Ok(LognormalFit {
                fragility: LognormalFragility::new((scale.mean - a / b * scale.deviation).exp(), scale.deviation / b)?,
                log_likelihood: here.value,
            });
        }
    }
    Err(FragilityError::NoConvergence { iterations: MAX_ITERATIONS })
}

/// The fits of `stripes` without each of the `units` in turn, its records left out at all levels, `[unit]`.
///
/// - `units`: positions of the records of each record, pair or earthquake.
///
/// # Errors
/// A threshold that is negative or not finite; as [`fit_lognormal`] for any of them.
pub fn fits_without_each(
    stripes: &Stripes,
    threshold_m: f64,
    units: &[Vec<usize>],
) -> Result<Vec<LognormalFit>, FragilityError> {
    let all = stripe_counts(stripes, threshold_m)?;
    let without = |unit: &Vec<usize>| {
        let count = |(level, count): (usize, &StripeCount)| {
            let (mut exceedances, mut trials) = (count.exceedances, count.trials);
            for &record in unit.iter().filter(|&&record| stripes.belongs(record, level)) {
                trials -= 1;
                exceedances -= u32::from(stripes.record(record)[level] > threshold_m);
            }
            StripeCount { exceedances, trials, ..*count }
        };
        fit_lognormal(&all.iter().enumerate().map(count).collect::<Vec<_>>())
    };
    units.iter().map(without).collect()
}

/// Refuses counts that are wrong, and counts whose likelihood has no maximum.
fn check_counts(counts: &[StripeCount]) -> Result<(), FragilityError> {
    check_levels(&counts.iter().map(|count| count.level).collect::<Vec<_>>())?;
    for &StripeCount { level, exceedances, trials } in counts {
        if exceedances > trials {
            return Err(FragilityError::Count { level, exceedances, trials });
        }
    }
    let exceeding = |count: &&StripeCount| count.exceedances > 0;
    let surviving = |count: &&StripeCount| count.exceedances < count.trials;
    let (Some(first_exceedance), Some(last_exceedance)) =
        (counts.iter().find(exceeding), counts.iter().rfind(exceeding))
    else {
        return Err(FragilityError::NoExceedance);
    };
    let (Some(first_survival), Some(last_survival)) = (counts.iter().find(surviving), counts.iter().rfind(surviving))
    else {
        return Err(FragilityError::AllExceed);
    };
    if last_survival.level <= first_exceedance.level {
        return Err(FragilityError::Separated {
            first_exceedance: first_exceedance.level,
            last_survival: last_survival.level,
        });
    }
    if last_exceedance.level <= first_survival.level {
        return Err(FragilityError::NotRising);
    }
    Ok(())
}

/// Mean and deviation of ln(level): standardised, the Newton equations are well conditioned in any unit.
struct LogScale {
    mean: f64,
    deviation: f64,
}

impl LogScale {
    fn new(counts: &[StripeCount]) -> Self {
        let n = counts.len() as f64;
        let mean = counts.iter().map(|count| count.level.ln()).sum::<f64>() / n;
        let variance = counts.iter().map(|count| (count.level.ln() - mean).powi(2)).sum::<f64>() / n;
        Self { mean, deviation: variance.sqrt() }
    }
}

/// The log-likelihood with its gradient and (negative) second derivatives in (a, b).
struct Likelihood {
    value: f64,
    gradient: [f64; 2],
    curvature: [f64; 3],
}

impl Likelihood {
    fn at(counts: &[StripeCount], scale: &LogScale, a: f64, b: f64) -> Self {
        let mut sum = Self { value: 0.0, gradient: [0.0; 2], curvature: [0.0; 3] };
        for count in counts {
            let x = (count.level.ln() - scale.mean) / scale.deviation;
            let t = a + b * x;
            // Exceedances see ln Φ(t), survivals ln Φ(−t): both kept accurate in their tails.
            for (weight, sign) in [(count.exceedances, 1.0), (count.trials - count.exceedances, -1.0)] {
                if weight == 0 {
                    continue;
                }
                let (weight, t) = (f64::from(weight), sign * t);
                let slope = ln_normal_cdf_slope(t);
                let bend = weight * slope * (slope + t);
                sum.value += weight * ln_normal_cdf(t);
                sum.gradient[0] += weight * sign * slope;
                sum.gradient[1] += weight * sign * slope * x;
                sum.curvature[0] += bend;
                sum.curvature[1] += bend * x;
                sum.curvature[2] += bend * x * x;
            }
        }
        sum
    }

    /// Solves curvature · step = gradient.
    fn newton_step(&self) -> [f64; 2] {
        let [aa, ab, bb] = self.curvature;
        let [ga, gb] = self.gradient;
        let determinant = aa * bb - ab * ab;
        [(bb * ga - ab * gb) / determinant, (aa * gb - ab * ga) / determinant]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    use super::*;
    use proptest::prelude::*;

    fn counts(levels: &[f64], exceedances: &[u32], trials: u32) -> Vec<StripeCount> {
        levels
            .iter()
            .zip(exceedances)
            .map(|(&level, &exceedances)| StripeCount { level, exceedances, trials })
            .collect()
    }

    /// Counts as a given fragility would have them, up to rounding to whole numbers.
    fn ideal(levels: &[f64], truth: &LognormalFragility, trials: u32) -> Vec<StripeCount> {
        let exceedances: Vec<u32> =
            levels.iter().map(|&level| (truth.probability(level) * f64::from(trials)).round() as u32).collect();
        counts(levels, &exceedances, trials)
    }

    /// Written out plainly from the definition, as an independent check.
    fn plain_log_likelihood(counts: &[StripeCount], median: f64, dispersion: f64) -> f64 {
        let fragility = LognormalFragility::new(median, dispersion).unwrap();
        counts
            .iter()
            .map(|count| {
                let p = fragility.probability(count.level);
                f64::from(count.exceedances) * p.ln() + f64::from(count.trials - count.exceedances) * (1.0 - p).ln()
            })
            .sum()
    }

    #[test]
    fn two_levels_are_met_exactly() {
        // Two levels, two parameters: Φ(ln(2/θ)/β) = 1/4, Φ(ln(8/θ)/β) = 3/4 by symmetry at θ = 4,
        // and ln 2 / β = Φ⁻¹(3/4) = 0.674489750196082.
        let fit = fit_lognormal(&counts(&[2.0, 8.0], &[25, 75], 100)).unwrap().fragility;
        assert!((fit.median() - 4.0).abs() < 1e-12, "{fit:?}");
        assert!((fit.dispersion() - 2.0_f64.ln() / 0.674_489_750_196_082).abs() < 1e-12, "{fit:?}");
    }

    #[test]
    fn without_a_record_the_fit_is_that_of_the_others() {
        let inf = f64::INFINITY;
        let demands = [0.1, inf, inf, 0.1, 0.2, inf, 0.1, 0.1, 0.2, inf, 0.1, inf];
        let each: Vec<Vec<usize>> = (0..4).map(|record| vec![record]).collect();
        let fits = fits_without_each(&Stripes::new(&[1.0, 2.0, 4.0], &demands).unwrap(), 1e9, &each).unwrap();
        assert_eq!(fits.len(), 4);
        for (record, fit) in fits.iter().enumerate() {
            let others = demands.chunks(3).enumerate().filter(|(other, _)| *other != record);
            let others: Vec<f64> = others.flat_map(|(_, of)| of.to_vec()).collect();
            let stripes = Stripes::new(&[1.0, 2.0, 4.0], &others).unwrap();
            assert_eq!(*fit, fit_lognormal(&stripe_counts(&stripes, 1e9).unwrap()).unwrap());
        }
    }

    #[test]
    fn says_when_there_is_nothing_to_fit() {
        let levels = [1.0, 2.0, 3.0];
        let fit = |exceedances: &[u32]| fit_lognormal(&counts(&levels, exceedances, 10)).unwrap_err();
        assert_eq!(fit(&[0, 0, 0]), FragilityError::NoExceedance);
        assert_eq!(fit_lognormal(&[]).unwrap_err(), FragilityError::NoExceedance);
        assert_eq!(fit(&[10, 10, 10]), FragilityError::AllExceed);
        assert!(matches!(fit(&[0, 0, 10]), FragilityError::Separated { .. }));
        // One mixed level alone fixes one parameter, not two.
        assert!(matches!(fit(&[0, 4, 10]), FragilityError::Separated { .. }));
        assert_eq!(fit(&[10, 4, 0]), FragilityError::NotRising);
        assert_eq!(fit(&[6, 5, 4]), FragilityError::NotRising);
        assert!(matches!(fit(&[0, 11, 3]), FragilityError::Count { .. }));
    }

    #[test]
    fn a_survival_far_out_in_the_tail_keeps_the_likelihood_finite() {
        // One record in a million survives far above the median: at the start its t is 40 and more deviations away.
        let fit =
            fit_lognormal(&counts(&[1.0, 1.01, 1.02, 1e9], &[0, 500_000, 1_000_000, 999_999], 1_000_000)).unwrap();
        assert!(fit.log_likelihood.is_finite());
        assert!(fit.fragility.dispersion() > 0.0);
    }

    proptest! {
        #[test]
        fn recovers_a_known_fragility_in_any_unit(median in 0.1..3.0, dispersion in 0.1..1.0, unit in 0.01..1000.0) {
            let levels: Vec<f64> = (0..25).map(|i| unit * 0.05 * 1.3_f64.powi(i)).collect();
            let truth = LognormalFragility::new(unit * median, dispersion).unwrap();
            let fit = fit_lognormal(&ideal(&levels, &truth, 1_000_000_000)).unwrap().fragility;
            // Rounding 1e9 trials to whole records moves probabilities by 1e-9.
            prop_assert!((fit.median() / truth.median() - 1.0).abs() < 1e-7);
            prop_assert!((fit.dispersion() / truth.dispersion() - 1.0).abs() < 1e-7);
        }

        #[test]
        fn no_neighbour_is_likelier(exceedances in prop::collection::vec(0_u32..=20, 6)) {
            let levels = [1.0, 1.5, 2.0, 3.0, 4.0, 6.0];
            let counts = counts(&levels, &exceedances, 20);
            let Ok(fit) = fit_lognormal(&counts) else { return Ok(()) };
            let (median, dispersion) = (fit.fragility.median(), fit.fragility.dispersion());
            // An almost level trend has an astronomic dispersion: leave it out, its probabilities are all alike.
            prop_assume!(dispersion < 10.0);
            let best = plain_log_likelihood(&counts, median, dispersion);
            prop_assert!((best - fit.log_likelihood).abs() < 1e-9 * best.abs());
            for (up, out) in [(1.001, 1.0), (0.999, 1.0), (1.0, 1.001), (1.0, 0.999), (1.001, 0.999), (0.999, 1.001)] {
                prop_assert!(plain_log_likelihood(&counts, median * up, dispersion * out) <= best + 1e-12 * best.abs());
            }
            // First-order condition, by central differences of the plain likelihood.
            let h = 1e-5;
            let slope = |up: f64, out: f64| {
                (plain_log_likelihood(&counts, median * (1.0 + up * h), dispersion * (1.0 + out * h))
                    - plain_log_likelihood(&counts, median * (1.0 - up * h), dispersion * (1.0 - out * h)))
                    / (2.0 * h)
            };
            prop_assert!(slope(1.0, 0.0).abs() < 1e-4 && slope(0.0, 1.0).abs() < 1e-4);
        }
    }
}
