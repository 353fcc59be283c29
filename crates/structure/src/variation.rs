//! A structure with one of its quantities changed and all others kept: what a search for the least of it varies.
//!
//! | quantity | what changes | what stays |
//! |---|---|---|
//! | strength | the force at uplift, `f̃_up = η m̃ g` | uplift displacement, displacement capacity, masses |
//! | size | all lengths, by the factor of `R`; `I_o` by its square | slenderness, masses, tendons |
//! | width | `2b` of block or column, extensions as they are | height, masses, inertia about the centre |
//! | capacity | `ũ_cap` | force at uplift, uplift displacement, masses |
//! | tendon stiffness | `k_res` of each column of a restrained frame | everything else |

use crate::description::{Kind, StructureDescription};
use crate::equivalent::EquivalentSystem;
use crate::error::{StructureError, positive};

/// A quantity of a structure that may be varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Uplift strength `η = f̃_up/(m̃ g)`.
    Strength,
    /// Semi-diagonal `R`, m, at the same slenderness.
    Size,
    /// Width `2b` of the block or column, m, at the same height.
    Width,
    /// Displacement capacity `ũ_cap`, m.
    Capacity,
    /// Stiffness of each column's tendon and spring, N/m.
    TendonStiffness,
}

impl Quantity {
    /// Every quantity.
    pub const ALL: [Self; 5] = [Self::Strength, Self::Size, Self::Width, Self::Capacity, Self::TendonStiffness];

    /// Its word.
    pub fn key(self) -> &'static str {
        match self {
            Self::Strength => "strength",
            Self::Size => "size",
            Self::Width => "width",
            Self::Capacity => "capacity",
            Self::TendonStiffness => "tendon-stiffness",
        }
    }

    /// Its unit; empty for a pure number.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Strength => "",
            Self::Size | Self::Width | Self::Capacity => "m",
            Self::TendonStiffness => "N/m",
        }
    }

    /// The value that the structure of `description` has; none of a capacity where its force does not fall.
    ///
    /// # Errors
    /// A mistake of the description; a quantity that its kind does not have.
    pub fn value(self, description: &StructureDescription) -> Result<Option<f64>, Vec<StructureError>> {
        let system = description.resolve()?;
        Ok(match self {
            Self::Strength => Some(system.strength()),
            Self::Size => Some(description.geometry().map_err(|error| vec![error])?.size_m()),
            Self::Width => Some(description.geometry().map_err(|error| vec![error])?.width_m()),
            Self::Capacity => system.capacity_m(),
            Self::TendonStiffness => {
                tendons(description, description.tendon_stiffness_n_m.unwrap_or_default())?;
                description.tendon_stiffness_n_m
            }
        })
    }

    /// The structure of `description` with this quantity at `value`, in its unit; none of strength and capacity, which
    /// change its oscillator alone.
    ///
    /// # Errors
    /// What the value makes impossible; a quantity that its kind does not have.
    pub fn described(
        self,
        description: &StructureDescription,
        value: f64,
    ) -> Result<Option<StructureDescription>, Vec<StructureError>> {
        let one = |error: StructureError| vec![error];
        Ok(match self {
            Self::Strength | Self::Capacity => None,
            Self::Size => Some(sized(description, value).map_err(one)?),
            Self::Width => Some(widened(description, value).map_err(one)?),
            Self::TendonStiffness => Some(tendons(description, value)?),
        })
    }

    /// The equivalent oscillator of the structure of `description` with this quantity at `value`, in its unit.
    ///
    /// # Errors
    /// A mistake of the description, or what the value makes impossible; a quantity that its kind does not have.
    pub fn varied(
        self,
        description: &StructureDescription,
        value: f64,
    ) -> Result<EquivalentSystem, Vec<StructureError>> {
        let one = |error: StructureError| vec![error];
        let held = |capacity_m: Option<f64>, strength: Option<f64>| {
            let system = description.resolve()?;
            let uplift_displacement_m = system.conditions().uplift_displacement_m();
            let capacity_m = match capacity_m {
                Some(capacity_m) => capacity_m,
                None => system.capacity().map_err(one)?.capacity_m(),
            };
            let weight_n = system.mass_kg() * system.conditions().gravity_m_s2();
            let uplift_force_n = strength.map_or(system.uplift_force_n(), |strength| strength * weight_n);
            system.with_static_analysis(uplift_force_n, uplift_displacement_m, capacity_m).map_err(one)
        };
        match self {
            Self::Strength => held(None, Some(positive("strength", value, "").map_err(one)?)),
            Self::Capacity => held(Some(positive("capacity", value, "m").map_err(one)?), None),
            Self::Size | Self::Width | Self::TendonStiffness => {
                self.described(description, value)?.unwrap_or(*description).resolve()
            }
        }
    }
}

/// All lengths by one factor, so that the size is `size_m`.
fn sized(of: &StructureDescription, size_m: f64) -> Result<StructureDescription, StructureError> {
    let geometry = of.geometry()?;
    let factor = positive("size_m", size_m, "m")? / geometry.size_m();
    let by_factor = |length_m: Option<f64>| length_m.map(|length_m| factor * length_m);
    Ok(StructureDescription {
        width_m: None,
        height_m: None,
        centre_height_m: None,
        slenderness_deg: None,
        slenderness_rad: Some(geometry.slenderness_rad()),
        size_m: Some(size_m),
        moment_of_inertia_kg_m2: of.moment_of_inertia_kg_m2.map(|inertia| factor * factor * inertia),
        curvature_radius_m: by_factor(of.curvature_radius_m),
        extended_width_m: by_factor(of.extended_width_m),
        ..*of
    })
}

/// The width `width_m` at the same height.
fn widened(of: &StructureDescription, width_m: f64) -> Result<StructureDescription, StructureError> {
    let geometry = of.geometry()?;
    let by_centre = of.kind.is_by_centre();
    let half_width_m = 0.5 * positive("width_m", width_m, "m")?;
    // the inertia about the corner, by that of the mass at its new distance
    let nearer_m2 = half_width_m * half_width_m - geometry.half_width_m() * geometry.half_width_m();
    Ok(StructureDescription {
        width_m: Some(width_m),
        height_m: (!by_centre).then(|| geometry.height_m()),
        centre_height_m: by_centre.then(|| geometry.half_height_m()),
        slenderness_deg: None,
        slenderness_rad: None,
        size_m: None,
        moment_of_inertia_kg_m2: of
            .moment_of_inertia_kg_m2
            .map(|inertia| inertia + of.mass_kg.unwrap_or_default() * nearer_m2),
        extended_width_m: of.extended_width_m.map(|extended_m| extended_m + width_m - geometry.width_m()),
        ..*of
    })
}

/// Tendons of another stiffness; an error for what has none.
fn tendons(of: &StructureDescription, stiffness_n_m: f64) -> Result<StructureDescription, Vec<StructureError>> {
    if of.kind != Kind::RestrainedFrame {
        return Err(vec![StructureError::NoTendons { kind: of.kind.name() }]);
    }
    Ok(StructureDescription { tendon_stiffness_n_m: Some(stiffness_n_m), ..*of })
}
