//! Equal columns that rock under a deck, all or some of them held by a restrainer.
//!
//! With `P` the load on the top of a column, `m_c g` its weight and `W = P + m_c g/2`, virtual work gives, for any
//! restrainer `T(Δ)` and any path `Δ(θ)`, the force on the deck
//!
//! `F(θ) = N { W tan(α − θ) + T(Δ) Δ'/(2R cos(α − θ)) }`,
//!
//! which is Eq. 5.1 for a linear restrainer at the column's foot and Eq. A2.5 for a shifted one. It is `dV/du` of
//! `V = N { W v(θ) + E(Δ(θ)) }`.
//!
//! The sections of a restrained column, in its own axes: at the top `N = P cos θ − F₁ sin θ + T`,
//! `V = F₁ cos θ + P sin θ` and `M = N b` with `F₁` its share of the force (Eq. 5.5–5.7 for small angles, where
//! `F1 + F2` must be read as `P`); at the base `N = P + m_c g`, more by `T` where the tendon is anchored in the
//! foundation, and `M = N b`.

use uplift_structure::Geometry;

use crate::error::{StaticsError, not_negative, positive, require};
use crate::parts::Parts;
use crate::path::{Elongation, TendonPath};
use crate::restrainer::Restrainer;
use crate::tilt::{largest_rotation_rad, rise_m, rotation_rad, travel_m};

/// Columns, what they carry and what holds them.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainedColumns {
    geometry: Geometry,
    columns: u32,
    top_load_n: f64,
    column_weight_n: f64,
    path: TendonPath,
    restrainer: Option<Restrainer>,
    restrained: u32,
}

/// Columns and restrainers at a rotation.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct PushoverState {
    /// Travel `u` of the deck, m.
    pub displacement_m: f64,
    /// Drift ratio `u/2h`.
    pub drift: f64,
    /// Rotation `θ` of the columns, rad.
    pub rotation_rad: f64,
    /// Force `F` on the deck, of all columns, N.
    pub force_n: f64,
    /// Rise `v` of the deck, m.
    pub rise_m: f64,
    /// Potential energy of weights and restrainers against that at rest, J.
    pub energy_j: f64,
    /// Elongation `Δ` of a restrainer, m.
    pub elongation_m: f64,
    /// Force `T` of a restrainer, N.
    pub tendon_n: f64,
    /// Deformation `d` of its springs, m.
    pub spring_m: Option<f64>,
    /// Sections of a column: of a restrained one, where there is one.
    #[serde(flatten)]
    pub sections: Sections,
}

/// Forces on the end sections of a column.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Sections {
    /// Axial force at the top, compression, N.
    pub top_axial_n: f64,
    /// Moment at the top, N m.
    pub top_moment_n_m: f64,
    /// Shear at the top, N.
    pub top_shear_n: f64,
    /// Axial force at the base, compression, N.
    pub base_axial_n: f64,
    /// Moment at the base, N m.
    pub base_moment_n_m: f64,
}

impl RestrainedColumns {
    /// Columns without restrainers, from the geometry of a column, their number, the load `P` on the top of each (N)
    /// and the weight `m_c g` of each (N).
    ///
    /// # Errors
    /// There must be a column and a load or weight; both must be finite and not negative.
    pub fn new(geometry: Geometry, columns: u32, top_load_n: f64, column_weight_n: f64) -> Result<Self, StaticsError> {
        require(columns >= 1, "columns", f64::from(columns), "", "at least 1")?;
        not_negative("top_load_n", top_load_n, "N")?;
        not_negative("column_weight_n", column_weight_n, "N")?;
        positive("top_load_n", top_load_n + 0.5 * column_weight_n, "N")?;
        let path = TendonPath::Column;
        Ok(Self { geometry, columns, top_load_n, column_weight_n, path, restrainer: None, restrained: 0 })
    }

    /// The same with a restrainer in every column.
    ///
    /// # Errors
    /// The path must go with the column: [`TendonPath::checked`].
    pub fn with_restrainer(self, restrainer: Restrainer, path: TendonPath) -> Result<Self, StaticsError> {
        let path = path.checked(&self.geometry)?;
        Ok(Self { path, restrained: self.columns, restrainer: Some(restrainer), ..self })
    }

    /// The same loads and restrainers with columns of another geometry.
    ///
    /// # Errors
    /// The path must go with the column: [`TendonPath::checked`].
    pub fn with_geometry(self, geometry: Geometry) -> Result<Self, StaticsError> {
        Ok(Self { path: self.path.checked(&geometry)?, geometry, ..self })
    }

    /// The same with another law of the restrainers, on the same path.
    pub(crate) fn with_law(self, restrainer: Restrainer) -> Self {
        Self { restrainer: Some(restrainer), ..self }
    }

    /// The same with a restrainer in some of the columns only: after the loss of a tendon, for instance.
    ///
    /// # Errors
    /// There cannot be more than there are columns.
    pub fn with_restrained(self, restrained: u32) -> Result<Self, StaticsError> {
        if restrained > self.columns {
            return Err(StaticsError::Restrained { restrained, columns: self.columns });
        }
        Ok(Self { restrained, ..self })
    }

    /// Geometry of a column.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Number of columns `N`.
    pub fn columns(&self) -> u32 {
        self.columns
    }

    /// Columns that have a restrainer.
    pub fn restrained(&self) -> u32 {
        self.restrained
    }

    /// Load `P` on the top of a column, N.
    pub fn top_load_n(&self) -> f64 {
        self.top_load_n
    }

    /// Weight of a column, N.
    pub fn column_weight_n(&self) -> f64 {
        self.column_weight_n
    }

    /// `W = P + m_c g/2` of a column, N.
    pub fn weight_n(&self) -> f64 {
        self.top_load_n + 0.5 * self.column_weight_n
    }

    /// Path of the tendons.
    pub fn path(&self) -> TendonPath {
        self.path
    }

    /// The restrainer of a restrained column.
    pub fn restrainer(&self) -> Option<&Restrainer> {
        self.restrainer.as_ref().filter(|_| self.restrained > 0)
    }

    /// The same without stoppers: they are a reserve, which a design does not count upon.
    ///
    /// # Errors
    /// None that the restrainer itself did not have.
    pub fn without_stoppers(&self) -> Result<Self, StaticsError> {
        let Some(restrainer) = &self.restrainer else { return Ok(self.clone()) };
        let bare = Restrainer::new(Parts { stopper: None, ..*restrainer.parts() })?;
        Ok(self.clone().with_law(bare))
    }

    /// Elongation of a restrainer at a rotation (rad).
    pub fn elongation(&self, rotation_rad: f64) -> Elongation {
        self.path.at(&self.geometry, rotation_rad)
    }

    /// Force at which the columns uplift, `F(0⁺) = N W b/h + N T0 Δ'(0)/2h`, N.
    pub fn uplift_force_n(&self) -> f64 {
        let tangent = self.geometry.half_width_m() / self.geometry.half_height_m();
        let prestress_n = self.restrainer().map_or(0.0, |restrainer| restrainer.parts().prestress_n);
        let held_n = 0.5 * self.path.openings() * f64::from(self.restrained) * prestress_n;
        (f64::from(self.columns) * self.weight_n() + held_n) * tangent
    }

    /// The last rotation that the law describes: where the springs stop the column, else a quarter turn, rad.
    pub fn last_rotation_rad(&self) -> f64 {
        let quarter = std::f64::consts::FRAC_PI_2.min(largest_rotation_rad(&self.geometry));
        let limit_m = self.restrainer().and_then(Restrainer::limit_m);
        limit_m.and_then(|limit_m| self.rotation_at_elongation_rad(limit_m)).map_or(quarter, |rad| rad.min(quarter))
    }

    /// The rotation at which the elongation is `elongation_m` (m), rad; none within a quarter turn.
    pub fn rotation_at_elongation_rad(&self, elongation_m: f64) -> Option<f64> {
        let quarter = std::f64::consts::FRAC_PI_2;
        let excess_m = |rotation: f64| self.elongation(rotation).elongation_m - elongation_m;
        if elongation_m < 0.0 || excess_m(quarter) < 0.0 {
            return None;
        }
        Some(crate::root::bisect(0.0, quarter, excess_m))
    }

    /// Everything at a rotation `θ` (rad).
    ///
    /// # Errors
    /// [`StaticsError::BeyondFlat`] beyond [`last_rotation_rad`](Self::last_rotation_rad).
    pub fn at_rotation(&self, rotation_rad: f64) -> Result<PushoverState, StaticsError> {
        let displacement_m = travel_m(&self.geometry, rotation_rad);
        self.state(rotation_rad, displacement_m)
    }

    /// Everything at a travel `u` (m) of the deck.
    ///
    /// # Errors
    /// The travel must be within the column's reach and before the springs stop it.
    pub fn at_displacement(&self, displacement_m: f64) -> Result<PushoverState, StaticsError> {
        self.state(rotation_rad(&self.geometry, displacement_m)?, displacement_m)
    }

    fn state(&self, rotation: f64, displacement_m: f64) -> Result<PushoverState, StaticsError> {
        let geometry = &self.geometry;
        let Elongation { elongation_m, rate_m } = self.elongation(rotation);
        let restrainer = self.restrainer().map(|restrainer| restrainer.at(elongation_m)).transpose();
        let restrainer = restrainer.map_err(|error| at(error, displacement_m))?;
        let tendon_n = restrainer.map_or(0.0, |state| state.force_n);
        let angle = geometry.slenderness_rad() - rotation;
        let gravity_n = self.weight_n() * angle.tan();
        let held_n = tendon_n * rate_m / (2.0 * geometry.size_m() * angle.cos());
        let (columns, restrained) = (f64::from(self.columns), f64::from(self.restrained));
        let rise_m = rise_m(geometry, rotation);
        let energy_j = restrainer.map_or(0.0, |state| state.energy_j);
        Ok(PushoverState {
            displacement_m,
            drift: displacement_m / geometry.height_m(),
            rotation_rad: rotation,
            force_n: columns * gravity_n + restrained * held_n,
            rise_m,
            energy_j: columns * self.weight_n() * rise_m + restrained * energy_j,
            elongation_m,
            tendon_n,
            spring_m: restrainer.and_then(|state| state.deformation_m),
            sections: self.sections(rotation, gravity_n + held_n, tendon_n),
        })
    }

    /// Sections of a restrained column that carries `share_n` (N) of the force.
    fn sections(&self, rotation: f64, share_n: f64, tendon_n: f64) -> Sections {
        let (sin, cos) = rotation.sin_cos();
        let b = self.geometry.half_width_m();
        let through_base_n = if self.path == TendonPath::Foundation { tendon_n } else { 0.0 };
        let top_axial_n = self.top_load_n * cos - share_n * sin + tendon_n;
        let base_axial_n = self.top_load_n + self.column_weight_n + through_base_n;
        Sections {
            top_axial_n,
            top_moment_n_m: top_axial_n * b,
            top_shear_n: share_n * cos + self.top_load_n * sin,
            base_axial_n,
            base_moment_n_m: base_axial_n * b,
        }
    }
}

/// The error with the displacement at which it was met.
fn at(error: StaticsError, displacement_m: f64) -> StaticsError {
    match error {
        StaticsError::BeyondFlat { elongation_m, flat_m, .. } => StaticsError::BeyondFlat {
            elongation_m,
            flat_m,
            at: format!(", met at a displacement of {displacement_m:.6} m"),
        },
        other => other,
    }
}
