//! Rates as 128-bit integers: sums that do not depend on their order.
//!
//! A rate is an even number of quanta of 2⁻⁸² per year, so that the halves of the trapezoid rule are whole. A double
//! above 4e-9 per year is represented exactly, a smaller one to 4e-25 per year. The weights of one record add up to at
//! most the rate at the foot of the hazard curve, so a sum over a sample stays below 2²⁰ · 2⁸² · 2²⁴ = 2¹²⁶.

/// Largest hazard rate, 1/yr (2²⁰).
pub(crate) const MAX_RATE_PER_YEAR: f64 = 1_048_576.0;

/// Largest number of draws in a sample (2²⁴).
pub(crate) const MAX_SAMPLE_SIZE: u64 = 1 << 24;

/// 2⁸¹: pairs of quanta in one event per year.
const PAIRS_PER_EVENT: f64 = (1_u128 << 81) as f64;

/// One quantum, 1/yr.
pub(crate) const QUANTUM_PER_YEAR: f64 = 0.5 / PAIRS_PER_EVENT;

/// A positive rate of at most [`MAX_RATE_PER_YEAR`] in quanta, rounded to an even number of them.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 0 ≤ rate ≤ 2²⁰
pub(crate) fn quanta(rate_per_year: f64) -> u128 {
    debug_assert!((0.0..=MAX_RATE_PER_YEAR).contains(&rate_per_year));
    2 * (rate_per_year * PAIRS_PER_EVENT).round() as u128
}

/// The rate, 1/yr, of a sum of quanta over a sample of `size` records.
pub(crate) fn rate_per_year(sum: u128, size: u32) -> f64 {
    sum as f64 / (2.0 * PAIRS_PER_EVENT) / f64::from(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_go_there_and_back() {
        for rate in [MAX_RATE_PER_YEAR, 13.7, 0.1, 4.04e-4, 1e-8, 5e-9, 0.0] {
            assert_eq!(rate_per_year(quanta(rate), 1), rate);
            assert_eq!(quanta(rate) % 2, 0);
        }
        assert!((rate_per_year(quanta(1e-12), 1) - 1e-12).abs() <= 4.2e-25);
    }

    #[test]
    fn the_largest_sum_fits() {
        assert!(quanta(MAX_RATE_PER_YEAR).checked_mul(u128::from(MAX_SAMPLE_SIZE)).is_some());
    }
}
