//! Frames in motion, planar and wobbling.

use serde::Deserialize;
use serde_json::{Map, Value};
use uplift_frame::{
    ColumnShape, FrameResponse, FrameState, GroundMotion, Model, Options, Pulse, PulseShape, RockingFrame, Shaking,
    Start, Until, respond,
};
use uplift_motion::Accelerogram;
use uplift_structure::Geometry;

use super::comparison::{Comparison, number};
use super::records::record;
use super::restrainer::restrainer;

/// A case that multiplies errors by so much that no digit is left: only what it shows at large is compared.
const CHAOTIC: f64 = 1e-2;
/// The moment of uplift does not depend on the motion.
const UPLIFT_TOLERANCE: f64 = 1e-9;
/// The largest acceleration of the deck is that of the steps of a solver, everybody's own.
const DECK_TOLERANCE: f64 = 1e-2;
/// Energy and momentum of free motion, relatively.
const INVARIANT_TOLERANCE: f64 = 1e-10;

#[derive(Deserialize)]
struct Case {
    #[serde(default)]
    model: Option<Model>,
    frame: Frame,
    restrainer: Value,
    #[serde(default)]
    input: Map<String, Value>,
    #[serde(default)]
    start: Value,
    #[serde(default)]
    restitution: Option<f64>,
    #[serde(default)]
    rest_amplitude_rad: Option<f64>,
    #[serde(default)]
    start_rotation_rad: Option<f64>,
    duration_s: f64,
    expected: Map<String, Value>,
}

#[derive(Deserialize)]
struct Frame {
    half_width_m: f64,
    half_height_m: f64,
    column_mass_kg: f64,
    deck_mass_kg: f64,
    columns: u32,
    #[serde(default)]
    restrained: Option<u32>,
    #[serde(default)]
    column_shape: Option<ColumnShape>,
    gravity_m_s2: f64,
}

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum Input {
    Sine(PulseInput),
    Cosine(PulseInput),
    HalfSine(PulseInput),
    Ricker(PulseInput),
    Record { record: String, factor: f64, time_scale: f64, dt_s: f64, gravity_m_s2: f64 },
}

#[derive(Deserialize)]
struct PulseInput {
    amplitude_m_s2: f64,
    period_s: f64,
    #[serde(default)]
    start_s: f64,
}

#[derive(Deserialize, Default)]
struct StartInput {
    theta: f64,
    #[serde(default)]
    omega: f64,
    #[serde(default)]
    phi: f64,
    #[serde(default)]
    phidot: f64,
}

/// A component that owns its record.
enum Component {
    Record(Accelerogram),
    Pulse(Pulse),
}

impl Component {
    fn shaking(&self) -> Shaking<'_> {
        match self {
            Self::Record(record) => Shaking::Record(record),
            Self::Pulse(pulse) => Shaking::Pulse(*pulse),
        }
    }
}

pub(crate) fn planar_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    motion_case(case, Model::Planar, comparison)
}

pub(crate) fn wobbling_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    motion_case(case, Model::Wobbling, comparison)
}

fn motion_case(case: &Value, listed: Model, comparison: &mut Comparison) -> Result<(), String> {
    let case: Case = serde_json::from_value(case.clone()).map_err(|error| error.to_string())?;
    let model = case.model.unwrap_or(listed);
    let frame = frame(&case, model)?;
    let component = |name: &str| case.input.get(name).filter(|value| is_something(value)).map(component).transpose();
    let (x, y, z) = (component("x")?, component("y")?, component("z")?);
    let ground = GroundMotion {
        x: x.as_ref().map(Component::shaking),
        y: y.as_ref().map(Component::shaking),
        z: z.as_ref().map(Component::shaking),
    };
    let options = Options {
        start: start(&case.start)?,
        until: Until::Time(case.duration_s),
        restitution: case.restitution,
        rest_amplitude_rad: Some(case.rest_amplitude_rad.unwrap_or(0.0)),
        start_rotation_rad: case.start_rotation_rad.unwrap_or(Options::default().start_rotation_rad),
    };
    let found = respond(&frame, &ground, model, &options).map_err(|error| error.to_string())?;
    let at = |time_s: f64| respond(&frame, &ground, model, &Options { until: Until::Time(time_s), ..options });
    // with nothing that dissipates, the peaks of free motion are equal: the time of any of them is right
    let recurs = |time_s: f64| {
        let is_free = time_s >= ground.duration_s() && found.rotation.time_s >= ground.duration_s();
        let end = if is_free { at(time_s).ok().map(|then| then.end) } else { None };
        end.filter(|end| {
            let tolerance = number(&case.expected, "end_abs_tol").unwrap_or(1e-9);
            (end.rotation_rad.abs() - found.rotation.value).abs() <= tolerance && end.velocity_rad_s.abs() <= tolerance
        })
    };
    compare(&case, &found, recurs, model, comparison);
    if let (Start::Tilted(start), Some(_)) = (options.start, number(&case.expected, "energy_drift")) {
        invariants(&frame, start, found.end, model, comparison);
    }
    Ok(())
}

fn frame(case: &Case, model: Model) -> Result<RockingFrame, String> {
    let of = &case.frame;
    let shape = if model == Model::Planar { ColumnShape::Rectangle } else { ColumnShape::Cylinder };
    let geometry = Geometry::from_width_and_height(2.0 * of.half_width_m, 2.0 * of.half_height_m)
        .map_err(|error| error.to_string())?;
    let frame = RockingFrame::new(
        geometry,
        of.columns,
        of.column_mass_kg,
        of.deck_mass_kg,
        of.column_shape.unwrap_or(shape),
        of.gravity_m_s2,
    )
    .map_err(|error| error.to_string())?;
    let Some((restrainer, path)) = restrainer(&case.restrainer)? else { return Ok(frame) };
    let held = frame.with_restrainer(restrainer, path).map_err(|error| error.to_string())?;
    match of.restrained {
        Some(restrained) => held.with_restrained(restrained).map_err(|error| error.to_string()),
        None => Ok(held),
    }
}

fn is_something(input: &Value) -> bool {
    !input.is_null() && input.get("kind").and_then(Value::as_str) != Some("none")
}

fn component(input: &Value) -> Result<Component, String> {
    let input: Input = serde_json::from_value(input.clone()).map_err(|error| format!("input: {error}"))?;
    let pulse = |shape, of: PulseInput| {
        Pulse::new(shape, of.amplitude_m_s2, of.period_s, of.start_s)
            .map(Component::Pulse)
            .map_err(|error| error.to_string())
    };
    match input {
        Input::Sine(of) => pulse(PulseShape::Sine, of),
        Input::Cosine(of) => pulse(PulseShape::Cosine, of),
        Input::HalfSine(of) => pulse(PulseShape::HalfSine, of),
        Input::Ricker(of) => pulse(PulseShape::Ricker, of),
        Input::Record { record: path, factor, time_scale, dt_s, gravity_m_s2 } => {
            record(&path, factor, gravity_m_s2, dt_s * time_scale).map(Component::Record)
        }
    }
}

fn start(start: &Value) -> Result<Start, String> {
    if start.is_null() || start.as_str() == Some("rest") {
        return Ok(Start::Rest);
    }
    let of: StartInput = serde_json::from_value(start.clone()).map_err(|error| format!("start: {error}"))?;
    Ok(Start::Tilted(FrameState {
        rotation_rad: of.theta,
        direction_rad: of.phi,
        velocity_rad_s: of.omega,
        turning_rad_s: of.phidot,
    }))
}

fn compare(
    case: &Case,
    found: &FrameResponse,
    recurs: impl Fn(f64) -> Option<FrameState>,
    model: Model,
    comparison: &mut Comparison,
) {
    let expected = &case.expected;
    let tolerance = number(expected, "suggested_rel_tol").unwrap_or(1e-9);
    let end_tolerance = number(expected, "end_abs_tol").unwrap_or(tolerance);
    comparison.tolerance = tolerance;
    let null = Value::Null;
    let of = |name: &str| expected.get(name).unwrap_or(&null);
    if let Some(status) = expected.get("status") {
        comparison.same("status", if found.overturned { "overturned" } else { "ok" }, status);
    }
    comparison.within("uplift_time_s", found.uplift_s, of("uplift_time_s"), 0.0, UPLIFT_TOLERANCE);
    if let Some(time) = expected.get("overturning_time_s") {
        comparison.compare("overturning_time_s", found.overturned.then_some(found.rotation.time_s), time);
    }
    if found.overturned {
        return;
    }
    if tolerance > CHAOTIC {
        if let Some(u_m) = number(expected, "u_max_m") {
            comparison.within(
                "u_max_m (its logarithm)",
                Some(found.displacement.value.ln()),
                &u_m.ln().into(),
                10_f64.ln(),
                0.0,
            );
        }
        return;
    }
    let u_m = number(expected, "u_max_m").unwrap_or(0.0);
    let peaks = [
        ("u_max_m", "t_max_s", found.displacement),
        ("ux_max_m", "t_ux_s", found.displacement_x),
        ("uy_max_m", "t_uy_s", found.displacement_y),
        ("theta_max_rad", "", found.rotation),
    ];
    let same_peak = number(expected, "t_max_s").and_then(recurs);
    for (name, time, peak) in peaks {
        let Some(value) = expected.get(name) else { continue };
        // beside the other component nothing: what is left is rounding
        comparison.within(name, Some(peak.value), value, 1e-15 * u_m, tolerance);
        let is_something = peak.value > 1e-9 * u_m;
        let is_told = is_something && !(time == "t_max_s" && same_peak.is_some());
        if let Some(time) = expected.get(time).filter(|time| !time.is_null() && is_told) {
            comparison.within(time_name(name), Some(peak.time_s), time, 1e-12, tolerance);
        }
    }
    if expected.contains_key("tendon_force_max_n") {
        comparison.compare("tendon_force_max_n", found.tendon_n, of("tendon_force_max_n"));
    }
    if expected.contains_key("spring_deformation_max_m") {
        comparison.compare("spring_deformation_max_m", found.spring_m, of("spring_deformation_max_m"));
    }
    if let Some(value) = expected.get("deck_acceleration_max_m_s2").filter(|value| !value.is_null()) {
        let ours = Some(found.deck_acceleration.value);
        comparison.within("deck_acceleration_max_m_s2", ours, value, 0.0, DECK_TOLERANCE);
    }
    // before a rest there are infinitely many
    let are_counted = model == Model::Planar && found.rests == 0;
    if let Some(value) = expected.get("impacts").filter(|value| !value.is_null() && are_counted) {
        comparison.within("impacts", Some(found.impacts as f64), value, 0.0, 0.0);
    }
    if let Some(value) = expected.get("rests").filter(|value| !value.is_null()) {
        comparison.within("rests", Some(found.rests as f64), value, 0.0, 0.0);
    }
    if let Some(value) = expected.get("theta_min_rad").filter(|value| !value.is_null()) {
        comparison.compare("theta_min_rad", found.least_rotation_rad, value);
    }
    // where the time of the peak is not defined, its direction is not
    if let (Some(direction), Some(_)) = (number(expected, "phi_at_max_rad"), number(expected, "t_max_s")) {
        let ours = same_peak.map_or(found.direction_at_peak_rad, |then| then.direction_rad);
        angle("phi_at_max_rad", ours, direction, end_tolerance, comparison);
    }
    if let Some(end) = expected.get("end").and_then(Value::as_object) {
        compare_end(found.end, end, end_tolerance, model, comparison);
    }
}

fn time_name(of: &str) -> &'static str {
    match of {
        "u_max_m" => "t_max_s",
        "ux_max_m" => "t_ux_s",
        _ => "t_uy_s",
    }
}

fn compare_end(
    end: FrameState,
    expected: &Map<String, Value>,
    tolerance: f64,
    model: Model,
    comparison: &mut Comparison,
) {
    // a frame that wobbles in a plane is reported with a sign, expected with a direction
    let turned = model == Model::Wobbling && end.rotation_rad < 0.0;
    let sign = if turned { -1.0 } else { 1.0 };
    let direction = end.direction_rad + if turned { std::f64::consts::PI } else { 0.0 };
    for (name, value) in expected {
        match name.as_str() {
            "theta" => comparison.within("end theta", Some(sign * end.rotation_rad), value, tolerance, 0.0),
            "omega" => comparison.within("end omega", Some(sign * end.velocity_rad_s), value, tolerance, 0.0),
            "phidot" => comparison.within("end phidot", Some(end.turning_rad_s), value, tolerance, 0.0),
            "phi" => {
                if let Some(value) = value.as_f64() {
                    angle("end phi", direction, value, tolerance, comparison);
                }
            }
            _ => comparison.unknown(&format!("end {name}")),
        }
    }
}

/// Angles that may differ by whole turns.
fn angle(name: &str, ours: f64, expected: f64, tolerance: f64, comparison: &mut Comparison) {
    let turns = ((ours - expected) / std::f64::consts::TAU).round();
    comparison.within(name, Some(ours - turns * std::f64::consts::TAU), &expected.into(), tolerance, 0.0);
}

/// Energy and momentum of free motion are constants.
fn invariants(frame: &RockingFrame, start: FrameState, end: FrameState, model: Model, comparison: &mut Comparison) {
    let energy = |of: FrameState| frame.energy_j(of.rotation_rad.abs(), of.velocity_rad_s, of.turning_rad_s);
    comparison.within("energy at the end", Some(energy(end)), &energy(start).into(), 0.0, INVARIANT_TOLERANCE);
    if model == Model::Wobbling {
        let momentum = |of: FrameState| frame.angular_momentum_kg_m2_s(of.rotation_rad.abs(), of.turning_rad_s);
        let expected = momentum(start).into();
        comparison.within("momentum at the end", Some(momentum(end)), &expected, 0.0, INVARIANT_TOLERANCE);
    }
}
