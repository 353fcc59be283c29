//! Random numbers that are the same on every machine.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use statrs::function::erf::{erfc, erfc_inv};
use uplift_random::{ChaCha8Rng, Rng, stream};

/// The use of these streams.
const DOMAIN: &[u8; 24] = b"uplift synthetic motions";

/// An endless sequence of variates: one stream of the counter-based generator `ChaCha8`.
///
/// The words of a stream are integers given by the algorithm alone. The uniform variates are made
/// of them by exact operations; the normal ones go through `ln` and `sqrt`, and so are equal on
/// different machines but for the last bits.
#[derive(Debug)]
pub(super) struct RandomStream(ChaCha8Rng);

impl RandomStream {
    /// Stream `number` of those that `seed` has.
    pub(super) fn new(seed: u64, number: u64) -> Self {
        Self(stream(DOMAIN, seed, number))
    }

    /// Uniform on the open interval (0, 1): the centres of 2⁵² equal cells, each exact.
    pub(super) fn uniform(&mut self) -> f64 {
        ((self.0.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    }

    /// Standard normal, by inversion: one word a variate, no rejection.
    pub(super) fn normal(&mut self) -> f64 {
        normal_quantile(self.uniform())
    }
}

/// Standard normal distribution function Φ.
pub(super) fn normal_probability(variate: f64) -> f64 {
    0.5 * erfc(-variate * FRAC_1_SQRT_2)
}

/// Its inverse, for a probability in (0, 1).
pub(super) fn normal_quantile(probability: f64) -> f64 {
    -SQRT_2 * erfc_inv(2.0 * probability)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_quantile_meets_tabulated_values_and_inverts_phi() {
        // Abramowitz & Stegun, Table 26.5 and Wichura's check values of AS 241.
        for (p, x) in [
            (0.5, 0.0),
            (0.25, -0.674_489_750_196_081_7),
            (0.001, -3.090_232_306_167_814),
            (1e-20, -9.262_340_089_798_408),
            (0.975, 1.959_963_984_540_054),
            (7.234_804_392_512_014e-5, -3.8),
        ] {
            assert!((normal_quantile(p) - x).abs() < 2e-15 * (1.0 + x.abs()), "{p}: {}", normal_quantile(p));
        }
        for i in -60..=60 {
            let x = f64::from(i) / 10.0;
            // The library's erfc holds ten digits in the tails; near 1 the probability no more
            // than 1e-16.
            let tolerance = 1e-10 + 1e-15 / normal_probability(-x.abs());
            assert!(
                (normal_quantile(normal_probability(x)) - x).abs() < tolerance,
                "{x} {:e}",
                normal_quantile(normal_probability(x)) - x
            );
        }
    }

    #[test]
    fn variates_have_the_moments_of_their_distribution() {
        let mut stream = RandomStream::new(7, 3);
        let count = 200_000;
        let (mut sum, mut squares, mut fourth, mut uniform) = (0.0, 0.0, 0.0, 0.0);
        for _ in 0..count {
            let x = stream.normal();
            sum += x;
            squares += x * x;
            fourth += x.powi(4);
            uniform += stream.uniform();
        }
        let n = f64::from(count);
        // Four standard errors: 1/√n, √2/√n, √96/√n, 1/√(12 n).
        assert!((sum / n).abs() < 4.0 / n.sqrt());
        assert!((squares / n - 1.0).abs() < 4.0 * (2.0 / n).sqrt());
        assert!((fourth / n - 3.0).abs() < 4.0 * (96.0 / n).sqrt());
        assert!((uniform / n - 0.5).abs() < 4.0 / (12.0 * n).sqrt());
    }
}
