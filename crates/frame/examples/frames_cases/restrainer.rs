//! The restrainer of a case.

use serde_json::{Map, Value};
use uplift_statics::{Restrainer, RestrainerDescription, TendonPath};

/// A restrainer and its path as a file of cases has them.
pub(crate) fn restrainer(of_case: &Value) -> Result<Option<(Restrainer, TendonPath)>, String> {
    // in a file of cases a tendon's length may stand beside its stiffness, whatever its path
    let mut restrainer = of_case.clone();
    if let Some(keys) = restrainer.as_object_mut() {
        contact_flats(keys)?;
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
    let together =
        |mistakes: Vec<_>| mistakes.iter().map(uplift_statics::StaticsError::to_string).collect::<Vec<_>>().join("; ");
    description.resolve().map_err(together)
}

/// Takes out the key `contact_flats`: whether the discs have them is told by the reduced thickness beside it.
pub(crate) fn contact_flats(keys: &mut Map<String, Value>) -> Result<(), String> {
    let reduced = keys.get("reduced_thickness_m").is_some_and(|reduced| !reduced.is_null());
    match keys.remove("contact_flats") {
        None | Some(Value::Null) => Ok(()),
        Some(Value::Bool(flats)) if flats == reduced => Ok(()),
        Some(Value::Bool(true)) => Err("contact_flats: give reduced_thickness_m with it".to_owned()),
        Some(Value::Bool(false)) => Err("contact_flats is false, and reduced_thickness_m is given".to_owned()),
        Some(other) => Err(format!("contact_flats is {other}: true or false")),
    }
}
