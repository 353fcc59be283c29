//! The single-degree-of-freedom oscillator that a rocking structure is equivalent to (Section 3.2, Eq. 3.1–3.4).

use uplift_oscillator::{Oscillator, OscillatorError, STANDARD_GRAVITY_M_S2};

use crate::error::{StructureError, not_negative, positive, representable};
use crate::geometry::{Geometry, SLENDER_TOLERANCE};
use crate::rule::Capacity;
use crate::warning::Warning;

/// What an equivalent system needs beside geometry and masses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditions {
    gravity_m_s2: f64,
    uplift_displacement_m: f64,
}

impl Default for Conditions {
    /// Standard gravity and the quasi-rigid `u_up = 0.5 mm` of Section 3.4.
    fn default() -> Self {
        Self { gravity_m_s2: STANDARD_GRAVITY_M_S2, uplift_displacement_m: 0.0005 }
    }
}

impl Conditions {
    /// Acceleration of gravity, m/s², and uplift displacement `u_up` of the point whose displacement counts, m; 0
    /// for a rigid structure.
    ///
    /// # Errors
    /// Gravity must be finite and positive, the uplift displacement finite and not negative.
    pub fn new(gravity_m_s2: f64, uplift_displacement_m: f64) -> Result<Self, StructureError> {
        Ok(Self {
            gravity_m_s2: positive("gravity_m_s2", gravity_m_s2, "m/s²")?,
            uplift_displacement_m: not_negative("uplift_displacement_m", uplift_displacement_m, "m")?,
        })
    }

    /// Acceleration of gravity, m/s².
    pub fn gravity_m_s2(&self) -> f64 {
        self.gravity_m_s2
    }

    /// Uplift displacement `u_up`, m.
    pub fn uplift_displacement_m(&self) -> f64 {
        self.uplift_displacement_m
    }
}

/// What is said everywhere of a structure whose force does not fall after uplift, and why.
pub const NO_CAPACITY: &str = "no displacement capacity";
/// Why a structure has [`NO_CAPACITY`].
pub const NO_CAPACITY_REASON: &str = "the force does not fall after uplift";

/// Slope of the restoring force after uplift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PostUpliftForce {
    /// The force falls and vanishes at the displacement capacity `u_cap`, m: NSBE (Eq. 3.2).
    Negative {
        /// Displacement capacity `u_cap`, m; above the uplift displacement.
        capacity_m: f64,
    },
    /// The force stays: ZSBE, `u_cap = ∞`.
    Zero,
    /// The force rises; there is no displacement capacity.
    Positive {
        /// Stiffness after uplift, N/m.
        stiffness_n_m: f64,
    },
}

/// The oscillator of Table 3.1: mass `m̃`, force at uplift `f̃_up`, displacement capacity `ũ_cap` and the factor
/// `Γ` on the excitation.
///
/// `m̃ ü + f(u) = −Γ m̃ ü_g` (Eq. 3.4), where `f` rises to `f̃_up` at `u_up` (Eq. 3.1) and then follows Eq. 3.2
/// with `abs(u)` for `u`.
#[derive(Debug, Clone, PartialEq)]
pub struct EquivalentSystem {
    pub(crate) table_row: u8,
    pub(crate) mass_kg: f64,
    pub(crate) uplift_force_n: f64,
    pub(crate) participation: f64,
    pub(crate) conditions: Conditions,
    pub(crate) post_uplift: PostUpliftForce,
    pub(crate) warnings: Vec<Warning>,
}

/// A row of Table 3.1 evaluated for a rigid structure.
pub(crate) struct Row {
    pub(crate) number: u8,
    pub(crate) mass_kg: f64,
    pub(crate) uplift_force_n: f64,
    /// Capacity without anything that restores, m.
    pub(crate) free_capacity_m: f64,
    /// What remains of the softening: 1 without restraint, 0 where the force stays, negative where it rises.
    pub(crate) softening: f64,
    pub(crate) participation: f64,
}

impl EquivalentSystem {
    pub(crate) fn from_row(row: &Row, geometry: &Geometry, conditions: Conditions) -> Result<Self, StructureError> {
        for (what, value) in [
            ("the equivalent mass, kg", row.mass_kg),
            ("the force at uplift, N", row.uplift_force_n),
            ("the factor Γ", row.participation),
            ("the strength f_up/(m g)", row.uplift_force_n / (row.mass_kg * conditions.gravity_m_s2)),
            ("the displacement capacity without restraint, m", row.free_capacity_m),
        ] {
            representable(what, value)?;
        }
        if !row.softening.is_finite() {
            let what = "the restraint against gravity";
            return Err(StructureError::NotRepresentable { what, value: row.softening });
        }
        let mut warnings = Vec::new();
        let linearisation_error = geometry.linearisation_error();
        if linearisation_error > SLENDER_TOLERANCE {
            warnings.push(Warning::Stocky { slenderness_rad: geometry.slenderness_rad(), linearisation_error });
        }
        // the zero of the line through the force at rest: beyond it where the force falls, behind it where it rises
        let zero_m = row.free_capacity_m / row.softening;
        let post_uplift = if zero_m.is_infinite() {
            PostUpliftForce::Zero
        } else {
            following(row.uplift_force_n, conditions.uplift_displacement_m, zero_m)?
        };
        let mut system = Self {
            table_row: row.number,
            mass_kg: row.mass_kg,
            uplift_force_n: row.uplift_force_n,
            participation: row.participation,
            conditions,
            post_uplift,
            warnings,
        };
        system.warn_of_stiffness();
        Ok(system)
    }

    /// The same mass and `Γ` with strength and capacity from a nonlinear static analysis of the deformable structure,
    /// as Section 3.2 asks for where the structure is not rigid.
    ///
    /// * `uplift_force_n` — `f̃_up`, N, at the point whose displacement counts
    /// * `uplift_displacement_m` — `ũ_up`, m
    /// * `capacity_m` — `ũ_cap`, m; infinite for a force that stays
    ///
    /// # Errors
    /// Force and capacity must be positive, the capacity above the uplift displacement.
    pub fn with_static_analysis(
        &self,
        uplift_force_n: f64,
        uplift_displacement_m: f64,
        capacity_m: f64,
    ) -> Result<Self, StructureError> {
        let uplift_force_n = positive("uplift_force_n", uplift_force_n, "N")?;
        let conditions = Conditions::new(self.conditions.gravity_m_s2, uplift_displacement_m)?;
        let capacity = Capacity::new(uplift_displacement_m, capacity_m)?;
        let post_uplift = if capacity.capacity_m().is_infinite() {
            PostUpliftForce::Zero
        } else {
            PostUpliftForce::Negative { capacity_m }
        };
        // the shape of the rigid loop is replaced: only what was said of the body itself still holds
        let warnings =
            self.warnings.iter().copied().filter(|warning| matches!(warning, Warning::Stocky { .. })).collect();
        let mut system = Self { uplift_force_n, conditions, post_uplift, warnings, ..self.clone() };
        system.warn_of_stiffness();
        Ok(system)
    }

    fn warn_of_stiffness(&mut self) {
        match self.post_uplift {
            PostUpliftForce::Negative { .. } => {}
            PostUpliftForce::Zero => self.warnings.push(Warning::ZeroStiffness),
            PostUpliftForce::Positive { stiffness_n_m } => {
                self.warnings.push(Warning::PositiveStiffness { stiffness_n_m });
            }
        }
    }

    /// Row of Table 3.1, 1 to 6.
    pub fn table_row(&self) -> u8 {
        self.table_row
    }

    /// Equivalent mass `m̃`, kg.
    pub fn mass_kg(&self) -> f64 {
        self.mass_kg
    }

    /// Force at uplift `f̃_up`, N.
    pub fn uplift_force_n(&self) -> f64 {
        self.uplift_force_n
    }

    /// Strength `η = f̃_up/(m̃ g)` of the oscillator that is driven by `Γ` times the ground motion.
    pub fn strength(&self) -> f64 {
        self.uplift_force_n / (self.mass_kg * self.conditions.gravity_m_s2)
    }

    /// Factor `Γ` on the ground motion (Eq. 3.4).
    pub fn participation(&self) -> f64 {
        self.participation
    }

    /// Gravity and uplift displacement.
    pub fn conditions(&self) -> Conditions {
        self.conditions
    }

    /// Slope of the force after uplift.
    pub fn post_uplift(&self) -> PostUpliftForce {
        self.post_uplift
    }

    /// The displacement at which the force is gone, m; none where it does not fall after uplift.
    pub fn capacity_m(&self) -> Option<f64> {
        match self.post_uplift {
            PostUpliftForce::Negative { capacity_m } => Some(capacity_m),
            PostUpliftForce::Zero | PostUpliftForce::Positive { .. } => None,
        }
    }

    /// What limits the worth of this system.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Uplift displacement and displacement capacity (infinite for zero stiffness), as the rules need them.
    ///
    /// # Errors
    /// [`StructureError::PositiveStiffness`] where the force rises after uplift.
    pub fn capacity(&self) -> Result<Capacity, StructureError> {
        let uplift_displacement_m = self.conditions.uplift_displacement_m;
        match self.post_uplift {
            PostUpliftForce::Negative { capacity_m } => Capacity::new(uplift_displacement_m, capacity_m),
            PostUpliftForce::Zero => Capacity::new(uplift_displacement_m, f64::INFINITY),
            PostUpliftForce::Positive { stiffness_n_m } => Err(StructureError::PositiveStiffness { stiffness_n_m }),
        }
    }

    /// Stiffness after uplift, N/m (Eq. 3.2): `−f_up/(u_cap − u_up)`, zero or positive.
    pub fn post_uplift_stiffness_n_m(&self) -> f64 {
        match self.post_uplift {
            PostUpliftForce::Negative { capacity_m } => {
                -self.uplift_force_n / (capacity_m - self.conditions.uplift_displacement_m)
            }
            PostUpliftForce::Zero => 0.0,
            PostUpliftForce::Positive { stiffness_n_m } => stiffness_n_m,
        }
    }

    /// Restoring force at a displacement (m), N (Eq. 3.1 and 3.2, the latter with `abs(u)`).
    pub fn restoring_force_n(&self, displacement_m: f64) -> f64 {
        let (distance, uplift) = (displacement_m.abs(), self.conditions.uplift_displacement_m);
        let force_n = if distance < uplift {
            self.uplift_force_n * distance / uplift
        } else {
            self.uplift_force_n + self.post_uplift_stiffness_n_m() * (distance - uplift)
        };
        if displacement_m == 0.0 { 0.0 } else { displacement_m.signum() * force_n }
    }

    /// Strength `η/Γ` at which to read a spectrum of ZSBE oscillators that are driven by the ground motion itself: `α`
    /// in all of Table 3.1.
    pub fn spectral_strength(&self) -> f64 {
        self.strength() / self.participation
    }

    /// The same where the spectrum is of another gravity (m/s²): it counts in multiples of its own, and the force
    /// per mass is what it is.
    pub fn spectral_strength_at(&self, gravity_m_s2: f64) -> f64 {
        let own_m_s2 = self.conditions().gravity_m_s2();
        if own_m_s2 == gravity_m_s2 {
            self.spectral_strength()
        } else {
            self.spectral_strength() * own_m_s2 / gravity_m_s2
        }
    }

    /// Uplift displacement `u_up/Γ` of the oscillator whose displacement a spectrum gives, m.
    ///
    /// The dissertation's spectra are for 0.5 mm; Section 3.5 says when another one does not matter.
    pub fn spectral_uplift_displacement_m(&self) -> f64 {
        self.conditions.uplift_displacement_m / self.participation
    }

    /// Whether a spectrum of oscillators that uplift at `uplift_displacement_m` \[m\] is of such ones: within 5 %,
    /// by which demands change by no more in the median (docs/design-rules.md has them for 2 mm in place of 0.5 mm).
    pub fn is_of_uplift_displacement(&self, uplift_displacement_m: f64) -> bool {
        (self.spectral_uplift_displacement_m() / uplift_displacement_m - 1.0).abs() <= 0.05
    }

    /// Demand `u_dem,ZS` on the structure's own displacement, m: `Γ` times the ordinate (m) that a spectrum has at
    /// [`spectral_strength`](Self::spectral_strength).
    ///
    /// # Errors
    /// The ordinate must be finite and not negative.
    pub fn zero_stiffness_demand_m(&self, ordinate_m: f64) -> Result<f64, StructureError> {
        Ok(self.participation * not_negative("ordinate_m", ordinate_m, "m")?)
    }

    /// The mass-normalised oscillator of Eq. 3.4: drive it with `Γ` times the ground motion.
    ///
    /// # Errors
    /// The coefficient of restitution must lie in \[0, 1\] and the uplift displacement must be positive.
    pub fn oscillator(&self, restitution: f64) -> Result<Oscillator, OscillatorError> {
        self.scaled_oscillator(1.0, restitution)
    }

    /// The oscillator driven by the ground motion itself: `Γ` times its displacement is the structure's.
    ///
    /// # Errors
    /// As for [`oscillator`](Self::oscillator).
    pub fn spectral_oscillator(&self, restitution: f64) -> Result<Oscillator, OscillatorError> {
        self.scaled_oscillator(self.participation, restitution)
    }

    fn scaled_oscillator(&self, scale: f64, restitution: f64) -> Result<Oscillator, OscillatorError> {
        let post_uplift = match self.post_uplift {
            PostUpliftForce::Negative { capacity_m } => {
                uplift_oscillator::PostUplift::Negative { capacity_m: capacity_m / scale }
            }
            PostUpliftForce::Zero => uplift_oscillator::PostUplift::Zero,
            PostUpliftForce::Positive { stiffness_n_m } => {
                uplift_oscillator::PostUplift::Positive { stiffness_per_s2: stiffness_n_m / self.mass_kg }
            }
        };
        Oscillator::new(
            self.strength() / scale,
            self.conditions.gravity_m_s2,
            self.conditions.uplift_displacement_m / scale,
            restitution,
            post_uplift,
        )
    }
}

/// The branch of Eq. 3.2 through `zero_m`, where its force vanishes: falling where that lies ahead, rising
/// where it lies behind.
fn following(uplift_force_n: f64, uplift_displacement_m: f64, zero_m: f64) -> Result<PostUpliftForce, StructureError> {
    if zero_m > 0.0 {
        Capacity::new(uplift_displacement_m, zero_m)?;
        Ok(PostUpliftForce::Negative { capacity_m: zero_m })
    } else {
        let stiffness_n_m = uplift_force_n / (uplift_displacement_m - zero_m);
        let stiffness_n_m = representable("the post-uplift stiffness, N/m", stiffness_n_m)?;
        Ok(PostUpliftForce::Positive { stiffness_n_m })
    }
}
