//! What can be wrong with a block, a pulse or what is asked of them.

use thiserror::Error;
use uplift_motion::{MotionError, six_digits};

/// Why a block cannot be made, or its motion not be computed.
#[derive(Debug, Error)]
pub enum BlockError {
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
    /// The motion would last too many times the block's own time.
    #[error(
        "{duration_s} s are {ratio:e} times 1/p = {time_s} s, the block's own time: at most {most:e} times are \
         computed; give a shorter motion or a larger block"
    )]
    TooLong {
        /// Duration of the motion, s.
        duration_s: f64,
        /// The block's own time 1/p, s.
        time_s: f64,
        /// The first over the second.
        ratio: f64,
        /// The largest ratio accepted.
        most: f64,
    },
    /// One of the axes of a spectrum has no values.
    #[error("the spectrum has no {axis}: give at least one")]
    Empty {
        /// The axis.
        axis: &'static str,
    },
    /// A pulse cannot be sampled as asked.
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
) -> Result<f64, BlockError> {
    if range.contains(&value) { Ok(value) } else { Err(BlockError::OutOfRange { name, value, unit, requirement }) }
}

/// A slenderness if it is within `range`. Width and height give it sixteen digits; its refusal has six, unless those
/// are within.
pub(crate) fn slenderness_within(
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    requirement: &'static str,
) -> Result<f64, BlockError> {
    let shown = Some(six_digits(value)).filter(|rounded| !range.contains(rounded)).unwrap_or(value);
    if range.contains(&value) { Ok(value) } else { within("slenderness alpha", shown, "rad", range, requirement) }
}
