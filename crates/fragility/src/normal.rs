//! The standard normal distribution with tails that do not collapse.
//!
//! The complementary error function comes from `libm`, good to the last bits; that of `statrs` 0.19 is off by 1e-10.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use libm::erfc;

/// Below this argument the asymptotic series is as exact as the complementary error function, and does not underflow.
const FAR_TAIL: f64 = -30.0;

/// Standard normal distribution function Φ(x), relatively accurate in the lower tail as well.
pub fn normal_cdf(x: f64) -> f64 {
    0.5 * erfc(-x * FRAC_1_SQRT_2)
}

/// ln Φ(x), finite and accurate for every finite x up to about 1e154 in magnitude.
pub fn ln_normal_cdf(x: f64) -> f64 {
    if x > 0.0 {
        (-normal_cdf(-x)).ln_1p()
    } else if x > FAR_TAIL {
        normal_cdf(x).ln()
    } else {
        // Φ(x) = φ(x)/|x| · (1 − 1/x² + 3/x⁴ − …)
        -0.5 * x * x - 0.5 * (2.0 * PI).ln() - (-x).ln() + far_tail_series(x).ln()
    }
}

/// The quantile Φ⁻¹(p) of the standard normal distribution: where [`normal_cdf`] has p, found by halving; infinite at 0
/// and 1.
pub fn normal_quantile(probability: f64) -> f64 {
    if probability > 0.5 {
        // the upper tail has no digits to lose where the lower one is searched
        return -normal_quantile(1.0 - probability);
    }
    let (mut low, mut high) = (-40.0, 0.0);
    if probability <= 0.0 {
        return f64::NEG_INFINITY;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if normal_cdf(middle) < probability { low = middle } else { high = middle }
    }
}

/// φ(x)/Φ(x): the slope of ln Φ.
pub(crate) fn ln_normal_cdf_slope(x: f64) -> f64 {
    if x > FAR_TAIL { (-0.5 * x * x).exp() / (2.0 * PI).sqrt() / normal_cdf(x) } else { -x / far_tail_series(x) }
}

fn far_tail_series(x: f64) -> f64 {
    let q = 1.0 / (x * x);
    1.0 - q * (1.0 - 3.0 * q * (1.0 - 5.0 * q * (1.0 - 7.0 * q * (1.0 - 9.0 * q))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, relative: f64) {
        assert!((a - b).abs() <= relative * b.abs(), "{a} against {b}");
    }

    #[test]
    fn quantiles_are_the_inverse() {
        // Φ⁻¹(0.1), Φ⁻¹(0.975) and Φ⁻¹(1e-10) as tabulated
        for (p, x) in [(0.1, -1.281_551_565_544_600_4), (0.975, 1.959_963_984_540_054), (1e-10, -6.361_340_902_404_056)]
        {
            assert!((normal_quantile(p) - x).abs() < 1e-13 * x.abs(), "{p} {}", normal_quantile(p));
        }
        // Φ rounds to a half on all of these
        assert!(normal_quantile(0.5).abs() < 2.0 * f64::EPSILON);
        assert_eq!([normal_quantile(0.0), normal_quantile(1.0)], [f64::NEG_INFINITY, f64::INFINITY]);
    }

    #[test]
    fn published_values_far_into_the_tail() {
        // Φ(−10) = 7.61985302416052606597e-24, Φ(−30) = 4.90671392714819e-198.
        close(normal_cdf(-10.0), 7.619_853_024_160_526e-24, 1e-13);
        close(normal_cdf(-30.0), 4.906_713_927_148_19e-198, 1e-12);
        close(normal_cdf(1.281_551_565_544_600_4), 0.9, 1e-15);
        close(ln_normal_cdf(10.0), -7.619_853_024_160_526e-24, 1e-13);
    }

    #[test]
    fn series_and_error_function_meet() {
        let (just_above, just_below) = (FAR_TAIL + 1e-9, FAR_TAIL);
        // Slope 30 times 1e-9 of distance is 3e-8 in 454.
        close(ln_normal_cdf(just_above) - 3.003e-8, ln_normal_cdf(just_below), 1e-13);
        close(ln_normal_cdf_slope(just_above), ln_normal_cdf_slope(just_below), 1e-10);
        assert!(ln_normal_cdf(-1e6).is_finite());
        close(ln_normal_cdf_slope(-1e6), 1e6, 1e-11);
    }

    #[test]
    fn slope_is_the_derivative() {
        for x in [-50.0_f64, -31.0, -12.0, -3.0, 0.0, 2.0, 5.0] {
            let h = 1e-5 * x.abs().max(1.0);
            let numeric = (ln_normal_cdf(x + h) - ln_normal_cdf(x - h)) / (2.0 * h);
            close(ln_normal_cdf_slope(x), numeric, 1e-7);
        }
    }
}
