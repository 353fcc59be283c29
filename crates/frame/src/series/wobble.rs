//! What the turning of the lean adds to the recurrence.

use uplift_taylor::Factors;

use super::{Constants, Shaken, Step, short_product};

/// What turning needs beside the unknowns.
#[derive(Debug, Default)]
pub(super) struct Wobble {
    /// `1/J` and `φ̇` at the begin.
    begin: [f64; 2],
    /// Factors of `sin θ (1 − cos θ)`, `(1 − cos θ)²`, `J φ̇` and `φ̇²`, the last two without the terms at their begin.
    inner: Factors<4>,
    /// Factors of the products in [`Changes`], with one of zeros that makes them pairs.
    factors: Factors<6>,
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
    /// The coefficients of order `k`, of which that of `cos ψ` is given.
    #[inline(always)]
    pub(super) fn order(
        &mut self,
        constants: &Constants,
        step: &mut Step,
        shaken: &Shaken,
        cos_psi: f64,
        k: usize,
    ) -> Changes {
        let (sine, versine) = (step.sine[k], step.versine[k]);
        // the terms of inertia and turning are not known yet
        let [sw, ww, momentum, squared] =
            self.inner.products([sine, versine, 0.0, 0.0], [versine, versine, 0.0, 0.0], k);
        let [j1, j2, j3] = constants.turning;
        let [k0, k1, k2, k3] = constants.turning_slope;
        let inertia = j1 * versine + j2 * sw + j3 * ww;
        let slope = k0 * sine + k1 * versine + k2 * sw + k3 * ww;
        if k == 0 {
            self.begin = [1.0 / inertia, step.momentum[0] / inertia];
        }
        let [by_inertia, first] = self.begin;
        let (turning, squared) = if k == 0 {
            (first, first * first)
        } else {
            let turning = (step.momentum[k] - (momentum + inertia * first)) * by_inertia;
            self.inner.replace(2, [inertia, turning], k);
            self.inner.replace(3, [turning, turning], k);
            (turning, squared + 2.0 * first * turning)
        };
        step.turning[k] = turning;
        let travel = constants.cos_alpha * sine + constants.sin_alpha * versine;
        let [x, y] = [shaken.horizontal[0].coefficients(), shaken.horizontal[1].coefficients()];
        let (sin, cos) = (&step.sin_direction, &step.cos_direction);
        let across = short_product(x, sin, k) - short_product(y, cos, k);
        let pushes = short_product(x, cos, k) + short_product(y, sin, k);
        let first = [cos_psi, travel, slope, cos[k], sin[k], 0.0];
        let second = [pushes, across, squared, turning, turning, 0.0];
        let [push, across, centrifugal, sin, cos, _] = self.factors.products(first, second, k);
        Changes { push, across, centrifugal, sin, cos }
    }
}
