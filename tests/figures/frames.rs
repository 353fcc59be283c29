//! A frame beside its proxy (docs/frames.md): over models, strength and size, embedded records.

use std::fmt::Write;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;
use uplift_plot::{Axis, Figure, Look, Panel, Series, Tone, Width, svg};

use super::images::compare;
use super::marks::hold;
use crate::common::{repository, uplift};

/// What a planar frame and an oscillator keep at an impact, and a wobbling frame past the upright.
const KEPT: &str = "0.95";

/// Demands on a structure, m; infinite where it overturns more often than the target.
#[expect(clippy::struct_field_names, reason = "the unit")]
struct Demands {
    oscillator_m: f64,
    planar_m: f64,
    wobbling_m: f64,
}

/// Of the structure of this text, with the restitution of impacts and that of wobbling.
fn demands(folder: &Path, text: &str, [impacts, wobbling]: [&str; 2]) -> Demands {
    let own = text.lines().filter(|line| !line.starts_with("restitution")).collect::<Vec<_>>().join("\n");
    let keys = format!("restitution = {impacts}\nwobbling_restitution = {wobbling}\n");
    std::fs::write(folder.join("s.toml"), keys + &own).unwrap();
    let ask = ["design", "s.toml", "--urs", "r.h5", "--site", "Athens", "--measure", "pgv", "--poe", "0.02"];
    let said = uplift(folder, &[&ask[..], &["--json", "-q"]].concat()).ok().stdout;
    let design: Value = serde_json::from_str(&said).unwrap();
    let demand_m = |of: &Value| of["demand_m"].as_f64().unwrap_or(f64::INFINITY);
    let models = &design["own"]["models"];
    Demands {
        oscillator_m: demand_m(&design["exact"]),
        planar_m: demand_m(&models[1]),
        wobbling_m: demand_m(&models[0]),
    }
}

/// A frame without restrainers, of the footbridge's masses.
fn free(width_m: f64, height_m: f64) -> String {
    format!(
        "kind = \"frame\"\ncolumns = 4\nwidth_m = {width_m}\nheight_m = {height_m}\ncolumn_mass_kg = 2e3\n\
         deck_mass_kg = 60e3\ncolumn_shape = \"cylinder\"\n"
    )
}

/// A folder with the result of the quick study.
fn with_result() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/quick.toml").to_str().unwrap().to_owned();
    uplift(folder.path(), &["run", &study, "-o", "r.h5", "-q"]).ok();
    folder
}

/// Minutes: four designs.
#[test]
#[ignore = "minutes: make doc-figures"]
fn demands_on_frames_and_their_proxies() {
    let folder = with_result();
    let mut table = "\n| frame | oscillator, 0.95 | planar, 0.95 | planar, 1 | wobbling, 0.95 | wobbling, 1 |\n\
                     |---|---|---|---|---|---|\n"
        .to_owned();
    for name in ["footbridge", "prototype"] {
        let text = std::fs::read_to_string(repository().join(format!("configs/structures/{name}.toml"))).unwrap();
        let with = demands(folder.path(), &text, [KEPT, "1.0"]);
        let without = demands(folder.path(), &text, ["1.0", KEPT]);
        let all = [with.oscillator_m, with.planar_m, without.planar_m, without.wobbling_m, with.wobbling_m];
        write!(table, "| {name} ").unwrap();
        for demand_m in &all {
            write!(table, "| {demand_m:.2} ").unwrap();
        }
        table.push_str("|\n");
    }
    hold("frames", &[("frames.table".to_owned(), table)]);
}

/// Minutes: nine designs.
#[test]
#[ignore = "minutes: make doc-figures"]
fn demands_by_strength_and_size() {
    let folder = with_result();
    let strengths = [0.1, 0.15, 0.25];
    let mut lines: Vec<(&str, Vec<(f64, f64)>)> =
        ["wobbling, 10 m", "wobbling, 20 m", "wobbling 0.95, 10 m", "planar, 10 m"]
            .map(|name| (name, Vec::new()))
            .to_vec();
    for strength in strengths {
        let [small, large] = [10.0, 20.0].map(|height_m| free(strength * height_m, height_m));
        let [own, twice] = [&small, &large].map(|text| demands(folder.path(), text, [KEPT, "1.0"]));
        let loses = demands(folder.path(), &small, [KEPT, KEPT]);
        let over = |demands: &Demands, demand_m: f64| (strength, demand_m / demands.oscillator_m);
        lines[0].1.push(over(&own, own.wobbling_m));
        lines[1].1.push(over(&twice, twice.wobbling_m));
        lines[2].1.push(over(&loses, loses.wobbling_m));
        lines[3].1.push(over(&own, own.planar_m));
    }
    let series = lines.into_iter().enumerate().map(|(place, (name, points))| {
        let finite = points.into_iter().filter(|point| point.1.is_finite() && point.1 > 0.0).collect();
        Series::line(name, finite, Tone::Distinct(place))
    });
    let x = Axis::linear("uplift strength f_up/(m g)").between(0.0, 0.3);
    let panel = Panel::lines("", x, Axis::linear("demand over that of the oscillator"), series.collect());
    let figure = Figure {
        id: "frames".to_owned(),
        title: "Frames without restrainers, Athens, 2 % in 50 years, by PGV".to_owned(),
        caption: String::new(),
        remark: "30 synthetic pairs".to_owned(),
        panels: vec![panel],
        columns: 1,
    };
    compare("frames.svg", &svg(&figure, Look { width: Width::Double, title: true }).unwrap().svg);
}
