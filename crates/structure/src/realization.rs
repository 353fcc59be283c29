//! One of the structures that a structure may be, where some of its quantities are not known exactly.
//!
//! | quantity | what changes | what stays |
//! |---|---|---|
//! | strength | the force at uplift, `f̃_up = η m̃ g` | uplift displacement, displacement capacity, masses |
//! | restitution | velocity after over before an impact | everything else |
//! | uplift displacement | `ũ_up` | force at uplift, displacement capacity, masses |
//! | capacity | `ũ_cap` | force at uplift, uplift displacement, masses |
//!
//! What goes together, such as strength and capacity of a block whose width is uncertain, is told by a correlation.

use uplift_plausible::{
    CAPACITY, RESTITUTION, Range, STRENGTH, UPLIFT_DISPLACEMENT, USUAL_CAPACITY, USUAL_RESTITUTION, USUAL_STRENGTH,
    USUAL_UPLIFT_DISPLACEMENT,
};

use crate::equivalent::{Conditions, EquivalentSystem, PostUpliftForce};
use crate::error::{StructureError, positive};

/// A quantity of a structure that may be uncertain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UncertainQuantity {
    /// Uplift strength `η = f̃_up/(m̃ g)`.
    Strength,
    /// Velocity after over before an impact.
    Restitution,
    /// Displacement at uplift `ũ_up`, m.
    UpliftDisplacement,
    /// Displacement capacity `ũ_cap`, m.
    Capacity,
}

impl UncertainQuantity {
    /// Every quantity.
    pub const ALL: [Self; 4] = [Self::Strength, Self::Restitution, Self::UpliftDisplacement, Self::Capacity];

    /// Its key, with its unit.
    pub fn key(self) -> &'static str {
        match self {
            Self::Strength => "strength",
            Self::Restitution => "restitution",
            Self::UpliftDisplacement => "uplift_displacement_m",
            Self::Capacity => "capacity_m",
        }
    }

    /// Its name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Strength => "strength",
            Self::Restitution => "restitution",
            Self::UpliftDisplacement => "uplift displacement",
            Self::Capacity => "capacity",
        }
    }

    /// What it can be.
    pub fn range(self) -> Range {
        match self {
            Self::Strength => STRENGTH,
            Self::Restitution => RESTITUTION,
            Self::UpliftDisplacement => UPLIFT_DISPLACEMENT,
            Self::Capacity => CAPACITY,
        }
    }

    /// What it usually is.
    pub fn usual(self) -> Range {
        match self {
            Self::Strength => USUAL_STRENGTH,
            Self::Restitution => USUAL_RESTITUTION,
            Self::UpliftDisplacement => USUAL_UPLIFT_DISPLACEMENT,
            Self::Capacity => USUAL_CAPACITY,
        }
    }

    /// The value that `system` has, whose impacts keep `restitution` of the velocity; none of a capacity where the
    /// force does not fall.
    pub fn value(self, system: &EquivalentSystem, restitution: Option<f64>) -> Option<f64> {
        match self {
            Self::Strength => Some(system.strength()),
            Self::Restitution => restitution,
            Self::UpliftDisplacement => Some(system.conditions().uplift_displacement_m()),
            Self::Capacity => system.capacity_m(),
        }
    }
}

/// The values of the uncertain quantities of one structure; none of those that are as described.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Realization {
    /// Uplift strength `η`.
    pub strength: Option<f64>,
    /// Velocity after over before an impact.
    pub restitution: Option<f64>,
    /// Displacement at uplift, m.
    pub uplift_displacement_m: Option<f64>,
    /// Displacement capacity, m.
    pub capacity_m: Option<f64>,
}

impl Realization {
    /// Gives `quantity` this `value`, in its unit.
    pub fn set(&mut self, quantity: UncertainQuantity, value: f64) {
        let of = match quantity {
            UncertainQuantity::Strength => &mut self.strength,
            UncertainQuantity::Restitution => &mut self.restitution,
            UncertainQuantity::UpliftDisplacement => &mut self.uplift_displacement_m,
            UncertainQuantity::Capacity => &mut self.capacity_m,
        };
        *of = Some(value);
    }
}

impl EquivalentSystem {
    /// The same structure with the values of `realization`; one with its own values is itself, to the bit. The
    /// restitution is that of its [oscillator](Self::spectral_oscillator).
    ///
    /// # Errors
    /// A value that is not positive, a capacity not above the uplift displacement, or one where the force does not
    /// fall.
    pub fn realized(&self, realization: &Realization) -> Result<Self, StructureError> {
        let uplift_displacement_m =
            realization.uplift_displacement_m.unwrap_or(self.conditions().uplift_displacement_m());
        let uplift_force_n = match realization.strength {
            Some(strength) if strength.to_bits() != self.strength().to_bits() => {
                positive("strength", strength, "")? * self.mass_kg() * self.conditions().gravity_m_s2()
            }
            _ => self.uplift_force_n(),
        };
        let capacity_m = match (self.post_uplift(), realization.capacity_m) {
            (PostUpliftForce::Negative { capacity_m }, own) => own.unwrap_or(capacity_m),
            (PostUpliftForce::Zero, None) => f64::INFINITY,
            (PostUpliftForce::Positive { .. }, None) => {
                let conditions = Conditions::new(self.conditions().gravity_m_s2(), uplift_displacement_m)?;
                let uplift_force_n = positive("uplift_force_n", uplift_force_n, "N")?;
                return Ok(Self { uplift_force_n, conditions, ..self.clone() });
            }
            (PostUpliftForce::Zero | PostUpliftForce::Positive { .. }, Some(value)) => {
                let requirement = "left out: the force of this structure does not fall after uplift";
                return Err(StructureError::OutOfRange { key: "capacity_m", value, unit: "m", requirement });
            }
        };
        self.with_static_analysis(uplift_force_n, uplift_displacement_m, capacity_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::{Block, Reference};
    use crate::geometry::Geometry;

    fn block() -> EquivalentSystem {
        let geometry = Geometry::from_width_and_height(0.8, 7.0).unwrap();
        Block::new(geometry, 9000.0).unwrap().equivalent(Reference::Top, Conditions::default()).unwrap()
    }

    #[test]
    fn a_structure_with_its_own_values_is_itself() {
        let system = block();
        let mut own = Realization::default();
        assert_eq!(system.realized(&own).unwrap(), system);
        for quantity in UncertainQuantity::ALL {
            own.set(quantity, quantity.value(&system, Some(0.93)).unwrap());
        }
        assert_eq!(system.realized(&own).unwrap(), system);
        assert_eq!(own.restitution, Some(0.93));
    }

    #[test]
    fn each_value_changes_its_own_quantity() {
        let system = block();
        for (quantity, value) in [
            (UncertainQuantity::Strength, 0.11),
            (UncertainQuantity::UpliftDisplacement, 0.004),
            (UncertainQuantity::Capacity, 0.7),
        ] {
            let mut realization = Realization::default();
            realization.set(quantity, value);
            let changed = system.realized(&realization).unwrap();
            for other in UncertainQuantity::ALL {
                let [before, after] = [&system, &changed].map(|of| other.value(of, None));
                if other == quantity {
                    assert!((after.unwrap() / value - 1.0).abs() < 1e-15, "{other:?}");
                } else {
                    assert_eq!(before, after, "{other:?} with another {quantity:?}");
                }
            }
            assert_eq!((changed.mass_kg(), changed.participation()), (system.mass_kg(), system.participation()));
        }
        let below = Realization { capacity_m: Some(1e-4), ..Realization::default() };
        assert!(matches!(system.realized(&below), Err(StructureError::CapacityBelowUplift { .. })));
        let falls = system.with_static_analysis(1000.0, 0.001, f64::INFINITY).unwrap();
        assert!(matches!(falls.realized(&below), Err(StructureError::OutOfRange { .. })));
    }
}
