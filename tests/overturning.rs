//! `uplift overturning`: by the equivalent oscillator and by the rigid block.

use serde_json::Value;

use crate::common::{SmallStudy, real_records};

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n";

fn json(study: &SmallStudy, structure: &str, more: &[&str]) -> Value {
    study.uplift(&[&["overturning", structure, "--urs", "r.h5", "--json", "-q"], more].concat()).json()
}

/// What one model does by one measure.
fn model<'a>(found: &'a Value, im: &str, name: &str) -> &'a Value {
    found["overturning"].as_array().unwrap().iter().find(|row| row["im"] == im && row["model"] == name).unwrap()
}

fn study(text: &str) -> SmallStudy {
    let study = SmallStudy::with(text);
    study.write("block.toml", BLOCK);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

/// Two grounds that set off for good with a constant acceleration, and one that jerks for two hundredths of a second.
pub(crate) fn steps() -> SmallStudy {
    let folder = SmallStudy::with(
        "title = \"steps\"\n[records]\nmanifest = \"manifest.csv\"\nduplicates = \"keep\"\n[strengths]\n\
         values = [0.1, 0.2]\n[pga]\n\
         levels_g = [0.05, 0.12, 0.3, 0.8]\n\
         [[sites]]\nname = \"Here\"\npga = \"pga.csv\"\n",
    );
    let step: String = (0..1500).map(|_| "1\n").collect();
    let jerk: String = (0..1500).map(|sample| if sample == 2 { "1\n" } else { "0\n" }).collect();
    folder.write("step.txt", &step);
    folder.write("jerk.txt", &jerk);
    let row = |id: &str, file: &str| format!("{id},{file},{file},0.01,m/s2\n");
    let rows = [row("A", "step.txt"), row("B", "jerk.txt"), row("C", "step.txt")].concat();
    folder.write("manifest.csv", &format!("record_id,file_h1,file_h2,dt_s,unit\n{rows}"));
    folder.write("block.toml", BLOCK);
    folder.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    folder
}

// tan α = 0.2: a constant acceleration above 0.2 g overturns any such block without return, one below does not even
// lift it; the jerk is too short to matter. So two of three records overturn it from 0.3 g on, and the risk is a sum of
// three terms with the hazard 1e-4/a^2.2.
#[test]
fn a_case_known_by_hand() {
    let study = steps();
    let found = json(&study, "block.toml", &[]);
    let rate = |level: f64| 1e-4 * level.powf(-2.2);
    let share = 2.0 / 3.0;
    let expected = 0.5 * share * (rate(0.12) - rate(0.3)) + share * (rate(0.3) - rate(0.8)) + share * rate(0.8);
    for name in ["oscillator", "block"] {
        let of_model = model(&found, "PGA", name);
        assert_eq!(of_model["overturned"], serde_json::json!([0, 0, 2, 2]), "{name}");
        assert_eq!(of_model["records"], 3);
        let site = &of_model["sites"][0];
        let near = |key: &str, expected: f64| {
            let found = site[key].as_f64().unwrap();
            assert!((found - expected).abs() < 1e-9 * expected, "{name} {key}: {found} {expected}");
        };
        near("per_year", expected);
        near("probability", -(-50.0 * expected).exp_m1());
        near("upper_tail_share", share * rate(0.8) / expected);
        // rates r, 0, r of the records, r = 3/2 of their mean: s = r/√3, γ = −√3 and a = −1; three records show no
        // kurtosis, so one degree of freedom, t = 6.313752: T = −3 ((1 + t − 1/6)^⅓ − 1) = −2.778710 above, and far
        // below nothing
        let limits = &site["bands"]["by_record"];
        let upper = expected + 2.778_710 * 1.5 * expected / 3.0;
        assert!((limits[1].as_f64().unwrap() / upper - 1.0).abs() < 1e-5, "{name}: {limits} {upper}");
        assert_eq!(limits[0], 0.0);
        assert_eq!(site["lower_tail_share"], 0.0);
        assert_eq!(site["site"], "Here");
    }
    // were it all motions above the last level in place of two thirds, the rate would rise by less than a tenth
    assert!(0.5 * share * rate(0.8) / expected < 0.1, "{expected}");
    assert!(!found["alarms"].to_string().contains("above the last level"), "{found}");
}

const WITH_PGA: &str = "title = \"small\"\n[records.synthetic]\npairs = 20\n[strengths]\nvalues = [0.05, 0.1]\n\
    [pga]\nlevels_g = [0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8]\n[[sites]]\nname = \"Here\"\npga = \"pga.csv\"\n\
    [[sites]]\nname = \"There\"\npga = \"pga.csv\"\n";

// A slender block without elasticity: the oscillator tends to it as its displacement before uplift does to zero.
// Impacts that take much keep records on the edge of overturning few.
#[test]
#[ignore = "long: make test-long"]
fn slender_blocks_overturn_as_their_oscillators_do() {
    let study = study(WITH_PGA);
    let counts = |model: &Value| -> Vec<i64> {
        model["overturned"].as_array().unwrap().iter().map(|count| count.as_i64().unwrap()).collect()
    };
    let apart = |uplift_m: f64| {
        let text = "kind = \"block\"\nslenderness_rad = 0.05\nsize_m = 2.5\nmass_kg = 1\n";
        study.write("slender.toml", &format!("{text}uplift_displacement_m = {uplift_m}\n"));
        let found = json(&study, "slender.toml", &["--restitution", "0.8"]);
        let [a, b] = ["oscillator", "block"].map(|name| counts(model(&found, "PGA", name)));
        assert!(b[0] < 10 && *b.last().unwrap() > 10, "{b:?}");
        let differences: Vec<i64> = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).collect();
        (differences, found)
    };
    let (near, found) = apart(1e-6);
    assert!(near.iter().all(|&difference| difference <= 1), "{near:?}");
    let [oscillator, block] = ["oscillator", "block"].map(|name| model(&found, "PGA", name));
    for key in ["theta", "beta"] {
        let [a, b] = [oscillator, block].map(|model| model[key].as_f64().unwrap());
        assert!((a / b - 1.0).abs() < 0.05, "{key}: {a} {b}");
    }
    let per_year = |model: &Value| model["sites"][0]["per_year"].as_f64().unwrap();
    assert!((per_year(oscillator) / per_year(block) - 1.0).abs() < 0.1, "{found}");
    let (far, _) = apart(1e-3);
    assert!(near.iter().sum::<i64>() < far.iter().sum(), "{near:?} {far:?}");
}

// What rotates as one block is one block: the frame and the block of its size and restitution give the same numbers.
#[test]
#[ignore = "long: make test-long"]
fn a_frame_is_its_block() {
    let study = study(WITH_PGA);
    study.write(
        "frame.toml",
        "kind = \"frame\"\ncolumns = 4\nwidth_m = 0.4\nheight_m = 4\ncolumn_mass_kg = 1000\ndeck_mass_kg = 9000\n",
    );
    let frame = json(&study, "frame.toml", &[]);
    let rotates = &frame["models"][1];
    let alpha = 0.1_f64.atan();
    // γ = 9/4: the size grows by (1 + 3γ)/(1 + 2γ), the loss is that of the angular momentum
    let size_m = 0.2_f64.hypot(2.0) * 7.75 / 5.5;
    let restitution = 1.0 - 1.5 * alpha.sin().powi(2) * 10.0 / 7.75;
    for (key, expected) in [("size_m", size_m), ("slenderness_rad", alpha), ("restitution", restitution)] {
        assert!((rotates[key].as_f64().unwrap() / expected - 1.0).abs() < 1e-12, "{key}: {rotates}");
    }
    assert_eq!(rotates["restitution_from"], "angular momentum");
    let text = format!(
        "kind = \"block\"\nslenderness_rad = {alpha}\nsize_m = {size_m}\nmass_kg = 1\nrestitution = {restitution}\n"
    );
    study.write("same.toml", &text);
    let same = json(&study, "same.toml", &[]);
    let counts = &model(&frame, "PGA", "equivalent block")["overturned"];
    assert_eq!(counts, &model(&same, "PGA", "block")["overturned"]);
    assert!(
        counts.to_string().contains("[0,") && counts.as_array().unwrap().iter().any(|count| count != 0),
        "{counts}"
    );
    assert_eq!(same["models"][1]["restitution_from"], "the structure file");
}

#[test]
#[ignore = "long: make test-long"]
fn what_no_record_overturns_has_a_bound_and_what_cannot_has_none() {
    let study = study(WITH_PGA);
    study.write("large.toml", "kind = \"block\"\nslenderness_rad = 0.3\nsize_m = 1e5\nmass_kg = 1\n");
    let large = json(&study, "large.toml", &[]);
    for name in ["oscillator", "block"] {
        let of_model = model(&large, "PGA", name);
        assert_eq!(of_model["overturned"], serde_json::json!([0, 0, 0, 0, 0, 0, 0]));
        assert!(of_model["theta"].is_null() && of_model["sites"][1]["lognormal_per_year"].is_null());
        assert_eq!(of_model["sites"][1]["per_year"], 0.0);
        assert!(of_model["sites"][1]["at_most_per_year"].as_f64().unwrap() > 0.0);
    }
    assert!(large["notes"].to_string().contains("no lognormal fragility"), "{large}");
    let frame = |stiffness: f64| {
        format!(
            "kind = \"restrained-frame\"\ncolumns = 2\nwidth_m = 0.5\nheight_m = 10\ncolumn_mass_kg = 0\n\
             deck_mass_kg = 1e5\n\
             tendon_stiffness_n_m = {stiffness}\ntendon_anchorage = \"foundation\"\n"
        )
    };
    study.write("stiff.toml", &frame(1e8));
    study.write("free.toml", &frame(0.0));
    let stiff = json(&study, "stiff.toml", &[]);
    // no block rotates as columns with tendons do: they are shaken as a frame
    let [_, own] = &stiff["models"].as_array().unwrap()[..] else { panic!("{stiff}") };
    assert_eq!(own["model"], "planar frame");
    let notes = stiff["notes"].to_string();
    assert!(notes.contains("never overturns") && notes.contains("the planar frame 0.9950"), "{notes}");
    let risk = &model(&stiff, "PGA", "oscillator")["sites"][0];
    assert!(risk["per_year"] == 0.0 && risk["at_most_per_year"].is_null(), "{risk}");
    let free = json(&study, "free.toml", &[]);
    assert!(model(&free, "PGA", "oscillator")["sites"][0]["per_year"].as_f64().unwrap() > 0.0);
}

#[test]
#[ignore = "long: make test-long"]
fn tables_and_figures_hold_what_is_printed() {
    let study = study(WITH_PGA);
    study.write("block.toml", "kind = \"block\"\nwidth_m = 0.4\nheight_m = 4\nmass_kg = 1000\n");
    let found = json(&study, "block.toml", &["-o", "b.csv", "--plot", "b.svg", "--site", "there"]);
    let read = |name: &str| std::fs::read_to_string(study.path().join(name)).unwrap();
    let rows = |name: &str| -> Vec<Vec<String>> {
        read(name).lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let fragility = rows("b.csv");
    assert_eq!(
        fragility[0].join(","),
        "im,unit,level,model,restitution,overturned,records,share,lognormal,overturned_rounding_lowest,\
         overturned_rounding_highest"
    );
    assert_eq!(fragility.len(), 1 + 2 * 7);
    for (row, level) in fragility[1..8].iter().zip(0..) {
        let of_model = model(&found, "PGA", "oscillator");
        assert_eq!(row[5], of_model["overturned"][level].to_string());
        let [fewest, most] = [0, 1].map(|end| &of_model["overturned_rounding"][level][end]);
        assert_eq!(row[9..], [fewest.to_string(), most.to_string()]);
        assert!(fewest.as_u64() <= row[5].parse().ok() && row[5].parse().ok() <= most.as_u64(), "{row:?}");
    }
    let risk = rows("b.risk.csv");
    assert_eq!(risk.len(), 3);
    assert_eq!((risk[1][0].as_str(), risk[2][2].as_str()), ("There", "block"));
    let per_year = model(&found, "PGA", "block")["sites"][0]["per_year"].as_f64().unwrap();
    assert!((risk[2][3].parse::<f64>().unwrap() / per_year - 1.0).abs() < 1e-12);
    // the rate of the lognormal fragility lies in its band, which the table has too
    let fitted = &model(&found, "PGA", "block")["sites"][0];
    let column = |name: &str| risk[2][risk[0].iter().position(|of| of == name).unwrap()].parse::<f64>().unwrap();
    for (end, name) in ["lower", "upper"].into_iter().enumerate() {
        let limit = fitted["lognormal_bands"]["by_record"][end].as_f64().unwrap();
        let written = column(&format!("maf_lognormal_records_{name}_per_year"));
        assert!((written - limit).abs() <= 1e-12 * limit, "{fitted}");
        let beyond = limit - fitted["lognormal_per_year"].as_f64().unwrap();
        assert!(if end == 0 { beyond < 0.0 } else { beyond > 0.0 }, "{fitted}");
    }
    let svg = read("b.svg");
    assert!(!svg.contains("Overturning of block") && svg.contains("synthetic records") && !svg.contains("NaN"));
    let on = |threads: &str| {
        study.uplift(&["overturning", "block.toml", "--urs", "r.h5", "--details", "--threads", threads]).ok().stdout
    };
    let shown = on("1");
    for words in ["rotates as a block of R = 2.0100 m", "angular momentum", "Here", "There", "synthetic", "theta"] {
        assert!(shown.contains(words), "{words}: {shown}");
    }
    assert_eq!(shown, on("5"));
}

/// Motions on the edge of overturning at many levels: one of them rounding pushes over it.
#[test]
#[ignore = "long: make test-long"]
fn what_rounding_decides_is_marked() {
    let levels: Vec<String> = (0..12).map(|level| format!("{:.2}", 0.5 + 0.01 * f64::from(level))).collect();
    let study = study(&WITH_PGA.replace("0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8", &levels.join(", ")));
    let found = json(&study, "block.toml", &["--site", "Here", "--restitution", "0.98"]);
    let of_model = model(&found, "PGA", "oscillator");
    let hanging =
        |level: &usize| of_model["overturned_rounding"][level][0] != of_model["overturned_rounding"][level][1];
    let hanging: Vec<usize> = (0..levels.len()).filter(hanging).collect();
    assert!(!hanging.is_empty() && hanging.len() < levels.len() / 2, "{hanging:?}");
    let range = &of_model["sites"][0]["per_year_rounding"];
    let [lowest, value, highest] = ["lowest", "value", "highest"].map(|end| range[end].as_f64().unwrap());
    assert!(lowest <= value && value <= highest && lowest < highest, "{range}");
    assert_eq!(of_model["sites"][0]["per_year"], range["value"]);
    let arguments = ["overturning", "block.toml", "--urs", "r.h5", "--site", "Here", "--restitution", "0.98"];
    let answer = study.uplift(&arguments).ok().stdout;
    // that takes nine times the analyses: as in a design, the answer has it in the details
    assert!(answer.contains(&format!("  {value:.1e}")) && !answer.contains('*'), "{value:.1e}\n{answer}");
    let shown = study.uplift(&[&arguments[..], &["--details"]].concat()).ok().stdout;
    let mark = if [lowest, highest].map(|end| format!("{end:.1e}")) == [value; 2].map(|own| format!("{own:.1e}")) {
        ""
    } else {
        "*"
    };
    assert!(shown.contains(&format!(" {value:.1e}{mark} ")), "{value:.1e}{mark}\n{shown}");
    for level in hanging {
        let [fewest, most] = [0, 1].map(|end| &of_model["overturned_rounding"][level][end]);
        let words = format!("{fewest} to {most} at {}", of_model["levels"][level]);
        assert!(shown.contains(&words), "{words}\n{shown}");
    }
}

#[test]
fn mistakes_are_said() {
    let study = steps();
    let overturning = |more: &[&str]| study.uplift(&[&["overturning", "block.toml", "--urs", "r.h5"], more].concat());
    overturning(&["--site", "Nowhere"]).fails(2, &["no site Nowhere: it has Here"]);
    overturning(&["--measure", "pgv"]).fails(2, &["the result has no measure pgv: it has pga"]);
    overturning(&["--restitution", "1.5"]).fails(2, &["--restitution", "1.5", "between 0 and 1"]);
    overturning(&["--plot", "b.pdf"]).fails(2, &[".svg or .png"]);
    overturning(&["-o", "b.txt"]).fails(2, &[".csv"]);
    overturning(&["-o", "manifest.csv"]).fails(2, &["manifest.csv", "another name"]);
    study.write("wrong.toml", "kind = \"block\"\nwidth_m = 0\n");
    study.uplift(&["overturning", "wrong.toml", "--urs", "r.h5"]).fails(3, &["wrong.toml:2", "mass_kg"]);
    std::fs::remove_file(study.path().join("jerk.txt")).unwrap();
    overturning(&[]).fails(4, &["jerk.txt", "--manifest"]);
}

// The real set: a spectrum's study with a capacity serves as well, and a block of temple size falls about as often by
// either model.
#[test]
#[ignore = "long: make test-long"]
fn real_set() {
    let Some(records) = real_records() else { return };
    let text = format!(
        "title = \"real\"\n[records]\nmanifest = {:?}\ntag = \"ord105\"\nfirst = 30\n[strengths]\nvalues = [0.1]\n\
         [oscillator]\ncapacity_m = 2.0\n\
         [pgv]\nlevels_cm_s = [5, 10, 20, 40, 60, 80, 120, 200]\n[[sites]]\nname = \"Here\"\npgv = \"here-pgv.csv\"\n",
        records.join("manifest.csv").display().to_string()
    );
    let study = study(&text);
    let found = json(&study, "block.toml", &[]);
    let [oscillator, block] = ["oscillator", "block"].map(|name| model(&found, "PGV", name));
    let rate = |model: &Value| model["sites"][0]["per_year"].as_f64().unwrap();
    let ratio = rate(oscillator) / rate(block);
    assert!((0.5..2.0).contains(&ratio), "{ratio}");
    let medians = [oscillator, block].map(|model| model["theta"].as_f64().unwrap());
    println!("rates {} {}, medians {medians:?} cm/s", rate(oscillator), rate(block));
    assert!((medians[0] / medians[1] - 1.0).abs() < 0.15, "{medians:?}");
}
