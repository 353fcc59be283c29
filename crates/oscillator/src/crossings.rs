//! Where a motion crosses a level inside one sample interval, without a general search.
//!
//! While `ωh < π` the acceleration changes its sign once at most. From the states at both ends it then follows where
//! the displacement turns and whether it can cross a level, and Newton's method finds the crossing. Whatever is not as
//! simple goes to the [nodes](crate::nodes).

use crate::ahead::smaller;
use crate::branch::LinearMotion;
use crate::nodes::{Node, Nodes, crossing_time, monotone_root};
use crate::stumpff::Stumpff;

/// Largest `(ωh)²` for the reasoning of this file: a little below π².
pub(crate) const SIMPLE: f64 = 9.0;
/// Newton steps before the safe search takes over.
const NEWTON_STEPS: usize = 12;
/// A Newton step below this part of the interval leaves an error of its square.
pub(crate) const CONVERGED: f64 = 1e-8;
/// Newton steps on the short series before a new start is made.
const NEARBY_STEPS: usize = 5;

/// Displacement, velocity and acceleration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub(crate) u: f64,
    pub(crate) v: f64,
    pub(crate) w: f64,
}

impl State {
    /// In the coordinates of this side.
    #[inline(always)]
    pub(crate) fn on(&self, side: f64) -> Self {
        Self { u: side * self.u, v: side * self.v, w: side * self.w }
    }
}

/// Whether an attached system is shown to stay inside the boundaries within `h`; `end` is its state then.
#[inline(always)]
pub(crate) fn stays_inside(motion: &LinearMotion, h: f64, end: &State, boundary: f64) -> bool {
    end.u.abs() <= boundary && (is_monotone(motion, h, end) || turns_inside(motion, h, end, boundary))
}

/// Where an attached system crosses one of the boundaries, outward, within `h`; `end` is its state then.
#[inline(always)]
pub(crate) fn uplift_within(motion: &LinearMotion, h: f64, end: &State, boundary: f64) -> Option<Crossing> {
    if stays_inside(motion, h, end, boundary) {
        return None;
    }
    let inside = end.u.abs() <= boundary;
    let (from, to) = (Node { tau: 0.0, u: motion.u0 }, Node { tau: h, u: end.u });
    if is_monotone(motion, h, end) {
        return Some(crossing(motion, from, motion.v0, to, boundary.copysign(end.u)));
    }
    if motion.k * h * h < SIMPLE && motion.v0 * end.v < 0.0 {
        // one turning point
        if let Some(crossing) = outward_crossing(motion, h, boundary.copysign(motion.v0)) {
            return Some(crossing);
        }
        let tau = turning_time(motion, h, end.v);
        let turn = Node { tau, u: motion.state(tau).0 };
        if turn.u.abs() > boundary {
            return Some(crossing(motion, from, motion.v0, turn, boundary.copysign(turn.u)));
        }
        return (!inside).then(|| crossing(motion, turn, 0.0, to, boundary.copysign(end.u)));
    }
    first_crossing(motion, h, |u| (u.abs() > boundary).then(|| boundary.copysign(u)))
}

/// Whether an attached motion is shown to keep its direction for `h`: its velocity then has one extremum at most, and
/// no zero if it has no extremum or cannot fall that far.
#[inline(always)]
fn is_monotone(motion: &LinearMotion, h: f64, end: &State) -> bool {
    motion.v0 * end.v > 0.0
        && motion.k * h * h < SIMPLE
        && (motion.w0 * end.w > 0.0
            || motion.v0.abs() + end.v.abs() > h * motion.acceleration_bound(h, end.w)
            || motion.keeps_direction(h, end.v))
}

/// True if no turning point of a motion with `k > 0` within `h` lies beyond the boundaries.
///
/// The motion oscillates about the equilibrium `e = u + w/k`, which drifts at the constant rate `ė`, with the amplitude
/// `A`. Where its velocity is zero the distance from the equilibrium is `√(A² − ė²/k)`. If it turns once and the
/// acceleration keeps its sign, that is on the side to which the motion starts, and as near to the zero of the chord of
/// the velocity as follows from the departure from the chord and the least acceleration.
#[inline(always)]
fn turns_inside(motion: &LinearMotion, h: f64, end: &State, boundary: f64) -> bool {
    let flexibility = 1.0 / motion.k;
    let (x, lag) = (motion.w0 * flexibility, motion.j0 * flexibility);
    let start = motion.u0 + x;
    let drift = motion.v0 + lag;
    let distance = (x * x + (lag * lag - drift * drift) * flexibility).max(0.0).sqrt();
    if motion.w0 * end.w > 0.0 && motion.v0 * end.v < 0.0 && motion.k * h * h < SIMPLE {
        let apart = motion.departure_of_velocity(h, end.v) / smaller(motion.w0.abs(), end.w.abs());
        let middle = start + drift * (h * (motion.v0 / (motion.v0 - end.v)));
        return middle * 1.0_f64.copysign(motion.v0) + drift.abs() * smaller(apart, h) + distance <= boundary;
    }
    (start + drift * (0.5 * h)).abs() + drift.abs() * (0.5 * h) + distance <= boundary
}

/// A level crossed: when, and how fast.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    /// The level, m.
    pub(crate) level: f64,
    /// Time since the start of the motion, s.
    pub(crate) tau: f64,
    /// Velocity, m/s.
    pub(crate) v: f64,
}

impl Crossing {
    /// In the coordinates of this side.
    #[inline(always)]
    pub(crate) fn on(&self, side: f64) -> Self {
        Self { level: side * self.level, tau: self.tau, v: side * self.v }
    }

    #[inline(always)]
    fn from_motion(motion: &LinearMotion, tau: f64, level: f64) -> Self {
        Self { level, tau, v: motion.state(tau).1 }
    }
}

/// Where `motion` crosses `level`, which it does once between `from`, where its velocity is `v`, and `to`: Newton's
/// method in a bracket, from the root of the parabola through the state at `from` and the end.
#[inline(always)]
pub(crate) fn crossing(motion: &LinearMotion, from: Node, v: f64, to: Node, level: f64) -> Crossing {
    let span = to.tau - from.tau;
    let distance = level - from.u;
    let ahead = 1.0_f64.copysign(to.u - level);
    if ahead * distance <= 0.0 && v * ahead > 0.0 {
        // there already, by rounding
        return Crossing { level, tau: from.tau, v };
    }
    let curvature = (to.u - from.u - v * span) * (2.0 / (span * span));
    let discriminant = (v * v + 2.0 * curvature * distance).max(0.0);
    let (mut low, mut high) = (from.tau, to.tau);
    let mut tau = from.tau + 2.0 * distance / (v + ahead * discriminant.sqrt());
    if motion.k == 0.0
        && let Some(found) = cubic_crossing(motion, tau, level, CONVERGED * span)
        && found.tau >= low
        && found.tau <= high
        && found.v * ahead > 0.0
    {
        return found;
    }
    for _ in 0..NEWTON_STEPS {
        // written so that NaN is left
        if !(tau > low && tau < high) {
            tau = 0.5 * (low + high);
        }
        let here = motion.restarted(tau);
        if let Some((further, v)) = nearby_crossing(&here, level, CONVERGED * span) {
            let found = tau + further;
            if found >= low && found <= high && v * ahead > 0.0 {
                return Crossing { level, tau: found, v };
            }
        }
        if ahead * (here.u0 - level) > 0.0 {
            high = tau;
        } else {
            low = tau;
        }
        tau -= (here.u0 - level) / here.v0;
    }
    let from = Node { tau: low, u: motion.state(low).0 };
    let to = Node { tau: high, u: motion.state(high).0 };
    Crossing::from_motion(motion, crossing_time(motion, from, to, level), level)
}

/// Newton's method from `tau` on for a motion without stiffness, which is a cubic; `None` where it does not converge.
#[inline(always)]
fn cubic_crossing(motion: &LinearMotion, mut tau: f64, level: f64, converged: f64) -> Option<Crossing> {
    let (half, third) = (0.5 * motion.w0, motion.j0 * (1.0 / 6.0));
    let distance = level - motion.u0;
    for _ in 0..NEARBY_STEPS {
        let v = motion.v0 + tau * (motion.w0 + tau * (0.5 * motion.j0));
        let step = (tau * (motion.v0 + tau * (half + tau * third)) - distance) / v;
        tau -= step;
        if step.abs() <= converged {
            return Some(Crossing { level, tau, v: v - step * (motion.w0 + tau * motion.j0) });
        }
    }
    None
}

/// The crossing of `level` outward within `h` of a motion that turns back once, by Newton's method from the parabola at
/// its start: a root with an outward velocity is the one sought, since the way back is inward. `None` where there is no
/// such root, or the method does not converge.
#[inline(always)]
fn outward_crossing(motion: &LinearMotion, h: f64, level: f64) -> Option<Crossing> {
    let distance = level - motion.u0;
    let discriminant = motion.v0 * motion.v0 + 2.0 * motion.w0 * distance;
    if !(discriminant > 0.0) {
        return None;
    }
    let tau = 2.0 * distance / (motion.v0 + discriminant.sqrt().copysign(motion.v0));
    if !(tau > 0.0 && tau < h) {
        return None;
    }
    let (further, v) = nearby_crossing(&motion.restarted(tau), level, CONVERGED * h)?;
    let found = tau + further;
    (found >= 0.0 && found <= h && v * level > 0.0).then_some(Crossing { level, tau: found, v })
}

/// Time until `here` crosses `level` and its velocity there, if that is so near that short series suffice: one
/// evaluation of the full ones then finds a crossing.
#[inline(always)]
fn nearby_crossing(here: &LinearMotion, level: f64, converged: f64) -> Option<(f64, f64)> {
    let mut tau = here.time_to(level);
    for _ in 0..NEARBY_STEPS {
        let short = Stumpff::near_zero(here.k * tau * tau)?;
        let (u, v) = here.state_with(tau, &short);
        let step = (u - level) / v;
        tau -= step;
        if step.abs() <= converged {
            let w = here.w0 * short.c0 + tau * here.j0 * short.c1;
            return Some((tau, v - step * w));
        }
    }
    None
}

/// Time at which the velocity of a motion vanishes, which changes its sign once between the start and `v1` at `h`.
#[inline(always)]
pub(crate) fn turning_time(motion: &LinearMotion, h: f64, v1: f64) -> f64 {
    if motion.k == 0.0 {
        let discriminant = (motion.w0 * motion.w0 - 2.0 * motion.j0 * motion.v0).max(0.0);
        let tau = 2.0 * motion.v0 / (-motion.w0 + discriminant.sqrt().copysign(motion.v0));
        return tau.clamp(0.0, h);
    }
    let (mut low, mut high) = (0.0, h);
    let mut tau = h * motion.v0 / (motion.v0 - v1);
    for _ in 0..NEWTON_STEPS {
        if !(tau > low && tau < high) {
            tau = 0.5 * (low + high);
        }
        let (v, w) = motion.rates(tau);
        if v * motion.v0 > 0.0 {
            low = tau;
        } else {
            high = tau;
        }
        let step = v / w;
        // the displacement is stationary here: the error of the time counts by its square alone
        if step.abs() <= CONVERGED * h && tau - step >= low && tau - step <= high {
            return tau - step;
        }
        tau -= step;
    }
    monotone_root((0.0, motion.v0), (h, v1), |tau| motion.rates(tau))
}

/// Time of the first crossing of a level that `level_beyond` names for the displacement at a node, over the
/// monotone parts of `motion`.
pub(crate) fn first_crossing(
    motion: &LinearMotion,
    h: f64,
    mut level_beyond: impl FnMut(f64) -> Option<f64>,
) -> Option<Crossing> {
    let mut from = Node { tau: 0.0, u: motion.u0 };
    for to in Nodes::new(motion, h) {
        if let Some(level) = level_beyond(to.u) {
            return Some(Crossing::from_motion(motion, crossing_time(motion, from, to, level), level));
        }
        from = to;
    }
    None
}
