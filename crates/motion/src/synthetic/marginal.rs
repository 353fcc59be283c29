//! The marginal distributions of the model parameters, as quantile functions.

use super::random::normal_probability;
use statrs::distribution::{Beta, ContinuousCDF, Gamma};

/// A marginal distribution (Rezaeian & Der Kiureghian 2010, Table III).
#[derive(Debug, Clone, Copy)]
pub(super) enum Marginal {
    /// Normal, by mean and standard deviation.
    Normal { mean: f64, deviation: f64 },
    /// Beta on \[low, low + width\].
    Beta { low: f64, width: f64, a: f64, b: f64 },
    /// Gamma, by shape and scale.
    Gamma { shape: f64, scale: f64 },
    /// Two-sided exponential on \[low, high\], low < 0 < high: density proportional to
    /// exp(rise x) below zero and to exp(−fall x) above.
    TwoSidedExponential { low: f64, high: f64, rise: f64, fall: f64 },
}

impl Marginal {
    /// The value whose probability of non-exceedance is Φ(`variate`).
    pub(super) fn at_normal(self, variate: f64) -> f64 {
        match self {
            Self::Normal { mean, deviation } => mean + deviation * variate,
            other => other.quantile(normal_probability(variate)),
        }
    }

    /// The value whose probability of non-exceedance is `probability`, in (0, 1).
    fn quantile(self, probability: f64) -> f64 {
        match self {
            Self::Normal { mean, deviation } => mean + deviation * super::random::normal_quantile(probability),
            Self::Beta { low, width, a, b } => {
                // Shapes are constants above zero: the constructor cannot fail.
                let unit = Beta::new(a, b).map_or(f64::NAN, |beta| beta.inverse_cdf(probability));
                low + width * unit
            }
            Self::Gamma { shape, scale } => scale * gamma_quantile(shape, probability),
            Self::TwoSidedExponential { low, high, rise, fall } => {
                // Masses of the two branches over the density at zero.
                let below = (1.0 - (rise * low).exp()) / rise;
                let above = (1.0 - (-fall * high).exp()) / fall;
                let mass = probability * (below + above);
                if mass < below {
                    ((rise * low).exp() + rise * mass).ln() / rise
                } else {
                    -(1.0 - fall * (mass - below)).ln() / fall
                }
            }
        }
    }
}

/// Quantile of the gamma distribution of unit scale.
pub(super) fn gamma_quantile(shape: f64, probability: f64) -> f64 {
    Gamma::new(shape, 1.0).map_or(f64::NAN, |gamma| gamma.inverse_cdf(probability))
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::Continuous;

    /// Simpson's rule, 2000 intervals.
    fn integral(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
        let n = 2000;
        let h = (to - from) / f64::from(n);
        (0..=n)
            .map(|i| {
                let weight = match i {
                    0 => 1.0,
                    i if i == n => 1.0,
                    i if i % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                weight * f(from + f64::from(i) * h)
            })
            .sum::<f64>()
            * h
            / 3.0
    }

    #[test]
    fn closed_forms() {
        // Beta(1, 1) is uniform, Beta(2, 1) has F = x², Gamma(1) is exponential.
        let beta = |a, b, p| Marginal::Beta { low: 0.0, width: 1.0, a, b }.quantile(p);
        for p in [1e-6, 0.03, 0.5, 0.9, 0.999_999] {
            assert!((beta(1.0, 1.0, p) - p).abs() < 1e-12);
            assert!((beta(2.0, 1.0, p) - p.sqrt()).abs() < 1e-12);
            assert!((gamma_quantile(1.0, p) + (1.0 - p).ln()).abs() < 1e-9);
        }
        let normal = Marginal::Normal { mean: -4.8255, deviation: 1.4318 };
        assert!((normal.quantile(0.5) + 4.8255).abs() < 1e-12);
        assert!((normal.at_normal(1.0) + 4.8255 - 1.4318).abs() < 1e-12);
        // χ² with 2 k degrees of freedom is 2 Gamma(k): 5 % point of χ²(10) is 3.940299.
        assert!((2.0 * gamma_quantile(5.0, 0.05) - 3.940_299).abs() < 1e-6);
        // Laplace with unit rates, not visibly truncated: median 0, quartiles ± ln 2.
        let laplace = Marginal::TwoSidedExponential { low: -40.0, high: 40.0, rise: 1.0, fall: 1.0 };
        assert!(laplace.quantile(0.5).abs() < 1e-12);
        assert!((laplace.quantile(0.25) + 2.0_f64.ln()).abs() < 1e-12);
        assert!((laplace.quantile(0.75) - 2.0_f64.ln()).abs() < 1e-12);
    }

    /// The mass of the density up to each quantile, integrated by Simpson's rule, is the
    /// probability: independent of the library's distribution function.
    #[test]
    fn quantiles_of_the_model_marginals_invert_their_densities() {
        let beta = |a: f64, b: f64| {
            let density = move |x: f64| x.powf(a - 1.0) * (1.0 - x).powf(b - 1.0);
            // x = s² takes the infinite slope at zero away.
            let mass = move |x: f64| integral(|s| 2.0 * s * density(s * s), 0.0, x.sqrt());
            // From 1 − x: the same with a and b exchanged, near 1.
            move |x: f64| mass(x) / mass(1.0)
        };
        let gamma = |shape: f64| {
            let mass = move |x: f64| integral(|t| t.powf(shape - 1.0) * (-t).exp(), 0.0, x);
            move |x: f64| mass(x) / mass(60.0)
        };
        for p in [0.001, 0.05, 0.25, 0.5, 0.75, 0.95, 0.999] {
            for (a, b) in [(1.1314, 2.4474), (1.5792, 3.6405), (1.4250, 5.7208)] {
                let x = Marginal::Beta { low: 0.0, width: 1.0, a, b }.quantile(p);
                assert!((beta(a, b)(x) - p).abs() < 1e-5, "Beta({a}, {b}) {p}");
            }
            let x = gamma_quantile(4.0982, p);
            assert!((gamma(4.0982)(x) - p).abs() < 1e-6, "Gamma {p}");
        }
    }

    #[test]
    fn round_trips_through_the_distribution_function() {
        for i in -55..=55 {
            let p = normal_probability(f64::from(i) / 10.0);
            for (a, b) in [(1.1314, 2.4474), (1.5792, 3.6405), (1.4250, 5.7208)] {
                let x = Marginal::Beta { low: 0.0, width: 1.0, a, b }.quantile(p);
                let beta = Beta::new(a, b).unwrap();
                // An error of the quantile weighs with the density there.
                assert!((beta.cdf(x) - p).abs() < 1e-12 * (1.0 + beta.pdf(x)), "Beta({a}, {b}) at {p}: {x}");
            }
            for shape in [1.0, 4.0982, 700.0] {
                let x = gamma_quantile(shape, p);
                let q = Gamma::new(shape, 1.0).unwrap().cdf(x);
                assert!((q - p).abs() < 1e-9, "Gamma({shape}) at {p}: {q}");
            }
        }
    }

    #[test]
    fn two_sided_exponential_matches_the_published_density() {
        let marginal = Marginal::TwoSidedExponential { low: -2.0, high: 0.5, rise: 6.7729, fall: 17.095 };
        let density = |x: f64| 4.8512 * if x < 0.0 { (6.7729 * x).exp() } else { (-17.095 * x).exp() };
        // The printed constant holds to its digits ...
        let total = integral(density, -2.0, 0.0) + integral(density, 0.0, 0.5);
        assert!((total - 1.0).abs() < 2e-4, "{total}");
        // ... and the quantiles invert the density.
        for p in [1e-4, 0.1, 0.5, 0.7, 0.75, 0.9, 0.9999] {
            let x = marginal.quantile(p);
            let mass = integral(density, -2.0, x.min(0.0)) + if x > 0.0 { integral(density, 0.0, x) } else { 0.0 };
            assert!((mass / total - p).abs() < 1e-9, "{p}: {x}");
        }
        assert!((marginal.quantile(1e-15) + 2.0).abs() < 1e-8);
        assert!((marginal.quantile(1.0 - 1e-15) - 0.5).abs() < 1e-8);
    }
}
