//! What a structure was asked under a result is kept in it: once a question, told again by report, status and export.

use serde_json::Value;
use uplift_labelled::LabelledReader;

use crate::common::{Finished, SmallStudy};

const STUDY: &str = r#"title = "kept"
[records.synthetic]
pairs = 6
[strengths]
values = [0.05, 0.1, 0.2, 0.4]
[pgv]
levels_cm_s = [1, 3, 10, 30, 60, 100, 200]
[[sites]]
name = "Here"
pgv = "here-pgv.csv"
[[sites]]
name = "There"
pgv = { file = "there-pgv.csv", unit = "m/s", kind = "poe", years = 50 }
"#;
const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n";
/// Every command that asks a structure something.
const QUESTIONS: [&str; 4] = [
    "design block.toml --urs r.h5 --site Here",
    "overturning block.toml --urs r.h5",
    "target block.toml --urs r.h5 --site Here --vary size --from 0.1 --to 2 --overturning 2e-4",
    "risk block.toml --urs r.h5 --site Here",
];

fn study() -> SmallStudy {
    let study = SmallStudy::with(STUDY);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.write("block.toml", BLOCK);
    study
}

fn ask(study: &SmallStudy, command: &str) -> Finished {
    study.uplift(&command.split(' ').collect::<Vec<_>>()).ok()
}

/// The places of all answers about `block` to `command`.
fn kept(study: &SmallStudy, command: &str) -> Vec<String> {
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let group = format!("/structures/block/{command}");
    if !reader.exists(&group) {
        return Vec::new();
    }
    reader.children(&group).unwrap().iter().map(|key| format!("{group}/{key}")).collect()
}

#[test]
#[ignore = "long: make test-long"]
fn a_question_has_one_answer() {
    let study = study();
    for question in QUESTIONS {
        let command = question.split(' ').next().unwrap();
        let first = ask(&study, &format!("{question} --json"));
        let [place] = &kept(&study, command)[..] else { panic!("{question}") };
        assert!(first.stderr.contains("kept     in r.h5"), "{}", first.stderr);
        let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
        // the document is the printed one
        let document: Value = serde_json::from_str(&reader.attribute::<String>(place, "document").unwrap()).unwrap();
        assert_eq!(document, serde_json::from_str::<Value>(&first.stdout).unwrap());
        drop(reader);
        // the same by another number of threads, and in other words
        let again = ask(&study, &format!("{question} --json --threads 1"));
        assert_eq!(again.stdout, first.stdout);
        assert_eq!(kept(&study, command), [place.as_str()]);
    }
    ask(&study, "design block.toml --urs r.h5 --site There");
    assert_eq!(kept(&study, "design").len(), 2);
    ask(&study, "design block.toml --urs r.h5 --site There --safety-factor 3");
    assert_eq!(kept(&study, "design").len(), 3);
    ask(&study, "design block.toml --urs r.h5 --site There --safety-factor 4 --no-keep");
    assert_eq!(kept(&study, "design").len(), 3);
    ask(&study, "overturning block.toml --urs r.h5 --site Here");
    assert_eq!((kept(&study, "overturning").len(), kept(&study, "target").len()), (2, 1));
    // of the oscillator alone it is another question
    for question in &QUESTIONS[1..3] {
        ask(&study, &format!("{question} --proxy"));
    }
    assert_eq!((kept(&study, "overturning").len(), kept(&study, "target").len()), (3, 2));
    ask(&study, "verify r.h5");
}

/// What neighbouring strengths make of a design costs most of it, and the answer without details does not show it.
#[test]
fn a_design_analyses_neighbours_where_they_are_shown() {
    let study = study();
    let plain = ask(&study, "design block.toml --urs r.h5 --site There");
    let [place] = &kept(&study, "design")[..] else { panic!() };
    let document = || -> Value {
        let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
        serde_json::from_str(&reader.attribute::<String>(place, "document").unwrap()).unwrap()
    };
    let without = document();
    let shown = ask(&study, "design block.toml --urs r.h5 --site There --details").stdout;
    assert!(shown.starts_with(plain.stdout.split("\nDetails").next().unwrap().split("\nWarnings").next().unwrap()));
    assert!(shown.contains("within 1 % of the strength"), "{shown}");
    let mut with = document();
    let exact = with["exact"].as_object_mut().unwrap();
    assert!(exact.remove("rounding").is_some() && exact.remove("within_one_percent_of_strength").is_some());
    // ten strengths beside its own with two oscillators each, and eight roundings of all three
    let analyses = |of: &Value| of["exact"]["analyses"].as_u64().unwrap();
    assert_eq!(analyses(&with), analyses(&without) / 3 * 47);
    with["exact"]["analyses"] = without["exact"]["analyses"].clone();
    assert_eq!(with, without);
}

#[test]
fn a_changed_structure_is_reported() {
    let study = study();
    ask(&study, QUESTIONS[0]);
    ask(&study, "design block.toml --urs r.h5 --site There");
    let before = kept(&study, "design");
    study.write("block.toml", &BLOCK.replace("0.8", "0.9"));
    let asked = ask(&study, QUESTIONS[0]);
    assert!(asked.stderr.contains("block.toml has changed: this answer replaces"), "{}", asked.stderr);
    assert!(asked.stderr.contains("keeps 1 answer") && asked.stderr.contains("site There"), "{}", asked.stderr);
    assert_eq!(kept(&study, "design"), before);
    let said = study.uplift(&["status", "r.h5"]).ok().stdout;
    let lines: Vec<&str> = said.lines().filter(|line| line.contains("  block: design, ")).collect();
    assert_eq!((lines.len(), said.matches("\n  answers  block: ").count()), (2, 1), "{said}");
    for line in lines {
        assert_eq!(line.contains("its file has changed since"), line.contains("site There"), "{line}");
    }
    let again = ask(&study, "design block.toml --urs r.h5 --site There");
    assert!(again.stderr.contains("has changed: this answer") && !again.stderr.contains("keeps"), "{}", again.stderr);
    assert!(!study.uplift(&["status", "r.h5"]).ok().stdout.contains("changed since"));
}

#[test]
fn a_result_that_may_not_be_written_keeps_nothing_and_answers_all_the_same() {
    let study = study();
    let writable = ask(&study, &format!("{} --no-keep", QUESTIONS[0]));
    let path = study.path().join("r.h5");
    let bytes = std::fs::read(&path).unwrap();
    let mut permissions = std::fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).unwrap();
    let asked = ask(&study, QUESTIONS[0]);
    assert!(
        asked.stderr.contains("note: the answer is not kept in r.h5: it may not be written to"),
        "{}",
        asked.stderr
    );
    assert_eq!(asked.stdout, writable.stdout);
    assert!(!writable.stderr.contains("kept"), "{}", writable.stderr);
    assert_eq!(std::fs::read(&path).unwrap(), bytes);
}

/// The numbers that a command prints, as every other place has them.
#[test]
#[ignore = "long: make test-long"]
fn report_and_exports_tell_what_was_printed() {
    let study = study();
    study.uplift(&["export", "r.h5", "--csv", "--json", "--mat", "--xlsx", "-q"]).ok();
    let text = |name: &str| std::fs::read_to_string(study.path().join(name)).unwrap();
    assert!(!study.path().join("r.structures.csv").exists() && !text("r.json").contains("\"structures\""));
    let printed: Vec<Finished> =
        QUESTIONS.iter().map(|question| ask(&study, &format!("{question} --details"))).collect();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    study.uplift(&["export", "r.h5", "--csv", "--json", "--mat", "--xlsx", "-q"]).ok();
    let (page, json): (String, Value) = (text("r.html"), serde_json::from_str(&text("r.json")).unwrap());
    let answers = json["structures"].as_array().unwrap();
    assert_eq!(answers.len(), QUESTIONS.len());
    let commands: Vec<&str> = answers.iter().map(|answer| answer["command"].as_str().unwrap()).collect();
    assert_eq!(commands, ["design", "overturning", "target", "risk"]);
    assert!(page.contains("<h3 class=\"part\" id=\"r1-structures-title\">Structures</h3>"));
    assert!(page.contains("<h4>block</h4>") && page.contains("aria-label=\"The structure") || page.contains("<svg"));
    let row = |answer: &Value, quantity: &str| -> Value {
        let rows = answer["rows"].as_array().unwrap();
        rows.iter().find(|row| row["quantity"] == quantity).unwrap_or_else(|| panic!("{quantity}: {rows:#?}")).clone()
    };
    let table = text("r.structures.csv");
    let mut told = 0;
    // what the table of the page shows stands in the printed answer, and the export has it in full
    for (answer, printed) in answers.iter().zip(&printed) {
        for row in answer["rows"].as_array().unwrap() {
            let Some(value) = row["value"].as_f64() else { continue };
            assert!(table.contains(&format!(",{value}")) || value.abs() < 1e-4 || value.fract() == 0.0, "{row}");
            let quantity = row["quantity"].as_str().unwrap();
            let shown = match row["unit"].as_str().unwrap() {
                "m" if !quantity.contains("size") => format!("{value:.4}"),
                "1/yr" if value > 0.0 => format!("{value:.1e}"),
                _ => continue,
            };
            assert!(page.contains(&format!("<td class=\"number\">{shown}</td>")), "{quantity}: {shown}");
            assert!(printed.stdout.contains(&shown), "{quantity}: {shown} is not in\n{}", printed.stdout);
            told += 1;
        }
    }
    assert!(told > 20, "{told}");
    let [design, overturning, target, risk] = answers.as_slice() else { panic!() };
    let exact = &design["document"]["exact"];
    assert_eq!(row(design, "demand, oscillator")["value"], exact["demand_m"]);
    assert_eq!(row(design, "overturning, oscillator")["value"], exact["overturning"]["per_year"]);
    assert_eq!(row(design, "overturning, oscillator")["lower"], exact["bands"]["overturning_per_year"]["by_record"][0]);
    let block = &overturning["document"]["overturning"][1];
    assert_eq!(row(overturning, "overturning, block")["value"], block["sites"][0]["per_year"]);
    let least = row(target, "least size that meets the target");
    assert_eq!(least["value"], target["document"]["value"]);
    assert_eq!([&least["lower"], &least["upper"]], [0, 1].map(|limit| &target["document"]["bands"][0]["value"][limit]));
    assert_eq!(row(risk, "demand, planar frame")["value"], risk["document"]["demands"][0]["demand_m"]["value"]);
    // and where there are thousands of bytes
    let mat = std::fs::read(study.path().join("r.mat")).unwrap();
    assert!(mat.windows(13).any(|bytes| bytes == b"finding_value"));
    let said = study.uplift(&["table", "r.h5"]).ok();
    assert!(said.stderr.contains("asked    4 answers for block"), "{}", said.stderr);
}

/// A search among uncertain structures keeps the bands with structures drawn, beside the narrower one of the records.
#[test]
#[ignore = "long: make test-long"]
fn a_target_of_uncertain_structures_keeps_every_band() {
    let study = study();
    let uncertainty = "[uncertainty]\nsamples = 8\n[uncertainty.strength]\ndistribution = \"lognormal\"\n\
                       coefficient_of_variation = 0.1\n";
    study.write("block.toml", &format!("{BLOCK}{uncertainty}"));
    ask(&study, &format!("{} --tolerance 0.05", QUESTIONS[2]));
    study.uplift(&["export", "r.h5", "--json", "-q"]).ok();
    let text = std::fs::read_to_string(study.path().join("r.json")).unwrap();
    let answer = serde_json::from_str::<Value>(&text).unwrap()["structures"][0].clone();
    let bands = answer["document"]["bands"].as_array().unwrap();
    let of: Vec<&str> = bands.iter().map(|band| band["of"].as_str().unwrap()).collect();
    assert_eq!(of, ["records", "structure and records"]);
    for (quantity, of) in
        [("least size that meets the target", "value"), ("overturning at the value found", "per_year")]
    {
        let rows: Vec<&Value> =
            answer["rows"].as_array().unwrap().iter().filter(|row| row["quantity"] == quantity).collect();
        for (row, band) in rows.iter().zip(bands) {
            assert_eq!([&row["lower"], &row["upper"]], [&band[of][0], &band[of][1]], "{row}");
            assert_eq!(row["band"], band["of"]);
        }
        // the value that each branch needs has percentiles too
        let by_structure = &answer["document"]["uncertainty"]["by_structure"];
        assert_eq!(rows.len(), if of == "value" { 3 } else { 2 }, "{answer:#}");
        if let Some(row) = rows.get(2) {
            assert_eq!((&row["lower"], &row["upper"]), (&by_structure[0], &by_structure[2]));
            assert_eq!(row["band"], "structure");
        }
    }
}

#[test]
fn answers_are_sealed_and_go_with_their_result() {
    let study = study();
    ask(&study, QUESTIONS[0]);
    let path = study.path().join("r.h5");
    let sound = std::fs::read(&path).unwrap();
    let words = b"required_safety_factor";
    let at = sound.windows(words.len()).position(|bytes| bytes == words).unwrap();
    let mut damaged = sound.clone();
    damaged[at] ^= 1;
    std::fs::write(&path, damaged).unwrap();
    study.uplift(&["verify", "r.h5"]).fails(4, &["r.h5"]);
    std::fs::write(&path, &sound).unwrap();
    ask(&study, "verify r.h5");
    // another result in its place: the answers are of the earlier one, which is kept with them
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5", "--force", "--set", "records.synthetic.pairs=7"]).ok();
    assert!(run.stderr.contains("earlier result"), "{}", run.stderr);
    assert_eq!(kept(&study, "design"), Vec::<String>::new());
    let earlier = std::fs::read_dir(study.path().join("r.earlier")).unwrap().next().unwrap().unwrap().path();
    assert!(LabelledReader::open(&earlier.join("r.h5")).unwrap().exists("/structures/block/design"));
}

/// 475 years are 9.991 % in 50 years: nobody asked for `poe 0.0999…`.
#[test]
fn a_return_period_is_reported_as_given() {
    let study = study();
    ask(&study, "design block.toml --urs r.h5 --site Here --return-period 475 --spectrum-only");
    ask(&study, "target block.toml --urs r.h5 --site Here --vary size --from 0.1 --to 2 --return-period 4750");
    let told = ask(&study, "status r.h5").stdout;
    let asked: Vec<&str> = told.lines().filter(|line| line.contains("  block: ")).collect();
    assert!(asked[0].contains(", 475 years (") && !asked[0].contains("poe"), "{told}");
    assert!(asked[1].contains(", per year 2.105e-4,"), "{told}");
    ask(&study, "report r.h5 -o page.html -q");
    let page = std::fs::read_to_string(study.path().join("page.html")).unwrap();
    assert!(page.contains("475 years (") && !page.contains("poe 0.0"), "475 years");
}

/// `uplift design` and `uplift risk` are of one risk, and their help says so.
#[test]
fn what_takes_one_risk_says_so() {
    let study = SmallStudy::new();
    for command in ["design", "risk"] {
        let help = ask(&study, &format!("{command} --help")).stdout;
        assert!(help.contains("--poe <P>") && help.contains("--return-period <YEARS>"), "{help}");
        let several = [command, "block.toml", "--urs", "r.h5", "--poe", "0.1,0.02"];
        study.uplift(&several).fails(2, &["--poe <P>", "0.1,0.02"]);
    }
}
