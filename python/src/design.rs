//! From the ordinate of a spectrum to a structure (Section 3.4.5).

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_structure::{Check, Rule};

use crate::errors::refused;
use crate::structure::Structure;

/// Demand on a structure, the capacity that it needs, and the one that it has (Eq. 3.8 to 3.15).
///
/// Attributes
/// ----------
/// zero_stiffness_demand_m : float
///     Demand on the oscillator of zero stiffness after uplift, m: Γ times the ordinate.
/// demand_m : float
///     Demand on the structure by the rule, m; `inf` where it overturns.
/// required_capacity_m : float
///     Capacity that the safety factor asks for, m (Eq. 3.15).
/// capacity_m : float
///     Capacity of the structure, m.
/// margin_m : float
///     Capacity less the required one, m.
/// safety_factor : float
///     Capacity over demand; 0 where it overturns.
/// is_satisfied : bool
///     Whether the capacity is at least the required one.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Design {
    zero_stiffness_demand_m: f64,
    demand_m: f64,
    required_capacity_m: f64,
    capacity_m: f64,
    margin_m: f64,
    safety_factor: f64,
    is_satisfied: bool,
}

#[pymethods]
impl Design {
    fn __repr__(&self) -> String {
        let Self { demand_m, required_capacity_m, capacity_m, .. } = self;
        format!(
            "<Design: demand {demand_m:.4} m, capacity {required_capacity_m:.4} m required, {capacity_m:.4} m there>"
        )
    }
}

/// Holds a structure against the ordinate of a spectrum by a rule of design (Section 3.4.5).
///
/// Parameters
/// ----------
/// structure : Structure
/// ordinate_m : float
///     Ordinate of the spectrum at ``structure.spectral_strength``, m.
/// rule : {"equal-energy", "equal-displacement"}, default "equal-energy"
///     How the demand follows from that of the oscillator of zero stiffness.
/// safety_factor : float, default 2.5
///     Capacity over demand that is asked for, 1 or more.
///
/// Returns
/// -------
/// Design
///
/// Raises
/// ------
/// ValueError
///     For a structure whose force rises after uplift, an ordinate that is negative or not finite, a safety factor
///     below 1.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 3.4.5. `uplift design` tests the design by the risk of the structure
/// itself.
#[pyfunction]
#[pyo3(signature = (structure, ordinate_m, *, rule = "equal-energy", safety_factor = 2.5))]
pub(crate) fn design(
    structure: &Bound<'_, Structure>,
    ordinate_m: f64,
    rule: &str,
    safety_factor: f64,
) -> PyResult<Design> {
    let rule = match rule {
        "equal-energy" => Rule::EqualEnergy,
        "equal-displacement" => Rule::EqualDisplacement,
        _ => {
            let message = format!("rule is {rule:?}: it must be \"equal-energy\" or \"equal-displacement\"");
            return Err(PyValueError::new_err(message));
        }
    };
    let system = &structure.get().read.system;
    let zero_stiffness_demand_m = system.zero_stiffness_demand_m(ordinate_m).map_err(refused)?;
    let check = Check::from_system(system, rule, safety_factor, zero_stiffness_demand_m).map_err(refused)?;
    Ok(Design {
        zero_stiffness_demand_m,
        demand_m: check.demand.displacement_m(),
        required_capacity_m: check.required_capacity_m,
        capacity_m: check.capacity_m,
        margin_m: check.margin_m(),
        safety_factor: check.safety_factor(),
        is_satisfied: check.is_satisfied(),
    })
}
