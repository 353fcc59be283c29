//! Complex numbers, as far as the filters need them.

/// A complex number, by real and imaginary part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Complex(pub(super) f64, pub(super) f64);

impl Complex {
    #[inline]
    pub(super) fn times(self, other: Self) -> Self {
        Self(self.0 * other.0 - self.1 * other.1, self.1 * other.0 + self.0 * other.1)
    }

    #[inline]
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self(self.0 * factor, self.1 * factor)
    }

    /// The exponential by its power series, for a modulus up to π/2 (25 Hz at 0.01 s).
    ///
    /// The filters step along the record by powers of it, so a difference in its last bit would
    /// grow a thousandfold: it is made of sums and products only, which are the same on every
    /// machine, unlike `exp` and `sin_cos`.
    pub(super) fn exponential(self) -> Self {
        // (π/2)²⁵/25! = 5e-21.
        (1..=24).rev().fold(Self(1.0, 0.0), |sum, k| {
            let Self(re, im) = self.scaled(1.0 / f64::from(k)).times(sum);
            Self(1.0 + re, im)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_series_is_the_exponential() {
        for (re, im) in [(0.0, 0.0), (-0.3, 0.7), (-1.5, 0.4), (-0.03, 1.57), (-1e-6, 2e-5)] {
            let Complex(x, y) = Complex(re, im).exponential();
            assert!((x - re.exp() * im.cos()).abs() < 1e-15, "{re} {im}: {x}");
            assert!((y - re.exp() * im.sin()).abs() < 1e-15, "{re} {im}: {y}");
        }
    }
}
