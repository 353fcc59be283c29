//! A run while the system is uplifted: intervals one by one.

use crate::ahead::smaller;
use crate::nodes::Node;
use crate::passages::{Passage, State, first_crossing, passage, turning_time};
use crate::reference::OVERTURNED_CAPACITIES;
use crate::run::{At, Phase, Run, Stretch};

impl Run<'_> {
    /// Uplifted with a stiffness: sample by sample.
    pub(crate) fn uplifted(&mut self, side: f64, start: At) -> Phase {
        let sweep = self.sweep;
        let mut at = start;
        loop {
            if at.interval == sweep.ground.intervals() {
                return Phase::RecordEnd(side, at.u, at.v);
            }
            let motion = self.motion(&at, sweep.uplifted.stiffness_per_s2);
            let h = sweep.dt_s - at.offset_s;
            let (u, v) = self.end_of_interval(&motion, &at, &sweep.whole_uplifted);
            let force = sweep.uplifted.restoring(side, u);
            let end = State { u, v, w: -force - self.ground_end(at.interval).0 };
            if let Some(passage) = self.uplifted_interval(side, &Stretch { at, motion, h, end }) {
                return self.impact(passage, side, &at);
            }
            at = At { interval: at.interval + 1, offset_s: 0.0, u, v, force };
            if sweep.capacity_m.is_finite() && !(u.abs() <= OVERTURNED_CAPACITIES * sweep.capacity_m) {
                return Phase::Overturned;
            }
        }
    }

    /// Raise the peak over one stretch, or up to the impact in it, whose time is returned.
    #[inline(always)]
    pub(crate) fn uplifted_interval(&mut self, side: f64, stretch: &Stretch) -> Option<Passage> {
        let Stretch { motion, h, end, .. } = stretch;
        let (h, boundary) = (*h, self.sweep.boundary_m);
        let sag = 0.125 * h * h * motion.acceleration_bound(h, end.w);
        let (from, to) = (side * motion.u0, side * end.u);
        if from.min(to) - sag >= boundary && from.max(to) + sag <= self.peak_m {
            return None;
        }
        let concave = side * motion.w0 <= 0.0 && side * end.w <= 0.0 && motion.k <= 0.0;
        if concave {
            let (v0, v1) = (side * motion.v0, side * end.v);
            let (start, end_node) = (Node { tau: 0.0, u: motion.u0 }, Node { tau: h, u: end.u });
            let mut top = to;
            if v0 > 0.0 && v1 < 0.0 && smaller(from + v0 * h, to - v1 * h) > self.peak_m {
                // the velocity falls all the way and is zero once
                top = side * motion.state(turning_time(motion, h, end.v)).0;
            }
            self.peak_m = self.peak_m.max(top);
            if to >= boundary {
                return None;
            }
            return Some(passage(motion, start, motion.v0, end_node, side * boundary));
        }
        let mut peak_m = self.peak_m;
        let found = first_crossing(motion, h, |u| {
            if side * u < boundary {
                return Some(side * boundary);
            }
            peak_m = peak_m.max(side * u);
            None
        });
        self.peak_m = peak_m;
        found
    }
}
