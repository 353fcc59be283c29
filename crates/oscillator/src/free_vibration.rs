//! The first peak after the record, in closed form.
//!
//! With the ground at rest the energy on a branch is constant and each impact takes a share, so the first peak of
//! `abs(u)` is the largest of the whole free motion. On a branch with restoring force `r` (now, per mass) and stiffness
//! `k`, a system that moves outward at speed `v` stops after the distance `d` with `r d + k d²/2 = v²/2`.

use crate::branch::Branch;

/// The first peak of the free motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FreePeak {
    /// A negative-stiffness system does not come back.
    Overturns,
    /// The system stops here and returns.
    At {
        /// Time after the start of the free motion, s.
        after_s: f64,
        /// `abs(u)` there, m.
        displacement_m: f64,
        /// Impacts on the way.
        impacts: u32,
        /// Uplifts on the way.
        uplifts: u32,
    },
}

/// True where a free system on the uplifted branch can no longer return.
///
/// About the capacity, `z = abs(u) − u_cap` obeys `z̈ = λ² z`: it grows for ever if `ż + λ z > 0`.
///
/// * `state` — side (0 attached, ±1 uplifted), displacement (m), velocity (m/s)
pub fn cannot_return(uplifted: &Branch, state: (f64, f64, f64)) -> bool {
    let (side, u, v) = state;
    let k = uplifted.stiffness_per_s2;
    if side == 0.0 || k >= 0.0 {
        return false;
    }
    let lambda = (-k).sqrt();
    // −(r0 + k u)/λ = λ (abs(u) − u_cap)
    side * v - uplifted.restoring(side, u) * side / lambda > 0.0
}

/// The first peak of the free motion from `state` (side 0 or ±1, displacement in m, velocity in m/s).
///
/// * `boundary_m` — uplift displacement, m
/// * `restitution` — coefficient of restitution
pub fn first_peak(
    attached: &Branch,
    uplifted: &Branch,
    boundary_m: f64,
    restitution: f64,
    state: (f64, f64, f64),
) -> FreePeak {
    if cannot_return(uplifted, state) {
        return FreePeak::Overturns;
    }
    let (side, u, v) = state;
    if side == 0.0 {
        return from_attached(attached, uplifted, boundary_m, (u, v), 0.0);
    }
    let (distance, outward) = (side * u, side * v);
    let force = uplifted.restoring(1.0, distance);
    if outward >= 0.0 {
        let Some((further, after_s)) = stop(uplifted.stiffness_per_s2, force, outward) else {
            return FreePeak::Overturns;
        };
        return FreePeak::At { after_s, displacement_m: distance + further, impacts: 0, uplifts: 0 };
    }
    let force_at_boundary = uplifted.restoring(1.0, boundary_m);
    let inward = -outward;
    let at_impact = (inward * inward + (force + force_at_boundary) * (distance - boundary_m)).max(0.0).sqrt();
    let until_impact = inward_time(uplifted, (distance, inward), (boundary_m, at_impact));
    let start = (side * boundary_m, -side * restitution * at_impact);
    match from_attached(attached, uplifted, boundary_m, start, until_impact) {
        FreePeak::At { after_s, displacement_m, impacts, uplifts } => {
            FreePeak::At { after_s, displacement_m, impacts: impacts + 1, uplifts }
        }
        FreePeak::Overturns => FreePeak::Overturns,
    }
}

/// The first peak from an attached state `(u, v)` reached `elapsed` seconds into the free motion.
fn from_attached(attached: &Branch, uplifted: &Branch, boundary_m: f64, (u, v): (f64, f64), elapsed: f64) -> FreePeak {
    let omega = attached.stiffness_per_s2.sqrt();
    if omega == 0.0 {
        // no force while attached: the system drifts to the boundary, or stays
        if v == 0.0 {
            return FreePeak::At { after_s: elapsed, displacement_m: u.abs(), impacts: 0, uplifts: 0 };
        }
        let crossing_s = (boundary_m - u * v.signum()) / v.abs();
        return uplift(uplifted, boundary_m, v.abs(), elapsed + crossing_s);
    }
    let at_boundary_squared = v * v + attached.stiffness_per_s2 * (u * u - boundary_m * boundary_m);
    // u = R sin(phase) on the side that the system moves to
    let direction = if v < 0.0 { -1.0 } else { 1.0 };
    let phase = (omega * u * direction).atan2(v.abs());
    if at_boundary_squared <= 0.0 {
        let amplitude = (v / omega).hypot(u).min(boundary_m);
        let after_s = elapsed + (std::f64::consts::FRAC_PI_2 - phase) / omega;
        return FreePeak::At { after_s, displacement_m: amplitude, impacts: 0, uplifts: 0 };
    }
    let speed = at_boundary_squared.sqrt();
    let crossing_s = ((omega * boundary_m).atan2(speed) - phase) / omega;
    uplift(uplifted, boundary_m, speed, elapsed + crossing_s)
}

fn uplift(uplifted: &Branch, boundary_m: f64, speed: f64, elapsed: f64) -> FreePeak {
    if cannot_return(uplifted, (1.0, boundary_m, speed)) {
        return FreePeak::Overturns;
    }
    match stop(uplifted.stiffness_per_s2, uplifted.restoring(1.0, boundary_m), speed) {
        Some((further, after_s)) => {
            FreePeak::At { after_s: elapsed + after_s, displacement_m: boundary_m + further, impacts: 0, uplifts: 1 }
        }
        None => FreePeak::Overturns,
    }
}

/// Distance (m) and time (s) until a system that moves outward at `v` against the force `r` of a branch of stiffness
/// `k` stops; `None` if it never does.
fn stop(k: f64, r: f64, v: f64) -> Option<(f64, f64)> {
    if v == 0.0 {
        return Some((0.0, 0.0));
    }
    let discriminant = r * r + k * v * v;
    if discriminant < 0.0 || (k <= 0.0 && r <= 0.0) {
        return None;
    }
    let distance = v * v / (r + discriminant.sqrt());
    let time = if k > 0.0 {
        (k.sqrt() * v).atan2(r) / k.sqrt()
    } else if k < 0.0 {
        ((-k).sqrt() * v / r).atanh() / (-k).sqrt()
    } else {
        v / r
    };
    Some((distance, time))
}

/// Time (s) of the inward motion on the uplifted branch between two states of (distance in m, inward speed in m/s).
fn inward_time(uplifted: &Branch, from: (f64, f64), to: (f64, f64)) -> f64 {
    let k = uplifted.stiffness_per_s2;
    if from.0 <= to.0 {
        return 0.0;
    }
    if k > 0.0 {
        let omega = k.sqrt();
        let phase = |(distance, speed): (f64, f64)| (omega * speed).atan2(uplifted.restoring(1.0, distance));
        return (phase(to) - phase(from)) / omega;
    }
    if k < 0.0 {
        // the growing part of z = abs(u) − u_cap: (ż + λ z) e^{−λ t} is constant
        let lambda = (-k).sqrt();
        let growing = |(distance, speed): (f64, f64)| uplifted.restoring(1.0, distance) / lambda + speed;
        return (growing(to) / growing(from)).ln() / lambda;
    }
    2.0 * (from.0 - to.0) / (from.1 + to.1)
}
