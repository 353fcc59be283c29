//! A record prepared for many runs: its integrals, and the extremes of its acceleration over blocks of samples.
//!
//! A system without post-uplift stiffness flies, relative to the ground, on a parabola minus the scaled ground displacement. With the
//! integrals of the record at hand its state at any sample is known from the start of the flight alone; with the extremes of the
//! acceleration over a block, a bound on the curvature shows that it does not come down within the block. So a
//! flight is followed in strides instead of samples, and nothing is approximated.

use crate::excitation::Excitation;

/// Strides of `2, 4, … 2^STRIDE_LEVELS` samples.
pub(crate) const STRIDE_LEVELS: usize = 6;

/// A unit-scale record with its integrals and block extremes. Memory: about 5 numbers a sample.
#[derive(Debug, Clone)]
pub struct GroundMotion<'a> {
    pub(crate) excitation: Excitation<'a>,
    /// Ground velocity and displacement at the samples, from rest, m/s and m.
    pub(crate) velocity_m_s: Vec<f64>,
    pub(crate) displacement_m: Vec<f64>,
    /// `extremes[l][b]`: least and largest acceleration over samples `b 2^l … (b + 1) 2^l`, both ends included, m/s².
    pub(crate) extremes: Vec<Vec<[f64; 2]>>,
}

impl<'a> GroundMotion<'a> {
    /// Prepare a record.
    pub fn new(excitation: Excitation<'a>) -> Self {
        let (dt, a) = (excitation.dt_s(), excitation.acceleration_m_s2());
        let (mut v, mut d) = (0.0, 0.0);
        let mut velocity_m_s = vec![0.0];
        let mut displacement_m = vec![0.0];
        for pair in a.windows(2) {
            // exact integrals of the linear acceleration
            d += dt * (v + dt * (pair[0] / 3.0 + pair[1] / 6.0));
            v += 0.5 * dt * (pair[0] + pair[1]);
            velocity_m_s.push(v);
            displacement_m.push(d);
        }
        let single: Vec<[f64; 2]> = a.windows(2).map(|p| [p[0].min(p[1]), p[0].max(p[1])]).collect();
        let extremes = halvings(single, |x, y| [x[0].min(y[0]), x[1].max(y[1])]);
        Self { excitation, velocity_m_s, displacement_m, extremes }
    }

    /// Number of sample intervals.
    pub(crate) fn intervals(&self) -> usize {
        self.excitation.acceleration_m_s2().len() - 1
    }
}

/// `[single, pairs of single, pairs of pairs, …]` for whole blocks, `STRIDE_LEVELS` times.
pub(crate) fn halvings<T: Copy>(single: Vec<T>, join: impl Fn(T, T) -> T) -> Vec<Vec<T>> {
    let mut levels = vec![single];
    for level in 0..STRIDE_LEVELS {
        let next = levels[level].chunks_exact(2).map(|pair| join(pair[0], pair[1])).collect();
        levels.push(next);
    }
    levels
}
