//! One run of the fast solver: from phase to phase, over one record at one scale.

use crate::branch::LinearMotion;
use crate::free_vibration::{FreePeak, first_peak};
use crate::ground_motion::STRIDE_LEVELS;
use crate::nodes::Node;
use crate::passages::{Passage, State, first_crossing, passage, transit, turning_time, uplift_within};
use crate::reference::OVERTURNED_CAPACITIES;
use crate::stumpff::Stumpff;
use crate::sweep::{Peak, Sweep};

/// Samples stepped one by one before another block is tried.
const SAMPLES_BETWEEN_SKIPS: usize = 4;

/// Stumpff functions of a branch without stiffness.
const PARABOLIC: Stumpff = Stumpff { c0: 1.0, c1: 1.0, c2: 0.5, c3: 1.0 / 6.0 };

/// A state inside a sample interval.
#[derive(Debug, Clone, Copy)]
struct At {
    interval: usize,
    /// Time since the start of the interval, s; below the sampling interval.
    offset_s: f64,
    u: f64,
    v: f64,
    /// Restoring force per mass, `± η g` to the bit at an event.
    force: f64,
}

/// Where a run stands between events.
#[derive(Debug, Clone, Copy)]
enum Phase {
    Attached(At),
    Uplifted(f64, At),
    /// Nothing in the rest of the record lifts the system again.
    Quiet,
    Overturned,
    /// The record has ended on this side, with this displacement and velocity.
    RecordEnd(f64, f64, f64),
}

pub(crate) struct Run<'a> {
    sweep: &'a Sweep<'a>,
    scale: f64,
    peak_m: f64,
    impacts: u32,
}

impl<'a> Run<'a> {
    pub(crate) fn new(sweep: &'a Sweep<'a>, scale: f64) -> Self {
        Self { sweep, scale, peak_m: sweep.boundary_m, impacts: 0 }
    }

    /// The peak of a run whose first uplift is in `interval`.
    pub(crate) fn follow(mut self, interval: usize) -> Peak {
        let sweep = self.sweep;
        let u = self.scale * sweep.elastic.displacement_m[interval];
        let v = self.scale * sweep.elastic.velocity_m_s[interval];
        let force = sweep.attached.stiffness_per_s2 * u;
        let mut phase = Phase::Attached(At { interval, offset_s: 0.0, u, v, force });
        loop {
            phase = match phase {
                Phase::Attached(at) => self.attached(at),
                Phase::Uplifted(side, at) if sweep.uplifted.stiffness_per_s2 == 0.0 => self.flight(side, at),
                Phase::Uplifted(side, at) => self.uplifted(side, at),
                Phase::Quiet => break,
                Phase::Overturned => {
                    self.peak_m = f64::INFINITY;
                    break;
                }
                Phase::RecordEnd(side, u, v) => {
                    self.free_vibration(side, u, v);
                    break;
                }
            }
        }
        Peak { displacement_m: self.peak_m, impacts: self.impacts }
    }

    /// Acceleration at the start of an interval and its slope there, scaled.
    fn ground(&self, interval: usize) -> (f64, f64) {
        let a = self.sweep.ground.excitation.acceleration_m_s2();
        let (from, to) = (self.scale * a[interval], self.scale * a[interval + 1]);
        (from, (to - from) * self.sweep.samples_per_s)
    }

    /// The motion from `at` on a branch of stiffness `k`.
    fn motion(&self, at: &At, k: f64) -> LinearMotion {
        let (from, slope) = self.ground(at.interval);
        LinearMotion { u0: at.u, v0: at.v, w0: -at.force - (from + slope * at.offset_s), j0: -slope - k * at.v, k }
    }

    /// The state of `motion` at the end of the interval of `at`.
    fn end_of_interval(&self, motion: &LinearMotion, at: &At, whole: &Stumpff) -> (f64, f64) {
        if at.offset_s == 0.0 {
            motion.state_with(self.sweep.dt_s, whole)
        } else {
            motion.state(self.sweep.dt_s - at.offset_s)
        }
    }

    fn attached(&mut self, start: At) -> Phase {
        let sweep = self.sweep;
        let (k, boundary) = (sweep.attached.stiffness_per_s2, sweep.boundary_m);
        if start.interval == sweep.ground.intervals() {
            return Phase::RecordEnd(0.0, start.u, start.v);
        }
        // the rest of the interval of the impact
        let motion = self.motion(&start, k);
        let rest = sweep.dt_s - start.offset_s;
        if let Some(passage) = transit(&motion, rest, boundary) {
            return self.uplift(passage, &start);
        }
        let (u, v) = self.end_of_interval(&motion, &start, &sweep.whole_attached);
        let end = State { u, v, w: -k * u - self.ground_end(start.interval).0 };
        if let Some(passage) = uplift_within(&motion, rest, &end, boundary) {
            return self.uplift(passage, &start);
        }
        if k == 0.0 {
            // without stiffness there is no elastic response to lean on
            let force = 0.0;
            return Phase::Attached(At { interval: start.interval + 1, offset_s: 0.0, u, v, force });
        }
        self.attached_samples(start.interval + 1, u, v)
    }

    /// Attached from the sample `j` on: the scaled elastic response plus a free vibration of constant amplitude.
    fn attached_samples(&mut self, mut j: usize, mut u: f64, v: f64) -> Phase {
        let (sweep, elastic) = (self.sweep, &self.sweep.elastic);
        let (n, k, boundary, scale) =
            (sweep.ground.intervals(), sweep.attached.stiffness_per_s2, sweep.boundary_m, self.scale);
        // the free vibration as (displacement, velocity/ω), a vector that turns
        let mut free = (u - scale * elastic.displacement_m[j], (v - scale * elastic.velocity_m_s[j]) / sweep.omega);
        // a margin for the rounding of the rotations below
        let amplitude = (free.0 * free.0 + free.1 * free.1).sqrt() * (1.0 + 1e-9);
        let magnitude = scale.abs();
        let room = boundary - amplitude;
        if magnitude * elastic.bound_from[j] <= room {
            return Phase::Quiet;
        }
        let sag_factor = sweep.sag_factor;
        let acceleration = sweep.ground.excitation.acceleration_m_s2();
        let mut w = -k * u - scale * acceleration[j];
        let (cos, sin) = sweep.rotations[0];
        while j < n {
            if room > 0.0 {
                let skipped = self.skip_blocks(&mut j, &mut free, room);
                if skipped {
                    u = scale * elastic.displacement_m[j] + free.0;
                    w = -k * u - scale * acceleration[j];
                }
            }
            let stop = if room > 0.0 { n.min(j + SAMPLES_BETWEEN_SKIPS) } else { n };
            let ahead = elastic.displacement_m[j..=stop].iter().zip(&acceleration[j..=stop]).skip(1);
            for (interval, (elastic_u, ground)) in (j..stop).zip(ahead) {
                let turned = (cos * free.0 + sin * free.1, cos * free.1 - sin * free.0);
                let next_u = scale * elastic_u + turned.0;
                let next_w = -k * next_u - scale * ground;
                // above the chord by what the motion curves down at most, and the other way round
                let above = larger(u, next_u) + sag_factor * larger(larger(-w, -next_w), 0.0);
                let below = smaller(u, next_u) - sag_factor * larger(larger(w, next_w), 0.0);
                if !(above <= boundary && below >= -boundary) {
                    let v = scale * elastic.velocity_m_s[interval] + sweep.omega * free.1;
                    let at = At { interval, offset_s: 0.0, u, v, force: k * u };
                    let end_v = scale * elastic.velocity_m_s[interval + 1] + sweep.omega * turned.1;
                    let end = State { u: next_u, v: end_v, w: next_w };
                    let motion = self.motion(&at, k);
                    if let Some(passage) = uplift_within(&motion, sweep.dt_s, &end, boundary) {
                        return self.uplift(passage, &at);
                    }
                }
                (u, w, free) = (next_u, next_w, turned);
            }
            j = stop;
        }
        Phase::RecordEnd(0.0, u, scale * elastic.velocity_m_s[n] + sweep.omega * free.1)
    }

    /// Skip the blocks from the sample `j` on in which the elastic response stays so small that no phase of the free vibration lifts the
    /// system, turning `free` along; true if there was one.
    fn skip_blocks(&self, j: &mut usize, free: &mut (f64, f64), room: f64) -> bool {
        let (elastic, n) = (&self.sweep.elastic, self.sweep.ground.intervals());
        let limit = room / self.scale.abs();
        let start = *j;
        let mut level = 0;
        while *j < n {
            while level > 0 && !(j.is_multiple_of(1 << level) && *j >> level < elastic.bounds[level].len()) {
                level -= 1;
            }
            if elastic.bounds[level][*j >> level] <= limit {
                let (cos, sin) = self.sweep.rotations[level];
                *free = (cos * free.0 + sin * free.1, cos * free.1 - sin * free.0);
                *j += 1 << level;
                level = (level + 1).min(STRIDE_LEVELS);
            } else if level > 0 {
                level -= 1;
            } else {
                break;
            }
        }
        *j > start
    }

    fn ground_end(&self, interval: usize) -> (f64, f64) {
        let a = self.sweep.ground.excitation.acceleration_m_s2();
        (self.scale * a[interval + 1], self.scale * a[interval])
    }

    fn uplift(&self, passage: Passage, at: &At) -> Phase {
        let sweep = self.sweep;
        let side = 1.0_f64.copysign(passage.level);
        let v = side * (side * passage.v).max(0.0);
        let displaced = At {
            interval: at.interval,
            offset_s: at.offset_s + passage.tau,
            u: side * sweep.boundary_m,
            v,
            force: side * sweep.at_boundary_m_s2,
        };
        Phase::Uplifted(side, self.normalised(displaced))
    }

    /// A state at the very end of an interval belongs to the next one.
    fn normalised(&self, at: At) -> At {
        if at.offset_s < self.sweep.dt_s { at } else { At { interval: at.interval + 1, offset_s: 0.0, ..at } }
    }

    fn impact(&mut self, passage: Passage, side: f64, at: &At) -> Phase {
        let sweep = self.sweep;
        self.impacts += 1;
        Phase::Attached(self.normalised(At {
            interval: at.interval,
            offset_s: at.offset_s + passage.tau,
            u: side * sweep.boundary_m,
            v: sweep.restitution * side * (side * passage.v).min(0.0),
            force: side * sweep.at_boundary_m_s2,
        }))
    }

    /// Uplifted with a stiffness: sample by sample.
    fn uplifted(&mut self, side: f64, start: At) -> Phase {
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
    fn uplifted_interval(
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
            if v0 > 0.0 && v1 < 0.0 {
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

    /// Uplifted without stiffness: in strides over the integrals of the record.
    fn flight(&mut self, side: f64, start: At) -> Phase {
        let sweep = self.sweep;
        let ground = sweep.ground;
        let (n, dt, boundary) = (ground.intervals(), sweep.dt_s, sweep.boundary_m);
        if start.interval == n {
            return Phase::RecordEnd(side, start.u, start.v);
        }

        // the rest of the interval in which the flight begins
        let motion = self.motion(&start, 0.0);
        let rest = dt - start.offset_s;
        let end = motion.state_with(rest, &PARABOLIC);
        let w1 = -start.force - self.ground_end(start.interval).0;
        if let Some(passage) = self.uplifted_interval(&motion, rest, side, end, w1) {
            return self.impact(passage, side, &start);
        }

        // y = side u = y0 + T (p − η g T/2) − c (D(t) − D0), in terms of the time T since the next sample
        let c = side * self.scale;
        let weight = sweep.at_boundary_m_s2;
        let base = start.interval + 1;
        let (y0, rate0) = (side * end.0, side * end.1);
        let p = rate0 + c * ground.velocity_m_s[base];
        let d0 = ground.displacement_m[base];
        let state = |j: usize| {
            let t = (j - base) as f64 * dt;
            let y = y0 + t * (p - 0.5 * weight * t) - c * (ground.displacement_m[j] - d0);
            (y, p - weight * t - c * ground.velocity_m_s[j])
        };
        let (mut j, mut y, mut rate) = (base, y0, rate0);
        let mut level = 0;
        while j < n {
            while level > 0 && !(j.is_multiple_of(1 << level) && j >> level < ground.extremes[level].len()) {
                level -= 1;
            }
            let stride_s = dt * f64::from(1_u32 << level);
            let next = j + (1 << level);
            let (y1, rate1) = state(next);
            let [least, largest] = ground.extremes[level][j >> level];
            // bounds on ÿ = −η g − c a over the stride
            let (a, b) = (-c * least, -c * largest);
            let fastest_fall = smaller(smaller(a, b) - weight, 0.0);
            let fastest_rise = larger(larger(a, b) - weight, 0.0);
            let eighth = 0.125 * stride_s * stride_s;
            let stays_up = smaller(y, y1) - eighth * fastest_rise >= boundary;
            let no_new_peak = || {
                larger(y, y1) - eighth * fastest_fall <= self.peak_m
                    || rate + stride_s * fastest_fall >= 0.0
                    || rate + stride_s * fastest_rise <= 0.0
            };
            if stays_up && no_new_peak() {
                self.peak_m = self.peak_m.max(y1);
                (j, y, rate) = (next, y1, rate1);
                level = (level + 1).min(STRIDE_LEVELS);
                continue;
            }
            if level > 0 {
                level -= 1;
                continue;
            }
            let at = At { interval: j, offset_s: 0.0, u: side * y, v: side * rate, force: side * weight };
            let motion = self.motion(&at, 0.0);
            let w1 = -at.force - self.ground_end(j).0;
            if let Some(passage) = self.uplifted_interval(&motion, dt, side, (side * y1, side * rate1), w1) {
                return self.impact(passage, side, &at);
            }
            (j, y, rate) = (next, y1, rate1);
        }
        Phase::RecordEnd(side, side * y, side * rate)
    }

    fn free_vibration(&mut self, side: f64, u: f64, v: f64) {
        if !self.sweep.with_free_peak {
            return;
        }
        let sweep = self.sweep;
        match first_peak(&sweep.attached, &sweep.uplifted, sweep.boundary_m, sweep.restitution, (side, u, v)) {
            FreePeak::Overturns => self.peak_m = f64::INFINITY,
            FreePeak::At { displacement_m, impacts, .. } => {
                self.impacts += impacts;
                self.peak_m = self.peak_m.max(displacement_m);
            }
        }
    }
}

/// `f64::max` without its care for NaN, which costs in the inner loops; a NaN in `a` gives `b`.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// `f64::min` likewise.
#[inline]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
