//! Design and check by the rules (Section 3.4.5, Eq. 3.15).

use crate::equivalent::EquivalentSystem;
use crate::error::StructureError;
use crate::rule::{Capacity, Demand, Rule};

/// A structure's demand, the capacity it needs and the one it has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Check {
    /// Demand on the ZSBE system, `u_dem,ZS`, m.
    pub zero_stiffness_demand_m: f64,
    /// Demand on the structure with the capacity it has, `u_dem,NS`.
    pub demand: Demand,
    /// Capacity that the safety factor asks for (Eq. 3.15), m.
    pub required_capacity_m: f64,
    /// Capacity of the structure, `u_cap`, m; infinite for zero post-uplift stiffness.
    pub capacity_m: f64,
}

impl Check {
    /// Check a structure against a ZSBE demand on its own displacement, m (see
    /// [`EquivalentSystem::zero_stiffness_demand_m`]).
    ///
    /// # Errors
    /// Positive post-uplift stiffness, a safety factor below 1, or a demand that is not a finite number.
    pub fn from_system(
        system: &EquivalentSystem,
        rule: Rule,
        safety_factor: f64,
        zero_stiffness_demand_m: f64,
    ) -> Result<Self, StructureError> {
        Self::from_capacity(&system.capacity()?, rule, safety_factor, zero_stiffness_demand_m)
    }

    /// Check a capacity against a ZSBE demand, m.
    ///
    /// # Errors
    /// A safety factor below 1, or a demand that is not a finite number.
    pub fn from_capacity(
        capacity: &Capacity,
        rule: Rule,
        safety_factor: f64,
        zero_stiffness_demand_m: f64,
    ) -> Result<Self, StructureError> {
        let uplift_m = capacity.uplift_displacement_m();
        Ok(Self {
            zero_stiffness_demand_m,
            demand: rule.demand(capacity, zero_stiffness_demand_m)?,
            required_capacity_m: rule.required_capacity_m(zero_stiffness_demand_m, uplift_m, safety_factor)?,
            capacity_m: capacity.capacity_m(),
        })
    }

    /// Margin: capacity less required capacity, m; negative where the structure falls short.
    pub fn margin_m(&self) -> f64 {
        self.capacity_m - self.required_capacity_m
    }

    /// Factor of safety the structure has, `u_cap/u_dem,NS`: 0 where it overturns, infinite without a demand.
    pub fn safety_factor(&self) -> f64 {
        match self.demand {
            Demand::Overturns { .. } => 0.0,
            Demand::Stands { displacement_m, .. } => self.capacity_m / displacement_m,
        }
    }

    /// True where the capacity is at least the required one.
    pub fn is_satisfied(&self) -> bool {
        self.capacity_m >= self.required_capacity_m
    }
}

/// Step (c) of Section 3.4.5: choose the capacity of a structure whose unrestrained capacity is `own` and check it.
///
/// The capacity is that of Eq. 3.15, or the structure's own where that is larger: a restraint can only add to it. The
/// tables of the section do the same, with 1.60 m of the columns themselves. The tendons follow from
/// [`Frame::tendon_stiffness_for_capacity_n_m`](crate::Frame::tendon_stiffness_for_capacity_n_m).
///
/// ```
/// use uplift_structure::{Capacity, Rule, design};
/// // Table 3.5, near-field pulse-like, 2.0 PGA: 4.32 m, demand 1.728 m
/// let own = Capacity::new(0.0005, 1.6)?;
/// let check = design(&own, Rule::EqualEnergy, 2.5, 1.382)?;
/// assert_eq!(format!("{:.2}", check.capacity_m), "4.32");
/// assert_eq!(format!("{:.2}", check.demand.displacement_m()), "1.73");
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
///
/// # Errors
/// A safety factor below 1, or a demand that is not a finite number.
pub fn design(
    own: &Capacity,
    rule: Rule,
    safety_factor: f64,
    zero_stiffness_demand_m: f64,
) -> Result<Check, StructureError> {
    let uplift_m = own.uplift_displacement_m();
    let required_m = rule.required_capacity_m(zero_stiffness_demand_m, uplift_m, safety_factor)?;
    let chosen = Capacity::new(uplift_m, own.capacity_m().max(required_m))?;
    Check::from_capacity(&chosen, rule, safety_factor, zero_stiffness_demand_m)
}
