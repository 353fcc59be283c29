//! Frames of columns whose flat ends are extended by curved parts (Table 3.1, row 6; Figure 3.5).
//!
//! Both ends of every column carry circular extensions of radius `r`, tangent to the flat part of width `2b` at its
//! corners; the deck rolls on the upper ones. Then the column rolls about a centre of curvature at height `r` and
//! lateral distance `b`, the lever of gravity is `b cos θ − (h − r) sin θ`, and the linearised force vanishes at the
//! rotation `b/(h − r)`:
//!
//! | | row 6 |
//! |---|---|
//! | `m̃` | `(1 + 3γ_m) m/3` |
//! | `f̃_up` | `(m g/2)(1 + 2γ_m) α` |
//! | `ũ_cap` | `2R sin α/(1 − 2ρ)`, at most `2R' sin α'` |
//! | `Γ` | `3(1 + 2γ_m)/(2(1 + 3γ_m))` |
//!
//! with `m` the mass of all columns. The text does not say what `ρ` is; by the derivation above `ρ = r/(2h)` (for
//! slender columns the same as `r/(2R)`), and `R'`, `α'` belong to the column with its extensions, so that `2R' sin α'`
//! is the extended width `2b'`.
//!
//! The bound is not a matter of taste: rolling reaches the end of the extension before the force vanishes exactly if
//! `2b/(1 − 2ρ) > 2b'` (to the order of the linearisation). From there the column rocks about the end of the
//! extension and overturns at `2b'`: the loop is trilinear. Then `ũ_cap = 2b'`, the bilinear loop is the chord of the
//! trilinear one, never above it, and a warning says so. This includes `2ρ ≥ 1`, where the force does not fall at all
//! while the column rolls.

use crate::equivalent::{Conditions, EquivalentSystem};
use crate::error::{StructureError, not_negative, positive};
use crate::frame::Frame;
use crate::warning::Warning;

/// A frame of columns with curved extensions at both ends: row 6. Without a deck and with one column it is a solitary
/// block with a curved base.
///
/// ```
/// use uplift_structure::{Conditions, CurvedFrame, Frame, Geometry};
/// let columns = Geometry::from_width_and_height(1.0, 10.0)?;
/// let frame = Frame::new(columns, 4, 20_000.0, 400_000.0)?;
/// let curved = CurvedFrame::new(frame, 2.5, 2.5)?.equivalent(Conditions::default())?;
/// assert_eq!(curved.capacity()?.capacity_m(), 2.0);
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvedFrame {
    frame: Frame,
    radius_m: f64,
    extended_width_m: f64,
}

impl CurvedFrame {
    /// From the frame with flat ends, the radius of curvature `r` of the extensions, m, and the width `2b'` of a column
    /// end including both extensions, m. Radius 0 is the sharp corner of the free frame.
    ///
    /// # Errors
    /// The radius must be finite and not negative, and the extended width between the flat width and
    /// that plus two radii.
    pub fn new(frame: Frame, curvature_radius_m: f64, extended_width_m: f64) -> Result<Self, StructureError> {
        let radius_m = not_negative("curvature_radius_m", curvature_radius_m, "m")?;
        let extended_width_m = positive("extended_width_m", extended_width_m, "m")?;
        let width_m = frame.geometry().width_m();
        if !(extended_width_m >= width_m && 0.5 * (extended_width_m - width_m) <= radius_m) {
            return Err(StructureError::Extension { extended_width_m, width_m, radius_m });
        }
        Ok(Self { frame, radius_m, extended_width_m })
    }

    /// Ratio `ρ = r/(2h)`.
    pub fn radius_ratio(&self) -> f64 {
        self.radius_m / self.frame.geometry().height_m()
    }

    /// Displacement `2b/(1 − 2ρ)` at which rolling alone loses all force, m; infinite where rolling does
    /// not soften (`2ρ ≥ 1`).
    pub fn rolling_capacity_m(&self) -> f64 {
        let softening = 1.0 - 2.0 * self.radius_ratio();
        if softening > 0.0 { self.frame.geometry().width_m() / softening } else { f64::INFINITY }
    }

    /// Displacement at which rolling reaches the end of the extension, m: `2h asin((b' − b)/r)`.
    pub fn rolling_until_m(&self) -> f64 {
        let length_m = 0.5 * (self.extended_width_m - self.frame.geometry().width_m());
        // a sharp corner has no extension to roll on
        let rotation = if length_m > 0.0 { (length_m / self.radius_m).min(1.0).asin() } else { 0.0 };
        self.frame.geometry().height_m() * rotation
    }

    /// Table 3.1, row 6.
    ///
    /// # Errors
    /// The capacity must exceed the uplift displacement.
    pub fn equivalent(&self, conditions: Conditions) -> Result<EquivalentSystem, StructureError> {
        let rolling_capacity_m = self.rolling_capacity_m();
        let capacity_m = rolling_capacity_m.min(self.extended_width_m);
        let mut system = self.frame.softened(6, capacity_m, 1.0, conditions)?;
        if rolling_capacity_m > self.extended_width_m {
            system.warnings.push(Warning::ExtensionEnds {
                rolling_until_m: self.rolling_until_m(),
                rolling_capacity_m,
                overturning_m: self.extended_width_m,
            });
        }
        Ok(system)
    }
}
