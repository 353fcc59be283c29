//! `uplift design`: a structure against a spectrum, and against its own risk.

use std::path::Path;

use serde_json::Value;
use uplift_bootstrap::{SkewedMean, StudentQuantiles};
use uplift_motion::{Accelerogram, ReadOptions, read_path};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, PostUplift, respond};

use crate::common::{SmallStudy, repository, uplift};

const STUDY: &str = r#"title = "design"
[records]
manifest = "manifest.csv"
[strengths]
values = [0.05, 0.1, 0.2, 0.4]
[pgv]
levels_cm_s = [1, 3, 10, 30, 60, 100, 200]
[[sites]]
name = "Here"
pgv = "here-pgv.csv"
"#;

const LEVELS_CM_S: [f64; 7] = [1.0, 3.0, 10.0, 30.0, 60.0, 100.0, 200.0];

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n";

/// A result made of five pairs in files, with the structure `block.toml` beside it.
fn study() -> SmallStudy {
    let study = SmallStudy::with(STUDY);
    study.uplift(&["records", "synthesize", "-o", "downloads", "--count", "5", "-q"]).ok();
    study.uplift(&["records", "import", "downloads", "-o", "manifest.csv", "-q"]).ok();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.write("block.toml", BLOCK);
    study
}

fn design(study: &SmallStudy, structure: &str, more: &[&str]) -> Value {
    let arguments = [&["design", structure, "--urs", "r.h5", "--json", "-q"], more].concat();
    study.uplift(&arguments).json()
}

/// What rounding makes of these numbers is a range around each.
fn is_around(exact: &Value, names: &[&str]) {
    for name in names {
        let range = &exact["rounding"][name];
        assert_eq!(range["value"], exact[name], "{name}");
        let [lowest, value, highest] =
            ["lowest", "value", "highest"].map(|of| range[of].as_f64().unwrap_or(f64::INFINITY));
        assert!(0.0 < lowest && lowest <= value && value <= highest, "{name}: {range}");
    }
}

fn close(found: &Value, expected: f64, tolerance: f64) {
    let found = found.as_f64().unwrap_or(f64::INFINITY);
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{found} {expected}");
}

/// Component 1 of each pair with the geometric mean of the velocities of both, cm/s.
fn records(folder: &Path) -> Vec<(Accelerogram, f64)> {
    let read = |name: String| read_path(&folder.join(name), &ReadOptions::default()).unwrap();
    (1..=5)
        .map(|index| {
            let [one, other] = [1, 2].map(|component| read(format!("downloads/SYN{index:03}_H{component}.AT2")));
            let pgv_cm_s = 100.0 * (one.pgv_m_s() * other.pgv_m_s()).sqrt();
            (one, pgv_cm_s)
        })
        .collect()
}

/// Peaks over `[record][level]`, m, of an oscillator that is driven by `factor` times the motion (Eq. 3.4), by the
/// readable solver.
fn peaks_m(records: &[(Accelerogram, f64)], oscillator: &Oscillator, factor: f64) -> Vec<Vec<f64>> {
    let peak = |(record, pgv_cm_s): &(Accelerogram, f64), level: f64| {
        let excitation = Excitation::new(record.dt_s(), record.acceleration_m_s2()).unwrap();
        let scaled = excitation.scaled(factor * level / pgv_cm_s).unwrap();
        respond(oscillator, &scaled, FreeVibration::FirstPeak).peak_displacement_m
    };
    records.iter().map(|record| LEVELS_CM_S.iter().map(|&level| peak(record, level)).collect()).collect()
}

/// Annual frequency of exceeding `threshold_m` with the hazard 0.2/v² from 0.5 cm/s on: Eq. 4.4 written out.
fn rate(peaks_m: &[Vec<f64>], threshold_m: f64) -> f64 {
    let hazard = |v: f64| 0.2 / (v * v);
    let share = |level: usize| {
        peaks_m.iter().filter(|of_record| of_record[level] > threshold_m).count() as f64 / peaks_m.len() as f64
    };
    let last = LEVELS_CM_S.len() - 1;
    let between: f64 = (0..last)
        .map(|i| 0.5 * (share(i) + share(i + 1)) * (hazard(LEVELS_CM_S[i]) - hazard(LEVELS_CM_S[i + 1])))
        .sum();
    0.5 * share(0) * (hazard(0.5) - hazard(LEVELS_CM_S[0])) + between + share(last) * hazard(LEVELS_CM_S[last])
}

/// The smallest peak that is exceeded no more often than the target.
fn ordinate_m(peaks_m: &[Vec<f64>], target: f64) -> f64 {
    let exceeded = |threshold_m: f64| if threshold_m.is_finite() { rate(peaks_m, threshold_m) } else { 0.0 };
    peaks_m.iter().flatten().copied().filter(|&peak_m| exceeded(peak_m) <= target).fold(f64::INFINITY, f64::min)
}

/// A range is from the lowest to the highest of `values`, whose sixth is its own; infinite bounds are null.
fn holds(range: &Value, values: impl Iterator<Item = f64>) {
    let values: Vec<f64> = values.collect();
    let bounds = [
        ("value", values[5]),
        ("lowest", values.iter().copied().fold(f64::INFINITY, f64::min)),
        ("highest", values.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
    ];
    for (bound, expected) in bounds {
        match range[bound].as_f64() {
            Some(found) => close(&found.into(), expected, 1e-6),
            None => assert!(expected.is_infinite(), "{bound}: none, {expected}"),
        }
    }
}

// Every number once more, for a block that uplifts at 5 mm, so that no chaos of hundreds of impacts blurs them: Table
// 3.1 for a block by hand, driven by Γ times the motion, the readable solver, plain sums.
/// A demand below the displacement at uplift is no demand of rocking.
#[test]
fn a_demand_below_uplift_is_said_to_be_one() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    for (period, rocks) in [("0.2", true), ("3", false)] {
        let block = format!("kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 6000\nperiod_s = {period}\n");
        study.write("block.toml", &block);
        let ask = ["design", "block.toml", "--urs", "r.h5", "--site", "here", "-q", "--proxy"];
        let told = study.uplift(&ask).ok().stdout;
        assert_eq!(told.contains("at this risk it does not rock"), !rocks, "{told}");
    }
}

#[test]
fn every_number_by_hand() {
    const UPLIFT_M: f64 = 0.005;
    let study = study();
    study.write("flexible.toml", &format!("{BLOCK}uplift_displacement_m = {UPLIFT_M}\n"));
    let records = records(study.path());
    let (alpha, factor) = (0.2_f64.atan(), 1.5);
    let oscillator = |post_uplift| Oscillator::new(factor * alpha, 9.806_65, UPLIFT_M, 0.95, post_uplift).unwrap();
    let nsbe = peaks_m(&records, &oscillator(PostUplift::Negative { capacity_m: 0.8 }), factor);
    let zsbe = peaks_m(&records, &oscillator(PostUplift::Zero), factor);
    for poe in [0.02, 0.1, 0.5] {
        let target = -(1.0_f64 - poe).ln() / 50.0;
        let found = design(&study, "flexible.toml", &["--poe", &poe.to_string()]);
        close(&found["structure"]["strength"], factor * alpha, 1e-12);
        close(&found["structure"]["spectral_strength"], alpha, 1e-12);
        let exact = &found["exact"];
        let (z, u) = (ordinate_m(&zsbe, target), ordinate_m(&nsbe, target));
        close(&exact["zero_stiffness_demand_m"], z, 1e-6);
        close(&exact["demand_m"], u, 1e-6);
        assert_eq!(exact["analyses"], (1 + 2 * 11 + 3 * 8) * 5 * 7);
        is_around(exact, &["zero_stiffness_demand_of_spectrum_m", "zero_stiffness_demand_m", "demand_m"]);
        assert_eq!(exact["overturns"], u.is_infinite());
        let [lower, upper] = [0, 1].map(|limit| exact["bands"]["demand_m"]["by_record"][limit].as_f64());
        let [lower, upper] = [lower, upper].map(|limit_m| limit_m.unwrap_or(f64::INFINITY));
        assert!(0.0 < lower && lower <= u * (1.0 + 1e-6) && u <= upper * (1.0 + 1e-6), "{lower} {u} {upper}");
        for (event, threshold_m) in [("beyond_capacity", 0.8), ("overturning", f64::MAX)] {
            let per_year = rate(&nsbe, threshold_m);
            assert!(per_year > 0.0);
            close(&exact[event]["per_year"], per_year, 1e-9);
            close(&exact[event]["probability"], -(-50.0 * per_year).exp_m1(), 1e-9);
            // the rates of single records, of which theirs is the mean
            let of_records = nsbe.iter().map(|peaks_m| rate(std::slice::from_ref(peaks_m), threshold_m) - per_year);
            let deviations: Vec<f64> = of_records.collect();
            let moment = |power: i32| deviations.iter().map(|deviation| deviation.powi(power)).sum::<f64>() / 5.0;
            let mean = SkewedMean::new(per_year, [2, 3, 4].map(moment), 5);
            let expected = mean.interval(&StudentQuantiles::new(0.9, 5));
            let bands = &exact["bands"][format!("{event}_per_year")];
            for (limit, expected) in expected.into_iter().enumerate() {
                close(&bands["by_record"][limit], expected, 1e-6);
            }
            assert!(bands["by_earthquake"].is_null(), "synthetic pairs share no earthquake");
        }
        // Eq. 3.11 and 3.15 with z, written out
        assert!(z > UPLIFT_M, "{z}");
        let energy = 0.8 - ((0.8 - UPLIFT_M) * (0.8 - 2.0 * z + UPLIFT_M)).sqrt();
        for (rule, demand) in found["rules"].as_array().unwrap().iter().zip([z, energy]) {
            let check = &rule["from_exact"];
            if demand.is_nan() || demand > 0.8 {
                assert_eq!(check["overturns"], true);
                continue;
            }
            close(&check["demand_m"], demand, 1e-6);
            if u.is_finite() {
                let error = check["error"].as_f64().unwrap();
                assert!((error - (demand / u - 1.0)).abs() < 1e-5, "{error}");
            } else {
                assert_eq!(check["error"], -1.0);
            }
        }
        close(&found["rules"][0]["from_exact"]["required_capacity_m"], 2.5 * z, 1e-6);
    }
}

// The ranges beside these numbers, by the same means; impacts that take most of the velocity leave no chaos at any
// strength of the sweep.
#[test]
fn ranges_are_those_of_neighbouring_strengths() {
    const UPLIFT_M: f64 = 0.005;
    const RESTITUTION: f64 = 0.2;
    let study = study();
    let structure = format!("{BLOCK}uplift_displacement_m = {UPLIFT_M}\nrestitution = {RESTITUTION}\n");
    study.write("plastic.toml", &structure);
    let records = records(study.path());
    let (alpha, factor, target) = (0.2_f64.atan(), 1.5, -(0.9_f64.ln()) / 50.0);
    let at = |change: f64, post_uplift| {
        let strength = change * factor * alpha;
        peaks_m(&records, &Oscillator::new(strength, 9.806_65, UPLIFT_M, RESTITUTION, post_uplift).unwrap(), factor)
    };
    let sweep: Vec<_> = (-5..=5)
        .map(|step| 1.0 + 0.01 * f64::from(step) / 5.0)
        .map(|change| (at(change, PostUplift::Negative { capacity_m: 0.8 }), at(change, PostUplift::Zero)))
        .collect();
    let found = design(&study, "plastic.toml", &["--poe", "0.1"]);
    let noise = &found["exact"]["within_one_percent_of_strength"];
    holds(&noise["demand_m"], sweep.iter().map(|(nsbe, _)| ordinate_m(nsbe, target)));
    holds(&noise["beyond_capacity_per_year"], sweep.iter().map(|(nsbe, _)| rate(nsbe, 0.8)));
    holds(&noise["overturning_per_year"], sweep.iter().map(|(nsbe, _)| rate(nsbe, f64::MAX)));
    let errors = sweep.iter().map(|(nsbe, zsbe)| ordinate_m(zsbe, target) / ordinate_m(nsbe, target) - 1.0);
    holds(&noise["rule_errors"]["equal-displacement"], errors);
    assert!(noise["demand_m"]["lowest"].as_f64() < noise["demand_m"]["highest"].as_f64(), "{noise}");
}

// A point mass is followed where the motion acts, Γ = 1: at a strength of the study its ZSBE demand is the ordinate
// itself, to the bit.
#[test]
#[ignore = "long: make test-long"]
fn the_exact_demand_is_the_ordinate_where_the_spectrum_has_one() {
    let study = study();
    study.write("mast.toml", "kind = \"point-mass\"\nslenderness_rad = 0.2\nsize_m = 5\nmass_kg = 10\n");
    study.write("between.toml", "kind = \"point-mass\"\nslenderness_rad = 0.16\nsize_m = 5\nmass_kg = 10\n");
    let u_m = |strength: usize| {
        let reader = uplift_labelled::LabelledReader::open(&study.path().join("r.h5")).unwrap();
        reader.array::<f64>("/urs/pgv/u_m").unwrap().values[strength]
    };
    let found = design(&study, "mast.toml", &["--poe", "0.02"]);
    assert_eq!(found["structure"]["participation"], 1.0);
    for place in ["zero_stiffness_demand_of_spectrum_m", "zero_stiffness_demand_m"] {
        assert_eq!(found["exact"][place].as_f64().unwrap().to_bits(), u_m(2).to_bits());
    }
    assert_eq!(found["spectrum"]["ordinate_m"].as_f64().unwrap().to_bits(), u_m(2).to_bits());
    // in between it is a straight line
    let between = design(&study, "between.toml", &[]);
    close(&between["spectrum"]["ordinate_m"], 0.4 * u_m(1) + 0.6 * u_m(2), 1e-12);
    assert_eq!(between["spectrum"]["between_strengths"], serde_json::json!([0.1, 0.2]));
    // the spectrum alone says the same, and no more
    let alone = design(&study, "between.toml", &["--spectrum-only"]);
    assert_eq!(alone["spectrum"], between["spectrum"]);
    assert_eq!(alone["rules"][1]["from_spectrum"]["demand_m"], between["rules"][1]["from_spectrum"]["demand_m"]);
    assert!(alone["exact"].is_null() && alone["rules"][0]["from_exact"].is_null());
    // beyond the strengths there is no ordinate, and the rules start from the exact demand
    study.write("stocky.toml", "kind = \"point-mass\"\nslenderness_rad = 0.5\nsize_m = 5\nmass_kg = 10\n");
    let beyond = design(&study, "stocky.toml", &[]);
    assert!(beyond["spectrum"].is_null() && beyond["rules"][0]["from_exact"]["demand_m"].is_f64());
    assert!(beyond["notes"].to_string().contains("0.05 to 0.4"), "{beyond}");
}

#[test]
fn limits_of_size() {
    let study = study();
    // infinitely large: neither capacity nor overturning is in reach, and both rules and both oscillators agree
    study.write("large.toml", "kind = \"point-mass\"\nslenderness_rad = 0.15\nsize_m = 1e7\nmass_kg = 10\n");
    let large = design(&study, "large.toml", &[]);
    let exact = &large["exact"];
    close(&exact["demand_m"], exact["zero_stiffness_demand_m"].as_f64().unwrap(), 1e-4);
    for event in ["beyond_capacity", "overturning"] {
        assert_eq!(exact[event]["per_year"], 0.0);
    }
    for rule in large["rules"].as_array().unwrap() {
        assert!(rule["from_exact"]["error"].as_f64().unwrap().abs() < 1e-4);
        assert_eq!(rule["from_spectrum"]["satisfied"], true);
    }
    // tiny: it overturns more often than the target
    study.write("tiny.toml", "kind = \"point-mass\"\nslenderness_rad = 0.15\nsize_m = 0.05\nmass_kg = 10\n");
    let tiny = design(&study, "tiny.toml", &[]);
    assert_eq!((&tiny["exact"]["overturns"], &tiny["exact"]["demand_m"]), (&Value::Bool(true), &Value::Null));
    assert!(tiny["exact"]["overturning"]["probability"].as_f64().unwrap() > 0.02);
    assert_eq!(tiny["rules"][0]["from_spectrum"]["satisfied"], false);
    let tiny = ["design", "tiny.toml", "--urs", "r.h5"];
    let shown = study.uplift(&tiny).ok().stdout;
    let verdict =
        "Verdict   tiny by PGV: NOT satisfied: equivalent block overturns more often than the target; capacity";
    assert!(shown.starts_with(verdict), "{shown}");
    let shown = study.uplift(&[&tiny[..], &["--proxy"]].concat()).ok().stdout;
    let verdict = "Verdict   tiny, by its oscillator alone, capacity 0.01 m: NOT satisfied";
    for words in [verdict, "Demand    overturns on the equivalent", "synthetic"] {
        assert!(shown.contains(words), "{words}: {shown}");
    }
    let shown = study.uplift(&[&tiny[..], &["--details"]].concat()).ok().stdout;
    assert!(
        shown.contains("A force that falls after uplift can make these bands twice as wide as the spectrum's."),
        "{shown}"
    );
    for words in ["overturns more often than the target", "(Eq. 3.14)"] {
        assert!(shown.contains(words), "{words}: {shown}");
    }
}

#[test]
fn structures_without_a_capacity() {
    let study = study();
    let frame = |stiffness: f64| {
        format!(
            "kind = \"restrained-frame\"\ncolumns = 2\nwidth_m = 1\nheight_m = 10\ncolumn_mass_kg = 0\n\
             deck_mass_kg = 1e5\n\
             tendon_stiffness_n_m = {stiffness}\ntendon_anchorage = \"foundation\"\n"
        )
    };
    study.write("stiff.toml", &frame(2e7));
    let stiff = design(&study, "stiff.toml", &[]);
    assert_eq!(stiff["rules"], serde_json::json!([]));
    assert!(stiff["structure"]["capacity_m"].is_null() && stiff["exact"]["beyond_capacity"].is_null());
    assert!(stiff["structure"]["warnings"].to_string().contains("positive"), "{stiff}");
    // stiffer than ZSBE, it moves less
    let exact = &stiff["exact"];
    assert!(exact["demand_m"].as_f64() < exact["zero_stiffness_demand_m"].as_f64());
    let stiff = ["design", "stiff.toml", "--urs", "r.h5"];
    let shown = study.uplift(&stiff).ok().stdout;
    assert!(
        shown.contains("no displacement capacity: the force does not fall after uplift: no rule applies"),
        "{shown}"
    );
    let shown = study.uplift(&[&stiff[..], &["--details"]].concat()).ok().stdout;
    assert!(shown.contains("do not apply") && shown.contains("warning    post-uplift stiffness"), "{shown}");
}

// The last step of Section 3.4.5: with the tendons that the program names, the structure has the capacity that it asks
// for.
#[test]
#[ignore = "long: make test-long"]
fn tendons_of_the_required_capacity() {
    let study = study();
    let pier = |stiffness: f64| {
        let text = "kind = \"restrained-frame\"\ncolumns = 2\nwidth_m = 0.3\nheight_m = 3\ncolumn_mass_kg = 500\n\
            deck_mass_kg = 20000\n";
        let file = study
            .write("pier.toml", &format!("{text}tendon_anchorage = \"column\"\ntendon_stiffness_n_m = {stiffness}\n"));
        design(&study, file.to_str().unwrap(), &["--safety-factor", "4"])
    };
    let free = pier(0.0);
    for rule in 0..2 {
        let check = &free["rules"][rule]["from_spectrum"];
        assert_eq!(check["satisfied"], false, "{free}");
        let restrained = pier(check["required_tendon_stiffness_n_m"].as_f64().unwrap());
        close(&restrained["structure"]["capacity_m"], check["required_capacity_m"].as_f64().unwrap(), 1e-9);
        assert!(restrained["rules"][rule]["from_spectrum"]["margin_m"].as_f64().unwrap().abs() < 1e-9);
    }
    assert!(design(&study, "block.toml", &[])["rules"][0]["from_spectrum"]["required_tendon_stiffness_n_m"].is_null());
}

#[test]
fn differences_from_the_study_are_reported() {
    let study = study();
    study.write(
        "other.toml",
        &format!("{BLOCK}uplift_displacement_m = 0.004\nrestitution = 0.9\ngravity_m_s2 = 9.81\n"),
    );
    let found = design(&study, "other.toml", &[]);
    let notes = found["notes"].to_string();
    for words in ["(4 mm divided by Γ)", "this structure's is 0.9", "9.81 m/s2"] {
        assert!(notes.contains(words), "{words}: {notes}");
    }
    assert_eq!(found["structure"]["restitution"], 0.9);
    assert!(found["assumed"].is_null(), "{found}");
    assert_eq!(
        design(&study, "block.toml", &[])["assumed"].to_string(),
        r#"["uplift displacement 0.5 mm","restitution 0.942 of the block, 0.95 of its oscillator"]"#
    );
    let said = study.uplift(&["design", "block.toml", "--urs", "r.h5", "--spectrum-only"]).ok().stdout;
    assert!(
        said.contains("\nAssumed   uplift displacement 0.5 mm, restitution 0.95: not in the structure file\n"),
        "{said}"
    );
    // the answer names the difference; what rounding makes of the remedy is none
    let needed_mm = |text: &str| notes.split(text).nth(1).unwrap().split(' ').next().unwrap().parse::<f64>().unwrap();
    let said = study.uplift(&["design", "other.toml", "--urs", "r.h5", "--spectrum-only"]).ok().stdout;
    assert!(
        said.contains("The spectrum is of another oscillator: its uplift displacement is 0.5 mm; this structure's is")
    );
    let needed_mm = needed_mm("mm; this structure's is ");
    let settings = found["own_oscillator"].as_str().unwrap();
    // a command that can be pasted, and replaces nothing
    let command = format!("run study.toml {settings} -o r-other.h5");
    assert!(said.contains(&format!("\n          own oscillator's spectrum: uplift {command}\n")), "{said}");
    study.uplift(&command.split(' ').collect::<Vec<_>>()).ok();
    let own = ["design", "other.toml", "--urs", "r-other.h5", "--spectrum-only", "--json"];
    let own = study.uplift(&own).json();
    assert!(own["own_oscillator"].is_null() && own["other_oscillator"] == false, "{own}");
    for (factor, is_other) in [(1.04, false), (1.06, true)] {
        let own_mm = 4.0 * 0.5 / needed_mm * factor;
        study.write("near.toml", &format!("{BLOCK}uplift_displacement_m = {}\n", 1e-3 * own_mm));
        assert_eq!(design(&study, "near.toml", &[])["other_oscillator"], is_other, "{own_mm}");
    }
    assert_ne!(found["exact"]["zero_stiffness_demand_m"], found["exact"]["zero_stiffness_demand_of_spectrum_m"]);
}

/// The first line has one verdict for all measures that agree, and theirs where they do not.
#[test]
fn a_verdict_is_that_of_rules_measures_and_own_demand() {
    let study = study();
    let said = |factor: &str| {
        let asked = ["design", "block.toml", "--urs", "r.h5", "--proxy", "--safety-factor", factor];
        let told = study.uplift(&asked).ok().stdout;
        let json = study.uplift(&[&asked[..], &["--json", "-q"]].concat()).json();
        let own = json["own_check"]["satisfied"].as_bool().unwrap();
        (told.lines().next().unwrap().to_owned(), told.lines().nth(1).unwrap().to_owned(), own)
    };
    let (first, second, own) = said("2.5");
    assert!(first.ends_with(": satisfied; safety factor 2.5 (Eq. 3.15)") && own, "{first}");
    assert!(second.contains("), 2.5 times its own demand (") && !second.contains("NOT"), "{second}");
    let (first, second, own) = said("100");
    assert!(first.ends_with(", NOT satisfied; safety factor 100 (Eq. 3.15)") && !own, "{first}");
    assert!(second.contains(": NOT satisfied by equal displacement (") && !second.contains("; "), "{second}");
    let between = (10..40).map(|factor| said(&factor.to_string())).find(|(first, ..)| first.contains(" checks"));
    let (first, second, _) = between.unwrap();
    // what is satisfied and what is not
    let [one, two] = [1, 2].map(|missed| format!(" NOT satisfied by {missed} of 3 checks"));
    assert!((first.contains(&one) || first.contains(&two)) && !first.contains("2.5"), "{first}");
    assert!(second.contains(": satisfied by ") && second.contains("; NOT satisfied by "), "{second}");
}

/// Stockier than the spectrum's strengths: the verdict says that it is not the spectrum's.
#[test]
fn a_spectrum_without_a_value_is_said_beside_the_verdict() {
    let study = study();
    study.write("stocky.toml", &BLOCK.replace("width_m = 0.8", "width_m = 2.4"));
    for more in [&[][..], &["--spectrum-only"]] {
        let said = study.uplift(&[&["design", "stocky.toml", "--urs", "r.h5"], more].concat()).ok().stdout;
        let why = said.lines().find(|line| line.contains("no value")).unwrap_or_default();
        assert!(
            why.contains("the spectrum has no value at strength 0.5404") && why.contains("from 0.05 to 0.4"),
            "{said}"
        );
        assert!(why.contains("widen strengths.values"), "{said}");
    }
}

#[test]
#[ignore = "long: make test-long"]
fn records_that_are_gone_leave_the_spectrum() {
    let study = study();
    let full = design(&study, "block.toml", &[]);
    // another motion in the place of one
    let file = study.path().join("downloads/SYN002_H1.AT2");
    let original = std::fs::read(&file).unwrap();
    std::fs::copy(study.path().join("downloads/SYN003_H1.AT2"), &file).unwrap();
    let changed = design(&study, "block.toml", &[]);
    assert!(changed["exact"].is_null());
    assert_eq!(changed["spectrum"], full["spectrum"]);
    assert!(changed["notes"].to_string().contains("SYN002_H1.AT2"), "{changed}");
    // a manifest that knows nothing of checksums does not hide it either
    let manifest = std::fs::read_to_string(study.path().join("manifest.csv")).unwrap();
    let bare: Vec<String> = manifest.lines().map(|line| line.replace("sha256", "unknown")).collect();
    study.write("bare.csv", &bare.join("\n"));
    let bare = ["design", "block.toml", "--urs", "r.h5", "--manifest", "bare.csv"];
    study.uplift(&bare).fails(4, &["SYN002"]);
    std::fs::write(&file, &original).unwrap();
    assert_eq!(design(&study, "block.toml", &["--manifest", "bare.csv"])["exact"], full["exact"]);
    // all of it gone, and moved
    std::fs::create_dir(study.path().join("elsewhere")).unwrap();
    for name in ["downloads", "manifest.csv", "here-pgv.csv"] {
        std::fs::rename(study.path().join(name), study.path().join("elsewhere").join(name)).unwrap();
    }
    let gone = ["design", "block.toml", "--urs", "r.h5"];
    let answer = study.uplift(&gone).ok().stdout;
    assert!(answer.contains("by the spectrum at strength ") && !answer.contains("structure itself"), "{answer}");
    let gone = study.uplift(&[&gone[..], &["--details"]].concat()).ok().stdout;
    assert!(gone.contains("not analysed") && gone.contains("manifest.csv") && gone.contains("equal energy"), "{gone}");
    assert_eq!(design(&study, "block.toml", &["--manifest", "elsewhere/manifest.csv"])["exact"], full["exact"]);
    study.uplift(&["design", "block.toml", "--urs", "r.h5", "--manifest", "no.csv"]).fails(4, &["no.csv"]);
}

#[test]
fn mistakes_are_said_at_once_with_their_lines() {
    let study = study();
    study.write(
        "wrong.toml",
        "kind = \"restrained-frame\"\nwidth_m = \"1.6\"\nheight_m = -9.6\ncolumns = 2.5\nmass_kg = 3\n\
         tendon_anchorage = \"colum\"\n\
         deck_mass = 1\ncolumn_mass_kg = 1000\nrestitution = 1.5\nuplift_displacement_m = 0\n",
    );
    let lines = [
        "wrong.toml:2",
        "expected a number [m], found the text",
        "wrong.toml:3",
        "-9.6 m",
        "wrong.toml:4",
        "whole number",
        "wrong.toml:5",
        "means nothing for kind",
        "wrong.toml:6",
        "did you mean `column`?",
        "wrong.toml:7",
        "unknown key `deck_mass`",
        "wrong.toml:9",
        "from 0 to 1",
        "wrong.toml:10",
        "from 1e-6 to 10 m",
        "`tendon_stiffness_n_m` is missing",
        "`deck_mass_kg` is missing",
        "10 mistakes",
    ];
    study.uplift(&["design", "wrong.toml", "--urs", "r.h5"]).fails(3, &lines);
    for modulus in ["E = 33e9", "youngs_modulus_pa = 33e9"] {
        study.write("modulus.toml", &format!("{BLOCK}{modulus}\n"));
        let words = ["modulus.toml:5", "uplift_displacement_m = force at uplift / stiffness, or period_s"];
        study.uplift(&["design", "modulus.toml", "--urs", "r.h5"]).fails(3, &words);
    }
    study.write("kind.toml", "kind = \"blok\"\nwidth_m = \"x\"\n");
    study.uplift(&["design", "kind.toml", "--urs", "r.h5"]).fails(3, &["did you mean `block`?", "kind.toml:2"]);
    study.write("none.toml", "width_m = 1\n");
    study.uplift(&["design", "none.toml", "--urs", "r.h5"]).fails(3, &["what kind", "restrained-frame"]);
    study.write("flexible.toml", &format!("{BLOCK}uplift_displacement_m = 0.9\n"));
    study.uplift(&["design", "flexible.toml", "--urs", "r.h5"]).fails(3, &["flexible.toml:5", "0.8 m is not above"]);
    study.write("syntax.toml", "kind = \"block\nwidth_m = 1\n");
    study.uplift(&["design", "syntax.toml", "--urs", "r.h5"]).fails(3, &["not TOML"]);
    study.uplift(&["design", "absent.toml", "--urs", "r.h5"]).fails(3, &["absent.toml"]);
}

#[test]
fn questions_that_do_not_fit_the_result() {
    let study = study();
    let design = |more: &[&str]| study.uplift(&[&["design", "block.toml", "--urs", "r.h5"], more].concat());
    design(&["--site", "Nowhere"]).fails(2, &["no site Nowhere: it has Here"]);
    design(&["--poe", "30"]).fails(2, &["30 % is --poe 30%", "a return period is --return-period 30"]);
    design(&["--poe", "0.1,0.3"]).fails(2, &["0.1,0.3", "write a probability, 0.1 or 10%"]);
    design(&["--measure", "pga"]).fails(2, &["the result has no measure pga: it has pgv"]);
    design(&["--measure", "pgx"]).fails(2, &["pgx"]);
    design(&["--safety-factor", "0.5"]).fails(2, &["--safety-factor is 0.5"]);
    study.uplift(&["design", "block.toml", "--urs", "absent.h5"]).fails(4, &["absent.h5"]);
    study.uplift(&["design", "block.toml", "--urs", "study.toml"]).fails(4, &["study.toml"]);
    study.uplift(&["design", "block.toml"]).fails(2, &["--urs"]);
    // spectra of something else than the ZSBE proxy
    for (key, word) in [("capacity_m", "negative"), ("post_uplift_stiffness_per_s2", "positive")] {
        let set = format!("oscillator.{key}=2.0");
        study.uplift(&["run", "study.toml", "-o", "other.h5", "-q", "--force", "--set", &set]).ok();
        study.uplift(&["design", "block.toml", "--urs", "other.h5"]).fails(4, &[word, key, "other.h5"]);
    }
    study.uplift(&["run", "study.toml", "-o", "bare.h5", "-q", "--set", "sites=[]"]).ok();
    study.uplift(&["design", "block.toml", "--urs", "bare.h5"]).fails(4, &["no sites"]);
}

#[test]
fn any_number_of_threads_gives_the_same_words() {
    let study = study();
    let one = study.uplift(&["design", "block.toml", "--urs", "r.h5", "--threads", "1"]).ok().stdout;
    let five = study.uplift(&["design", "block.toml", "--urs", "r.h5", "--threads", "5"]).ok().stdout;
    assert_eq!(one, five);
}

#[test]
fn shipped_structures_are_what_they_say() {
    let study = study();
    for name in ["pier", "single-pier", "block", "frame"] {
        let file = repository().join(format!("configs/structures/{name}.toml"));
        let asked = ["design", file.to_str().unwrap(), "--urs", "r.h5", "--spectrum-only", "--details"];
        let shown = uplift(study.path(), &asked).ok();
        let verdict = format!("Verdict   {name}, by its oscillator alone, capacity ");
        assert!(shown.stdout.starts_with(&verdict), "{}", shown.stdout);
        assert!(shown.stdout.contains(&format!("\nstructure  {name}: ")), "{}", shown.stdout);
        assert!(!shown.stdout.contains("warning "), "{}", shown.stdout);
    }
}

/// The block of docs/design.md that begins with `$ uplift`: the command and what it prints.
fn shown_in_the_documentation() -> Vec<(Vec<String>, String)> {
    let text = std::fs::read_to_string(repository().join("docs/design.md")).unwrap();
    let blocks = text.split("```").skip(1).step_by(2).filter_map(|block| block.split_once("$ uplift "));
    blocks
        .map(|(_, block)| {
            let (command, output) = block.split_once('\n').unwrap();
            (command.split(' ').map(str::to_owned).collect(), output.to_owned())
        })
        .collect()
}

// Last digits belong to a machine's mathematical functions.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
#[ignore = "long: make test-long"]
fn the_documentation_shows_what_is_printed() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("configs/structures")).unwrap();
    for name in ["single-pier", "frame"] {
        let file = format!("configs/structures/{name}.toml");
        std::fs::copy(repository().join(&file), folder.path().join(&file)).unwrap();
    }
    let quick = repository().join("configs/quick.toml");
    uplift(folder.path(), &["run", quick.to_str().unwrap(), "-q"]).ok();
    let shown = shown_in_the_documentation();
    assert_eq!(shown.len(), 1);
    for (command, output) in shown {
        assert_eq!(uplift(folder.path(), &command).ok().stdout, output, "{command:?}");
    }
}

/// A number as it is shown, with an asterisk where rounding decides its digits; infinite where it is null.
fn marked(range: &Value, shown: impl Fn(f64) -> String) -> String {
    let [value, lowest, highest] =
        ["value", "lowest", "highest"].map(|end| range[end].as_f64().map_or("overturns".to_owned(), &shown));
    let mark = if lowest == value && highest == value { "" } else { "*" };
    format!("{value}{mark}")
}

#[test]
fn a_design_sheet_says_what_the_design_says() {
    let study = study();
    let found = design(&study, "block.toml", &["--proxy", "--report", "sheet.html"]);
    let page = std::fs::read_to_string(study.path().join("sheet.html")).unwrap();
    // the demand in the table, to the tenth of a millimetre, and in the sentence before it
    let demand_m = found["exact"]["demand_m"].as_f64().unwrap();
    let exact = &found["exact"];
    for name in ["zero_stiffness_demand_of_spectrum_m", "zero_stiffness_demand_m", "demand_m"] {
        let shown = marked(&exact["rounding"][name], |demand_m| format!("{demand_m:.4}"));
        assert!(page.contains(&format!("<td class=\"number\">{shown}</td>")), "{name}: {shown}");
    }
    let overturning = marked(&exact["rounding"]["overturning_per_year"], |per_year| format!("{per_year:.3e}"));
    // some of the risk lies above the levels
    let share = exact["overturning"]["upper_tail_share"].as_f64().unwrap();
    assert!(share > 0.01, "{share}");
    let cell = format!("<td class=\"number\">{overturning}</td>");
    assert!(page.contains(&cell) && page.contains(" a year): "), "{cell}");
    assert_eq!(page.contains("not significant (rounding)"), page.contains("*</td>"));
    let (lead, rest) = page.split_once("<div class=\"answer\">").unwrap().1.split_once("</div>").unwrap();
    let said: f64 = lead
        .split_once("the demand on the equivalent oscillator is ")
        .unwrap()
        .1
        .split_once(" m")
        .unwrap()
        .0
        .parse()
        .unwrap();
    assert!((said / demand_m - 1.0).abs() < 0.06, "{lead}");
    let satisfied = found["rules"].as_array().unwrap().iter().all(|rule| rule["from_spectrum"]["satisfied"] == true);
    assert_eq!(lead.contains("class=\"verdict no\""), !satisfied, "{lead}");
    // how sure that is, in words and drawn
    assert!(lead.contains("m (90 % band ") && lead.contains(" 90 % band: "), "{lead}");
    let drawn = rest.split_once("aria-label=\"Values (dots) with their 90 % confidence bands (bars), m\"").unwrap().1;
    assert!(drawn.contains(">demand, oscillator, Here, PGV: "), "{drawn}");
    // the block to scale, with its dimensions
    let drawing = rest.split_once("<svg").unwrap().1.split_once("</svg>").unwrap().0;
    assert!(drawing.contains(">0.8 m</text>") && drawing.contains(">4 m</text>"), "{drawing}");
    assert_eq!(page.matches("not for design").count(), usize::from(found["synthetic"] == true));
    assert!(
        page.split("http").skip(1).all(|rest| rest.starts_with("://www.w3.org/2000/svg") || rest.starts_with("-equiv"))
    );

    // what holds for the best estimate alone, on the terminal and the sheet
    let asked = ["design", "block.toml", "--urs", "r.h5", "--proxy", "--safety-factor", "16"];
    let said = study.uplift(&[&asked[..], &["--report", "sheet.html", "--force"]].concat()).ok().stdout;
    let doubt = "not satisfied at the upper limit of the demand's band, 0.052 m (requires 0.83 m)";
    assert!(
        said.contains("satisfied by equal displacement") && said.contains(&format!("\n          {doubt}\n")),
        "{said}"
    );
    assert!(
        std::fs::read_to_string(study.path().join("sheet.html"))
            .unwrap()
            .contains(&format!("Its own demand is {doubt}."))
    );

    study.write("notes.html", "mine");
    let refused = ["design", "block.toml", "--urs", "r.h5", "--report", "notes.html"];
    study.uplift(&refused).fails(2, &["notes.html", "--force"]);
    study.uplift(&["design", "block.toml", "--urs", "r.h5", "--report", "sheet.pdf"]).fails(2, &["sheet.pdf", "html"]);
}
