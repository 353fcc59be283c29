//! The motion of a system that is uplifted without stiffness, by the integrals of the record.

use uplift_instructions::Vectors;

use crate::ahead::{AHEAD, Lanes, ahead, larger};
use crate::crossings::State;
use crate::ground_motion::GroundMotion;
use crate::run::Run;
use crate::stumpff::Stumpff;
use crate::uplifted::UpliftedMotion;

/// Stumpff functions of a branch without stiffness.
pub(crate) const PARABOLIC: Stumpff = Stumpff { c0: 1.0, c1: 1.0, c2: 0.5, c3: 1.0 / 6.0 };

/// `0, 1, 2, …`
const SAMPLES: Lanes = {
    let (mut samples, mut m) = ([0.0; AHEAD], 0);
    while m < AHEAD {
        samples[m] = m as f64;
        m += 1;
    }
    samples
};

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
    fn ahead<V: Vectors>(&self, vectors: V, j: usize) -> V::F64s {
        let displacement = ahead(&self.ground.displacement_m, j + 1);
        let elapsed = (j + 1 - self.base) as f64;
        // y0 + t (p − η g t/2) − c (D − D0)
        let samples = vectors.add(vectors.splat(elapsed), vectors.load(&SAMPLES));
        let t = vectors.mul(samples, vectors.splat(self.dt_s));
        let rate = vectors.sub(vectors.splat(self.p), vectors.mul(vectors.splat(0.5 * self.weight), t));
        let ground = vectors.sub(vectors.load(displacement), vectors.splat(self.d0));
        vectors.sub(
            vectors.add(vectors.splat(self.y0), vectors.mul(t, rate)),
            vectors.mul(vectors.splat(self.scale), ground),
        )
    }

    #[inline(always)]
    fn acceleration(&self, j: usize, _: f64) -> f64 {
        -self.weight - self.scale * self.ground.acceleration_m_s2[j]
    }

    #[inline(always)]
    fn bounds_ahead(&self, j: usize, _: f64, _: &Lanes) -> (f64, f64) {
        let ground = self.scale.abs() * self.ground.largest_ahead(j);
        (larger(ground - self.weight, 0.0), ground + self.weight)
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
