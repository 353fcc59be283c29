//! The response of a block to an excitation, and free rocking.

use std::ops::ControlFlow;

use uplift_taylor::Forcing;

use crate::block::{LYING_RAD, RockingBlock};
use crate::error::{BlockError, within};
use crate::excitation::Excitation;
use crate::motion::{Ending, Motion};
use crate::observer::{History, Moment, Observer, Unobserved};
use crate::rest::RestRule;
use crate::series::Series;

/// Longest motion computed, in units of 1/p.
const LONGEST_MOTION: f64 = 1e7;

/// How long the block is followed once the ground has come to rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum FreeRocking {
    /// Until its first peak, after which none is larger.
    #[default]
    FirstPeak,
    /// For a time, or until it rests or overturns.
    Lasting {
        /// The time \[s\].
        duration_s: f64,
    },
}

/// Whether a block overturns, and how: the two modes of Zhang & Makris (2001).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Overturning {
    /// It does not.
    None,
    /// Before any impact.
    WithoutImpact,
    /// After one impact or more.
    AfterImpact,
}

/// Peak response of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockResponse {
    /// Largest |θ| \[rad\]; +∞ if the block overturns, 0 if it never uplifts.
    pub rotation_rad: f64,
    /// Largest |u| of the top \[m\] (Eq. 2.10); +∞ if the block overturns.
    pub displacement_m: f64,
    /// When it is reached \[s\], on the clock of the excitation; of an overturned block, when it lies
    /// or is lost for certain.
    pub time_s: f64,
    /// When the block first uplifts \[s\]; none if it never does, or was released from a tilt.
    pub uplift_s: Option<f64>,
    /// Impacts, up to the end of the motion that is computed; of the infinitely many before a rest, those
    /// until it was certain.
    pub impacts: u64,
    /// Whether the block overturns.
    pub overturning: Overturning,
    /// Whether a nearly elastic block that rebounded 100,000 times in one segment of the excitation was put to rest.
    pub chatter_was_cut: bool,
}

impl BlockResponse {
    /// What came of a motion that `ending` ended, if not time.
    pub(crate) fn from_motion<O: Observer>(motion: &Motion<'_, O>, ending: Option<Ending>) -> Self {
        let is_overturned = ending == Some(Ending::Overturned);
        Self {
            rotation_rad: motion.peak,
            displacement_m: if is_overturned { f64::INFINITY } else { motion.block.top_displacement_m(motion.peak) },
            time_s: motion.peak_s,
            uplift_s: motion.uplift_s,
            impacts: motion.impacts,
            overturning: match (is_overturned, motion.impacts) {
                (false, _) => Overturning::None,
                (true, 0) => Overturning::WithoutImpact,
                (true, _) => Overturning::AfterImpact,
            },
            chatter_was_cut: motion.was_cut,
        }
    }

    /// Whether the block overturns.
    pub fn is_overturned(&self) -> bool {
        self.overturning != Overturning::None
    }
}

/// Response of `block`, at rest before, to `excitation`: Eq. 2.1 between impacts, Eq. 2.3 at them,
/// uplift at |üg| > g tan α.
///
/// The block overturns if |θ| reaches π/2 while the ground moves (it then lies on its side; short of that it may come
/// back, also from beyond α), or if, with the ground at rest, its energy and direction say that it will not come back.
///
/// # Errors
/// [`BlockError::TooLong`] for motions of more than 1e7/p, [`BlockError::OutOfRange`] for ground accelerations beyond
/// 1e6 m/s² and a negative or infinite time of free rocking.
///
/// # Source
/// Reggiani Manzo, Section 2.2, Eq. 2.1–2.3 and 2.10.
pub fn respond<'a>(
    block: &RockingBlock,
    excitation: impl Into<Excitation<'a>>,
    free: FreeRocking,
) -> Result<BlockResponse, BlockError> {
    run(block, Some(excitation.into()), 0.0, free, RestRule::Proven, Unobserved).map(|(response, _)| response)
}

/// The same, with the motion in time: a row at every sample (every sixteenth of a pulse's period, every 0.5/p of free
/// rocking), uplift, impact and rest.
///
/// # Errors
/// As [`respond`].
pub fn respond_with_history<'a>(
    block: &RockingBlock,
    excitation: impl Into<Excitation<'a>>,
    free: FreeRocking,
) -> Result<(BlockResponse, History), BlockError> {
    run(block, Some(excitation.into()), 0.0, free, RestRule::Proven, History::default())
}

/// Free rocking of `block`, let go from the tilt `rotation_rad` at time zero, for `duration_s` or until
/// it rests or overturns.
///
/// # Errors
/// As [`respond`], and unless the tilt is less than π/2 to either side.
pub fn rock_freely(
    block: &RockingBlock,
    rotation_rad: f64,
    duration_s: f64,
) -> Result<(BlockResponse, History), BlockError> {
    within("initial rotation", rotation_rad, "rad", -LYING_RAD..=LYING_RAD, "between -pi/2 and pi/2 rad")?;
    run(block, None, rotation_rad, FreeRocking::Lasting { duration_s }, RestRule::Proven, History::default())
}

pub(crate) fn run<O: Observer>(
    block: &RockingBlock,
    excitation: Option<Excitation<'_>>,
    rotation_rad: f64,
    free: FreeRocking,
    rest_rule: RestRule,
    observer: O,
) -> Result<(BlockResponse, O), BlockError> {
    excitation.map_or(Ok(()), |excitation| excitation.check())?;
    check_duration(block, excitation.map_or(0.0, |excitation| excitation.duration_s()), free)?;
    let mut motion = Motion::new(block, rest_rule, observer);
    motion.release(rotation_rad);
    let ending = follow(&mut motion, excitation, free);
    Ok((BlockResponse::from_motion(&motion, ending), motion.observer))
}

/// Refuses motions that last too many times the block's own time.
pub(crate) fn check_duration(block: &RockingBlock, shaken_s: f64, free: FreeRocking) -> Result<(), BlockError> {
    let free_s = match free {
        FreeRocking::FirstPeak => 0.0,
        FreeRocking::Lasting { duration_s } => {
            within("time of free rocking", duration_s, "s", 0.0..=f64::MAX, "finite and not negative")?
        }
    };
    let p = block.frequency_parameter_rad_s();
    let (duration_s, time_s) = (shaken_s + free_s, 1.0 / p);
    let ratio = duration_s * p;
    if ratio <= LONGEST_MOTION {
        Ok(())
    } else {
        Err(BlockError::TooLong { duration_s, time_s, ratio, most: LONGEST_MOTION })
    }
}

/// Shaking, then free rocking; what ended it, if not time.
fn follow<O: Observer>(
    motion: &mut Motion<'_, O>,
    excitation: Option<Excitation<'_>>,
    free: FreeRocking,
) -> Option<Ending> {
    let (mut end_s, mut series) = (0.0, Series::EMPTY);
    if let Some(excitation) = excitation {
        let (start_s, length_s) = (excitation.start_s(), excitation.segment_s());
        motion.observe(start_s, Moment::Sample);
        for segment in 0..excitation.segments() {
            let begin_s = start_s + segment as f64 * length_s;
            let shaking = |offset, step, forcing: &mut Forcing| excitation.shake(segment, offset, step, forcing);
            if let ControlFlow::Break(ending) = motion.advance(&mut series, begin_s, length_s, false, shaking) {
                return Some(ending);
            }
            motion.observe(start_s + (segment + 1) as f64 * length_s, Moment::Sample);
        }
        end_s = start_s + excitation.segments() as f64 * length_s;
    } else {
        motion.observe(0.0, Moment::Sample);
    }
    rock_on(motion, &mut series, end_s, free)
}

/// Free rocking from `end_s` on; what ended it, if not time.
pub(crate) fn rock_on<O: Observer>(
    motion: &mut Motion<'_, O>,
    series: &mut Series,
    end_s: f64,
    free: FreeRocking,
) -> Option<Ending> {
    let (until_peak, last_s) = match free {
        FreeRocking::FirstPeak => (true, f64::INFINITY),
        FreeRocking::Lasting { duration_s } => (false, duration_s),
    };
    let step_s = motion.longest_step_s();
    let mut steps = 0.0;
    loop {
        let begin_s = steps * step_s;
        if motion.is_lost() {
            return Some(motion.overturn(end_s + begin_s.min(last_s)));
        }
        if motion.resting || begin_s >= last_s {
            return None;
        }
        let length_s = step_s.min(last_s - begin_s);
        if let ControlFlow::Break(ending) =
            motion.advance(series, end_s + begin_s, length_s, until_peak, |_, _, forcing| forcing.set_none())
        {
            return Some(ending);
        }
        motion.observe(end_s + begin_s + length_s, Moment::Sample);
        steps += 1.0;
    }
}
