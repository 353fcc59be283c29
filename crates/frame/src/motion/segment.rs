//! A segment of the shaking: from rest to uplift, and step by step up to its end.

use std::ops::ControlFlow;

use uplift_taylor::{Forcing, first_zero, leading_sign};

use super::{Flow, Lean, Motion};
use crate::error::FrameError;
use crate::ground::length;
use crate::history::{Moment, Observer};
use crate::series::{Shaken, Step, Turning};
use crate::uplift::{Uplift, uplift_in_plane, uplift_in_space};

/// Impacts in one segment after which a frame that cannot be shown to come to rest is taken to be.
const MOST_IMPACTS: u32 = 100_000;

/// Steps in one segment after which a wobbling frame is given up.
const MOST_STEPS: u64 = 2_000_000;

/// Longest step in units of 1/p.
pub(crate) const LONGEST_STEP: f64 = 0.5;

/// Longest step towards the apex as a part of the radius of convergence there: order 20 or so.
const APEX_STEP: f64 = 0.15;

/// A step is long from this part of such a step on: order 12 or so.
const LONG_STEP: f64 = 0.3;

/// A segment of the shaking, and how far the motion is in it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    start_s: f64,
    length_s: f64,
    until_peak: bool,
    offset: f64,
    steps: u64,
    just_uplifted: bool,
    impacts_before: u64,
}

/// A step that is to be expanded from the present state.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked {
    pub(crate) step_s: f64,
    /// Whether the frame uplifts at its begin, where the moments cancel.
    pub(crate) at_threshold: bool,
    /// Whether the apex is so close that the series will be long.
    pub(crate) is_long: bool,
}

impl<O: Observer> Motion<O> {
    /// Begins a segment of `length_s` at `start_s`, on which `shaking` writes the components x, y, z in units of g from
    /// an offset in the segment on, in powers of (time − offset)/step. With `until_peak` it ends early, when `θ` has
    /// passed a maximum.
    pub(crate) fn enter(
        &self,
        start_s: f64,
        length_s: f64,
        until_peak: bool,
        shaken: &mut Shaken,
        shaking: impl Fn(f64, f64, &mut Shaken),
    ) -> Result<Segment, FrameError> {
        shaking(0.0, length_s, shaken);
        self.check_weight(start_s, length_s, &shaken.vertical)?;
        let impacts_before = self.impacts;
        Ok(Segment { start_s, length_s, until_peak, offset: 0.0, steps: 0, just_uplifted: false, impacts_before })
    }

    /// What the next step of the segment is expanded from, with its `shaken`; none where the segment ends at rest or is
    /// over.
    pub(crate) fn begin_step(
        &mut self,
        segment: &mut Segment,
        shaken: &mut Shaken,
        shaking: impl Fn(f64, f64, &mut Shaken),
    ) -> Result<Option<Asked>, FrameError> {
        let Segment { start_s, length_s, .. } = *segment;
        while segment.offset < length_s {
            let mut at_threshold = false;
            if self.resting {
                let remaining = length_s - segment.offset;
                shaking(segment.offset, remaining, shaken);
                let Some(s) = self.find_uplift(shaken) else { break };
                at_threshold = s > 0.0;
                segment.offset += s * remaining;
                if segment.offset >= length_s {
                    break; // at the very end: the next segment finds it
                }
                self.branch = 0;
                segment.just_uplifted = true;
            }
            segment.steps += 1;
            if segment.steps > MOST_STEPS {
                let (time_s, steps) = (start_s + segment.offset, segment.steps);
                return Err(FrameError::Rattles { time_s, rotation_rad: self.x, steps });
            }

            let apex_step_s = self.apex_step_s();
            let mut step_s = (length_s - segment.offset).min(LONGEST_STEP / self.p).min(apex_step_s);
            shaking(segment.offset, step_s, shaken);
            self.lean_into(shaken);
            if !segment.just_uplifted && self.rests(shaken, step_s) {
                self.come_to_rest(start_s + segment.offset);
                continue;
            }
            if let Lean::Plane { .. } = self.lean
                && self.x == 0.0
                && self.v > 0.0
            {
                // a rebound is over in 2v over the acceleration that draws it down, if that stays
                let [along, lift] = [&shaken.horizontal[0], &shaken.vertical].map(|forcing| forcing.value(0.0));
                let down = self.p * self.p * self.constants.cos_alpha * (self.tangent * (1.0 + lift) + along);
                let rebound_s = 2.5 * self.v / down;
                if down > 0.0 && rebound_s < step_s {
                    shaken.stretch(rebound_s / step_s);
                    step_s = rebound_s;
                }
            }
            return Ok(Some(Asked { step_s, at_threshold, is_long: step_s > LONG_STEP * apex_step_s }));
        }
        Ok(None)
    }

    /// Goes through the step that was expanded as [`begin_step`](Self::begin_step) asked.
    pub(crate) fn end_step(
        &mut self,
        segment: &mut Segment,
        step: &Step,
        step_s: f64,
        shaken: &mut Shaken,
    ) -> Flow<()> {
        let Segment { start_s, length_s, offset: begin, .. } = *segment;
        if self.resting {
            if let Lean::Plane { .. } = self.lean
                && leading_sign(step.x().iter()) <= 0.0
            {
                // shaking above the threshold by a rounding only
                segment.offset += 1e-9 * length_s;
                return Ok(ControlFlow::Continue(()));
            }
            self.resting = false;
            self.uplift_s.get_or_insert(start_s + begin);
            self.observe(start_s + begin, Moment::Uplift, shaken);
        } else if leading_sign(step.x().iter()) <= 0.0 {
            self.come_to_rest(start_s + begin);
            segment.offset += 1e-9 * length_s;
            return Ok(ControlFlow::Continue(()));
        }
        segment.just_uplifted = false;

        segment.offset = if step.length_s >= length_s - begin { length_s } else { begin + step.length_s };
        let time_s = |s: f64| start_s + (begin + s * step.length_s);
        if step.length_s < step_s {
            shaken.stretch(step.length_s / step_s);
        }
        let cut = match self.step(step, shaken, time_s, segment.until_peak)? {
            ControlFlow::Break(ending) => return Ok(ControlFlow::Break(ending)),
            ControlFlow::Continue(cut) => cut,
        };
        if let Some(s) = cut {
            segment.offset = begin + s * step.length_s;
            if self.impacts - segment.impacts_before >= u64::from(MOST_IMPACTS) && !self.resting {
                self.was_cut = true;
                self.come_to_rest(start_s + segment.offset);
                segment.offset = length_s;
                return Ok(ControlFlow::Continue(()));
            }
        }
        if let Some(passing_s) = self.pass_apex() {
            segment.offset += passing_s;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Refuses ground that falls away under the frame.
    fn check_weight(&self, start_s: f64, length_s: f64, vertical: &Forcing) -> Result<(), FrameError> {
        if vertical.bound() < 1.0 {
            return Ok(());
        }
        let weight = vertical.beginning_at(1.0 + vertical.value(0.0));
        let lifted = if weight.value(0.0) <= 0.0 { Some(0.0) } else { first_zero(weight.coefficients()) };
        let Some(s) = lifted else { return Ok(()) };
        let acceleration_m_s2 = self.frame.gravity_m_s2() * vertical.value(s);
        Err(FrameError::Airborne { time_s: start_s + s * length_s, acceleration_m_s2 })
    }

    /// First s in [0, 1) at which the frame uplifts: sets it upon its corners there.
    fn find_uplift(&mut self, shaken: &Shaken) -> Option<f64> {
        let Shaken { horizontal: [x, y], vertical: z } = shaken;
        let threshold = z.times(self.tangent).plus(&Forcing::none().beginning_at(self.tangent + self.prestress));
        (self.x, self.v) = (0.0, 0.0);
        match &mut self.lean {
            Lean::Plane { direction, side } => {
                let along = x.times(direction[0]).plus(&y.times(direction[1]));
                let Uplift { s, towards } = uplift_in_plane(&along, &threshold)?;
                *side = towards[0];
                Some(s)
            }
            Lean::Space(turning) => {
                let Uplift { s, towards } = uplift_in_space([x, y], &threshold)?;
                *turning = Turning { direction: towards[1].atan2(towards[0]), momentum: 0.0 };
                self.x = self.rules.start_rotation_rad;
                Some(s)
            }
        }
    }

    /// Turns horizontal components x and y into those along and across the lean, where that keeps its plane.
    pub(super) fn lean_into(&self, shaken: &mut Shaken) {
        if let Lean::Plane { direction, side } = self.lean {
            let [x, y] = &mut shaken.horizontal;
            x.combine(side * direction[0], y, side * direction[1]);
            y.set_none();
        }
    }

    /// Part of the radius of convergence near the apex, s.
    fn apex_step_s(&self) -> f64 {
        match self.lean {
            Lean::Plane { .. } => f64::INFINITY,
            Lean::Space(turning) => {
                let across = self.kappa * self.x * turning.momentum / self.turning_inertia();
                APEX_STEP * self.x / length([self.v, across])
            }
        }
    }
}
