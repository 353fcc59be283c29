//! What the turning of the lean adds to the series of several motions, as [`super::super::wobble`] to that of one.

use uplift_taylor::ORDER;

use super::Begins;
use super::lanes::{Lanes, Series, ZERO, inner_products, lanes, line, product, products, sign};
use crate::series::Constants;

/// Series of the turning, and of what it needs.
#[derive(Debug)]
pub(super) struct Turn {
    pub(super) direction: Series,
    pub(super) momentum: Series,
    /// `φ̇`.
    pub(super) turning: Series,
    sin_direction: Series,
    cos_direction: Series,
    inertia: Series,
    /// `J'`.
    slope: Series,
    /// `φ̇²`.
    squared: Series,
    /// `U_s/2R`.
    travel: Series,
    /// `A_x cos φ + A_y sin φ`.
    along: Series,
    /// `A_x sin φ − A_y cos φ`.
    across: Series,
    /// `1/J` at the begin.
    by_inertia: Lanes,
    /// Sign of the momentum; 0 of one that is zero until then.
    sense: Lanes,
}

impl Turn {
    pub(super) const NONE: Self = Self {
        direction: [ZERO; ORDER + 1],
        momentum: [ZERO; ORDER + 1],
        turning: [ZERO; ORDER + 1],
        sin_direction: [ZERO; ORDER + 1],
        cos_direction: [ZERO; ORDER + 1],
        inertia: [ZERO; ORDER + 1],
        slope: [ZERO; ORDER + 1],
        squared: [ZERO; ORDER + 1],
        travel: [ZERO; ORDER + 1],
        along: [ZERO; ORDER + 1],
        across: [ZERO; ORDER + 1],
        by_inertia: ZERO,
        sense: ZERO,
    };

    #[inline(always)]
    pub(super) fn begin(&mut self, begins: &Begins) {
        (self.direction[0], self.momentum[0]) = (begins.direction, begins.momentum);
        (self.sin_direction[0], self.cos_direction[0]) = (begins.sin_direction, begins.cos_direction);
        self.sense = lanes(|i| sign(begins.momentum[i]));
    }

    /// Coefficients `k` of `(A_x cos φ + A_y sin φ) cos ψ` and of `J' φ̇²`; the turning to one order more.
    #[inline(always)]
    pub(super) fn order(
        &mut self,
        constants: &Constants,
        begins: &Begins,
        [sine, versine, cos_psi]: [&Series; 3],
        factor: &Lanes,
        k: usize,
    ) -> [Lanes; 2] {
        let &Constants { sin_alpha, cos_alpha, fall, drag, .. } = constants;
        let Self { direction, momentum, turning, sin_direction, cos_direction, .. } = self;
        let Self { inertia, slope, squared, travel, along, across, by_inertia, sense, .. } = self;
        let [sw, ww] = products([(sine, versine), (versine, versine)], k);
        let [j1, j2, j3] = constants.turning;
        let [k0, k1, k2, k3] = constants.turning_slope;
        inertia[k] = lanes(|i| j1 * versine[k][i] + j2 * sw[i] + j3 * ww[i]);
        slope[k] = lanes(|i| k0 * sine[k][i] + k1 * versine[k][i] + k2 * sw[i] + k3 * ww[i]);
        if k == 0 {
            *by_inertia = lanes(|i| 1.0 / inertia[0][i]);
            turning[0] = lanes(|i| momentum[0][i] / inertia[0][i]);
            squared[0] = lanes(|i| turning[0][i] * turning[0][i]);
        } else {
            let [turned] = inner_products([(&*inertia, &*turning)], k);
            let [square] = inner_products([(&*turning, &*turning)], k);
            let first = turning[0];
            turning[k] = lanes(|i| (momentum[k][i] - (turned[i] + inertia[k][i] * first[i])) * by_inertia[i]);
            squared[k] = lanes(|i| square[i] + 2.0 * first[i] * turning[k][i]);
        }
        travel[k] = lanes(|i| cos_alpha * sine[k][i] + sin_alpha * versine[k][i]);
        let [x, y] = &begins.horizontal;
        let (x_sin, y_cos) = (line(x, sin_direction, k), line(y, cos_direction, k));
        let (x_cos, y_sin) = (line(x, cos_direction, k), line(y, sin_direction, k));
        across[k] = lanes(|i| x_sin[i] - y_cos[i]);
        along[k] = lanes(|i| x_cos[i] + y_sin[i]);
        let [push, aside, centrifugal] = products([(cos_psi, &*along), (&*travel, &*across), (&*slope, &*squared)], k);
        let [sin, cos] = products([(&*cos_direction, &*turning), (&*sin_direction, &*turning)], k);
        momentum[k + 1] = lanes(|i| factor[i] * fall * aside[i]);
        if drag > 0.0 {
            let lost = product(momentum, turning, k);
            let next: Lanes = lanes(|i| momentum[k + 1][i] - factor[i] * drag * sense[i] * lost[i]);
            *sense = lanes(|i| if sense[i] == 0.0 { sign(next[i]) } else { sense[i] });
            momentum[k + 1] = next;
        }
        direction[k + 1] = lanes(|i| factor[i] * turning[k][i]);
        sin_direction[k + 1] = lanes(|i| factor[i] * sin[i]);
        cos_direction[k + 1] = lanes(|i| -factor[i] * cos[i]);
        [push, centrifugal]
    }
}
