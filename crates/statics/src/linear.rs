//! The law for slender columns, linearised (Eq. 5.2–5.7, 6.1 and 6.2).
//!
//! `F = N { (W + e T0/2) b/h + (e² k α b/2 − W) u/2h }` with `e` the openings that the tendon follows, 1 at the column
//! and 2 in the foundation; so
//!
//! `u_cap = 2b (1 + e T0/(2W))/(1 − e² k α b/(2W))`, `k_crit = 2W/(e² α b)`.
//!
//! The text writes `α` for `atan(b/h)` and for `b/h`, and its numbers use both: the difference is 0.6 % in the
//! stiffness of the shake-table specimen. Here `α` is what is given.

use crate::columns::RestrainedColumns;
use crate::error::{StaticsError, not_negative};

/// The linearised columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearLaw {
    half_width_m: f64,
    height_m: f64,
    slenderness_rad: f64,
    columns: f64,
    weight_n: f64,
    top_load_n: f64,
    base_load_n: f64,
    prestress_n: f64,
    openings: f64,
    stiffness_n_m: f64,
    restrained: f64,
}

/// The linearised columns at a displacement.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct LinearState {
    /// Travel `u` of the deck, m.
    pub displacement_m: f64,
    /// Force on the deck, of all columns, N.
    pub force_n: f64,
    /// Force of a restrainer, `T0 + e k α u/2`, N (Eq. 5.4).
    pub tendon_n: f64,
    /// Axial force at the top, `P + T`, N (Eq. 5.5).
    pub top_axial_n: f64,
    /// Moment at the top, `N b`, N m (Eq. 5.6).
    pub top_moment_n_m: f64,
    /// Shear at the top of a restrained column, `F₁ + P u/2h` with `F₁` what it takes of the force, `F/N` where all are
    /// restrained, N (Eq. 5.7).
    pub top_shear_n: f64,
    /// Moment at the base, N m.
    pub base_moment_n_m: f64,
}

impl RestrainedColumns {
    /// The columns linearised, with a restrainer of constant stiffness (N/m) in place of theirs, and `α = atan(b/h)`.
    ///
    /// # Errors
    /// The stiffness must be finite and not negative.
    pub fn linear(&self, stiffness_n_m: f64) -> Result<LinearLaw, StaticsError> {
        let geometry = self.geometry();
        // a list of stiffnesses may be asked for columns that have no restrainer yet
        let restrained = if self.restrained() > 0 { self.restrained() } else { self.columns() };
        Ok(LinearLaw {
            half_width_m: geometry.half_width_m(),
            height_m: geometry.height_m(),
            slenderness_rad: geometry.slenderness_rad(),
            columns: f64::from(self.columns()),
            weight_n: self.weight_n(),
            top_load_n: self.top_load_n(),
            base_load_n: self.top_load_n() + self.column_weight_n(),
            prestress_n: self.restrainer().map_or(0.0, |restrainer| restrainer.parts().prestress_n),
            openings: self.path().openings(),
            stiffness_n_m: not_negative("stiffness_n_m", stiffness_n_m, "N/m")?,
            restrained: f64::from(restrained),
        })
    }

    /// Stiffness of the linear restrainer with which the linearised columns have the displacement capacity of the exact
    /// law, N/m: the one to give to an equivalent oscillator. Stoppers are not counted. Where the exact force does not
    /// vanish before the springs are flat and within four times the slenderness, the two forces agree there; 0 without
    /// a restrainer.
    ///
    /// # Errors
    /// None that the columns themselves did not have.
    pub fn equivalent_stiffness_n_m(&self) -> Result<f64, StaticsError> {
        if self.restrainer().is_none() {
            return Ok(0.0);
        }
        let bare = self.without_stoppers()?;
        let law = LinearLaw { prestress_n: 0.0, ..bare.linear(0.0)? };
        if let Some(capacity) = bare.capacity() {
            return Ok(law.stiffness_for_capacity_n_m(capacity.displacement_m));
        }
        let state = bare.at_rotation(bare.last_searched_rad())?;
        let share = 1.0 - (1.0 - state.force_n / law.uplift_force_n()) * law.width_m() / state.displacement_m;
        Ok(share.max(0.0) * law.critical_stiffness_n_m())
    }
}

impl LinearLaw {
    fn width_m(&self) -> f64 {
        2.0 * self.half_width_m
    }

    /// The same with another `α`, rad: `b/h` where the text takes it for the angle.
    #[must_use]
    pub fn with_slenderness(self, slenderness_rad: f64) -> Self {
        Self { slenderness_rad, ..self }
    }

    /// Force at uplift, N.
    pub fn uplift_force_n(&self) -> f64 {
        let held_n = 0.5 * self.openings * self.restrained * self.prestress_n;
        (self.columns * self.weight_n + held_n) * 2.0 * self.half_width_m / self.height_m
    }

    /// Stiffness after uplift, of all columns, N/m.
    pub fn stiffness_n_m(&self) -> f64 {
        let lever_m = self.slenderness_rad * self.half_width_m;
        let restored_n = 0.5 * self.openings.powi(2) * self.restrained * self.stiffness_n_m * lever_m;
        (restored_n - self.columns * self.weight_n) / self.height_m
    }

    /// Displacement capacity, m (Eq. 5.3); none where the force does not fall.
    pub fn capacity_m(&self) -> Option<f64> {
        let stiffness_n_m = self.stiffness_n_m();
        (stiffness_n_m < 0.0).then(|| -self.uplift_force_n() / stiffness_n_m)
    }

    /// Stiffness of a restrainer at which the force neither falls nor rises, N/m.
    pub fn critical_stiffness_n_m(&self) -> f64 {
        2.0 * self.columns * self.weight_n
            / (self.openings.powi(2) * self.restrained * self.slenderness_rad * self.half_width_m)
    }

    /// Stiffness of a restrainer that gives the columns a displacement capacity (m), N/m; 0 where they have it by
    /// themselves.
    pub fn stiffness_for_capacity_n_m(&self, capacity_m: f64) -> f64 {
        let free_m = self.height_m * self.uplift_force_n() / (self.columns * self.weight_n);
        (1.0 - free_m / capacity_m).max(0.0) * self.critical_stiffness_n_m()
    }

    /// What a restrained column takes of the force, N.
    fn share_n(&self, displacement_m: f64) -> f64 {
        let held_n = 0.5 * self.openings * self.prestress_n;
        let uplift_n = (self.weight_n + held_n) * 2.0 * self.half_width_m / self.height_m;
        let restored_n = 0.5 * self.openings.powi(2) * self.stiffness_n_m * self.slenderness_rad * self.half_width_m;
        uplift_n + (restored_n - self.weight_n) * displacement_m / self.height_m
    }

    /// Everything at a displacement (m); sections are those of a restrained column.
    pub fn at(&self, displacement_m: f64) -> LinearState {
        let force_n = self.uplift_force_n() + self.stiffness_n_m() * displacement_m;
        let tendon_n =
            self.prestress_n + 0.5 * self.openings * self.stiffness_n_m * self.slenderness_rad * displacement_m;
        let top_axial_n = self.top_load_n + tendon_n;
        let through_base_n = if self.openings > 1.0 { tendon_n } else { 0.0 };
        LinearState {
            displacement_m,
            force_n,
            tendon_n,
            top_axial_n,
            top_moment_n_m: top_axial_n * self.half_width_m,
            top_shear_n: self.share_n(displacement_m) + self.top_load_n * displacement_m / self.height_m,
            base_moment_n_m: (self.base_load_n + through_base_n) * self.half_width_m,
        }
    }
}
