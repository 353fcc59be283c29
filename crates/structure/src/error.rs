//! What can be wrong with a structure, a demand or a design.

use thiserror::Error;
use uplift_plausible::{Implausible, after_value};

/// Why a structure has no equivalent oscillator, or a rule or design gives no answer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum StructureError {
    /// A number is outside the range that makes physical sense.
    #[error("`{key}` is {value}{}: it must be {requirement}", after_value(.unit))]
    OutOfRange {
        /// Name of the quantity, as in a description.
        key: &'static str,
        /// The value given.
        value: f64,
        /// Its unit, empty for a pure number.
        unit: &'static str,
        /// What would be accepted.
        requirement: &'static str,
    },
    /// A number of a description is beyond what any structure has.
    #[error("`{}`{}", .0.name, .0.to_string().trim_start_matches(.0.name))]
    Implausible(Implausible),
    /// A description lacks a quantity that its kind needs.
    #[error("`{key}` is missing: kind \"{kind}\" needs it; give it{}", in_unit(.unit))]
    Missing {
        /// Name of the quantity.
        key: &'static str,
        /// Its unit, empty for a pure number.
        unit: &'static str,
        /// Kind of structure.
        kind: &'static str,
    },
    /// A restrained frame does not say where its tendons are fixed.
    #[error(
        "`tendon_anchorage` is missing: kind \"restrained-frame\" needs it; give \"foundation\" or \"column\", \
         the stiffness of the former counts four times"
    )]
    MissingAnchorage,
    /// A description gives a quantity that its kind does not have.
    #[error(
        "`{key}` = {value}{} means nothing for kind \"{kind}\": remove it or choose another kind",
        after_value(.unit)
    )]
    Foreign {
        /// Name of the quantity.
        key: &'static str,
        /// The value given, as written.
        value: String,
        /// Its unit, empty for a pure number.
        unit: &'static str,
        /// Kind of structure.
        kind: &'static str,
    },
    /// A quantity is to be varied that no structure of this kind has.
    #[error(
        "kind \"{kind}\" has no tendons: vary strength, size, width or capacity, or write kind = \"restrained-frame\" \
         with the stiffness of its tendons"
    )]
    NoTendons {
        /// Kind of structure.
        kind: &'static str,
    },
    /// The geometry is given by too few or too many quantities, or by two that do not go together.
    #[error("the geometry is given by {given}: {advice}")]
    Geometry {
        /// The quantities given, with their values and units.
        given: String,
        /// What to give instead.
        advice: &'static str,
    },
    /// Neither the columns nor the deck have a mass.
    #[error("`column_mass_kg` and `deck_mass_kg` are both 0 kg: at least one must be positive")]
    Massless,
    /// The moment of inertia about the pivot is below that of all the mass at the centre.
    #[error(
        "`moment_of_inertia_kg_m2` is {moment_of_inertia_kg_m2} kg m², below m R² = {} kg m²: \
         give the moment of inertia about the pivot corner, not about the mass centre",
        four_digits(*least_kg_m2)
    )]
    InertiaBelowPointMass {
        /// The value given, kg m².
        moment_of_inertia_kg_m2: f64,
        /// Moment of inertia of the point mass, kg m².
        least_kg_m2: f64,
    },
    /// The curved extensions cannot reach the extended width.
    #[error(
        "`extended_width_m` is {extended_width_m} m: with `width_m` = {width_m} m and `curvature_radius_m` = \
         {radius_m} m it must lie between `width_m` and `width_m` + 2 `curvature_radius_m`"
    )]
    Extension {
        /// Width of the base with its extensions, m.
        extended_width_m: f64,
        /// Width of the flat part, m.
        width_m: f64,
        /// Radius of the extensions, m.
        radius_m: f64,
    },
    /// A period beside the displacement that follows from it.
    #[error("`period_s` and `uplift_displacement_m` give the displacement at uplift twice: leave one out")]
    UpliftTwice,
    /// The displacement capacity does not exceed the uplift displacement.
    #[error(
        "the displacement capacity {capacity_m} m is not above `uplift_displacement_m` = {uplift_displacement_m} m: \
         the restoring force would vanish before the structure uplifts; check the geometry or give a smaller uplift \
         displacement"
    )]
    CapacityBelowUplift {
        /// Displacement at which the restoring force vanishes, m.
        capacity_m: f64,
        /// Displacement at uplift, m.
        uplift_displacement_m: f64,
    },
    /// The force rises after uplift: there is no displacement capacity, and the rules do not apply.
    #[error(
        "the post-uplift stiffness is {stiffness_n_m} N/m, positive: the force never vanishes, and the equal \
         displacement and equal energy rules hold for negative stiffness only; analyse the positive-stiffness \
         oscillator itself or soften the tendons"
    )]
    PositiveStiffness {
        /// Stiffness after uplift, N/m.
        stiffness_n_m: f64,
    },
    /// A quantity computed from the input is not a number that can be used: the input is extreme.
    #[error("{what} comes out as {value}: the masses or lengths given are too large or too small")]
    NotRepresentable {
        /// What was computed.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A demand of the structure beyond its capacity corresponds to no demand of the ZSBE system.
    #[error(
        "`demand_m` is {demand_m} m, above the displacement capacity {capacity_m} m: beyond it the structure has \
         overturned"
    )]
    DemandAboveCapacity {
        /// Demand given, m.
        demand_m: f64,
        /// Displacement capacity, m.
        capacity_m: f64,
    },
}

impl StructureError {
    /// Keys of the description whose values are at fault, the one to change first before the others;
    /// empty where none is.
    pub fn keys(&self) -> &[&'static str] {
        match self {
            Self::OutOfRange { key, .. } | Self::Missing { key, .. } | Self::Foreign { key, .. } => {
                std::slice::from_ref(key)
            }
            Self::Implausible(Implausible { name, .. }) => std::slice::from_ref(name),
            Self::MissingAnchorage => &["tendon_anchorage"],
            Self::UpliftTwice => &["period_s"],
            Self::Geometry { .. } => {
                &["width_m", "height_m", "centre_height_m", "slenderness_rad", "slenderness_deg", "size_m"]
            }
            Self::Massless => &["deck_mass_kg", "column_mass_kg"],
            Self::InertiaBelowPointMass { .. } => &["moment_of_inertia_kg_m2"],
            Self::Extension { .. } => &["extended_width_m", "curvature_radius_m", "width_m"],
            Self::CapacityBelowUplift { .. } => &["uplift_displacement_m", "period_s"],
            _ => &[],
        }
    }
}

fn in_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" in {unit}") }
}

/// `value` if it is finite and positive.
///
/// # Errors
/// [`StructureError::OutOfRange`] if it is not.
pub fn positive(key: &'static str, value: f64, unit: &'static str) -> Result<f64, StructureError> {
    require(value > 0.0 && value.is_finite(), key, value, unit, "finite and positive")
}

/// `value` if it is finite and not negative.
///
/// # Errors
/// [`StructureError::OutOfRange`] if it is not.
pub fn not_negative(key: &'static str, value: f64, unit: &'static str) -> Result<f64, StructureError> {
    require(value >= 0.0 && value.is_finite(), key, value, unit, "finite and not negative")
}

/// `value` if it is finite and positive, where it was computed from what is.
///
/// # Errors
/// [`StructureError::NotRepresentable`] if it is not.
pub(crate) fn representable(what: &'static str, value: f64) -> Result<f64, StructureError> {
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err(StructureError::NotRepresentable { what, value }) }
}

/// `value` if `holds`.
///
/// # Errors
/// [`StructureError::OutOfRange`] if it does not.
pub fn require(
    holds: bool,
    key: &'static str,
    value: f64,
    unit: &'static str,
    requirement: &'static str,
) -> Result<f64, StructureError> {
    if holds { Ok(value) } else { Err(StructureError::OutOfRange { key, value, unit, requirement }) }
}

/// A value that was computed, without the digits that nobody gave.
fn four_digits(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
