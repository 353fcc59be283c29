//! `uplift sweep`: variants of a study, each an ordinary result, compared.

use serde_json::Value;

use crate::common::{SmallStudy, array, same_bits};

fn json(study: &SmallStudy, more: &[&str]) -> Value {
    let run = study.uplift(&[&["sweep", "study.toml", "-o", "s", "--json", "-q"], more].concat()).ok();
    serde_json::from_str(&run.stdout).unwrap()
}

#[test]
fn every_variant_is_the_result_of_its_own_run() {
    let study = SmallStudy::new();
    let over = ["--over", "oscillator.restitution=0.85,0.95", "--over", "strengths.values=[0.1],[0.1, 0.3]"];
    let found = json(&study, &over);
    let variants = found["variants"].as_array().unwrap();
    assert_eq!(variants.len(), 4);
    assert_eq!(found["keys"], serde_json::json!(["oscillator.restitution", "strengths.values"]));
    assert_eq!(variants[1]["values"], serde_json::json!(["0.85", "[0.1, 0.3]"]));
    for (variant, [restitution, strengths]) in
        variants.iter().zip([["0.85", "[0.1]"], ["0.85", "[0.1, 0.3]"], ["0.95", "[0.1]"], ["0.95", "[0.1, 0.3]"]])
    {
        let [restitution, strengths] =
            [format!("oscillator.restitution={restitution}"), format!("strengths.values={strengths}")];
        let alone =
            ["run", "study.toml", "-o", "alone.h5", "-q", "--force", "--set", &restitution, "--set", &strengths];
        study.uplift(&alone).ok();
        std::fs::rename(study.path().join("alone.h5"), study.path().join("kept.h5")).unwrap();
        let own = study.path().join(variant["result"].as_str().unwrap());
        for name in ["/urs/pgv/u_m", "/urs/pga/u_m", "/ida/pgv/edp_m"] {
            assert!(same_bits(&array(&own, name), &array(&study.path().join("kept.h5"), name)), "{name}");
        }
    }
    // the table has a row an ordinate: 2 measures, 2 sites, the study's probabilities, and 1 or 2 strengths
    let table = std::fs::read_to_string(study.path().join("s/comparison.csv")).unwrap();
    let rows = variants
        .iter()
        .map(|variant| variant["strengths"].as_array().unwrap().len() * variant["spectra"].as_array().unwrap().len());
    assert_eq!(table.lines().count(), 1 + rows.sum::<usize>());
    assert!(table.starts_with("variant,oscillator.restitution,strengths.values,site,im,poe,years,strength,u_m\n"));
    let figure = std::fs::read_to_string(study.path().join("s/comparison.svg")).unwrap();
    assert!(figure.contains("restitution-0.85_values-0.1"));
}

#[test]
fn what_one_variant_computed_no_other_computes_again() {
    let study = SmallStudy::new();
    let over = ["--over", "strengths.values=[0.1, 0.3],[0.1]", "--over", "risk.poe=0.1,0.02"];
    let run = study.uplift(&[&["sweep", "study.toml", "-o", "s"][..], &over].concat()).ok();
    // 4 records, 2 strengths, 5 levels of PGV and 4 of PGA: the first computes 72, and nobody else any
    let known: Vec<&str> = run.stderr.lines().filter(|line| line.contains("analyses from before")).collect();
    let expected = ["72 of 72", "36 of 36", "36 of 36"];
    assert!(known.len() == 3 && known.iter().zip(expected).all(|(line, all)| line.contains(all)), "{}", run.stderr);
    // variants of another oscillator take nothing
    let other = ["sweep", "study.toml", "-o", "t", "--over", "oscillator.restitution=0.7,0.8"];
    let run = study.uplift(&other).ok();
    assert!(!run.stderr.contains("analyses from before"), "{}", run.stderr);
    // a second sweep finds every result, and runs none
    let again = study.uplift(&other).ok();
    assert_eq!(again.stderr.matches("is that of the study").count(), 2, "{}", again.stderr);
    assert_eq!(again.stdout, run.stdout);
}

#[test]
fn a_table_of_cases_names_its_results() {
    let study = SmallStudy::new();
    study.write("cases.csv", "name,records.first,oscillator.restitution\nfew,2,\nlossy,,0.7\nas_it_is,,\n");
    let found = json(&study, &["--cases", "cases.csv"]);
    let names: Vec<&str> =
        found["variants"].as_array().unwrap().iter().map(|variant| variant["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["few", "lossy", "as_it_is"]);
    assert_eq!(found["variants"][1]["values"], serde_json::json!([null, "0.7"]));
    assert!(study.path().join("s/lossy.h5").exists());
    study.write("bad.csv", "name,records.first\na/b,2\nx,3\nx,4\n");
    let bad = ["sweep", "study.toml", "--cases", "bad.csv"];
    study.uplift(&bad).fails(4, &["a/b", "\"x\" is given twice"]);
}

#[test]
fn all_mistakes_of_all_variants_are_told_before_anything_is_computed() {
    let study = SmallStudy::new();
    let over = ["--over", "oscillator.restitution=0.9,1.5,95", "--over", "records.frist=3,4"];
    study.uplift(&[&["sweep", "study.toml", "-o", "s"][..], &over].concat()).fails(
        2,
        &[
            "to mend in the variants",
            "oscillator.restitution=1.5",
            "oscillator.restitution=95",
            "records.frist=3",
            "frist=4",
        ],
    );
    assert!(!study.path().join("s").exists());
    // what only the inputs show is said of every variant, too
    let over = ["--over", "sites.Here.pgv=here-pgv.csv,study.toml"];
    study.uplift(&[&["sweep", "study.toml", "-o", "s"][..], &over].concat()).fails(4, &["pgv-study.toml"]);
    let left = std::fs::read_dir(study.path().join("s")).map_or(0, Iterator::count);
    assert_eq!(left, 0, "results before all inputs were looked at");
    study.uplift(&["sweep", "study.toml", "--over", "risk.years"]).fails(2, &["write KEY=VALUE"]);
    study.uplift(&["sweep", "study.toml"]).fails(2, &["--over"]);
}

#[test]
fn nothing_of_others_is_replaced() {
    let study = SmallStudy::new();
    let ask = ["sweep", "study.toml", "-o", "s", "--over", "oscillator.restitution=0.85,0.95", "-q"];
    std::fs::create_dir(study.path().join("s")).unwrap();
    study.write("s/comparison.csv", "a,b\n1,2\n");
    study.uplift(&ask).fails(2, &["comparison.csv is there already"]);
    std::fs::remove_file(study.path().join("s/comparison.csv")).unwrap();
    study.write("s/restitution-0.95.h5", "mine");
    study.uplift(&ask).fails(4, &["restitution-0.95", "is not an HDF5 file"]);
    assert!(!study.path().join("s/restitution-0.85.h5").exists());
    study.uplift(&[&ask[..], &["--force"]].concat()).ok();
}
