//! The fragility over two intensity measures together: a surface.

use crate::FragilityError;
use crate::normal::{ln_normal_cdf, ln_normal_cdf_slope, normal_cdf};

/// P(exceedance | x, y) = Φ(a + b ln x + c ln y): lognormal in either measure where the other is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FragilitySurface {
    /// a, b and c.
    pub coefficients: [f64; 3],
}

impl FragilitySurface {
    /// Probability of exceedance at the two intensities, both above 0.
    pub fn probability(&self, intensities: [f64; 2]) -> f64 {
        let [a, b, c] = self.coefficients;
        normal_cdf(a + b * intensities[0].ln() + c * intensities[1].ln())
    }
}

/// What one analysis says of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceTrial {
    /// The two intensities, above 0.
    pub intensities: [f64; 2],
    /// Whether the threshold was exceeded.
    pub exceeds: bool,
    /// Number of the record, pair or earthquake: trials of one unit depend on each other.
    pub unit: usize,
}

/// A fitted surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceFit {
    /// The surface of maximum likelihood.
    pub surface: FragilitySurface,
    /// Standard errors of its coefficients, robust against dependence within a unit; infinite of fewer than two units.
    pub standard_errors: [f64; 3],
    /// Its log-likelihood Σ ln p over what exceeds, and ln(1 − p) over what does not.
    pub log_likelihood: f64,
    /// Largest difference between predicted and counted share in any tenth of the trials, by ascending prediction;
    /// trials of the same prediction are not parted.
    pub largest_error: f64,
}

const MAX_ITERATIONS: usize = 100;
/// Mean −ln p of the trials below which all are as good as certain: only separated trials let a surface be so.
const CERTAIN: f64 = 1e-6;

/// Maximum-likelihood surface through `trials`.
///
/// The log-likelihood is concave in the coefficients: damped Newton steps reach its maximum, where it has one. The
/// standard errors are those of the sandwich, with the gradients summed over each unit, and n/(n − 1) for n units.
///
/// # Errors
/// Intensities that are not positive and finite; no exceedance, or nothing but exceedances; intensities that rise and
/// fall together ([`FragilityError::Collinear`]); trials that a line separates ([`FragilityError::NoSurface`]).
///
/// # Source
/// A probit regression. The errors: K.-Y. Liang and S. L. Zeger, Biometrika 73 (1986).
pub fn fit_surface(trials: &[SurfaceTrial]) -> Result<SurfaceFit, FragilityError> {
    for (index, trial) in trials.iter().enumerate() {
        if let Some(&value) = trial.intensities.iter().find(|value| !(value.is_finite() && **value > 0.0)) {
            return Err(FragilityError::Intensity { index, value });
        }
    }
    if !trials.iter().any(|trial| trial.exceeds) {
        return Err(FragilityError::NoExceedance);
    }
    if trials.iter().all(|trial| trial.exceeds) {
        return Err(FragilityError::AllExceed);
    }
    let n = trials.len() as f64;
    let mean: [f64; 2] = [0, 1].map(|of| trials.iter().map(|trial| trial.intensities[of].ln()).sum::<f64>() / n);
    let deviation: [f64; 2] = [0, 1]
        .map(|of| (trials.iter().map(|trial| (trial.intensities[of].ln() - mean[of]).powi(2)).sum::<f64>() / n).sqrt());
    // standardised, the equations are well conditioned in any unit
    let rows: Vec<[f64; 3]> = trials
        .iter()
        .map(|trial| {
            let [x, y] = [0, 1].map(|of| (trial.intensities[of].ln() - mean[of]) / deviation[of]);
            [1.0, x, y]
        })
        .collect();
    let correlation = rows.iter().map(|[_, x, y]| x * y).sum::<f64>() / n;
    // NaN where a measure has one value only
    if !(correlation.abs() < 1.0 - 1e-9) {
        return Err(FragilityError::Collinear);
    }

    let mut at = [0.0; 3];
    let mut here = Likelihood::at(trials, &rows, at);
    for _ in 0..MAX_ITERATIONS {
        let Some(inverse) = inverse(here.curvature) else { break };
        let step = times(&inverse, here.gradient);
        let converged = (0..3).all(|k| step[k].abs() <= 1e-10 * (1.0 + at[k].abs()));
        if converged {
            return (-here.value > CERTAIN * n)
                .then(|| finish(trials, &rows, (at, here.value), &inverse, (mean, deviation)))
                .ok_or(FragilityError::NoSurface);
        }
        let floor = here.value - 1e-13 * here.value.abs();
        let mut fraction = 1.0;
        loop {
            let next = [0, 1, 2].map(|k| at[k] + fraction * step[k]);
            let there = Likelihood::at(trials, &rows, next);
            if there.value >= floor || fraction < 1e-9 {
                (at, here) = (next, there);
                break;
            }
            fraction *= 0.5;
        }
    }
    Err(FragilityError::NoSurface)
}

/// The fit in the measures themselves, with its errors.
fn finish(
    trials: &[SurfaceTrial],
    rows: &[[f64; 3]],
    (at, log_likelihood): ([f64; 3], f64),
    inverse: &[[f64; 3]; 3],
    (mean, deviation): ([f64; 2], [f64; 2]),
) -> SurfaceFit {
    let mut of_unit = std::collections::BTreeMap::<usize, [f64; 3]>::new();
    for (trial, row) in trials.iter().zip(rows) {
        let gradient = gradient(trial, row, at);
        let sum = of_unit.entry(trial.unit).or_default();
        *sum = [0, 1, 2].map(|k| sum[k] + gradient[k]);
    }
    // a + b (ln x − mean)/deviation + …, back in powers of ln x and ln y: a linear map of the coefficients
    let [b, c] = deviation.map(|deviation| 1.0 / deviation);
    let back = [[1.0, -mean[0] * b, -mean[1] * c], [0.0, b, 0.0], [0.0, 0.0, c]];
    let units = of_unit.len() as f64;
    let mut variances = [0.0; 3];
    for gradient in of_unit.values() {
        let influence = times(&back, times(inverse, *gradient));
        variances = [0, 1, 2].map(|k| variances[k] + influence[k] * influence[k]);
    }
    let standard_errors =
        variances.map(|variance| if units < 2.0 { f64::INFINITY } else { (variance * units / (units - 1.0)).sqrt() });
    let surface = FragilitySurface { coefficients: times(&back, at) };
    SurfaceFit { surface, standard_errors, log_likelihood, largest_error: largest_error(trials, surface) }
}

/// Largest difference between mean prediction and counted share in about ten equal parts of the trials, which keep
/// trials of the same prediction together.
fn largest_error(trials: &[SurfaceTrial], surface: FragilitySurface) -> f64 {
    let mut predicted: Vec<(f64, bool)> =
        trials.iter().map(|trial| (surface.probability(trial.intensities), trial.exceeds)).collect();
    predicted.sort_by(|one, other| one.0.total_cmp(&other.0));
    let least = predicted.len().div_ceil(10);
    let (mut largest, mut sum, mut count) = (0.0_f64, 0.0, 0);
    for (place, &(probability, exceeds)) in predicted.iter().enumerate() {
        sum += probability - f64::from(u8::from(exceeds));
        count += 1;
        let next = predicted.get(place + 1).map(|next| next.0);
        if next.is_none() || count >= least && next != Some(probability) {
            largest = largest.max((sum / count as f64).abs());
            (sum, count) = (0.0, 0);
        }
    }
    largest
}

fn predictor(row: &[f64; 3], at: [f64; 3]) -> f64 {
    (0..3).map(|k| row[k] * at[k]).sum()
}

fn sign(trial: &SurfaceTrial) -> f64 {
    if trial.exceeds { 1.0 } else { -1.0 }
}

fn gradient(trial: &SurfaceTrial, row: &[f64; 3], at: [f64; 3]) -> [f64; 3] {
    let sign = sign(trial);
    let slope = sign * ln_normal_cdf_slope(sign * predictor(row, at));
    row.map(|value| slope * value)
}

/// The log-likelihood with its gradient and (negative) second derivatives.
struct Likelihood {
    value: f64,
    gradient: [f64; 3],
    curvature: [[f64; 3]; 3],
}

impl Likelihood {
    fn at(trials: &[SurfaceTrial], rows: &[[f64; 3]], at: [f64; 3]) -> Self {
        let mut sum = Self { value: 0.0, gradient: [0.0; 3], curvature: [[0.0; 3]; 3] };
        for (trial, row) in trials.iter().zip(rows) {
            let sign = sign(trial);
            let t = sign * predictor(row, at);
            let slope = ln_normal_cdf_slope(t);
            let bend = slope * (slope + t);
            sum.value += ln_normal_cdf(t);
            for i in 0..3 {
                sum.gradient[i] += sign * slope * row[i];
                for j in 0..3 {
                    sum.curvature[i][j] += bend * row[i] * row[j];
                }
            }
        }
        sum
    }
}

fn times(matrix: &[[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| predictor(&row, vector))
}

/// The inverse of a symmetric matrix by its cofactors; none where it has none.
fn inverse(m: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cofactor = |i: usize, j: usize| {
        let [[r, s], [c, d]] = [[(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]];
        m[r][c] * m[s][d] - m[r][d] * m[s][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    let size = m[0][0] * m[1][1] * m[2][2];
    (determinant > 1e-12 * size).then(|| [0, 1, 2].map(|i| [0, 1, 2].map(|j| cofactor(j, i) / determinant)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// At every point of a grid a thousand trials, of which the share that the surface says exceeds, to a rounding.
    fn exact(coefficients: [f64; 3]) -> Vec<SurfaceTrial> {
        let surface = FragilitySurface { coefficients };
        let mut trials = Vec::new();
        for x in [0.5, 1.0, 2.0, 4.0] {
            for y in [0.2, 0.6, 1.8] {
                let probability = surface.probability([x, y]);
                let before = trials.len();
                trials.extend((0..1000).map(|trial| SurfaceTrial {
                    intensities: [x, y],
                    exceeds: (trial as f64 + 0.5) / 1000.0 < probability,
                    unit: before + trial,
                }));
            }
        }
        trials
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn trials_of_a_surface_give_it_back(a in -1.0..1.0_f64, b in 0.3..1.5_f64, c in 0.3..1.5_f64) {
            let fit = fit_surface(&exact([a, b, c])).unwrap();
            for (found, expected) in fit.surface.coefficients.iter().zip([a, b, c]) {
                prop_assert!((found - expected).abs() < 0.01, "{fit:?}");
            }
            prop_assert!(fit.largest_error < 0.01);
            // ten thousand independent trials leave a few hundredths
            prop_assert!(fit.standard_errors.iter().all(|error| *error > 0.005 && *error < 0.08), "{fit:?}");
        }
    }

    /// Three coefficients meet three counted shares: their Φ⁻¹ lie on the plane.
    #[test]
    fn three_points_by_hand() {
        let at = |intensities: [f64; 2], exceedances: usize| {
            (0..10).map(move |trial| SurfaceTrial { intensities, exceeds: trial < exceedances, unit: trial })
        };
        let e = std::f64::consts::E;
        let trials: Vec<_> = at([1.0, 1.0], 3).chain(at([e, 1.0], 5)).chain(at([1.0, e], 9)).collect();
        let fit = fit_surface(&trials).unwrap();
        let [low, middle, high] = [0.3, 0.5, 0.9].map(crate::normal_quantile);
        for (found, expected) in fit.surface.coefficients.iter().zip([low, middle - low, high - low]) {
            assert!((found - expected).abs() < 1e-8, "{fit:?}");
        }
        let likelihood = [(3.0_f64, 7.0_f64), (5.0, 5.0), (9.0, 1.0)];
        let expected: f64 = likelihood.iter().map(|(k, n)| k * (k / 10.0).ln() + n * (n / 10.0).ln()).sum();
        assert!((fit.log_likelihood - expected).abs() < 1e-10);
    }

    /// The same trial twice in the same unit tells nothing new.
    #[test]
    fn repeated_trials_of_a_unit_leave_the_errors_as_they_are() {
        let once: Vec<_> = exact([0.1, 0.8, 0.6]).into_iter().step_by(37).collect();
        let twice: Vec<_> = once.iter().flat_map(|trial| [*trial, *trial]).collect();
        let [once, twice] = [once, twice].map(|trials| fit_surface(&trials).unwrap());
        for (one, other) in once.standard_errors.iter().zip(twice.standard_errors) {
            assert!((one / other - 1.0).abs() < 1e-6, "{once:?} {twice:?}");
        }
    }

    #[test]
    fn refuses_what_has_no_maximum() {
        let trial = |x, y, exceeds| SurfaceTrial { intensities: [x, y], exceeds, unit: 0 };
        let refused = |trials: &[SurfaceTrial]| fit_surface(trials).unwrap_err();
        assert!(matches!(refused(&[trial(0.0, 1.0, true)]), FragilityError::Intensity { index: 0, .. }));
        assert_eq!(refused(&[trial(1.0, 1.0, false)]), FragilityError::NoExceedance);
        assert_eq!(refused(&[trial(1.0, 1.0, true)]), FragilityError::AllExceed);
        let together = [trial(1.0, 2.0, false), trial(2.0, 4.0, true), trial(4.0, 8.0, false)];
        assert_eq!(refused(&together), FragilityError::Collinear);
        let separated = [trial(1.0, 2.0, false), trial(2.0, 1.0, false), trial(4.0, 5.0, true), trial(6.0, 3.0, true)];
        assert_eq!(refused(&separated), FragilityError::NoSurface);
    }
}
