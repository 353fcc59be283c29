//! What can be wrong with a frame, its shaking or what is asked of them.

use thiserror::Error;
use uplift_motion::{MotionError, six_digits};
use uplift_statics::StaticsError;
use uplift_structure::StructureError;

/// Why a frame cannot be made, or its motion not be computed.
#[derive(Debug, Error)]
pub enum FrameError {
    /// A number is outside the range that makes physical sense.
    #[error("{name} is {value} {unit}: it must be {requirement}")]
    OutOfRange {
        /// Name of the quantity, without its unit.
        name: &'static str,
        /// The value given.
        value: f64,
        /// Its unit; `(pure number)` where it has none.
        unit: &'static str,
        /// What would be accepted.
        requirement: &'static str,
    },
    /// A column with edges does not wobble.
    #[error(
        "columns of rectangular section turn about an edge and do not wobble: take the planar model, or columns of \
         circular section (`column_shape` = \"cylinder\")"
    )]
    RectangleWobbles,
    /// The ground falls away under the frame.
    #[error(
        "at {time_s:.4} s the vertical acceleration of the ground is {acceleration_m_s2:.3} m/s², as much as gravity \
         downwards: the columns leave the ground, which this model does not describe"
    )]
    Airborne {
        /// When, s.
        time_s: f64,
        /// The vertical ground acceleration, m/s².
        acceleration_m_s2: f64,
    },
    /// The springs are flat, and nothing else yields.
    #[error(
        "at {time_s:.4} s the columns have turned by {rotation_rad:.5} rad, where their springs are flat and stop them \
         (`when_flat` = \"stop\"): what follows is an impact that this model does not describe"
    )]
    SpringsStop {
        /// When, s.
        time_s: f64,
        /// Rotation there, rad.
        rotation_rad: f64,
    },
    /// A frame that loses nothing rattles on.
    #[error(
        "at {time_s:.4} s the frame still rattles at {rotation_rad:e} rad after {steps} steps: it loses no energy; \
         give an amplitude of rest (`rest_amplitude_rad`)"
    )]
    Rattles {
        /// When, s.
        time_s: f64,
        /// Rotation there, rad.
        rotation_rad: f64,
        /// Steps taken.
        steps: u64,
    },
    /// The motion would last too many times the frame's own time.
    #[error(
        "{duration_s} s are {ratio:e} times 1/p = {time_s} s, the frame's own time: at most {most:e} times are computed"
    )]
    TooLong {
        /// Duration of the motion, s.
        duration_s: f64,
        /// The frame's own time 1/p, s.
        time_s: f64,
        /// The first over the second.
        ratio: f64,
        /// The largest ratio accepted.
        most: f64,
    },
    /// Columns or restrainer are wrong.
    #[error(transparent)]
    Statics(#[from] StaticsError),
    /// The geometry of a column is wrong.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// A record is wrong.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// `value` if it is within `range`; NaN never is.
pub(crate) fn within(
    name: &'static str,
    value: f64,
    unit: &'static str,
    range: std::ops::RangeInclusive<f64>,
    requirement: &'static str,
) -> Result<f64, FrameError> {
    if range.contains(&value) { Ok(value) } else { Err(FrameError::OutOfRange { name, value, unit, requirement }) }
}

/// A slenderness if it is within `range`. Width and height give it sixteen digits; its refusal has six, unless those
/// are within.
pub(crate) fn slenderness_within(
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    requirement: &'static str,
) -> Result<f64, FrameError> {
    let shown = Some(six_digits(value)).filter(|rounded| !range.contains(rounded)).unwrap_or(value);
    if range.contains(&value) { Ok(value) } else { within("slenderness alpha", shown, "rad", range, requirement) }
}
