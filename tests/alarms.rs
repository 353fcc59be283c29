//! What an engineer would raise: the same list in the summary of a run, the table, the page, an export and a design.

use std::io::Read;
use std::path::Path;

use serde_json::Value;
use uplift::result::ResultFile;

use crate::common::{SMALL_STUDY, SmallStudy, repository};

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 6000\n";

/// A hazard curve as a file.
fn curve(levels: &[f64], rate: impl Fn(f64) -> f64) -> String {
    let rows: Vec<String> = levels.iter().map(|&level| format!("{level},{:e}\n", rate(level))).collect();
    format!("iml,maf\n{}", rows.concat())
}

/// Two sites, one of which has a hazard curve of PGV that belongs to a hundredth of the shaking by PGA.
fn study() -> SmallStudy {
    let study = SmallStudy::new();
    study.write("here-pgv.csv", &curve(&[0.5, 2.0, 20.0, 300.0], |v| 0.002 / (v * v)));
    study.write("block.toml", BLOCK);
    study
}

fn json(study: &SmallStudy, arguments: &[&str]) -> Value {
    study.uplift(arguments).json()
}

/// The alarm of one kind.
fn alarm<'a>(found: &'a Value, kind: &str) -> &'a Value {
    let alarms = found["alarms"].as_array().unwrap();
    alarms.iter().find(|alarm| alarm["kind"] == kind).unwrap_or_else(|| panic!("no {kind}: {alarms:#?}"))
}

/// Whether an alarm of one kind is there.
fn raised(found: &Value, kind: &str) -> bool {
    found["alarms"].as_array().unwrap().iter().any(|alarm| alarm["kind"] == kind)
}

/// What is raised about the fitted curves.
const FIT: [&str; 3] = ["fit-leaves-spectrum", "no-fit", "no-exponential"];

fn text<'a>(alarm: &'a Value, key: &str) -> &'a str {
    alarm[key].as_str().unwrap()
}

#[test]
fn every_face_says_the_same() {
    let study = study();
    let run = json(&study, &["run", "study.toml", "-o", "r.h5", "--json"]);
    let apart = alarm(&run, "curves-disagree");
    assert!(text(apart, "subject").starts_with("Here"), "{apart}");
    let what = text(apart, "what");
    assert!(
        what.starts_with("its curve of PGA is ") && what.contains(" times too high for its curve of PGV"),
        "{apart}"
    );
    assert!(text(apart, "what_to_do").starts_with("Check both curves: "), "{apart}");
    // the curves explain it at the other site
    let of_measures = alarm(&run, "measures-disagree");
    let of_here = serde_json::json!([of_measures["subject"], of_measures["also"]]).to_string().contains("Here");
    assert!(!of_here && text(of_measures, "subject").starts_with("There"), "{of_measures}");
    // the levels of PGA end at 1 g, which is exceeded a quarter as often as the target of 2 %
    let beyond = alarm(&run, "beyond-last-level");
    let words = "displacements may be too small (13.2 % of the risk above 1 g)";
    assert!(text(beyond, "what").contains(words), "{beyond}");
    assert!(text(beyond, "what_to_do").contains("pga.levels_g to 3"));
    // and the curve of PGV begins with 0.008 a year, below the target of 50 %
    let zero = alarm(&run, "no-exceedance");
    assert!(text(zero, "subject") == "Here, PGV, 50 %" && text(zero, "what").contains("8.0e-3 a year at 0.5 cm/s"));
    alarm(&run, "synthetic-records");
    alarm(&run, "few-records");
    let rank =
        |alarm: &Value| ["mistake", "caution", "note"].iter().position(|word| alarm["severity"] == *word).unwrap();
    let ranks: Vec<usize> = run["alarms"].as_array().unwrap().iter().map(rank).collect();
    assert!(ranks.is_sorted(), "{ranks:?}");

    // what a fit does wrong stands with its coefficients, and nowhere else
    let table = json(&study, &["table", "r.h5", "--json"]);
    let (of_fit, others): (Vec<&Value>, Vec<&Value>) =
        table["alarms"].as_array().unwrap().iter().partition(|alarm| FIT.contains(&text(alarm, "kind")));
    assert_eq!(others, run["alarms"].as_array().unwrap().iter().collect::<Vec<_>>());
    assert!(of_fit.iter().any(|alarm| alarm["kind"] == "fit-leaves-spectrum"), "{of_fit:?}");
    // how far a curve goes with its spectrum stands with its coefficients
    assert!(table["rows"][0]["reach"]["worst_ratio"].is_f64(), "{}", table["rows"][0]);
    study.uplift(&["export", "r.h5", "--json", "--csv", "-q"]).ok();
    let export: Value = serde_json::from_slice(&std::fs::read(study.path().join("r.json")).unwrap()).unwrap();
    assert_eq!(export["alarms"], run["alarms"]);
    let again = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok().stdout;
    let shown = study.uplift(&["table", "r.h5"]).ok().stdout;
    // strengths with the same digits
    let ranges = shown.lines().filter_map(|line| line.split_once(" to "));
    let words = ranges.map(|(from, to)| [from.split_whitespace().last(), to.split_whitespace().next()]);
    let strengths: Vec<&str> = words.flatten().flatten().filter(|word| word.parse::<f64>().is_ok()).collect();
    assert!(!strengths.is_empty(), "{shown}");
    assert!(strengths.iter().all(|word| word.split_once('.').is_some_and(|(_, digits)| digits.len() == 2)), "{shown}");
    // a summary has the worst, three at most and a line each, and says how to see the others
    for (face, found, others) in [(again, &run, "uplift warnings r.h5"), (shown, &table, "--details")] {
        let found = found["alarms"].as_array().unwrap();
        let (_, lines) = face.split_once("\nWarnings\n").unwrap_or_else(|| panic!("{face}"));
        let shown: Vec<&str> = lines.lines().take(3).collect();
        for (alarm, line) in found.iter().zip(&shown) {
            let remedy = text(alarm, "what_to_do");
            assert!(line.contains(text(alarm, "what")) && line.ends_with(remedy), "{line}\n{alarm}");
        }
        let rest = format!("  {} more: {others}", found.len() - 3);
        assert_eq!(lines.lines().nth(3), Some(&*rest), "{face}");
    }
    let listed = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    study.uplift(&["report", "r.h5", "-q"]).ok();
    // as HTML a slash is spelt out
    let page =
        std::fs::read_to_string(study.path().join("r.html")).unwrap().replace("&#x2f;", "/").replace("&#x27;", "'");
    assert!(page.contains(">Warnings<"), "{page:.300}");
    for (face, mark) in [(listed, ": "), (page, ":</strong> ")] {
        for alarm in run["alarms"].as_array().unwrap() {
            let told = format!("{mark}{}", text(alarm, "what"));
            assert_eq!(face.matches(&told).count(), 1, "{told}\n{face:.2000}");
            let (before, _) = face.split_once(&told).unwrap();
            let line = before.lines().last().unwrap();
            assert!(line.contains(text(alarm, "subject")), "{line}\n{alarm}");
            let remedy = text(alarm, "what_to_do");
            assert!(face.contains(remedy), "{alarm}\n{face:.2000}");
        }
    }
    // with the ordinates stands what they rest on
    let tidy = std::fs::read_to_string(study.path().join("r.spectra.csv")).unwrap();
    assert!(tidy.lines().next().unwrap().ends_with(",flag,lower_tail_share,upper_tail_share"), "{tidy:.300}");
    assert!(tidy.contains(",no exceedance,"));
    let ordinates = &export["spectra"][0];
    for key in ["flag", "lower_tail_share", "upper_tail_share"] {
        assert_eq!(ordinates[key].as_array().unwrap().len(), 10, "{key}");
    }

    let design = json(&study, &["design", "block.toml", "--urs", "r.h5", "--site", "here", "--json"]);
    let own = alarm(&design, "curves-disagree");
    assert!(text(own, "subject") == "Here" && own["also"] == serde_json::json!([]), "{own}");
    assert!(!design["notes"].to_string().contains("synthetic"), "said once: {}", design["notes"]);
}

// Wherever an answer goes, its commands name the result as it was named; a kept answer is the same at any place.
#[test]
fn commands_in_files_and_json_can_be_typed() {
    let study = SmallStudy::new();
    study.uplift(&["init", "first", "-q"]).ok();
    study.uplift(&["run", "first/study.toml", "-o", "deep/r.h5", "-q"]).ok();
    study.write("block.toml", BLOCK);
    let repair = "uplift consistency deep/r.h5 --repair";
    let printed = study.uplift(&["warnings", "deep/r.h5", "--json"]).ok().stdout;
    assert!(printed.contains(repair) && !printed.contains("RESULT"), "{printed}");
    let design = ["design", "block.toml", "--urs", "deep/r.h5", "--site", "Athens", "--spectrum-only"];
    let answer = study.uplift(&[&design[..], &["--report", "elsewhere/sheet.html", "--json", "-q"]].concat());
    let answer = answer.ok().stdout;
    assert!(answer.contains(repair) && !answer.contains("RESULT"), "{answer}");
    let kept = ResultFile::open(&study.path().join("deep/r.h5")).unwrap().findings().unwrap();
    let document = &kept[0].finding.document;
    assert!(document.contains("uplift consistency RESULT --repair"), "{document}");
    study.uplift(&["export", "deep/r.h5", "--json", "-o", "elsewhere/r.json", "-q"]).ok();
    study.uplift(&["report", "deep/r.h5", "-o", "elsewhere/page.html", "-q"]).ok();
    for file in ["sheet.html", "page.html", "r.json"] {
        let text = std::fs::read_to_string(study.path().join("elsewhere").join(file)).unwrap();
        let text = text.replace("&#x2f;", "/");
        assert!(text.contains(repair) && !text.contains("uplift consistency RESULT"), "{file}");
        assert!(file != "page.html" || text.contains("<code>uplift plot deep/r.h5</code>"), "{file}");
    }
}

// The first study: scaled to PGA its records have 1.6 times the site's PGV. That the spectra are apart is said with it,
// whichever is asked for, by every command.
#[test]
fn measures_that_disagree_are_raised_wherever_a_spectrum_is() {
    let study = SmallStudy::new();
    study.uplift(&["init", "first", "-q"]).ok();
    let run = json(&study, &["run", "first/study.toml", "-o", "r.h5", "--json"]);
    assert_eq!(text(alarm(&run, "hazard-inconsistent"), "subject"), "Athens by PGA");
    for measure in ["pga", "pgv"] {
        let found = json(&study, &["spectrum", "r.h5", "--measure", measure, "--json"]);
        let apart = alarm(&found, "measures-disagree");
        let what = text(apart, "what");
        assert!(what.starts_with("the PGA spectrum is ") && what.contains(" times PGV's at strength "), "{apart}");
        assert_eq!(text(apart, "what_to_do"), "Repair: uplift consistency r.h5 --repair");
        assert_eq!(raised(&found, "hazard-inconsistent"), measure == "pga", "{found}");
    }
    let every = json(&study, &["warnings", "r.h5", "--json"]);
    assert!(raised(&run, "measures-disagree") && every == run["alarms"], "{every}");
    // bands decide where there are some
    study.uplift(&["bootstrap", "r.h5", "--replicates", "30", "--sizes", "15,30", "-q"]).ok();
    let table = json(&study, &["table", "r.h5", "--measure", "pgv", "--json"]);
    assert!(text(alarm(&table, "measures-disagree"), "what").ends_with(", outside both 90 % bands"), "{table}");
    // asked for or not, it is the same probability
    let asked = |more: &[&str]| json(&study, &[&["spectrum", "r.h5", "--json"], more].concat())["alarms"].clone();
    assert_eq!(asked(&["--poe", "2%"]), asked(&[]));
}

/// Words of a file of the study that spells its texts as they are, in bytes of two or in a packed sheet.
fn holds(file: &Path, words: &str) -> bool {
    let bytes = std::fs::read(file).unwrap();
    let spelt = |bytes: &[u8], words: &[u8]| bytes.windows(words.len()).any(|window| window == words);
    if file.extension().is_some_and(|ending| ending == "mat") {
        let units: Vec<u8> = words.encode_utf16().flat_map(u16::to_le_bytes).collect();
        return spelt(&bytes, &units);
    }
    let mut sheets = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
    let mut texts = String::new();
    sheets.by_name("xl/sharedStrings.xml").unwrap().read_to_string(&mut texts).unwrap();
    texts.contains(words)
}

#[test]
fn workbook_matlab_and_design_sheet_say_it_too() {
    let study = study();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["export", "r.h5", "--xlsx", "--mat", "-q"]).ok();
    let table = json(&study, &["table", "r.h5", "--json"]);
    for (kind, word) in [("curves-disagree", "mistake?"), ("few-records", "caution"), ("no-exceedance", "caution")] {
        let what = text(alarm(&table, kind), "what").to_owned();
        for file in ["r.xlsx", "r.mat"] {
            let subject = text(alarm(&table, kind), "subject");
            assert!(holds(&study.path().join(file), &what), "{file}: {what}");
            assert!(holds(&study.path().join(file), &format!("{word}: {subject}")), "{file}: {word}: {subject}");
        }
    }
    let design = ["design", "block.toml", "--urs", "r.h5", "--site", "Here", "--json"];
    let found = json(&study, &[&design[..], &["--report", "sheet.html"]].concat());
    let sheet =
        std::fs::read_to_string(study.path().join("sheet.html")).unwrap().replace("&#x2f;", "/").replace("&#x27;", "'");
    for alarm in found["alarms"].as_array().unwrap() {
        assert!(sheet.contains(text(alarm, "what")), "{alarm}");
    }
}

#[test]
fn a_table_of_one_measure_says_what_concerns_it() {
    let study = study();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let kinds = |more: &[&str]| -> Vec<String> {
        let table = json(&study, &[&["table", "r.h5", "--json"], more].concat());
        let alarms = table["alarms"].as_array().unwrap().iter();
        alarms.map(|alarm| format!("{} {}", text(alarm, "kind"), text(alarm, "subject"))).collect()
    };
    let (plain, all, pgv) = (kinds(&[]), kinds(&["--measure", "all"]), kinds(&["--im", "pgv"]));
    // what is said of fits is said of those that are shown, and without a word those are by PGV
    let parted = |said: &[String]| -> (Vec<String>, Vec<String>) {
        said.iter().cloned().partition(|said| FIT.iter().any(|kind| said.starts_with(kind)))
    };
    assert_eq!(parted(&plain).1, parted(&all).1);
    assert_eq!(parted(&plain).0, parted(&pgv).0);
    assert!(parted(&all).0.iter().any(|said| said.contains(", PGA")), "{all:?}");
    assert!(all.iter().any(|said| said.contains(", PGA")) && !pgv.iter().any(|said| said.contains(", PGA")), "{pgv:?}");
    // what is of both, and of the records, is said of each
    for kind in ["curves-disagree", "synthetic-records"] {
        assert!(pgv.iter().any(|said| said.starts_with(kind)), "{kind}: {pgv:?}");
    }
    assert!(!kinds(&["--measure", "pga"]).iter().any(|said| said.contains(", PGV")));
}

#[test]
fn a_response_asks_about_unlikely_numbers() {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "-o", "set", "--count", "1", "-q"]).ok();
    let record = ["response", "set/SYN001_H1.AT2"];
    for (asked, words) in [
        (&["--block", "--width-m", "4", "--height-m", "220"][..], "--height-m is 220 m; usual is"),
        (&["--block", "--width-m", "40", "--height-m", "100"], "--width-m is 40 m; usual is"),
        (&["--strength", "40"], "--strength is 40; usual is"),
        (&["--strength", "0.2", "--uplift-displacement-m", "0.5"], "--uplift-displacement-m is 0.5 m; usual is"),
        (&["--strength", "0.2", "--gravity-m-s2", "981"], "--gravity-m-s2 is 981 m/s2; usual is"),
    ] {
        let said = study.uplift(&[&record[..], asked].concat()).ok().stdout;
        assert!(said.contains(&format!("\nWarnings\n  mistake? response: {words}")), "{words}:\n{said}");
        let found = json(&study, &[&record[..], asked, &["--json"]].concat());
        assert_eq!(alarm(&found, "unlikely-number")["severity"], "mistake");
    }
    let usual = json(&study, &[&record[..], &["--strength", "0.2", "--json"]].concat());
    assert_eq!(usual["alarms"], serde_json::json!([]));
}

#[test]
fn a_check_raises_what_a_run_would_of_the_last_level() {
    let study = study();
    let said = study.uplift(&["check", "study.toml", "--details"]).ok().stdout;
    let note = said.lines().find(|line| line.starts_with("  Here, PGA, 2 %")).unwrap_or_else(|| panic!("{said}"));
    assert!(note.contains("displacements may be too small (13.2 % of the risk above 1 g)"), "{note}");
    assert!(note.ends_with(". Raise the last of pga.levels_g to 3"), "{note}");
    let check = json(&study, &["check", "study.toml", "--json"]);
    let pga = check["levels"].as_array().unwrap().iter().find(|level| level["im"] == "PGA").unwrap();
    assert_eq!(pga["last_level"], 1.0);
    assert_eq!(alarm(&check, "beyond-last-level")["severity"], "caution");
    // nothing is raised that a run does not raise, and in the same words where no strengths are tried for it
    let run = json(&study, &["run", "study.toml", "-o", "r.h5", "--json"]);
    for raised in check["alarms"].as_array().unwrap() {
        let kind = raised["kind"].as_str().unwrap();
        let of_run = alarm(&run, kind);
        if ["synthetic-records", "few-records"].contains(&kind) {
            assert_eq!(raised, of_run);
        }
    }
    assert_eq!(alarm(&check, "few-records")["severity"], "caution");
}

#[test]
fn probabilities_taken_for_rates_are_reported() {
    let study = study();
    study.write("here-pgv.csv", &curve(&[0.5, 1.0, 2.0, 20.0, 300.0], |v| -(-50.0 * 0.2 / v).exp_m1()));
    let said = study.uplift(&["check", "study.toml"]).ok().stdout;
    assert!(said.contains("Here, PGV: the rates of the hazard curve level off just below 1"), "{said}");
    assert!(!said.contains("There, PGV: the rates"), "a curve of rates is none:\n{said}");
    let run = json(&study, &["run", "study.toml", "-o", "r.h5", "--json"]);
    let first = &run["alarms"][0];
    assert!(first["kind"] == "hazard-probabilities" && first["severity"] == "mistake", "{first}");
    assert!(text(first, "what_to_do").contains("kind = \"poe\""), "{first}");

    // one of two weighted curves beside a sound one is named, before a run and after it
    study.write("rates.csv", &curve(&[0.5, 1.0, 2.0, 20.0, 300.0], |v| 0.2 / v));
    let branches = "{ file = \"rates.csv\", branches = [{ file = \"rates.csv\", weight = 0.9 }, \
                    { file = \"here-pgv.csv\", weight = 0.1, name = \"odd\" }] }";
    study.write("branches.toml", &SMALL_STUDY.replacen("\"here-pgv.csv\"", branches, 1));
    let words = "Here, PGV: the rates of the weighted curve \"odd\" level off just below 1";
    let said = study.uplift(&["check", "branches.toml"]).ok().stdout;
    assert!(said.contains(words) && said.contains("if not all, write rates per year into the files"), "{said}");
    let said = study.uplift(&["run", "branches.toml", "-o", "b.h5"]).ok().stdout;
    assert!(said.contains(words) && said.contains("if not all, write rates per year into the files"), "{said}");
}

/// A curve of the repository, its levels `times` as large.
fn curve_times(file: &str, times: f64) -> String {
    let text = std::fs::read_to_string(repository().join("hazard").join(file)).unwrap();
    let rows = text.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_digit()));
    let row = |line: &str| {
        let (level, rate) = line.split_once(',').unwrap();
        format!("{},{rate}\n", times * level.parse::<f64>().unwrap())
    };
    format!("iml,maf\n{}", rows.map(row).collect::<String>())
}

#[test]
fn curves_and_levels_in_other_units_are_named() {
    let study = SmallStudy::with(
        "[records.synthetic]\npairs = 40\n[strengths]\nvalues = [0.2, 0.4]\n[pgv]\n\
         levels_cm_s = [2, 5, 10, 20, 40, 80, 160]\n[pga]\nlevels_g = [0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6]\n\
         [[sites]]\nname = \"Here\"\npgv = \"pgv.csv\"\npga = \"pga.csv\"\n",
    );
    study.write("pgv.csv", &curve_times("athens/pgv.csv", 1.0));
    study.write("pga.csv", &curve_times("athens/pga.csv", 1.0));
    let said = study.uplift(&["check", "study.toml", "-q"]).ok().stdout;
    assert!(!said.contains("mistake?"), "{said}");

    // what the records bring of the other measure tells it, before a run, at its beginning and after it
    study.write("pga.csv", &curve_times("athens/pga.csv", 9.81));
    let checked = json(&study, &["check", "study.toml", "--json"]);
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5", "--json"]).ok();
    let told = run.stderr.find("note: mistake? Here: its curve of PGA is ");
    assert!(told.is_some_and(|at| run.stderr[at..].contains("analyses")), "{}", run.stderr);
    let run: Value = serde_json::from_str(&run.stdout).unwrap();
    for found in [&checked, &run] {
        let mistaken = alarm(found, "curves-disagree");
        assert!(mistaken["severity"] == "mistake" && text(mistaken, "subject") == "Here", "{mistaken}");
        assert!(text(mistaken, "what").contains("its curve of PGA is") && text(mistaken, "what").contains("too high"));
        let remedy = "numbers of its PGA in m/s2, which would explain it? Then pga = { file = …, unit = \"m/s2\" } in \
                      [[sites]], or --set 'sites.Here.pga.unit=m/s2'";
        assert!(text(mistaken, "what_to_do").contains(remedy), "{mistaken}");
    }
    // whichever spectra are asked for, and on the page by its word
    for measure in ["PGV", "PGA"] {
        let said = study.uplift(&["table", "r.h5", "--measure", measure]).ok().stdout;
        assert!(said.contains("  mistake? Here: its curve of PGA is "), "{measure}: {said}");
    }
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    assert!(page.contains("<summary>mistake?: <strong>Here:</strong> its curve of PGA is "));
    assert!(page.contains("<p class=\"doubt\">"), "the answer is not given without a word of it");
    let said = study.uplift(&["check", "study.toml", "-q", "--set", "sites.Here.pga.unit=m/s2"]).ok().stdout;
    assert!(!said.contains("mistake?"), "{said}");
    // a gravity in another unit is reported, and no curve blamed for it
    study.write("pga.csv", &curve_times("athens/pga.csv", 1.0));
    let said = study.uplift(&["check", "study.toml", "-q", "--set", "gravity_m_s2=981"]).ok().stdout;
    assert!(said.contains("gravity_m_s2 is 981") && !said.contains("its curve of"), "{said}");

    // far outside the levels they are told by what would cover them
    let levels = "pgv.levels_cm_s=[0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6]";
    let words = ["Here, PGV", "is pgv.levels_cm_s in m/s?", "give it in cm/s", "PGV = 0.02 cm/s lies outside"];
    study.uplift(&["check", "study.toml", "--set", levels]).fails(4, &words);
    study.write("pgv.csv", &curve_times("athens/pgv.csv", 0.01));
    let words =
        ["are its numbers in m/s?", "pgv = { file = …, unit = \"m/s\" }", "Read as cm/s, PGV = 5 cm/s lies outside"];
    let failed = study.uplift(&["check", "study.toml"]).fails(4, &words);
    assert!(!failed.stderr.contains("extrapolation"), "no remedy for a unit: {}", failed.stderr);
    study.uplift(&["check", "study.toml", "--set", "sites.Here.pgv.unit=m/s"]).ok();
    // extrapolated, it is not refused, and told all the same
    let extrapolated = ["check", "study.toml", "--json", "--set", "risk.extrapolate=loglog"];
    let odd = alarm(&json(&study, &extrapolated), "hazard-implausible").clone();
    assert!(odd["severity"] == "mistake" && text(&odd, "what_to_do").starts_with("are its numbers in m/s?"), "{odd}");
    // two files that were taken for each other are no matter of units
    let interchanged = ["--set", "sites.Here.pgv=pga.csv", "--set", "sites.Here.pga=pgv.csv"];
    study.write("pgv.csv", &curve_times("athens/pgv.csv", 1.0));
    let failed = study.uplift(&[&["check", "study.toml"], &interchanged[..]].concat());
    let failed = failed.fails(4, &["are the files of pgv and pga interchanged?"]);
    assert!(!failed.stderr.contains("are its numbers"), "{}", failed.stderr);
    // a curve that begins a little too high is no curve in another unit
    study.write("pgv.csv", "iml,maf\n4,0.01\n30,1e-3\n400,1e-6\n");
    let failed = study
        .uplift(&["check", "study.toml"])
        .fails(4, &["the curve begins at 4 cm/s, the levels at 2 cm/s. In [pgv] write: levels_cm_s ="]);
    assert!(!failed.stderr.contains("are its numbers"), "{}", failed.stderr);
}

/// Rows of a curve of slope -2 without a header, its levels `times` as large.
fn rows(times: f64) -> String {
    let rows = [(1.0, "0.1"), (10.0, "1e-3"), (100.0, "1e-5"), (300.0, "1.1e-6")];
    rows.map(|(level, rate)| format!("{},{rate}\n", level * times)).concat()
}

#[test]
fn implausible_and_disagreeing_curves_are_reported() {
    let study = SmallStudy::with(
        "[records.synthetic]\npairs = 40\n[strengths]\nvalues = [0.2]\n[pgv]\nlevels_cm_s = [2, 5, 10, 20, 40, 80]\n\
         [risk]\nextrapolate = \"loglog\"\n[[sites]]\nname = \"Here\"\npgv = \"pgv.csv\"\n",
    );
    // millimetres for centimetres, and nothing to hold them against
    study.write("pgv.csv", &format!("iml,maf\n{}", rows(40.0)));
    let checked = json(&study, &["check", "study.toml", "--json"]);
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5", "--json"]).ok();
    assert!(
        run.stderr.contains("note: mistake? Here, PGV: by the hazard curve 1000 cm/s is exceeded"),
        "{}",
        run.stderr
    );
    for found in [&checked, &serde_json::from_str(&run.stdout).unwrap()] {
        let odd = alarm(found, "hazard-implausible");
        assert!(
            odd["severity"] == "mistake"
                && text(odd, "what").ends_with("1.6e-4 times a year, which is hardly possible"),
            "{odd}"
        );
        assert!(text(odd, "what_to_do").starts_with("are its numbers in mm/s? Then divide its levels by 10"), "{odd}");
    }

    // one of two in m/s, which every level of the study lies within
    study.write("a.csv", &format!("iml,maf\n{}", rows(1.0)));
    study.write("b.csv", &format!("iml,maf\n{}", rows(0.01)));
    let branches = |second: &str| {
        format!(
            "sites.Here.pgv={{ branches = [{{ file = \"a.csv\", weight = 0.5 }}, {{ file = \"{second}\", weight = 0.5, \
             name = \"other\" }}] }}"
        )
    };
    let set = ["--set", &branches("b.csv"), "--force"];
    let checked = json(&study, &[&["check", "study.toml", "--json"], &set[..2]].concat());
    let run = json(&study, &[&["run", "study.toml", "-o", "r.h5", "--json"], &set[..]].concat());
    for found in [&checked, &run] {
        let odd = alarm(found, "branches-disagree");
        assert!(
            odd["severity"] == "mistake"
                && text(odd, "what").contains("at least 100.0 times below")
                && text(odd, "what").ends_with("at every rate from 0.1 to 0.00001 a year"),
            "{odd}"
        );
        let remedy = text(odd, "what_to_do");
        assert!(remedy.contains("in m/s, which would explain it? All files of pgv are read in cm/s: convert"), "{odd}");
        let kinds: Vec<&Value> = found["alarms"].as_array().unwrap().iter().map(|alarm| &alarm["kind"]).collect();
        assert!(!kinds.contains(&&Value::from("hazard-implausible")), "said once: {kinds:?}");
    }
    study.write("b.csv", &format!("iml,maf\n{}", rows(1.5)));
    let said = study.uplift(&["check", "study.toml", "--set", &branches("b.csv")]).ok().stdout;
    assert!(!said.contains("mistake?"), "{said}");
    // what is given as their mean is held against them, too
    study.write("mean.csv", &format!("iml,maf\n{}", rows(0.01)));
    let with_mean = branches("b.csv").replacen("{ ", "{ file = \"mean.csv\", ", 1);
    let said = study.uplift(&["check", "study.toml", "--set", &with_mean]).ok().stdout;
    assert!(
        said.contains(
            "the levels of the curve of the spectra (mean.csv) are at least 100.0 times below those of the 2 others"
        ),
        "{said}"
    );
}

#[test]
fn a_file_that_says_another_unit_or_kind_is_answered_with_the_line_to_write() {
    let study = SmallStudy::with(
        "[records.synthetic]\npairs = 40\n[strengths]\nvalues = [0.2]\n[pgv]\nlevels_cm_s = [2, 5, 10, 20, 40, 80]\n\
         [[sites]]\nname = \"Here\"\npgv = \"pgv.csv\"\n",
    );
    let words = |of: &[&str]| study.uplift(&["check", "study.toml"]).fails(4, of);
    // what the study does not say, the file does
    study.write("pgv.csv", &format!("pgv_m_s,maf\n{}", rows(0.01)));
    study.uplift(&["check", "study.toml"]).ok();
    let completed = study.uplift(&["check", "study.toml", "--print-study"]).ok().stdout;
    assert!(completed.contains("unit = \"m/s\""), "{completed}");
    study.uplift(&["check", "study.toml", "--set", "sites.Here.pgv.unit=cm/s"]).fails(
        4,
        &[
            "but the study reads \"cm/s\"",
            "write pgv = { file = …, unit = \"m/s\" } in [[sites]], or",
            "--set 'sites.Here.pgv.unit=m/s'",
        ],
    );
    study.uplift(&["check", "study.toml", "--set", "sites.Here.pgv.unit=m/s"]).ok();
    study.write("pgv.csv", &format!("pgv_cm_s,poe\n{}", rows(1.0)));
    words(&[
        "but without kind = \"poe\" and years the study means annual rates",
        "write pgv = { file = …, kind = \"poe\", years = … } in [[sites]], with the years that they are of",
    ]);
    // the other way round, and of one branch of several
    study.uplift(&["check", "study.toml", "--set", "sites.Here.pgv.kind=poe", "--set", "sites.Here.pgv.years=50"]).ok();
    study.write("pgv.csv", &format!("pgv_cm_s,maf\n{}", rows(1.0)));
    let poe = ["check", "study.toml", "--set", "sites.Here.pgv.kind=poe", "--set", "sites.Here.pgv.years=50"];
    study.uplift(&poe).fails(4, &["leave out `kind` and `years` of pgv in [[sites]]"]);
    study.write("b.csv", &format!("pgv_m_s,maf\n{}", rows(0.01)));
    let branches = |unit: &str| {
        format!(
            "sites.Here.pgv={{ {unit}branches = [{{ file = \"pgv.csv\", weight = 0.5 }}, {{ file = \"b.csv\", weight = \
             0.5 }}] }}"
        )
    };
    let all_or_this = ["b.csv", "unit = \"m/s\" } in [[sites]] if all branches are so, or convert this file"];
    study.uplift(&["check", "study.toml", "--set", &branches("unit = \"cm/s\", ")]).fails(4, &all_or_this);
    study.uplift(&["check", "study.toml", "--set", &branches("")]).ok();
    // a unit that is not read
    study.write("pgv.csv", &format!("# IM: PGV [mm/s]\niml,maf\n{}", rows(10.0)));
    words(&["declares its unit as \"mm/s\"", "convert its levels into cm/s, and write that into its head"]);
    // probabilities that are certain, called rates
    study.write("pgv.csv", "pgv_cm_s,maf\n0.5,1\n1,1\n2,0.9\n80,0.01\n200,0.001\n");
    words(&["line 3: annual rate 1 1/yr equals that at ", "look like probabilities", "kind = \"poe\""]);
}

#[test]
fn numbers_in_other_units_are_accepted_and_reported() {
    let study = study();
    for (setting, words) in [
        ("oscillator.uplift_displacement_m=5", "oscillator.uplift_displacement_m is 5 m; usual is"),
        ("strengths.values=[5, 10, 20, 40]", "the largest of strengths.values is 40; usual is"),
        ("gravity_m_s2=981", "gravity_m_s2 is 981 m/s2; usual is"),
        ("pgv.levels_cm_s=[0.6, 1, 2]", "the highest of pgv.levels_cm_s is 2 cm/s; usual is"),
    ] {
        let said = study.uplift(&["check", "study.toml", "-q", "--set", setting]).ok().stdout;
        assert!(said.contains(&format!("  mistake? study: {words}")), "{words}:\n{said}");
        assert!(said.starts_with("The study can be run, subject to the mistake? below: "), "{said}");
    }
    // cautions and notes are not what a quiet terminal is for
    let loud = study.uplift(&["check", "study.toml"]).ok().stdout;
    let quiet = study.uplift(&["check", "study.toml", "-q"]).ok().stdout;
    assert!(loud.contains("\n  Synthetic records: ") && loud.contains("\nNote "), "{loud}");
    let (answer, warnings) = quiet.split_once("\nWarnings\n").unwrap();
    assert!(answer.starts_with("The study can be run") && answer.contains("\nResult "), "{quiet}");
    assert!(warnings.lines().all(|line| line.starts_with("  mistake? ")), "{quiet}");
    let help = study.uplift(&["warnings", "--help"]).ok().stdout;
    assert!(help.contains("spectra") && help.contains("uplift consistency RESULT --details"), "{help}");
    let run =
        json(&study, &["run", "study.toml", "-o", "r.h5", "--json", "--set", "strengths.values=[0.2, 5, 10, 40]"]);
    let first = &run["alarms"][0];
    assert!(
        first["kind"] == "unlikely-number" && first["severity"] == "mistake" && first["subject"] == "study",
        "{first}"
    );

    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--force"]).ok();
    study.write("pier.toml", "kind = \"block\"\nwidth_m = 40\nheight_m = 220\nmass_kg = 145\n");
    let pier = ["design", "pier.toml", "--urs", "r.h5", "--site", "Here", "--safety-factor", "40"];
    let found = json(&study, &[&pier[..], &["--json"]].concat());
    let mistakes: Vec<&str> = found["alarms"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|alarm| alarm["severity"] == "mistake")
        .map(|alarm| text(alarm, "what"))
        .collect();
    // the first is the site's: its curve of PGV is of a hundredth of the shaking
    let starts = [
        "its curve of PGA is 22.2 times too high for its curve of PGV and these records",
        "width_m is 40 m",
        "height_m is 220 m",
        "mass_kg over width² × height is",
        "--safety-factor is 40",
    ];
    assert_eq!(mistakes.len(), starts.len(), "{mistakes:?}");
    for (mistake, start) in mistakes.iter().zip(starts) {
        assert!(mistake.starts_with(start), "{mistake}");
    }
    let shown = study.uplift(&[&pier[..], &["--details"]].concat()).ok().stdout;
    assert!(shown.contains("\nThese verdicts hold only if the inputs marked mistake? below are correct.\n"), "{shown}");
}

#[test]
#[ignore = "long: make test-long"]
fn none_overturned_is_not_never() {
    let study = study();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.write("large.toml", "kind = \"block\"\nwidth_m = 30\nheight_m = 100\nmass_kg = 2e8\n");
    for command in ["design", "overturning"] {
        let arguments = [command, "large.toml", "--urs", "r.h5", "--site", "There"];
        let found = json(&study, &[&arguments[..], &["--json"]].concat());
        let none = alarm(&found, "none-overturned");
        for words in ["0 of 4 records up to", ": at most ", " a year (95 % confidence)"] {
            assert!(text(none, "what").contains(words), "{words}: {none}");
        }
        let answer = study.uplift(&arguments).ok().stdout;
        assert!(answer.contains("  < "), "{answer}");
        let shown = study.uplift(&[&arguments[..], &["--details"]].concat()).ok().stdout;
        assert!(shown.contains("  < ") && shown.contains("  > "), "{shown}");
        assert!(!shown.contains(" never"), "{shown}");
    }
    // in the table of risks beside it, and on the sheet
    study.uplift(&["overturning", "large.toml", "--urs", "r.h5", "--site", "There", "-o", "o.csv", "-q"]).ok();
    let risk = std::fs::read_to_string(study.path().join("o.risk.csv")).unwrap();
    let mut rows = risk.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let at = rows.next().unwrap().iter().position(|name| *name == "at_most_per_year").unwrap();
    for row in rows {
        assert!(row[at - 1] == "0.0" && row[at].parse::<f64>().unwrap() > 0.0, "{row:?}");
    }
    let design = ["design", "large.toml", "--urs", "r.h5", "--site", "There", "--report", "sheet.html"];
    study.uplift(&design).ok();
    let sheet = std::fs::read_to_string(study.path().join("sheet.html")).unwrap();
    assert!(sheet.contains(">none seen</td>") && !sheet.contains(">0</td>"), "{sheet}");
    // There by PGV: 0.1/v² from 0.5 cm/s on; the last levels are 30 and 100 cm/s
    let found = json(&study, &["design", "large.toml", "--urs", "r.h5", "--site", "There", "--json"]);
    let bound = found["exact"]["overturning"]["at_most_per_year"].as_f64().unwrap();
    let (beyond, before) = (0.1 / 1e4, 0.1 / 900.0);
    let expected = beyond + (1.0 - 0.05_f64.powf(0.25)) * 0.5 * (before - beyond);
    assert!((bound - expected).abs() < 1e-3 * expected, "{bound} {expected}");
}

// A curve that only the consistency looks at is judged like the others, by check and by run.
#[test]
fn curves_to_compare_with_are_told_as_mistakes_too() {
    let study = SmallStudy::with(&SMALL_STUDY.replace("[pga]\nlevels_g = [0.02, 0.1, 0.3, 1.0]\n", ""));
    let kinds = |kind: &str, words: &str| {
        let checked = json(&study, &["check", "study.toml", "--json"]);
        let run = json(&study, &["run", "study.toml", "-o", "r.h5", "--json", "--again"]);
        for found in [&checked, &run] {
            let odd = alarm(found, kind);
            assert!(odd["severity"] == "mistake" && text(odd, "what").contains(words), "{odd}");
        }
    };
    study.write("pga.csv", "iml,maf\n0.5,4\n50,0.12\n");
    kinds("hazard-implausible", "10 g is exceeded 0.41 times a year");
    study.write("pga.csv", "iml,maf\n0.005,1e-9\n5,1e-12\n");
    kinds("no-common-rate", "PGA from 1.0e-9 to 1.0e-12 a year have no rate in common");
}

// A curve may begin at any number: levels that no study can say are not proposed, and no reason against it.
#[test]
fn check_and_run_give_one_verdict_on_a_curve_from_nothing_to_everything() {
    let study = SmallStudy::new();
    study.write("here-pgv.csv", "iml,maf\n1e-300,1\n1e300,1e-10\n");
    for command in [&["check", "study.toml"][..], &["run", "study.toml", "-o", "r.h5"]] {
        let told = study.uplift(command).ok().stdout;
        assert!(told.contains("mistake?"), "{told}");
        assert!(!told.contains(&"0".repeat(20)), "numbers of 300 digits: {told}");
    }
}

// Once beside every number of theirs; a quiet terminal gets the numbers alone.
#[test]
fn synthetic_records_are_told_by_every_question() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    for question in [
        &["spectrum", "r.h5"][..],
        &["spectrum", "r.h5", "--strength", "0.2"],
        &["bootstrap", "r.h5", "--replicates", "20"],
        &["consistency", "r.h5"],
        &["consistency", "r.h5", "--details"],
        &["influence", "r.h5"],
        &["measures", "r.h5"],
        &["table", "r.h5"],
    ] {
        let told = study.uplift(question).ok().stdout;
        assert_eq!(told.matches("Synthetic records: not for design").count(), 1, "{question:?}\n{told}");
        let quiet = study.uplift(&[question, &["-q"]].concat()).ok().stdout;
        assert!(!quiet.contains("not for design") || question.contains(&"--details"), "{question:?}\n{quiet}");
    }
}
