//! The motion of a system that is uplifted without stiffness, by the integrals of the record.

use crate::ahead::{AHEAD, Lanes, ahead, larger};
use crate::crossings::State;
use crate::ground_motion::GroundMotion;
use crate::run::Run;
use crate::stumpff::Stumpff;
use crate::uplifted::UpliftedMotion;

/// Stumpff functions of a branch without stiffness.
pub(crate) const PARABOLIC: Stumpff = Stumpff { c0: 1.0, c1: 1.0, c2: 0.5, c3: 1.0 / 6.0 };

/// With the time `T` since the sample `base`, the distance on its side is `y = y0 + T (p − η g T/2) − c (D(t) − D0)`.
pub(crate) struct ZeroStiffnessMotion<'a> {
    ground: &'a GroundMotion<'a>,
    dt_s: f64,
    /// `c`: the scale, with the sign of the side.
    scale: f64,
    /// `η g`, m/s².
    weight: f64,
    base: usize,
    y0: f64,
    p: f64,
    d0: f64,
}

impl<'a> ZeroStiffnessMotion<'a> {
    /// The motion on `side` from the state at the sample `base` on.
    #[inline(always)]
    pub(crate) fn new<const STIFFNESS: bool>(run: &Run<'a, STIFFNESS>, side: f64, base: usize, from: &State) -> Self {
        let (ground, scale, weight) = (run.sweep.ground, side * run.scale, run.sweep.at_boundary_m_s2);
        Self {
            ground,
            dt_s: run.sweep.dt_s,
            scale,
            weight,
            base,
            y0: side * from.u,
            p: side * from.v + scale * ground.velocity_m_s[base],
            d0: ground.displacement_m[base],
        }
    }
}

impl UpliftedMotion for ZeroStiffnessMotion<'_> {
    #[inline(always)]
    fn ahead(&self, j: usize) -> (Lanes, Lanes) {
        let displacement = ahead(&self.ground.displacement_m, j + 1);
        let acceleration = ahead(&self.ground.acceleration_m_s2, j + 1);
        let elapsed = (j + 1 - self.base) as f64;
        let (mut y, mut w) = ([0.0; AHEAD], [0.0; AHEAD]);
        for m in 0..AHEAD {
            let t = (elapsed + m as f64) * self.dt_s;
            y[m] = self.y0 + t * (self.p - 0.5 * self.weight * t) - self.scale * (displacement[m] - self.d0);
            w[m] = -self.weight - self.scale * acceleration[m];
        }
        (y, w)
    }

    #[inline(always)]
    fn rate(&self, j: usize) -> f64 {
        self.p - self.weight * ((j - self.base) as f64 * self.dt_s) - self.scale * self.ground.velocity_m_s[j]
    }

    #[inline(always)]
    fn force(&self, _: f64) -> f64 {
        self.weight
    }

    #[inline(always)]
    fn outward_bound(&self, _: f64, greatest: f64) -> f64 {
        larger(greatest, 0.0)
    }

    #[inline(always)]
    fn restart_at(&mut self, _: usize, _: f64) {}
}
