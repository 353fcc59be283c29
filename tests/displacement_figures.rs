//! Figures and report of displacement spectra: what can be read off them against the arrays of the result.

use std::collections::HashMap;

use serde_json::Value;
use uplift_labelled::LabelledReader;

use crate::common::SmallStudy;

/// Small oscillators: the synthetic motions are gentle.
const OSCILLATORS: &str = r#"kind = "displacement spectra"
title = "few"
[records.synthetic]
pairs = 4
[scaling]
to = ["1 PGA", "4 PGV"]
by = ["record", "component"]
[spectrum]
percentiles = [16, 50, 90]
[oscillator]
uplift_displacement_m = [0.0005, 0.005]
capacity_m = [0.05, 0.2, inf]
[strengths]
values = [0, 0.02, "0.05:0.05:0.6"]
[design]
width_m = 0.1
height_m = 1
noise_points = 1
"#;
const BLOCKS: &str = r#"kind = "displacement spectra"
[records.synthetic]
pairs = 2
[scaling]
to = ["unscaled", "4 PGV"]
by = "record"
[spectrum]
percentiles = [50]
[block]
height_m = [0.5, 2, 1000]
[slenderness]
values = [0.02, "0.05:0.05:0.3"]
[design]
height_m = 2
noise_points = 1
"#;

/// A line of a panel as it can be read off: points with five digits.
type Lines = HashMap<String, Vec<(f64, f64)>>;

/// The panels of a figure in the report: title and lines by name.
fn panels(page: &str, id: &str) -> Vec<(String, Lines)> {
    let figure =
        page.split_once(&format!("<figure class=\"block\" id=\"r1-{id}\">")).unwrap_or_else(|| panic!("{id}")).1;
    let json = figure.split_once("<script type=\"application/json\">").unwrap().1.split_once("</script>").unwrap().0;
    let panels: Vec<Value> = serde_json::from_str(json).unwrap();
    let lines = |panel: &Value| -> Lines {
        let lines = panel["lines"].as_array().unwrap().iter();
        lines
            .map(|line| {
                (line["name"].as_str().unwrap().to_owned(), serde_json::from_value(line["points"].clone()).unwrap())
            })
            .collect()
    };
    panels.iter().map(|panel| (panel["title"].as_str().unwrap().to_owned(), lines(panel))).collect()
}

/// The points of a line that are finite and lie beyond its last infinite ordinate.
fn drawn(abscissas: &[f64], ordinates: &[f64]) -> Vec<(f64, f64)> {
    let from = ordinates.iter().rposition(|u| u.is_infinite()).map_or(0, |last| last + 1);
    let points = abscissas.iter().copied().zip(ordinates.iter().copied()).skip(from);
    points.filter(|point| point.1.is_finite()).collect()
}

fn assert_same(found: &[(f64, f64)], expected: &[(f64, f64)], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (a, b) in found.iter().zip(expected) {
        let close = |a: f64, b: f64| (a - b).abs() <= 6e-5 * b.abs();
        assert!(close(a.0, b.0) && close(a.1, b.1), "{what}: {a:?} {b:?}");
    }
}

#[test]
fn spectra_of_oscillators() {
    let study = SmallStudy::with(OSCILLATORS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    assert!(page.len() < 1 << 20, "{}", page.len());
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let (eta, u) = (reader.axis::<f64>("strength").unwrap(), reader.array::<f64>("/spectra/u_m").unwrap());
    // [record_set, scaling, scaled_by, uplift_displacement, capacity, percentile, strength]
    assert_eq!(u.shape, [1, 2, 2, 2, 3, 3, eta.len()]);
    let spectrum = |scaling: usize, uplift: usize, capacity: usize, percentile: usize| {
        let row = (((scaling * 2) * 2 + uplift) * 3 + capacity) * 3 + percentile;
        &u.values[row * eta.len()..(row + 1) * eta.len()]
    };
    let names = ["u_cap = 0.05 m", "u_cap = 0.2 m", "u_cap = ∞"];
    let capacities_m = [0.05, 0.2, f64::INFINITY];
    let (mut cut, mut gaps) = (0, 0);
    for (percentile, word) in [(1, "median"), (2, "percentile-90")] {
        let plain = panels(&page, &format!("spectra-synthetic-{word}-uplift-0.0005"));
        let divided = panels(&page, &format!("equal-energy-synthetic-{word}-uplift-0.0005"));
        assert_eq!(plain.iter().map(|panel| panel.0.as_str()).collect::<Vec<_>>(), ["1 PGA", "4 PGV"]);
        for scaling in 0..2 {
            let zero_m = spectrum(scaling, 0, 2, percentile);
            for (capacity, name) in names.iter().enumerate() {
                let own_m = spectrum(scaling, 0, capacity, percentile);
                let points = drawn(&eta, own_m);
                cut += eta.len() - points.len();
                // a line of three points at least can be read off
                let found = |panels: &[(String, Lines)]| panels[scaling].1.get(*name).cloned().unwrap_or_default();
                if points.len() > 2 {
                    assert_same(&found(&plain), &points, &format!("{word} {scaling} {name}"));
                }
                // Eq. 3.11 as printed, for uplifted systems
                let (c, up) = (capacities_m[capacity], 0.0005);
                let over_gamma = own_m.iter().zip(zero_m).map(|(&u, &z)| {
                    let gamma = if c.is_infinite() || z <= up {
                        1.0
                    } else {
                        c / z - ((c - up) / z * ((c - 2.0 * z + up) / z)).sqrt()
                    };
                    if u.is_infinite() { u } else { u / gamma }
                });
                let over_gamma: Vec<f64> = over_gamma.collect();
                gaps += over_gamma.iter().filter(|u| u.is_nan()).count();
                if points.len() > 2 {
                    assert_same(&found(&divided), &drawn(&eta, &over_gamma), &format!("γ {word} {scaling} {name}"));
                }
            }
        }
    }
    println!("{cut} points left out below the last overturning, {gaps} by Eq. 3.14");
    assert!(cut > 0 && gaps > 0, "the study shows both");

    // Figure 3.17: a line an uplift displacement, of endless capacity
    let uplifts = panels(&page, "uplift-displacement");
    for (scaling, (title, lines)) in uplifts.iter().enumerate() {
        assert!(title.starts_with("synthetic, "), "{title}");
        for (uplift, name) in ["u_up = 0.0005 m", "u_up = 0.005 m"].into_iter().enumerate() {
            assert_same(&lines[name], &drawn(&eta, spectrum(scaling, uplift, 2, 1)), name);
        }
    }
    // the main figures are those of the first way of scaling and the smallest uplift displacement
    assert!(!page.contains("uplift-0.005\"") && !page.contains("-by-component\""));
    let motions = panels(&page, "motions-synthetic");
    assert_eq!(motions.len(), 6);
    assert!(motions.iter().all(|(title, _)| title.contains(" h") && title.contains("PGV")));
    for word in ["id=\"r1-sets\"", "id=\"r1-design-2\"", "equal energy", "u_dem_TH_m", "not for design"] {
        assert!(page.contains(word), "{word}");
    }
}

#[test]
fn every_figure_of_oscillators_is_drawn() {
    let study = SmallStudy::with(OSCILLATORS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["plot", "r.h5", "-q"]).ok();
    let mut expected = vec!["design".to_owned(), "motions-synthetic".to_owned()];
    for by in ["", "-by-component"] {
        expected.push(format!("uplift-displacement{by}"));
        for kind in ["spectra", "equal-energy"] {
            for percentile in ["median", "percentile-90"] {
                expected.extend(["0.0005", "0.005"].map(|up| format!("{kind}-synthetic-{percentile}-uplift-{up}{by}")));
            }
        }
    }
    let files = std::fs::read_dir(study.path().join("r.figures")).unwrap();
    let mut found: Vec<String> =
        files.map(|file| file.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned()).collect();
    expected.sort();
    found.sort();
    assert_eq!(found, expected);
    for name in &found {
        let svg = std::fs::read_to_string(study.path().join(format!("r.figures/{name}.svg"))).unwrap();
        assert!(svg.contains("synthetic records") && !svg.contains("NaN") && !svg.contains(",inf"), "{name}");
    }
    study.uplift(&["plot", "r.h5", "--only", "nonsense"]).fails(2, &["nonsense", "motions-synthetic"]);
}

#[test]
#[ignore = "long: make test-long"]
fn spectra_and_design_of_blocks() {
    let study = SmallStudy::with(BLOCKS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    study.uplift(&["plot", "r.h5", "-q", "--only", "design", "--format", "svg"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let (tangents, u) = (reader.axis::<f64>("slenderness").unwrap(), reader.array::<f64>("/spectra/u_m").unwrap());
    // [record_set, scaling, scaled_by, height, percentile, slenderness]
    assert_eq!(u.shape, [1, 2, 1, 3, 1, tangents.len()]);
    let spectra = panels(&page, "spectra-synthetic-median");
    let design = panels(&page, "design-synthetic");
    for scaling in 0..2 {
        for (height, name) in ["2H = 0.5 m", "2H = 2 m", "2H = 1000 m"].into_iter().enumerate() {
            let row = (scaling * 3 + height) * tangents.len();
            let points = drawn(&tangents, &u.values[row..row + tangents.len()]);
            if points.len() > 2 {
                assert_same(&spectra[scaling].1[name], &points, name);
            }
        }
        let capacity: Vec<(f64, f64)> = tangents.iter().map(|tangent| (*tangent, 2.0 * tangent)).collect();
        assert_same(&design[scaling].1["capacity 2H tan α, 2H = 2 m"], &capacity, "capacity");
    }
    assert!(!page.contains("equal-energy") && !page.contains("uplift-displacement"));
    assert!(study.path().join("r.figures/design.svg").is_file());

    // results of both kinds on one page
    let risk = SmallStudy::new();
    risk.uplift(&["run", "study.toml", "-o", "risk.h5", "-q"]).ok();
    let blocks = study.path().join("r.h5").display().to_string();
    risk.uplift(&["report", "risk.h5", &blocks, "-o", "both.html", "-q"]).ok();
    let both = std::fs::read_to_string(risk.path().join("both.html")).unwrap();
    assert!(both.contains("Uniform risk spectra, Displacement spectra for rocking structures"));
    assert!(both.contains("id=\"r1-urs-pgv\"") && both.contains("id=\"r2-spectra-synthetic-median\""));
}
