//! The largest base that overturns under a wavelet (docs/pulses.md).

use super::marks::hold;
use crate::common::uplift;

/// Options that leave as little as may be of the figures but `by-half-width`.
pub const LITTLE_ELSE: [&str; 10] = [
    "--frequencies",
    "1,2",
    "--frequency-lines",
    "1,2",
    "--acceleration-lines",
    "1,2",
    "--sizes-m",
    "1,2",
    "--slendernesses",
    "0.1,0.2",
];

/// The largest base `2b ω_p²/a_p` that overturns, of the symmetric and the antisymmetric wavelet.
fn largest(slenderness: &str) -> [f64; 2] {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = ["pulse", "-o", "p", "-q", "--slenderness", slenderness].to_vec();
    arguments.extend(LITTLE_ELSE);
    arguments.extend(["--accelerations", "0.5:0.05:30", "--half-widths", "3:0.01:5"]);
    arguments.push("--json");
    let said = uplift(folder.path(), &arguments).ok().stdout;
    let said: serde_json::Value = serde_json::from_str(&said).unwrap();
    [0, 1].map(|wavelet| said["wavelets"][wavelet]["largest_overturning_base"].as_f64().unwrap())
}

/// A minute on a busy machine: 1 million motions.
#[test]
#[ignore = "minutes: make doc-figures"]
fn that_overturn() {
    let slendernesses = ["0.05", "0.1", "0.2", "0.3"];
    let computed: Vec<_> = (slendernesses.iter())
        .map(|slenderness| {
            let [symmetric, antisymmetric] = largest(slenderness);
            (format!("base-widths.{slenderness}"), format!("{symmetric:.2} and {antisymmetric:.2}"))
        })
        .collect();
    hold("base-widths", &computed);
}
