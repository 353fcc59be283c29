//! The motion itself: rest, uplift, rocking and impacts, segment by segment of the excitation.

use std::ops::ControlFlow;

use uplift_taylor::{DEGREE, Forcing, Rebound, first_sign_change, first_zero, leading_sign, sign_changes, value};

use crate::block::{LYING_RAD, RockingBlock};
use crate::observer::{HistoryRow, Moment, Observer};
use crate::rest::RestRule;
use crate::series::Series;
use crate::sine::sine_and_cosine;

/// Impacts in one segment after which a block that cannot be shown to come to rest is taken to be.
///
/// Only nearly elastic blocks get there, with rebounds some 2e-11 of what gravity would draw them
/// down during the segment.
const MOST_IMPACTS: u32 = 100_000;

/// Longest step in units of 1/p: the series has converged by then at order 14 or so.
const LONGEST_STEP: f64 = 0.5;

/// Why the motion ends before the excitation, or before the time asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The block does not come back.
    Overturned,
    /// The largest rotation of free rocking is known.
    PeakPassed,
}

/// A segment of the excitation, and how far the motion has come in it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    start_s: f64,
    length_s: f64,
    offset_s: f64,
    impacts_before: u64,
}

impl Segment {
    /// One of `length_s` at the begin of which, at `start_s`, the motion has had so many `impacts`.
    pub(crate) const fn new(start_s: f64, length_s: f64, impacts: u64) -> Self {
        Self { start_s, length_s, offset_s: 0.0, impacts_before: impacts }
    }

    /// Where a step of `step_s` ends in it, if that is at its end.
    pub(crate) fn end_s(&self, step_s: f64) -> Option<f64> {
        (step_s >= self.length_s - self.offset_s).then_some(self.offset_s + step_s)
    }
}

/// State of a block in motion, in the frame of the corner it stands on.
#[derive(Debug)]
pub(crate) struct Motion<'a, O> {
    pub(crate) block: &'a RockingBlock,
    p: f64,
    tangent: f64,
    cosine: f64,
    rest_rule: RestRule,
    /// Sign of the rotation: which corner.
    pub(crate) side: f64,
    /// |θ| \[rad\].
    pub(crate) x: f64,
    /// d|θ|/dt \[rad/s\].
    pub(crate) v: f64,
    pub(crate) resting: bool,
    pub(crate) peak: f64,
    pub(crate) peak_s: f64,
    pub(crate) uplift_s: Option<f64>,
    pub(crate) impacts: u64,
    pub(crate) was_cut: bool,
    pub(crate) observer: O,
}

impl<'a, O: Observer> Motion<'a, O> {
    /// A block at rest.
    pub(crate) fn new(block: &'a RockingBlock, rest_rule: RestRule, observer: O) -> Self {
        let (sine, cosine) = sine_and_cosine(block.slenderness_rad());
        Self {
            block,
            p: block.frequency_parameter_rad_s(),
            tangent: sine / cosine,
            cosine,
            rest_rule,
            side: 1.0,
            x: 0.0,
            v: 0.0,
            resting: true,
            peak: 0.0,
            peak_s: 0.0,
            uplift_s: None,
            impacts: 0,
            was_cut: false,
            observer,
        }
    }

    /// Tilts the block and lets it go.
    pub(crate) fn release(&mut self, rotation_rad: f64) {
        self.side = 1.0_f64.copysign(rotation_rad);
        self.x = rotation_rad.abs();
        self.resting = self.x == 0.0;
        self.peak = self.x;
    }

    /// Longest step that is taken \[s\].
    pub(crate) fn longest_step_s(&self) -> f64 {
        LONGEST_STEP / self.p
    }

    /// Whether the block never comes back without further shaking.
    pub(crate) fn is_lost(&self) -> bool {
        !self.resting && self.block.is_lost(self.x, self.v)
    }

    pub(crate) fn observe(&mut self, time_s: f64, moment: Moment) {
        let (rotation_rad, velocity_rad_s) = (self.side * self.x, self.side * self.v);
        self.observer.observe(HistoryRow { time_s, rotation_rad, velocity_rad_s, moment });
    }

    /// Moves through a segment of `length_s` that begins at `start_s`, a step after the other in `series`; `shaking`
    /// sets the ground acceleration \[m/s²\] from an offset in the segment on, in powers of (time − offset)/step. With
    /// `until_peak` it ends early, when |θ| has passed a maximum.
    pub(crate) fn advance(
        &mut self,
        series: &mut Series,
        start_s: f64,
        length_s: f64,
        until_peak: bool,
        shaking: impl Fn(f64, f64, &mut Forcing),
    ) -> ControlFlow<Ending> {
        let (mut segment, mut forcing) = (Segment::new(start_s, length_s, self.impacts), Forcing::none());
        while let Some(step_s) = self.next(&mut segment, &mut forcing, &shaking) {
            self.expand(series, &forcing, step_s);
            self.take(&mut segment, series, until_peak)?;
        }
        ControlFlow::Continue(())
    }

    /// The longest that the next step may be, none if the segment is over; makes `forcing` what shakes the block on it,
    /// in units of g and in the frame of the corner. It is not handed over by value: it is long, and hardly filled.
    pub(crate) fn next(
        &mut self,
        segment: &mut Segment,
        forcing: &mut Forcing,
        shaking: impl Fn(f64, f64, &mut Forcing),
    ) -> Option<f64> {
        let gravity = self.block.gravity_m_s2();
        while segment.offset_s < segment.length_s {
            let mut starts_at_threshold = false;
            if self.resting {
                let remaining = segment.length_s - segment.offset_s;
                shaking(segment.offset_s, remaining, forcing);
                forcing.scale(1.0 / gravity);
                let (s, side) = first_uplift(forcing, self.tangent)?;
                starts_at_threshold = s > 0.0;
                segment.offset_s += s * remaining;
                (self.side, self.x, self.v) = (side, 0.0, 0.0);
                if segment.offset_s >= segment.length_s {
                    return None; // at the very end: the next segment finds it
                }
            }

            let mut step = (segment.length_s - segment.offset_s).min(self.longest_step_s());
            shaking(segment.offset_s, step, forcing);
            forcing.scale(self.side / gravity);
            if starts_at_threshold {
                forcing.begin_at(-self.tangent);
            }
            if self.x == 0.0 && self.v > 0.0 {
                if self.rest_rule.comes_to_rest(&self.rebound(), forcing, step) {
                    self.come_to_rest(segment.start_s + segment.offset_s);
                    continue;
                }
                // a rebound is over in 2v over the acceleration that draws it down, if that stays
                let down = self.p * self.p * self.cosine * (self.tangent + forcing.value(0.0));
                let rebound = 2.5 * self.v / down;
                if down > 0.0 && rebound < step {
                    forcing.stretch(rebound / step);
                    step = rebound;
                }
            }
            return Some(step);
        }
        None
    }

    /// Makes `series` the motion on the next step, or on as much of it as it converges on.
    pub(crate) fn expand(&self, series: &mut Series, forcing: &Forcing, step_s: f64) {
        series.expand(self.x, self.v, forcing, step_s, self.p * self.p, self.block.slenderness_rad());
    }

    /// Takes the step of which `series` is the motion, up to an impact if there is one.
    pub(crate) fn take(&mut self, segment: &mut Segment, series: &Series, until_peak: bool) -> ControlFlow<Ending> {
        let (start_s, length_s, begin) = (segment.start_s, segment.length_s, segment.offset_s);
        let leaves = leading_sign(series.x().iter()) > 0.0;
        if self.resting || !leaves {
            if !leaves {
                // shaking above the threshold by a rounding only
                self.resting = true;
                segment.offset_s += 1e-9 * length_s;
                return ControlFlow::Continue(());
            }
            self.resting = false;
            self.uplift_s.get_or_insert(start_s + begin);
            self.observe(start_s + begin, Moment::Uplift);
        }

        segment.offset_s = if series.step_s >= length_s - begin { length_s } else { begin + series.step_s };
        if let Some(s) = self.step(series, |s| start_s + (begin + s * series.step_s), until_peak)? {
            segment.offset_s = begin + s * series.step_s;
            if !self.resting && self.impacts - segment.impacts_before >= u64::from(MOST_IMPACTS) {
                self.was_cut = true;
                self.come_to_rest(start_s + segment.offset_s);
                segment.offset_s = length_s;
            }
        }
        ControlFlow::Continue(())
    }

    /// Goes through one step, up to an impact if there is one: then the answer is where.
    fn step(
        &mut self,
        series: &Series,
        time_s: impl Fn(f64) -> f64,
        until_peak: bool,
    ) -> ControlFlow<Ending, Option<f64>> {
        let was_rising = self.v >= 0.0;
        let touch = first_zero(series.x());
        let end = touch.unwrap_or(1.0);

        let reach: f64 = series.x().iter().map(|x| x.abs()).sum();
        if reach >= LYING_RAD
            && let Some(s) = first_lying(series.x()).filter(|s| *s <= end)
        {
            (self.x, self.v) = (LYING_RAD, value(series.v(), s));
            return ControlFlow::Break(self.overturn(time_s(s)));
        }
        if reach > self.peak {
            let (x, v) = (series.x(), series.v());
            let _ = sign_changes(v, &mut |s| {
                if s > end {
                    return ControlFlow::Break(());
                }
                self.raise_peak(value(x, s), time_s(s));
                ControlFlow::Continue(())
            });
        }

        let (x, v) = series.at(end);
        if touch.is_some() || x <= 0.0 {
            if until_peak && was_rising {
                return ControlFlow::Break(Ending::PeakPassed);
            }
            self.impact(v, time_s(end));
            return ControlFlow::Continue(Some(end));
        }
        (self.x, self.v) = (x, v);
        self.raise_peak(x, time_s(end));
        if until_peak && was_rising && v <= 0.0 {
            return ControlFlow::Break(Ending::PeakPassed);
        }
        ControlFlow::Continue(None)
    }

    /// The block hits the ground with the velocity `v` ≤ 0 and stands on its other corner (Eq. 2.3).
    fn impact(&mut self, v: f64, time_s: f64) {
        (self.x, self.v) = (0.0, v.min(0.0)); // above zero by a rounding at most
        self.observe(time_s, Moment::BeforeImpact);
        self.side = -self.side;
        self.v *= -self.block.restitution();
        self.impacts += 1;
        self.observe(time_s, Moment::AfterImpact);
        if self.v == 0.0 {
            self.come_to_rest(time_s);
        }
    }

    pub(crate) fn overturn(&mut self, time_s: f64) -> Ending {
        (self.peak, self.peak_s) = (f64::INFINITY, time_s);
        self.observe(time_s, Moment::Overturned);
        Ending::Overturned
    }

    fn come_to_rest(&mut self, time_s: f64) {
        (self.x, self.v, self.resting) = (0.0, 0.0, true);
        self.observe(time_s, Moment::Rest);
    }

    fn raise_peak(&mut self, x: f64, time_s: f64) {
        if x > self.peak {
            (self.peak, self.peak_s) = (x, time_s);
        }
    }

    fn rebound(&self) -> Rebound {
        Rebound {
            p_squared: self.p * self.p,
            tangent: self.tangent,
            cosine: self.cosine,
            restitution: self.block.restitution(),
            velocity: self.v,
            peak: self.peak,
        }
    }
}

/// First s in [0, 1) at which |A| rises above tan α, and the corner on which the block will then
/// stand: against the ground.
fn first_uplift(forcing: &Forcing, tangent: f64) -> Option<(f64, f64)> {
    if forcing.bound() <= tangent {
        return None;
    }
    let excess = |sign: f64| forcing.times(sign).beginning_at(sign * forcing.value(0.0) - tangent);
    let first = |side: f64| {
        let excess = excess(-side);
        let c = excess.coefficients();
        let is_above = leading_sign(c.iter()) > 0.0;
        if is_above { Some((0.0, side)) } else { first_sign_change(c).map(|s| (s, side)) }
    };
    match (first(1.0), first(-1.0)) {
        (Some(one), Some(other)) => Some(if other.0 < one.0 { other } else { one }),
        (one, other) => one.or(other),
    }
}

/// First s in (0, 1) at which the rotation passes [`LYING_RAD`].
fn first_lying(x: &[f64]) -> Option<f64> {
    let mut above = [0.0; DEGREE + 1];
    above[..x.len()].copy_from_slice(x);
    above[0] -= LYING_RAD;
    if above[0] >= 0.0 { Some(0.0) } else { first_sign_change(&above[..x.len()]) }
}
