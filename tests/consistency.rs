//! Whether the records bring the hazard of the other measure: `uplift consistency`, and what a run says of it.

use serde_json::Value;
use uplift::result::ResultFile;
use uplift_motion::IntensityMeasure;

use crate::common::{Finished, SmallStudy, repository};

/// 105 synthetic pairs at Montreux and Athens, three strengths, the stripes of Chapter 4.
fn study(measures: &str, sites: &str, more: &str) -> SmallStudy {
    let hazard = repository().join("hazard").display().to_string();
    let site = |name: &str| {
        let file = |measure: &str| format!("{measure} = '{hazard}/{}/{measure}.csv'", name.to_lowercase());
        let curves: Vec<String> = sites.split(' ').map(file).collect();
        format!("[[sites]]\nname = \"{name}\"\n{}\n", curves.join("\n"))
    };
    SmallStudy::with(&format!(
        "[strengths]\nvalues = [0.1, 0.2, 0.4]\n{measures}\n[risk]\nmaf_surface = false\n[hazard]\nconversions = \
         [{{ from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }}]\n{}{}{more}",
        site("Montreux"),
        site("Athens")
    ))
}

const BOTH: &str = "[pgv]\nlevels_cm_s = [\"1:0.5:20\", \"25:5:200\"]\n[pga]";

fn json(finished: &Finished) -> Value {
    serde_json::from_str(&finished.stdout).unwrap()
}

fn row<'a>(report: &'a Value, site: &str, scaled_to: &str) -> &'a Value {
    let rows = report["rows"].as_array().unwrap();
    rows.iter().find(|row| row["site"] == site && row["scaled_to"] == scaled_to).unwrap()
}

/// The numbers of every plain array.
fn plain(study: &SmallStudy, name: &str) -> Vec<u64> {
    let file = ResultFile::open(&study.path().join(name)).unwrap();
    let spectra = file.spectra().unwrap();
    let mut numbers: Vec<f64> = Vec::new();
    for measure in &spectra.measures {
        for values in [&measure.u_m, &measure.lower_tail_share, &measure.upper_tail_share] {
            numbers.extend(values.values());
        }
        numbers.extend(measure.fits.values().iter().flat_map(|fit| [fit.c0_m, fit.c1, fit.c2_m, fit.rmse_m]));
    }
    numbers.into_iter().map(f64::to_bits).collect()
}

#[test]
fn asked_in_every_run_and_repaired_beside_the_plain_spectra() {
    let study = study(BOTH, "pgv pga", "");
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    assert!(run.stdout.contains("spectra by PGA are not hazard-consistent"), "{}", run.stdout);
    assert!(run.stdout.contains("[consistency] repair = \"weights\""), "{}", run.stdout);
    let before = plain(&study, "r.h5");

    let asked = json(&study.uplift(&["consistency", "r.h5", "--json", "-q"]).ok());
    assert_eq!(asked["rows"].as_array().unwrap().len(), 4);
    let by_pga = row(&asked, "Montreux", "PGA");
    assert_eq!((&by_pga["shows"], &by_pga["verdict"]), (&Value::from("PGV"), &Value::from("inconsistent")));
    // by definition: exp of the mean, and levels over levels
    assert!(by_pga["bias"].as_f64().unwrap() > 1.33);
    for target in by_pga["targets"].as_array().unwrap() {
        let number = |key: &str| target[key].as_f64().unwrap();
        assert!((number("implied_level") / number("site_level") / number("ratio") - 1.0).abs() < 1e-12);
    }
    assert!(by_pga["repair"].is_null());

    let repaired = json(&study.uplift(&["consistency", "r.h5", "--repair", "--json", "-q"]).ok());
    let by_pga = row(&repaired, "Montreux", "PGA");
    assert!(by_pga["repair"]["max"].as_f64().unwrap() < 0.05 && by_pga["repair"]["failed"].is_null(), "{by_pga}");
    // the ordinates by both measures come together
    let all = repaired["agreement"].as_array().unwrap().last().unwrap();
    let mean = |key: &str| all[key][1].as_f64().unwrap();
    assert!(mean("plain") > 1.5 && (mean("repaired") - 1.0).abs() < 0.1, "{all}");
    assert_eq!(plain(&study, "r.h5"), before, "a repair changed a plain number");
    // asked again, the repair stays; asked for another risk, it is read off the same weights
    study.uplift(&["consistency", "r.h5", "-q"]).ok();
    let rows = |poes: &str| -> Vec<Value> {
        let table = json(&study.uplift(&["table", "r.h5", "--im", "all", "--poe", poes, "--json"]).ok());
        let all = table["rows"].as_array().unwrap().iter();
        all.filter(|row| row["repaired"] == true && row["poe"] == 0.1).cloned().collect()
    };
    assert_eq!(rows("0.1"), rows("0.02,0.1,0.5"));
    assert_eq!(rows("0.1").len(), 4);
    let table = std::fs::read_to_string(study.path().join("r.consistency.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 4 * 3);

    // the same by the study's own key, in one go
    study.uplift(&["run", "study.toml", "-o", "k.h5", "-q", "--set", "consistency.repair=weights"]).ok();
    assert_eq!(plain(&study, "k.h5"), before);
    let spectra = |name: &str| -> Vec<u64> {
        let found = ResultFile::open(&study.path().join(name)).unwrap().consistency().unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].scaled_to, found[0].other), (IntensityMeasure::Pgv, IntensityMeasure::Pga));
        let u_m = found.iter().flat_map(|found| found.u_m.as_ref().unwrap().values().to_vec());
        u_m.map(f64::to_bits).collect()
    };
    assert_eq!(spectra("r.h5"), spectra("k.h5"));
    let told = study.uplift(&["run", "study.toml", "-o", "k.h5", "--set", "consistency.repair=weights"]).ok();
    assert!(told.stdout.contains("the records weighted so that they bring"), "{}", told.stdout);
    // and on any number of threads
    study
        .uplift(&["run", "study.toml", "-o", "t.h5", "-q", "--threads", "1", "--set", "consistency.repair=weights"])
        .ok();
    assert_eq!(spectra("t.h5"), spectra("k.h5"));
}

#[test]
fn a_verdict_can_be_required() {
    let study = study(BOTH, "pgv pga", "");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
        .uplift(&["consistency", "r.h5", "-q", "--require", "off"])
        .fails(4, &["--require off", "Montreux by PGA: inconsistent"]);
    study.uplift(&["consistency", "r.h5", "-q", "--require", "sound"]).fails(2, &["--require"]);
}

#[test]
fn the_curve_of_a_measure_that_is_not_analysed_is_enough() {
    let study = study("[pgv]", "pgv pga", "");
    let check = study.uplift(&["check", "study.toml"]).ok();
    assert!(check.stdout.contains("hazard    Montreux by PGV: the records bring"), "{}", check.stdout);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let asked = json(&study.uplift(&["consistency", "r.h5", "--json", "-q"]).ok());
    assert_eq!(asked["rows"].as_array().unwrap().len(), 2);
    assert_eq!(row(&asked, "Athens", "PGV")["shows"], "PGA");
    assert!(asked["agreement"].as_array().unwrap().is_empty());
    // it is an input like any other
    study.uplift(&["verify", "r.h5"]).ok();
    study.write(
        "study.toml",
        &std::fs::read_to_string(study.path().join("study.toml")).unwrap().replace("pga.csv", "x.csv"),
    );
    study.uplift(&["run", "study.toml", "-o", "x.h5", "-q"]).fails(3, &["x.csv"]);
}

#[test]
fn one_curve_alone_answers_nothing_and_is_no_error() {
    let study = study("[pgv]", "pgv", "");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let told = study.uplift(&["consistency", "r.h5"]).ok();
    assert!(told.stdout.contains("no site has hazard curves of two measures"), "{}", told.stdout);
    study.uplift(&["consistency", "r.h5", "--require", "off"]).fails(4, &["no site has hazard curves"]);
}

#[test]
fn mistakes_in_the_section_are_named() {
    let more = "[consistency]\nrepair = \"weight\"\nsmoothness = 0\nleast_effective = 0\nscale_factors = [5, 0.2]\n";
    let study = study(BOTH, "pgv pga", more);
    study.uplift(&["check", "study.toml"]).fails(
        3,
        &["4 mistakes", "did you mean `weights`", "0.001 to 10", "these are no two factors, the smaller first"],
    );
}
