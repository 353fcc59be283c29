//! Ground acceleration on a step of an integrator.

use crate::polynomial::value;
use crate::{ORDER, stretch};

/// Ground acceleration on a step, in powers of s.
#[derive(Debug, Clone, Copy)]
pub struct Forcing {
    c: [f64; ORDER + 1],
    len: usize,
}

impl Default for Forcing {
    fn default() -> Self {
        Self { c: [0.0; ORDER + 1], len: 0 }
    }
}

impl Forcing {
    /// No shaking.
    #[must_use]
    pub fn none() -> Self {
        Self { len: 1, ..Self::default() }
    }

    /// Appends the next coefficient; one beyond [`ORDER`] is left out.
    pub fn push(&mut self, coefficient: f64) {
        if let Some(place) = self.c.get_mut(self.len) {
            *place = coefficient;
            self.len += 1;
        }
    }

    /// Coefficients, lowest power first.
    pub fn coefficients(&self) -> &[f64] {
        &self.c[..self.len]
    }

    /// The acceleration at `s`.
    pub fn value(&self, s: f64) -> f64 {
        value(self.coefficients(), s)
    }

    /// Every coefficient times `factor`.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.c[..self.len].iter_mut().for_each(|c| *c *= factor);
        self
    }

    /// The same acceleration in powers of s/`ratio`: on a step `ratio` times as long.
    #[must_use]
    pub fn stretched(mut self, ratio: f64) -> Self {
        stretch(&mut self.c[..self.len], ratio);
        self
    }

    /// The same with another value at the begin of the step.
    #[must_use]
    pub fn beginning_at(mut self, value: f64) -> Self {
        self.c[0] = value;
        self
    }

    /// The sum of two.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        for (own, other) in self.c.iter_mut().zip(other.coefficients()) {
            *own += other;
        }
        self.len = self.len.max(other.len);
        self
    }

    /// The product of two, up to the highest power that a forcing has.
    #[must_use]
    pub fn product(&self, other: &Self) -> Self {
        let mut product = Self::default();
        for k in 0..(self.len + other.len).saturating_sub(1).min(ORDER + 1) {
            product.push((0..=k).map(|j| self.c[j] * other.c[k - j]).sum());
        }
        product
    }

    /// Whether it is zero throughout.
    pub fn is_zero(&self) -> bool {
        self.coefficients().iter().all(|c| *c == 0.0)
    }

    /// Σ |cₖ|: no value on the step is larger.
    pub fn bound(&self) -> f64 {
        self.coefficients().iter().map(|c| c.abs()).sum()
    }

    /// Σ k |cₖ|: no derivative by s on the step is larger.
    pub fn slope_bound(&self) -> f64 {
        self.coefficients().iter().enumerate().map(|(k, c)| k as f64 * c.abs()).sum()
    }
}
