//! Force laws that are polynomials of the third degree without a constant: linear springs and disc springs.

/// `F(x) = c₁ x + c₂ x² + c₃ x³`, N over m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cubic {
    coefficients: [f64; 3],
}

impl Cubic {
    /// From `c₁` (N/m), `c₂` (N/m²) and `c₃` (N/m³).
    pub fn new(coefficients: [f64; 3]) -> Self {
        Self { coefficients }
    }

    /// `c₁` (N/m), `c₂` (N/m²) and `c₃` (N/m³).
    pub fn coefficients(&self) -> [f64; 3] {
        self.coefficients
    }

    /// Force at `x` (m), N.
    pub fn force_n(&self, x_m: f64) -> f64 {
        let [c1, c2, c3] = self.coefficients;
        x_m * (c1 + x_m * (c2 + x_m * c3))
    }

    /// Tangent stiffness at `x` (m), N/m.
    pub fn stiffness_n_m(&self, x_m: f64) -> f64 {
        let [c1, c2, c3] = self.coefficients;
        c1 + x_m * (2.0 * c2 + x_m * 3.0 * c3)
    }

    /// Work from 0 to `x` (m), J.
    pub fn energy_j(&self, x_m: f64) -> f64 {
        let [c1, c2, c3] = self.coefficients;
        x_m * x_m * (0.5 * c1 + x_m * (c2 / 3.0 + x_m * 0.25 * c3))
    }

    /// The law of `series` such springs one behind the other, `parallel` beside each other in each place:
    /// `i F(x/n)`.
    #[must_use]
    pub fn stacked(&self, parallel: u32, series: u32) -> Self {
        let (i, n) = (f64::from(parallel), f64::from(series));
        let [c1, c2, c3] = self.coefficients;
        Self { coefficients: [i * c1 / n, i * c2 / (n * n), i * c3 / (n * n * n)] }
    }
}
