//! The course of a motion: segment by segment of the shaking, then free, a step at a time.

use std::ops::ControlFlow;

use crate::error::FrameError;
use crate::ground::{GroundMotion, Piece, length};
use crate::history::Observer;
use crate::motion::{Asked, Ending, LONGEST_STEP, Motion, Segment};
use crate::response::Until;
use crate::series::{Expansion, Shaken, Step};

/// A motion that asks for one step after the other, so that several can go on side by side.
pub(crate) struct Course<'a, O> {
    pub(crate) motion: Motion<O>,
    ground: GroundMotion<'a>,
    /// [`GroundMotion::knots_s`].
    knots_s: Vec<f64>,
    until: Until,
    /// When it is over, s.
    last_s: f64,
    /// Length of the segments of free motion, s.
    free_step_s: f64,
    /// Segments of the shaking that were entered.
    entered: usize,
    pieces: [Piece; 3],
    segment: Option<Segment>,
    /// Begin and end of the segment, s.
    ends_s: [f64; 2],
    /// When the free motion began, s, and its segments.
    free: Option<(f64, f64)>,
    shaken: Shaken,
}

/// How a motion goes on.
pub(crate) enum Next {
    /// With a step.
    Step(Asked),
    /// The motion is over: the event that ended it, or none where time ran out.
    End(Option<Ending>),
}

impl<'a, O: Observer> Course<'a, O> {
    pub(crate) fn new(motion: Motion<O>, ground: GroundMotion<'a>, until: Until) -> Self {
        let last_s = match until {
            Until::FirstFreePeak => f64::INFINITY,
            Until::Time(time_s) => time_s,
        };
        let free_step_s = LONGEST_STEP / motion.frequency_parameter_rad_s();
        Self {
            motion,
            ground,
            knots_s: ground.knots_s(),
            until,
            last_s,
            free_step_s,
            entered: 0,
            pieces: [Piece::Zero; 3],
            segment: None,
            ends_s: [0.0; 2],
            free: None,
            shaken: Shaken::none(),
        }
    }

    /// Shaking on the step that is asked for.
    pub(crate) fn shaken(&self) -> &Shaken {
        &self.shaken
    }

    /// To the next step.
    pub(crate) fn next(&mut self) -> Result<Next, FrameError> {
        loop {
            if let Some(segment) = &mut self.segment {
                let pieces = &self.pieces;
                let shaking = |offset: f64, step: f64, shaken: &mut Shaken| write(pieces, offset, step, shaken);
                if let Some(asked) = self.motion.begin_step(segment, &mut self.shaken, shaking)? {
                    return Ok(Next::Step(asked));
                }
                self.leave();
            }
            if let ControlFlow::Break(ending) = self.enter()? {
                return Ok(Next::End(ending));
            }
        }
    }

    /// Through the step that was expanded as [`next`](Self::next) asked; what ends the motion, if anything does.
    pub(crate) fn take(&mut self, step: &Step, step_s: f64) -> Result<Option<Ending>, FrameError> {
        let Some(segment) = &mut self.segment else { return Ok(None) };
        Ok(match self.motion.end_step(segment, step, step_s, &mut self.shaken)? {
            ControlFlow::Break(ending) => Some(ending),
            ControlFlow::Continue(()) => None,
        })
    }

    /// To the end, alone.
    pub(crate) fn run(&mut self, expansion: &mut Expansion) -> Result<Option<Ending>, FrameError> {
        loop {
            match self.next()? {
                Next::End(ending) => return Ok(ending),
                Next::Step(asked) => {
                    if let Some(ending) = self.step_alone(expansion, asked)? {
                        return Ok(Some(ending));
                    }
                }
            }
        }
    }

    /// Through a step that is expanded alone.
    pub(crate) fn step_alone(&mut self, expansion: &mut Expansion, asked: Asked) -> Result<Option<Ending>, FrameError> {
        self.motion.expand(expansion, &self.shaken, asked.step_s, asked.at_threshold);
        self.take(expansion.step(), asked.step_s)
    }

    /// Enters the next segment, of the shaking or free; what ends the motion, if there is none.
    fn enter(&mut self) -> Result<ControlFlow<Option<Ending>>, FrameError> {
        match self.knots_s.get(self.entered..self.entered + 2) {
            Some(&[begin_s, knot_s]) if begin_s < self.last_s => {
                self.enter_shaking(begin_s, knot_s)?;
                Ok(ControlFlow::Continue(()))
            }
            _ => self.enter_free(),
        }
    }

    /// Enters a segment of the shaking between two knots; one in which the frame rests is left at once.
    fn enter_shaking(&mut self, begin_s: f64, knot_s: f64) -> Result<(), FrameError> {
        let (motion, end_s) = (&mut self.motion, knot_s.min(self.last_s));
        self.ground.between(begin_s, knot_s, motion.gravity_m_s2(), &mut self.pieces);
        if self.entered == 0 && O::KEEPS {
            motion.observe_sample(0.0, at(&self.pieces, 0.0));
        }
        self.entered += 1;
        self.ends_s = [begin_s, end_s];
        if motion.resting {
            motion.follow_ground(self.pieces.map(|piece| piece.value(0.0)), begin_s);
        }
        if stays_at_rest(motion, &self.pieces, end_s - begin_s) {
            self.leave();
            return Ok(());
        }
        let pieces = &self.pieces;
        let shaking = |offset: f64, step: f64, shaken: &mut Shaken| write(pieces, offset, step, shaken);
        self.segment = Some(motion.enter(begin_s, end_s - begin_s, false, &mut self.shaken, shaking)?);
        Ok(())
    }

    fn enter_free(&mut self) -> Result<ControlFlow<Option<Ending>>, FrameError> {
        let (motion, [_, end_s]) = (&mut self.motion, self.ends_s);
        let until_peak = self.until == Until::FirstFreePeak;
        let (free_s, segments) = match self.free {
            Some((free_s, segments)) => (free_s, segments + 1.0),
            None if until_peak && !motion.resting && motion.is_lost() => {
                return Ok(ControlFlow::Break(Some(motion.overturn(end_s))));
            }
            None => (end_s, 0.0),
        };
        self.free = Some((free_s, segments));
        let now_s = free_s + segments * self.free_step_s;
        if motion.resting || now_s >= self.last_s {
            return Ok(ControlFlow::Break(None));
        }
        let length_s = self.free_step_s.min(self.last_s - now_s);
        self.shaken = Shaken::none();
        self.pieces = [Piece::Zero; 3];
        self.ends_s = [now_s, now_s + length_s];
        self.segment = Some(motion.enter(now_s, length_s, until_peak, &mut self.shaken, |_, _, _| {})?);
        Ok(ControlFlow::Continue(()))
    }

    /// Leaves a segment.
    fn leave(&mut self) {
        self.segment = None;
        let [begin_s, end_s] = self.ends_s;
        if self.free.is_none() && self.motion.resting {
            self.motion.follow_ground(self.pieces.map(|piece| piece.value(end_s - begin_s)), end_s);
        }
        if O::KEEPS {
            self.motion.observe_sample(end_s, at(&self.pieces, end_s - begin_s));
        }
    }
}

fn write([x, y, z]: &[Piece; 3], offset: f64, step: f64, shaken: &mut Shaken) {
    x.write(offset, step, &mut shaken.horizontal[0]);
    y.write(offset, step, &mut shaken.horizontal[1]);
    z.write(offset, step, &mut shaken.vertical);
}

fn at(pieces: &[Piece; 3], offset: f64) -> Shaken {
    let mut shaken = Shaken::none();
    write(pieces, offset, 1.0, &mut shaken);
    shaken
}

/// Whether a frame at rest surely stays so on a segment of straight pieces.
fn stays_at_rest<O: Observer>(motion: &Motion<O>, pieces: &[Piece; 3], length_s: f64) -> bool {
    if !motion.resting {
        return false;
    }
    let [Some(x), Some(y), Some(z)] = pieces.map(|piece| piece.ends(length_s)) else { return false };
    let size = |ends: [f64; 2]| ends[0].abs().max(ends[1].abs());
    motion.stays_at_rest(length([size(x), size(y)]), -z[0].min(z[1]))
}
