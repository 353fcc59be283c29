//! What published criteria of overturning say, and how many real records overturn blocks at them
//! (docs/rocking-library.md).

use std::collections::HashMap;

use super::marks::hold;
use crate::common::{real_records, repository, uplift};

/// Gravity of the library, cm/s².
const GRAVITY_CM_S2: f64 = 980.665;

/// Ishiyama's least velocity, 10 B/√H in cm/s, over g tan α/p of a block of this slenderness.
fn least(slenderness_rad: f64) -> f64 {
    10.0 * (1.5 * slenderness_rad.cos() / GRAVITY_CM_S2).sqrt()
}

/// The velocity of the impulse that brings a block just to its unstable equilibrium, over the same.
fn impulse(slenderness_rad: f64) -> f64 {
    1.0 / (0.5 * slenderness_rad).cos()
}

#[test]
fn criteria_by_hand() {
    // 10 B/√H of a block of 40 cm by 200 cm
    let [width_cm, height_cm]: [f64; 2] = [40.0, 200.0];
    let slenderness_rad = (width_cm / height_cm).atan();
    let p_rad_s = (0.75 * GRAVITY_CM_S2 / (0.5 * width_cm.hypot(height_cm))).sqrt();
    let unit_cm_s = GRAVITY_CM_S2 * slenderness_rad.tan() / p_rad_s;
    let least_cm_s = 10.0 * width_cm / height_cm.sqrt();
    assert!((least(slenderness_rad) * unit_cm_s / least_cm_s - 1.0).abs() < 1e-12);
    // the angular velocity 3 V cos α/(4 R) after the impulse, and the energy up to the equilibrium
    let angular_rad_s =
        0.75 * impulse(slenderness_rad) * unit_cm_s * slenderness_rad.cos() / (0.5 * width_cm.hypot(height_cm));
    let needed = 2.0 * p_rad_s.powi(2) * (1.0 - slenderness_rad.cos());
    assert!((angular_rad_s.powi(2) / needed - 1.0).abs() < 1e-12);
}

#[test]
#[ignore = "long: make test-long"]
fn criteria_against_real_records() {
    let Some(records) = real_records() else { return };
    let criteria = ["least", "impulse"];
    let manifest = format!("records.manifest={}", records.join("manifest.csv").display());
    let library = repository().join("configs/rocking-library.toml").to_str().unwrap().to_owned();
    let folder = tempfile::tempdir().unwrap();
    let mut shares = [Vec::new(), Vec::new()];
    let mut computed = Vec::new();
    for slenderness_rad in [0.1, 0.2, 0.3] {
        let levels = [least, impulse].map(|of| of(slenderness_rad));
        let mut run = ["library", &library, "-o", "out", "-q", "--force"].map(str::to_owned).to_vec();
        let settings = [
            manifest.clone(),
            format!("block.slenderness_rad={slenderness_rad}"),
            format!("levels.pgv={levels:?}"),
            // next to nothing of what is not asked
            "levels.pga=0.5".to_owned(),
            "strengths.values=0.1".to_owned(),
            "oscillator.capacity_m=inf".to_owned(),
        ];
        run.extend(settings.into_iter().flat_map(|setting| ["--set".to_owned(), setting]));
        uplift(folder.path(), &run).ok();

        let text = std::fs::read_to_string(folder.path().join("out/levels.csv")).unwrap();
        let mut rows = text.lines();
        let names: Vec<&str> = rows.next().unwrap().split(',').collect();
        let cells = rows.map(|row| names.iter().copied().zip(row.split(',')).collect::<HashMap<_, _>>());
        let blocks: Vec<_> = cells.filter(|row| row["kind"] == "block" && row["im"] == "pgv").collect();
        // four sizes
        assert_eq!(blocks.len(), 4 * levels.len());
        computed.push(("published.motions".to_owned(), blocks[0]["motions"].to_owned()));
        for row in blocks {
            let criterion = levels.iter().position(|level| row["level"].parse() == Ok(*level)).unwrap();
            shares[criterion].push(row["share_overturning"].parse::<f64>().unwrap());
        }
    }
    for (name, shares) in criteria.into_iter().zip(shares) {
        let [low, high] = shares.iter().fold([1.0, 0.0], |[low, high]: [f64; 2], of| [low.min(*of), high.max(*of)]);
        computed.push((format!("published.{name}"), format!("{:.0} to {:.0} %", 100.0 * low, 100.0 * high)));
    }
    hold("published", &computed);
}
