//! Computed peaks beside measured ones: the command, the decoded Table 6.2, what is typed wrong.

use std::fmt::Write;

use serde_json::Value;

use crate::common::{SmallStudy, repository};

fn json(study: &SmallStudy, arguments: &[&str]) -> Value {
    study.uplift(&[&["validate"], arguments, &["--json"]].concat()).json()
}

fn close(found: &Value, expected: f64) {
    let number = found.as_f64().unwrap_or(f64::NAN);
    assert!((number - expected).abs() < 1e-12 * expected.abs().max(1.0), "{found} {expected}");
}

fn texts(found: &Value) -> Vec<&str> {
    found.as_array().unwrap().iter().map(|value| value.as_str().unwrap()).collect()
}

/// The printed p of Table 6.2 from samples of its decoded sizes and distances, each shifted by k ranks: the first k of
/// the measured values lie below all of the computed.
#[test]
#[ignore = "long: make test-long"]
fn table_6_2() {
    let study = SmallStudy::new();
    let reference = std::fs::read_to_string(repository().join("tests/reference/table_6_2.csv")).unwrap();
    let mut evidence = Vec::new();
    for line in reference.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [n, k] = [cells[2], cells[3]].map(|cell| cell.parse::<u32>().unwrap());
        let (mut measured, mut computed) = ("u_mm\n".to_owned(), "u_m\n".to_owned());
        for place in 0..n {
            writeln!(measured, "{}", place + 1).unwrap();
            writeln!(computed, "{}", 1e-3 * (f64::from(place + k) + 0.5)).unwrap();
        }
        study.write("measured.csv", &measured);
        study.write("computed.csv", &computed);
        let found = json(&study, &["measured.csv", "computed.csv", "--p", "kstest2", "--replicates", "10"]);
        let group = &found["groups"][0];
        close(&group["kolmogorov_smirnov"]["distance"], f64::from(k) / f64::from(n));
        let p = group["p"].as_f64().unwrap();
        assert_eq!(format!("{p:.2}"), cells[4], "{line}");
        evidence.push(group["evidence"].as_str().unwrap().to_owned());
        assert!(group["kolmogorov_smirnov"]["p_exact"].as_f64().unwrap() > p, "{line}");
    }
    assert_eq!(evidence.iter().filter(|word| *word == "small-or-none").count(), 7);
    assert_eq!(evidence[2], "medium-weak");
}

const MEASURED: &str = "exc_id,level,u_mm\n1,low,10\n2,low,20\n3,low,40\n4,low,\n5,low,33\n1,high,>80\n\
                        2,high,overturned\n3,high,60\n";
const COMPUTED: &str = "u_m,exc_id,class,level\n0.012,1,NF,low\n0.018,2,FF,low\n0.044,3,FF,low\n0.05,4,FF,low\n0.07,1,\
                        NF,high\ninf,2,FF,high\n0.085,3,FF,high\n0.01,9,FF,high\n";

/// Pairs joined by key and the level that both have, grouped by a class that one of them has; units, collapses and
/// limits; nothing dropped without a word.
#[test]
fn pairs_by_key() {
    let study = SmallStudy::new();
    study.write("measured.csv", MEASURED);
    study.write("computed.csv", COMPUTED);
    let arguments = ["measured.csv", "computed.csv", "--by", "class,level", "--replicates", "200"];
    let found = json(&study, &arguments);
    let unmatched = &found["unmatched"];
    assert_eq!(texts(&unmatched["measured_only"]), ["5, low"]);
    assert_eq!(texts(&unmatched["computed_only"]), ["4, low", "9, high"]);
    assert_eq!(texts(&unmatched["measured_blank"]), ["4, low"]);
    let groups = found["groups"].as_array().unwrap();
    let names: Vec<String> = groups.iter().map(|group| group["of"].to_string()).collect();
    let expected = [
        r#"[null,"low"]"#,
        r#"["NF","low"]"#,
        r#"["FF","low"]"#,
        r#"[null,"high"]"#,
        r#"["NF","high"]"#,
        r#"["FF","high"]"#,
    ];
    assert_eq!(names, expected);
    let low = &groups[0];
    assert_eq!(low["pairs"]["finite"], 3);
    let bias = [1.2_f64, 0.9, 1.1].map(f64::ln).iter().sum::<f64>() / 3.0;
    close(&low["pairs"]["log_bias"], bias);
    close(&low["median_measured"], 0.02);
    close(&low["median_error"], 0.018 / 0.02 - 1.0);
    close(&low["e50"], 0.1);
    // measured 10, 20, 40 and computed 12, 18, 44 mm: the areas between the stairs
    close(&low["wasserstein"], (2.0 + 2.0 + 4.0) / 3.0 * 1e-3);
    let high = &groups[3];
    assert_eq!((&high["measured_collapses"], &high["computed_collapses"]), (&Value::from(1), &Value::from(1)));
    assert_eq!(high["censored"]["measured"], 1);
    // 60, >80, ∞ and 70, 85, ∞: above all values the limit makes ranks 1, 4, 4 of it, at the limit 1, 3, 5
    close(&high["kolmogorov_smirnov"]["distance"], 1.0 / 3.0);
    close(&high["censored"]["ks_distance_at_limits"], 1.0 / 3.0);
    assert_eq!(high["wasserstein"], Value::Null);
    // 60, >80, ∞: above 80, and no error of it
    assert_eq!((&high["median_measured"], &high["median_measured_above"]), (&Value::Null, &Value::from(0.08)));
    close(&high["median_computed"], 0.085);
    assert_eq!((&high["median_error"], &high["median_error_band"]), (&Value::Null, &Value::Null));
    assert_eq!(high["pairs"]["collapses"]["both"], 1);
    // the collapse of both agrees, 85 beside 60 lies within 1.5; >80 beside 70 agrees with nothing
    close(&high["pairs"]["within_1_5"], 2.0 / 3.0);
    let p: Vec<f64> = groups.iter().map(|group| group["p"].as_f64().unwrap()).collect();
    let holm: Vec<f64> = groups.iter().map(|group| group["p_holm"].as_f64().unwrap()).collect();
    assert!(p.iter().zip(&holm).all(|(p, holm)| holm >= p));
    // the same bits on any number of threads
    assert_eq!(found, json(&study, &[&arguments[..], &["--threads", "1"]].concat()));
    let answer = study.uplift(&[&["validate"], &arguments[..]].concat()).ok().stdout;
    let left_out = "\nLeft out 2 measured and 2 computed rows, without a partner or a value\n";
    assert!(answer.contains(left_out) && !answer.contains("Two samples"), "{answer}");
    let told = study.uplift(&[&["validate"], &arguments[..], &["--permutation", "--details"]].concat()).ok().stdout;
    for words in [
        "1 measured rows have no computed one",
        "9, high",
        "4, low",
        "D at limits",
        "p swaps",
        "pairs by exc_id",
        "FF, low",
        ">0.0800",
        "a lower bound (>m) without an error",
    ] {
        assert!(told.contains(words), "{words} is not in\n{told}");
    }
}

/// Two samples where there is no key; table and figures; of another band other areas.
#[test]
#[ignore = "long: make test-long"]
fn samples_tables_and_figures() {
    let study = SmallStudy::new();
    let rows = |factor: f64| {
        (1..=30).fold("level,u_m\n".to_owned(), |mut text, place| {
            let level = if place % 2 == 0 { "low" } else { "high" };
            writeln!(text, "{level},{}", factor * 0.01 * f64::from(place)).unwrap();
            text
        })
    };
    study.write("tests.csv", &rows(1.0));
    study.write("model.csv", &rows(1.3));
    let arguments = ["validate", "tests.csv", "model.csv", "--by", "level", "--replicates", "100"];
    let written = [&arguments[..], &["-o", "statistics.csv", "--plot", "cdf.svg"]].concat();
    let answer = study.uplift(&written).ok().stdout;
    assert!(answer.contains("\nTwo samples, not joined: --key COLUMN"), "{answer}");
    let told = study.uplift(&[&written[..], &["--force", "--details"]].concat()).ok().stdout;
    assert!(told.contains("two samples, not joined") && told.contains("--key"), "{told}");
    let table = std::fs::read_to_string(study.path().join("statistics.csv")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    for name in ["level", "ks_distance", "ks_p_kstest2", "p_holm", "median_error_q95", "wasserstein_m", "pearson"] {
        assert!(header.contains(&name), "{name} is not in {header:?}");
    }
    assert_eq!(
        table.lines().map(|line| line.split(',').next().unwrap()).collect::<Vec<_>>(),
        ["level", "all", "high", "low"]
    );
    let cell = |name: &str| {
        let place = header.iter().position(|column| *column == name).unwrap();
        table.lines().nth(1).unwrap().split(',').nth(place).unwrap().to_owned()
    };
    assert!((cell("median_error").parse::<f64>().unwrap() - 0.3).abs() < 1e-12);
    assert_eq!(cell("pearson"), "");
    let figure = |band: &str| {
        let name = format!("{band}.svg");
        study.uplift(&[&arguments[..], &["--plot", &name, "--band", band]].concat()).ok();
        std::fs::read_to_string(study.path().join(name)).unwrap()
    };
    let figures = ["greenwood", "dkw", "bootstrap"].map(figure);
    assert!(figures[0] != figures[1] && figures[1] != figures[2] && figures[0] != figures[2]);
    assert_eq!(figures[0], std::fs::read_to_string(study.path().join("cdf.svg")).unwrap());
    study.uplift(&[&arguments[..], &["--plot-pairs", "pairs.svg"]].concat()).fails(2, &["--key"]);
    study.write("tests.csv", &rows(1.0).replace("level,", "exc_id,").replace("high", "1").replace("low", "1"));
    study
        .uplift(&["validate", "tests.csv", "tests.csv"])
        .fails(4, &["tests.csv: \"1\" is in rows 1 and 2", "24 more rows", "--key"]);
    study.write("measured.csv", MEASURED);
    study.write("computed.csv", COMPUTED);
    study
        .uplift(&["validate", "measured.csv", "computed.csv", "--by", "level", "--plot-pairs", "pairs.png", "-q"])
        .ok();
    assert!(std::fs::read(study.path().join("pairs.png")).unwrap().starts_with(b"\x89PNG"));
    // nobody else's table is overwritten
    study.uplift(&[&arguments[..], &["-o", "measured.csv"]].concat()).fails(2, &["measured.csv already exists"]);
    study
        .uplift(&["validate", "measured.csv", "computed.csv", "--by", "level", "-o", "computed.csv", "--force"])
        .fails(2, &["would overwrite an input"]);
}

/// Every mistake of a table at once, with its row; columns that are not there, with those that are.
#[test]
fn mistakes() {
    let study = SmallStudy::new();
    study.write("good.csv", COMPUTED);
    study.write("bad.csv", "exc_id,level,u_m\n1,low,0.1\n2,,0.2\n3,low,fell over\n4,low,-0.1\n5,low,\">x\"\n");
    let run = |arguments: &[&str]| study.uplift(&[&["validate"], arguments].concat());
    run(&["bad.csv", "good.csv", "--by", "level"]).fails(
        4,
        &["4 problems", "row 2, level: blank", "row 3, u_m: \"fell over\"", "row 4, u_m: -0.1 is below 0", "row 5"],
    );
    run(&["good.csv", "good.csv", "--value", "drift"]).fails(4, &["drift, drift_percent", "u_m, exc_id, class, level"]);
    study.write("two.csv", "u_m,u_mm\n1,1000\n");
    run(&["good.csv", "two.csv"]).fails(4, &["it has the columns u_m, u_mm: leave one"]);
    run(&["good.csv", "good.csv", "--by", "lvl"]).fails(4, &["neither table has the column lvl"]);
    run(&["good.csv", "good.csv", "--key", "motion"]).fails(4, &["no column motion, which --key names"]);
    study.write("other.csv", "exc_id,u_m\n77,0.1\n");
    run(&["good.csv", "other.csv", "--key", "exc_id,level"]).fails(4, &["no column level"]);
    study.write("blank.csv", "exc_id,level,u_m\n1,low,\n2,low,nan\n");
    run(&["blank.csv", "good.csv", "--by", "level"])
        .fails(4, &["measured blank.csv: no row has a value in its column u_m"]);
    study.write("low.csv", "exc_id,level,u_m\n77,low,0.1\n");
    run(&["low.csv", "good.csv", "--by", "level"]).fails(4, &["no row in common", "77, low", "1, low"]);
    run(&["good.csv", "good.csv", "--by", "level", "--significance", "10", "--replicates", "0"])
        .fails(2, &["significance 10", "0 replicates"]);
    run(&["good.csv", "missing.csv"]).fails(4, &["missing.csv"]);
}

/// Peaks in another unit than their column says.
#[test]
fn peaks_in_another_unit_are_asked_about() {
    let study = SmallStudy::new();
    let peaks = |name: &str, column: &str, times: f64| {
        let rows = (1..=8).map(|row| format!("{row},{}\n", times * f64::from(row))).collect::<Vec<_>>().concat();
        study.write(name, &format!("exc_id,{column}\n{rows}"));
    };
    let answer = |arguments: &[&str]| {
        study.uplift(&[&["validate", "tests.csv", "model.csv", "--replicates", "50"], arguments].concat()).ok().stdout
    };
    peaks("model.csv", "u_m", 0.022);
    for (times, words) in [
        (20.0, "mistake? the median of the measured peaks is 90 m; usual is from 1e-4 to 20 m"),
        (2.0, "mistake? the median of the measured peaks is 91 times that of the computed: are both in the units"),
    ] {
        peaks("tests.csv", "u_m", times);
        assert!(answer(&[]).contains(words), "{}", answer(&[]));
    }
    peaks("tests.csv", "u_mm", 20.0);
    assert!(!answer(&[]).contains("mistake?"), "{}", answer(&[]));
    for name in ["tests.csv", "model.csv"] {
        peaks(name, "f_kn", 1e4);
    }
    assert!(!answer(&["--value", "f_kn"]).contains("mistake?"));
}

/// 200 000 motions take seconds, and what is no longer exact is said.
#[test]
fn very_many_motions() {
    let study = SmallStudy::new();
    for (name, shift) in [("measured.csv", 0.0), ("computed.csv", 800.5)] {
        let rows = (0..200_000).map(|row| format!("{row},{}\n", f64::from(row) + shift)).collect::<Vec<_>>().concat();
        study.write(name, &format!("exc_id,u_m\n{rows}"));
    }
    let found = json(&study, &["measured.csv", "computed.csv"]);
    let group = &found["groups"][0];
    assert_eq!((&group["kolmogorov_smirnov"]["is_exact"], &group["replicates"]), (&false.into(), &1000.into()));
    close(&group["kolmogorov_smirnov"]["distance"], 0.004_005);
    let notes = texts(&found["notes"]);
    for words in ["p is Kolmogorov's", "the bands have only 1000 replicates"] {
        assert!(notes.iter().any(|note| note.contains(words)), "{notes:?}");
    }
    // and Ctrl-C takes a moment
    #[cfg(unix)]
    {
        let run = study.start(&["validate", "measured.csv", "computed.csv"]);
        std::thread::sleep(std::time::Duration::from_secs(2));
        run.interrupt();
        let begin = std::time::Instant::now();
        assert_eq!(run.end().code, 5);
        assert!(begin.elapsed().as_secs() < 2);
    }
}
