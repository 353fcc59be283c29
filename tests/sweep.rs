//! `uplift sweep`: variants of a study, each an ordinary result, compared.

use serde_json::Value;

use crate::common::{SmallStudy, array, same_bits};

fn json(study: &SmallStudy, more: &[&str]) -> Value {
    study.uplift(&[&["sweep", "study.toml", "-o", "s", "--json", "-q"], more].concat()).json()
}

#[test]
#[ignore = "long: make test-long"]
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
    let rows: usize = variants
        .iter()
        .map(|variant| variant["strengths"].as_array().unwrap().len() * variant["spectra"].as_array().unwrap().len())
        .sum();
    assert_eq!(table.lines().count(), 1 + rows);
    let columns = "variant,oscillator.restitution,strengths.values,site,im,poe,years,strength,u_m,over_first,flag,\
                   lower_tail_share,upper_tail_share,cautions\n";
    assert!(table.starts_with(columns), "{table}");
    let said = table.lines().nth(1).unwrap();
    assert!(said.contains(",regular,") && said.contains("synthetic-records"), "{said}");
    // every ordinate over that of the first variant, which has the strength of 0.1 alone
    let (mut compared, mut first) = (0, std::collections::BTreeMap::new());
    for (row, line) in table.lines().skip(1).enumerate() {
        let site = if line.contains(",Here,") { ",Here," } else { ",There," };
        let cells: Vec<&str> = line.split_once(site).unwrap().1.split(',').collect();
        // measure, probability, years, strength
        let key = (site, cells[..4].to_vec());
        let u_m: f64 = cells[4].parse().unwrap();
        if row < 12 {
            first.insert(key.clone(), u_m);
        }
        match first.get(&key).map(|first| u_m / first).filter(|ratio| !ratio.is_nan()) {
            Some(expected) => assert!((cells[5].parse::<f64>().unwrap() / expected - 1.0).abs() < 1e-12, "{line}"),
            None => assert_eq!(cells[5], "", "{line}"),
        }
        compared += usize::from(!cells[5].is_empty());
    }
    assert!(compared > 12 && compared < rows, "{compared}");
    let figure = std::fs::read_to_string(study.path().join("s/comparison.svg")).unwrap();
    assert!(figure.contains("restitution-0.85_values-0.1"));
}

#[test]
fn what_one_variant_computed_no_other_computes_again() {
    let study = SmallStudy::new();
    let over = ["--over", "strengths.values=[0.1, 0.3],[0.1]", "--over", "risk.poe=0.1,0.02"];
    let run = study.uplift(&[&["sweep", "study.toml", "-o", "s"][..], &over].concat()).ok();
    // 4 records, 2 strengths, 5 levels of PGV and 4 of PGA: the first computes 72, and nobody else any
    let known: Vec<&str> = run.stderr.lines().filter(|line| line.contains("analyses resumed")).collect();
    let expected = ["72 of 72", "36 of 36", "36 of 36"];
    assert!(known.len() == 3 && known.iter().zip(expected).all(|(line, all)| line.contains(all)), "{}", run.stderr);
    // variants of another oscillator take nothing
    let other = ["sweep", "study.toml", "-o", "t", "--over", "oscillator.restitution=0.7,0.8"];
    let run = study.uplift(&other).ok();
    assert!(!run.stderr.contains("analyses resumed"), "{}", run.stderr);
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
    let bad = ["sweep", "study.toml", "--cases", "bad.csv", "-o", "bad"];
    study.uplift(&bad).fails(4, &["a/b", "row 3: name \"x\" is given twice"]);
    // each mistake by its row and column, in our words
    for (table, code, words) in [
        (
            "name,records.first\nx,3\nX,4\n",
            4,
            &["row 2: name \"X\" is given twice (upper and lower case are the same)"][..],
        ),
        ("name,records.first\nx,2\ny,3,4\n", 4, &["line 3: it has 3 cells, and the header has 2 columns"]),
        ("name\n\"a\n", 4, &["line 2: a quote (\") is opened and not closed"]),
        ("", 4, &["it is empty"]),
        ("records.first\n", 4, &["bad.csv: no case below the header"]),
        ("risk.years,risk.years\n1,2\n", 4, &["column risk.years is given twice"]),
        (
            "records.frist,oscillator.restitution\n2,0.9\n,1.5\n",
            3,
            &["bad.csv, row 1, column records.frist", "bad.csv, row 2, column oscillator.restitution"],
        ),
        ("records.first,seed\n2,1\n\n3\n", 4, &["bad.csv: line 4: column seed is missing"]),
        ("records.first,seed\n,\n", 4, &["bad.csv: no case below the header"]),
        ("records.first,seed\n2,\n3,\n,\n2,\n", 2, &["first-2", "are the same study: leave one of them out"]),
    ] {
        study.write("bad.csv", table);
        study.uplift(&bad).fails(code, words);
    }
    assert!(!study.path().join("bad").exists());
}

#[test]
fn all_mistakes_of_all_variants_are_reported_before_anything_is_computed() {
    let study = SmallStudy::new();
    let over = ["--over", "oscillator.restitution=0.9,1.5,95", "--over", "records.frist=3,4"];
    study.uplift(&[&["sweep", "study.toml", "-o", "s"][..], &over].concat()).fails(
        3,
        &[
            "in the variants",
            "- --over oscillator.restitution=1.5: ",
            "- --over oscillator.restitution=95: ",
            "- --over records.frist=3: ",
            "- --over records.frist=4: ",
        ],
    );
    assert!(!study.path().join("s").exists());
    // what only the inputs show is said of every variant, too
    let over = ["--over", "sites.Here.pgv=here-pgv.csv,study.toml"];
    study.uplift(&[&["sweep", "study.toml", "-o", "s"][..], &over].concat()).fails(4, &["pgv-study.toml"]);
    let left = std::fs::read_dir(study.path().join("s")).map_or(0, Iterator::count);
    assert_eq!(left, 0, "results before all inputs were looked at");
    study.uplift(&["sweep", "study.toml", "--over", "risk.years"]).fails(2, &["write KEY=VALUE"]);
    let both = ["sweep", "study.toml", "--over", "risk.years=40,60", "--set", "risk.years=50"];
    study.uplift(&both).fails(2, &["--over risk.years: --set gives it one value for all variants"]);
    study.write("cases.csv", "risk.years,name\n40,a\n60,b\n");
    let both = ["sweep", "study.toml", "--cases", "cases.csv", "--set", "risk.years=50"];
    study.uplift(&both).fails(2, &["column risk.years: --set gives it one value for all variants"]);
    study.uplift(&["sweep", "study.toml"]).fails(2, &["--over"]);
}

#[test]
fn variants_that_compare_nothing_are_refused_in_words() {
    let study = SmallStudy::new();
    let refused = |over: &[&str], words: &str| {
        let over = over.iter().flat_map(|over| ["--over", over]).collect::<Vec<_>>();
        study.uplift(&[&["sweep", "study.toml", "-o", "s"][..], &over].concat()).fails(2, &[words]);
    };
    refused(&["seed=1,2"], "has the same spectra for all its values");
    refused(&["output.file=\"a.h5\",\"b.h5\""], "lie in its folder (-o)");
    refused(&["oscillator.restitution=0.9,0.90"], "are the same study");
    refused(&["oscillator.restitution=0.8,0.9", "sites=[]"], "the study names none");
    assert!(!study.path().join("s").exists());
    // components that a seed draws differ
    let drawn = ["sweep", "study.toml", "-o", "s", "-q", "--set", "records.component=random", "--over", "seed=1,2"];
    study.uplift(&drawn).ok();
}

#[test]
#[ignore = "long: make test-long"]
fn repaired_spectra_are_compared_too() {
    let study = SmallStudy::repaired();
    let found = json(&study, &["--over", "oscillator.restitution=0.85,0.95", "--force"]);
    for variant in found["variants"].as_array().unwrap() {
        let own = study.path().join(variant["result"].as_str().unwrap());
        let repaired: Vec<f64> = variant["spectra"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|spectrum| spectrum["repaired_m"].as_array().unwrap())
            .map(|u_m| u_m.as_f64().unwrap_or(f64::NAN))
            .collect();
        let stored = ["pgv", "pga"].map(|key| array(&own, &format!("/consistency/{key}/u_m"))).concat();
        assert_eq!(repaired.len(), stored.len());
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || !b.is_finite();
        assert!(repaired.iter().zip(&stored).all(same) && stored.iter().any(|u_m| u_m.is_finite()));
    }
    let table = std::fs::read_to_string(study.path().join("s/comparison.csv")).unwrap();
    assert!(table.lines().next().unwrap().contains(",u_m,over_first,u_consistent_m,flag,"), "{table}");
    let figure = std::fs::read_to_string(study.path().join("s/comparison.svg")).unwrap();
    assert!(figure.contains(", repaired"));
}

#[test]
fn a_table_that_is_wrong_in_every_cell_shows_its_first_mistakes() {
    let study = SmallStudy::new();
    let rows: Vec<String> = (1..=60).map(|row| format!("a{row},b{row}\n")).collect();
    study.write("cases.csv", &format!("oscillator.restitution,risk.years\n{}", rows.concat()));
    let said = study.uplift(&["sweep", "study.toml", "--cases", "cases.csv"]).fails(3, &["120 mistakes", "row 1,"]);
    assert!(said.stderr.contains("\n  … and 110 more") && !said.stderr.contains("row 6,"), "{}", said.stderr);
    assert_eq!(said.stderr.lines().count(), 12, "{}", said.stderr);
}

#[test]
fn an_unfinished_sweep_has_a_status() {
    let study = SmallStudy::new();
    let ask = ["sweep", "study.toml", "--over", "oscillator.restitution=0.85,0.95", "-q"];
    study.uplift(&ask).ok();
    // a script that waits for it sees no error when it is finished
    let finished = "results/study.sweep: finished sweep, 2 variants\n  more: uplift status \
                    results/study.sweep/restitution-0.85.h5\n";
    let is_finished = |of: &str| assert_eq!(study.uplift(&["status", of]).ok().stdout, finished, "{of}");
    ["study.toml", "results/study.sweep"].into_iter().for_each(is_finished);
    // as an interruption leaves it
    std::fs::remove_file(study.path().join("results/study.sweep/comparison.csv")).unwrap();
    std::fs::remove_file(study.path().join("results/study.sweep/restitution-0.95.h5")).unwrap();
    let words = "results/study.sweep: unfinished sweep, 1 variant finished; the same `uplift sweep` resumes it\n";
    for of in ["study.toml", "results/study.sweep"] {
        assert_eq!(study.uplift(&["status", of]).ok().stdout, words, "{of}");
    }
    study.uplift(&ask).ok();
    is_finished("study.toml");
    std::fs::create_dir(study.path().join("empty")).unwrap();
    study.uplift(&["status", "empty"]).fails(4, &["is a folder: it has no results"]);
    // in a folder of another name: by the command in its results, before there is one by its checkpoints
    study.uplift(&[&ask[..], &["-o", "sw"]].concat()).ok();
    std::fs::remove_file(study.path().join("sw/comparison.csv")).unwrap();
    let words = "sw: unfinished sweep, 2 variants finished; the same `uplift sweep` resumes it\n";
    assert_eq!(study.uplift(&["status", "sw"]).ok().stdout, words);
    study.uplift(&["run", "study.toml", "--shard", "1/1", "-q"]).ok();
    std::fs::create_dir(study.path().join("begun")).unwrap();
    let shard = study.path().join("results/study.shard-1-of-1");
    std::fs::rename(shard, study.path().join("begun/restitution-0.85.h5.part")).unwrap();
    let said = study.uplift(&["status", "begun"]).ok().stdout;
    let words = "begun: unfinished sweep or run; the same command resumes it\n\
                 begun/restitution-0.85.h5.part: checkpoint of an unfinished run, 360 of 360 analyses (100 %)";
    assert!(said.starts_with(words), "{said}");
    // a folder of any results
    study.uplift(&["run", "study.toml", "-o", "begun/r.h5", "-q"]).ok();
    std::fs::remove_file(study.path().join("begun/restitution-0.85.h5.part")).unwrap();
    let words = "begun: 1 result\n  more: uplift status begun/r.h5\n";
    assert_eq!(study.uplift(&["status", "begun"]).ok().stdout, words);
}

#[test]
fn nothing_of_others_is_replaced() {
    let study = SmallStudy::new();
    let ask = ["sweep", "study.toml", "-o", "s", "--over", "oscillator.restitution=0.85,0.95", "-q"];
    std::fs::create_dir(study.path().join("s")).unwrap();
    study.write("s/comparison.csv", "a,b\n1,2\n");
    study.uplift(&ask).fails(2, &["comparison.csv already exists"]);
    std::fs::remove_file(study.path().join("s/comparison.csv")).unwrap();
    study.write("s/restitution-0.95.h5", "mine");
    study.uplift(&ask).fails(4, &["restitution-0.95", "is not an HDF5 file"]);
    assert!(!study.path().join("s/restitution-0.85.h5").exists());
    study.uplift(&[&ask[..], &["--force"]].concat()).ok();
    // the comparison of other variants stays, and that of the same ones is made again
    study.uplift(&ask).ok();
    let other = ["sweep", "study.toml", "-o", "s", "--over", "oscillator.restitution=0.7,0.8", "-q"];
    let kept = std::fs::read(study.path().join("s/comparison.csv")).unwrap();
    study.uplift(&other).fails(2, &["comparison.csv compares other variants", "--force"]);
    assert_eq!(std::fs::read(study.path().join("s/comparison.csv")).unwrap(), kept);
    study.uplift(&[&other[..], &["--force"]].concat()).ok();
}
