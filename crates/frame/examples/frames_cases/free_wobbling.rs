//! Frames that wobble freely, as given by the half diagonal, the slenderness and the ratio of deck to columns.

use serde::Deserialize;
use serde_json::{Value, json};

use super::comparison::Comparison;
use super::motions::wobbling_case;

/// The name of the record without motion.
const NO_MOTION: &str = "z";

/// How near the smallest rotation must be: it was looked for at samples.
const SAMPLED: f64 = 1e-6;

/// A case, in kN, m, Mg and s.
#[derive(Deserialize)]
struct Case {
    rec_x: String,
    rec_y: String,
    #[serde(rename = "T")]
    duration_s: f64,
    y0: Value,
    #[serde(rename = "R")]
    half_diagonal_m: f64,
    alpha: f64,
    m_c: f64,
    /// Mass of the deck over that of the columns.
    gamma: f64,
    /// Stiffness of the restrainer of one column, kN/m.
    k_res: f64,
    g: f64,
    expected: Value,
}

/// Whether nothing shakes the frame of a case: the records of the others are not in such a file.
pub(crate) fn is_free(case: &Value) -> bool {
    ["rec_x", "rec_y"].iter().all(|record| case[record] == NO_MOTION)
}

/// The case in the units of the others, checked like them.
pub(crate) fn free_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    let of: Case = serde_json::from_value(case.clone()).map_err(|error| error.to_string())?;
    if [&of.rec_x, &of.rec_y].iter().any(|record| *record != NO_MOTION) {
        return Err("its records are not in the file".to_owned());
    }
    let (sin, cos) = of.alpha.sin_cos();
    let column_mass_kg = 1e3 * of.m_c;
    let restrainer = if of.k_res > 0.0 {
        json!({"kind": "linear", "stiffness_n_m": 1e3 * of.k_res, "prestress_n": 0.0, "anchorage": "column"})
    } else {
        json!({"kind": "none"})
    };
    let mut expected = json!({"status": of.expected["status"], "suggested_rel_tol": 1e-8, "end_abs_tol": 1e-8});
    if let Some(end) = of.expected["y_end"].as_array() {
        expected["u_max_m"] = of.expected["U_max"].clone();
        expected["theta_max_rad"] = of.expected["theta_max"].clone();
        expected["end"] = json!({"theta": end[0], "phi": end[1], "omega": end[2], "phidot": end[3]});
    }
    let start = &of.y0;
    let as_others = json!({
        "frame": {
            "half_width_m": of.half_diagonal_m * sin,
            "half_height_m": of.half_diagonal_m * cos,
            "column_mass_kg": column_mass_kg,
            "deck_mass_kg": of.gamma * column_mass_kg,
            "columns": 1,
            "column_shape": "cylinder",
            "gravity_m_s2": of.g,
        },
        "restrainer": restrainer,
        "input": {},
        "start": {
            "theta": start["theta"], "phi": start["phi"], "omega": start["theta_dot"], "phidot": start["phi_dot"],
        },
        "restitution": 1.0,
        "duration_s": of.duration_s,
        "expected": expected,
    });
    wobbling_case(&as_others, comparison)?;
    if of.expected["y_end"].is_array() {
        let mut least = as_others;
        least["expected"] = json!({
            "status": "ok",
            "theta_min_rad": of.expected["theta_min"],
            "suggested_rel_tol": SAMPLED,
            "end_abs_tol": 1e-8,
        });
        wobbling_case(&least, comparison)?;
    }
    Ok(())
}
