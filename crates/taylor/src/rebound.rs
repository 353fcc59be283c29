//! When a chattering body comes to rest.
//!
//! A body that loses velocity at every impact makes infinitely many of them in a finite time, then rests. The motion
//! is cut short only where this is certain, so that no threshold enters the result: [`Rebound::is_over_within`]
//! proves that from the present impact on all rebounds are over before the ground could move the body again, and
//! that none is as high as the peak so far. Nothing but the number of impacts, which is infinite, depends on the
//! moment at which that is proved.
//!
//! The motion is ẍ = −p² [(1 + Z) sin(α − x) + A cos(α − x) + f(x)] for x ≥ 0, with A and Z the horizontal and vertical
//! accelerations of the ground in units of g and f(x) ≥ 0 whatever else draws the body back: nothing in a block, the
//! tendons in a frame.
//!
//! The proof. On the window w let |A| ≤ a, z₀ ≤ Z, |Z| ≤ z, |dA/dt| + |dZ/dt| ≤ a', and m = (1 + z₀) sin α − a cos α
//! > 0. The body leaves the ground with velocity v.
//! 1. While x ≤ x̂ = v²/(p² m), it is drawn back with at least p² (m − (1 + z + a) x̂), which is d = p² m/2 or more if
//!    v² (1 + z + a) ≤ p² m²/2. Then it indeed rises by no more than v²/(2d) = x̂, and is back within 2v/d.
//! 2. Rising and falling through the same x, it is drawn by forces that differ by p² a' (2v/d) at most. So it lands
//!    with v √(1 + ε) at most, ε = 2 p² a' v/d², and leaves with ϱ v, ϱ = r √(1 + ε).
//! 3. If ϱ < 1 all of this holds for the next rebound, with ϱ v for v: the velocities are bounded by a geometric
//!    series, and so are the durations, whose sum is at most 2v/(d (1 − ϱ)).
//!
//! If that is no longer than w, the body is at rest by then, and stays so within w, as |A| < (1 + Z) tan α.

use crate::forcing::Forcing;
use crate::polynomial::CERTAIN;

/// A body that leaves the ground after an impact.
#[derive(Debug, Clone, Copy)]
pub struct Rebound {
    /// p² \[1/s²\].
    pub p_squared: f64,
    /// tan α.
    pub tangent: f64,
    /// cos α.
    pub cosine: f64,
    /// Coefficient of restitution r.
    pub restitution: f64,
    /// Velocity v with which the body leaves the ground \[rad/s\].
    pub velocity: f64,
    /// Largest rotation so far \[rad\].
    pub peak: f64,
}

impl Rebound {
    /// Whether the body surely comes to rest on a step of `step_s`, under `horizontal` and `vertical` in units of g,
    /// without a new peak.
    pub fn is_over_within(&self, step_s: f64, horizontal: &Forcing, vertical: &Forcing) -> bool {
        let &Self { p_squared, tangent, cosine, restitution, velocity: v, peak } = self;
        let slack = cosine * (tangent * (1.0 + vertical.value(0.0)) - horizontal.value(0.0).abs());
        if slack <= 0.0 || restitution >= 1.0 {
            return false;
        }
        // under the least that the bounds can be it would last longer: most rebounds are too high by far
        if 4.0 * v > CERTAIN * step_s * p_squared * slack * (1.0 - restitution) {
            return false;
        }
        // the time that it takes under constant shaking, with a margin for the bounds to be wider
        let window = step_s.min(8.0 * v / (p_squared * slack * (1.0 - restitution)));
        let [bounds, vertical_bounds] = [horizontal, vertical].map(|forcing| forcing.bounds_within(window / step_s));
        let ([bound, change], [vertical_bound, vertical_change]) = (bounds, vertical_bounds);
        let begin = vertical.value(0.0);
        let least = begin - (vertical_bound - begin.abs());
        let m = cosine * (tangent * (1.0 + least) - bound);
        if m <= 0.0 || v * v * (1.0 + vertical_bound + bound) > 0.5 * p_squared * m * m {
            return false;
        }
        let d = 0.5 * p_squared * m;
        let slope = (change + vertical_change) / window;
        let gain = 2.0 * p_squared * slope * v / (d * d);
        let ratio = restitution * (1.0 + gain).sqrt();
        ratio < 1.0 && 2.0 * v <= window * d * (1.0 - ratio) && v * v <= 2.0 * d * peak
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rebound(velocity: f64) -> Rebound {
        Rebound {
            p_squared: 4.0,
            tangent: 0.2_f64.tan(),
            cosine: 0.2_f64.cos(),
            restitution: 0.94,
            velocity,
            peak: 0.01,
        }
    }

    fn linear(begin: f64, change: f64) -> Forcing {
        let mut forcing = Forcing::default();
        forcing.push(begin);
        forcing.push(change);
        forcing
    }

    #[test]
    fn nothing_is_proven_that_is_not_so() {
        let proven =
            |v: f64, begin: f64, change: f64| rebound(v).is_over_within(0.01, &linear(begin, change), &Forcing::none());
        assert!(proven(1e-6, 0.05, 0.01));
        assert!(!proven(0.05, 0.05, 0.01)); // too fast to be over in the interval
        assert!(!proven(1e-6, 0.25, 0.0)); // the ground moves it
        assert!(!proven(1e-6, 0.2027, 0.0)); // next to nothing draws it down
        assert!(proven(1e-9, 0.05, 0.9)); // long over when the ground will move it
        assert!(!proven(1e-4, 0.05, 0.9));
        let elastic = Rebound { restitution: 1.0, ..rebound(1e-9) };
        assert!(!elastic.is_over_within(0.01, &linear(0.0, 0.0), &Forcing::none()));
        let first = Rebound { peak: 1e-20, ..rebound(1e-6) };
        assert!(!first.is_over_within(0.01, &linear(0.0, 0.0), &Forcing::none())); // the rebound is the peak
    }

    /// Vertical shaking upwards weighs the body down, downwards it lightens it: with −0.8 g the ground moves it.
    #[test]
    fn a_lightened_body_is_not_proven_to_rest() {
        let proven = |vertical: f64| rebound(1e-6).is_over_within(0.01, &linear(0.05, 0.01), &linear(vertical, 0.0));
        assert!(proven(0.0) && proven(-0.3) && proven(0.3));
        assert!(!proven(-0.8));
    }
}
