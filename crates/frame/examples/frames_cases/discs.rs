//! Disc springs: forces at deflections.

use serde_json::Value;
use uplift_statics::{RestrainerDescription, TendonAnchorage};

use super::comparison::{Comparison, number};
use super::restrainer::contact_flats;

/// Relative tolerance of a disc's force: a polynomial.
const TOLERANCE: f64 = 1e-12;

/// Keys of a disc that a restrainer does not have.
const OF_THE_CASE: [&str; 6] = ["id", "note", "points", "k4", "tolerance", "parallel"];

pub(crate) fn disc_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    let whole = case.as_object().ok_or("not an object")?;
    comparison.tolerance = number(whole, "tolerance").unwrap_or(TOLERANCE);
    let mut keys = whole.clone();
    keys.retain(|key, value| !value.is_null() && !OF_THE_CASE.contains(&key.as_str()));
    contact_flats(&mut keys)?;
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
