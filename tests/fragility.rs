//! `uplift export --fragility`: fragilities for other programs, against the counts of the same records.

use crate::common::{SMALL_STUDY, SmallStudy};
use crate::overturning::steps;

/// The rows of a table, by the names of its columns.
fn rows(study: &SmallStudy, name: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = std::fs::read_to_string(study.path().join(name)).unwrap();
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    (cells(text.lines().next().unwrap()), text.lines().skip(1).map(cells).collect())
}

fn poes(model: &str, function: &str, state: &str) -> Vec<f64> {
    let of = model.split(&format!("id=\"{function}\"")).nth(1).unwrap().split("</fragilityFunction>").next().unwrap();
    let text = of.split(&format!("<poes ls=\"{state}\">")).nth(1).unwrap().split('<').next().unwrap();
    text.split(' ').map(|number| number.parse().unwrap()).collect()
}

// two of three records overturn the block and its oscillator from 0.3 g on, and nothing lifts them before
#[test]
fn a_structure_known_by_hand() {
    let study = steps();
    study.uplift(&["export", "r.h5", "--fragility", "openquake", "--structure", "block.toml", "-q"]).ok();
    let model = std::fs::read_to_string(study.path().join("r.fragility.xml")).unwrap();
    assert!(model.contains("<limitStates>uplift capacity_50pct capacity overturning</limitStates>"), "{model}");
    assert!(model.contains("<imls imt=\"PGA\">0.05 0.12 0.3 0.8</imls>"), "{model}");
    for function in ["block_oscillator_pga", "block_block_pga"] {
        for state in ["capacity", "overturning"] {
            assert_eq!(poes(&model, function, state), [0.0, 0.0, 2.0 / 3.0, 2.0 / 3.0], "{function} {state}");
        }
    }
    assert!(!model.contains("_lognormal"), "shares that do not rise beyond 0.3 g have no fit: {model}");
    // again into its own file, and not into another's
    study.uplift(&["export", "r.h5", "--fragility", "openquake", "--structure", "block.toml", "-q"]).ok();
    study.write("other.xml", "<nrml/>");
    let asked = ["export", "r.h5", "--fragility", "openquake", "--structure", "block.toml", "-o", "other.xml"];
    study.uplift(&asked).fails(2, &["other.xml", "--force"]);
    let (names, table) = {
        let run = study.uplift(&["export", "r.h5", "--fragility", "pelicun", "--structure", "block.toml"]).ok();
        assert!(run.stderr.contains("block_oscillator_pga: no lognormal function"), "{run:?}");
        rows(&study, "r.pelicun.csv")
    };
    assert_eq!(names[..6], ["ID", "Incomplete", "Demand-Type", "Demand-Unit", "Demand-Offset", "Demand-Directional"]);
    assert_eq!(names[6..10], ["LS1-Family", "LS1-Theta_0", "LS1-Theta_1", "LS1-DamageStateWeights"]);
    let of: Vec<&[String]> = table.iter().map(|row| &row[..4]).collect();
    assert_eq!(of[0], ["block_oscillator_pga", "0", "Peak Ground Acceleration", "g"]);
    assert_eq!(of[1], ["block_oscillator_pga_lognormal", "1", "Peak Ground Acceleration", "g"]);
}

// between the levels 0.12 g, at which nothing lifts the block, and 0.3 g, at which two of three records overturn it
#[test]
fn demands_of_a_structure_known_by_hand() {
    let study = steps();
    let asked = ["export", "r.h5", "--demand", "here", "--structure", "block.toml", "--return-period", "475"];
    let run = study.uplift(&asked).ok();
    assert!(run.stderr.contains("location 1: block oscillator, location 2: block block; inf: overturned"), "{run:?}");
    let (names, table) = rows(&study, "r.demand.csv");
    assert_eq!(names, ["record", "1-PGA-0-1", "1-DEC-1-1", "1-DEC-2-1"]);
    assert_eq!(table[0], ["Units", "g", "m", "m"]);
    let level: f64 = table[1][1].parse().unwrap();
    assert!(level > 0.12 && level < 0.3, "{level}");
    for (row, name) in table[1..].iter().zip(["A", "B", "C"]) {
        let block_m: f64 = row[3].parse().unwrap();
        assert_eq!((row[0].as_str(), block_m.is_infinite()), (name, name != "B"), "{row:?}");
        assert!(name != "B" || block_m < 1e-3, "{row:?}");
    }
    let export = |more: &[&str]| study.uplift(&[&["export", "r.h5", "--demand", "Here"], more].concat());
    export(&[]).fails(2, &["--strength", "--structure"]);
    export(&["--strength", "0.3"]).fails(2, &["no strength 0.3: it has 0.1"]);
    export(&["--strength", "0.1", "--poe", "0.02,0.1"]).fails(2, &["one probability"]);
    export(&["--strength", "0.1", "--poe", "0.02", "--years", "500"]).fails(2, &["last level, 0.8 g"]);
    export(&["--strength", "0.1", "--capacity-share", "0.4"]).fails(2, &["--capacity-share"]);
    export(&["--strength", "0.1", "--fragility", "csv"]).fails(2, &["--fragility"]);
    export(&["--strength", "0.1", "--displacement-m", "0.1"]).fails(2, &["--displacement-m"]);
    export(&["--strength", "0.1", "--manifest", "x.csv"]).fails(2, &["--manifest"]);
    study.uplift(&["export", "r.h5", "--demand", "Rome", "--strength", "0.1"]).fails(2, &["no site Rome", "Here"]);
    study.uplift(&["export", "r.h5", "--strength", "0.1"]).fails(2, &["--fragility", "--demand"]);
}

// records that shake several oscillators each are rows each; a structure is shaken once by each motion
#[test]
fn demands_of_a_study_of_uncertain_oscillators() {
    let more = "[uncertainty]\nkind = \"aleatory\"\ndraws = 2\n[uncertainty.strength]\ndistribution = \
                \"lognormal\"\ncoefficient_of_variation = 0.2\n[strengths]";
    let study = SmallStudy::with(&SMALL_STUDY.replace("[strengths]", more));
    study.write("block.toml", "kind = \"block\"\nwidth_m = 0.4\nheight_m = 3\nmass_kg = 1000\n");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let count = |of: &[&str]| {
        study.uplift(&[&["export", "r.h5", "--demand", "Here", "--return-period", "475", "-q"], of].concat()).ok();
        rows(&study, "r.demand.csv").1.len() - 1
    };
    let of_structure = count(&["--structure", "block.toml"]);
    assert_eq!(count(&["--strength", "0.1"]), 2 * of_structure);
}

#[test]
fn the_curves_are_those_of_overturning() {
    let study = SmallStudy::new();
    study.write("block.toml", "kind = \"block\"\nwidth_m = 0.4\nheight_m = 3\nmass_kg = 1000\n");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["export", "r.h5", "--fragility", "csv", "--structure", "block.toml", "-q"]).ok();
    study.uplift(&["overturning", "block.toml", "--urs", "r.h5", "-o", "o.csv", "-q"]).ok();
    let (names, curves) = rows(&study, "r.fragility.csv");
    let (known, counts) = rows(&study, "o.csv");
    let at = |names: &[String], name: &str| names.iter().position(|own| own == name).unwrap();
    let mut compared = 0;
    for row in &counts {
        let of = |name: &str| row[at(&known, name)].as_str();
        let same = curves.iter().find(|own| {
            let is = |name: &str, value: &str| own[at(&names, name)] == value;
            is("im", of("im"))
                && is("system", &format!("block {}", of("model")))
                && is("level", of("level"))
                && is("limit_state", "overturning")
        });
        assert_eq!(same.unwrap()[at(&names, "exceeding")], of("overturned"), "{row:?}");
        compared += 1;
    }
    // two measures of five and four levels, two models
    assert_eq!(compared, 18);
}

#[test]
fn what_cannot_be_exported_is_named() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let export = |more: &[&str]| study.uplift(&[&["export", "r.h5", "--fragility", "csv"], more].concat());
    export(&[]).fails(2, &["--displacement-m", "--structure"]);
    export(&["--displacement-m", "0.1"]).fails(2, &["--strength"]);
    export(&["--displacement-m", "0.1", "--strength", "0.15"]).fails(2, &["no strength 0.15: it has 0, 0.05, 0.1"]);
    export(&["--displacement-m", "-1", "--strength", "0.1"]).fails(2, &["--displacement-m -1", "positive"]);
    export(&["--displacement-m", "0.1", "--strength", "0.1", "--measure", "cav"])
        .fails(2, &["no measure cav: it has pgv, pga"]);
    export(&["--displacement-m", "0.1", "--strength", "0.1", "--csv"]).fails(2, &["--csv"]);
    // of both measures, at two strengths
    export(&["--displacement-m", "0.1,0.3", "--strength", "0.1,0.2", "-q"]).ok();
    let (names, fits) = rows(&study, "r.fragility.fits.csv");
    assert_eq!((names[0].as_str(), fits.len()), ("id", 8));
    assert_eq!(fits[0][..4], ["strength_0p1_pgv", "PGV", "cm/s", "u_100mm"]);
}
