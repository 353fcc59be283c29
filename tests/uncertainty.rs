//! `uplift overturning` and `uplift design` of a structure that is not known exactly.

use serde_json::{Value, json};

use crate::common::SmallStudy;
use crate::overturning::steps;

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\nrestitution = 0.95\n";
const KINDS: [&str; 2] = ["epistemic", "aleatory"];

/// Few structures of either kind.
fn few(kind: &str) -> &'static str {
    if kind == "epistemic" { "samples = 8\n" } else { "draws = 3\n" }
}

fn asked(study: &SmallStudy, job: &str, uncertainty: &str, more: &[&str]) -> Value {
    study.write("block.toml", &format!("{BLOCK}{uncertainty}"));
    let run = study.uplift(&[&[job, "block.toml", "--urs", "r.h5", "--json", "-q"], more].concat()).ok();
    serde_json::from_str(&run.stdout).unwrap()
}

fn read(study: &SmallStudy, name: &str) -> String {
    std::fs::read_to_string(study.path().join(name)).unwrap()
}

/// Strength and capacity that scatter together, and a restitution.
fn scattering(kind: &str, more: &str, variation: f64) -> String {
    let quantity = |key: &str| {
        format!("[uncertainty.{key}]\ndistribution = \"lognormal\"\ncoefficient_of_variation = {variation}\n")
    };
    format!(
        "[uncertainty]\nkind = \"{kind}\"\n{more}{}{}[uncertainty.restitution]\ndistribution = \"normal\"\n\
         coefficient_of_variation = {variation}\n[[uncertainty.correlation]]\n\
         between = [\"strength\", \"capacity_m\"]\ncoefficient = 0.8\n",
        quantity("strength"),
        quantity("capacity_m")
    )
}

const STUDY: &str = "title = \"uncertain\"\n[records.synthetic]\npairs = 6\n[strengths]\nvalues = [0.05, 0.1, 0.2]\n\
    [pga]\nlevels_g = [0.05, 0.1, 0.2, 0.4, 0.8, 1.6]\n[[sites]]\nname = \"Here\"\npga = \"pga.csv\"\n";

fn study() -> SmallStudy {
    let study = SmallStudy::with(STUDY);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

// A constant acceleration overturns what it lifts, and what it does not lift stands. So of two of three records a share
// P of the structures, those weaker than 0.3 g, overturns from that level on and the rest from 0.8 g on: a mixture over
// the stripes of both. A uniform oscillator's strength of 0.15 to 0.45 has P = 1/2, and with what the elastic motion
// before uplift adds, of a few per cent of 0.3 g, up to 0.53.
#[test]
fn a_mixture_known_by_hand() {
    let study = steps();
    let rate = |level: f64| 1e-4 * level.powf(-2.2);
    let mixture = |share: f64| {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let all = mean(0.0, share) * (rate(0.12) - rate(0.3)) + mean(share, 1.0) * (rate(0.3) - rate(0.8)) + rate(0.8);
        2.0 / 3.0 * all
    };
    for (kind, least, most) in [("epistemic", 0.48, 0.55), ("aleatory", 0.44, 0.59)] {
        // the block's strength is 3/2 of its oscillator's
        let uniform = format!(
            "[uncertainty]\nkind = \"{kind}\"\n{}[uncertainty.strength]\ndistribution = \"uniform\"\n\
             lower = 0.225\nupper = 0.675\n",
            if kind == "aleatory" { "draws = 50\n" } else { "" }
        );
        let found = asked(&study, "overturning", &uniform, &[]);
        let of_oscillator = &found["overturning"][0]["sites"][0]["per_year"];
        let [result] = &found["uncertainty"]["results"].as_array().unwrap()[..] else { panic!("{found}") };
        assert_eq!(result["as_described"], *of_oscillator);
        let value = match kind {
            "epistemic" => &result["epistemic"]["by_structure"]["mean"],
            _ => &result["aleatory"]["value"],
        };
        let value = value.as_f64().unwrap();
        assert!(
            mixture(least) < value && value < mixture(most),
            "{kind}: {value} {} {}",
            mixture(least),
            mixture(most)
        );
    }
}

/// Nothing else in a report changes; without scatter nothing at all.
#[test]
#[ignore = "long: make test-long"]
fn certain_properties_keep_their_numbers() {
    let study = study();
    for job in ["overturning", "design"] {
        let known = asked(&study, job, "", &[]);
        assert!(known.get("uncertainty").is_none());
        for kind in KINDS {
            let mut found = asked(&study, job, &scattering(kind, few(kind), 0.0), &[]);
            let uncertainty = found.as_object_mut().unwrap().remove("uncertainty").unwrap();
            assert_eq!(found, known, "{job} {kind}");
            let results = uncertainty["results"].as_array().unwrap();
            assert_eq!(results.len(), if job == "design" { 3 } else { 1 });
            for result in results {
                let expected = &result["as_described"];
                let values = match kind {
                    "epistemic" => {
                        let of = &result["epistemic"]["by_structure"];
                        vec![&of["mean"], &of["percentiles"][0], &of["percentiles"][4]]
                    }
                    _ => vec![&result["aleatory"]["value"]],
                };
                assert!(values.iter().all(|value| *value == expected), "{job} {kind}: {result}");
            }
        }
    }
}

/// Shards, threads and a checkpoint that was cut off: the answer is that of an undisturbed run.
#[test]
#[ignore = "long: make test-long"]
fn the_same_bits_however_it_is_computed() {
    let study = study();
    for (job, kind) in [("overturning", "epistemic"), ("overturning", "aleatory"), ("design", "epistemic")] {
        let text = scattering(kind, few(kind), 0.05);
        let whole = asked(&study, job, &text, &["--threads", "1"]);
        let shard = |of: &str| study.uplift(&[job, "block.toml", "--urs", "r.h5", "--shard", of, "-q"]).ok();
        let files = ["1/2", "2/2"].map(|of| {
            shard(of);
            format!("r.h5.{job}-block.shard-{}", of.replace('/', "-of-"))
        });
        let joined = asked(&study, job, &text, &["--shards", &files[0], &files[1]]);
        assert_eq!(joined, whole, "{job} {kind}");
        shard("1/1");
        let rows = std::fs::read(study.path().join(format!("r.h5.{job}-block.shard-1-of-1"))).unwrap();
        study.write_bytes(&format!("r.h5.{job}-block.part"), &rows[..2 * rows.len() / 3]);
        assert_eq!(asked(&study, job, &text, &["--threads", "3"]), whole, "{job} {kind}");
        // the next kind has the same name, and other work
        for of in ["1-of-2", "2-of-2", "1-of-1"] {
            std::fs::remove_file(study.path().join(format!("r.h5.{job}-block.shard-{of}"))).unwrap();
        }
        let structures = &whole["uncertainty"]["structures"];
        // both samples, and the first with strength and capacity or with the restitution of the second
        assert_eq!(*structures, if kind == "epistemic" { json!(8 * 4) } else { json!(6 * 3) }, "{job} {kind}");
    }
}

/// The least value of a quantity of `file` with which it overturns as seldom as that.
fn least(study: &SmallStudy, file: &str, text: &str, more: &[&str]) -> Value {
    study.write(file, text);
    let run = study.uplift(&[&["target", file, "--urs", "r.h5", "--json", "-q"], more].concat()).ok();
    serde_json::from_str(&run.stdout).unwrap()
}

// A strength of v stands for 0.8 v to 1.2 v, of which those below 0.3 g overturn from that level on, as above: half of
// them where v is 0.3. A branch of f v by itself needs a v of 0.3/f, so 90 % of them 0.3/1.18 to 0.3/0.82.
#[test]
#[ignore = "long: make test-long"]
fn a_target_known_by_hand() {
    let study = steps();
    let rate = |level: f64| 1e-4 * f64::powf(level, -2.2);
    let half = 0.25 * (rate(0.12) - rate(0.3)) + 0.75 * (rate(0.3) - rate(0.8)) + rate(0.8);
    let target = format!("{}", 2.0 / 3.0 * half);
    let mast = "kind = \"point-mass\"\nwidth_m = 1\ncentre_height_m = 2.5\nmass_kg = 1\nuplift_displacement_m = 1e-4\n";
    let ask = ["--vary", "strength", "--overturning", &target, "--from", "0.2", "--to", "0.5", "--tolerance", "0.01"];
    for (kind, size, tolerance) in [("epistemic", "samples = 16", 0.01), ("aleatory", "draws = 50", 0.02)] {
        let text = format!(
            "{mast}[uncertainty]\nkind = \"{kind}\"\n{size}\n[uncertainty.strength]\ndistribution = \"uniform\"\n\
             lower = 0.16\nupper = 0.24\n"
        );
        let found = least(&study, "mast.toml", &text, &ask);
        let value = found["value"].as_f64().unwrap();
        assert!((value / 0.3 - 1.0).abs() < tolerance, "{kind}: {value}");
        let band = &found["uncertainty"]["by_structure"];
        if kind == "aleatory" {
            assert!(band.is_null(), "{found}");
            continue;
        }
        assert_eq!(found["uncertainty"]["structures"], 32);
        for (place, expected) in [(0, 0.3 / 1.18), (1, 0.3), (2, 0.3 / 0.82)] {
            let limit = band[place].as_f64().unwrap();
            assert!((limit / expected - 1.0).abs() < 0.03, "{limit} {expected}");
        }
    }
}

#[test]
#[ignore = "long: make test-long"]
fn a_target_without_scatter_equals_that_of_a_certain_structure() {
    let study = study();
    let ask = ["--vary", "width", "--overturning", "2e-3", "--tolerance", "0.02"];
    // what is drawn is not kept
    let kept = |of: &mut Value| of.as_object_mut().unwrap().remove("kept").unwrap();
    let mut known = least(&study, "block.toml", BLOCK, &ask);
    assert!(known.get("uncertainty").is_none());
    assert_eq!(kept(&mut known), "uplift displacement 0.5 mm, restitution 0.95");
    // nor has what may be several structures the band of one value
    assert!(known.as_object_mut().unwrap().remove("safe_bands").is_some());
    for tried in known["tried"].as_array_mut().unwrap() {
        tried.as_object_mut().unwrap().remove("upper_per_year");
    }
    for kind in KINDS {
        let text = format!("{BLOCK}{}", scattering(kind, few(kind), 0.0));
        let mut found = least(&study, "block.toml", &text, &ask);
        assert_eq!(kept(&mut found), "uplift displacement 0.5 mm", "{kind}");
        let uncertainty = found.as_object_mut().unwrap().remove("uncertainty").unwrap();
        assert_eq!(found, known, "{kind}");
        assert_eq!((&uncertainty["structures"], &uncertainty["by_structure"]), (&json!(1), &Value::Null));
    }
}

/// Tendons of a certain stiffness leave a force that rises after uplift: there is no capacity then, and none scatters.
#[test]
#[ignore = "long: make test-long"]
fn a_capacity_scatters_where_there_is_one() {
    let study = study();
    let pier = "kind = \"restrained-frame\"\ncolumns = 4\nwidth_m = 0.6\nheight_m = 4\ncolumn_mass_kg = 48000\n\
                deck_mass_kg = 900000\ntendon_stiffness_n_m = 1.5e6\ntendon_anchorage = \"foundation\"\n\
                uplift_displacement_m = 0.0005\n";
    let ask = ["--vary", "tendon-stiffness", "--exceed", "0.2", "--per-year", "1e-3", "--from", "5e6", "--to", "3e7"];
    let known = least(&study, "pier.toml", pier, &ask);
    for variation in [0.0, 0.02] {
        let capacity = format!(
            "[uncertainty]\nsamples = 8\n[uncertainty.capacity_m]\ndistribution = \"lognormal\"\n\
             coefficient_of_variation = {variation}\n"
        );
        let found = least(&study, "pier.toml", &format!("{pier}{capacity}"), &ask);
        let last = |of: &Value| of["tried"].as_array().unwrap().last().unwrap().clone();
        assert_eq!(last(&found)["value"], json!(3e7));
        // what rises has no capacity, and its risk is that of the structure that is known
        assert_eq!(last(&found)["per_year"], last(&known)["per_year"], "{variation}");
        if variation == 0.0 {
            assert_eq!(found["value"], known["value"]);
        }
    }
}

/// Every value has the risk that `uplift overturning` tells of a structure with it.
#[test]
#[ignore = "long: make test-long"]
fn target_and_risk_are_inverses_of_uncertain_structures() {
    let study = study();
    for kind in KINDS {
        let text = scattering(kind, few(kind), 0.05);
        let ask = ["--vary", "width", "--overturning", "3e-4", "--tolerance", "0.02", "--from", "0.8", "--to", "3"];
        let found = least(&study, "block.toml", &format!("{BLOCK}{text}"), &ask);
        let risk_of = |width_m: &Value| {
            let width = format!("width_m = {width_m}");
            study.write("found.toml", &format!("{}{text}", BLOCK.replace("width_m = 0.8", &width)));
            let run = study.uplift(&["overturning", "found.toml", "--urs", "r.h5", "--json", "-q"]).ok();
            let told: Value = serde_json::from_str(&run.stdout).unwrap();
            let result = &told["uncertainty"]["results"][0];
            let mean = &result["epistemic"]["by_structure"]["mean"];
            mean.as_f64().or(result["aleatory"]["value"].as_f64()).unwrap()
        };
        // of the structure as described to the bit
        let own = &found["tried"][0];
        assert_eq!(own["value"], 0.8);
        assert_eq!(Some(risk_of(&own["value"])), own["per_year"].as_f64(), "{kind}");
        // of another but for the rounding of its means, on which a run may hang
        let per_year = found["risk"]["per_year"].as_f64().unwrap();
        assert!((risk_of(&found["value"]) / per_year - 1.0).abs() < 0.03, "{kind}: {per_year}");
        assert!(per_year <= 3e-4 && risk_of(&found["missed_at"]) > 0.97 * 3e-4, "{kind}");
    }
}

#[test]
fn it_is_reported_in_sentences_and_refused_in_words() {
    let study = study();
    study.write("block.toml", &format!("{BLOCK}{}", scattering("epistemic", "samples = 16\n", 0.05)));
    let run = study.uplift(&["overturning", "block.toml", "--urs", "r.h5", "-q", "--details"]).ok();
    let answer = study.uplift(&["overturning", "block.toml", "--urs", "r.h5", "-q"]).ok().stdout;
    let found = study.uplift(&["overturning", "block.toml", "--urs", "r.h5", "-q", "--json"]).ok().stdout;
    let found: Value = serde_json::from_str(&found).unwrap();
    let of = &found["uncertainty"]["results"][0]["epistemic"];
    let [mean, lower, upper] =
        [&of["by_structure"]["mean"], &of["by_all"]["percentiles"][0], &of["by_all"]["percentiles"][4]]
            .map(|value| value.as_f64().unwrap());
    let short = format!(
        "Uncertain oscillator, overturning, Here, PGA: {mean:.1e} per year (90 % band {lower:.1e} to {upper:.1e})\n"
    );
    assert!(answer.contains(&short), "{short}{answer}");
    for words in [
        "Uncertain structure (epistemic, every structure a branch): 64 structures, sobol, seed 1, 2,304 \
         analyses",
        "of the distribution is outside the possible range, and is cut off",
        "overturning, Here, PGA: ",
        "of its variance ",
        "strength and capacity ",
    ] {
        assert!(run.stdout.contains(words), "{words}: {}", run.stdout);
    }
    let both = ["overturning", "block.toml", "--urs", "r.h5", "--restitution", "0.9"];
    study.uplift(&both).fails(2, &["--restitution", "[uncertainty.restitution]"]);
    let only = ["design", "block.toml", "--urs", "r.h5", "--spectrum-only", "-q", "--details"];
    let only = study.uplift(&only).ok();
    assert!(only.stdout.contains("[uncertainty]: all numbers are of the structure as described"), "{}", only.stdout);
    study.write("block.toml", &format!("{BLOCK}{}", scattering("random", "", 0.05)));
    study.uplift(&["overturning", "block.toml", "--urs", "r.h5"]).fails(3, &["uncertainty.kind", "epistemic"]);
}

/// A block that no run overturns: the bound of what is known stands in the place of every 0.
#[test]
#[ignore = "long: make test-long"]
fn zero_counts_are_reported_as_a_bound() {
    let study = study();
    let large = "kind = \"block\"\nwidth_m = 30\nheight_m = 8\nmass_kg = 1e6\nrestitution = 0.95\n";
    for kind in KINDS {
        study.write("large.toml", &format!("{large}{}", scattering(kind, few(kind), 0.01)));
        for (job, questions) in [("overturning", 1), ("design", 2)] {
            let ask = [job, "large.toml", "--urs", "r.h5", "-q"];
            let answer = study.uplift(&ask).ok().stdout;
            let told = study.uplift(&[&ask[..], &["--details"]].concat()).ok().stdout;
            let found = study.uplift(&[&ask[..], &["--json"]].concat()).json();
            let plain = match job {
                "overturning" => &found["overturning"][0]["sites"][0]["at_most_per_year"],
                _ => &found["exact"]["overturning"]["at_most_per_year"],
            };
            assert!(plain.as_f64().unwrap() > 0.0, "{found}");
            let results = found["uncertainty"]["results"].as_array().unwrap();
            let frequencies: Vec<&Value> = results.iter().filter(|result| result["unit"] == "1/yr").collect();
            assert_eq!(frequencies.len(), questions);
            for result in frequencies {
                let of = if kind == "epistemic" { &result[kind]["by_structure"] } else { &result[kind] };
                assert_eq!((&of["at_most_per_year"], &result["as_described_at_most_per_year"]), (plain, plain));
            }
            let line = told.lines().find(|line| line.starts_with("overturning, Here, PGA: ")).unwrap();
            let bound = format!("at most {:.1e} per year: no run shows it", plain.as_f64().unwrap());
            assert_eq!(line.matches(&bound).count(), 2, "{line}");
            let short =
                format!("Uncertain oscillator, overturning, Here, PGA: < {:.1e} per year\n", plain.as_f64().unwrap());
            assert!(answer.contains(&short), "{short}{answer}");
            assert!(!told.contains("0.000e0"), "{told}");
        }
    }
    // on the page and in the exports as well
    study.uplift(&["report", "r.h5", "-o", "page.html", "-q"]).ok();
    let page = read(&study, "page.html");
    assert!(page.contains("structure not known exactly") && !page.contains("0.000e0"));
    study.uplift(&["export", "r.h5", "--csv", "-o", "e.csv", "-q"]).ok();
    let table = read(&study, "e.structures.csv");
    let rows: Vec<&str> =
        table.lines().filter(|row| row.contains("overturning, structure not known exactly")).collect();
    assert!(rows.len() == 2 && rows.iter().all(|row| row.contains(",at most,")), "{table}");
}

/// What does not fall after uplift cannot overturn, and has no bound.
#[test]
fn what_cannot_overturn_has_no_bound() {
    let study = study();
    let stiff = "kind = \"restrained-frame\"\ncolumns = 2\nwidth_m = 0.5\nheight_m = 10\ncolumn_mass_kg = 0\n\
                 deck_mass_kg = 1e5\ntendon_stiffness_n_m = 1e8\ntendon_anchorage = \"foundation\"\n";
    let strength = "[uncertainty]\nsamples = 8\n[uncertainty.strength]\ndistribution = \"lognormal\"\n\
                    coefficient_of_variation = 0.05\n";
    study.write("stiff.toml", &format!("{stiff}{strength}"));
    let asked = ["overturning", "stiff.toml", "--urs", "r.h5", "-q", "--details"];
    let told = study.uplift(&asked).ok().stdout;
    assert!(told.contains("overturning, Here, PGA: no displacement capacity"), "{told}");
    let row = told.lines().nth(3).map(|line| line.split_whitespace().collect::<Vec<_>>());
    assert_eq!(row.as_deref(), Some(&["Here", "oscillator", "no", "displacement", "capacity"][..]), "{told}");
}

/// The rows of the oscillator have the answer, with bands and shares, in columns of their own.
#[test]
fn the_table_of_risks_has_what_is_uncertain() {
    let study = study();
    let column = |table: &str, name: &str| -> Vec<String> {
        let mut rows = table.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let header = rows.next().unwrap();
        let place = header.iter().position(|of| of == name).unwrap_or_else(|| panic!("{name}: {header:?}"));
        rows.map(|row| row[place].clone()).collect()
    };
    for kind in KINDS {
        study.write("block.toml", &format!("{BLOCK}{}", scattering(kind, few(kind), 0.05)));
        let ask = ["overturning", "block.toml", "--urs", "r.h5", "-o", "o.csv", "--json", "-q", "--force"];
        let found = study.uplift(&ask).json();
        let table = read(&study, "o.risk.csv");
        assert_eq!(column(&table, "model"), ["oscillator", "block"]);
        assert_eq!(column(&table, "uncertainty"), [kind, ""]);
        let result = &found["uncertainty"]["results"][0][kind];
        let (value, others) = match kind {
            "epistemic" => (
                &result["by_structure"]["mean"],
                vec![
                    ("maf_structure_p95_per_year", &result["by_structure"]["percentiles"][4]),
                    ("maf_all_mean_per_year", &result["by_all"]["mean"]),
                    ("maf_all_p05_per_year", &result["by_all"]["percentiles"][0]),
                ],
            ),
            _ => (&result["value"], vec![("maf_uncertain_records_upper_per_year", &result["by_record"][1])]),
        };
        for (name, expected) in [&[("maf_uncertain_per_year", value)], &others[..]].concat() {
            let cells = column(&table, name);
            let cell: f64 = cells[0].parse().unwrap();
            assert!(Some(cell) == expected.as_f64() && cells[1].is_empty(), "{kind} {name}: {cells:?} {expected}");
        }
        if kind == "epistemic" {
            let shares = result["shares"].as_array().unwrap();
            let of = shares.iter().find(|share| share["factor"] == "strength and capacity").unwrap();
            let cell: f64 = column(&table, "total_share_strength_and_capacity")[0].parse().unwrap();
            assert_eq!(Some(cell), of["total"].as_f64());
        }
    }
}

/// Every value that was tried has the branches' percentiles beside their mean.
#[test]
#[ignore = "long: make test-long"]
fn the_table_of_a_target_has_what_is_uncertain() {
    let study = study();
    let ask = ["--vary", "width", "--overturning", "2e-3", "--tolerance", "0.1", "-o", "t.csv", "--force"];
    for kind in KINDS {
        least(&study, "block.toml", &format!("{BLOCK}{}", scattering(kind, few(kind), 0.05)), &ask);
        let table = read(&study, "t.csv");
        let header = table.lines().next().unwrap();
        assert!(header.contains(",uncertainty") && table.lines().nth(1).unwrap().contains(kind), "{table}");
        assert_eq!(header.contains(",maf_structure_p95_per_year"), kind == "epistemic", "{header}");
    }
}

/// Numbers that are probably in another unit are asked about, beside the refusal that they lead to.
#[test]
fn a_target_in_another_unit_raises_a_warning() {
    let study = study();
    study.write("block.toml", BLOCK);
    let ask = ["target", "block.toml", "--urs", "r.h5", "--vary", "width"];
    let often = ["--overturning", "5"];
    study.uplift(&[&ask[..], &often].concat()).fails(2, &["the allowed frequency is 5 1/yr", "return period"]);
    let far = ["--exceed", "300", "--per-year", "2e-3"];
    let told = study.uplift(&[&ask[..], &far].concat()).ok().stdout;
    assert!(told.contains("mistake? target: --exceed is 300 m") && told.contains("in mm or cm?"), "{told}");
}

/// A structure that cannot be is refused with what is probably in another unit, with its line.
#[test]
fn a_slip_that_makes_a_structure_impossible_is_named() {
    let study = study();
    let quantity = |key: &str, rest: &str| format!("[uncertainty.{key}]\ndistribution = \"lognormal\"\n{rest}\n");
    let millimetres = quantity("uplift_displacement_m", "percentiles = [[5, 3], [95, 12]]");
    let six = "coefficient_of_variation = 6";
    let per_cent = quantity("capacity_m", six) + &quantity("uplift_displacement_m", &format!("mean = 0.05\n{six}"));
    for (text, words) in [
        (millimetres, ["line 8, uncertainty.uplift_displacement_m.percentiles[0][1] is 3 m", "in mm or cm?"]),
        (per_cent, ["line 8, uncertainty.capacity_m.coefficient_of_variation is 6", "in per cent?"]),
    ] {
        study.write("slip.toml", &format!("{BLOCK}{text}"));
        let target = ["target", "slip.toml", "--urs", "r.h5", "--vary", "width", "--overturning", "1e-3"];
        let overturning = ["overturning", "slip.toml", "--urs", "r.h5"];
        for (ask, code) in [(&overturning[..], 4), (&target[..], 2)] {
            let run = study.uplift(ask);
            run.fails(code, &[&["a sampled structure is invalid (", "slip.toml", "mistake?"], &words[..]].concat());
        }
    }
}

/// A structure file that is not there is answered with one, and not with a study.
#[test]
fn a_missing_structure_is_answered_with_a_structure() {
    let study = SmallStudy::new();
    let ask = ["overturning", "none.toml", "--urs", "r.h5"];
    study.uplift(&ask).fails(3, &["there is no such file", "configs/structures/pier.toml"]);
}
