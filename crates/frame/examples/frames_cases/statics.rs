//! Columns with a restrainer: scalars and points of their pushover curves.

use serde::Deserialize;
use serde_json::{Map, Value};
use uplift_statics::{EventKind, PushoverState, RestrainedColumns};
use uplift_structure::Geometry;

use super::comparison::{Comparison, number};
use super::restrainer::restrainer;

/// Relative tolerance: both sides are computed with doubles.
const TOLERANCE: f64 = 1e-9;

#[derive(Deserialize)]
struct StaticsCase {
    half_width_m: f64,
    half_height_m: f64,
    top_load_n: f64,
    column_weight_n: f64,
    columns: u32,
    #[serde(default)]
    restrained: Option<u32>,
    restrainer: Value,
    #[serde(default)]
    scalars: Map<String, Value>,
    #[serde(default)]
    points: Vec<Map<String, Value>>,
    #[serde(default)]
    tolerance: Option<f64>,
}

pub(crate) fn statics_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    let case: StaticsCase = serde_json::from_value(case.clone()).map_err(|error| error.to_string())?;
    comparison.tolerance = case.tolerance.unwrap_or(TOLERANCE);
    let columns = columns(&case)?;
    for (name, expected) in &case.scalars {
        match scalar(&columns, name, &case.scalars) {
            Some(ours) => comparison.compare(name, ours?, expected),
            // what the next scalar is between, not a result
            None if name == "slope_drifts" => {}
            None => comparison.unknown(name),
        }
    }
    // where a quantity crosses zero, rounding is that of the larger terms that cancel
    let largest = |name: &str| {
        let sizes = case.points.iter().filter_map(|point| Some(number(point, name)?.abs()));
        sizes.fold(0.0, f64::max)
    };
    for (index, point) in case.points.iter().enumerate() {
        let state = match (number(point, "u_m"), number(point, "theta_rad")) {
            (Some(u_m), _) => columns.at_displacement(u_m),
            (None, Some(theta_rad)) => columns.at_rotation(theta_rad),
            (None, None) => return Err(format!("point {index} has neither u_m nor theta_rad")),
        };
        let state = state.map_err(|error| format!("point {index}: {error}"))?;
        for (name, expected) in point {
            match quantity(&columns, &state, name) {
                Ok(ours) => {
                    let (absolute, relative) = (comparison.tolerance * largest(name), comparison.tolerance);
                    comparison.within(&format!("point {index} {name}"), ours, expected, absolute, relative);
                }
                Err(Unknown) => comparison.unknown(&format!("point {index} {name}")),
            }
        }
    }
    Ok(())
}

fn columns(case: &StaticsCase) -> Result<RestrainedColumns, String> {
    let geometry = Geometry::from_width_and_height(2.0 * case.half_width_m, 2.0 * case.half_height_m)
        .map_err(|error| error.to_string())?;
    let free = RestrainedColumns::new(geometry, case.columns, case.top_load_n, case.column_weight_n)
        .map_err(|error| error.to_string())?;
    let Some((restrainer, path)) = restrainer(&case.restrainer)? else { return Ok(free) };
    let held = free.with_restrainer(restrainer, path).map_err(|error| error.to_string())?;
    match case.restrained {
        Some(restrained) => held.with_restrained(restrained).map_err(|error| error.to_string()),
        None => Ok(held),
    }
}

/// A scalar by its name; none for a name that is none.
fn scalar(
    columns: &RestrainedColumns,
    name: &str,
    scalars: &Map<String, Value>,
) -> Option<Result<Option<f64>, String>> {
    let event = |kind: EventKind| columns.first(kind).map(|event| event.state);
    let capacity = columns.capacity();
    let drifts = || -> Option<(f64, f64)> {
        let drifts = scalars.get("slope_drifts")?.as_array()?;
        Some((drifts.first()?.as_f64()?, drifts.get(1)?.as_f64()?))
    };
    Some(Ok(match name {
        "alpha_rad" => Some(columns.geometry().slenderness_rad()),
        "half_diagonal_m" => Some(columns.geometry().size_m()),
        "uplift_force_n" => Some(columns.uplift_force_n()),
        "capacity_m" => capacity.map(|capacity| capacity.displacement_m),
        "capacity_theta_rad" => capacity.map(|capacity| capacity.rotation_rad),
        "secant_at_capacity_n_m" => capacity.and_then(|capacity| capacity.secant_n_m),
        "spring_at_capacity_m" => capacity.and_then(|capacity| capacity.spring_m),
        "slope_secant_n_m" => {
            let (from, to) = drifts()?;
            return Some(columns.slope_between_drifts_n_m(from, to).map(Some).map_err(|error| error.to_string()));
        }
        "touch_theta_rad" => event(EventKind::TendonTouches).map(|state| state.rotation_rad),
        "touch_u_m" => event(EventKind::TendonTouches).map(|state| state.displacement_m),
        "touch_elongation_m" => event(EventKind::TendonTouches).map(|state| state.elongation_m),
        "stopper_engages_u_m" => event(EventKind::StopperEngages).map(|state| state.displacement_m),
        "stopper_engages_theta_rad" => event(EventKind::StopperEngages).map(|state| state.rotation_rad),
        "tendon_at_engagement_n" => event(EventKind::StopperEngages).map(|state| state.tendon_n),
        "stopper_yields_u_m" => event(EventKind::StopperYields).map(|state| state.displacement_m),
        "stopper_yields_theta_rad" => event(EventKind::StopperYields).map(|state| state.rotation_rad),
        "tendon_at_yield_n" => event(EventKind::StopperYields).map(|state| state.tendon_n),
        "springs_flat_u_m" => event(EventKind::SpringsFlat).map(|state| state.displacement_m),
        "springs_flat_theta_rad" => event(EventKind::SpringsFlat).map(|state| state.rotation_rad),
        "tendon_when_flat_n" => event(EventKind::SpringsFlat).map(|state| state.tendon_n),
        "tendon_yields_u_m" => event(EventKind::TendonYields).map(|state| state.displacement_m),
        "slack_taken_u_m" => event(EventKind::SlackTaken).map(|state| state.displacement_m),
        _ => return None,
    }))
}

/// A name that is no quantity of a point.
struct Unknown;

/// A quantity of a point by its name; none where the columns do not have it.
fn quantity(columns: &RestrainedColumns, state: &PushoverState, name: &str) -> Result<Option<f64>, Unknown> {
    Ok(match name {
        "u_m" => Some(state.displacement_m),
        "theta_rad" => Some(state.rotation_rad),
        "rise_m" | "v_m" => Some(state.rise_m),
        "drift" => Some(state.drift),
        "force_n" => Some(state.force_n),
        "tendon_n" => Some(state.tendon_n),
        "elongation_m" => Some(state.elongation_m),
        "elongation_rate_m" => Some(columns.elongation(state.rotation_rad).rate_m),
        "spring_m" => state.spring_m,
        "energy_j" => Some(state.energy_j),
        "top_axial_n" => Some(state.sections.top_axial_n),
        "top_moment_n_m" => Some(state.sections.top_moment_n_m),
        "top_shear_n" => Some(state.sections.top_shear_n),
        "base_axial_n" => Some(state.sections.base_axial_n),
        "base_moment_n_m" => Some(state.sections.base_moment_n_m),
        _ => return Err(Unknown),
    })
}
