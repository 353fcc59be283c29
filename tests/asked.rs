//! Any probability or return period of a result, without a new run: what a run of it would have given, to the bit.

use serde_json::Value;

use crate::common::{Finished, SmallStudy};

/// Probabilities that the small study does not have, and one that it has.
const ASKED: &str = "0.05,0.02,0.3";

/// Two results of one study, `r.h5` of its own probabilities and `asked.h5` of those asked for, with `more` changed;
/// both with bands.
fn study(more: &[&str]) -> SmallStudy {
    let study = SmallStudy::new();
    let run = |name: &str, more: &[&str]| {
        study.uplift(&[&["run", "study.toml", "-q", "-o", name], more].concat()).ok();
        study.uplift(&["bootstrap", name, "--replicates", "30", "--sizes", "2,4", "-q"]).ok();
    };
    run("r.h5", more);
    let poe = format!("risk.poe=[{ASKED}]");
    run("asked.h5", &[&["--set", &poe], more].concat());
    study
}

/// The export of a result as JSON, but for where it comes from.
fn export(study: &SmallStudy, result: &str, more: &[&str]) -> Value {
    study.uplift(&[&["export", result, "--json", "-o", "x.json", "--force", "-q"], more].concat()).ok();
    let mut tree: Value = serde_json::from_slice(&std::fs::read(study.path().join("x.json")).unwrap()).unwrap();
    let all = tree.as_object_mut().unwrap();
    for key in ["provenance", "created", "study_digest"] {
        assert!(all.remove(key).is_some(), "{key}");
    }
    tree
}

/// The alarms but for those of the record set, whose verdict is of the range of the study's own probabilities; commands
/// name one file.
fn without_consistency(alarms: &Value) -> Vec<Value> {
    let others = alarms.as_array().unwrap().iter().filter(|alarm| alarm["kind"] != "hazard-inconsistent");
    others.map(|alarm| alarm.to_string().replace("asked.h5", "r.h5").parse().unwrap()).collect()
}

#[test]
#[ignore = "long: make test-long"]
fn spectra_bands_and_warnings_are_those_of_a_run() {
    for contour in ["risk.contour=exact", "risk.contour=grid"] {
        let study = study(&["--set", contour]);
        let mut run = export(&study, "asked.h5", &[]);
        let mut ours = export(&study, "r.h5", &["--poe", ASKED]);
        // in whatever order of what is equally grave
        let sorted = |alarms: Value| {
            let mut said: Vec<String> = without_consistency(&alarms).iter().map(ToString::to_string).collect();
            said.sort();
            said
        };
        let (own, theirs) = (sorted(ours["alarms"].take()), sorted(run["alarms"].take()));
        assert!(own.len() > 2);
        assert_eq!(own, theirs);
        // verdicts are of the range of the study's own probabilities
        ours["consistency"].take();
        run["consistency"].take();
        assert_eq!(ours, run);
        let spectra = ours["spectra"].as_array().unwrap();
        assert_eq!(spectra.len(), 2 * 2 * 3);
        let some = &spectra[0]["u_m"][1];
        assert!(some.as_f64().unwrap() > 0.0 && spectra[0]["bands"][1]["sample_size"] == 4, "{some}");
        // and what the result has itself is not touched
        assert_ne!(export(&study, "r.h5", &[]), ours);
    }
}

#[test]
fn a_return_period_is_a_probability() {
    let study = study(&[]);
    let poe = -(-50.0_f64 / 475.0).exp_m1();
    let by_period = export(&study, "r.h5", &["--return-period", "475"]);
    assert_eq!(by_period, export(&study, "r.h5", &["--poe", &poe.to_string()]));
    let back = by_period["spectra"][0]["return_period_years"].as_f64().unwrap();
    assert!((back - 475.0).abs() < 1e-9, "{back}");
    // the same risk in other years is the same spectrum
    let in_one = export(&study, "r.h5", &["--return-period", "475", "--years", "1"]);
    assert_eq!((&in_one["years"], &in_one["spectra"][0]["u_m"]), (&1.0.into(), &by_period["spectra"][0]["u_m"]));
    let in_hundred = export(&study, "r.h5", &["--years", "100"]);
    let poes: Vec<&Value> = in_hundred["spectra"].as_array().unwrap()[..3].iter().map(|of| &of["poe"]).collect();
    assert_eq!(poes, [0.02, 0.1, 0.5]);
    assert_ne!(in_hundred["spectra"][0]["u_m"], export(&study, "r.h5", &[])["spectra"][0]["u_m"]);
}

#[test]
#[ignore = "long: make test-long"]
fn designs_tables_and_pages_take_it() {
    let study = study(&[]);
    study.write("block.toml", "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n");
    let without_file = |finished: Finished| {
        let mut tree = finished.json();
        tree.as_object_mut().unwrap().remove("result");
        // in whatever order of what is equally grave
        let mut alarms = without_consistency(&tree["alarms"]);
        assert!(alarms.len() > 1);
        alarms.sort_by_key(Value::to_string);
        tree["alarms"] = alarms.into();
        tree
    };
    let design = |result: &str, more: &[&str]| {
        // what is kept would stand on the page, with its risk
        let asked = ["design", "block.toml", "--urs", result, "--site", "Here", "--json", "-q", "--no-keep"];
        without_file(study.uplift(&[&asked[..], more].concat()))
    };
    let found = design("r.h5", &["--poe", "0.3"]);
    assert_eq!(found["poe"], 0.3);
    assert!(found["spectrum"]["ordinate_m"].as_f64().unwrap() > 0.0, "{found}");
    assert_eq!(found, design("asked.h5", &["--poe", "0.3"]));
    // the smallest, of the study
    assert_eq!(design("asked.h5", &[]), design("r.h5", &["--poe", "0.02"]));

    let table = |result: &str, more: &[&str]| -> Value {
        let asked = ["table", result, "--measure", "all", "--json"];
        without_file(study.uplift(&[&asked[..], more].concat()))
    };
    assert_eq!(table("r.h5", &["--poe", ASKED]), table("asked.h5", &[]));

    study.uplift(&["report", "r.h5", "-o", "page.html", "--poe", "0.05", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("page.html")).unwrap();
    assert!(page.contains("5 % in 50 years") && page.contains("read after the run"));
    assert!(page.contains("id=\"r1-bands-together\"") && !page.contains("2 % in 50 years"));
}

#[test]
#[ignore = "long: make test-long"]
fn a_return_period_is_called_by_its_name_everywhere() {
    let study = study(&[]);
    study.write("block.toml", "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n");
    study.uplift(&["influence", "r.h5", "-q"]).ok();
    let asked = ["--return-period", "475"];
    study.uplift(&[&["report", "r.h5", "-o", "page.html", "-q"], &asked[..]].concat()).ok();
    let page = std::fs::read_to_string(study.path().join("page.html")).unwrap();
    assert!(page.contains("Displacement, m, of 475 years (9.991 % in 50 years) by PGV"), "{page:.9000}");
    assert!(!page.contains("9.9912"));
    // what was found for other probabilities is left out, and that is said
    assert!(page.contains("uplift influence found it for the probabilities of the study"));
    study.uplift(&["report", "r.h5", "-o", "own.html", "-q"]).ok();
    assert!(!std::fs::read_to_string(study.path().join("own.html")).unwrap().contains("uplift influence found it"));

    let table = study.uplift(&[&["table", "r.h5"], &asked[..]].concat()).ok().stdout;
    assert!(table.contains("  475 years  ") && !table.contains("9.99"), "{table}");
    let design = ["design", "block.toml", "--urs", "r.h5", "--site", "Here", "--report", "sheet.html"];
    let shown = study.uplift(&[&design[..], &asked[..]].concat()).ok().stdout;
    assert!(shown.contains("At        Here, 475 years (9.991 % in 50 years); "), "{shown}");
    let sheet = std::fs::read_to_string(study.path().join("sheet.html")).unwrap();
    assert!(sheet.contains("At Here, for 475 years (9.991 % in 50 years)"));
    let export = export(&study, "r.h5", &asked);
    assert!(export["alarms"].to_string().contains(", PGA, 475 years"), "{}", export["alarms"]);
}

#[test]
fn what_is_nearly_certain_is_not_a_hundred_per_cent() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-q", "-o", "r.h5"]).ok();
    let shown = study.uplift(&["table", "r.h5", "--poe", "0.9999999,1e-12"]).ok().stdout;
    assert!(shown.contains("99.99999 %") && shown.contains(" 1e-12 ") && !shown.contains("100 %"), "{shown}");
}

#[test]
fn bands_need_the_draws() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-q", "-o", "r.h5"]).ok();
    study.uplift(&["export", "r.h5", "--csv", "--poe", "0.05"]).ok();
    let table = std::fs::read_to_string(study.path().join("r.spectra.csv")).unwrap();
    // the quoted band needs none
    assert!(
        table.starts_with("site,im,poe,years,strength,u_m,lower_m,upper_m,fit_m") && !table.contains("u05"),
        "{table}"
    );
}

#[test]
fn a_single_record_has_no_band_in_any_export() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-q", "-o", "r.h5", "--set", "records.first=1"]).ok();
    study.uplift(&["export", "r.h5", "--csv", "--json", "--mat", "--xlsx"]).ok();
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(study.path().join("r.json")).unwrap()).unwrap();
    let spectrum = &json["spectra"][0];
    let strengths = json["strength"].as_array().unwrap().len();
    assert!(json["confidence"] == 0.9 && spectrum["confidence"] == 0.9, "{spectrum}");
    for limit in ["lower_m", "upper_m"] {
        assert_eq!(spectrum[limit], serde_json::json!(vec![(); strengths]), "{spectrum}");
    }
    let table = std::fs::read_to_string(study.path().join("r.spectra.csv")).unwrap();
    let mut lines = table.lines();
    let place = lines.next().unwrap().split(',').position(|name| name == "lower_m").unwrap();
    assert!(lines.count() > 0 && table.lines().skip(1).all(|line| line.split(',').nth(place) == Some("")), "{table}");
}

/// The quoted band is of 90 % whatever the bootstrap's are.
#[test]
fn each_band_has_its_own_confidence() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-q", "-o", "r.h5", "--set", "bootstrap.confidence=0.8"]).ok();
    study.uplift(&["bootstrap", "r.h5", "-q", "--replicates", "20"]).ok();
    study.uplift(&["export", "r.h5", "--json"]).ok();
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(study.path().join("r.json")).unwrap()).unwrap();
    let spectrum = &json["spectra"][0];
    assert!(json["confidence"] == 0.8 && spectrum["confidence"] == 0.9, "{spectrum}");
    assert!(spectrum["bands"].as_array().is_some_and(|bands| !bands.is_empty()), "{spectrum}");
}

#[test]
fn what_is_no_risk_is_refused() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-q", "-o", "r.h5"]).ok();
    for (asked, words) in [
        (&["--poe", "1.5,0"][..], &["--poe 1.5", "--poe 0:", "10 % is 0.1 or 10%"][..]),
        (&["--poe", "0.1,0.1"], &["--poe 0.1 is given twice"]),
        (&["--poe", "x"], &["--poe", "x"]),
        (&["--poe", "150%"], &["150%", "between 0 and 100 %"]),
        (&["--poe", "1e-300"], &["--poe 1e-300: a probability is from 1e-12 to 0.999999999999"]),
        (&["--return-period", "1e9", "--years", "1e-4"], &["--years is 1e-4 yr"]),
        (&["--return-period", "-475"], &["--return-period is -475 yr"]),
        (&["--return-period", "1"], &["in 50 years that is certain", "--years"]),
        (&["--years", "0"], &["--years is 0 yr"]),
        (&["--poe", "0.1", "--return-period", "475"], &["--poe", "--return-period", "cannot be used with"]),
    ] {
        for command in [&["table", "r.h5"][..], &["export", "r.h5", "--csv"], &["report", "r.h5"]] {
            study.uplift(&[command, asked].concat()).fails(2, words);
        }
    }
    assert!(!study.path().join("r.spectra.csv").exists() && !study.path().join("r.html").exists());
    // a look at what the result has already
    study.uplift(&["influence", "r.h5", "--return-period", "475", "-q"]).ok();
    study
        .uplift(&["influence", "r.h5", "--return-period", "500"])
        .fails(2, &["the result has no return period 500: it has 2474.9, 474.6, 72.1"]);
}

#[test]
#[ignore = "long: make test-long"]
fn data_too_large_for_a_sheet_is_refused() {
    let study = study(&[]);
    let many: Vec<String> = (1..=700).map(|index| (f64::from(index) / 1000.0).to_string()).collect();
    let refused = study.uplift(&["export", "r.h5", "--xlsx", "--poe", &many.join(",")]);
    refused.fails(4, &["r.h5", "16384", "--csv"]);
    study.uplift(&["export", "r.h5", "--csv", "--poe", &many.join(","), "-q"]).ok();
    let table = std::fs::read_to_string(study.path().join("r.spectra.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 2 * 2 * 700 * 10);
}
