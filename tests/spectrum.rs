//! `uplift spectrum`, `uplift warnings` and `uplift init`: a number at any strength and return period, what to doubt of
//! it, and a study to start from.

use std::path::Path;

use serde_json::Value;

use crate::common::{Finished, SMALL_STUDY, SmallStudy, array, same_bits, uplift};

/// Strengths of the small study.
const STRENGTHS: [f64; 10] = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];

/// The small study and its result `r.h5`.
fn study() -> SmallStudy {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

fn ask(study: &SmallStudy, more: &[&str]) -> Finished {
    study.uplift(&[&["spectrum", "r.h5"], more].concat())
}

fn json(study: &SmallStudy, more: &[&str]) -> Value {
    ask(study, &[more, &["--json"]].concat()).json()
}

/// Displacements with the limits of their bands, NaN without.
fn numbers(found: &Value) -> Vec<[f64; 3]> {
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let displacements = found["displacements"].as_array().unwrap().iter();
    displacements.map(|own| [number(&own["u_m"]), number(&own["band_m"][0]), number(&own["band_m"][1])]).collect()
}

/// The ordinates `/urs/pgv/u_m` of a site at the probability of this position, by strength.
fn ordinates(study: &SmallStudy, site: usize, poe: usize) -> Vec<f64> {
    let all = array(&study.path().join("r.h5"), "/urs/pgv/u_m");
    all[(site * 3 + poe) * STRENGTHS.len()..][..STRENGTHS.len()].to_vec()
}

#[test]
fn an_answer_is_a_line_with_its_number_first() {
    let study = study();
    let said = ask(&study, &["--strength", "0.13", "--return-period", "475"]).ok().stdout;
    let found = numbers(&json(&study, &["--strength", "0.13", "--return-period", "475"]));
    let lines: Vec<&str> = said.lines().take_while(|line| !line.is_empty()).collect();
    assert_eq!((lines.len(), found.len()), (2, 2), "{said}");
    for ((line, site), [u_m, lower_m, upper_m]) in lines.iter().zip(["Here", "There"]).zip(found) {
        let (number, rest) = line.split_once(" m (90 % band ").unwrap_or_else(|| panic!("{line}"));
        let (band, of) = rest.split_once(')').unwrap();
        let limits: Vec<f64> = band.split(" to ").map(|limit| limit.parse().unwrap()).collect();
        assert_eq!(of, format!("  {site}, strength 0.13, 475 years, by PGV"));
        for (shown, exact) in [(number.parse::<f64>().unwrap(), u_m), (limits[0], lower_m), (limits[1], upper_m)] {
            // two digits
            assert!((shown - exact).abs() <= 0.05 * exact.max(1e-4), "{line}: {exact}");
        }
    }
    // what does not uplift says so, below the answer
    let elastic = "\nBelow 0.0005 m the structure does not uplift: no design values\n";
    let weak = ["--strength", "0.8", "--site", "here", "--poe", "50%"];
    let is_elastic = numbers(&json(&study, &weak)).iter().all(|[u_m, ..]| 0.0 < *u_m && *u_m < 0.0005);
    assert!(is_elastic && ask(&study, &weak).ok().stdout.contains(elastic) && !said.contains(elastic), "{said}");
    // one of a site, by a probability; warnings follow, and quietly there are none
    let one = ["--strength", "0.13", "--site", "there", "--poe", "10%"];
    let said = ask(&study, &one).ok().stdout;
    let (first, rest) = said.split_once('\n').unwrap();
    assert!(first.ends_with("  There, strength 0.13, 10 % in 50 years, by PGV"), "{said}");
    assert!(rest.starts_with("\nWarnings\n  "), "{said}");
    assert_eq!(ask(&study, &[&one[..], &["-q"]].concat()).ok().stdout, format!("{first}\n"));
}

#[test]
fn on_the_strengths_of_the_result_it_is_its_ordinate_and_between_them_on_a_line() {
    let study = study();
    for (site, name) in ["Here", "There"].into_iter().enumerate() {
        for (poe, probability) in ["0.02", "0.1", "0.5"].into_iter().enumerate() {
            let expected = ordinates(&study, site, poe);
            let asked = ["--site", name, "--poe", probability, "--strength"];
            let all = STRENGTHS.map(|strength| strength.to_string()).join(",");
            let found = numbers(&json(&study, &[&asked[..], &[&all]].concat()));
            let u_m: Vec<f64> = found.iter().map(|[u_m, ..]| *u_m).collect();
            assert!(same_bits(&u_m, &expected), "{name} {probability}: {u_m:?} {expected:?}");
            // a quarter of the way from 0.1 to 0.2
            let [left, right] = [&found[2], &found[3]];
            let [between] = numbers(&json(&study, &[&asked[..], &["0.125"]].concat()))[..] else { panic!() };
            for ((between, left), right) in between.iter().zip(left).zip(right) {
                assert!((between - (0.75 * left + 0.25 * right)).abs() <= 1e-15, "{between} {left} {right}");
            }
        }
    }
    // the same numbers as comma-separated values, to the last digit
    let printed = ask(&study, &["--strength", "0.125,0.2", "--csv"]).ok();
    assert!(printed.stderr.contains("Warnings\n  Synthetic records"), "{}", printed.stderr);
    let csv = printed.stdout;
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("site,im,strength,poe,years,return_period_years,u_m,lower_m,upper_m"));
    let rows: Vec<Vec<String>> = lines.map(|line| line.split(',').map(str::to_owned).collect()).collect();
    let found = numbers(&json(&study, &["--strength", "0.125,0.2"]));
    assert_eq!(rows.len(), found.len());
    for (row, expected) in rows.iter().zip(found) {
        let told: Vec<f64> = row[6..].iter().map(|cell| cell.parse().unwrap()).collect();
        assert!(same_bits(&told, &expected), "{row:?}");
    }
    // a return period is the probability that it is
    let years = 50.0 / -(-0.02_f64).ln_1p();
    let by_period = numbers(&json(&study, &["--strength", "0.1", "--return-period", &years.to_string()]));
    let by_poe = numbers(&json(&study, &["--strength", "0.1", "--poe", "0.02"]));
    for (a, b) in by_period.concat().iter().zip(by_poe.concat()) {
        assert!((a - b).abs() <= 1e-12 * b, "{a} {b}");
    }
}

#[test]
fn the_band_is_that_of_all_records_like_these_in_a_bootstrap() {
    let study = study();
    study.uplift(&["bootstrap", "r.h5", "--sizes", "2,4", "--replicates", "20", "-q"]).ok();
    for measure in ["pgv", "pga"] {
        let [lower, upper] = ["lower", "upper"]
            .map(|end| array(&study.path().join("r.h5"), &format!("/bootstrap/{measure}/truth_{end}_m")));
        // [site, poe, size, strength], of which the second size is all records
        assert_eq!(lower.len(), 2 * 3 * 2 * STRENGTHS.len());
        let all = STRENGTHS.map(|strength| strength.to_string()).join(",");
        let found = numbers(&json(&study, &["--measure", measure, "--poe", "0.02,0.1,0.5", "--strength", &all]));
        assert_eq!(found.len(), 2 * 3 * STRENGTHS.len());
        let mut compared = 0;
        for (place, [_, lower_m, upper_m]) in found.iter().enumerate() {
            let (spectrum, strength) = (place / STRENGTHS.len(), place % STRENGTHS.len());
            let at = (spectrum * 2 + 1) * STRENGTHS.len() + strength;
            for (own, stored) in [(*lower_m, lower[at]), (*upper_m, upper[at])] {
                // a band without an end is none in JSON
                let is_none = own.is_nan() && !stored.is_finite();
                assert!(is_none || (own - stored).abs() <= 1e-12 * stored, "{measure} {place}: {own} {stored}");
                compared += usize::from(own > 0.0);
            }
        }
        assert!(compared > 60, "{compared}");
    }
    // and so does what the command shows
    let shown = study.uplift(&["bootstrap", "r.h5", "--sizes", "2,4", "--replicates", "20"]).ok().stdout;
    let table = study.uplift(&["spectrum", "r.h5", "-q"]).ok().stdout;
    assert!(shown.contains(&table), "{shown}\n{table}");
}

#[test]
fn a_folder_is_its_only_result() {
    let study = study();
    let own = ask(&study, &["-q"]).ok().stdout;
    std::fs::create_dir(study.path().join("results")).unwrap();
    study
        .uplift(&["spectrum", "results"])
        .fails(2, &["results is a folder without a result: give a result, or a study to run"]);
    assert_eq!(study.uplift(&["spectrum", ".", "-q"]).ok().stdout, own);
    std::fs::copy(study.path().join("r.h5"), study.path().join("results/b.h5")).unwrap();
    assert_eq!(study.uplift(&["spectrum", "results", "-q"]).ok().stdout, own);
    study.uplift(&["spectrum", "."]).fails(2, &["several results", "./r.h5, ./results/b.h5"]);
}

#[test]
fn a_caution_about_the_number_comes_first() {
    let said = ask(&study(), &["--strength", "0.2", "--return-period", "1e8"]).ok().stdout;
    let first = said.split_once("Warnings\n").unwrap().1.lines().next().unwrap().to_owned();
    assert!(first.contains("displacements may be too small"), "{said}");
}

#[test]
fn what_the_result_does_not_have_is_refused_with_what_it_has() {
    let study = study();
    for (asked, words) in [
        (&["--strength", "0.9"][..], &["--strength 0.9", "strengths from 0 to 0.8", "strengths.values"][..]),
        (&["--strength=-0.1"][..], &["--strength -0.1", "a strength is not negative"][..]),
        (&["--strength", "-0.1"], &["--strength -0.1", "strengths from 0 to 0.8"]),
        (&["--strength", "a fifth"], &["write a number"]),
        (&["--site", "Nowhere"], &["the result has no site Nowhere: it has Here, There"]),
        (&["--measure", "sa_1s"], &["the result has no measure sa_1s: it has pgv, pga"]),
        (&["--measure", "pgx"], &["--measure", "pgx"]),
        (&["--repaired"], &["no repaired spectra by PGV", "uplift consistency r.h5 --repair"]),
        (&["--capacity-m", "0.0001"], &["--capacity-m"]),
        (&["--return-period", "0"], &["--return-period"]),
        (&["--poe", "2"], &["2 % is --poe 2%", "a return period is --return-period 2"]),
        (&["--json", "--csv"], &["--csv"]),
    ] {
        ask(&study, asked).fails(2, words);
    }
    study.uplift(&["spectrum", "absent.h5"]).fails(4, &["absent.h5"]);
    study.uplift(&["run", "study.toml", "-o", "bare.h5", "-q", "--set", "sites=[]"]).ok();
    study.uplift(&["spectrum", "bare.h5"]).fails(4, &["no sites"]);
}

// Energy of a force that falls from 1 to 0 between uplift and capacity, and of one that stays (Eq. 3.11), by hand.
#[test]
fn a_capacity_raises_displacements_by_equal_energy() {
    let study = study();
    let asked = ["--strength", "0.05,0.2", "--poe", "0.1"];
    let plain = numbers(&json(&study, &asked)).concat();
    let (uplift_m, capacity_m) = (0.0005, 0.5);
    let raised = numbers(&json(&study, &[&asked[..], &["--capacity-m", "0.5"]].concat())).concat();
    let mut compared = 0;
    for (zero_m, raised_m) in plain.into_iter().zip(raised) {
        if zero_m <= uplift_m {
            assert_eq!(zero_m.to_bits(), raised_m.to_bits());
        } else if raised_m.is_finite() {
            let left_m = capacity_m - uplift_m;
            let own = raised_m - uplift_m;
            assert!((own - own * own / (2.0 * left_m) - (zero_m - uplift_m)).abs() < 1e-12, "{zero_m} {raised_m}");
            assert!(raised_m > zero_m);
            compared += 1;
        } else {
            // beyond what the capacity has energy for
            assert!(zero_m - uplift_m > 0.5 * (capacity_m - uplift_m), "{zero_m}");
        }
    }
    assert!(compared >= 6, "{compared}");
    let said = ask(&study, &["--strength", "0.2", "--capacity-m", "0.5"]).ok().stdout;
    assert!(said.lines().next().unwrap().ends_with("by PGV, capacity 0.5 m"), "{said}");
    // warnings have the years that are asked for
    let said = ask(&study, &["--strength", "0.2", "--years", "100"]).ok().stdout;
    assert!(said.contains(", 2 % in 100 years"), "{said}");
    // centimetres taken for metres
    let said = ask(&study, &["--strength", "0.2", "--capacity-m", "120"]).ok().stdout;
    assert!(said.contains("mistake? spectrum: --capacity-m is 120 m; usual is from 0.01 to 20 m"), "{said}");
    // too small a capacity is overturning in words, and nothing in JSON
    let tiny = ["--strength", "0.05", "--capacity-m", "0.002"];
    assert!(ask(&study, &tiny).ok().stdout.starts_with("overturns  Here, "));
    assert!(json(&study, &tiny)["displacements"][0]["u_m"].is_null());
}

#[test]
fn without_a_question_it_is_the_table_of_a_run() {
    let study = SmallStudy::new();
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok().stdout;
    let shown = ask(&study, &[]).ok().stdout;
    let table = |said: &str| said.split("\n\nWarnings").next().unwrap().to_owned();
    assert_eq!(table(&run), table(&shown));
    assert!(table(&run).lines().count() >= 5, "{run}");
    let quiet = study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--force"]).ok().stdout;
    assert_eq!(quiet, ask(&study, &["-q"]).ok().stdout);
    assert!(table(&run).ends_with(quiet.trim_end()), "{quiet}");
    // in detail a run shows every risk and measure
    let details = study.uplift(&["run", "study.toml", "-o", "r.h5", "--force", "--details"]).ok().stdout;
    for measure in ["pgv", "pga"] {
        let all = ask(&study, &["--measure", measure, "--poe", "0.02,0.1,0.5", "-q"]).ok().stdout;
        assert!(details.contains(&all), "{details}\n{all}");
    }
    // what was shaken, in the details of an answer too
    let oscillator = "\nOscillator: uplift displacement 0.5 mm, restitution 0.95\n";
    let answer = ask(&study, &["--strength", "0.2", "--poe", "0.1", "--details"]).ok().stdout;
    assert!(details.contains(oscillator) && answer.contains(oscillator), "{details}\n{answer}");
}

#[test]
fn repaired_spectra_are_those_of_the_result() {
    let study = SmallStudy::repaired();
    let u_m = array(&study.path().join("r.h5"), "/consistency/pgv/u_m");
    let asked = ["--repaired", "--site", "Athens &lt; 1", "--strength", "0.05,0.1,0.2,0.4", "--poe", "0.02,0.1,0.5"];
    let found = json(&study, &asked);
    let own: Vec<f64> = numbers(&found).iter().map(|[u_m, ..]| *u_m).collect();
    assert!(same_bits(&own, &u_m[12..]), "{own:?} {u_m:?}");
    assert_eq!(found["repaired"], true);
    let said = ask(&study, &["--repaired"]).ok().stdout;
    assert!(
        said.contains("Repaired uniform risk spectra, 40 synthetic records, ") && said.contains("(90 % band)"),
        "{said}"
    );
    for [u_m, lower_m, upper_m] in numbers(&found) {
        assert!(lower_m <= u_m && u_m <= upper_m && lower_m < upper_m, "{found}");
    }
    // the site without weights has no number, and is no error
    assert!(said.lines().any(|line| line.starts_with("Montreux") && line.contains(" none")), "{said}");
    // what this spectrum rests on is the first warning, whichever risk is asked for
    let by_pga = ["--repaired", "--measure", "pga"];
    for risk in [&[][..], &["--return-period", "475"]] {
        let alarms = json(&study, &[&by_pga, risk].concat())["alarms"].clone();
        assert_eq!(alarms[0]["kind"], "few-effective-records", "{alarms}");
    }
    // asked for alone, there is no answer
    let alone = ["--repaired", "--site", "Montreux"];
    ask(&study, &alone).fails(2, &["no weights repair the records by PGV", "uplift consistency r.h5 --details"]);
}

#[test]
fn every_warning_of_a_run_is_listed() {
    let study = SmallStudy::new();
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5", "--json"]).json();
    let listed = study.uplift(&["warnings", "r.h5", "--json"]).json();
    let listed = listed.as_array().unwrap();
    assert!(run["alarms"].as_array().unwrap().iter().all(|alarm| listed.contains(alarm)), "{listed:?}");
    // and what is raised where one measure is asked for alone
    for measure in ["pgv", "pga"] {
        let asked = ["spectrum", "r.h5", "--measure", measure, "--json"];
        let found = study.uplift(&asked).json();
        for alarm in found["alarms"].as_array().unwrap() {
            assert!(listed.iter().any(|own| own["kind"] == alarm["kind"]), "{alarm}");
        }
    }
    let said = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    let alarms = run["alarms"].as_array().unwrap();
    assert!(alarms.len() > 3, "{said}");
    let mut rest = said.as_str();
    for alarm in alarms {
        // in this order
        for key in ["severity", "subject", "what"] {
            let words = alarm[key].as_str().unwrap();
            rest = rest.split_once(words).unwrap_or_else(|| panic!("{words}\n{said}")).1;
        }
        for also in alarm["also"].as_array().unwrap() {
            assert!(rest.contains(also.as_str().unwrap()), "{also}\n{said}");
        }
    }
    // at another risk, what holds at that
    let rare = study.uplift(&["warnings", "r.h5", "--return-period", "5000"]).ok().stdout;
    assert!(rare != said && rare.contains("Synthetic records"), "{rare}");
    study.uplift(&["warnings", "absent.h5"]).fails(4, &["absent.h5"]);
    study.uplift(&["warnings"]).fails(2, &["RESULT"]);
}

fn content(folder: &Path) -> Vec<Vec<u8>> {
    ["study.toml", "hazard/athens-pgv.csv", "hazard/athens-pga.csv"]
        .map(|file| std::fs::read(folder.join(file)).unwrap())
        .into()
}

#[test]
fn a_study_is_made_where_there_is_none() {
    let folder = tempfile::tempdir().unwrap();
    let said = uplift(folder.path(), &["init", "first"]).ok();
    assert!(said.stdout.starts_with("first/study.toml\n"), "{}", said.stdout);
    assert!(said.stderr.contains("Next: uplift run first/study.toml"), "{}", said.stderr);
    let before = content(&folder.path().join("first"));
    // nothing of a study is overwritten, be it one of its files alone
    uplift(folder.path(), &["init", "first"]).fails(2, &["first/study.toml exists and is not overwritten"]);
    uplift(folder.path(), &["init"]).fails(2, &["first/study.toml exists"]);
    std::fs::remove_file(folder.path().join("first/study.toml")).unwrap();
    uplift(folder.path(), &["init", "first"]).fails(2, &["athens-pgv.csv exists"]);
    assert!(!folder.path().join("first/study.toml").exists());
    uplift(folder.path(), &["init", "second", "-q"]).ok();
    assert_eq!(content(&folder.path().join("second")), before);
    let checked = uplift(folder.path(), &["check", "second/study.toml"]).ok().stdout;
    assert!(checked.starts_with("The study can be run: "), "{checked}");
}

#[test]
#[ignore = "long: make test-long"]
fn the_study_that_was_made_runs() {
    let folder = tempfile::tempdir().unwrap();
    uplift(folder.path(), &["init", "."]).ok();
    let run = uplift(folder.path(), &["run", "study.toml"]).ok().stdout;
    assert!(run.contains("Uniform risk spectra, 30 synthetic records, 2 % in 50 years, by PGV\n"), "{run}");
    let row = run.lines().find(|line| line.starts_with("Athens ")).unwrap();
    assert_eq!(row.matches('–').count(), 3, "a band each: {row}");
    // as its first lines say
    let said = uplift(folder.path(), &["spectrum", "results/study.h5", "--strength", "0.13", "--return-period", "475"]);
    assert!(said.ok().stdout.contains("  Athens, strength 0.13, 475 years, by PGV\n"));
}

/// The small study has what these tests count on.
#[test]
fn the_strengths_here_are_those_of_the_small_study() {
    assert!(SMALL_STUDY.contains("values = [0, 0.05, \"0.1:0.1:0.8\"]"));
}
