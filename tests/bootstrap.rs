//! `uplift bootstrap`, `influence` and `measures`: what they say, what they leave behind, and how they stop and go on.

use serde_json::Value;
use uplift::text::two_digits;
use uplift_labelled::LabelledReader;

use crate::common::{self, SmallStudy, array, real_records, repository, same_bits};

/// The limits beyond the set, from the lowest to the highest, around the spectrum.
const INFERRED: [&str; 4] = ["prediction_lower_m", "truth_lower_m", "truth_upper_m", "prediction_upper_m"];
const BANDS: [&str; 3] = ["u05_m", "u50_m", "u95_m"];

fn rows(json: &str) -> Vec<Value> {
    serde_json::from_str(json).unwrap()
}

/// The widest band of the table, by the number of records: of all of them it is the table's.
#[test]
fn the_widest_band_is_of_the_table_above() {
    let study = SmallStudy::new();
    for capacity in [None, Some("oscillator.capacity_m=0.3")] {
        let set: Vec<&str> = capacity.iter().flat_map(|set| ["--set", set]).collect();
        study.uplift(&[&["run", "study.toml", "-o", "r.h5", "-q", "--force"], &set[..]].concat()).ok();
        let said = study.uplift(&["bootstrap", "r.h5", "--sizes", "2,4", "--replicates", "60"]).ok().stdout;
        let told = said
            .lines()
            .find_map(|line| line.strip_prefix("Widest for its ordinate: "))
            .unwrap_or_else(|| panic!("{said}"));
        let (site, rest) = told.split_once(", strength ").unwrap();
        let strength = rest.split_once(", ").unwrap().0;
        let of_all = said.lines().find_map(|line| line.strip_prefix("  4 records: ")).unwrap();
        let heading = said.lines().find(|line| line.starts_with("site ")).unwrap();
        let mut widest = (0.0, String::new());
        for name in ["Here", "There"] {
            for shown in heading.split_whitespace().skip(1) {
                let ask = ["spectrum", "r.h5", "--site", name, "--strength", shown, "--json"];
                let json = study.uplift(&ask).json();
                let found = &json["displacements"][0];
                let Some(u_m) = found["u_m"].as_f64() else { continue };
                let limits = [0, 1].map(|end| found["band_m"][end].as_f64().unwrap_or(f64::INFINITY));
                let [lower, upper] = limits.map(two_digits);
                let width = (limits[1] - limits[0]) / u_m;
                if width >= widest.0 {
                    let end = if limits[1].is_finite() { format!("{upper} m") } else { "overturning".to_owned() };
                    widest = (width, format!("{name} {shown} {lower} to {end}"));
                }
            }
        }
        assert_eq!(format!("{site} {strength} {of_all}"), widest.1, "{said}");
    }
}

#[test]
fn a_bootstrap_has_the_warnings_of_its_spectrum_and_names_repaired_bands() {
    let few = SmallStudy::new();
    few.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    for (study, is_repaired) in [(few, false), (SmallStudy::repaired(), true)] {
        let said = study.uplift(&["bootstrap", "r.h5", "--replicates", "5"]).ok().stdout;
        let spectrum = study.uplift(&["spectrum", "r.h5"]).ok().stdout;
        let warnings = spectrum.split_once("\nWarnings\n").unwrap().1;
        assert!(said.contains(warnings), "{said}\n{warnings}");
        assert_eq!(warnings.contains("Few records: 4 (40 advised)"), !is_repaired, "{warnings}");
        assert_eq!(said.contains("bands too: uplift spectrum r.h5 --repaired"), is_repaired, "{said}");
    }
}

// A study is run first, its result is used afterwards; the rows agree with the arrays, which Eq. 4.9 and 4.10 are
// formed of here anew.
#[test]
fn a_study_becomes_bands() {
    let study = SmallStudy::new();
    let result = study.path().join("results/study.h5");
    let arguments = ["bootstrap", "study.toml", "--sizes", "2,4", "--replicates", "60", "--json"];
    let first = study.uplift(&arguments).ok();
    assert!(first.stderr.contains("result   computing "), "{}", first.stderr);
    let again = study.uplift(&arguments).ok();
    assert!(again.stderr.contains("is that of the study"), "{}", again.stderr);
    assert_eq!(first.stdout, again.stdout);

    let rows = rows(&first.stdout);
    // 2 measures, 2 sites, 3 probabilities, 2 sizes
    assert_eq!(rows.len(), 24);
    let (sites, poes, sizes) = (["Here", "There"], [0.02, 0.1, 0.5], [2_u64, 4]);
    for (im, label) in [("pgv", "PGV"), ("pga", "PGA")] {
        let [lower, median, upper] = BANDS.map(|name| array(&result, &format!("/bootstrap/{im}/{name}")));
        let spectra = array(&result, &format!("/urs/{im}/u_m"));
        let strengths = 10;
        for (cell, range) in array(&result, &format!("/bootstrap/{im}/r_90ci")).into_iter().enumerate() {
            let (site, poe, size) = (cell / 6, cell / 2 % 3, cell % 2);
            let row = rows
                .iter()
                .find(|row| {
                    row["im"] == label
                        && row["site"] == sites[site]
                        && row["poe"] == poes[poe]
                        && row["sample_size"] == sizes[size]
                })
                .unwrap();
            // strength 0 is left out
            let at = |strength: usize| cell * strengths + strength;
            let widest = (1..strengths).max_by(|&a, &b| {
                let width = |strength: usize| upper[at(strength)] - lower[at(strength)];
                width(a).total_cmp(&width(b))
            });
            let widest = at(widest.unwrap());
            let expected = 100.0 * (upper[widest] - lower[widest]) / median[widest];
            assert!((range - expected).abs() < 1e-9 * expected, "{range} {expected}");
            assert!((row["r_90ci"].as_f64().unwrap() - range).abs() < 1e-9);
            let spectrum = |strength: usize| spectra[(site * 3 + poe) * strengths + strength];
            let difference = |strength: usize| (median[at(strength)] - spectrum(strength)).abs();
            let furthest = (1..strengths).max_by(|&a, &b| difference(a).total_cmp(&difference(b))).unwrap();
            let expected = 100.0 * difference(furthest) / spectrum(furthest);
            assert!((row["e_median"].as_f64().unwrap() - expected).abs() < 1e-9 * (1.0 + expected), "{row}");
        }
    }
    // the bands of the truth and of another set lie around the spectrum, and do not hang on the draws
    for im in ["pgv", "pga"] {
        let inferred = || INFERRED.map(|name| array(&result, &format!("/bootstrap/{im}/{name}")));
        let [low, lower, upper, high] = inferred();
        let spectra = array(&result, &format!("/urs/{im}/u_m"));
        // sizes 2 and 4, of 4 records
        for (place, spectrum_m) in spectra.into_iter().enumerate() {
            let at = (place / 10 * 2 + 1) * 10 + place % 10;
            let order = [0.0, low[at], lower[at], spectrum_m, upper[at], high[at]];
            assert!(order.is_sorted(), "{im} {place}: {order:?}");
        }
        let before = inferred();
        study.uplift(&["bootstrap", "study.toml", "--sizes", "2,4", "--replicates", "20", "--seed", "9", "-q"]).ok();
        assert!(before.iter().zip(&inferred()).all(|(before, after)| same_bits(before, after)));
    }
    let [lower, upper] = [0, 1].map(|limit| rows[1]["inferred"]["truth"][limit].as_f64().unwrap());
    assert!(rows[1]["sample_size"] == 4 && lower < 0.0 && upper > 0.0, "{}", rows[1]);
    study.uplift(&arguments).ok();
    let table = std::fs::read_to_string(study.path().join("results/study.table-4-1.csv")).unwrap();
    assert!(table.lines().next().unwrap().ends_with("sample_size,e_median_pct,r_90ci_pct"), "{table}");
    let bands = std::fs::read_to_string(study.path().join("results/study.bands.csv")).unwrap();
    let columns = "site,im,poe,years,sample_size,strength,u05_m,u50_m,u95_m";
    let inferred = "truth_lower_m,truth_upper_m,prediction_lower_m,prediction_upper_m";
    assert_eq!(bands.lines().next().unwrap(), format!("{columns},{inferred}"));
    assert_eq!(bands.lines().count(), 1 + 24 * 10);
    // what the run wrote is still there
    assert!(LabelledReader::open(&result).unwrap().exists("/risk/pgv/maf_per_year"));
}

#[test]
#[ignore = "long: make test-long"]
fn same_bits_on_any_number_of_threads_and_from_a_kept_plan() {
    let study = SmallStudy::new();
    for name in ["a.h5", "b.h5", "c.h5"] {
        study.uplift(&["run", "study.toml", "-o", name, "-q"]).ok();
    }
    let options = ["--sizes", "3,9", "--replicates", "40", "--seed", "5", "--simultaneous", "--interval", "bca", "-q"];
    study.uplift(&[&["bootstrap", "a.h5", "--threads", "1"], &options[..]].concat()).ok();
    study.uplift(&[&["bootstrap", "b.h5", "--threads", "3"], &options[..]].concat()).ok();
    let kept = ["bootstrap", "c.h5", "--plan", "a.h5", "--simultaneous", "--interval", "bca", "-q"];
    study.uplift(&kept).ok();
    for name in BANDS.iter().chain(&INFERRED).chain(&["simultaneous_lower_m", "simultaneous_upper_m"]) {
        for im in ["pgv", "pga"] {
            let name = format!("/bootstrap/{im}/{name}");
            let [a, b, c] = ["a.h5", "b.h5", "c.h5"].map(|file| array(&study.path().join(file), &name));
            assert!(same_bits(&a, &b) && same_bits(&a, &c), "{name}");
        }
    }
    // the pointwise band lies within the one for whole spectra
    let [lower, inner] = ["simultaneous_lower_m", "u50_m"]
        .map(|name| array(&study.path().join("a.h5"), &format!("/bootstrap/pgv/{name}")));
    assert!(lower.iter().zip(&inner).all(|(lower, inner)| lower <= inner));
    study.uplift(&["bootstrap", "a.h5", "--plan", "study.toml"]).fails(4, &["study.toml: is a study, not a result"]);
    study.uplift(&["run", "study.toml", "-o", "d.h5", "-q", "--set", "records.first=3"]).ok();
    study.uplift(&["bootstrap", "d.h5", "--plan", "a.h5"]).fails(4, &["other records"]);
    study.uplift(&["bootstrap", "a.h5", "--plan", "d.h5"]).fails(4, &["keeps no resampling plan"]);
}

/// Six pairs of three earthquakes, in one study.
fn study_of_earthquakes() -> SmallStudy {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "--count", "6", "-o", "set", "-q"]).ok();
    let path = study.path().join("set/manifest.csv");
    let mut manifest = std::fs::read_to_string(&path).unwrap();
    for (record, event) in ["A", "B", "A", "C", "B", "A"].iter().enumerate() {
        let line = manifest.lines().find(|line| line.starts_with(&format!("SYN00{}", record + 1))).unwrap().to_owned();
        let quoted = line.split('"').nth(1).unwrap();
        manifest = manifest.replace(&line, &line.replace(&format!("\"{quoted}\""), event));
    }
    std::fs::write(&path, manifest).unwrap();
    study
}

#[test]
#[ignore = "long: make test-long"]
fn earthquakes_are_drawn_with_all_their_records() {
    let study = study_of_earthquakes();
    let source = ["--set", "records.manifest=set/manifest.csv", "--set", "records.first=6"];
    study.uplift(&[&["run", "study.toml", "-o", "r.h5", "-q"][..], &source].concat()).ok();
    let options = ["--unit", "event", "--sizes", "4,12", "--replicates", "300", "--interval", "bca"];
    let told = study.uplift(&[&["bootstrap", "r.h5"][..], &options].concat()).ok();
    assert!(told.stderr.contains("with their earthquakes, 2, 6 of 3"), "{}", told.stderr);
    let file = study.path().join("r.h5");
    let drawn = LabelledReader::open(&file).unwrap().array::<u32>("/bootstrap/multiplicity").unwrap().values;
    for (index, drawn) in drawn.chunks_exact(6).enumerate() {
        assert!(drawn[0] == drawn[2] && drawn[0] == drawn[5] && drawn[1] == drawn[4], "{drawn:?}");
        assert_eq!(drawn[0] + drawn[1] + drawn[3], if index < 300 { 2 } else { 6 });
    }
    // whoever asks it something new draws the same: the plan of the file is one of earthquakes
    let json = |more: &[&str]| {
        study.uplift(&[&["export", "r.h5", "--json", "-o", "e.json", "-q", "--force"][..], more].concat()).ok();
        let text = std::fs::read_to_string(study.path().join("e.json")).unwrap();
        serde_json::from_str::<Value>(&text).unwrap()["spectra"][0]["bands"].clone()
    };
    assert_eq!(json(&[]), json(&["--poe", "0.02,0.1,0.5"]));
    // the same from the study's key
    std::fs::copy(&file, study.path().join("s.h5")).unwrap();
    let keyed = [&["run", "study.toml", "-o", "s.h5", "-q", "--force"][..], &source].concat();
    study.uplift(&[&keyed[..], &["--set", "bootstrap.unit=event", "--set", "bootstrap.replicates=300"]].concat()).ok();
    study.uplift(&["bootstrap", "s.h5", "-q", "--sizes", "4,12", "--interval", "bca"]).ok();
    for name in BANDS.map(|name| format!("/bootstrap/pgv/{name}")) {
        assert!(same_bits(&array(&file, &name), &array(&study.path().join("s.h5"), &name)), "{name}");
    }
    // the plan goes on to another result of these records
    study.uplift(&["bootstrap", "s.h5", "--plan", "r.h5", "-q", "--interval", "bca"]).ok();

    // synthetic records are of no earthquake, and records of one alone cannot be drawn
    study.uplift(&["run", "study.toml", "-o", "a.h5", "-q"]).ok();
    let alone = study.uplift(&["bootstrap", "a.h5", "--unit", "event", "--replicates", "5", "--sizes", "4"]).ok();
    assert!(alone.stderr.contains("no two pairs share an earthquake"), "{}", alone.stderr);
    let manifest = std::fs::read_to_string(study.path().join("set/manifest.csv")).unwrap();
    study.write("set/manifest.csv", &manifest.replace(",B,", ",A,").replace(",C,", ",A,"));
    study.uplift(&[&["run", "study.toml", "-o", "o.h5", "-q"][..], &source].concat()).ok();
    study.uplift(&["bootstrap", "o.h5", "--unit", "event"]).fails(2, &["all records are of one earthquake"]);
}

// Six records of an earthquake that differ in their amplitude alone: scaled to a level they are the same, and four
// earthquakes know as much as four records, whatever their records seem to know.
#[test]
fn the_quoted_band_is_by_earthquake_where_records_of_one_are_alike() {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "--count", "24", "-o", "set", "-q"]).ok();
    let file = |record: usize, which: &str| study.path().join(format!("set/SYN{record:03}_{which}.AT2"));
    let mut manifest = std::fs::read_to_string(study.path().join("set/manifest.csv")).unwrap();
    for record in 1..=24 {
        // powers of 2 change no bit of what is scaled to a level
        let (earthquake, factor) = ((record - 1) % 4 + 1, f64::from(1 << ((record - 1) / 4)));
        for which in ["H1", "H2"] {
            let text = std::fs::read_to_string(file(earthquake, which)).unwrap();
            let (head, samples) = text.split_at(text.match_indices('\n').nth(3).unwrap().0);
            let scaled = |sample: &str| format!("{:e}\n", factor * sample.parse::<f64>().unwrap());
            let samples: String = samples.split_whitespace().map(scaled).collect();
            std::fs::write(file(record, which), format!("{head}\n{samples}")).unwrap();
        }
        let line = manifest.lines().find(|line| line.starts_with(&format!("SYN{record:03}"))).unwrap().to_owned();
        let quoted = line.split('"').nth(1).unwrap();
        manifest = manifest.replace(&line, &line.replace(&format!("\"{quoted}\""), &format!("E{earthquake}")));
    }
    study.write("set/manifest.csv", &manifest);
    let run = |records: &str, result: &str| {
        let source = ["records.manifest=set/manifest.csv", records].map(|set| ["--set", set]).concat();
        study.uplift(&[&["run", "study.toml", "-o", result, "-q"][..], &source].concat()).ok();
        let size = records.rsplit('=').next().unwrap();
        study.uplift(&["bootstrap", result, "-q", "--replicates", "50", "--sizes", size]).ok();
        let asked = study.uplift(&["spectrum", result, "--json"]).ok().stdout;
        let asked: Value = serde_json::from_str(&asked).unwrap();
        let limits = ["truth_lower_m", "truth_upper_m"]
            .map(|name| array(&study.path().join(result), &format!("/bootstrap/pgv/{name}")));
        (asked["band_of"].clone(), asked["displacements"][1]["band_m"].clone(), limits)
    };
    let [many, four] = [("records.first=24", "r.h5"), ("records.first=4", "s.h5")].map(|(set, name)| run(set, name));
    assert_eq!((&many.0, &four.0), (&Value::from("earthquakes"), &Value::from("records")));
    for (of_many, of_four) in many.2.iter().flatten().zip(four.2.iter().flatten()) {
        assert!((of_many - of_four).abs() <= 1e-5 * of_four || of_many == of_four, "{of_many} {of_four}");
    }
    let limits = |band: &Value| [0, 1].map(|limit| band[limit].as_f64().unwrap());
    assert!(limits(&many.1).iter().zip(limits(&four.1)).all(|(a, b)| (a - b).abs() <= 1e-5 * b), "{many:?}");
    let said = study.uplift(&["spectrum", "r.h5"]).ok().stdout;
    assert!(said.contains("(90 % band by earthquake)"), "{said}");
    study.uplift(&["export", "r.h5", "--json", "-q"]).ok();
    let exported: Value = serde_json::from_str(&std::fs::read_to_string(study.path().join("r.json")).unwrap()).unwrap();
    assert_eq!(exported["spectra"][0]["band_of"], "earthquakes");
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    assert!(
        page.contains("(90 % confidence band by earthquake)") && page.contains("confidence bands by earthquake, from")
    );
    study.write("block.toml", "kind = \"block\"\nwidth_m = 0.4\nheight_m = 4\nmass_kg = 1000\n");
    let overturning = |result: &str| study.uplift(&["overturning", "block.toml", "--urs", result, "-q"]).ok().stdout;
    assert!(overturning("r.h5").contains(")†") && overturning("r.h5").contains("\n† band by earthquake\n"));
    assert!(!overturning("s.h5").contains('†'));
    // so does the design of a frame
    study.write(
        "frame.toml",
        "kind = \"frame\"\ncolumns = 3\nwidth_m = 1\nheight_m = 8\ncolumn_mass_kg = 15e3\ndeck_mass_kg = 400e3\n\
         column_shape = \"cylinder\"\n",
    );
    let design = ["design", "frame.toml", "--urs", "r.h5", "--site", "Here", "-q"];
    let designed = study.uplift(&design).ok().stdout;
    assert!(designed.contains(")†") && designed.contains("\n† band by earthquake\n"), "{designed}");
    let warned = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    assert!(warned.contains("Few earthquakes: 4; below 5 the bands are unreliable."), "{warned}");
    // before anything is computed too, and of a sweep where it is so
    let manifest = ["--set", "records.manifest=set/manifest.csv"];
    let checked = study
        .uplift(&[&["check", "study.toml", "--details", "--set", "records.first=24"], &manifest[..]].concat())
        .ok()
        .stdout;
    assert!(checked.contains("Few earthquakes: 4; below 5 the bands are unreliable"), "{checked}");
    // two records are of two earthquakes at most, whether they share one or not
    for (records, words) in [("records.first=2", "Few earthquakes: "), ("records.first=1", "Few records: 1 ")] {
        let few = study.uplift(&[&["check", "study.toml", "--details", "--set", records], &manifest[..]].concat()).ok();
        assert!(few.stdout.contains(words), "{}", few.stdout);
        assert_eq!(few.stdout.contains("Few earthquakes"), records.ends_with('2'), "{}", few.stdout);
    }
    let sweep = |first: &str| {
        let over = format!("records.first={first}");
        study.uplift(&[&["sweep", "study.toml", "-o", first, "--over", &over], &manifest[..]].concat()).ok().stdout
    };
    let [both, all] = ["4,24", "24"].map(sweep);
    assert!(both.contains("(90 % band, by earthquake: first-24)"), "{both}");
    assert!(all.contains("(90 % band by earthquake)"), "{all}");
    // the safe value of a structure is by the same
    study.write("block.toml", "kind = \"block\"\nwidth_m = 0.4\nheight_m = 2\nmass_kg = 1000\n");
    let ask = ["--vary", "width", "--site", "Here", "--exceed", "0.1", "--per-year", "2e-3", "--json", "-q"];
    let [shared, alone] = ["r.h5", "s.h5"].map(|result| -> Value {
        let found = study.uplift(&[&["target", "block.toml", "--urs", result], &ask[..]].concat()).ok();
        serde_json::from_str(&found.stdout).unwrap()
    });
    let of = |found: &Value| -> Vec<Value> {
        found["bands"].as_array().unwrap().iter().map(|band| band["of"].clone()).collect()
    };
    assert_eq!((of(&shared), of(&alone)), (vec!["records".into(), "earthquakes".into()], vec!["records".into()]));
    let value = |found: &Value, band: usize| limits(&found["bands"][band]["value"]);
    for (of_shared, of_alone) in value(&shared, 1).into_iter().zip(value(&alone, 0)) {
        // other sums, rounded
        assert!((of_shared - of_alone).abs() <= 1e-12 * of_alone, "{of_shared} {of_alone}");
    }
    // as it comes to drawing them
    study.uplift(&["bootstrap", "r.h5", "-q", "--replicates", "50", "--sizes", "24", "--unit", "event"]).ok();
    let by_event = array(&study.path().join("r.h5"), "/bootstrap/pgv/truth_upper_m");
    assert!(same_bits(&by_event, &many.2[1]));
}

// A pair of twins knows no more than one of them: the bands are those of one component.
#[test]
fn components_of_a_pair_scatter_together() {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "--count", "6", "-o", "set", "-q"]).ok();
    for record in 1..=6 {
        let [first, second] = ["H1", "H2"].map(|which| study.path().join(format!("set/SYN00{record}_{which}.AT2")));
        std::fs::copy(first, second).unwrap();
    }
    let bands_of = |component: &str, size: &str| {
        let result = format!("{component}.h5");
        let component = format!("records.component={component}");
        let set = ["--set", "records.manifest=set/manifest.csv", "--set", "records.first=6", "--set", &component];
        study.uplift(&[&["run", "study.toml", "-o", &result, "-q"][..], &set].concat()).ok();
        study.uplift(&["bootstrap", &result, "-q", "--sizes", size, "--replicates", "50"]).ok();
        ["u05_m", "truth_lower_m", "truth_upper_m", "prediction_lower_m", "prediction_upper_m"]
            .map(|name| array(&study.path().join(&result), &format!("/bootstrap/pgv/{name}")))
    };
    let ([drawn, one @ ..], [drawn_alone, both @ ..]) = (bands_of("h1", "6"), bands_of("both", "12"));
    // upper limits lie between demands, by a factor that is rounded
    let is_same = |(one, both): (&f64, &f64)| (one - both).abs() <= 1e-12 * one;
    assert!(one.iter().flatten().zip(both.iter().flatten()).all(is_same), "{one:?}\n{both:?}");
    assert!(one.iter().flatten().all(|limit| !limit.is_nan()));
    assert!(!same_bits(&drawn, &drawn_alone), "components are drawn one by one");
}

/// The number in "12 of 100 strengths are kept".
fn kept_strengths(said: &str) -> usize {
    let words: Vec<&str> = said.split_whitespace().collect();
    let at = words.windows(2).position(|pair| pair[0] == "interrupted:" && pair[1].parse::<usize>().is_ok()).unwrap();
    words[at + 1].parse().unwrap()
}

// Stopped in the middle, it keeps what is done and goes on from there, to the same bits.
#[cfg(unix)]
#[test]
#[ignore = "long: make test-long"]
fn an_interrupted_bootstrap_resumes() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "whole.h5", "-q", "--set", "strengths.values=0.02:0.02:1"]).ok();
    std::fs::copy(study.path().join("whole.h5"), study.path().join("parts.h5")).unwrap();
    let options = ["--sizes", "4,8", "--replicates", "20000"];
    let arguments = |file: &'static str| [&["bootstrap", file, "--threads", "1"], &options[..]].concat();
    study.uplift(&arguments("whole.h5")).ok();

    // one of other settings that was interrupted stays through all of this
    let part = study.path().join("parts.bootstrap.part.h5");
    let mut other = study.start(&["bootstrap", "parts.h5", "--threads", "1", "--replicates", "40000"]);
    other.wait_until_said("plan");
    other.interrupt();
    other.end().fails(5, &["Run the same command to resume"]);
    let of_other = std::fs::read(&part).unwrap();

    let mut kept = 0;
    for pause in 0..3 {
        let mut run = study.start(&arguments("parts.h5"));
        run.wait_until_said("plan");
        // some strengths are done by then, or none, or all on a very fast machine: each must be right
        std::thread::sleep(std::time::Duration::from_millis(200));
        if pause < 2 {
            run.interrupt();
        }
        let done = run.end();
        assert!(kept == 0 || done.stderr.contains(&format!("{kept} strengths from")), "{}", done.stderr);
        if done.code == 0 {
            println!("finished after {pause} pauses");
            break;
        }
        let done = done.fails(5, &["Run the same command to resume"]);
        assert!(!LabelledReader::open(&study.path().join("parts.h5")).unwrap().exists("/bootstrap"));
        kept = kept_strengths(&done.stderr);
        let status = study.uplift(&["status", "parts.h5"]).ok().stdout;
        let resume = "; to resume it type: uplift bootstrap parts.h5 --threads 1 --replicates 40000\n";
        assert!(status.contains("an interrupted bootstrap") && status.contains(resume), "{status}");
        let own = done.stderr.split_once("parts.bootstrap-").unwrap().1;
        let own = format!("parts.bootstrap-{}", own.split_once(".h5").unwrap().0) + ".h5";
        let status = study.uplift(&["status", &own]).ok().stdout;
        assert!(status.contains(&format!("an interrupted bootstrap, {kept} strengths finished")), "{status}");
    }
    for name in BANDS {
        let name = format!("/bootstrap/pgv/{name}");
        let [whole, parts] = ["whole.h5", "parts.h5"].map(|file| array(&study.path().join(file), &name));
        assert!(same_bits(&whole, &parts), "{name}");
    }
    let left = std::fs::read_dir(study.path()).unwrap();
    let left: Vec<String> = left.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(left.iter().filter(|name| name.contains(".part.h5")).collect::<Vec<_>>(), ["parts.bootstrap.part.h5"]);
    assert_eq!(std::fs::read(&part).unwrap(), of_other);
}

#[test]
#[ignore = "long: make test-long"]
fn sizes_above_the_set_one_record_and_one_replicate_are_defined() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let more = study.uplift(&["bootstrap", "r.h5", "--sizes", "1,400", "--replicates", "1", "--json"]).ok();
    assert!(more.stderr.contains("samples of 400 records from a set of 4"), "{}", more.stderr);
    // one replicate has no width
    assert!(rows(&more.stdout).iter().all(|row| row["r_90ci"] == 0.0));

    study.uplift(&["run", "study.toml", "-o", "one.h5", "-q", "--set", "records.first=1"]).ok();
    let one = study.uplift(&["bootstrap", "one.h5", "--replicates", "5", "--json", "--interval", "bca"]).ok();
    for row in rows(&one.stdout) {
        assert_eq!((&row["sample_size"], &row["e_median"]), (&Value::from(1), &Value::from(0.0)), "{row}");
    }
    study.uplift(&["influence", "one.h5"]).ok();
    study.uplift(&["measures", "one.h5"]).ok();
}

// An ordinate that overturning makes infinite, or that nothing exceeds so often, gives no ratio, and says so.
#[test]
#[ignore = "long: make test-long"]
fn overturning_and_spectra_of_zero_are_defined() {
    let study = SmallStudy::new();
    let run = |name: &str, keys: [&str; 2]| {
        study.uplift(&["run", "study.toml", "-o", name, "-q", "--set", keys[0], "--set", keys[1]]).ok();
        let finished = study.uplift(&["bootstrap", name, "--sizes", "4", "--replicates", "30", "--json"]).ok();
        study.uplift(&["bootstrap", name, "--sizes", "4", "--replicates", "30"]).ok();
        study.uplift(&["influence", name]).ok();
        study.uplift(&["measures", name]).ok();
        rows(&finished.stdout)
    };
    let overturned = run("overturned.h5", ["oscillator.capacity_m=0.004", "risk.years=50"]);
    assert!(array(&study.path().join("overturned.h5"), "/bootstrap/pgv/u95_m").contains(&f64::INFINITY));
    assert!(overturned.iter().any(|row| row["r_90ci"].is_null() && row["e_median"].is_null()));
    // a target of 16 a year, above λ(0) everywhere
    let still = run("still.h5", ["risk.poe=[0.9999999]", "risk.years=1"]);
    assert!(array(&study.path().join("still.h5"), "/bootstrap/pgv/u95_m").iter().all(|&u_m| u_m == 0.0));
    for row in still {
        assert_eq!((row["e_median"].as_f64(), row["r_90ci"].as_f64()), (Some(0.0), Some(0.0)), "{row}");
    }
}

#[test]
fn mistakes_are_said_before_anything_is_computed() {
    let study = SmallStudy::new();
    study.uplift(&["bootstrap", "absent.h5"]).fails(4, &["absent.h5"]);
    study.uplift(&["bootstrap", "absent.toml"]).fails(3, &["absent.toml"]);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["bootstrap", "r.h5", "--sizes", "20,20"]).fails(2, &["20", "once"]);
    study.uplift(&["bootstrap", "r.h5", "--sizes", "0"]).fails(2, &["0"]);
    study.uplift(&["bootstrap", "r.h5", "--set", "bootstrap.replicates=9"]).fails(2, &["--set changes a study"]);
    study.write("bad.csv", "site,size\nHere,20\n");
    study.uplift(&["bootstrap", "r.h5", "--reference", "bad.csv"]).fails(4, &["bad.csv", "sample_size"]);
    study.uplift(&["influence", "r.h5", "--poe", "0.3"]).fails(2, &["no probability 0.3: it has", "0.02"]);
    let bad = [
        "bootstrap.sizes=[20, 20]",
        "bootstrap.replicates=0",
        "bootstrap.confidence=90",
        "bootstrap.interval=\"normal\"",
    ];
    let arguments: Vec<&str> =
        ["check", "study.toml"].into_iter().chain(bad.iter().flat_map(|key| ["--set", key])).collect();
    study.uplift(&arguments).fails(3, &["given twice", "replicates", "90 % is 0.9", "percentile"]);
}

// The ordinates without a record are those of a set without it, run anew; the shares of the risk add up.
#[test]
fn influence_is_that_of_a_set_without_the_record() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "all.h5", "-q"]).ok();
    study.uplift(&["run", "study.toml", "-o", "three.h5", "-q", "--set", "records.first=3"]).ok();
    let said = study.uplift(&["influence", "all.h5", "--json"]).json();
    assert!(!said["records"].as_array().unwrap().is_empty() && !said["intensities"].as_array().unwrap().is_empty());
    let without = array(&study.path().join("all.h5"), "/influence/pgv/u_without_m");
    let three = array(&study.path().join("three.h5"), "/urs/pgv/u_m");
    let (records, strengths) = (4, 10);
    for (row, spectrum) in three.chunks_exact(strengths).enumerate() {
        let start = (row * records + 3) * strengths;
        assert!(same_bits(&without[start..start + strengths], spectrum), "row {row}");
    }
    let shares = array(&study.path().join("all.h5"), "/disaggregation/pgv/share");
    let mut whole = 0;
    for ordinate in shares.chunks_exact(6).filter(|shares| shares[0].is_finite()) {
        assert!((ordinate.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{ordinate:?}");
        whole += 1;
    }
    assert!(whole > 20);
    let text = study.uplift(&["influence", "all.h5"]).ok().stdout;
    assert!(
        text.starts_with("Change of the displacement if the most influential record is left out")
            && text.contains("SYN")
            // where structures are, and not only where the change is largest
            && text.contains("average  at 0.200")
            && text.contains("all.influence.csv"),
        "{text}"
    );
}

#[test]
fn measures_are_compared() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let text = study.uplift(&["measures", "r.h5"]).ok().stdout;
    // PGV or PGA, that its records miss the site's hazard, and what to type
    let mut lines = text.lines();
    let first = lines.next().unwrap();
    assert!(first.contains("), but its records miss the site's hazard: "), "{text}");
    // all by the numbers of the table: measure, scatter of the displacement and of initiation
    let mut told: Vec<(f64, f64, &str)> = Vec::new();
    for (name, numbers) in text.lines().filter_map(|line| line.split_once("  ")) {
        let numbers: Vec<f64> = numbers.split_whitespace().map_while(|word| word.parse().ok()).collect();
        told.extend((numbers.len() == 2).then(|| (numbers[0], numbers[1], name)));
    }
    assert_eq!(told.len(), 10, "{text}");
    let of = |name: &str| told.iter().find(|(.., own)| *own == name).unwrap().0;
    let order = if first.starts_with("PGV") { ["PGV", "PGA"] } else { ["PGA", "PGV"] };
    let [less, more] = order.map(of);
    let words = format!("{} scatters less than {} ({less:.2}, {more:.2}", order[0], order[1]);
    let rest = first.strip_prefix(&words).unwrap_or_else(|| panic!("{text}"));
    // on average: where it does not is said
    let exceptions = rest.split_once("), but ").unwrap().0;
    assert!(less <= more && (exceptions.is_empty() || exceptions.starts_with("; not at strength ")), "{text}");
    let least = text.lines().find(|line| line.starts_with("Least scatter of all 10: ")).unwrap();
    let [level, initiation] = [|row: &(f64, f64, &str)| row.0, |row: &(f64, f64, &str)| row.1].map(|of| {
        let least = told.iter().map(of).fold(f64::INFINITY, f64::min);
        told.iter().filter(|row| of(row) == least).map(|row| format!("{} ({least:.2})", row.2)).collect::<Vec<_>>()
    });
    for (what, names) in [("displacement", level), ("initiation", initiation)] {
        assert!(names.iter().any(|name| least.contains(&format!("{what} {name}"))), "{names:?}: {text}");
    }
    assert_eq!(lines.next(), Some("Repair: uplift consistency r.h5 --repair"), "{text}");
    // marks are explained before they are used
    assert!(text.find("\n+ has no hazard curve").unwrap() < text.find("Least scatter").unwrap(), "{text}");
    assert!(text.contains("\nSA(1.0) +"), "{text}");
    assert!(!text.contains("Efficiency:"), "{text}");
    let details = study.uplift(&["measures", "r.h5", "--details"]).ok().stdout;
    for word in ["Efficiency: ", "Sufficiency: ", "SA(1.0) +", "magnitude\n", "ln_duration\n"] {
        assert!(details.contains(word), "{word}:\n{details}");
    }
    let rows = rows(&study.uplift(&["measures", "r.h5", "--json"]).ok().stdout);
    // ten measures, ten strengths
    assert_eq!(rows.len(), 100);
    // each strength has each place once
    for strength in 0..10 {
        let mut places: Vec<u64> =
            rows.iter().skip(strength).step_by(10).filter_map(|row| row["rank"].as_u64()).collect();
        places.sort_unstable();
        assert!(places.is_empty() || places == (1..=10).collect::<Vec<u64>>(), "{places:?}");
    }
    for row in &rows {
        for trend in row["trends"].as_object().unwrap().values() {
            if let Some(p_value) = trend["p_value"].as_f64() {
                assert!((0.0..=1.0).contains(&p_value), "{row}");
            }
        }
    }
    let dispersion = array(&study.path().join("r.h5"), "/efficiency/pgv/ln_deviation");
    // from the demands themselves: strength 0.3 (index 4), level 30 cm/s (index 3)
    let edp = array(&study.path().join("r.h5"), "/ida/pgv/edp_m");
    let logarithms: Vec<f64> = (0..4).map(|record| edp[(record * 10 + 4) * 5 + 3].ln()).collect();
    let mean = logarithms.iter().sum::<f64>() / 4.0;
    let expected = (logarithms.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 3.0).sqrt();
    assert!((dispersion[4 * 5 + 3] - expected).abs() < 1e-12);
}

/// The trends of Table 4.1 with real records, on every tenth strength: bands shrink about as one over the root of the
/// sample size, those of PGA are wider than those of PGV where structures rock, and narrower where they begin to.
///
/// The dissertation prints neither its records nor its hazard; so no digit of the table is held, and the figures are
/// printed.
#[test]
#[ignore = "long: make test-long"]
fn trends_of_table_4_1_appear_with_real_records() {
    let Some(records) = real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml");
    let manifest = format!("records.manifest={}", records.join("manifest.csv").display());
    let set = ["--set", &manifest, "--set", "records.tag=ord105", "--set", "strengths.values=0:1/30:1"];
    let run = ["run", study.to_str().unwrap(), "-o", "t.h5", "-q", "--set", "risk.maf_surface=false"];
    common::uplift(folder.path(), &[&run[..], &set[..]].concat()).ok();
    let reference = repository().join("tests/reference/table_4_1.csv");
    let report = |more: &[&str]| {
        let arguments = [&["bootstrap", "t.h5", "--reference", reference.to_str().unwrap()], more].concat();
        common::uplift(folder.path(), &arguments).ok().stdout
    };
    let text = report(&[]);
    println!("{text}");
    assert!(
        text.split_whitespace().collect::<Vec<_>>().join(" ").contains("| 3.9 63")
            && text.contains("\nWidest for its ordinate: ")
            && !text.contains("Rocking initiation"),
        "the reference stands beside ours"
    );
    let rows = rows(&report(&["--json"]));
    // relative widths of the 2 % bands, on average over sites and the strengths above 0.05 that rock: [measure][size]
    let result = folder.path().join("t.h5");
    let strengths = LabelledReader::open(&result).unwrap().axis::<f64>("strength").unwrap();
    let widths = ["pgv", "pga"].map(|im| {
        let [lower, median, upper] = BANDS.map(|name| array(&result, &format!("/bootstrap/{im}/{name}")));
        [0, 1, 2, 3, 4].map(|size| {
            let (mut sum, mut count) = (0.0, 0);
            for site in 0..6 {
                for (index, &strength) in strengths.iter().enumerate() {
                    let at = (site * 3 * 5 + size) * strengths.len() + index;
                    if strength > 0.05 && lower[at] > 0.0005 {
                        sum += (upper[at] - lower[at]) / median[at];
                        count += 1;
                    }
                }
            }
            sum / f64::from(count)
        })
    });
    println!("relative widths by size: PGV {:.2?}, PGA {:.2?}", widths[0], widths[1]);
    for [twenty, _, _, eighty, _] in widths {
        // √(80/20) = 2
        assert!((1.6..2.6).contains(&(twenty / eighty)), "{widths:.2?}");
    }
    // Eq. 4.10 takes the widest place, where displacements are large: there PGA is the worse measure at every size
    for size in [20, 40, 60, 80, 105] {
        let mean = |im: &str| {
            let chosen = rows.iter().filter(|row| row["im"] == im && row["poe"] == 0.02 && row["sample_size"] == size);
            let ranges: Vec<f64> = chosen.map(|row| row["r_90ci"].as_f64().unwrap()).collect();
            assert_eq!(ranges.len(), 6);
            ranges.iter().sum::<f64>() / 6.0
        };
        let wider = mean("PGA") / mean("PGV");
        assert!(wider > 1.5, "{size}: {wider}");
    }
    // widths at initiation: the last column of the last table, PGV and PGA in turn
    let details = report(&["--details"]);
    let table = &details[details.find("Rocking initiation").unwrap()..];
    let widths: Vec<f64> = table
        .lines()
        .filter(|line| line.contains("PGV") || line.contains("PGA"))
        .filter_map(|line| line.split_whitespace().next_back()?.parse().ok())
        .collect();
    let (pgv, pga): (Vec<f64>, Vec<f64>) = widths.chunks_exact(2).map(|pair| (pair[0], pair[1])).unzip();
    assert!(pgv.len() >= 4 && pga.iter().sum::<f64>() < pgv.iter().sum(), "{pgv:?} {pga:?}");
}
