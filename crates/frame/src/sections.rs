//! Forces on the end sections of a column in motion.
//!
//! The deck's own motion gives them: with `m_d = m_b/N` the share of its mass, `a_r` its total acceleration in the
//! direction of the lean and `a_z` upwards, a column carries `P = m_d (g + a_z)` and is pushed by `F₁ = −m_d a_r`. The
//! sections are those of a column at rest under these ([`RestrainedColumns`](uplift_statics::RestrainedColumns)); at
//! the base the column's own mass comes in, whose middle rises half as fast as the deck.

use uplift_statics::{Sections, TendonPath};

use crate::frame::RockingFrame;
use crate::history::HistoryRow;

impl RockingFrame {
    /// Sections of a column (of a restrained one, where there is one) at a moment of a motion of this frame under the
    /// vertical ground acceleration `ground_z_m_s2`: `N = P cos θ − F₁ sin θ + T`, `V = F₁ cos θ + P sin θ` in the
    /// plane of the lean and `M = N b` at the top; `N` and `M = N b` at the base. None of a frame that stands upright:
    /// its sections are closed, and their moment is not `N b`.
    ///
    /// # Source
    /// Reggiani Manzo, Section 6.2 and Eq. 5.5 to 5.7, with the forces of the motion in place of the static ones.
    pub fn sections(&self, row: &HistoryRow, ground_z_m_s2: f64) -> Option<Sections> {
        if row.rotation_rad == 0.0 {
            return None;
        }
        let columns = self.columns();
        let rotation = row.rotation_rad.abs();
        let (sin, cos) = rotation.sin_cos();
        let (sin_lean, cos_lean) = row.direction_rad.sin_cos();
        let lever_m = self.geometry().half_width_m();
        let deck_kg = self.deck_mass_kg() / f64::from(columns.columns());
        let radial_m_s2 = row.deck_acceleration_x_m_s2 * cos_lean + row.deck_acceleration_y_m_s2 * sin_lean;
        let load_n = deck_kg * (self.gravity_m_s2() + row.deck_acceleration_z_m_s2);
        // where only some columns are restrained, these carry all that the restrainers add
        let angle = self.geometry().slenderness_rad() - rotation;
        let held_n =
            row.tendon_n * columns.elongation(rotation).rate_m / (2.0 * self.geometry().size_m() * angle.cos());
        let unrestrained = 1.0 - f64::from(columns.restrained()) / f64::from(columns.columns());
        let push_n = -deck_kg * radial_m_s2 + unrestrained * held_n;
        let through_base_n = match columns.path() {
            TendonPath::Foundation => row.tendon_n,
            TendonPath::Column | TendonPath::Shifted { .. } => 0.0,
        };
        let middle_m_s2 = 0.5 * (row.deck_acceleration_z_m_s2 + ground_z_m_s2);
        let top_axial_n = load_n * cos - push_n * sin + row.tendon_n;
        let base_axial_n = load_n + self.column_mass_kg() * (self.gravity_m_s2() + middle_m_s2) + through_base_n;
        Some(Sections {
            top_axial_n,
            top_moment_n_m: top_axial_n * lever_m,
            top_shear_n: push_n * cos + load_n * sin,
            base_axial_n,
            base_moment_n_m: base_axial_n * lever_m,
        })
    }
}
