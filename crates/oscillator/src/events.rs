//! The events of several runs found side by side: the same reasoning as in [`crossings`](crate::crossings), without
//! conditional branches, so that the compiler turns it into vector instructions.
//!
//! Only simple cases are solved here. The rest is left to the [crossings](crate::crossings), run by run.

// a lazy operator is a branch, and a loop over branches is not made into vectors
#![allow(clippy::needless_bitwise_bool, clippy::needless_range_loop)]

use crate::ahead::{larger, smaller};
use crate::branch::LinearMotion;
use crate::crossings::{CONVERGED, Crossing, State};
use crate::stumpff::{NEAR, NEAR_TERMS, Stumpff};

/// Newton steps after the first guess and the inverse series about it.
const STEPS: usize = 2;

/// One number a run.
pub(crate) type PerRun<const RUNS: usize> = [f64; RUNS];

/// What the attached segments of all runs have in common.
#[derive(Debug)]
pub(crate) struct Attached {
    /// Stiffness, 1/s²; positive.
    pub(crate) k: f64,
    /// How far the acceleration between samples may exceed its ends; see [`growth`](crate::sweep::growth).
    pub(crate) growth: f64,
    /// Terms of the series that suffice for a whole sample interval.
    pub(crate) terms: usize,
    /// Displacement of the boundaries, m.
    pub(crate) boundary: f64,
}

/// A segment of each run: the motion from its start on, and the state at its end.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct Segments<const RUNS: usize> {
    pub(crate) u0: PerRun<RUNS>,
    pub(crate) v0: PerRun<RUNS>,
    pub(crate) w0: PerRun<RUNS>,
    pub(crate) j0: PerRun<RUNS>,
    /// Duration, s.
    pub(crate) h: PerRun<RUNS>,
    pub(crate) u1: PerRun<RUNS>,
    pub(crate) v1: PerRun<RUNS>,
    pub(crate) w1: PerRun<RUNS>,
}

/// What was found in the segment of each run.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct Events<const RUNS: usize> {
    /// The level crossed, m.
    level: PerRun<RUNS>,
    /// Time since the start of the segment, s: NaN where it is not found.
    tau: PerRun<RUNS>,
    /// Velocity then, m/s.
    v: PerRun<RUNS>,
}

impl<const RUNS: usize> Events<RUNS> {
    /// The crossing of a run, if it was found.
    #[inline(always)]
    pub(crate) fn crossing(&self, run: usize) -> Option<Crossing> {
        let (level, tau, v) = (self.level[run], self.tau[run], self.v[run]);
        (!tau.is_nan()).then_some(Crossing { level, tau, v })
    }
}

impl<const RUNS: usize> Segments<RUNS> {
    pub(crate) const EMPTY: Self = {
        let none = [0.0; RUNS];
        Self { u0: none, v0: none, w0: none, j0: none, h: none, u1: none, v1: none, w1: none }
    };

    #[inline(always)]
    pub(crate) fn put(&mut self, run: usize, motion: &LinearMotion, h: f64) {
        (self.u0[run], self.v0[run], self.w0[run], self.j0[run]) = (motion.u0, motion.v0, motion.w0, motion.j0);
        self.h[run] = h;
    }

    #[inline(always)]
    pub(crate) fn put_end(&mut self, run: usize, end: &State) {
        (self.u1[run], self.v1[run], self.w1[run]) = (end.u, end.v, end.w);
    }

    #[inline(always)]
    pub(crate) fn end(&self, run: usize) -> State {
        State { u: self.u1[run], v: self.v1[run], w: self.w1[run] }
    }

    /// The motion of a run on a branch of stiffness `k`.
    #[inline(always)]
    pub(crate) fn motion(&self, run: usize, k: f64) -> LinearMotion {
        LinearMotion { u0: self.u0[run], v0: self.v0[run], w0: self.w0[run], j0: self.j0[run], k }
    }

    /// The states at the ends of attached segments.
    #[inline(always)]
    pub(crate) fn advance(&mut self, Attached { k, terms, .. }: &Attached) {
        let series = stumpff(&self.h.map(|h| k * h * h), *terms);
        for run in 0..RUNS {
            let (h, w0, j0) = (self.h[run], self.w0[run], self.j0[run]);
            let (c1, c2, c3) = (series.c1[run], series.c2[run], series.c3[run]);
            self.u1[run] = self.u0[run] + h * (self.v0[run] + h * (w0 * c2 + h * j0 * c3));
            self.v1[run] = self.v0[run] + h * (w0 * c1 + h * j0 * c2);
            self.w1[run] = w0 * series.c0[run] + h * j0 * c1;
        }
    }

    /// Whether attached systems are shown to stay inside the boundaries; see
    /// [`stays_inside`](crate::crossings::stays_inside).
    #[inline(always)]
    pub(crate) fn stay_inside(&self, attached: &Attached) -> [bool; RUNS] {
        let &Attached { k, growth, boundary, .. } = attached;
        let mut stays = [false; RUNS];
        let flexibility = 1.0 / k;
        for run in 0..RUNS {
            let (u0, v0, w0, j0) = (self.u0[run], self.v0[run], self.w0[run], self.j0[run]);
            let (h, u1, v1, w1) = (self.h[run], self.u1[run], self.v1[run], self.w1[run]);
            let motion = Direction::new((v0, w0, j0), (v1, w1), h, k, growth);
            let turn = Turn::new((u0, v0, w0, j0), (v1, w1), h, flexibility, motion.departure);
            let turns_inside = turn.highest <= boundary;
            stays[run] = (u1.abs() <= boundary) & (motion.monotone | turns_inside);
        }
        stays
    }

    /// Where attached systems cross one of the boundaries, outward.
    #[inline(always)]
    pub(crate) fn uplifts(&self, attached: &Attached) -> Events<RUNS> {
        let &Attached { k, growth, terms, boundary } = attached;
        let mut found = Events { level: [0.0; RUNS], tau: [0.0; RUNS], v: [0.0; RUNS] };
        let flexibility = 1.0 / k;
        for run in 0..RUNS {
            let (u0, v0, w0, j0) = (self.u0[run], self.v0[run], self.w0[run], self.j0[run]);
            let (h, u1, v1, w1) = (self.h[run], self.u1[run], self.v1[run], self.w1[run]);
            let motion = Direction::new((v0, w0, j0), (v1, w1), h, k, growth);
            let turn = Turn::new((u0, v0, w0, j0), (v1, w1), h, flexibility, motion.departure);
            let outside = u1.abs() > boundary;
            // one way: the parabola through the state at the start and the end
            let distance = boundary.copysign(v0) - u0;
            let chord = (u1 - u0 - v0 * h) * (2.0 / (h * h));
            let discriminant = v0 * v0 + 2.0 * chord * distance;
            // turning: the parabola about the turn, and the way out before it, or on the other side after it
            let leaves = turn.top > boundary;
            let fall = if leaves { turn.top - boundary } else { turn.top + boundary };
            let turning = v0 * v1 < 0.0;
            let root = larger(if turning { 2.0 * fall / (k * turn.distance) } else { discriminant }, 0.0).sqrt();
            let around = turn.time + if leaves { -root } else { root };
            let tau = if turning { around } else { 2.0 * distance / (v0 + root.copysign(v0)) };
            let back = outside & (turn.highest <= boundary);
            let reached = (motion.monotone & outside & (discriminant >= 0.0)) | (turning & (leaves | back));
            let simple = reached & (tau > 0.0) & (tau < h);
            let level = if turning & !leaves { -boundary.copysign(v0) } else { boundary.copysign(v0) };
            found.tau[run] = if simple { tau } else { f64::NAN };
            found.level[run] = level;
        }
        let series = stumpff(&found.tau.map(|tau| k * tau * tau), terms);
        for run in 0..RUNS {
            let (u0, v0, w0, j0, h) = (self.u0[run], self.v0[run], self.w0[run], self.j0[run], self.h[run]);
            let (c0, c1, c2, c3) = (series.c0[run], series.c1[run], series.c2[run], series.c3[run]);
            // the same motion with the guess as its start
            let (tau, level) = (found.tau[run], found.level[run]);
            let u = u0 + tau * (v0 + tau * (w0 * c2 + tau * j0 * c3));
            let v = v0 + tau * (w0 * c1 + tau * j0 * c2);
            let w = w0 * c0 + tau * j0 * c1;
            let j = j0 * c0 - k * tau * w0 * c1;
            let here = LinearMotion { u0: u, v0: v, w0: w, j0: j, k };
            let mut further = here.time_to(level);
            let (mut step, mut speed) = (0.0, 0.0);
            let mut near = true;
            for _ in 0..STEPS {
                let x = k * further * further;
                near &= x <= NEAR;
                let short = Stumpff::series::<NEAR_TERMS>(x);
                let (u, v) = here.state_with(further, &short);
                step = (u - level) / v;
                further -= step;
                speed = v - step * (w * short.c0 + further * j * short.c1);
            }
            let time = tau + further;
            let settled = near & (step.abs() <= CONVERGED * h) & (time >= 0.0) & (time <= h);
            found.tau[run] = if settled & (speed * level > 0.0) { time } else { f64::NAN };
            found.v[run] = speed;
        }
        found
    }

    /// Where uplifted systems without stiffness that are below the boundary at the end of their segments come down to
    /// it, in the coordinates of their sides, and the highest points of the way there.
    #[inline(always)]
    pub(crate) fn impacts(&self, boundary: f64) -> (Events<RUNS>, PerRun<RUNS>) {
        let mut found = Events { level: [boundary; RUNS], tau: [0.0; RUNS], v: [0.0; RUNS] };
        let mut tops = [0.0; RUNS];
        for run in 0..RUNS {
            let (y0, v0, w0, j0) = (self.u0[run], self.v0[run], self.w0[run], self.j0[run]);
            let (h, y1, v1, w1) = (self.h[run], self.u1[run], self.v1[run], self.w1[run]);
            // falls freely: turns back once at most
            let falls = (w0 <= 0.0) & (w1 <= 0.0);
            let turn = 2.0 * v0 / (larger(w0 * w0 - 2.0 * j0 * v0, 0.0).sqrt() - w0);
            let top = y0 + turn * (v0 + turn * (0.5 * w0 + turn * j0 * (1.0 / 6.0)));
            tops[run] = if (v0 > 0.0) & (v1 < 0.0) { top } else { y0 };
            // the root of the parabola through the state at the start and the end, in the form that does not cancel
            let distance = boundary - y0;
            let curvature = (y1 - y0 - v0 * h) * (2.0 / (h * h));
            let root = larger(v0 * v0 + 2.0 * curvature * distance, 0.0).sqrt();
            let rising = v0 > 0.0;
            let over = if rising { -(v0 + root) } else { 2.0 * distance };
            let tau = over / if rising { curvature } else { v0 - root };
            // as for uplifts; the motion is a cubic here
            let u = tau * (v0 + tau * (0.5 * w0 + tau * (j0 * (1.0 / 6.0)))) - distance;
            let v = v0 + tau * (w0 + tau * (0.5 * j0));
            let here = LinearMotion { u0: u, v0: v, w0: w0 + tau * j0, j0, k: 0.0 };
            let mut tau = tau + here.time_to(0.0);
            let (mut step, mut speed) = (0.0, 0.0);
            for _ in 0..STEPS {
                let v = v0 + tau * (w0 + tau * (0.5 * j0));
                step = (tau * (v0 + tau * (0.5 * w0 + tau * (j0 * (1.0 / 6.0)))) - distance) / v;
                tau -= step;
                speed = v - step * (w0 + tau * j0);
            }
            let settled = falls & (step.abs() <= CONVERGED * h) & (tau >= 0.0) & (tau <= h);
            found.tau[run] = if settled & (speed < 0.0) { tau } else { f64::NAN };
            found.v[run] = speed;
        }
        (found, tops)
    }
}

/// What the states at both ends show of the velocity of an attached motion; see [`crossings`](crate::crossings).
struct Direction {
    /// The velocity has the same sign at both ends and is shown to keep it between them.
    monotone: bool,
    /// A bound on its departure from its chord, m/s.
    departure: f64,
}

impl Direction {
    #[inline(always)]
    fn new((v0, w0, j0): (f64, f64, f64), (v1, w1): (f64, f64), h: f64, k: f64, growth: f64) -> Self {
        let departure = 0.125 * h * h * larger(j0.abs(), (j0 + k * (v0 - v1)).abs()) * growth;
        let acceleration = larger(w0.abs(), w1.abs()) * growth;
        let (slow, fast) = (smaller(v0.abs(), v1.abs()), larger(v0.abs(), v1.abs()));
        let kept =
            (w0 * w1 > 0.0) | (slow + fast > h * acceleration) | (slow > larger(departure - 0.25 * (fast - slow), 0.0));
        Self { monotone: (v0 * v1 > 0.0) & kept, departure }
    }
}

/// Where an attached motion turns, in the coordinates of the side to which it starts; see
/// [`crossings`](crate::crossings).
struct Turn {
    /// Distance from the equilibrium, m.
    distance: f64,
    /// A bound on the displacement, m.
    highest: f64,
    /// Time, s, and displacement, m, if the velocity changes its sign: nearly.
    time: f64,
    top: f64,
}

impl Turn {
    #[inline(always)]
    fn new(
        (u0, v0, w0, j0): (f64, f64, f64, f64),
        (v1, w1): (f64, f64),
        h: f64,
        flexibility: f64,
        departure: f64,
    ) -> Self {
        let side = 1.0_f64.copysign(v0);
        let (equilibrium, lag) = (w0 * flexibility, j0 * flexibility);
        let start = u0 + equilibrium;
        let drift = v0 + lag;
        let distance = larger(equilibrium * equilibrium + (lag * lag - drift * drift) * flexibility, 0.0).sqrt();
        // the zero of the chord of the velocity, then a step towards that of the cubic with the
        // accelerations at both ends
        let part = v0 / (v0 - v1);
        let rest = 1.0 - part;
        let v = (v0 * rest * (1.0 + 2.0 * part) + h * w0 * rest * part) * rest
            + (v1 * part * (3.0 - 2.0 * part) - h * w1 * rest * part) * part;
        let time = h * part - v / (w0 * rest + w1 * part);
        let keeps = (w0 * w1 > 0.0) & (v0 * v1 < 0.0);
        let apart = smaller(departure / smaller(w0.abs(), w1.abs()), h);
        let known = side * (start + drift * (h * part)) + drift.abs() * apart;
        let unknown = (start + drift * (0.5 * h)).abs() + drift.abs() * (0.5 * h);
        let highest = if keeps { known } else { unknown } + distance;
        Self { distance, highest, time, top: side * (start + drift * time) + distance }
    }
}

/// Stumpff functions, one argument of each run.
#[repr(align(64))]
struct Functions<const RUNS: usize> {
    c0: PerRun<RUNS>,
    c1: PerRun<RUNS>,
    c2: PerRun<RUNS>,
    c3: PerRun<RUNS>,
}

/// The functions by `terms` of their series, an even number; see [`Stumpff`].
#[inline(always)]
fn stumpff<const RUNS: usize>(x: &PerRun<RUNS>, terms: usize) -> Functions<RUNS> {
    let square = x.map(|x| x * x);
    let (mut c2, mut c3) = ([0.0; RUNS], [0.0; RUNS]);
    for pair in Stumpff::TABLE[..terms].chunks_exact(2).rev() {
        for run in 0..RUNS {
            c2[run] = (pair[0].0 - x[run] * pair[1].0) + square[run] * c2[run];
            c3[run] = (pair[0].1 - x[run] * pair[1].1) + square[run] * c3[run];
        }
    }
    let (mut c0, mut c1) = ([0.0; RUNS], [0.0; RUNS]);
    for run in 0..RUNS {
        c0[run] = 1.0 - x[run] * c2[run];
        c1[run] = 1.0 - x[run] * c3[run];
    }
    Functions { c0, c1, c2, c3 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crossings::first_crossing;
    use crate::nodes::{Node, Nodes, crossing_time};
    use crate::sweep::growth;
    use proptest::prelude::*;

    const BOUNDARY: f64 = 1.0;

    fn one(motion: &LinearMotion, h: f64) -> Segments<1> {
        let mut segment = Segments::EMPTY;
        segment.put(0, motion, h);
        let (u, v) = motion.state(h);
        segment.put_end(0, &State { u, v, w: motion.rates(h).1 });
        segment
    }

    fn uplift(phase: f64, h: f64, segment: &Segments<1>) -> (bool, Option<Crossing>) {
        // the segment may be a part of an interval
        let whole = 1.2 * phase;
        let terms = Stumpff::terms(whole * whole).unwrap_or_default();
        let attached = Attached { k: (phase / h) * (phase / h), growth: growth(whole), terms, boundary: BOUNDARY };
        (segment.stay_inside(&attached)[0], segment.uplifts(&attached).crossing(0))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        // Against the safe search over the nodes of the motion.
        #[test]
        fn uplifts_are_the_first_crossings(
            phase in 0.001_f64..2.4, u0 in prop_oneof![-1.0_f64..1.0, Just(1.0), Just(-1.0)], v0 in -2.0_f64..2.0,
            w0 in -3.0_f64..3.0, j0 in -3.0_f64..3.0,
        ) {
            let h = 0.7;
            let k = (phase / h) * (phase / h);
            // at the boundary a system moves inward
            let v0 = if u0.abs() == BOUNDARY { -u0 * v0.abs() } else { v0 };
            let motion = LinearMotion { u0, v0: 3.0 * v0, w0: 3.0 * w0, j0: 5.0 * j0, k };
            let segment = one(&motion, h);
            let (stays_inside, crossing) = uplift(phase, h, &segment);
            let beyond = |u: f64| (u.abs() > BOUNDARY).then(|| BOUNDARY.copysign(u));
            let first = first_crossing(&motion, h, beyond);
            if stays_inside {
                let highest = Nodes::new(&motion, h).map(|node| node.u.abs()).fold(0.0, f64::max);
                prop_assert!(highest <= BOUNDARY + 1e-14, "{highest}");
            } else if let Some(crossing) = crossing {
                // a way out and back that rounding decides may be found by one of them only
                let Some(first) = first else { prop_assert!(crossing.v.abs() < 1e-6); return Ok(()) };
                prop_assert_eq!(crossing.level, first.level);
                let allowed = 1e-9 * (1.0 + 1.0 / first.v.abs());
                prop_assert!((crossing.v - first.v).abs() < allowed, "{crossing:?} {first:?}");
                prop_assert!((crossing.tau - first.tau).abs() * first.v.abs() < 1e-13, "{crossing:?} {first:?}");
            }
        }

        #[test]
        fn impacts_are_the_first_crossings(
            above in prop_oneof![Just(0.0), 0.0_f64..0.5], below in 0.0_f64..0.5, w0 in -5.0_f64..1.0,
            j0 in -5.0_f64..5.0,
        ) {
            let h = 0.7;
            let above = if above == 0.0 && (below / h + h * (0.5 * w0 + h * j0 / 6.0)) > 0.0 { below } else { above };
            let v0 = -(above + below) / h - h * (0.5 * w0 + h * j0 / 6.0);
            let motion = LinearMotion { u0: BOUNDARY + above, v0, w0, j0, k: 0.0 };
            let segment = one(&motion, h);
            let (found, tops) = segment.impacts(BOUNDARY);
            if let Some(crossing) = found.crossing(0) {
                let highest = Nodes::new(&motion, crossing.tau).map(|node| node.u).fold(motion.u0, f64::max);
                prop_assert!((tops[0] - highest).abs() < 1e-14, "{} {highest}", tops[0]);
                let from = Nodes::new(&motion, h).take_while(|node| node.u >= BOUNDARY).last();
                let from = from.unwrap_or(Node { tau: 0.0, u: motion.u0 });
                let to = Node { tau: h, u: segment.u1[0] };
                let tau = crossing_time(&motion, from, to, BOUNDARY);
                prop_assert!((crossing.tau - tau).abs() * crossing.v.abs() < 1e-13, "{crossing:?} {tau}");
                prop_assert!((crossing.v - motion.state(tau).1).abs() < 1e-9 * (1.0 + 1.0 / crossing.v.abs()));
            }
        }
    }

    // The tests of what is found would pass if nothing were ever found.
    #[test]
    fn most_events_are_found() {
        let (mut uplifts, mut impacts) = (0, 0);
        for i in 0..1000 {
            let part = |step: f64| (f64::from(i) * step).fract();
            let (v0, ground, slope) = (2.0 * part(0.618), part(0.377) - 0.5, part(0.911) - 0.5);
            let rebound = LinearMotion { u0: -1.0, v0, w0: 1.0 + ground, j0: -v0 + slope, k: 1.0 };
            let (stays_inside, crossing) = uplift(1.0, 1.0, &one(&rebound, 1.0));
            uplifts += u32::from(stays_inside || crossing.is_some());
            let uplifted = LinearMotion { u0: 1.0, v0: 0.4 * v0, w0: -2.0 + ground, j0: slope, k: 0.0 };
            impacts += u32::from(one(&uplifted, 1.0).impacts(BOUNDARY).0.crossing(0).is_some());
        }
        assert!(uplifts > 900 && impacts > 900, "{uplifts} {impacts}");
    }
}
