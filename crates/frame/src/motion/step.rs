//! One step: up to what ends it before its time, a threshold, an impact, the columns lying.

use std::ops::ControlFlow;

use uplift_taylor::{DEGREE, first_zero, leading_sign};

use super::{Ending, Flow, Lean, Motion};
use crate::branch::branches;
use crate::error::FrameError;
use crate::escape::LYING_RAD;
use crate::history::{Moment, Observer};
use crate::series::{Shaken, Step, Turning};

/// Rotation below which a passage by the apex is a straight line in the developed cone, rad, ...
const APEX_RAD: f64 = 1e-10;

/// ... if gravity deflects it by less than this, rad.
const APEX_DEFLECTION: f64 = 1e-12;

/// Part of a step in which a lean that begins to turn may turn to and fro by rounding.
const STILL: f64 = 1e-9;

/// What ends a step before its time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cut {
    Upper,
    Lower,
    Impact,
    Lying,
    Stop,
    TurnsBack,
    StopsTurning,
}

impl<O: Observer> Motion<O> {
    /// Goes through one step, up to what cuts it if anything does: then the answer is where.
    pub(super) fn step(
        &mut self,
        step: &Step,
        shaken: &Shaken,
        time_s: impl Fn(f64) -> f64,
        until_peak: bool,
    ) -> Flow<Option<f64>> {
        let was_rising = self.v >= 0.0;
        let x = step.x();
        let spread: f64 = x[1..].iter().map(|x| x.abs()).sum();
        let reach = x[0] + spread;
        let (mut end, mut cut) = (1.0, None);
        let mut earliest = |found: Option<f64>, kind: Cut| {
            if let Some(s) = found.filter(|s| *s < end || cut.is_none()) {
                (end, cut) = (s, Some(kind));
            }
        };
        let lower = self.branches.get(self.branch).map_or(0.0, |branch| branch.from_rad);
        let upper = self.branches.get(self.branch + 1).map_or(f64::INFINITY, |branch| branch.from_rad);
        if reach >= upper {
            earliest(first_reach(x, upper), Cut::Upper);
        }
        if lower > 0.0 && x[0] - spread <= lower {
            earliest(first_fall(x, lower), Cut::Lower);
        }
        if lower == 0.0 && matches!(self.lean, Lean::Plane { .. }) && x[0] <= spread {
            earliest(first_zero(x), Cut::Impact);
        }
        if reach >= LYING_RAD {
            earliest(first_reach(x, LYING_RAD), Cut::Lying);
        }
        if reach >= self.stop_rad {
            earliest(first_reach(x, self.stop_rad), Cut::Stop);
        }
        if self.v > 0.0 && self.branches.get(self.branch).is_some_and(|branch| branch.yields) {
            earliest(first_zero(step.v()), Cut::TurnsBack);
        }

        let begins_still = self.momentum() == 0.0;
        if matches!(self.lean, Lean::Space(_)) && self.constants.drag > 0.0 {
            earliest(step.stops_turning().map(|s| if begins_still { s.max(STILL) } else { s }), Cut::StopsTurning);
        }

        self.watch(step, reach, end, &time_s);
        self.follow_peaks(step, (reach, spread), end, &time_s);
        if !matches!(cut, Some(Cut::Impact)) {
            for s in [0.0, 0.5 * end] {
                self.follow_deck(step, shaken, s, time_s(s));
            }
        }

        let (x, v) = step.at(end);
        let is_upright = matches!(cut, Some(Cut::Impact)) || (x <= 0.0 && matches!(self.lean, Lean::Plane { .. }));
        if is_upright {
            if until_peak && was_rising {
                return Ok(ControlFlow::Break(Ending::PeakPassed));
            }
            self.impact(v, time_s(end), shaken);
            return Ok(ControlFlow::Continue(Some(end)));
        }
        (self.x, self.v) = (x, v);
        if let Lean::Space(turning) = &mut self.lean {
            *turning = step.turning_at(end);
        }
        match cut {
            Some(Cut::Upper) => (self.x, self.branch) = (upper, self.branch + 1),
            Some(Cut::Lower) => (self.x, self.branch) = (lower, self.branch - 1),
            Some(Cut::Lying) => {
                self.x = LYING_RAD;
                return Ok(ControlFlow::Break(self.overturn(time_s(end))));
            }
            Some(Cut::Stop) => {
                return Err(FrameError::SpringsStop { time_s: time_s(end), rotation_rad: self.stop_rad });
            }
            Some(Cut::TurnsBack) => {
                self.v = 0.0;
                self.turn_back_after_yielding()?;
            }
            Some(Cut::StopsTurning) => {
                if let Lean::Space(turning) = &mut self.lean
                    && !(begins_still && end <= STILL)
                {
                    turning.momentum = 0.0;
                }
            }
            Some(Cut::Impact) | None => {}
        }
        self.raise_peaks(self.x, time_s(end), end, Some(step));
        if until_peak && was_rising && self.v <= 0.0 {
            return Ok(ControlFlow::Break(Ending::PeakPassed));
        }
        Ok(ControlFlow::Continue(cut.map(|_| end)))
    }

    /// The stoppers have yielded and unload: from now on they engage later, by the plastic part.
    fn turn_back_after_yielding(&mut self) -> Result<(), FrameError> {
        let columns = self.frame.columns();
        let (path, restrained) = (columns.path(), columns.restrained());
        let elongation_m = columns.elongation(self.x).elongation_m;
        let Some(restrainer) = columns.restrainer() else { return Ok(()) };
        let Some(deformation_m) = restrainer.at(elongation_m)?.deformation_m else { return Ok(()) };
        let unloading = restrainer.after_yielding(deformation_m)?;
        self.frame = self.frame.clone().with_restrainer(unloading, path)?.with_restrained(restrained)?;
        self.branches = branches(&self.frame);
        // they stand at their new yield point, to rounding: below it
        if let Some(index) = self.branches.iter().position(|branch| branch.yields) {
            self.x = self.x.min(self.branches[index].from_rad);
            self.branch = index.saturating_sub(1);
        } else {
            self.branch = self.branch_at(self.x, -1.0);
        }
        Ok(())
    }

    /// A frame in a plane hits the ground with the velocity `v` ≤ 0 and stands on its other corners (Eq. 6.5).
    pub(super) fn impact(&mut self, v: f64, time_s: f64, shaken: &Shaken) {
        (self.x, self.v) = (0.0, v.min(0.0)); // above zero by a rounding at most
        if let Lean::Plane { side, .. } = &mut self.lean {
            *side = -*side;
        }
        self.v *= -self.rules.restitution;
        self.impacts += 1;
        self.branch = 0;
        self.observe(time_s, Moment::Impact, shaken);
        if self.v == 0.0 {
            self.come_to_rest(time_s);
        }
    }

    /// Passes the apex along a straight line in the developed cone; how long that takes, s.
    pub(super) fn pass_apex(&mut self) -> Option<f64> {
        let Lean::Space(turning) = self.lean else { return None };
        let deflection = self.p * self.p * self.constants.sin_alpha * self.x;
        if self.x > APEX_RAD || self.v >= 0.0 || deflection > APEX_DEFLECTION * self.v * self.v {
            return None;
        }
        let across = if turning.momentum == 0.0 { 0.0 } else { self.x * turning.momentum / self.turning_inertia() };
        let speed = self.v.abs();
        if turning.momentum != 0.0 && self.constants.drag > 0.0 {
            let passage = self.rolling.passage(self.x, speed, across.abs())?;
            (self.x, self.v) = (passage.rotation_rad, passage.velocity_rad_s);
            let direction = turning.direction + turning.momentum.signum() * passage.turn_rad;
            self.lean = Lean::Space(Turning { direction, momentum: turning.momentum * passage.momentum_kept });
            self.impacts += 1;
            return Some(passage.duration_s);
        }
        let passing_s = 2.0 * self.x * speed / (speed * speed + (self.kappa * across).powi(2));
        let turn = if turning.momentum == 0.0 {
            self.v *= self.rules.restitution;
            std::f64::consts::PI
        } else {
            turning.momentum.signum() * 2.0 * speed.atan2(self.kappa * across.abs()) / self.kappa
        };
        self.v = -self.v;
        self.lean = Lean::Space(Turning { direction: turning.direction + turn, ..turning });
        self.impacts += 1;
        Some(passing_s)
    }
}

/// First s in (0, 1) at which a rotation that begins at or below `level` rises to it.
pub(super) fn first_reach(x: &[f64], level: f64) -> Option<f64> {
    let mut below = [0.0; DEGREE + 1];
    for (below, x) in below.iter_mut().zip(x) {
        *below = -x;
    }
    below[0] += level;
    let below = &below[..x.len()];
    if below[0] < 0.0 { Some(0.0) } else { first_zero_from_above(below) }
}

/// First s in (0, 1) at which a rotation that begins at or above `level` falls to it.
fn first_fall(x: &[f64], level: f64) -> Option<f64> {
    let mut above = [0.0; DEGREE + 1];
    above[..x.len()].copy_from_slice(x);
    above[0] -= level;
    first_zero_from_above(&above[..x.len()])
}

/// As [`first_zero`]; at once, if the function begins at zero and falls.
fn first_zero_from_above(c: &[f64]) -> Option<f64> {
    if leading_sign(c.iter()) < 0.0 { Some(0.0) } else { first_zero(c) }
}
