//! The block: its size, its slenderness and what it loses at an impact.

use std::f64::consts::FRAC_PI_2;

use uplift_motion::STANDARD_GRAVITY_M_S2;

use crate::error::{BlockError, slenderness_within, within};

/// A rigid rectangular block of half-width b = R sin α and half-height h = R cos α, free to rock about its corners
/// (Figure 2.1). It neither slides nor leaves the ground.
///
/// # Source
/// Reggiani Manzo, Section 2.2; G. W. Housner (1963), "The behavior of inverted pendulum structures
/// during earthquakes".
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RockingBlock {
    size_m: f64,
    slenderness_rad: f64,
    restitution: f64,
    gravity_m_s2: f64,
}

impl RockingBlock {
    /// A block of size parameter R, half its diagonal \[m\], and slenderness α = atan(b/h) \[rad\], with Housner's
    /// restitution (Eq. 2.3) and standard gravity.
    ///
    /// # Errors
    /// [`BlockError::OutOfRange`] unless 1e-6 m ≤ R ≤ 1e9 m and 1e-6 ≤ α < 0.9553 (54.7°), beyond which Housner's
    /// restitution is negative: such a block does not rock on.
    pub fn new(size_m: f64, slenderness_rad: f64) -> Result<Self, BlockError> {
        let size_m = within("size parameter R", size_m, "m", 1e-6..=1e9, "between 1e-6 m and 1e9 m")?;
        let slenderness_rad = slenderness_within(
            slenderness_rad,
            1e-6..=(2.0_f64 / 3.0).sqrt().asin(),
            "between 1e-6 rad and 0.9553 rad (a stockier block does not rock: Eq. 2.3 is negative)",
        )?;
        let restitution = housner_restitution(slenderness_rad).max(0.0);
        Ok(Self { size_m, slenderness_rad, restitution, gravity_m_s2: STANDARD_GRAVITY_M_S2 })
    }

    /// A block of half-width b and half-height h \[m\].
    ///
    /// # Errors
    /// As [`new`](Self::new), and unless both are finite and above zero.
    pub fn from_half_sides(half_width_m: f64, half_height_m: f64) -> Result<Self, BlockError> {
        let half_width_m = length("half-width b", half_width_m)?;
        let half_height_m = length("half-height h", half_height_m)?;
        Self::new(half_width_m.hypot(half_height_m), half_width_m.atan2(half_height_m))
    }

    /// A block of height 2H \[m\] and slenderness α \[rad\], as in Figure 2.9: R = H/cos α.
    ///
    /// # Errors
    /// As [`new`](Self::new), and unless the height is finite and above zero.
    pub fn from_height(height_m: f64, slenderness_rad: f64) -> Result<Self, BlockError> {
        let block = Self::new(1.0, slenderness_rad)?;
        let size_m = 0.5 * length("height 2H", height_m)? / slenderness_rad.cos();
        Ok(Self { size_m: Self::new(size_m, slenderness_rad)?.size_m, ..block })
    }

    /// The same block with another ratio r of angular velocity after to before an impact.
    ///
    /// # Errors
    /// [`BlockError::OutOfRange`] unless 0 ≤ r ≤ 1.
    pub fn with_restitution(self, restitution: f64) -> Result<Self, BlockError> {
        let restitution =
            within("coefficient of restitution r", restitution, "(pure number)", 0.0..=1.0, "between 0 and 1")?;
        Ok(Self { restitution, ..self })
    }

    /// The same block under another acceleration of gravity \[m/s²\].
    ///
    /// # Errors
    /// [`BlockError::OutOfRange`] unless it is between 1e-3 and 1e4 m/s².
    pub fn with_gravity(self, gravity_m_s2: f64) -> Result<Self, BlockError> {
        let gravity_m_s2 = within("gravity", gravity_m_s2, "m/s2", 1e-3..=1e4, "between 1e-3 and 1e4 m/s2")?;
        Ok(Self { gravity_m_s2, ..self })
    }

    /// Size parameter R, half the diagonal \[m\].
    pub fn size_m(&self) -> f64 {
        self.size_m
    }

    /// Slenderness α \[rad\].
    pub fn slenderness_rad(&self) -> f64 {
        self.slenderness_rad
    }

    /// Half-width b = R sin α \[m\]; 2b is the displacement capacity.
    pub fn half_width_m(&self) -> f64 {
        self.size_m * self.slenderness_rad.sin()
    }

    /// Half-height h = R cos α \[m\].
    pub fn half_height_m(&self) -> f64 {
        self.size_m * self.slenderness_rad.cos()
    }

    /// Ratio r of angular velocity after to before an impact (Eq. 2.3, unless another was given).
    pub fn restitution(&self) -> f64 {
        self.restitution
    }

    /// Acceleration of gravity \[m/s²\].
    pub fn gravity_m_s2(&self) -> f64 {
        self.gravity_m_s2
    }

    /// Frequency parameter p = √(3g/(4R)) \[rad/s\] (Eq. 2.2).
    pub fn frequency_parameter_rad_s(&self) -> f64 {
        (0.75 * self.gravity_m_s2 / self.size_m).sqrt()
    }

    /// Ground acceleration g tan α beyond which a block at rest uplifts \[m/s²\].
    pub fn uplift_acceleration_m_s2(&self) -> f64 {
        self.gravity_m_s2 * self.slenderness_rad.tan()
    }

    /// Horizontal displacement of the top, relative to the ground, at the rotation θ \[m\] (Eq. 2.10).
    ///
    /// The difference of sines is written as a product, which keeps all digits of small rotations.
    pub fn top_displacement_m(&self, rotation_rad: f64) -> f64 {
        let half = 0.5 * rotation_rad.abs();
        (4.0 * self.size_m * half.sin() * (self.slenderness_rad - half).cos()).copysign(rotation_rad)
    }

    /// Rotation at which the top has moved by `displacement_m` ≥ 0 \[rad\], the inverse of Eq. 2.10; infinite of an
    /// infinite displacement.
    pub fn rotation_rad(&self, displacement_m: f64) -> f64 {
        if displacement_m == 0.0 || displacement_m.is_infinite() {
            return displacement_m;
        }
        let sine = self.slenderness_rad.sin() - 0.5 * displacement_m / self.size_m;
        self.slenderness_rad - sine.clamp(-1.0, 1.0).asin()
    }

    /// Whether a block tilted by `tilt_rad` ≥ 0 and moving outward with `rate_rad_s` (inward if negative) never comes
    /// back without further shaking: θ̇ ≥ 2p sin((α − θ)/2).
    ///
    /// That is the separatrix of Eq. 2.1: short of θ = α it says that the kinetic energy carries the block over its
    /// corner, beyond, that it does not suffice to bring it back.
    pub(crate) fn is_lost(&self, tilt_rad: f64, rate_rad_s: f64) -> bool {
        rate_rad_s >= 2.0 * self.frequency_parameter_rad_s() * (0.5 * (self.slenderness_rad - tilt_rad)).sin()
    }
}

/// Housner's coefficient of restitution 1 − (3/2) sin²α (Eq. 2.3).
pub fn housner_restitution(slenderness_rad: f64) -> f64 {
    1.0 - 1.5 * slenderness_rad.sin().powi(2)
}

/// Rotation at which the block lies on its side \[rad\]: nothing is computed beyond.
pub const LYING_RAD: f64 = FRAC_PI_2;

fn length(name: &'static str, value_m: f64) -> Result<f64, BlockError> {
    within(name, value_m, "m", f64::MIN_POSITIVE..=f64::MAX, "finite and above zero")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_ways_to_the_same_block() {
        let block = RockingBlock::new(2.0, 0.3).unwrap();
        let sides = RockingBlock::from_half_sides(block.half_width_m(), block.half_height_m()).unwrap();
        let height = RockingBlock::from_height(2.0 * block.half_height_m(), 0.3).unwrap();
        for other in [sides, height] {
            assert!((other.size_m() - 2.0).abs() < 1e-15);
            assert!((other.slenderness_rad() - 0.3).abs() < 1e-15);
            assert!((other.restitution() - (1.0 - 1.5 * 0.3_f64.sin().powi(2))).abs() < 1e-15);
        }
        assert!((block.frequency_parameter_rad_s().powi(2) - 0.75 * 9.806_65 / 2.0).abs() < 1e-14);
    }

    #[test]
    fn the_top_moves_as_equation_2_10_says() {
        let block = RockingBlock::new(3.0, 0.2).unwrap();
        for rotation in [-1.2_f64, -0.2, -1e-3, 0.0, 0.05, 0.4, 1.5] {
            let alpha = 0.2_f64.copysign(rotation);
            let printed = 6.0 * (alpha.sin() - (alpha - rotation).sin());
            assert!((block.top_displacement_m(rotation) - printed).abs() < 1e-14, "{rotation}");
        }
        for rotation in [0.0_f64, 1e-3, 0.05, 0.4, 1.5] {
            assert!((block.rotation_rad(block.top_displacement_m(rotation)) - rotation).abs() < 1e-14, "{rotation}");
        }
        assert!(block.rotation_rad(f64::INFINITY).is_infinite());
        // all digits of a rotation of which the printed form keeps none
        assert!((block.top_displacement_m(1e-18) / (6.0 * 1e-18 * 0.2_f64.cos()) - 1.0).abs() < 1e-15);
    }

    /// At the separatrix v²/2 + p² cos(α − x) is the p² of the block on its corner.
    #[test]
    fn a_block_is_lost_from_the_energy_of_its_corner_on() {
        let block = RockingBlock::new(2.0, 0.3).unwrap();
        let p = block.frequency_parameter_rad_s();
        for tilt in [0.0, 0.1, 0.299, 0.301, 0.8, 1.5] {
            let inward = if tilt > 0.3 { -1.0 } else { 1.0 };
            let limit = inward * p * (2.0 * (1.0 - (0.3_f64 - tilt).cos())).sqrt();
            let margin = 1e-9 * limit.abs();
            assert!(block.is_lost(tilt, limit + margin) && !block.is_lost(tilt, limit - margin), "{tilt}");
        }
    }

    #[test]
    fn refuses_what_is_no_block() {
        for size in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-7] {
            let message = RockingBlock::new(size, 0.1).unwrap_err().to_string();
            assert!(message.contains(&format!("size parameter R is {size} m")), "{message}");
            assert!(RockingBlock::from_height(size, 0.1).is_err());
            assert!(RockingBlock::from_half_sides(size, 1.0).is_err());
            assert!(RockingBlock::from_half_sides(0.1, size).is_err());
        }
        for alpha in [0.0, -0.1, 0.96, f64::NAN] {
            let message = RockingBlock::new(1.0, alpha).unwrap_err().to_string();
            assert!(message.contains(&format!("slenderness alpha is {alpha} rad")), "{message}");
        }
        // six digits of what sides give, unless these would be within
        for (alpha, shown) in [(1.190_289_949_682_531_7, "1.19029 rad"), (0.999_999_9e-6, "0.0000009999999 rad")] {
            let message = RockingBlock::new(1.0, alpha).unwrap_err().to_string();
            assert!(message.contains(&format!("slenderness alpha is {shown}: ")), "{message}");
        }
        // what is typed is shown as it is
        let message = RockingBlock::new(1_000_000_001.0, 0.1).unwrap_err().to_string();
        assert!(message.contains("R is 1000000001 m: it must be between 1e-6 m and 1e9 m"), "{message}");
        let block = RockingBlock::new(1.0, 0.1).unwrap();
        for bad in [-0.01, 1.01, f64::NAN] {
            assert!(block.with_restitution(bad).unwrap_err().to_string().contains("between 0 and 1"));
        }
        assert!(block.with_gravity(0.0).unwrap_err().to_string().contains("gravity is 0 m/s2"));
    }
}
