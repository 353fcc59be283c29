//! What the turning of the lean adds to the recurrence.

use uplift_taylor::{DEGREE, product, products, products_by_lane};

use super::{Coefficients, Constants, Shaken, Step, short_product};

/// Products of a step side by side, with one of zeros that makes them pairs.
const LANES: usize = 6;

/// Coefficients of so many functions, `[order][function]`.
type Lanes = [[f64; LANES]; DEGREE + 1];

/// What turning needs beside the unknowns.
#[derive(Debug)]
pub(super) struct Wobble {
    inertia: Coefficients,
    /// First factors of the products in [`Changes`].
    first: Lanes,
    /// Second factors.
    second: Lanes,
}

/// Coefficients of what turning changes.
#[derive(Debug)]
pub(super) struct Changes {
    /// `(A_x cos φ + A_y sin φ) cos ψ`.
    pub(super) push: f64,
    /// `(A_x sin φ − A_y cos φ) U_s/2R`.
    pub(super) across: f64,
    /// `J' φ̇²`.
    pub(super) centrifugal: f64,
    /// `φ̇ cos φ`.
    pub(super) sin: f64,
    /// `φ̇ sin φ`.
    pub(super) cos: f64,
}

impl Wobble {
    pub(super) fn new() -> Self {
        let zero = [[0.0; LANES]; DEGREE + 1];
        Self { inertia: [0.0; DEGREE + 1], first: zero, second: zero }
    }

    /// The coefficients of order `k`, of which that of `cos ψ` is given.
    pub(super) fn order(
        &mut self,
        constants: &Constants,
        step: &mut Step,
        shaken: &Shaken,
        cos_psi: f64,
        k: usize,
    ) -> Changes {
        let (sine, versine) = (&step.sine, &step.versine);
        let [sw, ww] = products([(sine, versine), (versine, versine)], k);
        let [j1, j2, j3] = constants.turning;
        let [k0, k1, k2, k3] = constants.turning_slope;
        self.inertia[k] = j1 * versine[k] + j2 * sw + j3 * ww;
        let slope = k0 * sine[k] + k1 * versine[k] + k2 * sw + k3 * ww;
        let known = if k == 0 { 0.0 } else { product(&self.inertia[1..], &step.turning, k - 1) };
        let turning = (step.momentum[k] - known) / self.inertia[0];
        step.turning[k] = turning;
        let turning_squared = product(&step.turning, &step.turning, k);
        let travel = constants.cos_alpha * sine[k] + constants.sin_alpha * versine[k];
        let [x, y] = [shaken.horizontal[0].coefficients(), shaken.horizontal[1].coefficients()];
        let (sin, cos) = (&step.sin_direction, &step.cos_direction);
        let across = short_product(x, sin, k) - short_product(y, cos, k);
        let pushes = short_product(x, cos, k) + short_product(y, sin, k);
        self.first[k] = [cos_psi, travel, slope, cos[k], sin[k], 0.0];
        self.second[k] = [pushes, across, turning_squared, turning, turning, 0.0];
        let [push, across, centrifugal, sin, cos, _] = products_by_lane(&self.first, &self.second, k);
        Changes { push, across, centrifugal, sin, cos }
    }
}
