//! The rules' own errors (docs/design-rules.md): three structures at six sites, real records.

use serde_json::Value;

use super::marks::hold;
use super::{range, signed, with_real_records};
use crate::common::{repository, uplift};

const SITES: [&str; 6] = ["Aachen", "Athens", "Baden", "Focsani", "Montreux", "Perugia"];
/// Demand over capacity from which on a structure is near its capacity, and told apart.
const NEAR: f64 = 0.9;

/// The error of a rule, of equal displacement or equal energy, on the exact demand or on the spectrum as read.
fn error(design: &Value, rule: usize, from: &str) -> Option<f64> {
    design["rules"][rule][from]["error"].as_f64()
}

/// Many minutes: 5 million analyses, then 36 designs of as many as 0.2 million each.
#[test]
#[ignore = "many minutes: make doc-figures"]
fn errors_of_the_rules() {
    let Some(set) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let run = ["run", &study, "-o", "r.h5", "-q", "--set", "risk.maf_surface=false"].map(str::to_owned);
    uplift(folder.path(), &[&run[..], &set].concat()).ok();
    let mut computed = Vec::new();
    let mut near = Vec::new();
    for (im, name) in ["pgv", "pga"].into_iter().flat_map(|im| ["pier", "frame", "block"].map(|name| (im, name))) {
        let file = repository().join(format!("configs/structures/{name}.toml"));
        let designs: Vec<Value> = SITES
            .map(|site| {
                let arguments = ["design", file.to_str().unwrap(), "--urs", "r.h5", "--site", site, "--measure", im];
                let said = uplift(folder.path(), &[&arguments[..], &["--json", "-q"]].concat()).ok().stdout;
                serde_json::from_str(&said).unwrap()
            })
            .to_vec();
        let over_capacity = |design: &Value| {
            let demand_m = design["exact"]["demand_m"].as_f64().filter(|_| design["exact"]["overturns"] != true);
            demand_m.map_or(f64::INFINITY, |demand_m| demand_m / design["structure"]["capacity_m"].as_f64().unwrap())
        };
        let (far, close): (Vec<_>, Vec<_>) = designs.iter().partition(|design| over_capacity(design) < NEAR);
        near.extend(close.into_iter().map(|design| (over_capacity(design), design.clone())));
        if (im, name) == ("pga", "pier") {
            let noise = &designs[3]["exact"]["within_one_percent_of_strength"]["rule_errors"]["equal-energy"];
            let [lowest, highest] = ["lowest", "highest"].map(|end| signed(noise[end].as_f64().unwrap()));
            computed.push(("designs.focsani".to_owned(), format!("{lowest} to {highest} %")));
        }
        if (im, name) == ("pgv", "pier") {
            let end = |name: &str, end: &str| designs[1]["exact"]["rounding"][name][end].as_f64().unwrap();
            let range = |name: &str| [end(name, "lowest"), end(name, "highest")];
            let [low, high] = range("zero_stiffness_demand_of_spectrum_m");
            computed.push(("designs.rounding-demand".to_owned(), format!("{} m", between(low, high, 4))));
            let [low, high] = range("overturning_per_year").map(|rate| 1e5 * rate);
            computed.push(("designs.rounding-risk".to_owned(), format!("{low:.3} to {high:.3}")));
        }
        if (im, name) == ("pgv", "block") {
            let reading = [0, 2, 4].map(|site: usize| error(&designs[site], 0, "from_spectrum").unwrap());
            let [low, high] = range(reading);
            computed.push(("designs.reading".to_owned(), format!("{} to {} %", signed(low), signed(high))));
        }
        let [low, high] = range(far.iter().map(|design| over_capacity(design)));
        computed.push((format!("designs.{im}.{name}.demand"), format!("{low:.2} to {high:.2}")));
        for (rule, short) in ["ed", "ee"].into_iter().enumerate() {
            let [low, high] = range(far.iter().filter_map(|design| error(design, rule, "from_exact")));
            computed.push((format!("designs.{im}.{name}.{short}"), format!("{} to {}", signed(low), signed(high))));
        }
    }
    let standing: Vec<_> = near.iter().filter(|(share, _)| share.is_finite()).collect();
    let mut shares: Vec<String> = standing.iter().map(|(share, _)| format!("{share:.2}")).collect();
    shares.sort();
    let by_displacement = standing.iter().filter_map(|(_, design)| error(design, 0, "from_exact"));
    let [low, high] = range(by_displacement.map(|error| -100.0 * error));
    let warned = near.iter().filter(|(_, design)| design["rules"][1]["from_exact"]["overturns"] == true).count();
    computed.extend([
        ("designs.near".to_owned(), near.len().to_string()),
        ("designs.near-demand".to_owned(), shares.join(" and ")),
        ("designs.near-ed".to_owned(), format!("{} %", between(low, high, 0))),
        ("designs.near-ee".to_owned(), warned.to_string()),
    ]);
    hold("designs", &computed);
}

/// From where to where, or the one value that both are in these digits.
fn between(low: f64, high: f64, digits: usize) -> String {
    let [low, high] = [low, high].map(|end| format!("{end:.digits$}"));
    if low == high { low } else { format!("{low} to {high}") }
}
