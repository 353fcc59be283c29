//! The fourth-order Daubechies wavelet, db4: eight filter taps, support of seven units.
//!
//! The scaling function φ solves the two-scale relation φ(x) = √2 Σ hₖ φ(2x − k). Its values at
//! the integers are the fixed point of that relation, its values at halves follow from those, and
//! so on (the cascade); then ψ(x) = √2 Σ gₖ φ(2x − k) with gₖ = (−1)ᵏ h₇₋ₖ.
//!
//! # Source
//!
//! I. Daubechies, Ten Lectures on Wavelets (1992), Table 6.1 (N = 4) and Section 6.5.

use std::sync::LazyLock;

/// Length of the support [0, 7] of φ and ψ, in units of the scale.
pub(super) const SUPPORT: f64 = 7.0;

/// Frequency at which the spectrum of ψ, sampled at whole periods in the support, is largest, in
/// cycles per unit of the scale: five cycles in seven units. Its inverse, 1.4, is the ratio of
/// pseudo-period to scale.
pub(super) const CENTRE_FREQUENCY: f64 = 5.0 / 7.0;

/// Low-pass filter hₖ, with Σ hₖ = √2.
const FILTER: [f64; 8] = [
    0.230_377_813_308_896_5,
    0.714_846_570_552_915_6,
    0.630_880_767_929_858_9,
    -0.027_983_769_416_859_854,
    -0.187_034_811_719_093_08,
    0.030_841_381_835_560_764,
    0.032_883_011_666_885_2,
    -0.010_597_401_785_069_032,
];

/// Dyadic refinements of the tables: 2¹¹ points a unit.
const LEVELS: u32 = 11;
const PER_UNIT: usize = 1 << LEVELS;

struct Tables {
    /// ψ at the points.
    value: Vec<f64>,
    /// ∫ψ from 0 to the points.
    integral: Vec<f64>,
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let value = wavelet(&scaling_function());
    let (mut area, mut previous) = (0.0, 0.0);
    let integral = value.iter().map(|&psi| {
        area += 0.5 * (previous + psi) / PER_UNIT as f64;
        previous = psi;
        area
    });
    let integral = integral.collect();
    Tables { value, integral }
});

/// ψ(x); zero outside the support.
pub(super) fn value(x: f64) -> f64 {
    interpolate(&TABLES.value, x)
}

/// ∫ψ from 0 to x; zero outside the support, as ψ has no mean.
pub(super) fn integral(x: f64) -> f64 {
    interpolate(&TABLES.integral, x)
}

/// Linear between the points of a table, zero outside; zero for NaN.
fn interpolate(table: &[f64], x: f64) -> f64 {
    if !(x > 0.0 && x < SUPPORT) {
        return 0.0;
    }
    let position = x * PER_UNIT as f64;
    // Between zero and the last point, by the check above.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let before = (position as usize).min(table.len() - 2);
    let part = position - before as f64;
    table[before] + part * (table[before + 1] - table[before])
}

/// √2 Σ filterₖ f(2x − k) at the point `index` of a table with `per_unit` points a unit, where
/// `f` is tabulated with `f_per_unit`.
fn two_scale(filter: &[f64; 8], f: &[f64], f_per_unit: usize, per_unit: usize, index: usize) -> f64 {
    // Index of 2x in the table of f; exact where f is half as fine, or as fine.
    let doubled = 2 * index * f_per_unit / per_unit;
    let terms = filter.iter().enumerate().map(|(k, tap)| {
        let shifted = doubled.checked_sub(k * f_per_unit);
        shifted.and_then(|at| f.get(at)).map_or(0.0, |value| tap * value)
    });
    std::f64::consts::SQRT_2 * terms.sum::<f64>()
}

/// φ at [`PER_UNIT`] points a unit, both ends of the support included.
fn scaling_function() -> Vec<f64> {
    // Fixed point at the integers 0 to 7. The relation keeps the sum of the values at one and
    // halves every other part of the start, at least: 60 rounds leave rounding only.
    let mut table = vec![0.125; 8];
    for _ in 0..60 {
        table = (0..8).map(|index| two_scale(&FILTER, &table, 1, 1, index)).collect();
    }
    for level in 1..=LEVELS {
        let per_unit = 1 << level;
        table = (0..=7 * per_unit).map(|index| two_scale(&FILTER, &table, per_unit / 2, per_unit, index)).collect();
    }
    table
}

/// ψ at [`PER_UNIT`] points a unit from φ at the same.
fn wavelet(phi: &[f64]) -> Vec<f64> {
    let mut high_pass = FILTER;
    high_pass.reverse();
    high_pass.iter_mut().skip(1).step_by(2).for_each(|tap| *tap = -*tap);
    (0..=7 * PER_UNIT).map(|index| two_scale(&high_pass, phi, PER_UNIT, PER_UNIT, index)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Σ f(x) over the points of the support times their distance: the integral, where f has no
    /// ends to count.
    fn integrated(f: impl Fn(f64) -> f64) -> f64 {
        (0..=7 * PER_UNIT).map(|i| f(i as f64 / PER_UNIT as f64)).sum::<f64>() / PER_UNIT as f64
    }

    #[test]
    fn the_filter_is_orthonormal_with_four_vanishing_moments() {
        for shift in 0..4 {
            let product: f64 = FILTER.iter().zip(&FILTER[2 * shift..]).map(|(a, b)| a * b).sum();
            let expected = if shift == 0 { 1.0 } else { 0.0 };
            assert!((product - expected).abs() < 1e-15, "shift {shift}: {product}");
        }
        for moment in 0..4 {
            let sum: f64 = (0_i32..8).zip(FILTER).map(|(k, h)| f64::from((1 - 2 * (k % 2)) * k.pow(moment)) * h).sum();
            assert!(sum.abs() < 1e-11, "moment {moment}: {sum}");
        }
    }

    #[test]
    fn the_wavelet_is_orthonormal_with_four_vanishing_moments() {
        assert!((integrated(|x| value(x).powi(2)) - 1.0).abs() < 1e-7);
        for shift in 1..7 {
            assert!(integrated(|x| value(x) * value(x - f64::from(shift))).abs() < 1e-7, "shift {shift}");
        }
        // One octave apart.
        assert!(integrated(|x| value(x) * value(2.0 * x - 3.0)).abs() < 1e-6);
        for moment in 0..4 {
            let centred = integrated(|x| value(x) * (x - 3.5).powi(moment));
            assert!(centred.abs() < 1e-6, "moment {moment}: {centred}");
        }
    }

    #[test]
    fn the_integral_is_that_of_the_values() {
        assert_eq!(integral(-1.0), 0.0);
        assert_eq!(integral(SUPPORT), 0.0);
        assert_eq!(integral(f64::NAN), 0.0);
        assert!(integral(SUPPORT - 1e-9).abs() < 1e-12);
        for x in [1.0, 2.5, 3.3, 3.9, 5.01] {
            let step = 1e-3;
            let slope = (integral(x + step) - integral(x - step)) / (2.0 * step);
            assert!((slope - value(x)).abs() < 2e-3, "{x}: {slope} {}", value(x));
        }
    }

    #[test]
    fn the_spectrum_is_largest_at_five_cycles_in_the_support() {
        let power = |cycles: i32| {
            let phase = |x: f64| std::f64::consts::TAU * f64::from(cycles) * x / SUPPORT;
            integrated(|x| value(x) * phase(x).cos()).hypot(integrated(|x| value(x) * phase(x).sin()))
        };
        let strongest = (1..60).max_by(|&a, &b| power(a).total_cmp(&power(b))).unwrap();
        assert_eq!(f64::from(strongest) / SUPPORT, CENTRE_FREQUENCY);
    }
}
