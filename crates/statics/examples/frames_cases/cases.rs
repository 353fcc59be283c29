//! Cases of statics and of disc springs against what they expect.

use serde::Deserialize;
use serde_json::{Map, Value};
use uplift_statics::{EventKind, PushoverState, RestrainedColumns, RestrainerDescription, TendonAnchorage};
use uplift_structure::Geometry;

/// Relative tolerance of statics: both sides are computed with doubles.
const STATICS_TOLERANCE: f64 = 1e-9;
/// Relative tolerance of a disc's force: a polynomial.
const DISC_TOLERANCE: f64 = 1e-12;

/// What became of a case.
pub(crate) struct Verdict {
    /// Name of the case.
    pub(crate) id: String,
    /// Everything that differs, in words; empty where all agrees.
    pub(crate) differences: Vec<String>,
    /// Numbers that were compared.
    #[allow(dead_code)] // the tests ask for it
    pub(crate) compared: usize,
}

#[derive(Deserialize)]
struct File {
    #[serde(default)]
    statics: Vec<Value>,
    #[serde(default)]
    discs: Vec<Value>,
}

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

/// The verdict on every case of a file.
///
/// # Errors
/// The file is no JSON, or not an object with lists `statics` and `discs`.
pub(crate) fn verdicts(text: &str) -> Result<Vec<Verdict>, serde_json::Error> {
    let file: File = serde_json::from_str(text)?;
    let statics = file.statics.iter().map(|case| verdict(case, statics_case));
    Ok(statics.chain(file.discs.iter().map(|case| verdict(case, disc_case))).collect())
}

fn verdict(case: &Value, check: fn(&Value, &mut Comparison) -> Result<(), String>) -> Verdict {
    let id = case.get("id").and_then(Value::as_str).unwrap_or("(no id)").to_owned();
    let mut comparison = Comparison::default();
    if let Err(message) = check(case, &mut comparison) {
        comparison.differences.push(format!("cannot be computed: {message}"));
    }
    Verdict { id, differences: comparison.differences, compared: comparison.compared }
}

#[derive(Default)]
struct Comparison {
    differences: Vec<String>,
    compared: usize,
    tolerance: f64,
}

impl Comparison {
    /// `ours` against a number or null.
    fn compare(&mut self, name: &str, ours: Option<f64>, expected: &Value) {
        self.compared += 1;
        let agrees = match (ours, expected) {
            (None, Value::Null) => true,
            (Some(ours), expected) => expected.as_f64().is_some_and(|expected| {
                (ours - expected).abs() <= self.tolerance * expected.abs().max(f64::MIN_POSITIVE)
            }),
            (None, _) => false,
        };
        if !agrees {
            let ours = ours.map_or("none".to_owned(), |ours| ours.to_string());
            self.differences.push(format!("{name}: {ours} | {expected} | {:e}", self.tolerance));
        }
    }

    /// A name that this program has nothing for.
    fn unknown(&mut self, name: &str) {
        self.differences.push(format!("{name}: not a quantity that is computed here"));
    }
}

fn statics_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    let case: StaticsCase = serde_json::from_value(case.clone()).map_err(|error| error.to_string())?;
    comparison.tolerance = case.tolerance.unwrap_or(STATICS_TOLERANCE);
    let columns = columns(&case)?;
    for (name, expected) in &case.scalars {
        match scalar(&columns, name, &case.scalars) {
            Some(ours) => comparison.compare(name, ours?, expected),
            // what the next scalar is between, not a result
            None if name == "slope_drifts" => {}
            None => comparison.unknown(name),
        }
    }
    for (index, point) in case.points.iter().enumerate() {
        let state = match (number(point, "u_m"), number(point, "theta_rad")) {
            (Some(u_m), _) => columns.at_displacement(u_m),
            (None, Some(theta_rad)) => columns.at_rotation(theta_rad),
            (None, None) => return Err(format!("point {index} has neither u_m nor theta_rad")),
        };
        let state = state.map_err(|error| format!("point {index}: {error}"))?;
        for (name, expected) in point {
            match quantity(&columns, &state, name) {
                Ok(ours) => comparison.compare(&format!("point {index} {name}"), ours, expected),
                Err(Unknown) => comparison.unknown(&format!("point {index} {name}")),
            }
        }
    }
    Ok(())
}

fn columns(case: &StaticsCase) -> Result<RestrainedColumns, String> {
    // in a file of cases a tendon's length may stand beside its stiffness, whatever its path
    let mut restrainer = case.restrainer.clone();
    if let Some(keys) = restrainer.as_object_mut() {
        let none = keys.get("kind").and_then(Value::as_str) == Some("none");
        let shifted = keys.get("anchorage").and_then(Value::as_str) == Some("shifted");
        keys.retain(|key, value| !value.is_null() && (!none || key == "kind"));
        if !shifted {
            keys.remove("duct_gap_m");
            if !keys.contains_key("tendon_area_m2") {
                keys.remove("tendon_length_m");
            }
        }
    }
    let description: RestrainerDescription =
        serde_json::from_value(restrainer).map_err(|error| format!("restrainer: {error}"))?;
    let geometry = Geometry::from_width_and_height(2.0 * case.half_width_m, 2.0 * case.half_height_m)
        .map_err(|error| error.to_string())?;
    let free = RestrainedColumns::new(geometry, case.columns, case.top_load_n, case.column_weight_n)
        .map_err(|error| error.to_string())?;
    let together =
        |mistakes: Vec<_>| mistakes.iter().map(uplift_statics::StaticsError::to_string).collect::<Vec<_>>().join("; ");
    let Some((restrainer, path)) = description.resolve().map_err(together)? else { return Ok(free) };
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

fn number(of: &Map<String, Value>, name: &str) -> Option<f64> {
    of.get(name).and_then(Value::as_f64)
}

/// Keys of a disc that a restrainer does not have.
const OF_THE_CASE: [&str; 6] = ["id", "note", "points", "k4", "tolerance", "parallel"];

fn disc_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    let whole = case.as_object().ok_or("not an object")?;
    comparison.tolerance = number(whole, "tolerance").unwrap_or(DISC_TOLERANCE);
    let mut keys = whole.clone();
    keys.retain(|key, value| !value.is_null() && !OF_THE_CASE.contains(&key.as_str()));
    let series = keys.remove("springs").and_then(|springs| springs.as_u64()).unwrap_or(1);
    keys.insert("kind".to_owned(), "disc-springs".into());
    let description: RestrainerDescription =
        serde_json::from_value(Value::Object(keys)).map_err(|error| error.to_string())?;
    debug_assert_eq!(description.anchorage.unwrap_or_default(), TendonAnchorage::Column);
    let disc = description
        .disc()
        .map_err(|mistakes| mistakes.first().map_or(String::new(), std::string::ToString::to_string))?;
    if let Some(k4) = whole.get("k4") {
        comparison.compare("k4", Some(disc.flats_factor()), k4);
    }
    let count = |value: u64| u32::try_from(value).map_err(|error| error.to_string());
    let parallel = whole.get("parallel").and_then(Value::as_u64).unwrap_or(1);
    let law = disc.law().stacked(count(parallel)?, count(series)?);
    for (index, point) in case.get("points").and_then(Value::as_array).into_iter().flatten().enumerate() {
        let point = point.as_object().ok_or("a point is not an object")?;
        let deflection_m = number(point, "deflection_m").ok_or("a point has no deflection_m")?;
        for (name, expected) in point {
            match name.as_str() {
                "deflection_m" => {}
                "force_n" => {
                    comparison.compare(&format!("point {index} {name}"), Some(law.force_n(deflection_m)), expected);
                }
                "stiffness_n_m" => {
                    let ours = law.stiffness_n_m(deflection_m);
                    comparison.compare(&format!("point {index} {name}"), Some(ours), expected);
                }
                "energy_j" => {
                    comparison.compare(&format!("point {index} {name}"), Some(law.energy_j(deflection_m)), expected);
                }
                _ => comparison.unknown(&format!("point {index} {name}")),
            }
        }
    }
    Ok(())
}
