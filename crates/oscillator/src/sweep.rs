//! One oscillator under one record at many scales: the fast solver behind an incremental dynamic analysis.
//!
//! It solves the same piecewise-linear problem as the [reference](mod@crate::reference) without an approximation, and differs
//! from it by rounding alone. What makes it fast:
//!
//! * up to the first uplift the response is the elastic one times the scale, computed once;
//! * attached again, it differs from that by a free vibration, so blocks that cannot lift it are skipped, and the run ends
//!   when the rest of the record cannot either;
//! * a flight without post-uplift stiffness is followed in strides over the [integrals of the record](crate::ground_motion);
//! * events are found by Newton's method where convexity makes the root unique, by the nodes of the motion elsewhere.

use crate::branch::{Branch, LinearMotion};
use crate::elastic::ElasticResponse;
use crate::free_vibration::{FreePeak, cannot_return, first_peak};
use crate::ground_motion::{GroundMotion, STRIDE_LEVELS};
use crate::nodes::{Node, Nodes, crossing, monotone_root};
use crate::oscillator::Oscillator;
use crate::reference::OVERTURNED_CAPACITIES;
use crate::stumpff::Stumpff;

/// What an incremental dynamic analysis keeps of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Largest `abs(u)`, m: `+∞` if the system overturned.
    pub displacement_m: f64,
    /// Impacts up to the end of the run.
    pub impacts: u32,
}

/// One oscillator and one record, ready for any number of scales.
#[derive(Debug)]
pub struct Sweep<'a> {
    ground: &'a GroundMotion<'a>,
    elastic: ElasticResponse,
    attached: Branch,
    uplifted: Branch,
    boundary_m: f64,
    at_boundary_m_s2: f64,
    restitution: f64,
    capacity_m: f64,
    /// Angular frequency while attached, 1/s.
    omega: f64,
    with_free_peak: bool,
    dt_s: f64,
    whole_attached: Stumpff,
    whole_uplifted: Stumpff,
    /// Sag of a free vibration of amplitude one between samples, m/m.
    free_sag: f64,
    /// `(cos, sin)` of `ω` times a stride, for strides of `1, 2, 4 …` samples.
    rotations: [(f64, f64); STRIDE_LEVELS + 1],
}

impl<'a> Sweep<'a> {
    /// Prepare the runs of `oscillator` under `ground`.
    ///
    /// * `with_free_peak` — whether the first peak of the free vibration after the record counts
    pub fn new(oscillator: &Oscillator, ground: &'a GroundMotion<'a>, with_free_peak: bool) -> Self {
        let (attached, uplifted) = (oscillator.attached(), oscillator.uplifted());
        let dt_s = ground.excitation.dt_s();
        let omega = attached.stiffness_per_s2.sqrt();
        let mut rotations = [(1.0, 0.0); STRIDE_LEVELS + 1];
        for (level, rotation) in rotations.iter_mut().enumerate() {
            let (sin, cos) = (omega * dt_s * f64::from(1_u32 << level)).sin_cos();
            *rotation = (cos, sin);
        }
        Self {
            ground,
            elastic: ElasticResponse::new(&attached, ground, with_free_peak && !oscillator.is_free_mass()),
            attached,
            uplifted,
            boundary_m: oscillator.boundary_m(),
            at_boundary_m_s2: oscillator.uplift_acceleration_m_s2(),
            restitution: oscillator.restitution(),
            capacity_m: oscillator.capacity_m(),
            omega,
            free_sag: 0.125 * (omega * dt_s).powi(2),
            with_free_peak,
            dt_s,
            whole_attached: Stumpff::at(attached.stiffness_per_s2 * dt_s * dt_s),
            whole_uplifted: Stumpff::at(uplifted.stiffness_per_s2 * dt_s * dt_s),
            rotations,
        }
    }

    /// The peak under the record times `scale`, which multiplies the excitation's own.
    pub fn peak(&self, scale: f64) -> Peak {
        let scale = scale * self.ground.excitation.scale();
        let elastic_peak_m = scale.abs() * self.elastic.peak_m;
        let level_m = self.boundary_m / scale.abs();
        match self.elastic.first_interval_above(level_m) {
            Some(interval) if elastic_peak_m > self.boundary_m => self.run(scale, interval),
            _ => Peak { displacement_m: elastic_peak_m, impacts: 0 },
        }
    }

    fn run(&self, scale: f64, interval: usize) -> Peak {
        let u = scale * self.elastic.displacement_m[interval];
        let v = scale * self.elastic.velocity_m_s[interval];
        let mut run = Run { sweep: self, scale, peak_m: self.boundary_m, impacts: 0 };
        let mut phase =
            Phase::Attached(At { interval, offset_s: 0.0, u, v, force: self.attached.stiffness_per_s2 * u });
        loop {
            phase = match phase {
                Phase::Attached(at) => run.attached(at),
                Phase::Uplifted(side, at) if self.uplifted.stiffness_per_s2 == 0.0 => run.flight(side, at),
                Phase::Uplifted(side, at) => run.uplifted(side, at),
                Phase::Quiet => break,
                Phase::Overturned => {
                    run.peak_m = f64::INFINITY;
                    break;
                }
                Phase::RecordEnd(side, u, v) => {
                    run.free_vibration(side, u, v);
                    break;
                }
            }
        }
        Peak { displacement_m: run.peak_m, impacts: run.impacts }
    }
}

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

struct Run<'a> {
    sweep: &'a Sweep<'a>,
    scale: f64,
    peak_m: f64,
    impacts: u32,
}

impl Run<'_> {
    /// Acceleration at the start of an interval and its slope there, scaled.
    fn ground(&self, interval: usize) -> (f64, f64) {
        let a = self.sweep.ground.excitation.acceleration_m_s2();
        let (from, to) = (self.scale * a[interval], self.scale * a[interval + 1]);
        (from, (to - from) / self.sweep.dt_s)
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
        if let Some(tau) = transit(&motion, rest, boundary) {
            return self.uplift(&motion, tau, &start);
        }
        let (u, v) = self.end_of_interval(&motion, &start, &sweep.whole_attached);
        let end = State { u, v, w: -k * u - self.ground_end(start.interval).0 };
        if let Some(tau) = uplift_within(&motion, rest, &end, boundary) {
            return self.uplift(&motion, tau, &start);
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
        let free_sag = sweep.free_sag * amplitude;
        let mut level = 0;
        while j < n {
            while level > 0 && !(j.is_multiple_of(1 << level) && j >> level < elastic.bounds[level].len()) {
                level -= 1;
            }
            let (cos, sin) = sweep.rotations[level];
            let turned = (cos * free.0 + sin * free.1, cos * free.1 - sin * free.0);
            if magnitude * elastic.bounds[level][j >> level] <= room {
                // no phase of the free vibration lifts the system in this block
                free = turned;
                j += 1 << level;
                u = scale * elastic.displacement_m[j] + free.0;
                level = (level + 1).min(STRIDE_LEVELS);
                continue;
            }
            if level > 0 {
                level -= 1;
                continue;
            }
            let next_u = scale * elastic.displacement_m[j + 1] + turned.0;
            let sag = magnitude * elastic.sags[j] + free_sag;
            if u.abs().max(next_u.abs()) + sag > boundary {
                let v = scale * elastic.velocity_m_s[j] + sweep.omega * free.1;
                let at = At { interval: j, offset_s: 0.0, u, v, force: k * u };
                let motion = self.motion(&at, k);
                let end = State {
                    u: next_u,
                    v: scale * elastic.velocity_m_s[j + 1] + sweep.omega * turned.1,
                    w: -k * next_u - self.ground_end(j).0,
                };
                if let Some(tau) = uplift_within(&motion, sweep.dt_s, &end, boundary) {
                    return self.uplift(&motion, tau, &at);
                }
            }
            (j, u, free) = (j + 1, next_u, turned);
        }
        Phase::RecordEnd(0.0, u, scale * elastic.velocity_m_s[n] + sweep.omega * free.1)
    }

    fn ground_end(&self, interval: usize) -> (f64, f64) {
        let a = self.sweep.ground.excitation.acceleration_m_s2();
        (self.scale * a[interval + 1], self.scale * a[interval])
    }

    fn uplift(&mut self, motion: &LinearMotion, tau: f64, at: &At) -> Phase {
        let sweep = self.sweep;
        let (u, v) = motion.state(tau);
        let side = 1.0_f64.copysign(u);
        let v = side * (side * v).max(0.0);
        let displaced = At {
            interval: at.interval,
            offset_s: at.offset_s + tau,
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

    fn impact(&mut self, motion: &LinearMotion, tau: f64, side: f64, at: &At) -> Phase {
        let sweep = self.sweep;
        let v = motion.state(tau).1;
        self.impacts += 1;
        Phase::Attached(self.normalised(At {
            interval: at.interval,
            offset_s: at.offset_s + tau,
            u: side * sweep.boundary_m,
            v: sweep.restitution * side * (side * v).min(0.0),
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
            if let Some(tau) =
                self.uplifted_interval(&motion, rest, side, (u, v), -force - self.ground_end(at.interval).0)
            {
                return self.impact(&motion, tau, side, &at);
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
    ) -> Option<f64> {
        let boundary = self.sweep.boundary_m;
        let sag = 0.125 * rest * rest * motion.acceleration_bound(rest, w1);
        let (from, to) = (side * motion.u0, side * end.0);
        if from.min(to) - sag >= boundary && from.max(to) + sag <= self.peak_m {
            return None;
        }
        let concave = side * motion.w0 <= 0.0 && side * w1 <= 0.0 && motion.k <= 0.0;
        if concave {
            let (v0, v1) = (side * motion.v0, side * end.1);
            let mut top = to;
            if v0 > 0.0 && v1 < 0.0 {
                // the velocity falls all the way and is zero once
                top = side * motion.state(turning_time(motion, rest, end.1)).0;
            }
            if to >= boundary {
                self.peak_m = self.peak_m.max(top);
                return None;
            }
            if let Some(tau) = concave_descent(motion, rest, side, boundary, to) {
                self.peak_m = self.peak_m.max(top);
                return Some(tau);
            }
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
        if let Some(tau) = self.uplifted_interval(&motion, rest, side, end, w1) {
            return self.impact(&motion, tau, side, &start);
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
            let (lowest_w, highest_w) = (a.min(b) - weight, a.max(b) - weight);
            let eighth = 0.125 * stride_s * stride_s;
            let stays_up = y.min(y1) - eighth * highest_w.max(0.0) >= boundary;
            let no_new_peak = || {
                y.max(y1) - eighth * lowest_w.min(0.0) <= self.peak_m
                    || rate + stride_s * lowest_w.min(0.0) >= 0.0
                    || rate + stride_s * highest_w.max(0.0) <= 0.0
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
            if let Some(tau) = self.uplifted_interval(&motion, dt, side, (side * y1, side * rate1), w1) {
                return self.impact(&motion, tau, side, &at);
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
        debug_assert!(side == 0.0 || !cannot_return(&sweep.uplifted, (side, u, v)) || sweep.capacity_m.is_finite());
        match first_peak(&sweep.attached, &sweep.uplifted, sweep.boundary_m, sweep.restitution, (side, u, v)) {
            FreePeak::Overturns => self.peak_m = f64::INFINITY,
            FreePeak::At { displacement_m, impacts, .. } => {
                self.impacts += impacts;
                self.peak_m = self.peak_m.max(displacement_m);
            }
        }
    }
}

/// Displacement, velocity and acceleration.
#[derive(Debug, Clone, Copy)]
struct State {
    u: f64,
    v: f64,
    w: f64,
}

/// Time at which an attached system passes one of the boundaries, outward, within `h`; `end` is its state then.
fn uplift_within(motion: &LinearMotion, h: f64, end: &State, boundary: f64) -> Option<f64> {
    // ωh < π: the acceleration changes its sign once at most, not at all if its ends agree
    if motion.k * h * h < 9.0 && motion.w0 * end.w > 0.0 {
        if end.u.abs() > boundary {
            // a motion of one curvature passes the level that lies between its ends once
            let side = 1.0_f64.copysign(end.u);
            let dips = side * motion.w0 > 0.0 && side * motion.v0 < 0.0;
            if side * motion.u0 < boundary && (!dips || -tangents_meet(motion, h, end, side) <= boundary) {
                return Some(root_in_bracket(motion, h, side * boundary, end));
            }
        } else if motion.v0 * end.v >= 0.0 {
            return None; // monotone between ends that are attached
        } else if tangents_meet(motion, h, end, -1.0_f64.copysign(end.w)).abs() <= boundary {
            return None; // the turning point lies on the inner side of both tangents
        }
    }
    let sag = 0.125 * h * h * motion.acceleration_bound(h, end.w);
    if motion.u0.abs().max(end.u.abs()) + sag <= boundary {
        return None;
    }
    first_crossing(motion, h, |u| (u.abs() > boundary).then(|| boundary.copysign(u)))
}

/// Height `side u` at which the tangents at both ends of a motion meet: beyond its turning point if it has one curvature.
fn tangents_meet(motion: &LinearMotion, h: f64, end: &State, side: f64) -> f64 {
    let (v0, v1) = (side * motion.v0, side * end.v);
    side * motion.u0 + v0 * (side * (end.u - motion.u0) - v1 * h) / (v0 - v1)
}

/// The time at which `motion` passes `level`, which it does once between its start and its `end` at `h`: Newton's method from the root of
/// the parabola through the initial state and the end, inside the bracket.
fn root_in_bracket(motion: &LinearMotion, h: f64, level: f64, end: &State) -> f64 {
    let distance = level - motion.u0;
    let (mut low, mut high) = (0.0, h);
    let ahead = 1.0_f64.copysign(end.u - motion.u0);
    let curvature = 2.0 * (end.u - motion.u0 - motion.v0 * h) / (h * h);
    let discriminant = motion.v0 * motion.v0 + 2.0 * curvature * distance;
    let mut tau = 2.0 * distance / (motion.v0 + ahead * discriminant.max(0.0).sqrt());
    for _ in 0..NEWTON_STEPS {
        if !(tau > low && tau < high) {
            tau = 0.5 * (low + high);
        }
        let (u, v) = motion.state(tau);
        let beyond = ahead * (u - level) > 0.0;
        if beyond {
            high = tau
        } else {
            low = tau
        }
        let step = (u - level) / v;
        let next = tau - step;
        if step.abs() <= CONVERGED * h && next >= 0.0 && next <= h {
            return next;
        }
        tau = next;
    }
    crossing(motion, Node { tau: 0.0, u: motion.u0 }, Node { tau: h, u: end.u }, level)
}

/// Stumpff functions of a branch without stiffness.
const PARABOLIC: Stumpff = Stumpff { c0: 1.0, c1: 1.0, c2: 0.5, c3: 1.0 / 6.0 };

/// Time of the first crossing of a level that `level_beyond` names for the displacement at a node, over the monotone pieces of `motion`.
fn first_crossing(motion: &LinearMotion, h: f64, mut level_beyond: impl FnMut(f64) -> Option<f64>) -> Option<f64> {
    let mut from = Node { tau: 0.0, u: motion.u0 };
    for to in Nodes::new(motion, h) {
        if let Some(level) = level_beyond(to.u) {
            return Some(crossing(motion, from, to, level));
        }
        from = to;
    }
    None
}

/// Time at which the velocity of a motion vanishes, which changes its sign once between the start and `v1` at `h`.
fn turning_time(motion: &LinearMotion, h: f64, v1: f64) -> f64 {
    if motion.k == 0.0 {
        let discriminant = (motion.w0 * motion.w0 - 2.0 * motion.j0 * motion.v0).max(0.0);
        let tau = 2.0 * motion.v0 / (-motion.w0 + discriminant.sqrt().copysign(motion.v0));
        return tau.clamp(0.0, h);
    }
    monotone_root((0.0, motion.v0), (h, v1), |tau| motion.rates(tau))
}

/// Newton steps before the safe search takes over.
const NEWTON_STEPS: usize = 12;

/// A Newton step below this part of the interval leaves an error of its square.
const CONVERGED: f64 = 1e-9;

/// The impact of an uplifted system with `side ü ≤ 0` all the way that is below the boundary at `h`: Newton's method on a
/// concave function, from the root of the parabola through the initial state and the end.
///
/// * `end` — `side u` at `h`
fn concave_descent(motion: &LinearMotion, h: f64, side: f64, boundary: f64, end: f64) -> Option<f64> {
    let (height, v0) = (side * motion.u0 - boundary, side * motion.v0);
    let curvature = 2.0 * (end - side * motion.u0 - v0 * h) / (h * h);
    let mut tau = 2.0 * height / ((v0 * v0 - 2.0 * curvature * height).max(0.0).sqrt() - v0);
    if !(tau > 0.0 && tau <= h) {
        tau = h;
    }
    for _ in 0..NEWTON_STEPS {
        let (u, v) = motion.state(tau);
        let step = (side * u - boundary) / (side * v);
        let next = tau - step;
        if !(side * v < 0.0 && next >= 0.0 && next <= h) {
            return None;
        }
        if step.abs() <= CONVERGED * h {
            return Some(next);
        }
        tau = next;
    }
    None
}

/// The passage of an attached system from one boundary straight to the other within `h`: `None` if it is not as simple as that.
fn transit(motion: &LinearMotion, h: f64, boundary: f64) -> Option<f64> {
    if motion.u0.abs() != boundary {
        return None;
    }
    let side = motion.u0.signum();
    let speed = -side * motion.v0;
    let mut tau = 2.0 * boundary / speed;
    if !(speed > 0.0 && tau <= h) {
        return None;
    }
    for _ in 0..NEWTON_STEPS {
        let (u, v) = motion.state(tau);
        let step = (side * u + boundary) / (side * v);
        let next = tau - step;
        if !(next > 0.0 && next <= h) {
            return None;
        }
        if step.abs() <= CONVERGED * h {
            // monotone on the way: the velocity is inward at both ends and has no maximum between them
            let w = motion.rates(next).1;
            let inward = side * v < 0.0 && !(side * motion.w0 > 0.0 && side * w < 0.0);
            return (inward && motion.k * h * h < 9.0).then_some(next);
        }
        tau = next;
    }
    None
}
