//! The worked example of docs/tutorial-pier.md: the pier by hand, from its dimensions alone, and what the program says.

use std::f64::consts::PI;
use std::path::Path;

use serde_json::Value;

use super::marks::hold;
use super::signed;
use crate::common::{repository, uplift};

const G: f64 = 9.806_65;

fn name(name: &str) -> String {
    format!("worked.{name}")
}

/// The rows of the table, with the numbers of the text alone.
fn by_hand() -> (Vec<(String, String)>, [f64; 2]) {
    let (width_m, height_m, deck_t, modulus_pa) = (1.2_f64, 12.0_f64, 220.0_f64, 33e9_f64);
    let slenderness = (width_m / height_m).atan();
    let column_t = width_m * width_m * height_m * 2.5;
    let heaviness = deck_t / column_t;
    let mass_t = column_t / 3.0 + deck_t;
    let force_kn = (column_t / 2.0 + deck_t) * G * slenderness;
    let factor = (column_t / 2.0 + deck_t) / mass_t;
    let stiffness_n_m = 12.0 * modulus_pa * (width_m.powi(4) / 12.0) / height_m.powi(3);
    let period_s = 2.0 * PI * (1e3 * mass_t / stiffness_n_m).sqrt();
    let uplift_mm = 1e6 * force_kn / stiffness_n_m;
    let lost = 1.5 * slenderness.sin().powi(2);
    let restitution = 1.0 - lost * (1.0 + 4.0 * heaviness) / (1.0 + 3.0 * heaviness);
    let computed = vec![
        (name("slenderness"), format!("{slenderness:.4}")),
        (name("masses"), format!("{column_t:.1} t; {heaviness:.2}")),
        (name("mass"), format!("{mass_t:.1} t")),
        (name("force"), format!("{force_kn:.0} kN")),
        (name("factor"), format!("{factor:.3}, {:.3}", factor * slenderness)),
        (name("stiffness"), format!("{:.1} MN/m", stiffness_n_m / 1e6)),
        (name("period"), format!("{period_s:.2} s")),
        (name("uplift"), format!("{uplift_mm:.1} mm")),
        (name("restitution"), format!("{restitution:.2}")),
    ];
    (computed, [factor, slenderness])
}

fn run(at: &Path, arguments: &[&str]) {
    let study = repository().join("configs/quick.toml");
    uplift(at, &[&["run", study.to_str().unwrap(), "-q"], arguments].concat()).ok();
}

fn design(at: &Path, result: &str) -> Value {
    let file = repository().join("configs/structures/single-pier.toml");
    let arguments = ["design", file.to_str().unwrap(), "--urs", result, "--site", "Athens", "--json", "-q"];
    uplift(at, &arguments).json()
}

fn metres(value: &Value, decimals: usize) -> String {
    format!("{:.decimals$} m", value.as_f64().unwrap())
}

#[test]
#[ignore = "long: make test-long"]
fn by_hand_and_by_the_program() {
    let (mut computed, [factor, slenderness]) = by_hand();
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), &["-o", "quick.h5"]);
    let found = design(folder.path(), "quick.h5");
    let of_spectrum_m = found["spectrum"]["ordinate_m"].as_f64().unwrap();
    let demand_m = factor * of_spectrum_m;
    let energy_m = 1.2 - ((1.2 - 0.006) * (1.2 - 2.0 * demand_m + 0.006)).sqrt();
    // Eq. 3.15 by hand: the capacity that is 2.5 times the demand that a structure of that capacity has
    let gap = |capacity_m: f64| {
        capacity_m - 2.5 * (capacity_m - ((capacity_m - 0.006) * (capacity_m - 2.0 * demand_m + 0.006)).sqrt())
    };
    let (mut low, mut high) = (2.0 * demand_m, 1e3);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if gap(middle) < 0.0 { low = middle } else { high = middle }
    }
    computed.extend([
        (name("reading"), format!("{of_spectrum_m:.4} m at {slenderness:.4}")),
        (name("times"), format!("{factor:.4} is {demand_m:.3} m")),
        (name("energy"), format!("{energy_m:.3} m")),
        (name("required"), format!("{low:.2} m, and {:.2} m", 1.2 - low)),
    ]);

    let (exact, rules) = (&found["exact"], &found["rules"]);
    let within = |rule: &str| {
        let range = &exact["within_one_percent_of_strength"]["rule_errors"][rule];
        ["lowest", "highest"].map(|end| range[end].as_f64().unwrap())
    };
    let [lowest, highest] = within("equal-displacement");
    assert!(lowest * highest > 0.0, "the error of equal displacement keeps its sign");
    let [lowest, highest] = within("equal-energy");
    assert!(lowest * highest < 0.0, "that of equal energy changes it");
    let error = -rules[1]["from_exact"]["error"].as_f64().unwrap();
    let own_m = exact["zero_stiffness_demand_m"].as_f64().unwrap();
    let spectral_mm = 1e3 * found["structure"]["uplift_displacement_m"].as_f64().unwrap() / factor;
    let years = 1.0 / exact["overturning"]["per_year"].as_f64().unwrap();
    assert!((9e3..1.3e4).contains(&years), "{years}: once in some ten thousand years");
    computed.extend([
        (
            name("zero-stiffness"),
            format!("{own_m:.2} m in place of {:.2}", exact["zero_stiffness_demand_of_spectrum_m"].as_f64().unwrap()),
        ),
        (name("own"), metres(&exact["demand_m"], 2)),
        (name("error"), format!("{:.0} %", 100.0 * error)),
        (name("spectral-uplift"), format!("{spectral_mm:.2} mm")),
    ]);

    let settings = ["--set", "oscillator.uplift_displacement_m=0.00582", "--set", "oscillator.restitution=0.98"];
    run(folder.path(), &[&["-o", "own.h5"], &settings[..]].concat());
    let energy = &design(folder.path(), "own.h5")["rules"][1]["from_spectrum"];
    computed.extend([
        (
            name("from-own"),
            format!("{} (error {} %)", metres(&energy["demand_m"], 2), signed(energy["error"].as_f64().unwrap())),
        ),
        (name("own-required"), metres(&energy["required_capacity_m"], 2)),
        (name("own-margin"), metres(&energy["margin_m"], 2)),
    ]);
    hold("worked", &computed);
}
