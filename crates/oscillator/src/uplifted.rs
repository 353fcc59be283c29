//! A run while the system is uplifted: intervals one by one.

use crate::ahead::smaller;
use crate::branch::LinearMotion;
use crate::nodes::Node;
use crate::passages::{Passage, first_crossing, passage, turning_time};
use crate::reference::OVERTURNED_CAPACITIES;
use crate::run::{At, Phase, Run};

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
            let rest = sweep.dt_s - at.offset_s;
            let (u, v) = self.end_of_interval(&motion, &at, &sweep.whole_uplifted);
            let force = sweep.uplifted.restoring(side, u);
            if let Some(passage) =
                self.uplifted_interval(&motion, rest, side, (u, v), -force - self.ground_end(at.interval).0)
            {
                return self.impact(passage, side, &at);
            }
            at = At { interval: at.interval + 1, offset_s: 0.0, u, v, force };
            if sweep.capacity_m.is_finite() && !(u.abs() <= OVERTURNED_CAPACITIES * sweep.capacity_m) {
                return Phase::Overturned;
            }
        }
    }

    /// Raise the peak over one interval, or up to the impact in it, whose time is returned.
    ///
    /// * `end` — displacement and velocity at the end, `w1` the acceleration there
    #[inline(always)]
    pub(crate) fn uplifted_interval(
        &mut self,
        motion: &LinearMotion,
        rest: f64,
        side: f64,
        end: (f64, f64),
        w1: f64,
    ) -> Option<Passage> {
        let boundary = self.sweep.boundary_m;
        let sag = 0.125 * rest * rest * motion.acceleration_bound(rest, w1);
        let (from, to) = (side * motion.u0, side * end.0);
        if from.min(to) - sag >= boundary && from.max(to) + sag <= self.peak_m {
            return None;
        }
        let concave = side * motion.w0 <= 0.0 && side * w1 <= 0.0 && motion.k <= 0.0;
        if concave {
            let (v0, v1) = (side * motion.v0, side * end.1);
            let (start, end_node) = (Node { tau: 0.0, u: motion.u0 }, Node { tau: rest, u: end.0 });
            let mut top = to;
            if v0 > 0.0 && v1 < 0.0 && smaller(from + v0 * rest, to - v1 * rest) > self.peak_m {
                // the velocity falls all the way and is zero once
                top = side * motion.state(turning_time(motion, rest, end.1)).0;
            }
            self.peak_m = self.peak_m.max(top);
            if to >= boundary {
                return None;
            }
            return Some(passage(motion, start, motion.v0, end_node, side * boundary));
        }
        let mut peak_m = self.peak_m;
        let found = first_crossing(motion, rest, |u| {
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
