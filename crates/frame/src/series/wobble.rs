//! What the turning of the lean adds to the recurrence.

use uplift_taylor::{DEGREE, product, products};

use super::{Coefficients, Constants, Shaken, Step, short_product};

/// What turning needs beside the unknowns.
#[derive(Debug)]
pub(super) struct Wobble {
    sine_versine: Coefficients,
    versine_squared: Coefficients,
    inertia: Coefficients,
    pub(super) slope: Coefficients,
    pub(super) turning_squared: Coefficients,
    /// `A_x cos φ + A_y sin φ`.
    pub(super) pushes: Coefficients,
    /// `A_x sin φ − A_y cos φ`.
    pub(super) across: Coefficients,
    pub(super) travel: Coefficients,
}

impl Wobble {
    pub(super) fn new() -> Self {
        let zero = [0.0; DEGREE + 1];
        Self {
            sine_versine: zero,
            versine_squared: zero,
            inertia: zero,
            slope: zero,
            turning_squared: zero,
            pushes: zero,
            across: zero,
            travel: zero,
        }
    }

    /// The coefficients of order `k`.
    pub(super) fn order(&mut self, constants: &Constants, step: &mut Step, shaken: &Shaken, k: usize) {
        let (sine, versine) = (&step.sine, &step.versine);
        [self.sine_versine[k], self.versine_squared[k]] = products([(sine, versine), (versine, versine)], k);
        let (sw, ww) = (self.sine_versine[k], self.versine_squared[k]);
        let [j1, j2, j3] = constants.turning;
        let [k0, k1, k2, k3] = constants.turning_slope;
        self.inertia[k] = j1 * versine[k] + j2 * sw + j3 * ww;
        self.slope[k] = k0 * sine[k] + k1 * versine[k] + k2 * sw + k3 * ww;
        let known = if k == 0 { 0.0 } else { product(&self.inertia[1..], &step.turning, k - 1) };
        step.turning[k] = (step.momentum[k] - known) / self.inertia[0];
        self.turning_squared[k] = product(&step.turning, &step.turning, k);
        self.travel[k] = constants.cos_alpha * sine[k] + constants.sin_alpha * versine[k];
        let [x, y] = [shaken.horizontal[0].coefficients(), shaken.horizontal[1].coefficients()];
        let (sin, cos) = (&step.sin_direction, &step.cos_direction);
        self.across[k] = short_product(x, sin, k) - short_product(y, cos, k);
        self.pushes[k] = short_product(x, cos, k) + short_product(y, sin, k);
    }
}
