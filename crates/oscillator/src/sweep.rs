//! One oscillator under one record at many scales: the fast solver behind an incremental dynamic analysis.
//!
//! It solves the same piecewise-linear problem as the [reference](mod@crate::reference) without an approximation, and
//! differs from it by rounding alone. What makes it fast:
//!
//! * up to the first uplift the response is the elastic one times the scale, computed once;
//! * attached again, it differs from that by a free vibration, a vector that rotates by known angles; uplifted without
//!   stiffness, the motion follows from the [integrals of the record](crate::ground_motion), with stiffness from the
//!   response of that branch from rest. So sixteen samples ahead are evaluated together, and most hold no event;
//! * several runs go from event to event side by side, each at its own time, and their events are found together in
//!   vectors; what is not simple is found run by run: by Newton's method where convexity makes the root unique, by the
//!   nodes of the motion elsewhere.

use uplift_instructions::Instructions;

use crate::ahead::{AHEAD, Lanes};
use crate::branch::Branch;
use crate::elastic::ElasticResponse;
use crate::ground_motion::GroundMotion;
use crate::instructions::follow;
use crate::nonzero_stiffness::NonzeroStiffnessBranch;
use crate::oscillator::Oscillator;
use crate::reference::OVERTURNED_CAPACITIES;
use crate::side_by_side::PendingRun;
use crate::stumpff::Stumpff;

/// What a bound leaves to rounding, of itself.
const ROUNDING: f64 = 1e-9;

/// What an incremental dynamic analysis keeps of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Largest `abs(u)`, m: `+∞` if the system overturned.
    pub displacement_m: f64,
    /// Impacts up to the end of the run.
    pub impacts: u32,
}

/// The angles by which a free vibration rotates in `1, 2, …` samples.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct Rotations {
    pub(crate) cos: Lanes,
    pub(crate) sin: Lanes,
}

impl Rotations {
    fn new(phase: f64) -> Self {
        let mut rotations = Self { cos: [1.0; AHEAD], sin: [0.0; AHEAD] };
        for (samples, (cos, sin)) in (1_u32..).zip(rotations.cos.iter_mut().zip(&mut rotations.sin)) {
            (*sin, *cos) = (phase * f64::from(samples)).sin_cos();
        }
        rotations
    }
}

/// One oscillator and one record, ready for any number of scales.
#[derive(Debug)]
pub struct Sweep<'a> {
    pub(crate) ground: &'a GroundMotion<'a>,
    pub(crate) elastic: ElasticResponse,
    pub(crate) attached: Branch,
    pub(crate) uplifted: Branch,
    /// None without post-uplift stiffness, or where motions grow too fast to be evaluated far ahead.
    pub(crate) nonzero_stiffness: Option<NonzeroStiffnessBranch>,
    pub(crate) boundary_m: f64,
    pub(crate) at_boundary_m_s2: f64,
    pub(crate) restitution: f64,
    /// Displacement beyond which the system has overturned, m.
    pub(crate) overturned_m: f64,
    /// Angular frequency while attached, 1/s.
    pub(crate) omega: f64,
    pub(crate) with_free_peak: bool,
    pub(crate) dt_s: f64,
    pub(crate) samples_per_s: f64,
    pub(crate) whole_attached: Stumpff,
    /// Deviation from the chord between samples, while attached, over the largest acceleration at their ends, s²; NaN
    /// where the samples are too far apart for such a bound.
    pub(crate) sag_factor: f64,
    /// Where the displacement at samples is at most this times `boundary − sag_factor a`, and the ground's acceleration
    /// at most `a`, it stays inside the boundaries between them too: its acceleration is at most `k` times as much and
    /// `a`. NaN as `sag_factor`.
    pub(crate) quiet_factor: f64,
    /// See [`growth`].
    pub(crate) growth: f64,
    pub(crate) rotations: Rotations,
    /// Terms of the series that suffice for a whole interval while attached; none where the runs are
    /// followed one by one.
    pub(crate) terms: Option<usize>,
}

impl<'a> Sweep<'a> {
    /// Prepare the runs of `oscillator` under `ground`.
    ///
    /// * `with_free_peak` — whether the first peak of the free vibration after the record counts
    pub fn new(oscillator: &Oscillator, ground: &'a GroundMotion<'a>, with_free_peak: bool) -> Self {
        let (attached, uplifted) = (oscillator.attached(), oscillator.uplifted());
        let dt_s = ground.excitation.dt_s();
        let omega = attached.stiffness_per_s2.sqrt();
        let growth = growth(omega * dt_s);
        let sag_factor = 0.125 * dt_s * dt_s * growth;
        Self {
            ground,
            elastic: ElasticResponse::new(&attached, ground, with_free_peak && !oscillator.is_free_mass()),
            attached,
            uplifted,
            nonzero_stiffness: NonzeroStiffnessBranch::new(uplifted, ground),
            boundary_m: oscillator.boundary_m(),
            at_boundary_m_s2: oscillator.uplift_acceleration_m_s2(),
            restitution: oscillator.restitution(),
            overturned_m: OVERTURNED_CAPACITIES * oscillator.capacity_m(),
            omega,
            sag_factor,
            quiet_factor: (1.0 - ROUNDING) / (1.0 + sag_factor * attached.stiffness_per_s2),
            growth,
            with_free_peak,
            dt_s,
            samples_per_s: dt_s.recip(),
            whole_attached: Stumpff::at(attached.stiffness_per_s2 * dt_s * dt_s),
            rotations: Rotations::new(omega * dt_s),
            terms: Stumpff::terms(omega * omega * dt_s * dt_s).filter(|_| omega > 0.0 && growth.is_finite()),
        }
    }

    /// The peak under the record times `scale`, which multiplies the excitation's own.
    pub fn peak(&self, scale: f64) -> Peak {
        self.peaks(&[scale])[0]
    }

    /// The peaks under the record times each of `scales`, which multiply the excitation's own: the same bits
    /// as one by one, in less time.
    pub fn peaks(&self, scales: &[f64]) -> Vec<Peak> {
        self.peaks_with(Instructions::chosen(), scales)
    }

    /// As [`peaks`](Self::peaks), with some of the processor's instructions.
    pub(crate) fn peaks_with(&self, instructions: Instructions, scales: &[f64]) -> Vec<Peak> {
        let mut peaks = Vec::with_capacity(scales.len());
        let mut pending = Vec::with_capacity(scales.len());
        for (index, scale) in scales.iter().enumerate() {
            let scale = scale * self.ground.excitation.scale();
            let elastic_peak_m = if scale == 0.0 { 0.0 } else { scale.abs() * self.elastic.peak_m };
            // no force holds a free mass back, and it may still go too far
            let overturned = elastic_peak_m > self.overturned_m;
            peaks.push(Peak { displacement_m: if overturned { f64::INFINITY } else { elastic_peak_m }, impacts: 0 });
            if elastic_peak_m > self.boundary_m
                && let Some(interval) = self.elastic.first_interval_above(self.boundary_m / scale.abs())
            {
                pending.push(PendingRun { index, scale, interval });
            }
        }
        // empty lanes cost as much as full ones
        match (self.uplifted.stiffness_per_s2 != 0.0, pending.len()) {
            (_, 0) => {}
            (false, 1) => follow::<1, false>(instructions, self, &pending, &mut peaks),
            (false, 2..=6) => follow::<4, false>(instructions, self, &pending, &mut peaks),
            (false, _) => follow::<8, false>(instructions, self, &pending, &mut peaks),
            (true, 1..=6) => follow::<1, true>(instructions, self, &pending, &mut peaks),
            (true, _) => follow::<8, true>(instructions, self, &pending, &mut peaks),
        }
        peaks
    }
}

/// How far the acceleration between samples may exceed its ends, over an attached interval of the `phase` `ω dt`: it is
/// a sine of time, of which no arc between two ends is higher than `1/cos(phase/2)` times the higher end. NaN where the
/// samples are too far apart for such a bound.
pub(crate) fn growth(phase: f64) -> f64 {
    if phase < 3.0 { (0.5 * phase).cos().recip() } else { f64::NAN }
}
