//! The response of one branch from rest: any motion on the branch is this one times the scale plus a free motion.
//!
//! It starts again from rest every few samples: over a whole record it would grow beyond all bounds where the stiffness
//! is negative, and be large beside the motions it is a part of elsewhere, which would cost digits. Where it grows too
//! fast even so, it is not used.

use crate::ahead::{AHEAD, larger};
use crate::ground_motion::GroundMotion;
use crate::stumpff::Stumpff;

/// Samples after which the response begins again from rest, at most and at least: powers of two.
const LONGEST: usize = 64;
const SHORTEST: usize = 16;
/// Largest growth after one state of rest, as the exponent of e: a digit and a half.
const GROWTH: f64 = 3.0;

/// Displacement and velocity at the samples of every block, and as many after it as are evaluated together.
#[derive(Debug, Clone)]
pub(crate) struct ParticularResponse {
    /// Samples of a block, as the power of two.
    block: u32,
    displacement_m: Vec<f64>,
    velocity_m_s: Vec<f64>,
}

impl ParticularResponse {
    /// The response of a branch of stiffness `k`, 1/s², to the unit-scale record.
    pub(crate) fn new(k: f64, ground: &GroundMotion<'_>) -> Option<Self> {
        let dt_s = ground.excitation.dt_s();
        let growth_a_sample = (-k).max(0.0).sqrt() * dt_s;
        let suits = |block: usize| growth_a_sample * (block + AHEAD) as f64 <= GROWTH;
        let mut block = LONGEST;
        while !suits(block) {
            block /= 2;
            if block < SHORTEST {
                return None;
            }
        }
        let (step, a) = (Step::new(k, dt_s), &ground.acceleration_m_s2);
        let blocks = ground.intervals() / block + 1;
        let mut displacement_m = vec![0.0; blocks * (block + AHEAD)];
        let mut velocity_m_s = displacement_m.clone();
        for i in 0..blocks {
            let (mut u, mut v) = (0.0, 0.0);
            let start = i * (block + AHEAD);
            for (m, pair) in a[i * block..].windows(2).take(block + AHEAD - 1).enumerate() {
                (u, v) = step.next((u, v), pair[0], pair[1]);
                displacement_m[start + m + 1] = u;
                velocity_m_s[start + m + 1] = v;
            }
        }
        Some(Self { block: block.trailing_zeros(), displacement_m, velocity_m_s })
    }

    /// Largest displacement, m.
    pub(crate) fn largest_m(&self) -> f64 {
        self.displacement_m.iter().fold(0.0, |largest, u| larger(u.abs(), largest))
    }

    /// Displacements (m) and velocities (m/s) at the sample `j` and those ahead of it, from the same state of rest.
    #[inline(always)]
    pub(crate) fn from(&self, j: usize) -> (&[f64], &[f64]) {
        let index = j + (j >> self.block) * AHEAD;
        (&self.displacement_m[index..], &self.velocity_m_s[index..])
    }
}

/// From sample to sample on a branch: the free motion, and what the ground adds to it,
/// `u' = c0 u + h c1 v + …`, `v' = −k h c1 u + c0 v + …`.
pub(crate) struct Step {
    k: f64,
    samples_per_s: f64,
    c0: f64,
    h_c1: f64,
    h_c2: f64,
    h_c3: f64,
}

impl Step {
    pub(crate) fn new(k: f64, dt_s: f64) -> Self {
        let whole = Stumpff::at(k * dt_s * dt_s);
        let (h_c1, h_c2, h_c3) = (dt_s * whole.c1, dt_s * dt_s * whole.c2, dt_s * dt_s * dt_s * whole.c3);
        Self { k, samples_per_s: dt_s.recip(), c0: whole.c0, h_c1, h_c2, h_c3 }
    }

    /// The state after an interval over which the ground acceleration changes from `a0` to `a1`, m/s².
    #[inline(always)]
    pub(crate) fn next(&self, (u, v): (f64, f64), a0: f64, a1: f64) -> (f64, f64) {
        let slope = (a1 - a0) * self.samples_per_s;
        let pushed = (-a0 * self.h_c2 - slope * self.h_c3, -a0 * self.h_c1 - slope * self.h_c2);
        (self.c0 * u + self.h_c1 * v + pushed.0, self.c0 * v - self.k * self.h_c1 * u + pushed.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Excitation;
    use crate::branch::LinearMotion;
    use crate::problems::shaped_noise;

    #[test]
    fn from_any_sample_it_is_a_motion_on_the_branch() {
        let record = shaped_noise(4.0, 500, 3);
        let ground = GroundMotion::new(Excitation::new(0.01, &record).unwrap());
        // too strong: e^0.5 a sample
        assert!(ParticularResponse::new(-2500.0, &ground).is_none());
        for k in [-80.0, -9.0, -0.1, 0.5, 30.0] {
            let response = ParticularResponse::new(k, &ground).unwrap();
            for j in 0..record.len() {
                let (u, v) = response.from(j);
                for (m, pair) in record[j..].windows(2).take(AHEAD).enumerate() {
                    let slope = (pair[1] - pair[0]) / 0.01;
                    let motion = LinearMotion { u0: u[m], v0: v[m], w0: -k * u[m] - pair[0], j0: -slope - k * v[m], k };
                    let end = motion.state(0.01);
                    assert!((end.0 - u[m + 1]).abs() < 1e-14 * (1e-3 + u[m + 1].abs()), "{k} {j} {m}");
                    assert!((end.1 - v[m + 1]).abs() < 1e-14 * (1.0 + v[m + 1].abs()), "{k} {j} {m}");
                }
            }
        }
    }
}
