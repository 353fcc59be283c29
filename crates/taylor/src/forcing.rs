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
    pub const fn none() -> Self {
        Self { c: [0.0; ORDER + 1], len: 1 }
    }

    /// Makes it a straight line from `begin` to `begin + change`.
    #[inline]
    pub fn set_line(&mut self, begin: f64, change: f64) {
        [self.c[0], self.c[1]] = [begin, change];
        self.len = 2;
    }

    /// Makes it no shaking.
    #[inline]
    pub fn set_none(&mut self) {
        self.c[0] = 0.0;
        self.len = 1;
    }

    /// Makes it `factor` times itself and `other_factor` times `other`.
    #[inline]
    pub fn combine(&mut self, factor: f64, other: &Self, other_factor: f64) {
        self.c[self.len..other.len.max(self.len)].fill(0.0);
        self.len = self.len.max(other.len);
        for (k, own) in self.c[..self.len].iter_mut().enumerate() {
            *own = factor * *own + if k < other.len { other_factor * other.c[k] } else { 0.0 };
        }
    }

    /// Multiplies it in place: [`times`](Self::times).
    #[inline]
    pub fn scale(&mut self, factor: f64) {
        self.c[..self.len].iter_mut().for_each(|c| *c *= factor);
    }

    /// Makes it begin at another value in place: [`beginning_at`](Self::beginning_at).
    #[inline]
    pub fn begin_at(&mut self, value: f64) {
        self.len = self.len.max(1);
        self.c[0] = value;
    }

    /// Stretches it in place: [`stretched`](Self::stretched).
    #[inline]
    pub fn stretch(&mut self, ratio: f64) {
        stretch(&mut self.c[..self.len], ratio);
    }

    /// Appends the next coefficient; one beyond [`ORDER`] is left out.
    #[inline]
    pub fn push(&mut self, coefficient: f64) {
        if let Some(place) = self.c.get_mut(self.len) {
            *place = coefficient;
            self.len += 1;
        }
    }

    /// Coefficients, lowest power first.
    #[inline]
    pub fn coefficients(&self) -> &[f64] {
        &self.c[..self.len]
    }

    /// The acceleration at `s`.
    #[inline]
    pub fn value(&self, s: f64) -> f64 {
        value(self.coefficients(), s)
    }

    /// Every coefficient times `factor`.
    #[must_use]
    #[inline]
    pub fn times(mut self, factor: f64) -> Self {
        self.scale(factor);
        self
    }

    /// The same acceleration in powers of s/`ratio`: on a step `ratio` times as long.
    #[must_use]
    #[inline]
    pub fn stretched(mut self, ratio: f64) -> Self {
        self.stretch(ratio);
        self
    }

    /// The same with another value at the begin of the step.
    #[must_use]
    #[inline]
    pub fn beginning_at(mut self, value: f64) -> Self {
        self.begin_at(value);
        self
    }

    /// The sum of two.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        self.combine(1.0, other, 1.0);
        self
    }

    /// The product of two, up to the highest power that a forcing has.
    #[must_use]
    pub fn product(&self, other: &Self) -> Self {
        let mut product = Self::default();
        if self.len == 0 || other.len == 0 {
            return product;
        }
        for k in 0..(self.len + other.len - 1).min(ORDER + 1) {
            let from = k.saturating_sub(other.len - 1);
            product.push((from..=k.min(self.len - 1)).map(|j| self.c[j] * other.c[k - j]).sum());
        }
        product
    }

    /// Whether it is zero throughout.
    #[inline]
    pub fn is_zero(&self) -> bool {
        self.coefficients().iter().all(|c| *c == 0.0)
    }

    /// Σ |cₖ|: no value on the step is larger.
    #[inline]
    pub fn bound(&self) -> f64 {
        self.coefficients().iter().map(|c| c.abs()).sum()
    }

    /// Of the first `part` of the step, [stretched](Self::stretched) to a whole one: Σ |cₖ|, its [bound](Self::bound),
    /// and Σ k |cₖ|, which no derivative by s exceeds.
    pub fn bounds_within(&self, part: f64) -> [f64; 2] {
        let (mut power, mut bounds) = (1.0, [0.0; 2]);
        for (k, c) in self.coefficients().iter().enumerate() {
            let size = (c * power).abs();
            bounds = [bounds[0] + size, bounds[1] + k as f64 * size];
            power *= part;
        }
        bounds
    }
}
