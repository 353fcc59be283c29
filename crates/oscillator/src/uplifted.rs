//! A run while the system is uplifted, whatever the stiffness.

use uplift_instructions::Vectors;

use crate::ahead::{AHEAD, Lanes, intervals_to_look_at, larger, smaller};
use crate::crossings::{Crossing, SIMPLE, State, crossing, first_crossing, turning_time};
use crate::nodes::Node;
use crate::nonzero_stiffness::NonzeroStiffnessMotion;
use crate::run::{IntervalState, Phase, Run, Segment};
use crate::zero_stiffness::{PARABOLIC, ZeroStiffnessMotion};

/// An uplifted motion over the samples ahead, in the coordinates of its side.
pub(crate) trait UpliftedMotion {
    /// Distance at the samples after `j`.
    fn ahead<V: Vectors>(&self, vectors: V, j: usize) -> V::F64s;
    /// Acceleration at the sample `j`, where the distance is `y`.
    fn acceleration(&self, j: usize, y: f64) -> f64;
    /// Bounds on the outward and inward acceleration from the sample `j`, where it is `w0`, on over those after it,
    /// whose distances are `y`; at least zero.
    fn bounds_ahead(&self, j: usize, w0: f64, y: &Lanes) -> (f64, f64);
    /// Rate of the distance at the sample `j`.
    fn rate(&self, j: usize) -> f64;
    /// Restoring force per mass at the distance `y`.
    fn force(&self, y: f64) -> f64;
    /// A bound on the outward acceleration between samples, from the least and the greatest one at
    /// samples; at least zero.
    fn outward_bound(&self, least: f64, greatest: f64) -> f64;
    /// Makes the sample `j`, where the distance is `y`, the start; no sample before it is asked for any more.
    fn restart_at(&mut self, j: usize, y: f64);
}

impl<const STIFFNESS: bool> Run<'_, STIFFNESS> {
    #[inline(always)]
    pub(crate) fn uplifted<V: Vectors>(&mut self, vectors: V, side: f64, start: IntervalState) -> Phase {
        if start.interval == self.sweep.ground.intervals() {
            return Phase::RecordEnd(side, start.u, start.v);
        }
        self.uplifted_from(vectors, side, &self.rest_of_interval_uplifted(side, start))
    }

    /// The rest of the interval of an uplift.
    #[inline(always)]
    pub(crate) fn rest_of_interval_uplifted(&self, side: f64, at: IntervalState) -> Segment {
        let branch = &self.sweep.uplifted;
        let motion = self.motion(&at, branch.stiffness_per_s2);
        let h = self.sweep.dt_s - at.offset_s;
        let (u, v) = if STIFFNESS { motion.state(h) } else { motion.state_with(h, &PARABOLIC) };
        let force = if STIFFNESS { branch.restoring(side, u) } else { at.force };
        Segment { at, motion, h, end: State { u, v, w: -force - self.ground_end(at.interval) } }
    }

    /// Uplifted from the start of a segment on.
    #[inline(always)]
    pub(crate) fn uplifted_from<V: Vectors>(&mut self, vectors: V, side: f64, segment: &Segment) -> Phase {
        let mut segment = *segment;
        loop {
            if let Some(crossing) = self.uplifted_interval(side, &segment) {
                return self.impact(crossing, side, &segment.at);
            }
            match self.seek_impact(vectors, side, segment.at.interval + 1, &segment.end) {
                Ok(further) => segment = further,
                Err(over) => return over,
            }
        }
    }

    /// The first interval from the sample `j` on in which the system may come down, or turn back beyond the peak, or
    /// how the run ends before; the peak is raised on the way.
    #[inline(always)]
    pub(crate) fn seek_impact<V: Vectors>(
        &mut self,
        vectors: V,
        side: f64,
        j: usize,
        start: &State,
    ) -> Result<Segment, Phase> {
        match &self.sweep.nonzero_stiffness {
            _ if !STIFFNESS => {
                self.seek_impact_of(vectors, ZeroStiffnessMotion::new(self, side, j, start), side, j, start)
            }
            Some(stiffness) if stiffness.keeps_digits(self.scale, self.sweep.boundary_m) => {
                let motion = NonzeroStiffnessMotion::new(self, stiffness, side, j, start);
                self.seek_impact_of(vectors, motion, side, j, start)
            }
            _ => self.next_interval_uplifted(side, j, start),
        }
    }

    /// The interval after the sample `j`, where the samples further ahead cannot be evaluated together.
    fn next_interval_uplifted(&self, side: f64, j: usize, start: &State) -> Result<Segment, Phase> {
        if !(side * start.u <= self.sweep.overturned_m) {
            return Err(Phase::Overturned);
        }
        if j == self.sweep.ground.intervals() {
            return Err(Phase::RecordEnd(side, start.u, start.v));
        }
        let force = self.sweep.uplifted.restoring(side, start.u);
        let at = IntervalState { interval: j, offset_s: 0.0, u: start.u, v: start.v, force };
        Ok(self.rest_of_interval_uplifted(side, at))
    }

    #[inline(always)]
    fn seek_impact_of<V: Vectors>(
        &mut self,
        vectors: V,
        mut uplifted: impl UpliftedMotion,
        side: f64,
        mut j: usize,
        start: &State,
    ) -> Result<Segment, Phase> {
        let sweep = self.sweep;
        let (n, dt_s, boundary) = (sweep.ground.intervals(), sweep.dt_s, sweep.boundary_m);
        let eighth = 0.125 * dt_s * dt_s;
        let (mut y0, mut w0) = (side * start.u, side * start.w);
        if !(y0 <= sweep.overturned_m) {
            return Err(Phase::Overturned);
        }
        while j < n {
            let count = AHEAD.min(n - j);
            let distance = uplifted.ahead(vectors, j);
            let y = vectors.store(distance);
            let (outward, inward) = uplifted.bounds_ahead(j, w0, &y);
            let (dip, rise) = (eighth * outward, eighth * inward);
            let limit = smaller(self.peak_m, sweep.overturned_m);
            // an interval between two quiet samples holds no event; the others are looked at one by one
            let quiet = vectors.at_most(vectors.splat(boundary), vectors.sub(distance, vectors.splat(dip)))
                & vectors.at_most(vectors.add(distance, vectors.splat(rise)), vectors.splat(limit));
            let quiet_start = y0 - dip >= boundary && y0 + rise <= limit;
            let mut intervals = intervals_to_look_at(quiet, quiet_start, count);
            while intervals != 0 {
                let m = intervals.trailing_zeros() as usize;
                intervals &= intervals - 1;
                let interval = j + m;
                let (y0, w0) = if m == 0 { (y0, w0) } else { (y[m - 1], uplifted.acceleration(interval, y[m - 1])) };
                let w = uplifted.acceleration(interval + 1, y[m]);
                if self.may_impact_or_peak(&uplifted, (y0, w0), (y[m], w)) {
                    let (rate0, rate1) = (uplifted.rate(interval), uplifted.rate(interval + 1));
                    let force = side * uplifted.force(y0);
                    let at = IntervalState { interval, offset_s: 0.0, u: side * y0, v: side * rate0, force };
                    let motion = self.motion(&at, sweep.uplifted.stiffness_per_s2);
                    let end = State { u: side * y[m], v: side * rate1, w: side * w };
                    return Ok(Segment { at, motion, h: dt_s, end });
                }
                if !(y[m] <= sweep.overturned_m) {
                    return Err(Phase::Overturned);
                }
                self.peak_m = larger(y[m], self.peak_m);
            }
            y0 = y[count - 1];
            w0 = uplifted.acceleration(j + count, y0);
            j += count;
            uplifted.restart_at(j, y0);
        }
        Err(Phase::RecordEnd(side, side * y0, side * uplifted.rate(n)))
    }

    /// Whether the system may come down, or turn back beyond the peak, between two samples, from distance and
    /// acceleration there; see [`may_uplift`](Self::may_uplift).
    #[inline(always)]
    fn may_impact_or_peak(&self, uplifted: &impl UpliftedMotion, (y0, w0): (f64, f64), (y1, w1): (f64, f64)) -> bool {
        let eighth = 0.125 * self.sweep.dt_s * self.sweep.dt_s;
        let quarter = 0.25 * (y1 - y0).abs();
        let (least, greatest) = (smaller(w0, w1), larger(w0, w1));
        let dip = larger(eighth * uplifted.outward_bound(least, greatest) - quarter, 0.0);
        let rise = larger(eighth * uplifted.outward_bound(-greatest, -least) - quarter, 0.0);
        let stays_uplifted = smaller(y0, y1) - dip >= self.sweep.boundary_m;
        let no_new_peak = larger(y0, y1) + rise <= self.peak_m || rise == 0.0;
        !(stays_uplifted && no_new_peak)
    }

    /// Raise the peak over one segment, or up to the impact in it, which is returned.
    #[inline(always)]
    pub(crate) fn uplifted_interval(&mut self, side: f64, segment: &Segment) -> Option<Crossing> {
        let Segment { motion, h, end, .. } = segment;
        let (h, boundary) = (*h, self.sweep.boundary_m);
        let (from, to) = (side * motion.u0, side * end.u);
        let (v0, v1) = (side * motion.v0, side * end.v);
        let falls = side * motion.w0 <= 0.0 && side * end.w <= 0.0 && motion.k * h * h < SIMPLE;
        if falls || (v0 * v1 > 0.0 && motion.keeps_direction(h, end.v)) {
            let (start, end_node) = (Node { tau: 0.0, u: motion.u0 }, Node { tau: h, u: end.u });
            let mut top = to;
            if v0 > 0.0 && v1 < 0.0 && smaller(from + v0 * h, to - v1 * h) > self.peak_m {
                // the velocity falls all the way and is zero once
                top = side * motion.state(turning_time(motion, h, end.v)).0;
            }
            self.peak_m = larger(top, self.peak_m);
            if to >= boundary {
                return None;
            }
            return Some(crossing(motion, start, motion.v0, end_node, side * boundary));
        }
        let sag = 0.125 * h * h * motion.acceleration_bound(h, end.w);
        if from.min(to) - sag >= boundary && from.max(to) + sag <= self.peak_m {
            return None;
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
