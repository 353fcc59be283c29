//! Records as the shaking table plays them: factor and PGA at a level of PGV.

use serde_json::Value;
use uplift_frame::{TableLevel, srss};
use uplift_motion::{Accelerogram, STANDARD_GRAVITY_M_S2};

use super::comparison::{Comparison, number};
use super::records::plain;

/// Relative tolerance: both sides are computed with doubles.
const TOLERANCE: f64 = 1e-9;
/// Length scale of the model.
const LENGTH_SCALE: f64 = 5.0;
/// Level of PGV in the model's scale, m/s.
const LEVEL_M_S: f64 = 0.335;

pub(crate) fn shake_table_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    let case = case.as_object().ok_or("not an object")?;
    comparison.tolerance = number(case, "tolerance").unwrap_or(TOLERANCE);
    let component = |file: &str, step: &str| -> Result<Accelerogram, String> {
        let path = case.get(file).and_then(Value::as_str).ok_or_else(|| format!("no {file}"))?;
        let record = plain(path)?;
        match number(case, step) {
            Some(dt_s) => {
                Accelerogram::new(dt_s, record.acceleration_m_s2().to_vec()).map_err(|error| error.to_string())
            }
            None => Ok(record),
        }
    };
    let (x, y) = (component("file_h1", "dt1_s")?, component("file_h2", "dt2_s")?);
    let scale = number(case, "length_scale").unwrap_or(LENGTH_SCALE);
    let level =
        TableLevel::new(scale, number(case, "pgv_m_s").unwrap_or(LEVEL_M_S)).map_err(|error| error.to_string())?;
    let Some(([x, y], factor)) = level.pair([&x, &y]).map_err(|error| error.to_string())? else {
        return Err("the records do not move".to_owned());
    };
    if let Some(expected) = case.get("factor") {
        comparison.compare("factor", Some(factor), expected);
    }
    if let Some(expected) = case.get("pga_srss_g") {
        let pga_g = srss(x.pga_m_s2(), y.pga_m_s2()) / STANDARD_GRAVITY_M_S2;
        comparison.compare("pga_srss_g", Some(pga_g), expected);
    }
    Ok(())
}
