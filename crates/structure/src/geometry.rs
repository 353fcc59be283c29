//! Width, height, slenderness and size of a rectangular block or column (Figures 2.1 and 3.1).

use std::f64::consts::FRAC_PI_2;

use crate::error::{StructureError, positive, representable, require};

/// `(tan α − α)/tan α` above which a body is called stocky: 5 %, `α` about 0.38.
pub const SLENDER_TOLERANCE: f64 = 0.05;

/// Half width `b` and half height `h` of a block, both positive.
///
/// `R = √(b² + h²)` is the distance from a pivot corner to the centre and `α = atan(b/h)` the slenderness, so
/// `2b = 2R sin α` and `2h = 2R cos α`. The text writes `α` for `atan(b/h)` and, in the linearised formulas of Sections
/// 3.5 and 6.3.3, also for `b/h`; here `α` is always the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geometry {
    half_width_m: f64,
    half_height_m: f64,
}

fn checked_slenderness(slenderness_rad: f64) -> Result<f64, StructureError> {
    let holds = slenderness_rad > 0.0 && slenderness_rad < FRAC_PI_2;
    require(holds, "slenderness_rad", slenderness_rad, "rad", "above 0 and below π/2")
}

impl Geometry {
    /// From width `2b` and height `2h`, m.
    ///
    /// # Errors
    /// Both must be finite and positive.
    pub fn from_width_and_height(width_m: f64, height_m: f64) -> Result<Self, StructureError> {
        let width_m = positive("width_m", width_m, "m")?;
        let height_m = positive("height_m", height_m, "m")?;
        Self::usable(0.5 * width_m, 0.5 * height_m)
    }

    /// From slenderness `α`, rad, and size `R` (the semi-diagonal), m.
    ///
    /// # Errors
    /// The slenderness must lie between 0 and π/2, the size must be finite and positive.
    pub fn from_slenderness_and_size(slenderness_rad: f64, size_m: f64) -> Result<Self, StructureError> {
        let (sin, cos) = checked_slenderness(slenderness_rad)?.sin_cos();
        let size_m = positive("size_m", size_m, "m")?;
        Self::usable(size_m * sin, size_m * cos)
    }

    /// From slenderness `α`, rad, and height `2h`, m.
    ///
    /// # Errors
    /// The slenderness must lie between 0 and π/2, the height must be finite and positive.
    pub fn from_slenderness_and_height(slenderness_rad: f64, height_m: f64) -> Result<Self, StructureError> {
        let tangent = checked_slenderness(slenderness_rad)?.tan();
        let height_m = positive("height_m", height_m, "m")?;
        Self::usable(0.5 * height_m * tangent, 0.5 * height_m)
    }

    /// From slenderness `α`, rad, and width `2b`, m.
    ///
    /// # Errors
    /// The slenderness must lie between 0 and π/2, the width must be finite and positive.
    pub fn from_slenderness_and_width(slenderness_rad: f64, width_m: f64) -> Result<Self, StructureError> {
        let tangent = checked_slenderness(slenderness_rad)?.tan();
        let width_m = positive("width_m", width_m, "m")?;
        Self::usable(0.5 * width_m, 0.5 * width_m / tangent)
    }

    /// The geometry, if products of its lengths can be represented.
    fn usable(half_width_m: f64, half_height_m: f64) -> Result<Self, StructureError> {
        Ok(Self {
            half_width_m: representable("the half width of the block, m", half_width_m)?,
            half_height_m: representable("the half height of the block, m", half_height_m)?,
        })
    }

    /// Half width `b`, m.
    pub fn half_width_m(&self) -> f64 {
        self.half_width_m
    }

    /// Half height `h`, m.
    pub fn half_height_m(&self) -> f64 {
        self.half_height_m
    }

    /// Width `2b = 2R sin α`, m.
    pub fn width_m(&self) -> f64 {
        2.0 * self.half_width_m
    }

    /// Height `2h = 2R cos α`, m.
    pub fn height_m(&self) -> f64 {
        2.0 * self.half_height_m
    }

    /// Size `R`: the semi-diagonal, m.
    pub fn size_m(&self) -> f64 {
        self.half_width_m.hypot(self.half_height_m)
    }

    /// Slenderness `α = atan(b/h)`, rad.
    pub fn slenderness_rad(&self) -> f64 {
        self.half_width_m.atan2(self.half_height_m)
    }

    /// `(tan α − α)/tan α`: by how much the linearised uplift force `m g α` falls short of the static `m g tan α`.
    pub fn linearisation_error(&self) -> f64 {
        1.0 - self.slenderness_rad() * self.half_height_m / self.half_width_m
    }
}
