//! Pairs seen from azimuths, and records with a third component.

use std::path::Path;

use serde_json::Value;

use crate::common::{SMALL_STUDY, SmallStudy, array, same_bits};

const ROTATED: [&str; 2] = ["--set", "records.component=rotated"];

/// The settings of `[records.rotation]` as options.
fn rotation(settings: &[&str]) -> Vec<String> {
    let set = |setting: &&str| ["--set".to_owned(), format!("records.rotation.{setting}")];
    ROTATED.map(str::to_owned).into_iter().chain(settings.iter().flat_map(set)).collect()
}

fn run(study: &SmallStudy, result: &str, more: &[String]) -> Vec<f64> {
    let more: Vec<&str> = more.iter().map(String::as_str).collect();
    study.uplift(&[&["run", "study.toml", "-o", result, "-q"], &more[..]].concat()).ok();
    peaks(&study.path().join(result))
}

fn component(which: &str) -> Vec<String> {
    vec!["--set".to_owned(), format!("records.component={which}")]
}

fn peaks(result: &Path) -> Vec<f64> {
    array(result, "/ida/pgv/edp_m")
}

/// Records x strengths x levels of the small study: 4 pairs, 10 strengths, 5 levels of PGV.
const CELLS: usize = 10 * 5;

#[test]
fn azimuths_of_quarter_turns_are_the_components() {
    let study = SmallStudy::new();
    let both = run(&study, "both.h5", &component("both"));
    let each = run(&study, "each.h5", &rotation(&["take=each", "azimuths=2"]));
    assert!(same_bits(&both, &each));
    let first = run(&study, "h1.h5", &component("h1"));
    assert!(same_bits(&first, &run(&study, "one.h5", &rotation(&["take=percentile", "azimuths=1", "percentile=50"]))));
    for name in ["/urs/pgv/u_m", "/urs/pga/u_m"] {
        let of = |result: &str| array(&study.path().join(result), name);
        assert!(same_bits(&of("both.h5"), &of("each.h5")) && same_bits(&of("h1.h5"), &of("one.h5")));
    }
}

/// What none of four pairs shows is not known better for having looked at each twice.
#[test]
#[ignore = "long: make test-long"]
fn the_bound_of_what_no_run_shows_counts_pairs() {
    let study = SmallStudy::new();
    let broad = "kind = \"block\"\nwidth_m = 40\nheight_m = 41\nmass_kg = 1000\nuplift_displacement_m = 0.001\n";
    study.write("broad.toml", broad);
    let of = |name: &str, more: &[String]| -> (Value, String) {
        run(&study, name, more);
        let told = study.uplift(&["overturning", "broad.toml", "--urs", name, "--json", "-q"]).ok().stdout;
        let told: Value = serde_json::from_str(&told).unwrap();
        let bound = told["overturning"][0]["sites"][0]["at_most_per_year"].clone();
        let alarms = told["alarms"].as_array().unwrap();
        let few = alarms.iter().find(|alarm| alarm["kind"] == "few-records").unwrap();
        (bound, few["what"].as_str().unwrap().to_owned())
    };
    let (one, few) = of("one.h5", &component("h1"));
    assert!(one.as_f64().is_some_and(|bound| bound > 0.0) && few.starts_with("4 (40 advised)"), "{one} {few}");
    for (name, more, records) in
        [("both.h5", component("both"), 8), ("each.h5", rotation(&["take=each", "azimuths=3"]), 12)]
    {
        let (bound, few) = of(name, &more);
        assert_eq!(bound, one, "{name}");
        assert!(few.starts_with(&format!("4 pairs, {records} records (40 advised)")), "{few}");
    }
}

/// The percentile is taken of the peaks under each azimuth; the worst is at least every one.
#[test]
fn a_percentile_ranks_the_peaks_of_all_azimuths() {
    let study = SmallStudy::with(&SMALL_STUDY.replace("[strengths]", "[oscillator]\ncapacity_m = 0.1\n[strengths]"));
    let each = run(&study, "each.h5", &rotation(&["take=each", "azimuths=5"]));
    assert_eq!(each.len(), 4 * 5 * CELLS);
    let mut overturned = [0; 2];
    for (percentile, rank) in [(1, 0), (50, 2), (100, 4)] {
        let of = format!("percentile={percentile}");
        let found = run(&study, &format!("{percentile}.h5"), &rotation(&["take=percentile", "azimuths=5", &of]));
        for (pair, cells) in found.chunks(CELLS).enumerate() {
            for (cell, &peak) in cells.iter().enumerate() {
                let azimuth = |azimuth: usize| each[(5 * pair + azimuth) * CELLS + cell];
                let mut ranked: Vec<f64> = (0..5).map(azimuth).collect();
                ranked.sort_by(f64::total_cmp);
                assert_eq!(peak.to_bits(), ranked[rank].to_bits(), "{percentile} {pair} {cell}");
                overturned[usize::from(peak.is_infinite())] += 1;
            }
        }
    }
    assert!(overturned.iter().all(|count| *count > 50), "{overturned:?}");
}

/// Threads, shards and what an earlier result knows change no bit; another percentile is known to be another.
#[test]
fn percentiles_go_on_and_are_shared_like_any_other_study() {
    let study = SmallStudy::new();
    let settings = rotation(&["take=percentile", "azimuths=3", "percentile=60"]);
    let options: Vec<&str> = settings.iter().map(String::as_str).collect();
    let whole = run(&study, "r.h5", &[&settings[..], &["--threads".to_owned(), "1".to_owned()]].concat());
    for (shard, part) in [("1/2", "one"), ("2/2", "two")] {
        let ask = ["run", "study.toml", "-o", part, "-q", "--threads", "2", "--shard", shard];
        study.uplift(&[&ask[..], &options].concat()).ok();
    }
    study.uplift(&[&["merge", "study.toml", "one", "two", "-o", "s.h5", "-q"], &options[..]].concat()).ok();
    assert!(same_bits(&whole, &peaks(&study.path().join("s.h5"))));
    let summary = |percentile: &str| -> Value {
        let more = ["--set", percentile, "--json", "--force"];
        let done = study.uplift(&[&["run", "study.toml", "-o", "r.h5", "-q"], &options[..], &more].concat()).ok();
        serde_json::from_str(&done.stdout).unwrap()
    };
    let of_pgv = |summary: &Value, key: &str| summary["measures"][0][key].as_u64().unwrap();
    let again = summary("title=another");
    assert_eq!((of_pgv(&again, "analyses_computed"), of_pgv(&again, "analyses")), (0, 4 * 3 * 50));
    let other = summary("records.rotation.percentile=100");
    assert_eq!(of_pgv(&other, "analyses_computed"), 4 * 3 * 50);
    let check = study.uplift(&[&["check", "study.toml", "--json"], &options[..]].concat()).ok();
    let check: Value = serde_json::from_str(&check.stdout).unwrap();
    assert_eq!(check["analyses"], 3 * 4 * 10 * 9);
    assert!(check["record_set"].as_str().unwrap().ends_with("component rotated (percentile 60 of 3 azimuths)"));
}

/// A drawn azimuth depends on the seed and the pair alone, and is reported.
#[test]
fn a_random_azimuth_follows_from_seed_and_pair() {
    let study = SmallStudy::new();
    let all = run(&study, "all.h5", &rotation(&[]));
    let azimuths = |result: &str| {
        let reader = uplift_labelled::LabelledReader::open(&study.path().join(result)).unwrap();
        reader.array::<String>("/records/component").unwrap().values
    };
    let few = run(&study, "few.h5", &[rotation(&[]), vec!["--set".into(), "records.first=2".into()]].concat());
    assert!(same_bits(&all[..2 * CELLS], &few));
    assert_eq!(azimuths("all.h5")[..2], azimuths("few.h5"));
    for told in azimuths("all.h5") {
        let degrees: f64 = told.strip_suffix("deg").unwrap().parse().unwrap();
        assert!((0.0..180.0).contains(&degrees) && (100.0 * degrees).fract().abs() < 1e-6, "{told}");
    }
    run(&study, "other.h5", &[rotation(&[]), vec!["--set".into(), "seed=2".into()]].concat());
    assert_ne!(azimuths("all.h5"), azimuths("other.h5"));
}

/// What is drawn of azimuths are pairs, whatever is asked; so the bands are those of pairs of components.
#[test]
#[ignore = "long: make test-long"]
fn azimuths_of_a_pair_are_resampled_together() {
    let study = SmallStudy::with(&SMALL_STUDY.replace("first = 4", "first = 6").replace("pairs = 4", "pairs = 6"));
    let ask = ["--sizes", "12", "--replicates", "40", "-q"];
    run(&study, "each.h5", &rotation(&["take=each", "azimuths=2"]));
    study.uplift(&[&["bootstrap", "each.h5", "--unit", "record"], &ask[..]].concat()).ok();
    run(&study, "both.h5", &component("both"));
    study.uplift(&[&["bootstrap", "both.h5", "--unit", "pair"], &ask[..]].concat()).ok();
    let of = |result: &str, name: &str| array(&study.path().join(result), name);
    for name in ["/bootstrap/pgv/u05_m", "/bootstrap/pgv/u50_m", "/bootstrap/pgv/u95_m"] {
        assert!(same_bits(&of("each.h5", name), &of("both.h5", name)), "{name}");
    }
    let counts = {
        let reader = uplift_labelled::LabelledReader::open(&study.path().join("each.h5")).unwrap();
        reader.array::<u32>("/bootstrap/multiplicity").unwrap().values
    };
    assert!(counts.chunks(2).all(|pair| pair[0] == pair[1]) && counts.iter().any(|count| *count > 1));
    // and left out: without the last pair the spectrum is that of a study without it
    let json = study.uplift(&["influence", "each.h5", "--json", "-q"]).ok().stdout;
    assert!(json.contains("\"record\": \"SYN00") && !json.contains("deg"), "{json}");
    let without = of("each.h5", "/influence/pgv/u_without_m");
    let fewer = rotation(&["take=each", "azimuths=2"]);
    run(&study, "fewer.h5", &[fewer, vec!["--set".into(), "records.first=5".into()]].concat());
    for (place, ordinates) in of("fewer.h5", "/urs/pgv/u_m").chunks(10).enumerate() {
        for record in [10, 11] {
            assert!(same_bits(&without[(place * 12 + record) * 10..][..10], ordinates), "{place} {record}");
        }
    }
    let ask = ["bootstrap", "each.h5", "--unit", "record", "--sizes", "12", "--replicates", "40"];
    let told = study.uplift(&ask).ok().stderr;
    assert!(told.contains("with their pairs, "), "{told}");
}

/// Records that are not synchronised are not added; components of other time steps neither.
#[test]
fn components_that_do_not_belong_together_are_not_turned() {
    let records = "manifest = \"m.csv\"\nduplicates = \"keep\"";
    let study = SmallStudy::with(&SMALL_STUDY.replace("first = 4\n[records.synthetic]\npairs = 4", records));
    let motion = |dt: &str| {
        let samples: Vec<String> = (0..400).map(|sample| format!("{:.3}", (f64::from(sample) * 0.1).sin())).collect();
        format!("# dt = {dt} s\n# acc (m/s2)\n{}\n", samples.join("\n"))
    };
    study.write("a.txt", &motion("0.01"));
    study.write("b.txt", &motion("0.02"));
    study.write("m.csv", "record_id,file_h1,file_h2\nONE,a.txt,b.txt\nTWO,b.txt,a.txt\nTHREE,a.txt,a.txt\n");
    let settings = rotation(&[]);
    let ask: Vec<&str> = ["check", "study.toml"].into_iter().chain(settings.iter().map(String::as_str)).collect();
    study.uplift(&ask).fails(4, &["record ONE", "record TWO", "0.01 s", "records.component = \"h1\""]);
    study.uplift(&["check", "study.toml"]).ok();
}

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n";
const FRAME: &str = "kind = \"frame\"\ncolumns = 3\nwidth_m = 1\nheight_m = 8\ncolumn_mass_kg = 15e3\n\
                     deck_mass_kg = 400e3\ncolumn_shape = \"cylinder\"\nrestitution = 0.9\n";

/// Three synthetic pairs as files, the second component of the next as the third of each.
fn with_third_components() -> SmallStudy {
    let text = SMALL_STUDY
        .replace("first = 4\n[records.synthetic]\npairs = 4", "manifest = \"with.csv\"\nvertical = true")
        .replace("levels_cm_s = [1, 3, 10, 30, 100]", "levels_cm_s = [1, 3, 10, 20, 35]")
        .replace("levels_g = [0.02, 0.1, 0.3, 1.0]", "levels_g = [0.02, 0.1, 0.2, 0.3]");
    let study = SmallStudy::with(&text);
    study.uplift(&["records", "synthesize", "-o", "d", "--count", "3", "-q"]).ok();
    study.uplift(&["records", "import", "d", "-o", "m.csv", "-q"]).ok();
    let manifest = std::fs::read_to_string(study.path().join("m.csv")).unwrap();
    let rows = manifest.lines().filter(|line| !line.starts_with('#')).enumerate().map(|(place, row)| match place {
        0 => format!("{row},file_v\n"),
        place => format!("{row},d/SYN00{}_H2.AT2\n", place % 3 + 1),
    });
    study.write("with.csv", &rows.collect::<String>());
    study.write("block.toml", BLOCK);
    study.write("frame.toml", FRAME);
    study
}

fn json(study: &SmallStudy, ask: &[&str]) -> Value {
    study.uplift(&[ask, &["--json", "-q"]].concat()).json()
}

/// Stripes of the frame are single runs with the third component, scaled as the pair.
#[test]
#[ignore = "long: make test-long"]
fn the_third_component_shakes_frames_with_the_factor_of_the_pair() {
    let study = with_third_components();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let plain = run(&study, "plain.h5", &["--set".into(), "records.vertical=false".into()]);
    assert!(same_bits(&plain, &peaks(&study.path().join("r.h5"))), "oscillators felt it");
    let ask = ["risk", "frame.toml", "--site", "Here", "--urs"];
    json(&study, &[&ask[..], &["r.h5", "-o", "peaks.csv"]].concat());
    json(&study, &[&ask[..], &["plain.h5", "-o", "plain.csv"]].concat());
    let rows = |name: &str| -> Vec<Vec<String>> {
        let text = std::fs::read_to_string(study.path().join(name)).unwrap();
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let (shaken, plain) = (rows("peaks.csv"), rows("plain.csv"));
    let column = |name: &str| shaken[0].iter().position(|cell| cell == name).unwrap();
    let pgv_cm_s = array(&study.path().join("r.h5"), "/records/pgv_cm_s");
    let mut differing = 0;
    for (index, row) in shaken[1..].iter().enumerate() {
        let (record, number) = (index / 5, |name: &str| row[column(name)].parse::<f64>().unwrap());
        let scale = (number("level") / pgv_cm_s[record]).to_string();
        let files = [1, 2].map(|which| format!("d/SYN00{}_H{which}.AT2", record + 1));
        let vertical = format!("d/SYN00{}_H2.AT2", (record + 1) % 3 + 1);
        let under = |more: &[&str]| -> f64 {
            let ask = ["response", "--structure", "frame.toml", "--scale", &scale, "--v", &vertical, "--h1", &files[0]];
            let run = json(&study, &[&ask[..], more].concat());
            run["runs"][0]["peak_displacement_m"].as_f64().unwrap_or(f64::INFINITY)
        };
        assert_eq!(under(&["--h2", &files[1]]), number("wobbling_frame_m"), "{index}");
        assert_eq!(under(&["--model", "planar"]), number("planar_frame_m"), "{index}");
        differing += usize::from(row[column("wobbling_frame_m")] != plain[index + 1][column("wobbling_frame_m")]);
    }
    assert!(differing > 3, "{differing}");
    // blocks feel it too
    let overturning = |result: &str| json(&study, &["overturning", "block.toml", "--urs", result]);
    let noted = overturning("r.h5")["record_set"].to_string();
    assert!(noted.contains("with the vertical one"), "{noted}");
}

/// Every record without a third component is named before anything is computed, and levels at which the ground falls as
/// fast as gravity are refused.
#[test]
fn what_has_no_third_component_is_named_at_once() {
    let study = with_third_components();
    let manifest = ["--set", "records.manifest=m.csv"];
    study
        .uplift(&[&["check", "study.toml"][..], &manifest].concat())
        .fails(4, &["3 of 3 records have no third component", "SYN001, SYN002, SYN003", "file_v"]);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--set", "pgv.levels_cm_s=[1, 300]"]).ok();
    let ask = ["risk", "frame.toml", "--urs", "r.h5", "--site", "Here"];
    study.uplift(&ask).fails(4, &["3 records have a vertical acceleration", "leave the ground", "SYN003"]);
    // a design, and how often it overturns, are those of the proxy then
    let told = "the ground falls as fast as gravity under 3 records";
    for structure in ["frame.toml", "block.toml"] {
        let ask = ["design", structure, "--urs", "r.h5", "--site", "Here"];
        let design = json(&study, &ask);
        assert!(design["own"].is_null() && design["exact"]["overturning"]["per_year"].is_number(), "{design}");
        assert!(design["without_own"].as_str().unwrap().contains(told), "{design}");
        let said = study.uplift(&ask).ok().stdout;
        assert!(
            said.contains("Itself    not analysed: ") && said.contains(told) && said.contains("its oscillator alone"),
            "{said}"
        );
    }
    let rates = json(&study, &["overturning", "frame.toml", "--urs", "r.h5"]);
    let models: Vec<&str> =
        rates["models"].as_array().unwrap().iter().map(|of| of["model"].as_str().unwrap()).collect();
    assert_eq!(models, ["oscillator"]);
    assert!(rates["without_own"].as_str().unwrap().contains(told), "{rates}");
    let rates = json(&study, &["overturning", "block.toml", "--urs", "r.h5"]);
    assert!(rates["without_own"].as_str().unwrap().contains(told) && rates["by_proxy"] == true, "{rates}");
    let said = study.uplift(&["overturning", "block.toml", "--urs", "r.h5", "-q"]).ok().stdout;
    assert!(said.contains(": its oscillator alone ") && said.contains("\nItself    not analysed: "), "{said}");
    let alone = json(&study, &["design", "frame.toml", "--urs", "r.h5", "--site", "Here", "--proxy"]);
    assert!(alone["without_own"].is_null(), "{alone}");
}

/// Blocks of a study of displacement spectra: without motion the third component changes nothing but rounding, and with
/// it the peaks.
#[test]
fn blocks_of_a_displacement_study_feel_the_third_component() {
    let study = with_third_components();
    study.write(
        "blocks.toml",
        "kind = \"displacement spectra\"\n[records]\nmanifest = \"with.csv\"\n[scaling]\nto = [\"0.7 PGA\"]\n[block]\n\
         height_m = [4]\n[slenderness]\nvalues = [0.1, 0.15]\n",
    );
    let manifest = std::fs::read_to_string(study.path().join("with.csv")).unwrap();
    let still: String = (0..10).map(|_| "0\n").collect();
    study.write("still.txt", &format!("# dt = 0.01 s\n# acc (g)\n{still}"));
    let quiet: Vec<String> = (manifest.lines())
        .map(|row| {
            row.rsplit_once(',').map_or(String::new(), |(rest, last)| {
                let last = if last == "file_v" { last } else { "still.txt" };
                format!("{},{last}\n", rest.replace(",at2,", ",,"))
            })
        })
        .collect();
    study.write("still.csv", &quiet.concat());
    let of = |result: &str, more: &[&str]| -> Vec<f64> {
        study.uplift(&[&["run", "blocks.toml", "-o", result, "-q"], more].concat()).ok();
        array(&study.path().join(result), "/sets/all records/u_m")
    };
    let plain = of("plain.h5", &[]);
    let vertical = ["--set", "records.vertical=true"];
    let still = of("still.h5", &[&vertical[..], &["--set", "records.manifest=still.csv"]].concat());
    let shaken = of("shaken.h5", &vertical);
    let near = |a: &f64, b: &f64| a == b || (a - b).abs() <= 1e-6 * b.abs();
    assert!(plain.iter().zip(&still).all(|(plain, still)| near(still, plain)), "{plain:?} {still:?}");
    let changed = plain.iter().zip(&shaken).filter(|(plain, shaken)| !near(shaken, plain)).count();
    assert!(changed > 2 && plain.iter().any(|peak| *peak > 0.0), "{plain:?} {shaken:?}");
}
