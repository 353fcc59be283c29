//! Solitary rocking bodies: Table 3.1, rows 1 to 4.
//!
//! All of them pivot about a corner at distance `R` from the mass centre, with slenderness `α` (Figure 3.1), and obey
//! `I_o θ̈ + m g R sin(α − θ) = −m ü_g R cos(α − θ)`, which is Eq. 3.5 for a rectangular block (`I_o = 4/3 m R²`).
//! Linearised and expressed in the displacement `u = R θ` of the centre or `u = 2R θ` of the top, it is Eq. 3.4:
//!
//! | row | body | displacement of | `m̃` | `f̃_up` | `ũ_cap` | `Γ` |
//! |---|---|---|---|---|---|---|
//! | 1 | point mass on a massless body | mass | `m` | `m g α` | `R sin α` | 1 |
//! | 2 | rectangular block | centre | `4m/3` | `m g α` | `R sin α` | 3/4 |
//! | 3 | any body of inertia `I_o` about the pivot | mass centre | `I_o/R²` | `m g α` | `R sin α` | `m R²/I_o` |
//! | 4 | rectangular block | top | `m/3` | `m g α/2` | `2R sin α` | 3/2 |

use crate::equivalent::{Conditions, EquivalentSystem, Row};
use crate::error::{StructureError, positive};
use crate::geometry::Geometry;

/// Point of a rectangular block whose displacement is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reference {
    /// The centre: row 2.
    Centre,
    /// The top: row 4 and Eq. 3.6, as in the spectra of Chapter 2.
    #[default]
    Top,
}

/// All the mass at a point that rocks on a massless body: row 1.
///
/// The geometry is that of the block around the point: `2b` the width of the base and `2h` twice
/// the height of the mass.
///
/// ```
/// use uplift_structure::{Conditions, Geometry, PointMass};
/// let geometry = Geometry::from_slenderness_and_size(0.1, 5.0)?;
/// let system = PointMass::new(geometry, 1000.0)?.equivalent(Conditions::default())?;
/// assert!((system.strength() - 0.1).abs() < 1e-15);
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMass {
    pub(crate) geometry: Geometry,
    mass_kg: f64,
}

impl PointMass {
    /// From geometry and mass `m`, kg.
    ///
    /// # Errors
    /// The mass must be finite and positive.
    pub fn new(geometry: Geometry, mass_kg: f64) -> Result<Self, StructureError> {
        Ok(Self { geometry, mass_kg: positive("mass_kg", mass_kg, "kg")? })
    }

    /// Table 3.1, row 1.
    ///
    /// # Errors
    /// The capacity `R sin α` must exceed the uplift displacement.
    pub fn equivalent(&self, conditions: Conditions) -> Result<EquivalentSystem, StructureError> {
        at_centre(1, &self.geometry, self.mass_kg, 1.0, conditions)
    }
}

/// A rectangular block of uniform density: rows 2 and 4.
///
/// ```
/// use uplift_structure::{Block, Conditions, Geometry, Reference};
/// let geometry = Geometry::from_width_and_height(1.0, 10.0)?;
/// let system = Block::new(geometry, 25_000.0)?.equivalent(Reference::Top, Conditions::default())?;
/// assert_eq!(system.participation(), 1.5);
/// assert_eq!(system.capacity()?.capacity_m(), 1.0);
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    pub(crate) geometry: Geometry,
    mass_kg: f64,
}

impl Block {
    /// From geometry and mass `m`, kg.
    ///
    /// # Errors
    /// The mass must be finite and positive.
    pub fn new(geometry: Geometry, mass_kg: f64) -> Result<Self, StructureError> {
        Ok(Self { geometry, mass_kg: positive("mass_kg", mass_kg, "kg")? })
    }

    /// Table 3.1, row 2 (centre) or row 4 (top, Eq. 3.6).
    ///
    /// # Errors
    /// The capacity `R sin α` or `2R sin α` must exceed the uplift displacement.
    pub fn equivalent(&self, reference: Reference, conditions: Conditions) -> Result<EquivalentSystem, StructureError> {
        match reference {
            Reference::Centre => at_centre(2, &self.geometry, self.mass_kg, 4.0 / 3.0, conditions),
            Reference::Top => {
                let row = Row {
                    number: 4,
                    mass_kg: self.mass_kg / 3.0,
                    uplift_force_n: 0.5 * self.mass_kg * conditions.gravity_m_s2() * self.geometry.slenderness_rad(),
                    free_capacity_m: self.geometry.width_m(),
                    softening: 1.0,
                    participation: 1.5,
                };
                EquivalentSystem::from_row(&row, &self.geometry, conditions)
            }
        }
    }
}

/// A body of any shape, symmetric about the vertical through its mass centre: row 3.
///
/// The geometry is that of the rectangle around which it rocks: `2b` the width of the base and `2h` twice the
/// height of the mass centre.
///
/// ```
/// use uplift_structure::{Body, Conditions, Geometry};
/// let geometry = Geometry::from_slenderness_and_size(0.1, 5.0)?;
/// // a rectangular block: 4/3 m R², which gives row 2
/// let system = Body::new(geometry, 1000.0, 100_000.0 / 3.0)?.equivalent(Conditions::default())?;
/// assert!((system.participation() - 0.75).abs() < 1e-12);
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    pub(crate) geometry: Geometry,
    mass_kg: f64,
    /// `I_o/(m R²)`.
    pub(crate) inertia_ratio: f64,
}

impl Body {
    /// From geometry, mass `m`, kg, and moment of inertia `I_o` about the pivot corner, kg m².
    ///
    /// # Errors
    /// Mass and moment of inertia must be finite and positive, the latter at least `m R²`: less is
    /// impossible (parallel axes).
    pub fn new(geometry: Geometry, mass_kg: f64, moment_of_inertia_kg_m2: f64) -> Result<Self, StructureError> {
        let mass_kg = positive("mass_kg", mass_kg, "kg")?;
        let moment_of_inertia_kg_m2 = positive("moment_of_inertia_kg_m2", moment_of_inertia_kg_m2, "kg m²")?;
        let least_kg_m2 = mass_kg * geometry.size_m() * geometry.size_m();
        // a value written with rounded digits may fall short of the point mass by its rounding
        if moment_of_inertia_kg_m2 < least_kg_m2 * (1.0 - 1e-9) {
            return Err(StructureError::InertiaBelowPointMass { moment_of_inertia_kg_m2, least_kg_m2 });
        }
        Ok(Self { geometry, mass_kg, inertia_ratio: moment_of_inertia_kg_m2 / least_kg_m2 })
    }

    /// Table 3.1, row 3.
    ///
    /// # Errors
    /// The capacity `R sin α` must exceed the uplift displacement.
    pub fn equivalent(&self, conditions: Conditions) -> Result<EquivalentSystem, StructureError> {
        at_centre(3, &self.geometry, self.mass_kg, self.inertia_ratio, conditions)
    }
}

/// Rows 1 to 3: a body of `I_o = inertia_ratio · m R²`, followed at its mass centre.
fn at_centre(
    number: u8,
    geometry: &Geometry,
    mass_kg: f64,
    inertia_ratio: f64,
    conditions: Conditions,
) -> Result<EquivalentSystem, StructureError> {
    let row = Row {
        number,
        mass_kg: inertia_ratio * mass_kg,
        uplift_force_n: mass_kg * conditions.gravity_m_s2() * geometry.slenderness_rad(),
        free_capacity_m: geometry.half_width_m(),
        softening: 1.0,
        participation: 1.0 / inertia_ratio,
    };
    EquivalentSystem::from_row(&row, geometry, conditions)
}
