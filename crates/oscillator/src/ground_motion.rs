//! A record prepared for many runs: its integrals.
//!
//! While uplifted, a system without post-uplift stiffness moves, relative to the ground, on a parabola
//! minus the scaled ground displacement. With the integrals of the record its state at any sample follows
//! from the state at uplift alone.

use crate::ahead::{AHEAD, larger, padded};
use crate::excitation::Excitation;

/// A unit-scale record with its integrals. Memory: a little over 3 numbers a sample beside the record.
#[derive(Debug, Clone)]
pub struct GroundMotion<'a> {
    pub(crate) excitation: Excitation<'a>,
    /// Ground acceleration, velocity and displacement at the samples, the latter from rest; m/s², m/s and m. The
    /// samples of acceleration and displacement are followed by padding.
    pub(crate) acceleration_m_s2: Vec<f64>,
    pub(crate) velocity_m_s: Vec<f64>,
    pub(crate) displacement_m: Vec<f64>,
    /// The largest `abs` of the acceleration over each block of [`AHEAD`] samples and the next one, m/s².
    largest_m_s2: Vec<f64>,
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
        let largest: Vec<f64> =
            a.chunks(AHEAD).map(|block| block.iter().fold(0.0, |most, a| larger(a.abs(), most))).collect();
        let next = largest[1..].iter().chain(&[0.0]);
        let largest_m_s2 = largest.iter().zip(next).map(|(block, next)| larger(*block, *next)).collect();
        Self {
            excitation,
            acceleration_m_s2: padded(a.to_vec()),
            velocity_m_s,
            displacement_m: padded(displacement_m),
            largest_m_s2,
        }
    }

    /// A bound on the `abs` of the acceleration from the sample `j` on to the last of the [`AHEAD`] after it, m/s².
    #[inline(always)]
    pub(crate) fn largest_ahead(&self, j: usize) -> f64 {
        self.largest_m_s2[j / AHEAD]
    }

    /// Number of sample intervals.
    pub(crate) fn intervals(&self) -> usize {
        self.excitation.acceleration_m_s2().len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_ahead_is_no_less_than_any_sample_there() {
        for samples in [2, 15, 16, 17, 32, 33, 50] {
            // one sample stands out, wherever it is
            for peak in 0..samples {
                let mut record = vec![0.1; samples];
                record[peak] = -1.0;
                let ground = GroundMotion::new(Excitation::new(0.01, &record).unwrap());
                for j in 0..ground.intervals() {
                    let ahead = &record[j..samples.min(j + AHEAD + 1)];
                    let largest = ahead.iter().fold(0.0, |most, a| larger(a.abs(), most));
                    assert!(ground.largest_ahead(j) >= largest, "{samples} {peak} {j}");
                    // and far from the peak it is not that of the peak
                    if peak + AHEAD < j || peak > j + 2 * AHEAD {
                        assert_eq!(ground.largest_ahead(j), 0.1, "{samples} {peak} {j}");
                    }
                }
            }
        }
    }
}
