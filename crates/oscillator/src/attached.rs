//! A run while the system is attached: the scaled elastic response plus a free vibration of constant amplitude.

use uplift_instructions::Vectors;

use crate::ahead::{AHEAD, ahead, intervals_to_look_at, larger};
use crate::crossings::{State, stays_inside, uplift_within};
use crate::run::{IntervalState, Phase, Run, Segment};

impl<const STIFFNESS: bool> Run<'_, STIFFNESS> {
    #[inline(always)]
    pub(crate) fn attached<V: Vectors>(&self, vectors: V, start: IntervalState) -> Phase {
        let sweep = self.sweep;
        let k = sweep.attached.stiffness_per_s2;
        if start.interval == sweep.ground.intervals() {
            return Phase::RecordEnd(0.0, start.u, start.v);
        }
        // the rest of the interval of the impact
        let motion = self.motion(&start, k);
        let h = sweep.dt_s - start.offset_s;
        let (u, v) = self.end_of_interval(&motion, &start, &sweep.whole_attached);
        let end = State { u, v, w: -k * u - self.ground_end(start.interval) };
        self.attached_from(vectors, &Segment { at: start, motion, h, end })
    }

    /// Attached from the start of a segment on.
    #[inline(always)]
    pub(crate) fn attached_from<V: Vectors>(&self, vectors: V, segment: &Segment) -> Phase {
        let sweep = self.sweep;
        let mut segment = *segment;
        loop {
            if let Some(crossing) = uplift_within(&segment.motion, segment.h, &segment.end, sweep.boundary_m) {
                return self.uplift(crossing, &segment.at);
            }
            if sweep.attached.stiffness_per_s2 == 0.0 {
                // without stiffness there is no elastic response to scale
                let (u, v) = (segment.end.u, segment.end.v);
                return Phase::Attached(IntervalState {
                    interval: segment.at.interval + 1,
                    offset_s: 0.0,
                    u,
                    v,
                    force: 0.0,
                });
            }
            match self.seek_uplift(vectors, segment.at.interval + 1, &segment.end) {
                Ok(further) => segment = further,
                Err(over) => return over,
            }
        }
    }

    /// The first interval from the sample `j` on in which the system may uplift, or how the run ends before.
    #[inline(always)]
    pub(crate) fn seek_uplift<V: Vectors>(&self, vectors: V, mut j: usize, start: &State) -> Result<Segment, Phase> {
        let (sweep, scale) = (self.sweep, self.scale);
        let (n, k, boundary) = (sweep.ground.intervals(), sweep.attached.stiffness_per_s2, sweep.boundary_m);
        let (elastic, cos, sin) = (&sweep.elastic, &sweep.rotations.cos, &sweep.rotations.sin);
        let (mut u0, mut w0) = (start.u, start.w);
        // the free vibration as (displacement, velocity/ω), a vector that rotates
        let mut free =
            (start.u - scale * elastic.displacement_m[j], (start.v - scale * elastic.velocity_m_s[j]) / sweep.omega);
        let rotated =
            |free: (f64, f64), m: usize| (cos[m] * free.0 + sin[m] * free.1, cos[m] * free.1 - sin[m] * free.0);
        while j < n {
            let count = AHEAD.min(n - j);
            let unit = ahead(&elastic.displacement_m, j + 1);
            let ground = ahead(&sweep.ground.acceleration_m_s2, j + 1);
            let free_motion = vectors.add(
                vectors.mul(vectors.load(cos), vectors.splat(free.0)),
                vectors.mul(vectors.load(sin), vectors.splat(free.1)),
            );
            let displacement = vectors.add(vectors.mul(vectors.splat(scale), vectors.load(unit)), free_motion);
            let u = vectors.store(displacement);
            let acceleration = |m: usize| -k * u[m] - scale * ground[m];
            // an interval between two samples below that holds no event; the others are looked at one by one
            let quiet_m =
                sweep.quiet_factor * (boundary - sweep.sag_factor * (scale.abs() * sweep.ground.largest_ahead(j)));
            let quiet = vectors.at_most(displacement, vectors.splat(quiet_m))
                & vectors.at_most(vectors.splat(-quiet_m), displacement);
            let mut intervals = intervals_to_look_at(quiet, u0.abs() <= quiet_m, count);
            while intervals != 0 {
                let m = intervals.trailing_zeros() as usize;
                intervals &= intervals - 1;
                let (u0, w0) = if m == 0 { (u0, w0) } else { (u[m - 1], acceleration(m - 1)) };
                let w = acceleration(m);
                if self.may_uplift((u0, w0), (u[m], w)) {
                    let interval = j + m;
                    let velocity = |j: usize, free: (f64, f64)| scale * elastic.velocity_m_s[j] + sweep.omega * free.1;
                    let free0 = if m == 0 { free } else { rotated(free, m - 1) };
                    let at =
                        IntervalState { interval, offset_s: 0.0, u: u0, v: velocity(interval, free0), force: k * u0 };
                    let end = State { u: u[m], v: velocity(interval + 1, rotated(free, m)), w };
                    let motion = self.motion(&at, k);
                    if !stays_inside(&motion, sweep.dt_s, &end, boundary) {
                        return Ok(Segment { at, motion, h: sweep.dt_s, end });
                    }
                }
            }
            (u0, w0, free) = (u[count - 1], acceleration(count - 1), rotated(free, count - 1));
            j += count;
        }
        Err(Phase::RecordEnd(0.0, u0, scale * elastic.velocity_m_s[n] + sweep.omega * free.1))
    }

    /// Whether the displacement may exceed the boundary between two samples, from displacement and acceleration there.
    ///
    /// Where the acceleration is at most `W` and the ends differ by `Δ`, nothing between them lies higher than the
    /// higher one by more than `S (1 − Δ/4S)² ≤ S − Δ/4` with `S = W h²/8`, and nothing does if that is negative.
    #[inline(always)]
    fn may_uplift(&self, (u0, w0): (f64, f64), (u1, w1): (f64, f64)) -> bool {
        let sag = self.sweep.sag_factor * larger(w0.abs(), w1.abs()) - 0.25 * (u1 - u0).abs();
        let highest = larger(u0.abs(), u1.abs()) + if sag < 0.0 { 0.0 } else { sag };
        !(highest <= self.sweep.boundary_m)
    }
}
