//! The instants between which a motion is monotone.
//!
//! Inside a sample interval there may be two or more crossings, a grazing one, or a peak. Searching for roots
//! by sampling misses them; here the motion is divided where it turns. The acceleration of a [`LinearMotion`]
//! is a single sine, line or hyperbolic function, whose zeros are known in closed form; between two of them
//! the velocity is monotone and has at most one zero; between two of those the displacement is monotone and
//! crosses a level at most once.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::branch::LinearMotion;

/// Zeros of the acceleration in `(0, h)`, ascending.
#[derive(Debug, Clone)]
struct AccelerationZeros {
    next: f64,
    /// Distance between zeros, s; infinite where there is one at most.
    period: f64,
    end: f64,
}

impl AccelerationZeros {
    fn new(m: &LinearMotion, h: f64) -> Self {
        let (next, period) = if m.k > 0.0 {
            let omega = m.k.sqrt();
            if m.w0 == 0.0 && m.j0 == 0.0 {
                (f64::INFINITY, f64::INFINITY)
            } else {
                // w = R cos(ωτ − φ); of ±w the positive one, so that a motion and its mirror image turn
                // at the same time to the bit
                let turned = 1.0_f64.copysign(m.w0);
                let phase = (turned * m.j0 / omega).atan2(m.w0.abs());
                ((phase + FRAC_PI_2).rem_euclid(PI) / omega, PI / omega)
            }
        } else if m.j0 == 0.0 {
            (f64::INFINITY, f64::INFINITY)
        } else if m.k == 0.0 {
            (-m.w0 / m.j0, f64::INFINITY)
        } else {
            // tanh(λτ) = −w0 λ/j0: no real zero (NaN) where the right side exceeds one
            let lambda = (-m.k).sqrt();
            ((-m.w0 * lambda / m.j0).atanh() / lambda, f64::INFINITY)
        };
        Self { next, period, end: h }
    }
}

impl Iterator for AccelerationZeros {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        if self.next <= 0.0 {
            self.next += self.period;
        }
        // written so that NaN ends the iteration
        if self.next > 0.0 && self.next < self.end {
            let zero = self.next;
            self.next += self.period;
            Some(zero)
        } else {
            None
        }
    }
}

/// A node of a motion: the time since its start and the displacement there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Time, s.
    pub tau: f64,
    /// Displacement, m.
    pub u: f64,
}

/// The nodes of a motion over `(0, h]`, ascending, the last one at `h`: between neighbours (and between 0 and the
/// first) the displacement is monotone.
#[derive(Debug, Clone)]
pub struct Nodes<'a> {
    motion: &'a LinearMotion,
    zeros: AccelerationZeros,
    h: f64,
    /// Time and velocity at the end of the part scanned last.
    at: (f64, f64),
    /// End of the current part, to be returned after a turning point.
    pending: Option<f64>,
    done: bool,
}

impl<'a> Nodes<'a> {
    /// The nodes of `motion` over `h` seconds.
    pub fn new(motion: &'a LinearMotion, h: f64) -> Self {
        Self { motion, zeros: AccelerationZeros::new(motion, h), h, at: (0.0, motion.v0), pending: None, done: false }
    }

    fn node(&self, tau: f64) -> Node {
        Node { tau, u: self.motion.state(tau).0 }
    }
}

impl Iterator for Nodes<'_> {
    type Item = Node;

    fn next(&mut self) -> Option<Node> {
        if let Some(end) = self.pending.take() {
            self.done = end >= self.h;
            return Some(self.node(end));
        }
        if self.done {
            return None;
        }
        let end = self.zeros.next().unwrap_or(self.h);
        let (start, v_start) = self.at;
        let v_end = self.motion.rates(end).0;
        self.at = (end, v_end);
        if v_start * v_end < 0.0 {
            let turn = monotone_root((start, v_start), (end, v_end), |tau| self.motion.rates(tau));
            if turn > start && turn < end {
                self.pending = Some(end);
                return Some(self.node(turn));
            }
        }
        self.done = end >= self.h;
        Some(self.node(end))
    }
}

/// The first time in `(from, to]` at which a displacement that is monotone there equals `level`, the ends being on
/// either side of it (or on it).
///
/// * `from`, `to` — time (s) and displacement (m) of the ends
pub fn crossing_time(motion: &LinearMotion, from: Node, to: Node, level: f64) -> f64 {
    monotone_root((from.tau, from.u - level), (to.tau, to.u - level), |tau| {
        let (u, v) = motion.state(tau);
        (u - level, v)
    })
}

/// Root of a function that is monotone between `a` and `b` (time, value), where its values differ in sign: Newton's
/// method kept inside a shrinking bracket, bisection where Newton leaves it or stalls (a double root).
///
/// `f` returns value and slope.
pub(crate) fn monotone_root(mut a: (f64, f64), mut b: (f64, f64), f: impl Fn(f64) -> (f64, f64)) -> f64 {
    if a.1 == 0.0 {
        return a.0;
    }
    if b.1 == 0.0 {
        return b.0;
    }
    let mut x = a.0 + (b.0 - a.0) * (a.1 / (a.1 - b.1));
    let mut width_before = f64::INFINITY;
    for _ in 0..200 {
        let width = b.0 - a.0;
        if !(x > a.0 && x < b.0) {
            x = a.0 + 0.5 * width;
            if x <= a.0 || x >= b.0 {
                return b.0; // the bracket is two neighbouring numbers
            }
        }
        let (value, slope) = f(x);
        if value == 0.0 {
            return x;
        }
        if (value > 0.0) == (a.1 > 0.0) {
            a = (x, value);
        } else {
            b = (x, value);
        }
        let newton = x - value / slope;
        // the step is below the resolution of the time itself
        if (newton - x).abs() <= f64::EPSILON * x.abs() {
            return newton.clamp(a.0, b.0);
        }
        // Newton converges from one side, so the bracket need not shrink on the other; only a slow
        // step calls for bisection
        let step = (newton - x).abs();
        x = if step < 0.5 * width_before { newton } else { a.0 + 0.5 * (b.0 - a.0) };
        width_before = step.max(f64::EPSILON * x.abs());
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    // u = cos(ωτ), ω = 140 rad/s: three turning points inside 0.08 s, at multiples of π/ω, and the
    // crossings of ±1/2 between them.
    #[test]
    fn stiff_oscillation_turns_several_times_in_one_interval() {
        let omega = 140.0_f64;
        let motion = LinearMotion { u0: 1.0, v0: 0.0, w0: -omega * omega, j0: 0.0, k: omega * omega };
        let nodes: Vec<Node> = Nodes::new(&motion, 0.08).collect();
        let turning: Vec<f64> = nodes.iter().filter(|n| n.u.abs() > 0.999_999).map(|n| n.tau * omega / PI).collect();
        assert_eq!(turning.len(), 3, "{nodes:?}");
        for (found, exact) in turning.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - exact).abs() < 1e-14);
        }
        let tau = crossing_time(&motion, Node { tau: 0.0, u: 1.0 }, nodes[1], 0.5);
        assert!((tau - PI / 3.0 / omega).abs() < 1e-17);
    }

    // u = (τ − 1)³/6 turns nowhere although its velocity has a double zero at τ = 1.
    #[test]
    fn inflection_is_no_turning_point() {
        let motion = LinearMotion { u0: -1.0 / 6.0, v0: 0.5, w0: -1.0, j0: 1.0, k: 0.0 };
        let nodes: Vec<Node> = Nodes::new(&motion, 3.0).collect();
        assert!(nodes.windows(2).all(|pair| pair[0].u <= pair[1].u));
        let tau = crossing_time(&motion, nodes[0], nodes[1], 4.0 / 3.0 / 6.0);
        assert!((tau - (1.0 + (4.0_f64 / 3.0).cbrt())).abs() < 1e-14);
    }

    // Hyperbolic: u = cosh(τ − 1) turns once, at τ = 1.
    #[test]
    fn hyperbolic_motion_turns_once() {
        let motion = LinearMotion {
            u0: 1.0_f64.cosh(),
            v0: -(1.0_f64.sinh()),
            w0: 1.0_f64.cosh(),
            j0: -(1.0_f64.sinh()),
            k: -1.0,
        };
        let lowest = Nodes::new(&motion, 3.0).min_by(|a, b| a.u.total_cmp(&b.u)).map(|n| n.tau);
        assert!((lowest.unwrap_or(f64::NAN) - 1.0).abs() < 1e-8);
    }
}
