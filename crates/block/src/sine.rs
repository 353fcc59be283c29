//! Sine and cosine of the angles of a block, the same bits from any processor and C library, and in vectors.

use uplift_instructions::Numbers;

/// 1/n! with alternating signs, for n from `first` on in steps of two: −1/3!, 1/5!, … or −1/2!, 1/4!, …
const fn alternating<const N: usize>(first: usize) -> [f64; N] {
    let mut coefficients = [0.0; N];
    let mut i = 0;
    while i < N {
        let order = first + 2 * i;
        // exact up to 22!
        let (mut factorial, mut n) = (1.0, 2);
        while n <= order {
            factorial *= n as f64;
            n += 1;
        }
        coefficients[i] = if i % 2 == 0 { -1.0 / factorial } else { 1.0 / factorial };
        i += 1;
    }
    coefficients
}

const SINE: [f64; 10] = alternating(3);
const COSINE: [f64; 11] = alternating(2);

/// Sine and cosine of an angle between −π/2 and π/2 \[rad\], by their Taylor series: within 1.25 × 2⁻⁵².
#[inline(always)]
pub(crate) fn sine_and_cosine(angle_rad: f64) -> (f64, f64) {
    let square = angle_rad * angle_rad;
    let horner = |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * square + c);
    (angle_rad + angle_rad * (square * horner(&SINE)), 1.0 + square * horner(&COSINE))
}

/// The same of several angles, with the same bits.
#[inline(always)]
pub(crate) fn sines_and_cosines<const LANES: usize, N: Numbers<LANES>>(n: N, angles: N::F64s) -> (N::F64s, N::F64s) {
    let squares = n.mul(angles, angles);
    let horner = |coefficients: &[f64]| {
        let terms = coefficients.iter().rev().map(|c| n.splat(*c));
        terms.reduce(|sums, c| n.add(n.mul(sums, squares), c)).unwrap_or(squares)
    };
    let sines = n.add(angles, n.mul(angles, n.mul(squares, horner(&SINE))));
    (sines, n.add(n.splat(1.0), n.mul(squares, horner(&COSINE))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_sine_and_cosine() {
        let (mut of_sine, mut of_cosine) = (0.0_f64, 0.0_f64);
        for i in -100_000..=100_000 {
            let angle = f64::from(i) * 1e-5 * std::f64::consts::FRAC_PI_2;
            let (sine, cosine) = sine_and_cosine(angle);
            of_sine = of_sine.max((sine - angle.sin()).abs() / f64::EPSILON / angle.sin().abs().max(1e-300));
            of_cosine = of_cosine.max((cosine - angle.cos()).abs() / f64::EPSILON);
        }
        assert!(of_sine <= 1.25 && of_cosine <= 1.25, "{of_sine} {of_cosine}");
        assert_eq!(sine_and_cosine(0.0), (0.0, 1.0));
        assert_eq!(sine_and_cosine(1e-200).0, 1e-200);
    }
}
