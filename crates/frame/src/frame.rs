//! The frame: its columns, its deck, what holds them, and its inertia.
//!
//! Everything is per column and divided by `μ R²` with `μ = m_c + 2 m_b/N`, which is `(1 + 2γ) m_c` with
//! `γ = m_b/(N m_c)`, so that a deck on columns without mass is no special case. In these units the inertia about a
//! corner is `M = (i m_c + 4 m_b/N)/μ`, `i = 4/3` for rectangular columns (Eq. 6.3) and `(15 + cos²α)/12` for cylinders
//! (Eq. 6.6), the potential of the weights `(g/R) [cos(α − θ) − cos α]`, and that of a wobbling frame's turning
//! `J(θ) = e U_s² + i_d sin²θ + i_a (1 − cos θ)²`, `e = (m_c + 4 m_b/N)/μ`, `i_d = (sin²α/4 + cos²α/3) m_c/μ`,
//! `i_a = ½ sin²α m_c/μ`, `U_s = sin θ cos α + (1 − cos θ) sin α = u/2R`.

use uplift_statics::{RestrainedColumns, Restrainer, TendonPath};
use uplift_structure::Geometry;

use crate::error::{FrameError, slenderness_within, within};

/// Section of the columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColumnShape {
    /// Rectangular: turns about an edge, in a plane.
    #[default]
    Rectangle,
    /// Circular: wobbles on its rim.
    Cylinder,
}

/// Columns of equal size under a rigid deck that translates and does not turn.
#[derive(Debug, Clone, PartialEq)]
pub struct RockingFrame {
    columns: RestrainedColumns,
    column_mass_kg: f64,
    deck_mass_kg: f64,
    shape: ColumnShape,
    gravity_m_s2: f64,
}

/// Inertia of a frame in units of `μ R²`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inertia {
    /// `M`: about a corner.
    pub(crate) tilt: f64,
    /// `e`.
    pub(crate) deck: f64,
    /// `i_d`.
    pub(crate) diameter: f64,
    /// `i_a`.
    pub(crate) axis: f64,
}

impl RockingFrame {
    /// A frame without restrainers, from the geometry of a column, the number `N` of columns, the masses of a column
    /// and of the whole deck (kg), the section of the columns and gravity (m/s²).
    ///
    /// # Errors
    /// Masses must be finite, that of a column or of the deck above zero, none negative; gravity between 1e-3 and 1e4
    /// m/s²; there must be a column, no stockier than 54.7°.
    ///
    /// # Source
    /// Reggiani Manzo, Section 6.2, Eq. 6.3 and 6.6, as corrected in `docs/errata.md`.
    pub fn new(
        geometry: Geometry,
        columns: u32,
        column_mass_kg: f64,
        deck_mass_kg: f64,
        shape: ColumnShape,
        gravity_m_s2: f64,
    ) -> Result<Self, FrameError> {
        let gravity_m_s2 = within("gravity", gravity_m_s2, "m/s2", 1e-3..=1e4, "between 1e-3 and 1e4 m/s2")?;
        within("column mass", column_mass_kg, "kg", 0.0..=1e15, "between 0 and 1e15 kg")?;
        within("deck mass", deck_mass_kg, "kg", 0.0..=1e15, "between 0 and 1e15 kg")?;
        let slenderness = geometry.slenderness_rad();
        slenderness_within(slenderness, 1e-6..=0.9553, "between 1e-6 and 0.9553 rad")?;
        let top_load_n = deck_mass_kg * gravity_m_s2 / f64::from(columns.max(1));
        let columns = RestrainedColumns::new(geometry, columns, top_load_n, column_mass_kg * gravity_m_s2)?;
        Ok(Self { columns, column_mass_kg, deck_mass_kg, shape, gravity_m_s2 })
    }

    /// The rigid rectangular block of size `R` (m) and slenderness `α` (rad): one column that carries no deck. Its mass
    /// is of no influence.
    ///
    /// # Errors
    /// As [`new`](Self::new); the size must be finite and above zero.
    pub fn block(size_m: f64, slenderness_rad: f64, gravity_m_s2: f64) -> Result<Self, FrameError> {
        let column = Geometry::from_slenderness_and_size(slenderness_rad, size_m)?;
        Self::new(column, 1, 1.0, 0.0, ColumnShape::Rectangle, gravity_m_s2)
    }

    /// The same with a restrainer in every column.
    ///
    /// # Errors
    /// The path must go with the column.
    pub fn with_restrainer(self, restrainer: Restrainer, path: TendonPath) -> Result<Self, FrameError> {
        Ok(Self { columns: self.columns.with_restrainer(restrainer, path)?, ..self })
    }

    /// The same with a restrainer in some of the columns only. What that makes the deck twist is not in the model.
    ///
    /// # Errors
    /// There cannot be more than there are columns.
    pub fn with_restrained(self, restrained: u32) -> Result<Self, FrameError> {
        Ok(Self { columns: self.columns.with_restrained(restrained)?, ..self })
    }

    /// The columns as they stand: statics.
    pub fn columns(&self) -> &RestrainedColumns {
        &self.columns
    }

    /// Geometry of a column.
    pub fn geometry(&self) -> &Geometry {
        self.columns.geometry()
    }

    /// Mass of a column, kg.
    pub fn column_mass_kg(&self) -> f64 {
        self.column_mass_kg
    }

    /// Mass of the deck, kg.
    pub fn deck_mass_kg(&self) -> f64 {
        self.deck_mass_kg
    }

    /// Section of the columns.
    pub fn shape(&self) -> ColumnShape {
        self.shape
    }

    /// Acceleration of gravity, m/s².
    pub fn gravity_m_s2(&self) -> f64 {
        self.gravity_m_s2
    }

    /// Deck mass on a column, kg.
    fn deck_share_kg(&self) -> f64 {
        self.deck_mass_kg / f64::from(self.columns.columns())
    }

    /// `μ = m_c + 2 m_b/N`, kg.
    pub(crate) fn mass_kg(&self) -> f64 {
        self.column_mass_kg + 2.0 * self.deck_share_kg()
    }

    pub(crate) fn inertia(&self) -> Inertia {
        let (sin, cos) = self.geometry().slenderness_rad().sin_cos();
        let mass = self.mass_kg();
        let (column, deck) = (self.column_mass_kg / mass, self.deck_share_kg() / mass);
        let corner = match self.shape {
            ColumnShape::Rectangle => 4.0 / 3.0,
            ColumnShape::Cylinder => (15.0 + cos * cos) / 12.0,
        };
        Inertia {
            tilt: corner * column + 4.0 * deck,
            deck: column + 4.0 * deck,
            diameter: (0.25 * sin * sin + cos * cos / 3.0) * column,
            axis: 0.5 * sin * sin * column,
        }
    }

    /// All that its motion depends on, as numbers: frames of the same numbers move alike, to the bit.
    pub fn identity(&self) -> Vec<f64> {
        let shape = match self.shape {
            ColumnShape::Rectangle => 0.0,
            ColumnShape::Cylinder => 1.0,
        };
        let geometry = self.geometry();
        let mut numbers = vec![
            geometry.size_m(),
            geometry.slenderness_rad(),
            f64::from(self.columns.columns()),
            self.column_mass_kg,
            self.deck_mass_kg,
            shape,
            self.gravity_m_s2,
        ];
        if let Some(restrainer) = self.columns.restrainer() {
            numbers.push(f64::from(self.columns.restrained()));
            numbers.extend(match self.columns.path() {
                TendonPath::Column => vec![0.0],
                TendonPath::Foundation => vec![1.0],
                TendonPath::Shifted { duct_gap_m, tendon_length_m } => vec![2.0, duct_gap_m, tendon_length_m],
            });
            numbers.extend(restrainer.parts().identity());
        }
        numbers
    }

    /// Frequency parameter `p = √(g/(R M))`, rad/s: of a frame without restrainers, the rate at which it falls.
    pub fn frequency_parameter_rad_s(&self) -> f64 {
        (self.gravity_m_s2 / (self.geometry().size_m() * self.inertia().tilt)).sqrt()
    }

    /// Ratio of angular velocity after to before an impact by the balance of momentum,
    /// `r = 1 − 2 sin²α (1 + 4γ)/(1 + 4γ + i_c)` with `i_c = 1/3` for rectangles and `sin²α/4 + cos²α/3` for cylinders
    /// (Eq. 6.5 for rectangles). Springs and prestress do not enter: their forces are finite.
    pub fn momentum_restitution(&self) -> f64 {
        let sin = self.geometry().slenderness_rad().sin();
        let inertia = self.inertia();
        let own = match self.shape {
            ColumnShape::Rectangle => self.column_mass_kg / (3.0 * self.mass_kg()),
            ColumnShape::Cylinder => inertia.diameter,
        };
        (1.0 - 2.0 * sin * sin * inertia.deck / (inertia.deck + own)).max(0.0)
    }

    /// Part of the uplift threshold that prestress brings, as a part of gravity: `T0 Δ'(0)/(μ g R cos α)`.
    pub(crate) fn prestress_ratio(&self) -> f64 {
        let prestress_n = self.columns.restrainer().map_or(0.0, |restrainer| restrainer.parts().prestress_n);
        let share = f64::from(self.columns.restrained()) / f64::from(self.columns.columns());
        let tangent = self.geometry().slenderness_rad().tan();
        share * prestress_n * self.columns.path().openings() * tangent / (self.mass_kg() * self.gravity_m_s2)
    }

    /// Horizontal ground acceleration beyond which the frame uplifts, without vertical shaking:
    /// `g tan α + T0 tan α/((1 + 2γ) m_c)`, the second part twice for tendons in the foundation, m/s².
    pub fn uplift_acceleration_m_s2(&self) -> f64 {
        self.gravity_m_s2 * (self.geometry().slenderness_rad().tan() + self.prestress_ratio())
    }

    /// Potential energy of weights and restrainers over that at rest, per column over `μ R²`, s⁻²; the law's last value
    /// beyond its end.
    pub(crate) fn potential(&self, rotation_rad: f64) -> f64 {
        let geometry = self.geometry();
        let elongation_m = self.columns.elongation(rotation_rad).elongation_m;
        let held_j = self.columns.restrainer().map_or(0.0, |restrainer| {
            let elongation_m = restrainer.limit_m().map_or(elongation_m, |limit_m| elongation_m.min(limit_m));
            restrainer.at(elongation_m).map_or(0.0, |state| state.energy_j)
        });
        let share = f64::from(self.columns.restrained()) / f64::from(self.columns.columns());
        let size_m = geometry.size_m();
        let half = 0.5 * rotation_rad;
        let lift = 2.0 * half.sin() * (geometry.slenderness_rad() - half).sin();
        self.gravity_m_s2 / size_m * lift + share * held_j / (self.mass_kg() * size_m * size_m)
    }

    /// `J(θ)`: `½ J φ̇²` is the energy of turning, per column over `μ R²`.
    pub(crate) fn turning_inertia(&self, rotation_rad: f64) -> f64 {
        let inertia = self.inertia();
        let sin = rotation_rad.sin();
        let versine = 2.0 * (0.5 * rotation_rad).sin().powi(2);
        let (sin_alpha, cos_alpha) = self.geometry().slenderness_rad().sin_cos();
        let travel = sin * cos_alpha + versine * sin_alpha;
        inertia.deck * travel * travel + inertia.diameter * sin * sin + inertia.axis * versine * versine
    }

    /// Kinetic and potential energy per column of a frame that moves with the velocities `ω` and `φ̇` (rad/s) at the
    /// rotation `θ` (rad), over that at rest, J: constant without shaking and without yielding.
    pub fn energy_j(&self, rotation_rad: f64, velocity_rad_s: f64, turning_rad_s: f64) -> f64 {
        let size_m = self.geometry().size_m();
        let kinetic = 0.5 * self.inertia().tilt * velocity_rad_s.powi(2)
            + 0.5 * self.turning_inertia(rotation_rad) * turning_rad_s.powi(2);
        (kinetic + self.potential(rotation_rad)) * self.mass_kg() * size_m * size_m
    }

    /// The moment of momentum `J φ̇` per column about the vertical, kg m²/s, of a frame at the rotation `θ` (rad) whose
    /// direction of lean turns at `φ̇` (rad/s): constant without shaking.
    pub fn angular_momentum_kg_m2_s(&self, rotation_rad: f64, turning_rad_s: f64) -> f64 {
        self.turning_inertia(rotation_rad) * turning_rad_s * self.mass_kg() * self.geometry().size_m().powi(2)
    }
}
