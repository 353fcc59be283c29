//! What cannot be is refused, with the key, the value and what to do.

use serde_json::{Value, json};
use uplift_statics::{Parts, RestrainedColumns, Restrainer, RestrainerDescription, TendonPath, WhenFlat};

use crate::hand_solutions::{column, stack};

fn stack_of_125() -> Value {
    json!({"kind": "disc-springs", "outer_diameter_m": 0.125, "inner_diameter_m": 0.061, "thickness_m": 0.006,
        "cone_height_m": 0.0036, "springs": 10, "tendon_stiffness_n_m": 13e6})
}

fn mistakes(changes: &Value) -> Vec<String> {
    let mut keys = stack_of_125();
    for (key, value) in changes.as_object().unwrap() {
        keys[key] = value.clone();
    }
    keys.as_object_mut().unwrap().retain(|_, value| !value.is_null());
    let description: RestrainerDescription = serde_json::from_value(keys).unwrap();
    description.resolve().unwrap_err().iter().map(std::string::ToString::to_string).collect()
}

#[track_caller]
#[allow(clippy::needless_pass_by_value)] // it is written in the call
fn refused(changes: Value, words: &str) {
    let found = mistakes(&changes);
    assert!(found.len() == 1 && found[0].contains(words), "{found:#?}");
}

#[test]
fn numbers_that_cannot_be() {
    refused(json!({"thickness_m": 0.0}), "`thickness_m` is 0 m: it must be from 1e-5 to 0.3 m (in m, not in mm");
    refused(json!({"inner_diameter_m": 0.2}), "must be below `outer_diameter_m` = 0.125 m");
    refused(json!({"springs": 0}), "`springs` is 0: it must be at least 1");
    refused(json!({"poisson": 0.7}), "`poisson` is 0.7: it must be from 0 to 0.5");
    refused(json!({"reduced_thickness_m": 0.007}), "with contact flats it lies below `thickness_m`");
    refused(json!({"cone_height_m": null, "free_height_m": 0.005}), "not above `thickness_m` = 0.006 m");
    refused(
        json!({"cone_height_m": 0.009}),
        "h0/t is 1.5".replace("h0/t", "the disc's cone height over its thickness").as_str(),
    );
    refused(json!({"prestress_n": 70e3}), "not below the 64028 N that press the springs flat");
    refused(json!({"prestress_n": 2e3, "tendon_yield_n": 1.5e3}), "not below the tendon's tendon_yield_n = 1500 N");
    refused(json!({"prestress_n": 2e3, "slack_m": 0.001}), "a tendon is either loose or taut");
    refused(json!({"stopper": {"gap_m": 0.04, "stiffness_n_m": 2e7}}), "it would never engage; shorten the gap");
    refused(json!({"stopper": {"gap_m": 0.001, "stiffness_n_m": 2e7}, "prestress_n": 5e3}), "take less prestress or a");
    refused(json!({"stopper": {"gap_m": 0.001, "stiffness_n_m": 0.0}}), "`stiffness_n_m` is 0 N/m");
}

/// Lengths in millimetres, an area in their squares, a modulus in megapascals: all at once, each with its unit.
#[test]
fn mistakes_of_unit() {
    let found = mistakes(&json!({"outer_diameter_m": 125, "inner_diameter_m": 61, "thickness_m": 6,
        "cone_height_m": 3.6, "young_modulus_pa": 206e3, "tendon_stiffness_n_m": null, "tendon_area_m2": 150.0,
        "tendon_length_m": 2.134, "stopper": {"gap_m": 15, "stiffness_n_m": 2e7}}));
    for words in [
        "`outer_diameter_m` is 125 m",
        "`inner_diameter_m` is 61 m",
        "`thickness_m` is 6 m",
        "`cone_height_m` is 3.6 m",
        "`young_modulus_pa` is 206000 Pa",
        "`tendon_area_m2` is 150 m2",
        "`gap_m` is 15 m",
    ] {
        assert!(found.iter().any(|message| message.contains(words)), "{words}: {found:#?}");
    }
    assert_eq!(found.len(), 7, "{found:#?}");
}

#[test]
fn missing_and_meaningless_keys_are_reported_together() {
    let found = mistakes(&json!({"springs": null, "thickness_m": null, "stiffness_n_m": 1e6, "duct_gap_m": 0.008,
        "tendon_area_m2": 1e-4}));
    for words in [
        "`springs` is missing",
        "`thickness_m` is missing",
        "`stiffness_n_m` means nothing",
        "`duct_gap_m`",
        "`tendon_stiffness_n_m` and `tendon_area_m2` are both given",
    ] {
        assert!(found.iter().any(|message| message.contains(words)), "{words}: {found:#?}");
    }
    refused(
        json!({"anchorage": "shifted", "duct_gap_m": 0.008}),
        "`tendon_length_m` is missing: anchorage \"shifted\" needs",
    );
    let none: RestrainerDescription = serde_json::from_value(json!({"kind": "none"})).unwrap();
    assert_eq!(none.resolve().unwrap(), None);
    assert!(serde_json::from_value::<RestrainerDescription>(json!({"kind": "linear", "stifness": 1.0})).is_err());
}

#[test]
fn tendons_that_do_not_go_with_the_column() {
    let law = Restrainer::new(Parts::discs(stack(), 13e6)).unwrap();
    let free = || RestrainedColumns::new(column(), 4, 30e3, 2e3).unwrap();
    let with = |duct_gap_m, tendon_length_m| {
        free()
            .with_restrainer(law.clone(), TendonPath::Shifted { duct_gap_m, tendon_length_m })
            .unwrap_err()
            .to_string()
    };
    assert!(with(0.01, 1.5).contains("`tendon_length_m` is 1.5 m, below the column's height of 1.6 m"));
    assert!(with(0.1, 2.0).contains("must be below the column's half width of 0.1 m"));
    assert!(RestrainedColumns::new(column(), 0, 1.0, 1.0).is_err());
    assert!(RestrainedColumns::new(column(), 1, 0.0, 0.0).is_err());
    assert!(RestrainedColumns::new(column(), 1, f64::NAN, 0.0).is_err());
}

#[test]
fn displacements_out_of_reach() {
    let stop = Parts { when_flat: WhenFlat::Stop, ..Parts::discs(stack(), 13e6) };
    let columns = RestrainedColumns::new(column(), 4, 30e3, 2e3)
        .unwrap()
        .with_restrainer(Restrainer::new(stop).unwrap(), TendonPath::Column)
        .unwrap();
    let message = columns.at_displacement(0.7).unwrap_err().to_string();
    assert!(message.contains("springs are flat, met at a displacement of 0.700000 m"), "{message}");
    let message = columns.at_displacement(10.0).unwrap_err().to_string();
    assert!(message.contains("beyond the column's reach"), "{message}");
    assert!(columns.at_displacement(-0.1).is_err() && columns.at_displacement(f64::NAN).is_err());
}
