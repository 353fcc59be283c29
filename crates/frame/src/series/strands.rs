//! The moment `T Δ'` of the restrainers as a series.

use uplift_statics::RestrainedColumns;
use uplift_taylor::{DEGREE, inner_product, product};

use super::Coefficients;
use crate::branch::{Branch, Form, Law};

/// Series of a restrainer's moment `T Δ'`.
#[derive(Debug)]
pub(super) struct Strands {
    form: Form,
    law: Law,
    half_sine: Coefficients,
    half_cosine: Coefficients,
    /// `Δ`, or `ρ` of a chord.
    length: Coefficients,
    rate: Coefficients,
    deformation: Coefficients,
    deformation_squared: Coefficients,
    tension: Coefficients,
    /// `Δ` at the begin, m.
    elongation_m: f64,
}

impl Strands {
    pub(super) fn new() -> Self {
        let zero = [0.0; DEGREE + 1];
        Self {
            form: Form::Axis { lever_m: 0.0 },
            law: Law::Loose,
            half_sine: zero,
            half_cosine: zero,
            length: zero,
            rate: zero,
            deformation: zero,
            deformation_squared: zero,
            tension: zero,
            elongation_m: 0.0,
        }
    }

    /// The first coefficients at the rotation `x`, of whose half the sine and cosine are given.
    pub(super) fn begin(
        &mut self,
        branch: &Branch,
        columns: &RestrainedColumns,
        x: f64,
        [half_sin, half_cos]: [f64; 2],
    ) {
        (self.form, self.law) = (branch.form, branch.law);
        (self.half_sine[0], self.half_cosine[0]) = (half_sin, half_cos);
        if let (Law::Loose, _) | (Law::Linear { .. }, Form::Axis { .. }) = (branch.law, branch.form) {
            return;
        }
        self.elongation_m = columns.elongation(x).elongation_m;
        if let Form::Chord { rest_m, .. } = branch.form {
            self.length[0] = self.elongation_m + rest_m;
        }
        if let (Law::Cubic { .. }, Some(restrainer)) = (branch.law, columns.restrainer()) {
            let elongation_m = restrainer.limit_m().map_or(self.elongation_m, |m| m.min(self.elongation_m));
            let state = restrainer.at(elongation_m).ok();
            self.deformation[0] = state.and_then(|state| state.deformation_m).unwrap_or(self.elongation_m);
        }
    }

    /// Coefficient `k` of `T Δ'`, N m. Kept apart: its loops would cost the step of a spring that needs none of them.
    #[inline(never)]
    pub(super) fn moment(&mut self, sine: &Coefficients, versine: &Coefficients, k: usize) -> f64 {
        match self.form {
            Form::Axis { lever_m } => {
                self.length[k] = 2.0 * lever_m * self.half_sine[k];
                self.rate[k] = lever_m * self.half_cosine[k];
            }
            Form::Chord { sine_m2, versine_m2, .. } => {
                if k > 0 {
                    let square = sine_m2 * sine[k] + versine_m2 * versine[k];
                    self.length[k] = 0.5 * (square - inner_product(&self.length, &self.length, k)) / self.length[0];
                }
                let cosine = f64::from(u8::from(k == 0)) - versine[k];
                let known = if k == 0 { 0.0 } else { product(&self.length[1..], &self.rate, k - 1) };
                self.rate[k] = (0.5 * (sine_m2 * cosine + versine_m2 * sine[k]) - known) / self.length[0];
            }
        }
        let elongation_m = if k == 0 { self.elongation_m } else { self.length[k] };
        self.tension[k] = self.pull(elongation_m, k);
        product(&self.tension, &self.rate, k)
    }

    /// Coefficient `k` of `T`, N, from that of `Δ`.
    fn pull(&mut self, elongation_m: f64, k: usize) -> f64 {
        match self.law {
            Law::Loose => 0.0,
            Law::Linear { constant_n, stiffness_n_m } => {
                stiffness_n_m * elongation_m + if k == 0 { constant_n } else { 0.0 }
            }
            Law::Cubic { coefficients: [c0, c1, c2, c3], flexibility_m_n } => {
                let first = self.deformation[0];
                if k == 0 {
                    self.deformation_squared[0] = first * first;
                    return c0 + first * (c1 + first * (c2 + first * c3));
                }
                // d² and d³ without their terms of dₖ, which are 2d₀ dₖ and 3d₀² dₖ
                let square = inner_product(&self.deformation, &self.deformation, k);
                let cube = first * square + inner_product(&self.deformation_squared, &self.deformation, k);
                let known = c2 * square + c3 * cube;
                let stiffness = c1 + first * (2.0 * c2 + first * 3.0 * c3);
                let deformation = (elongation_m - flexibility_m_n * known) / (1.0 + flexibility_m_n * stiffness);
                self.deformation[k] = deformation;
                self.deformation_squared[k] = 2.0 * first * deformation + square;
                stiffness * deformation + known
            }
        }
    }

    /// Coefficient `k` of the half angle's sine and cosine.
    #[inline(always)]
    pub(super) fn half(&self, k: usize) -> [f64; 2] {
        [self.half_sine[k], self.half_cosine[k]]
    }

    /// The half angle's sine and cosine to one order more, from the coefficients `k` of their products with the
    /// velocity.
    #[inline(always)]
    pub(super) fn extend(&mut self, [sine_v, cosine_v]: [f64; 2], factor: f64, k: usize) {
        self.half_sine[k + 1] = 0.5 * factor * cosine_v;
        self.half_cosine[k + 1] = -0.5 * factor * sine_v;
    }
}
