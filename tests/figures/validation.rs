//! Table 6.2 decoded, and what its tests would have seen (docs/comparison.md).

use uplift_validation::{Evidence, KolmogorovSmirnov, Resampling, Sample, detectable_factor};

use serde_json::Value;

use super::marks::hold;
use super::signed;
use crate::common::{repository, uplift};

/// Dispersion of the power of the document.
const DISPERSION: f64 = 0.7;

#[test]
#[ignore = "long: make test-long"]
fn table_6_2_decoded() {
    let reference = std::fs::read_to_string(repository().join("tests/reference/table_6_2.csv")).unwrap();
    let mut computed = Vec::new();
    for line in reference.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [n, k] = [cells[2], cells[3]].map(|cell| cell.parse::<u32>().unwrap());
        let values = |from: f64| Sample::new((0..n).map(|place| f64::from(place) + from).collect()).unwrap();
        let test = KolmogorovSmirnov::from_samples(&values(0.0), &values(f64::from(k) - 0.5));
        let sizes = (n as usize, n as usize);
        let sees = detectable_factor(
            sizes,
            DISPERSION,
            0.1,
            Resampling { replicates: 2000, seed: 1, ..Resampling::default() },
        )
        .unwrap();
        let name = |what: &str| format!("validation.{}.{}.{what}", cells[0], cells[1]);
        computed.push((name("kstest2"), format!("{:.3}", test.p_kstest2)));
        computed.push((name("exact"), format!("{:.3}", test.p_exact)));
        computed.push((name("evidence"), Evidence::from_p(test.p_exact).words().to_owned()));
        computed.push((name("sees"), format!("{:.2}", sees.unwrap())));
    }
    hold("validation", &computed);
}

/// The specimen as built in the place of the tests, beside the model with a constant stiffness: twice 210 tests.
#[test]
#[ignore = "half a minute: make doc-figures"]
fn a_worked_example() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| repository().join(name).display().to_string();
    let (study, built) = (place("configs/shake-table.toml"), place("configs/structures/shake-table.toml"));
    let structure = format!("structure={built}");
    uplift(folder.path(), &["run", &study, "-o", "model.h5", "-q"]).ok();
    uplift(folder.path(), &["run", &study, "-o", "built.h5", "-q", "--set", &structure]).ok();
    let found = uplift(folder.path(), &["validate", "built.h5", "model.h5", "--by", "level", "--json"]).ok().stdout;
    let found: Value = serde_json::from_str(&found).unwrap();
    let mut computed = Vec::new();
    for group in found["groups"].as_array().unwrap() {
        let Some(level) = group["of"][0].as_str() else { continue };
        let number = |value: &Value, decimals: usize| format!("{:.decimals$}", value.as_f64().unwrap());
        let error = |value: &Value| signed(value.as_f64().unwrap());
        let band = &group["median_error_band"];
        let evidence = Evidence::from_p(group["p"].as_f64().unwrap()).words().to_owned();
        let collapses = format!("{}, {}", group["measured_collapses"], group["computed_collapses"]);
        let of = &group["kolmogorov_smirnov"];
        computed.extend(
            [
                ("distance", number(&of["distance"], 3)),
                ("exact", number(&of["p_exact"], 3)),
                ("evidence", evidence),
                ("sees", number(&group["detectable_factor"], 2)),
                (
                    "error",
                    format!("{} % ({} to {})", error(&group["median_error"]), error(&band["q05"]), error(&band["q95"])),
                ),
                ("spearman", number(&group["pairs"]["spearman"], 2)),
                ("collapses", collapses),
            ]
            .map(|(what, value)| (format!("validation-example.{level}.{what}"), value)),
        );
    }
    hold("validation-example", &computed);
}
