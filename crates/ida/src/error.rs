//! What can be wrong with a plan, or end an analysis.

use thiserror::Error;
use uplift_block::BlockError;
use uplift_frame::FrameError;
use uplift_instructions::InstructionsError;
use uplift_motion::MotionError;
use uplift_oscillator::OscillatorError;

use crate::plan::{MOST_PEAK_M_S2, MOST_SCALE};

/// Why an incremental dynamic analysis cannot be planned or finished.
#[derive(Debug, Error)]
pub enum IdaError {
    /// One of the three axes of the analysis is empty.
    #[error("the analysis has no {what}: give at least one")]
    Empty {
        /// Records or motions, systems, levels or scale factors.
        what: &'static str,
    },
    /// A level is not positive and finite, or does not exceed the one before.
    #[error("intensity level {index} is {value} after {before}: levels must be positive, finite and ascending")]
    Levels {
        /// Index of the level, from 0.
        index: usize,
        /// Its value, in the unit of the measure.
        value: f64,
        /// The level before, 0 for the first.
        before: f64,
    },
    /// A record whose intensity is zero cannot be scaled to a level.
    #[error("record {record}: its intensity measure is {value}, so it cannot be scaled; leave the record out")]
    Unscalable {
        /// Identifier of the record.
        record: String,
        /// Its intensity measure.
        value: f64,
    },
    /// A motion has not as many scale factors as the first.
    #[error("record {motion}: {count} scale factors, and {expected} of the first motion: all must have as many")]
    Scales {
        /// The motion.
        motion: String,
        /// How many it has.
        count: usize,
        /// How many the first has.
        expected: usize,
    },
    /// A motion that is run at no scale.
    #[error("record {motion}: has no scale factor: leave it out")]
    NoRun {
        /// The motion.
        motion: String,
    },
    /// A scale factor that is not a finite number.
    #[error("record {motion}: its scale factor {index} is {value}: it must be finite")]
    Scale {
        /// The motion.
        motion: String,
        /// Index of the factor, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A scale factor that makes noise of a record, or a motion that no ground has.
    #[error(
        "record {motion}: its scale factor {index} is {value:e}, which makes its largest acceleration {peak_m_s2:e} \
         m/s2: at most {MOST_SCALE:e} and {MOST_PEAK_M_S2:e} m/s2 are allowed; is the unit of the record right?"
    )]
    Implausible {
        /// The motion.
        motion: String,
        /// Index of the factor, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// Largest acceleration of the scaled motion, m/s².
        peak_m_s2: f64,
    },
    /// The arithmetic of a run left the numbers: its peak is NaN, or infinite for a system that cannot overturn.
    #[error(
        "record {motion}, scale factor {scale}, {system}: the displacement comes out as {displacement_m} m, which is \
         not a number: leave the record or the system out, and please report it"
    )]
    NotFinite {
        /// The motion.
        motion: String,
        /// Its scale factor.
        scale: f64,
        /// The system.
        system: String,
        /// What came out, m.
        displacement_m: f64,
    },
    /// The motion does not suit the oscillator.
    #[error("record {motion}: {source}")]
    Oscillator {
        /// The motion.
        motion: String,
        /// What is wrong.
        source: OscillatorError,
    },
    /// The response of a block to a motion is not computed.
    #[error("record {motion}: {source}")]
    Block {
        /// The motion.
        motion: String,
        /// What is wrong.
        source: Box<BlockError>,
    },
    /// The response of a frame to a motion is not computed.
    #[error("record {motion}, scale factor {scale}: {source}")]
    Frame {
        /// The motion.
        motion: String,
        /// Its scale factor.
        scale: f64,
        /// What is wrong.
        source: Box<FrameError>,
    },
    /// Components for other motions than there are.
    #[error("{count} {what} for {expected} motions: each motion needs its own")]
    Beside {
        /// What they are.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many motions there are.
        expected: usize,
    },
    /// Motions under which blocks and frames would leave the ground.
    #[error(
        "{} records have a vertical acceleration that, scaled, is as much as gravity downwards: columns and blocks \
         leave the ground then, which no model here describes; end the levels below these scale factors, or leave the \
         records or their vertical motion out: {}{}",
        falling.len(),
        falling.iter().take(10).cloned().collect::<Vec<_>>().join(", "),
        if falling.len() > 10 { ", …" } else { "" }
    )]
    Falls {
        /// Each with the first scale factor at which it does.
        falling: Vec<String>,
    },
    /// Azimuths that no percentile can be taken of.
    #[error(
        "percentile {percentile} of azimuths: it must be from 0 to 100, every motion needs the same number of \
         azimuths, and a model shaken by both components has none"
    )]
    Azimuths {
        /// The percentile.
        percentile: u8,
    },
    /// Systems that cannot be shared out among the motions.
    #[error("{systems} systems for {motions} motions: each motion needs as many of its own")]
    OwnSystems {
        /// How many systems there are.
        systems: usize,
        /// How many motions there are.
        motions: usize,
    },
    /// A motion that cannot be multiplied so.
    #[error("record {motion}: {source}")]
    Motion {
        /// The motion.
        motion: String,
        /// What is wrong.
        source: Box<MotionError>,
    },
    /// The processor's instructions that were asked for are not to be had.
    #[error(transparent)]
    Instructions(InstructionsError),
    /// The analysis was told to stop.
    #[error("the analysis was interrupted")]
    Cancelled,
}
