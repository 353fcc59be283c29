//! Whether free motion comes back, and how far it goes: one root of the energy, no integration.
//!
//! Without shaking energy and momentum are constants, so that `θ` moves between turning points of `V(θ) + L²/2J(θ)`.
//! The largest rotation to come is the first root beyond the present one of `V + L²/2J = E`; where there is none before
//! the columns lie, the frame overturns.

use crate::frame::RockingFrame;

/// Parts that a smooth piece of the potential is searched in.
const PARTS: u32 = 200;

/// The columns lie.
pub(crate) const LYING_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// Free motion at an instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Free {
    /// Rotation `θ ≥ 0`, rad.
    pub(crate) rotation: f64,
    /// `θ̇`, rad/s.
    pub(crate) velocity: f64,
    /// `J φ̇` over `μ R²`, 1/s.
    pub(crate) momentum: f64,
    /// Ratio of velocities at an impact; 1 where there is none.
    pub(crate) restitution: f64,
}

impl RockingFrame {
    /// The largest rotation of free motion from now on, rad; none if the frame overturns.
    pub(crate) fn largest_rotation_to_come(&self, free: Free) -> Option<f64> {
        let Free { rotation, velocity, momentum, restitution } = free;
        let turning = |theta: f64| {
            if momentum == 0.0 { 0.0 } else { 0.5 * momentum * momentum / self.turning_inertia(theta) }
        };
        let barrier = |theta: f64| self.potential(theta) + turning(theta);
        let energy = 0.5 * self.inertia().tilt * velocity * velocity + barrier(rotation);
        let knots = self.columns().threshold_rotations_rad();
        let excess = |theta: f64| barrier(theta) - energy;
        if velocity < 0.0 && momentum == 0.0 && !turns_before_zero(rotation, excess) {
            // through the upright position, where it loses what an impact takes
            let after = restitution * restitution * energy;
            return first_rise(0.0, &knots, |theta| barrier(theta) - after);
        }
        first_rise(rotation, &knots, excess)
    }
}

/// Whether a motion inwards is turned outwards before it is upright.
fn turns_before_zero(rotation: f64, excess: impl Fn(f64) -> f64) -> bool {
    (1..PARTS).any(|part| excess(rotation * f64::from(part) / f64::from(PARTS)) > 0.0)
}

/// The first place from `from` to a quarter turn at which `excess` rises above zero, searched in parts between `knots`.
/// A part at whose ends it is below but between which it has its largest value is searched for that.
fn first_rise(from: f64, knots: &[f64], excess: impl Fn(f64) -> f64) -> Option<f64> {
    let mut ends: Vec<f64> = knots.iter().copied().filter(|knot| *knot > from && *knot < LYING_RAD).collect();
    ends.push(LYING_RAD);
    let mut begin = from;
    let (mut before, mut last) = (f64::NEG_INFINITY, (from, excess(from).min(0.0)));
    let mut earlier = from;
    for end in ends {
        for part in 1..=PARTS {
            let place = if part == PARTS { end } else { begin + f64::from(part) * (end - begin) / f64::from(PARTS) };
            let value = excess(place);
            if value > 0.0 {
                return Some(root(last.0, place, &excess));
            }
            if last.1 >= before && last.1 >= value && last.1 < 0.0 {
                let top = largest(earlier, place, &excess);
                if excess(top) > 0.0 {
                    return Some(root(earlier, top, &excess));
                }
            }
            (earlier, before, last) = (last.0, last.1, (place, value));
        }
        begin = end;
    }
    None
}

/// The place between `low`, where `f` is not above zero, and `high`, where it is, to the last digit.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if f(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// The place of the largest value of a function that rises, then falls, by golden sections.
fn largest(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let share = 0.5 * (3.0 - 5.0_f64.sqrt());
    for _ in 0..80 {
        let (left, right) = (low + share * (high - low), high - share * (high - low));
        if f(left) > f(right) { high = right } else { low = left }
    }
    0.5 * (low + high)
}
