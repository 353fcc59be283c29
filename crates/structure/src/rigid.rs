//! The solitary block that rotates exactly as a rigid structure does, with no small-angle simplification.
//!
//! A body that pivots about its corners obeys `I_o θ̈ + m g R sin(α − θ) = −m ü_g R cos(α − θ)`, which depends on the
//! body by `α` and `I_o/(m R)` alone. That is Eq. 2.1 of a rectangular block of the same slenderness and the size
//! parameter `R_b = (3/4) I_o/(m R)`. A frame of columns under a deck obeys the same equation (Makris and Vassiliou
//! 2013, Section 2.4.3).
//!
//! An impact conserves the angular momentum about the next pivot; for the frame, of each column with the impulse that
//! the deck hands to its new corner:
//!
//! | structure | `R_b` | `θ̇` after over before an impact |
//! |---|---|---|
//! | point mass | `(3/4) R` | `1 − 2 sin²α` |
//! | rectangular block | `R` | `1 − (3/2) sin²α` (Eq. 2.3) |
//! | body of inertia `I_o` about the pivot | `(3/4) I_o/(m R)` | `1 − 2 (m R²/I_o) sin²α` |
//! | frame | `R (1 + 3γ_m)/(1 + 2γ_m)` | `1 − (3/2) sin²α (1 + 4γ_m)/(1 + 3γ_m)` |
//!
//! Tendons and curved ends add terms that no solitary block has: such structures have no equivalent here.

use crate::block::{Block, Body, PointMass};
use crate::description::{Kind, StructureDescription};
use crate::error::StructureError;
use crate::frame::Frame;
use crate::geometry::Geometry;

/// A solitary rectangular block, by what its rotation depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotatingBlock {
    /// Size parameter `R_b`: half the diagonal, m.
    pub size_m: f64,
    /// Slenderness `α`, rad: that of the structure.
    pub slenderness_rad: f64,
    /// Angular velocity after over before an impact, by conservation of angular momentum; 0 where
    /// that would be negative.
    pub restitution: f64,
}

impl RotatingBlock {
    /// * `size_ratio` — `R_b/R`
    /// * `loss` — `(1 − r)/sin²α`
    fn from_geometry(geometry: &Geometry, size_ratio: f64, loss: f64) -> Self {
        let slenderness_rad = geometry.slenderness_rad();
        let restitution = (1.0 - loss * slenderness_rad.sin().powi(2)).max(0.0);
        Self { size_m: size_ratio * geometry.size_m(), slenderness_rad, restitution }
    }
}

impl PointMass {
    /// The block that rotates as this mass on its massless body.
    pub fn rotating_block(&self) -> RotatingBlock {
        RotatingBlock::from_geometry(&self.geometry, 0.75, 2.0)
    }
}

impl Block {
    /// The block itself.
    pub fn rotating_block(&self) -> RotatingBlock {
        RotatingBlock::from_geometry(&self.geometry, 1.0, 1.5)
    }
}

impl Body {
    /// The block that rotates as this body.
    pub fn rotating_block(&self) -> RotatingBlock {
        RotatingBlock::from_geometry(&self.geometry, 0.75 * self.inertia_ratio, 2.0 / self.inertia_ratio)
    }
}

impl Frame {
    /// The block that rotates as the columns of this frame.
    pub fn rotating_block(&self) -> RotatingBlock {
        let size_ratio = self.equivalent_block_height_m() / self.geometry().height_m();
        RotatingBlock::from_geometry(self.geometry(), size_ratio, self.impact_loss())
    }
}

impl StructureDescription {
    /// The solitary block that rotates exactly as this structure; none for one with tendons or curved ends.
    ///
    /// # Errors
    /// A mistake of the description, which [`resolve`](Self::resolve) lists with all others.
    pub fn rotating_block(&self) -> Result<Option<RotatingBlock>, StructureError> {
        Ok(match self.kind {
            Kind::PointMass => Some(self.point_mass()?.rotating_block()),
            Kind::Block => Some(self.block()?.rotating_block()),
            Kind::Body => Some(self.body()?.rotating_block()),
            Kind::Frame => Some(self.frame()?.rotating_block()),
            Kind::RestrainedFrame | Kind::CurvedFrame => None,
        })
    }
}
