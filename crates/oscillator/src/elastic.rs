//! The attached response to a unit-scale record: linear, so it holds for every scale.
//!
//! Until the first uplift the response is this one times the scale factor. Later, whenever the system is attached, it
//! differs from it by a free vibration of constant amplitude. So a run needs no step from sample to sample.

use crate::ahead::{AHEAD, larger, padded};
use crate::branch::{Branch, LinearMotion};
use crate::free_vibration::{FreePeak, first_peak};
use crate::ground_motion::GroundMotion;
use crate::nodes::Nodes;
use crate::particular::Step;
use crate::sweep::growth;

/// The attached response at every sample, with its extremes.
#[derive(Debug, Clone)]
pub(crate) struct ElasticResponse {
    /// At the samples and the padding after them.
    pub(crate) displacement_m: Vec<f64>,
    pub(crate) velocity_m_s: Vec<f64>,
    /// `(interval, largest abs(u) up to its end)` for each interval that holds a new one.
    highs: Vec<(usize, f64)>,
    /// Largest `abs(u)` of the whole response, m.
    pub(crate) peak_m: f64,
}

impl ElasticResponse {
    /// The response on `attached` alone, as if the system never uplifted.
    pub(crate) fn new(attached: &Branch, ground: &GroundMotion<'_>, with_free_peak: bool) -> Self {
        let dt = ground.excitation.dt_s();
        let k = attached.stiffness_per_s2;
        let samples_per_s = dt.recip();
        let (n, sag_factor) = (ground.intervals(), 0.125 * dt * dt * growth(k.sqrt() * dt));
        let (mut u, mut v, mut peak_m) = (0.0, 0.0, 0.0_f64);
        let mut displacement_m = Vec::with_capacity(n + 1 + AHEAD);
        let mut velocity_m_s = Vec::with_capacity(n + 1);
        let mut highs = Vec::new();
        displacement_m.push(u);
        velocity_m_s.push(v);
        let step = Step::new(k, dt);
        let mut w = -ground.acceleration_m_s2[0];
        for (i, pair) in ground.excitation.acceleration_m_s2().windows(2).enumerate() {
            let slope = (pair[1] - pair[0]) * samples_per_s;
            let start = (u, v, w);
            (u, v) = step.next((u, v), pair[0], pair[1]);
            w = -k * u - pair[1];
            let motion = LinearMotion { u0: start.0, v0: start.1, w0: start.2, j0: -slope - k * start.1, k };
            let sag = if sag_factor.is_nan() {
                0.125 * dt * dt * motion.acceleration_bound(dt, w)
            } else {
                sag_factor * larger(motion.w0.abs(), w.abs())
            };
            if larger(motion.u0.abs(), u.abs()) + sag > peak_m {
                let high = Nodes::new(&motion, dt).fold(peak_m, |high, node| high.max(node.u.abs()));
                if high > peak_m {
                    peak_m = high;
                    highs.push((i, high));
                }
            }
            displacement_m.push(u);
            velocity_m_s.push(v);
        }
        let free_peak_m = match first_peak(attached, attached, f64::INFINITY, 1.0, (0.0, u, v)) {
            _ if !with_free_peak => 0.0,
            // without stiffness the system drifts on after the record
            _ if k == 0.0 && v != 0.0 => f64::INFINITY,
            FreePeak::At { displacement_m, .. } => displacement_m,
            FreePeak::Overturns => 0.0,
        };
        if free_peak_m > peak_m {
            peak_m = free_peak_m;
            highs.push((n, free_peak_m));
        }
        Self { displacement_m: padded(displacement_m), velocity_m_s, highs, peak_m }
    }

    /// The first interval in which `abs(u)` exceeds `level_m`; the number of intervals if only the free vibration does.
    pub(crate) fn first_interval_above(&self, level_m: f64) -> Option<usize> {
        let position = self.highs.partition_point(|&(_, high)| high <= level_m);
        self.highs.get(position).map(|&(interval, _)| interval)
    }
}
