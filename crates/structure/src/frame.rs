//! Rocking frames: equal columns under a rigid deck, free or restrained by tendons (Table 3.1, row 5; Eq. 6.1 and 6.2).
//!
//! With `N` columns of mass `m` each, a deck of mass `m_b` and `γ_m = m_b/(N m)`, row 5 reads, in masses rather than
//! their ratio so that massless columns and a missing deck are plain cases,
//!
//! | | row 5 | here |
//! |---|---|---|
//! | `m̃` | `(1 + 3γ_m) N m/3` | `N m/3 + m_b` |
//! | `f̃_up` | `(N m g/2)(1 + 2γ_m) α` | `(N m/2 + m_b) g α` |
//! | `ũ_cap` | `2b (½ + γ_m)/((½ + γ_m) − (EA/(m g)) α²)` | `2b/(1 − κ)` |
//! | `Γ` | `3(1 + 2γ_m)/(2(1 + 3γ_m))` | `(N m/2 + m_b)/(N m/3 + m_b)` |
//!
//! `κ` is the share of the softening by gravity that the tendons take back. A tendon with spring of stiffness `k_res`
//! in every column gives
//!
//! * `κ = 2 N k_res b α/((N m/2 + m_b) g)` if it is anchored in the foundation (Eq. 6.1),
//! * a quarter of that if it is anchored within the column (Eq. 6.2), since the gap opens at one end only.
//!
//! Row 5 is the first of these with `EA = 2h k_res` and `b = h α`: its `EA` is the axial stiffness (N) of a tendon as
//! long as the column. Here `b` is the column's own, `h tan α`, so that `κ` is larger by `tan α/α`, 0.9 % at
//! `α = 0.165`. Section 3.4.5 prints the limit `γ_m → ∞` as `1 − (N EA/m_b) α²`, which
//! lacks `g` beside `m_b`.
//!
//! `κ < 1` is negative post-uplift stiffness, `κ = 1` the ZSBE system, `κ > 1` positive stiffness without a
//! displacement capacity. Tendons are not prestressed: they do not change the force at uplift (Section 3.4.5).

use crate::equivalent::{Conditions, EquivalentSystem, Row};
use crate::error::{StructureError, not_negative, positive, require};
use crate::geometry::Geometry;

/// Equal columns under a rigid deck, all free to rock: row 5 without tendons.
///
/// ```
/// use uplift_structure::{Conditions, Frame, Geometry};
/// let columns = Geometry::from_width_and_height(1.6, 9.6)?;
/// let frame = Frame::new(columns, 4, 48_000.0, 900_000.0)?.equivalent(Conditions::default())?;
/// assert_eq!(frame.mass_kg(), 64_000.0 + 900_000.0);
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    geometry: Geometry,
    columns: u32,
    column_mass_kg: f64,
    deck_mass_kg: f64,
}

/// Where the lower end of a tendon is fixed; the upper end is above the deck (Figure 6.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Anchorage {
    /// In the foundation: the tendon follows the opening at both ends of the column (Eq. 6.1; Table 3.1, row 5).
    Foundation,
    /// At the lower end of the column: the tendon follows the opening under the deck only (Eq. 6.2, Eq. 5.2).
    Column,
}

impl Anchorage {
    /// `κ (N m/2 + m_b) g/(N k_res b α)`.
    fn leverage(self) -> f64 {
        match self {
            Self::Foundation => 2.0,
            Self::Column => 0.5,
        }
    }
}

impl Frame {
    /// From the geometry of a column, the number of columns, the mass of each (kg) and the mass of the deck (kg). One
    /// of the masses may be 0.
    ///
    /// # Errors
    /// There must be a column and a mass; masses must be finite and not negative.
    pub fn new(
        geometry: Geometry,
        columns: u32,
        column_mass_kg: f64,
        deck_mass_kg: f64,
    ) -> Result<Self, StructureError> {
        require(columns > 0, "columns", f64::from(columns), "", "at least 1")?;
        not_negative("column_mass_kg", column_mass_kg, "kg")?;
        not_negative("deck_mass_kg", deck_mass_kg, "kg")?;
        if column_mass_kg == 0.0 && deck_mass_kg == 0.0 {
            return Err(StructureError::Massless);
        }
        Ok(Self { geometry, columns, column_mass_kg, deck_mass_kg })
    }

    /// Geometry of a column.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    fn columns_mass_kg(&self) -> f64 {
        f64::from(self.columns) * self.column_mass_kg
    }

    /// `N m/3 + m_b`, kg.
    fn inertial_mass_kg(&self) -> f64 {
        self.columns_mass_kg() / 3.0 + self.deck_mass_kg
    }

    /// `N m/2 + m_b`, kg: what gravity and the ground motion act upon.
    fn gravitating_mass_kg(&self) -> f64 {
        0.5 * self.columns_mass_kg() + self.deck_mass_kg
    }

    /// Table 3.1, row 5 with `EA = 0`.
    ///
    /// # Errors
    /// The capacity `2R sin α` must exceed the uplift displacement.
    pub fn equivalent(&self, conditions: Conditions) -> Result<EquivalentSystem, StructureError> {
        self.softened(5, self.geometry.width_m(), 1.0, conditions)
    }

    /// A row of the frame with its capacity `free_capacity_m/softening`.
    pub(crate) fn softened(
        &self,
        number: u8,
        free_capacity_m: f64,
        softening: f64,
        conditions: Conditions,
    ) -> Result<EquivalentSystem, StructureError> {
        let row = Row {
            number,
            mass_kg: self.inertial_mass_kg(),
            uplift_force_n: self.gravitating_mass_kg() * conditions.gravity_m_s2() * self.geometry.slenderness_rad(),
            free_capacity_m,
            softening,
            participation: self.gravitating_mass_kg() / self.inertial_mass_kg(),
        };
        EquivalentSystem::from_row(&row, &self.geometry, conditions)
    }

    /// Height `2H` of the solitary block of the same slenderness that rotates as this frame does (Section 2.4.3, after
    /// Makris and Vassiliou 2013), m: `2h (1 + 3γ_m)/(1 + 2γ_m)`.
    ///
    /// The top of that block moves by `(1 + 3γ_m)/(1 + 2γ_m)` times the displacement of the deck; demand over
    /// capacity is the same.
    pub fn equivalent_block_height_m(&self) -> f64 {
        1.5 * self.geometry.height_m() * self.inertial_mass_kg() / self.gravitating_mass_kg()
    }

    /// What an impact takes of the angular velocity, in units of `sin²α`: `(3/2)(1 + 4γ_m)/(1 + 3γ_m)` (see
    /// [`rigid`](crate::rigid)).
    pub(crate) fn impact_loss(&self) -> f64 {
        0.5 * (self.columns_mass_kg() + 4.0 * self.deck_mass_kg) / self.inertial_mass_kg()
    }

    /// Stiffness of the tendon and spring of each column at which the post-uplift stiffness is zero, `k_crit` of
    /// Section 6.2.1, N/m: `(1 + 2γ_m) m g/(4 b α)` for [`Anchorage::Foundation`], four times that for
    /// [`Anchorage::Column`].
    pub fn critical_tendon_stiffness_n_m(&self, anchorage: Anchorage, conditions: Conditions) -> f64 {
        let lever = anchorage.leverage() * self.geometry.half_width_m() * self.geometry.slenderness_rad();
        self.gravitating_mass_kg() * conditions.gravity_m_s2() / (f64::from(self.columns) * lever)
    }

    /// Stiffness of the tendon and spring of each column that gives the frame a displacement capacity (m), N/m: row 5
    /// solved for `EA`, the last step of Section 3.4.5. Zero where the columns have that capacity by themselves.
    ///
    /// # Errors
    /// The capacity must be finite and positive.
    pub fn tendon_stiffness_for_capacity_n_m(
        &self,
        capacity_m: f64,
        anchorage: Anchorage,
        conditions: Conditions,
    ) -> Result<f64, StructureError> {
        let share = 1.0 - self.geometry.width_m() / positive("capacity_m", capacity_m, "m")?;
        Ok(share.max(0.0) * self.critical_tendon_stiffness_n_m(anchorage, conditions))
    }
}

/// A frame with an unbonded, unprestressed tendon through the centre of every column: row 5.
///
/// ```
/// use uplift_structure::{Anchorage, Conditions, Frame, Geometry, RestrainedFrame};
/// let columns = Geometry::from_width_and_height(1.6, 9.6)?;
/// let free = Frame::new(columns, 4, 48_000.0, 900_000.0)?;
/// let stiffness = free.tendon_stiffness_for_capacity_n_m(3.2, Anchorage::Column, Conditions::default())?;
/// let frame = RestrainedFrame::new(free, stiffness, Anchorage::Column)?.equivalent(Conditions::default())?;
/// assert!((frame.capacity()?.capacity_m() - 3.2).abs() < 1e-12);
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestrainedFrame {
    frame: Frame,
    tendon_stiffness_n_m: f64,
    anchorage: Anchorage,
}

impl RestrainedFrame {
    /// From a free frame and the stiffness `k_res` of the tendon and spring of each column, in series, N/m;
    /// 0 is the free frame.
    ///
    /// # Errors
    /// The stiffness must be finite and not negative.
    pub fn new(frame: Frame, tendon_stiffness_n_m: f64, anchorage: Anchorage) -> Result<Self, StructureError> {
        let tendon_stiffness_n_m = not_negative("tendon_stiffness_n_m", tendon_stiffness_n_m, "N/m")?;
        Ok(Self { frame, tendon_stiffness_n_m, anchorage })
    }

    /// Table 3.1, row 5. A positive post-uplift stiffness is computed and said in a warning.
    ///
    /// # Errors
    /// The capacity must exceed the uplift displacement.
    pub fn equivalent(&self, conditions: Conditions) -> Result<EquivalentSystem, StructureError> {
        let critical_n_m = self.frame.critical_tendon_stiffness_n_m(self.anchorage, conditions);
        let softening = 1.0 - self.tendon_stiffness_n_m / critical_n_m;
        self.frame.softened(5, self.frame.geometry.width_m(), softening, conditions)
    }
}
