//! The readable solver: interval by interval, event by event.
//!
//! In each sample interval the motion on the current branch is advanced in one step. A bound on its curvature shows at
//! once that most intervals hold neither an event nor a new peak; the others are divided at their
//! [nodes](crate::nodes) and searched part by part. At an event the state is put on the boundary exactly, the branch
//! changes and the rest of the interval follows.

use crate::branch::{Branch, LinearMotion};
use crate::excitation::Excitation;
use crate::free_vibration::{self, FreePeak};
use crate::history::{Event, EventKind, History, Observer, Sample};
use crate::nodes::{Node, Nodes, crossing_time};
use crate::oscillator::Oscillator;
use crate::response::{FreeVibration, Response};
use crate::stumpff::Stumpff;

/// During shaking a negative-stiffness system has overturned when it is this many capacities away.
pub const OVERTURNED_CAPACITIES: f64 = 20.0;

/// The response of `oscillator` to `excitation`, from rest.
pub fn respond(oscillator: &Oscillator, excitation: &Excitation<'_>, free_vibration: FreeVibration) -> Response {
    Run::new(oscillator, excitation.dt_s(), ()).follow(excitation, free_vibration).0
}

/// The same with the motion at every sample and every event.
pub fn respond_with_history(
    oscillator: &Oscillator,
    excitation: &Excitation<'_>,
    free_vibration: FreeVibration,
) -> (Response, History) {
    Run::new(oscillator, excitation.dt_s(), History::default()).follow(excitation, free_vibration)
}

/// A linear segment of the ground acceleration: `duration_s` long, from `from_m_s2` with the given slope.
#[derive(Debug, Clone, Copy)]
struct Ground {
    duration_s: f64,
    from_m_s2: f64,
    slope_m_s3: f64,
}

/// State on a branch.
#[derive(Debug, Clone, Copy)]
struct State {
    /// 0 attached, ±1 uplifted on that side.
    side: f64,
    u: f64,
    v: f64,
    /// Restoring force per mass. Carried so that it is `± η g` to the bit on both sides of an event: were it computed
    /// from either branch, the two could differ in the last digit and send the state to and fro.
    restoring: f64,
}

struct Run<O> {
    attached: Branch,
    uplifted: Branch,
    boundary_m: f64,
    at_boundary_m_s2: f64,
    restitution: f64,
    capacity_m: f64,
    dt_s: f64,
    /// Stumpff functions of a whole sample interval on either branch.
    whole: [Stumpff; 2],
    state: State,
    /// Time at the start of the current interval, s.
    time_s: f64,
    peak_m: f64,
    peak_time_s: f64,
    impacts: u32,
    uplifts: u32,
    overturned: bool,
    observer: O,
}

impl<O: Observer> Run<O> {
    fn new(oscillator: &Oscillator, dt_s: f64, observer: O) -> Self {
        let (attached, uplifted) = (oscillator.attached(), oscillator.uplifted());
        let whole = [attached, uplifted].map(|branch| Stumpff::at(branch.stiffness_per_s2 * dt_s * dt_s));
        Self {
            attached,
            uplifted,
            boundary_m: oscillator.boundary_m(),
            at_boundary_m_s2: oscillator.uplift_acceleration_m_s2(),
            restitution: oscillator.restitution(),
            capacity_m: oscillator.capacity_m(),
            dt_s,
            whole,
            state: State { side: 0.0, u: 0.0, v: 0.0, restoring: 0.0 },
            time_s: 0.0,
            peak_m: 0.0,
            peak_time_s: 0.0,
            impacts: 0,
            uplifts: 0,
            overturned: false,
            observer,
        }
    }

    fn follow(mut self, excitation: &Excitation<'_>, free_vibration: FreeVibration) -> (Response, O) {
        let scale = excitation.scale();
        let acceleration = excitation.acceleration_m_s2();
        self.observe();
        for (i, pair) in acceleration.windows(2).enumerate() {
            self.time_s = i as f64 * self.dt_s;
            let (from, to) = (scale * pair[0], scale * pair[1]);
            self.interval(Ground { duration_s: self.dt_s, from_m_s2: from, slope_m_s3: (to - from) / self.dt_s });
            self.time_s = (i + 1) as f64 * self.dt_s;
            self.observe();
            if self.has_overturned() {
                return self.finish();
            }
        }
        match free_vibration {
            FreeVibration::None => {}
            FreeVibration::FirstPeak => self.first_free_peak(),
            FreeVibration::Seconds(seconds) => self.free_motion(seconds),
        }
        self.finish()
    }

    /// The ground is at rest for `seconds` more: advanced by sample intervals, so that the history goes on.
    fn free_motion(&mut self, seconds: f64) {
        let start_s = self.time_s;
        let mut i = 0_u32;
        loop {
            let elapsed_s = f64::from(i) * self.dt_s;
            // written so that NaN ends the loop; what is left of a rounding error is not an interval
            if !(seconds - elapsed_s > 1e-9 * self.dt_s) {
                return;
            }
            if self.cannot_return() {
                self.overturned = true;
                return;
            }
            self.time_s = start_s + elapsed_s;
            let duration_s = self.dt_s.min(seconds - elapsed_s);
            self.interval(Ground { duration_s, from_m_s2: 0.0, slope_m_s3: 0.0 });
            self.time_s = start_s + elapsed_s + duration_s;
            self.observe();
            i += 1;
        }
    }

    fn first_free_peak(&mut self) {
        if self.boundary_m.is_infinite() {
            return; // a free mass keeps its velocity: there is no peak to come
        }
        let State { side, u, v, .. } = self.state;
        match free_vibration::first_peak(
            &self.attached,
            &self.uplifted,
            self.boundary_m,
            self.restitution,
            (side, u, v),
        ) {
            FreePeak::Overturns => self.overturned = true,
            FreePeak::At { after_s, displacement_m, impacts, uplifts } => {
                self.impacts += impacts;
                self.uplifts += uplifts;
                if displacement_m > self.peak_m {
                    self.peak_m = displacement_m;
                    self.peak_time_s = self.time_s + after_s;
                }
            }
        }
    }

    fn finish(self) -> (Response, O) {
        let response = Response {
            peak_displacement_m: if self.overturned { f64::INFINITY } else { self.peak_m },
            time_of_peak_s: if self.overturned { self.time_s } else { self.peak_time_s },
            impacts: self.impacts,
            uplifts: self.uplifts,
            overturned: self.overturned,
            end_displacement_m: self.state.u,
            end_velocity_m_s: self.state.v,
        };
        (response, self.observer)
    }

    fn observe(&mut self) {
        self.observer.sample(Sample { time_s: self.time_s, displacement_m: self.state.u, velocity_m_s: self.state.v });
    }

    /// During shaking: so far beyond the capacity that no ground motion brings the system back. Also ends a run
    /// whose numbers overflow, which only an unstable branch can do.
    fn has_overturned(&mut self) -> bool {
        if self.capacity_m.is_finite() && !(self.state.u.abs() <= OVERTURNED_CAPACITIES * self.capacity_m) {
            self.overturned = true;
        }
        self.overturned
    }

    /// In free motion: beyond the capacity and moving outward, or inward too slowly to get back.
    fn cannot_return(&self) -> bool {
        free_vibration::cannot_return(&self.uplifted, (self.state.side, self.state.u, self.state.v))
    }

    /// Advance by one segment of ground acceleration.
    fn interval(&mut self, ground: Ground) {
        let mut elapsed = 0.0;
        loop {
            let State { side, u, v, restoring } = self.state;
            let attached = side == 0.0;
            let branch = if attached { self.attached } else { self.uplifted };
            let rest = ground.duration_s - elapsed;
            let acceleration = ground.from_m_s2 + ground.slope_m_s3 * elapsed;
            let motion = LinearMotion {
                u0: u,
                v0: v,
                w0: -restoring - acceleration,
                j0: -ground.slope_m_s3 - branch.stiffness_per_s2 * v,
                k: branch.stiffness_per_s2,
            };
            let (u1, v1) = if rest == self.dt_s {
                motion.state_with(rest, &self.whole[usize::from(!attached)])
            } else {
                motion.state(rest)
            };
            let restoring1 = branch.restoring(side, u1);
            let w1 = -restoring1 - (ground.from_m_s2 + ground.slope_m_s3 * ground.duration_s);

            // abs(u − chord) ≤ h²/8 max abs(ü): enough to show that nothing happens in most intervals
            let sag = 0.125 * rest * rest * motion.acceleration_bound(rest, w1);
            let highest = u.abs().max(u1.abs()) + sag;
            let quiet =
                if attached { highest <= self.boundary_m } else { (side * u).min(side * u1) - sag >= self.boundary_m };
            let event = if quiet && highest <= self.peak_m { None } else { self.search(&motion, rest, elapsed) };

            let Some(tau) = event else {
                self.state = State { side, u: u1, v: v1, restoring: restoring1 };
                return;
            };
            self.cross_boundary(&motion, tau, self.time_s + elapsed + tau);
            elapsed += tau;
            if elapsed >= ground.duration_s {
                return;
            }
        }
    }

    /// Raise the peak over the monotone parts of `motion` up to its first event within `h` seconds, and return the time
    /// of that.
    fn search(&mut self, motion: &LinearMotion, h: f64, elapsed: f64) -> Option<f64> {
        let side = self.state.side;
        let mut from = Node { tau: 0.0, u: motion.u0 };
        for to in Nodes::new(motion, h) {
            let level = if side == 0.0 {
                // outward through either boundary
                (to.u.abs() > self.boundary_m).then(|| self.boundary_m.copysign(to.u))
            } else {
                // inward through the boundary of this side
                (side * to.u < self.boundary_m).then_some(side * self.boundary_m)
            };
            if let Some(level) = level {
                let tau = crossing_time(motion, from, to, level);
                self.raise_peak(level, self.time_s + elapsed + tau);
                return Some(tau);
            }
            self.raise_peak(to.u, self.time_s + elapsed + to.tau);
            from = to;
        }
        None
    }

    fn raise_peak(&mut self, u: f64, time_s: f64) {
        if u.abs() > self.peak_m {
            self.peak_m = u.abs();
            self.peak_time_s = time_s;
        }
    }

    /// Put the state on the boundary `tau` seconds into `motion` and change the branch.
    fn cross_boundary(&mut self, motion: &LinearMotion, tau: f64, time_s: f64) {
        let (u, v) = motion.state(tau);
        let leaving = self.state.side == 0.0;
        let side = if leaving { 1.0_f64.copysign(u) } else { self.state.side };
        // rounding may leave a grazing velocity on the wrong side of zero
        let before = if leaving { side * (side * v).max(0.0) } else { side * (side * v).min(0.0) };
        let after = if leaving { before } else { self.restitution * before };
        let (kind, new_side) = if leaving {
            self.uplifts += 1;
            (EventKind::Uplift, side)
        } else {
            self.impacts += 1;
            (EventKind::Impact, 0.0)
        };
        let displacement_m = side * self.boundary_m;
        self.state = State { side: new_side, u: displacement_m, v: after, restoring: side * self.at_boundary_m_s2 };
        self.observer.event(Event {
            time_s,
            kind,
            displacement_m,
            velocity_before_m_s: before,
            velocity_after_m_s: after,
        });
    }
}
