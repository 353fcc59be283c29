//! The smooth function by whose exponential records are weighted: its slope is an exponent, linear between knots.

/// Number of knots K.
pub const KNOTS: usize = 4;

/// Exponents b at the knots: near knot k weights go as (y/x)^b.
pub type Exponents = [f64; KNOTS];

/// The knots t = ln y of g: g' is the exponent b at each, linear between them, constant outside, and g(t₁) = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Knots {
    ln_levels: [f64; KNOTS],
}

impl Knots {
    /// From levels y that rise strictly and are above 0.
    pub(crate) fn new(levels: [f64; KNOTS]) -> Self {
        Self { ln_levels: levels.map(f64::ln) }
    }

    /// What each exponent contributes to g at t = ln y: `g(t) = Σ b_k B_k(t)`.
    ///
    /// Over an interval of the length d, with v = t less its first knot, clipped to 0…d: v − v²/(2d) for the exponent
    /// there, v²/(2d) for the next.
    pub(crate) fn basis(&self, ln_level: f64) -> [f64; KNOTS] {
        let knots = &self.ln_levels;
        let mut basis = [0.0; KNOTS];
        basis[0] = (ln_level - knots[0]).min(0.0);
        basis[KNOTS - 1] = (ln_level - knots[KNOTS - 1]).max(0.0);
        for k in 0..KNOTS - 1 {
            let length = knots[k + 1] - knots[k];
            let v = (ln_level - knots[k]).clamp(0.0, length);
            let rest = 0.5 * v * v / length;
            basis[k] += v - rest;
            basis[k + 1] += rest;
        }
        basis
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_at_a_knot_is_its_exponent() {
        let levels = [0.1, 0.2, 0.5, 2.0];
        let (knots, exponents) = (Knots::new(levels), [2.0, 1.0, -1.0, 3.0]);
        let g = |t: f64| -> f64 { knots.basis(t).iter().zip(exponents).map(|(basis, b)| basis * b).sum() };
        let slope = |t: f64| (g(t + 1e-6) - g(t - 1e-6)) / 2e-6;
        assert!(g(levels[0].ln()).abs() < 1e-15);
        for (level, exponent) in levels.iter().zip(exponents) {
            assert!((slope(level.ln()) - exponent).abs() < 1e-5, "{level}");
        }
        // linear between, constant outside
        assert!((slope(0.5 * (0.2_f64.ln() + 0.5_f64.ln())) - 0.0).abs() < 1e-6);
        assert!((slope(-9.0) - 2.0).abs() < 1e-6 && (slope(9.0) - 3.0).abs() < 1e-6);
    }

    #[test]
    fn alike_exponents_are_a_power() {
        let knots = Knots::new([0.1, 0.2, 0.5, 2.0]);
        for t in [-5.0, -2.0, -1.0, 0.0, 0.3, 4.0] {
            assert!((knots.basis(t).iter().sum::<f64>() - (t - 0.1_f64.ln())).abs() < 1e-14);
        }
    }
}
