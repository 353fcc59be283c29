//! `uplift target`: the least of a quantity for a target risk, the inverse of `uplift overturning`.

use serde_json::Value;

use crate::common::SmallStudy;

const STUDY: &str = "title = \"small\"\n[records.synthetic]\npairs = 20\n[strengths]\nvalues = [0.05, 0.1]\n\
    [pga]\nlevels_g = [0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8, 1.2, 2]\n[bootstrap]\nreplicates = 200\n[[sites]]\n\
    name = \"Here\"\npga = \"pga.csv\"\n";

fn frame(width_m: f64) -> String {
    format!(
        "kind = \"frame\"\ncolumns = 4\nwidth_m = {width_m}\nheight_m = 4\ncolumn_mass_kg = 1000\ndeck_mass_kg = 9000\n"
    )
}

fn study() -> SmallStudy {
    let study = SmallStudy::with(STUDY);
    study.write("frame.toml", &frame(0.6));
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

fn json(study: &SmallStudy, more: &[&str]) -> Value {
    study.uplift(&[&["target", "frame.toml", "--urs", "r.h5", "--json", "-q"], more].concat()).json()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
#[ignore = "long: make test-long"]
fn target_and_risk_are_inverses() {
    let study = study();
    let overturning_per_year = |width_m: f64| {
        study.write("other.toml", &frame(width_m));
        let run = study.uplift(&["overturning", "other.toml", "--urs", "r.h5", "--json", "-q"]).ok();
        let found: Value = serde_json::from_str(&run.stdout).unwrap();
        number(&found["overturning"][0]["sites"][0]["per_year"])
    };
    let found = json(&study, &["--overturning", "2e-3", "--vary", "width", "--tolerance", "1e-3"]);
    let (value, missed_at) = (number(&found["value"]), number(&found["missed_at"]));
    assert!(missed_at < value && value <= missed_at * (1.0 + 1e-3), "{found}");
    // the risk at the value, to the bit, meets the target; that a thousandth below does not
    assert_eq!(overturning_per_year(value).to_bits(), number(&found["risk"]["per_year"]).to_bits());
    assert!(overturning_per_year(value) <= 2e-3 && overturning_per_year(missed_at) > 2e-3);
    // everything above that was tried meets it, and each risk is that of `uplift overturning`
    let tried = found["tried"].as_array().unwrap();
    assert!(tried.iter().all(|tried| number(&tried["value"]) < value || tried["is_met"] == true));
    for place in [0, tried.len() - 1] {
        let per_year = overturning_per_year(number(&tried[place]["value"]));
        assert_eq!(per_year.to_bits(), number(&tried[place]["per_year"]).to_bits());
    }
    // asked for as a probability it is the same
    let poe = format!("{}", -(-50.0_f64 * 2e-3).exp_m1());
    let same = json(&study, &["--poe", &poe, "--years", "50", "--vary", "width", "--tolerance", "1e-3"]);
    assert_eq!(same["value"], found["value"]);
    let band: Vec<f64> = found["bands"][0]["value"].as_array().unwrap().iter().map(number).collect();
    assert!(band[0] < band[1] && band[0] <= value && value <= band[1], "{band:?} {value}");
    // from the safe value on the upper limit meets the target, by all values together and by each alone
    let safe = number(&found["safe_value"]);
    assert!(value <= safe && band[1] <= safe, "{band:?} {safe}");
    assert!(number(&found["safe_bands"]["by_record"][1]) <= 2e-3, "{found}");
    let from_safe_on = tried.iter().filter(|tried| number(&tried["value"]) >= safe);
    assert!(from_safe_on.clone().all(|tried| tried["upper_per_year"].as_f64().is_none_or(|upper| upper <= 2e-3)));
    assert!(from_safe_on.count() > 1 && tried.iter().any(|tried| number(&tried["upper_per_year"]) > 2e-3), "{found}");
    assert_eq!(overturning_per_year(safe).to_bits(), number(&found["safe_risk"]["per_year"]).to_bits());
    assert!(overturning_per_year(safe) <= 2e-3);
    // with the bands that overturning has there
    study.write("other.toml", &frame(safe));
    let told = study.uplift(&["overturning", "other.toml", "--urs", "r.h5", "--json", "-q", "--no-keep"]).json();
    assert_eq!(found["safe_bands"], told["overturning"][0]["sites"][0]["bands"], "{told}");
    let ask = ["target", "frame.toml", "--urs", "r.h5", "--overturning", "2e-3", "--vary", "width"];
    let shown = study.uplift(&[&ask[..], &["--tolerance", "1e-3", "--proxy"]].concat()).ok().stdout;
    assert!(shown.starts_with(&format!("Safe width {safe} m; best estimate {value} m (")), "{shown}");
    let at = found["at_return_periods"].as_array().unwrap();
    assert!(number(&at[0]["probability"]) <= number(&at[1]["probability"]) && at[1]["records"] == 20, "{found}");
}

/// The capacity over a safety factor, which `uplift design` holds against the structure's own demand.
#[test]
fn a_safety_factor_sizes_what_a_design_then_passes() {
    let study = study();
    let ask = ["--exceed", "capacity", "--safety-factor", "2.5", "--poe", "10%", "--years", "50", "--vary", "width"];
    let found = json(&study, &[&ask[..], &["--tolerance", "0.02"]].concat());
    assert_eq!(found["event"], "exceeding the capacity divided by 2.5");
    let is_satisfied = |width_m: f64| {
        study.write("other.toml", &frame(width_m));
        let ask = ["design", "other.toml", "--urs", "r.h5", "--poe", "10%", "--proxy", "--json", "-q"];
        let told = study.uplift(&ask).json();
        let [required_m, capacity_m] =
            [&told["own_check"]["required_capacity_m"], &told["structure"]["capacity_m"]].map(number);
        assert_eq!(told["own_check"]["satisfied"], capacity_m >= required_m);
        assert!((required_m - 2.5 * number(&told["exact"]["demand_m"])).abs() < 1e-12);
        capacity_m >= required_m
    };
    assert!(is_satisfied(number(&found["value"])) && !is_satisfied(number(&found["missed_at"])));
    study
        .uplift(&[
            "target",
            "frame.toml",
            "--urs",
            "r.h5",
            "--vary",
            "width",
            "--overturning",
            "1e-3",
            "--safety-factor",
            "2",
        ])
        .fails(2, &["--safety-factor divides a capacity: give --exceed capacity"]);
}

/// A block is judged itself where its oscillator needs no more, by the rate that `uplift overturning` has, and the
/// value that it needs is told first.
#[test]
fn a_block_is_judged_itself() {
    let study = study();
    let block = |width_m: f64| format!("kind = \"block\"\nwidth_m = {width_m}\nheight_m = 2\nmass_kg = 100\n");
    study.write("block.toml", &block(0.4));
    let ask = ["target", "block.toml", "--urs", "r.h5", "--overturning", "2e-3", "--vary", "width"];
    let ask = [&ask[..], &["--tolerance", "0.02", "--no-keep"]].concat();
    let found = study.uplift(&[&ask[..], &["--json", "-q"]].concat()).json();
    let (own, safe) = (&found["own"], number(&found["safe_value"]));
    assert_eq!((number(&own["value"]), own["models"][0]["model"].as_str()), (safe, Some("block")));
    let overturning = |width_m: f64| {
        study.write("other.toml", &block(width_m));
        let told = study.uplift(&["overturning", "other.toml", "--urs", "r.h5", "--json", "-q", "--no-keep"]).json();
        let of_block = told["overturning"].as_array().unwrap().iter().find(|of| of["model"] == "block").unwrap();
        of_block["sites"][0].clone()
    };
    for tried in own["tried"].as_array().unwrap() {
        let told = overturning(number(&tried["value"]));
        assert_eq!(number(&tried["per_year"]).to_bits(), number(&told["per_year"]).to_bits());
        assert_eq!(tried["is_safe"], number(&tried["upper_per_year"]) <= 2e-3);
    }
    let needed = number(&own["safe_value"]);
    assert!(overturning(needed)["bands"]["by_record"][1].as_f64().unwrap() <= 2e-3);
    // that it needs less is found, too: just below, the block is not safe
    let missed = number(&own["missed_at"]);
    assert!(missed < needed && needed <= 1.03 * missed, "{own}");
    let shown = study.uplift(&ask).ok().stdout;
    let first = if own["models"][0]["is_safe"] == true {
        format!("Safe width: the block needs {needed} m (at most ")
    } else {
        format!("Safe width: the block needs {needed} m, its oscillator {safe} m; at {safe} m the block's rate")
    };
    assert!(shown.starts_with(&first), "{shown}");
    let size = [&ask[..4], &["--overturning", "1e-3", "--vary", "size", "--tolerance", "0.1", "--no-keep"]].concat();
    let size = study.uplift(&size).ok().stdout;
    assert!(size.contains("; the structure's size is 1.0198 m; multiply all lengths by "), "{size}");
    let alone = study.uplift(&[&ask[..], &["--proxy"]].concat()).ok().stdout;
    assert!(
        alone.lines().next().unwrap().ends_with(", by its oscillator alone") && !alone.contains("block, "),
        "{alone}"
    );
    // what is equivalent to a frame is judged as a design judges it
    study.write("frame.toml", &frame(0.6));
    let beyond = ["target", "frame.toml", "--urs", "r.h5", "--exceed", "capacity", "--per-year", "2e-3", "--json"];
    let beyond = study.uplift(&[&beyond[..], &["--vary", "width", "--tolerance", "0.02", "--no-keep"]].concat()).json();
    let own = &beyond["own"]["models"][0];
    study.write("frame.toml", &frame(number(&beyond["own"]["value"])));
    let design = study.uplift(&["design", "frame.toml", "--urs", "r.h5", "--json", "-q", "--no-keep"]).json();
    let of_design = &design["own"]["models"][0];
    assert_eq!((&own["model"], &of_design["model"]), (&"equivalent block".into(), &"equivalent block".into()));
    assert_eq!(own["risk"]["per_year"], of_design["beyond_capacity"]["per_year"]);
}

/// With the weights of a repair the search has the rates that `uplift overturning` has by them.
#[test]
fn a_repair_weighs_the_records_of_a_search() {
    let [pgv, pga] = ["pgv", "pga"].map(|key| crate::common::repository().join(format!("hazard/athens/{key}.csv")));
    let study = SmallStudy::with(&format!(
        "[strengths]\nvalues = [0.1, 0.3]\n[pgv]\nlevels_cm_s = [\"1:2:21\", \"25:20:205\"]\n[pga]\nlevels_g = \
         [\"0.01:0.03:0.31\", \"0.35:0.15:2.0\"]\n[hazard]\nconversions = [{{ from = \"GMRotI50\", to = \
         \"geometric mean\", pgv = 1.0, pga = 1.0 }}]\n[[sites]]\nname = \"Athens\"\npgv = '{}'\npga = '{}'\n",
        pgv.display(),
        pga.display()
    ));
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.write("frame.toml", &frame(0.6));
    let ask = ["target", "frame.toml", "--urs", "r.h5", "--overturning", "2e-4", "--vary", "width", "--measure", "pga"];
    let ask = [&ask[..], &["--tolerance", "0.02", "--no-keep"]].concat();
    let repaired = [&ask[..], &["--repaired"]].concat();
    study.uplift(&repaired).fails(2, &["--repaired: the result has no repaired spectrum of Athens by PGA: `uplift"]);
    study.uplift(&["consistency", "r.h5", "--repair", "-q"]).ok();
    let found = study.uplift(&[&repaired[..], &["--json", "-q"]].concat()).json();
    assert_eq!(found["repaired"], true);
    let plain = study.uplift(&[&ask[..], &["--json", "-q"]].concat()).json();
    assert!(found["value"] != plain["value"] && plain["repaired"] == false, "{plain}");
    for measure in ["pga", "pgv"] {
        let told = if measure == "pga" { &found["risk"] } else { &found["by_other_measures"][0] };
        let at = if measure == "pga" { &found["value"] } else { &found["safe_value"] };
        study.write("other.toml", &frame(number(at)));
        let run = ["overturning", "other.toml", "--urs", "r.h5", "--json", "-q", "--no-keep", "--measure", measure];
        let site = study.uplift(&run).json()["overturning"][0]["sites"][0].clone();
        assert_eq!(number(&told["per_year"]).to_bits(), number(&site["repaired"]["per_year"]).to_bits(), "{site}");
    }
    let [lower, upper] = [0, 1].map(|end| number(&found["bands"][0]["value"][end]));
    let safe = number(&found["safe_value"]);
    assert!(lower < number(&found["value"]) && upper < safe, "{found}");
    // that value alone has a band that meets the target, and the last one tried before it has not
    let values = found["tried"].as_array().unwrap().iter().map(|tried| number(&tried["value"]));
    let before = values.filter(|value| *value < safe).fold(0.0, f64::max);
    let [missed, met] = [before, safe].map(|width_m| {
        study.write("other.toml", &frame(width_m));
        let run = ["overturning", "other.toml", "--urs", "r.h5", "--json", "-q", "--no-keep", "--measure", "pga"];
        let site = study.uplift(&run).json()["overturning"][0]["sites"][0].clone();
        number(&site["repaired_bands"]["by_record"][1])
    });
    assert!(missed > 2e-4 && met <= 2e-4, "{missed} {met}");
    let shown = study.uplift(&repaired).ok().stdout;
    assert!(shown.contains("\nAt        Athens by PGA, repaired; ") && !shown.contains("Weights"), "{shown}");
    let shown = study.uplift(&ask).ok().stdout;
    assert!(shown.contains(" times the site's PGV: --repaired searches by the repair's weights\n"), "{shown}");
}

/// The other measure has its own word on the safe value, which is that of `uplift overturning`.
#[test]
fn the_other_measure_judges_the_safe_value() {
    let both = STUDY
        .replace("[pga]", "[pgv]\nlevels_cm_s = [3, 10, 30, 60, 100, 200]\n[pga]")
        .replace("pga = \"pga.csv\"", "pga = \"pga.csv\"\npgv = \"here-pgv.csv\"");
    let study = SmallStudy::with(&both);
    study.write("frame.toml", &format!("{}restitution = 0.9\n", frame(0.6)));
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let ask = ["--overturning", "2e-3", "--vary", "width", "--tolerance", "0.05", "--measure", "pga"];
    let found = json(&study, &ask);
    let [other] = &found["by_other_measures"].as_array().unwrap()[..] else { panic!("{found}") };
    let safe = number(&found["safe_value"]);
    study.write("other.toml", &format!("{}restitution = 0.9\n", frame(safe)));
    let run = ["overturning", "other.toml", "--urs", "r.h5", "--json", "-q", "--measure", "pgv"];
    let told = study.uplift(&run).json();
    let per_year = number(&told["overturning"][0]["sites"][0]["per_year"]);
    assert_eq!((other["im"].as_str(), number(&other["per_year"]).to_bits()), (Some("PGV"), per_year.to_bits()));
    assert_eq!(other["is_met"], per_year <= 2e-3);
    let shown = study.uplift(&[&["target", "frame.toml", "--urs", "r.h5"], &ask[..]].concat()).ok().stdout;
    let verdict = if per_year <= 2e-3 { "meets" } else { "MISSES" };
    assert!(shown.contains(&format!(" per year at {safe} m: {verdict} the target\n")), "{shown}");
    assert!(
        shown.contains("\nAssumed   uplift displacement 0.5 mm, restitution 0.9, column mass 1000 kg at every width: "),
        "{shown}"
    );
    assert!(number(&other["per_year"]) > 0.0);
    // levels that end far below what overturns the frame cannot tell
    let low = both.replace("levels_cm_s = [3, 10, 30, 60, 100, 200]", "levels_cm_s = [0.6, 0.8, 1]");
    study.write("low.toml", &low);
    study.uplift(&["run", "low.toml", "-o", "low.h5", "-q"]).ok();
    let ask = [&["target", "frame.toml", "--urs", "low.h5", "--json"], &ask[..]].concat();
    let low = study.uplift(&ask).json();
    assert!(low["by_other_measures"][0]["is_met"].is_null(), "{low}");
    assert_eq!(low["safe_value"], found["safe_value"]);
    // and leaves nothing behind
    let left = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
    let files: Vec<String> = std::fs::read_dir(study.path()).unwrap().map(left).collect();
    assert!(!files.iter().any(|name| name.contains("target")), "{files:?}");
}

#[test]
#[ignore = "long: make test-long"]
fn any_number_of_threads_gives_the_same_answer() {
    let study = study();
    let ask = ["target", "frame.toml", "--urs", "r.h5", "--overturning", "5e-4", "--vary", "size", "--json", "-q"];
    let one = study.uplift(&[&ask[..], &["--threads", "1"]].concat()).ok().stdout;
    assert_eq!(study.uplift(&[&ask[..], &["--threads", "3"]].concat()).ok().stdout, one);
}

// A ground that sets off for good with an acceleration a overturns whatever is weaker than a/g, but for what it stores
// on its way to uplift: √(u_up/u_cap) of the strength, 0.1 % here. From levels of 0.12 to 0.3 g on, two of three do it.
#[test]
fn a_strength_known_by_hand() {
    let folder = SmallStudy::with(
        "title = \"steps\"\n[records]\nmanifest = \"manifest.csv\"\nduplicates = \"keep\"\n[strengths]\n\
         values = [0.1, 0.2]\n[pga]\n\
         levels_g = [0.05, 0.12, 0.3, 0.8]\n[[sites]]\nname = \"Here\"\npga = \"pga.csv\"\n",
    );
    let samples =
        |jerk: bool| -> String { (0..1500).map(|sample| if !jerk || sample == 2 { "1\n" } else { "0\n" }).collect() };
    folder.write("step.txt", &samples(false));
    folder.write("jerk.txt", &samples(true));
    let row = |id: &str, file: &str| format!("{id},{file},{file},0.01,m/s2\n");
    let rows = [row("A", "step.txt"), row("B", "jerk.txt"), row("C", "step.txt")].concat();
    folder.write("manifest.csv", &format!("record_id,file_h1,file_h2,dt_s,unit\n{rows}"));
    folder.write(
        "mast.toml",
        "kind = \"point-mass\"\nwidth_m = 1\ncentre_height_m = 2.5\nmass_kg = 1\nuplift_displacement_m = 1e-6\n",
    );
    folder.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let rate = |level: f64| 1e-4 * f64::powf(level, -2.2);
    // with 0.3 g and 0.8 g that overturn, and with 0.8 g alone
    let [many, few] = [
        (0.5 * (rate(0.12) - rate(0.3)) + rate(0.3)) * 2.0 / 3.0,
        (0.5 * (rate(0.3) - rate(0.8)) + rate(0.8)) * 2.0 / 3.0,
    ];
    let target = format!("{}", 0.5 * (many + few));
    let ask = ["target", "mast.toml", "--urs", "r.h5", "--vary", "strength", "--tolerance", "1e-4"];
    let run = folder.uplift(&[&ask[..], &["--overturning", &target, "--json", "-q"]].concat()).ok();
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    assert!((number(&found["value"]) / 0.3 - 1.0).abs() < 3e-3, "{found}");
    assert!((number(&found["risk"]["per_year"]) / few - 1.0).abs() < 1e-9, "{found}");
    assert_eq!(found["crossings"].as_array().unwrap().len(), 1);
}

#[test]
fn an_unreachable_target_is_reported() {
    let study = study();
    let ask = |more: &[&str]| study.uplift(&[&["target", "frame.toml", "--urs", "r.h5"], more].concat());
    ask(&["--overturning", "1e-9", "--vary", "width"]).fails(2, &["too rare for these levels", "pga.levels_g"]);
    ask(&["--overturning", "10", "--vary", "width"]).fails(2, &["met at every width", "--from"]);
    ask(&["--overturning", "2e-3", "--vary", "width", "--to", "0.2"]).fails(2, &["missed at every width", "--to"]);
    ask(&["--overturning", "2e-3", "--vary", "tendon-stiffness"])
        .fails(2, &["kind \"frame\" has no tendons: vary strength"]);
    ask(&["--vary", "width"]).fails(2, &["--overturning"]);
    let period = ["--overturning", "20000", "--vary", "width"];
    ask(&period).fails(2, &["a rate per year: 5e-5 is once in 20,000 years"]);
    ask(&["--overturning", "1/20000", "--vary", "width"]).fails(2, &["write a number, 5e-5"]);
    ask(&["--overturning", "-1", "--vary", "width", "--tolerance", "7"]).fails(2, &["2 problems", "--tolerance"]);
    ask(&["--per-year", "1e-3", "--exceed", "x", "--vary", "width"]).fails(2, &["'x' for '--exceed", "or `capacity`"]);
    ask(&["--overturning", "2e-3", "--vary", "width", "--site", "Nowhere"])
        .fails(2, &["the result has no site Nowhere: it has Here"]);
}

#[test]
#[ignore = "long: make test-long"]
fn capacity_is_exceeded_more_often_than_the_frame_overturns() {
    let study = study();
    let value = |more: &[&str]| number(&json(&study, more)["value"]);
    let capacity = value(&["--exceed", "capacity", "--per-year", "2e-3", "--vary", "width"]);
    let overturning = value(&["--overturning", "2e-3", "--vary", "width"]);
    assert!(capacity >= overturning, "{capacity} {overturning}");
    // beyond so many metres: the width that it takes is that at which the frequency of so many is the target
    let beyond = json(&study, &["--exceed", "0.3", "--per-year", "2e-3", "--vary", "width"]);
    assert!(number(&beyond["risk"]["per_year"]) <= 2e-3);
    // what may be a mistake is said before the answer
    let ask = ["target", "frame.toml", "--urs", "r.h5", "--exceed", "50", "--per-year", "2e-3", "--vary", "width"];
    let doubted = study.uplift(&ask).ok().stdout;
    assert!(doubted.starts_with("Subject to the mistake? below, safe width"), "{doubted}");
}

#[test]
#[ignore = "long: make test-long"]
fn stripes_are_kept_until_the_answer_is_there() {
    let study = study();
    let ask = ["target", "frame.toml", "--urs", "r.h5", "--overturning", "2e-3", "--vary", "width", "--json"];
    let whole = study.uplift(&ask).ok().stdout;
    let checkpoint = study.path().join("r.h5.target-frame.part");
    assert!(!checkpoint.exists());
    // where no checkpoint can be written it goes on without
    std::fs::create_dir(&checkpoint).unwrap();
    let done = study.uplift(&ask).ok();
    assert!(done.stderr.contains("no checkpoint can be written (") && done.stdout == whole, "{}", done.stderr);
    std::fs::remove_dir(&checkpoint).unwrap();
    // the table has a row for every value tried, of oscillator and block, and replaces nothing of another kind
    study.write("mine.csv", "a,b\n1,2\n");
    study.uplift(&[&ask[..], &["-o", "mine.csv"]].concat()).fails(2, &["mine.csv already exists"]);
    study.uplift(&[&ask[..], &["-o", "tried.csv", "-q"]].concat()).ok();
    let table = std::fs::read_to_string(study.path().join("tried.csv")).unwrap();
    let found: Value = serde_json::from_str(&whole).unwrap();
    let rows = |model: &str| table.lines().filter(|line| line.starts_with(&format!("width,m,{model},"))).count();
    let tried = [&found["tried"], &found["own"]["tried"]].map(|tried| tried.as_array().unwrap().len());
    assert_eq!([rows("oscillator"), rows("equivalent block")], tried);
    assert_eq!(table.lines().count(), 1 + tried.iter().sum::<usize>());
}

#[cfg(unix)]
#[test]
#[ignore = "long: make test-long"]
fn ctrl_c_leaves_a_checkpoint() {
    let study = study();
    study.uplift(&["records", "synthesize", "-o", "many", "--count", "60", "-q"]).ok();
    study.uplift(&["records", "import", "many", "-o", "many.csv", "-q"]).ok();
    study.write(
        "many.toml",
        &STUDY.replace("[records.synthetic]\npairs = 20\n", "[records]\nmanifest = \"many.csv\"\n"),
    );
    study.uplift(&["run", "many.toml", "-o", "m.h5", "-q"]).ok();
    let ask = ["target", "frame.toml", "--urs", "m.h5", "--overturning", "2e-3", "--vary", "width", "--json"];
    let mut running = study.start(&[&ask[..], &["--threads", "1"]].concat());
    let checkpoint = study.path().join("m.h5.target-frame.part");
    running.wait_until("rows are in the checkpoint", || {
        std::fs::metadata(&checkpoint).is_ok_and(|file| file.len() > 20_000)
    });
    running.interrupt();
    running.end().fails(5, &["are in the checkpoint", "m.h5.target-frame.part"]);
    let resumed = study.uplift(&ask).ok();
    assert!(resumed.stderr.contains("analyses resumed"), "{}", resumed.stderr);
    assert!(!checkpoint.exists());
    assert_eq!(resumed.stdout, study.uplift(&ask).ok().stdout);
}

#[test]
fn a_refusal_leaves_nothing_behind_and_says_what_is_probably_mistaken() {
    let study = study();
    // columns of a kilogram
    study.write("frame.toml", &frame(40.0).replace("column_mass_kg = 1000", "column_mass_kg = 1"));
    let ask =
        |more: &[&str]| study.uplift(&[&["target", "frame.toml", "--urs", "r.h5", "--vary", "width"], more].concat());
    let told = ask(&["--overturning", "2e-3", "--from", "40", "--to", "60"])
        .fails(2, &["met at every width", "less than", "mistake? ", "column_mass_kg over width²"]);
    assert!(!told.stderr.contains("0.000e0"), "{}", told.stderr);
    ask(&["--overturning", "2e-3", "--to", "0.2", "--from", "0.1"]).fails(2, &["missed at every width"]);
    let left = std::fs::read_dir(study.path()).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
    let left: Vec<String> = left.filter(|name| name.contains(".part")).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn what_the_result_was_made_from_is_never_replaced() {
    let study = study();
    let curve = std::fs::read(study.path().join("pga.csv")).unwrap();
    for (command, more) in [("target", &["--vary", "width", "--overturning", "2e-3"][..]), ("overturning", &[])] {
        let ask = [&[command, "frame.toml", "--urs", "r.h5", "-o", "pga.csv", "--force"], more].concat();
        study.uplift(&ask).fails(2, &["pga.csv would overwrite an input"]);
    }
    assert_eq!(std::fs::read(study.path().join("pga.csv")).unwrap(), curve);
}

// A frame on cylinders wobbles: by its oscillator alone what is found is the width of its oscillator.
#[test]
fn by_its_proxy_a_frame_is_not_shaken() {
    let study = study();
    let ask = |text: &str, more: &[&str]| {
        study.write("frame.toml", text);
        let ask = ["target", "frame.toml", "--urs", "r.h5", "--overturning", "2e-3", "--tolerance", "0.05"];
        study.uplift(&[&ask[..], more].concat()).ok().stdout
    };
    let wobbles = format!("{}column_shape = \"cylinder\"\n", frame(0.6));
    assert!(ask(&frame(0.6), &["--vary", "width"]).lines().next().unwrap().contains(" equivalent block "));
    let alone = ask(&wobbles, &["--vary", "width", "--proxy"]);
    assert!(
        alone.lines().next().unwrap().ends_with(", by its oscillator alone") && !alone.contains("wobbl"),
        "{alone}"
    );
    // the strength of columns follows from their size
    let strength = ask(&wobbles, &["--vary", "strength"]);
    assert!(
        strength.contains("by its oscillator alone")
            && strength.contains("Itself    not analysed: strength and capacity follow"),
        "{strength}"
    );
}

// The frame of the width found is that of a file with this width, and safe there it needs no other.
#[test]
#[ignore = "long: make test-long"]
fn the_width_of_a_frame_is_judged_by_the_wobbling_frame() {
    let study = study();
    let wobbles = |width_m: f64| format!("{}column_shape = \"cylinder\"\n", frame(width_m));
    study.write("frame.toml", &wobbles(0.6));
    let found = json(&study, &["--overturning", "5e-4", "--vary", "width", "--tolerance", "0.05"]);
    let own = &found["own"];
    assert_eq!((&found["by_proxy"], &own["value"]), (&Value::from(false), &found["safe_value"]));
    study.write("other.toml", &wobbles(number(&own["value"])));
    let run = study.uplift(&["overturning", "other.toml", "--urs", "r.h5", "--json", "-q"]).ok();
    let written: Value = serde_json::from_str(&run.stdout).unwrap();
    for (place, name) in ["wobbling frame", "planar frame"].into_iter().enumerate() {
        let (model, written) = (&own["models"][place], &written["overturning"][place + 1]);
        assert_eq!((&model["model"], &written["model"]), (&Value::from(name), &Value::from(name)));
        assert_eq!(model["risk"]["per_year"], written["sites"][0]["per_year"], "{name}");
        assert_eq!(model["bands"], written["sites"][0]["bands"], "{name}");
        assert_eq!((&model["is_met"], &model["is_safe"]), (&Value::from(true), &Value::from(true)), "{name}");
    }
    assert_eq!((&own["safe_value"], own["tried"].as_array().unwrap().len()), (&own["value"], 1));
}

// Under both components and without loss a frame goes further than its proxy: it needs a larger width.
#[test]
#[ignore = "long: make test-long"]
fn the_wobbling_frame_needs_more_than_its_proxy() {
    let study = study();
    study.write("frame.toml", &format!("{}column_shape = \"cylinder\"\n", frame(0.6)));
    let ask = ["--exceed", "0.1", "--per-year", "2e-3", "--vary", "width", "--tolerance", "0.1"];
    let found = json(&study, &ask);
    let own = &found["own"];
    let [proxy, safe, missed] =
        [&found["safe_value"], &own["safe_value"], &own["missed_at"]].map(|value| value.as_f64().unwrap());
    assert!(proxy <= missed && missed < safe && safe <= 1.101 * missed, "{own}");
    let tried = own["tried"].as_array().unwrap();
    assert!((2..=8).contains(&tried.len()), "{own}");
    for of in tried {
        assert_eq!(of["is_safe"], number(&of["upper_per_year"]) <= 2e-3, "{of}");
        assert!(number(&of["value"]) < safe || of["is_safe"] == true, "{own}");
    }
    let frame = &own["models"][0];
    assert_eq!((&frame["is_met"], &frame["risk"]["per_year"]), (&Value::from(true), &tried[0]["per_year"]));
    let said = study.uplift(&[&["target", "frame.toml", "--urs", "r.h5", "--details"], &ask[..]].concat()).ok().stdout;
    let first = format!(
        "Safe width: the wobbling frame needs {safe} m, its oscillator {proxy} m; at {proxy} m the wobbling frame's \
         rate meets the target, its upper limit does not\n"
    );
    assert!(said.starts_with(&first) && said.contains("met, not safe") && said.contains("at other values"), "{said}");
}
