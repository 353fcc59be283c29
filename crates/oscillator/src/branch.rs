//! One linear branch of the restoring force and the motion on it.

use crate::ahead::{larger, smaller};
use crate::stumpff::Stumpff;

/// A branch `r(u) = offset + k u` of the restoring force per mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Tangent stiffness over the mass `k`, 1/s²: positive, zero or negative.
    pub stiffness_per_s2: f64,
    /// Force per mass that the branch would have at `u = 0`, m/s².
    pub offset_m_s2: f64,
}

impl Branch {
    /// Restoring force per mass at the displacement `u`, m/s², on the side `sign` (±1, or 0 where the
    /// branch is attached).
    pub fn restoring(&self, sign: f64, u: f64) -> f64 {
        sign * self.offset_m_s2 + self.stiffness_per_s2 * u
    }
}

/// The motion on one branch while the ground acceleration is linear in time: `ü + k u = f0 + f1 τ`.
///
/// In terms of the initial displacement, velocity, acceleration `w0` and the rate `j0 = f1 − k v0`,
/// `u(τ) = u0 + v0 τ + w0 τ² c2(kτ²) + j0 τ³ c3(kτ²)`: increments on the initial state, so nothing
/// cancels for short times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearMotion {
    /// Displacement at `τ = 0`, m.
    pub u0: f64,
    /// Velocity at `τ = 0`, m/s.
    pub v0: f64,
    /// Acceleration at `τ = 0`, m/s².
    pub w0: f64,
    /// Rate of the acceleration at `τ = 0`, m/s³.
    pub j0: f64,
    /// Stiffness of the branch, 1/s².
    pub k: f64,
}

impl LinearMotion {
    /// The same motion as seen from the side ±1.
    #[must_use]
    #[inline(always)]
    pub(crate) fn on(&self, side: f64) -> Self {
        Self { u0: side * self.u0, v0: side * self.v0, w0: side * self.w0, j0: side * self.j0, k: self.k }
    }

    /// Displacement and velocity at `τ` seconds, given the Stumpff functions at `k τ²`.
    #[inline(always)]
    pub fn state_with(&self, tau: f64, s: &Stumpff) -> (f64, f64) {
        let u = self.u0 + tau * (self.v0 + tau * (self.w0 * s.c2 + tau * self.j0 * s.c3));
        let v = self.v0 + tau * (self.w0 * s.c1 + tau * self.j0 * s.c2);
        (u, v)
    }

    /// Displacement (m) and velocity (m/s) at `τ` seconds.
    #[inline(always)]
    pub fn state(&self, tau: f64) -> (f64, f64) {
        self.state_with(tau, &Stumpff::at(self.k * tau * tau))
    }

    /// The same motion with `τ` seconds as its start.
    #[must_use]
    #[inline(always)]
    pub fn restarted(&self, tau: f64) -> Self {
        let s = Stumpff::at(self.k * tau * tau);
        let (u0, v0) = self.state_with(tau, &s);
        let w0 = self.w0 * s.c0 + tau * self.j0 * s.c1;
        let j0 = self.j0 * s.c0 - self.k * tau * self.w0 * s.c1;
        Self { u0, v0, w0, j0, k: self.k }
    }

    /// Time until a near `level` is reached, by the inverse series to the third term: the error is of the
    /// fourth order in that time.
    #[inline(always)]
    pub(crate) fn time_to(&self, level: f64) -> f64 {
        let inverse = 1.0 / self.v0;
        let first = (level - self.u0) * inverse;
        let bend = 0.5 * first * self.w0 * inverse;
        first * (1.0 - bend + 2.0 * bend * bend - self.j0 * first * first * inverse * (1.0 / 6.0))
    }

    /// Velocity (m/s) and acceleration (m/s²) at `τ` seconds.
    #[inline(always)]
    pub fn rates(&self, tau: f64) -> (f64, f64) {
        let s = Stumpff::at(self.k * tau * tau);
        let v = self.v0 + tau * (self.w0 * s.c1 + tau * self.j0 * s.c2);
        (v, self.w0 * s.c0 + tau * self.j0 * s.c1)
    }

    /// A bound on `abs(ü)` over `[0, h]` given the acceleration `w1` at its end, m/s².
    ///
    /// The acceleration obeys `ẅ = −k w`, so it is convex towards zero where `k ≤ 0` (its largest magnitude is at an
    /// end), at most `max(abs(w0), abs(w1))/(1 − k h²/8)` where `k h²` is small, and never above its amplitude.
    #[inline(always)]
    pub fn acceleration_bound(&self, h: f64, w1: f64) -> f64 {
        let ends = self.w0.abs().max(w1.abs());
        let x = self.k * h * h;
        if x <= 0.0 {
            ends
        } else if x < 4.0 {
            ends / (1.0 - 0.125 * x)
        } else {
            (self.w0 * self.w0 + self.j0 * self.j0 / self.k).sqrt()
        }
    }

    /// A bound on how far the velocity departs within `h` seconds from its chord, `v1` being its value then.
    ///
    /// That is `h²/8 max abs(w')`, and the second derivative of the velocity `w'`, as the acceleration, obeys
    /// `w''' = −k w'`.
    #[inline(always)]
    pub(crate) fn departure_of_velocity(&self, h: f64, v1: f64) -> f64 {
        let x = self.k * h * h;
        let ends = larger(self.j0.abs(), (self.j0 + self.k * (self.v0 - v1)).abs());
        if x < 4.0 { 0.125 * h * h * ends / (1.0 - 0.125 * larger(x, 0.0)) } else { f64::INFINITY }
    }

    /// Whether the velocity, of one sign at the start and as `v1` after `h` seconds, is shown to keep it in between.
    #[inline(always)]
    pub(crate) fn keeps_direction(&self, h: f64, v1: f64) -> bool {
        // it lies below the slower end by `S (1 − Δ/4S)² ≤ S − Δ/4` at most, where Δ is the difference of both
        let (slow, fast) = (smaller(self.v0.abs(), v1.abs()), larger(self.v0.abs(), v1.abs()));
        slow > larger(self.departure_of_velocity(h, v1) - 0.25 * (fast - slow), 0.0)
    }
}
