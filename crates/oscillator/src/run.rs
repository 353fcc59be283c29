//! One run of the fast solver: from phase to phase, over one record at one scale.

use uplift_instructions::Vectors;

use crate::branch::LinearMotion;
use crate::crossings::{Crossing, State};
use crate::free_vibration::{FreePeak, first_peak};
use crate::stumpff::Stumpff;
use crate::sweep::{Peak, Sweep};

/// A state inside a sample interval.
#[derive(Debug, Clone, Copy)]
pub(crate) struct IntervalState {
    pub(crate) interval: usize,
    /// Time since the start of the interval, s; below the sampling interval.
    pub(crate) offset_s: f64,
    pub(crate) u: f64,
    pub(crate) v: f64,
    /// Restoring force per mass, `± η g` to the bit at an event.
    pub(crate) force: f64,
}

/// Where a run stands between events.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Phase {
    Attached(IntervalState),
    Uplifted(f64, IntervalState),
    Overturned,
    /// The record has ended on this side, with this displacement and velocity.
    RecordEnd(f64, f64, f64),
}

impl Phase {
    pub(crate) fn is_over(&self) -> bool {
        matches!(self, Self::Overturned | Self::RecordEnd(..))
    }
}

/// The motion over a sample interval, or the rest of one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    pub(crate) at: IntervalState,
    pub(crate) motion: LinearMotion,
    /// Duration, s.
    pub(crate) h: f64,
    pub(crate) end: State,
}

/// One run, its peak and impacts so far.
///
/// * `STIFFNESS` — whether there is a post-uplift stiffness
#[derive(Debug)]
pub(crate) struct Run<'a, const STIFFNESS: bool> {
    pub(crate) sweep: &'a Sweep<'a>,
    pub(crate) scale: f64,
    pub(crate) peak_m: f64,
    impacts: u32,
}

impl<'a, const STIFFNESS: bool> Run<'a, STIFFNESS> {
    pub(crate) fn new(sweep: &'a Sweep<'a>, scale: f64) -> Self {
        Self { sweep, scale, peak_m: sweep.boundary_m, impacts: 0 }
    }

    /// The phase at the start of `interval`, that of the first uplift.
    pub(crate) fn start(&self, interval: usize) -> Phase {
        let u = self.scale * self.sweep.elastic.displacement_m[interval];
        let v = self.scale * self.sweep.elastic.velocity_m_s[interval];
        Phase::Attached(IntervalState {
            interval,
            offset_s: 0.0,
            u,
            v,
            force: self.sweep.attached.stiffness_per_s2 * u,
        })
    }

    /// From phase to phase to the end of the run.
    #[inline(always)]
    pub(crate) fn follow<V: Vectors>(&mut self, vectors: V, mut phase: Phase) -> Phase {
        while !phase.is_over() {
            phase = match phase {
                Phase::Attached(at) => self.attached(vectors, at),
                Phase::Uplifted(side, at) => self.uplifted(vectors, side, at),
                over => over,
            };
        }
        phase
    }

    /// The peak of a run that is over.
    pub(crate) fn peak(mut self, phase: Phase) -> Peak {
        match phase {
            Phase::Overturned => self.peak_m = f64::INFINITY,
            Phase::RecordEnd(side, u, v) => self.free_vibration(side, u, v),
            Phase::Attached(_) | Phase::Uplifted(..) => {}
        }
        Peak { displacement_m: self.peak_m, impacts: self.impacts }
    }

    /// Acceleration at the start of an interval and its slope there, scaled.
    #[inline(always)]
    fn ground(&self, interval: usize) -> (f64, f64) {
        let a = &self.sweep.ground.acceleration_m_s2;
        let (from, to) = (self.scale * a[interval], self.scale * a[interval + 1]);
        (from, (to - from) * self.sweep.samples_per_s)
    }

    /// The motion from `at` on a branch of stiffness `k`.
    #[inline(always)]
    pub(crate) fn motion(&self, at: &IntervalState, k: f64) -> LinearMotion {
        let (from, slope) = self.ground(at.interval);
        LinearMotion { u0: at.u, v0: at.v, w0: -at.force - (from + slope * at.offset_s), j0: -slope - k * at.v, k }
    }

    /// The state of `motion` at the end of the interval of `at`.
    #[inline(always)]
    pub(crate) fn end_of_interval(&self, motion: &LinearMotion, at: &IntervalState, whole: &Stumpff) -> (f64, f64) {
        if at.offset_s == 0.0 {
            motion.state_with(self.sweep.dt_s, whole)
        } else {
            motion.state(self.sweep.dt_s - at.offset_s)
        }
    }

    /// Acceleration at the end of an interval, scaled.
    #[inline(always)]
    pub(crate) fn ground_end(&self, interval: usize) -> f64 {
        self.scale * self.sweep.ground.acceleration_m_s2[interval + 1]
    }

    #[inline(always)]
    pub(crate) fn uplift(&self, crossing: Crossing, at: &IntervalState) -> Phase {
        let sweep = self.sweep;
        let side = 1.0_f64.copysign(crossing.level);
        let v = side * (side * crossing.v).max(0.0);
        let displaced = IntervalState {
            interval: at.interval,
            offset_s: at.offset_s + crossing.tau,
            u: side * sweep.boundary_m,
            v,
            force: side * sweep.at_boundary_m_s2,
        };
        Phase::Uplifted(side, self.normalised(displaced))
    }

    /// A state at the very end of an interval belongs to the next one.
    #[inline(always)]
    fn normalised(&self, at: IntervalState) -> IntervalState {
        if at.offset_s < self.sweep.dt_s {
            at
        } else {
            IntervalState { interval: at.interval + 1, offset_s: 0.0, ..at }
        }
    }

    #[inline(always)]
    pub(crate) fn impact(&mut self, crossing: Crossing, side: f64, at: &IntervalState) -> Phase {
        let sweep = self.sweep;
        self.impacts += 1;
        Phase::Attached(self.normalised(IntervalState {
            interval: at.interval,
            offset_s: at.offset_s + crossing.tau,
            u: side * sweep.boundary_m,
            v: sweep.restitution * side * (side * crossing.v).min(0.0),
            force: side * sweep.at_boundary_m_s2,
        }))
    }

    fn free_vibration(&mut self, side: f64, u: f64, v: f64) {
        if !self.sweep.with_free_peak {
            return;
        }
        let sweep = self.sweep;
        match first_peak(&sweep.attached, &sweep.uplifted, sweep.boundary_m, sweep.restitution, (side, u, v)) {
            FreePeak::Overturns => self.peak_m = f64::INFINITY,
            FreePeak::At { displacement_m, impacts, .. } => {
                self.impacts += impacts;
                self.peak_m = self.peak_m.max(displacement_m);
            }
        }
    }
}
