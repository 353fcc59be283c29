//! Levels that begin too high for the targets of a study: what a check says of them, and what a run then finds.

use serde_json::Value;

use crate::common::SmallStudy;

/// Two sites whose curves begin at 0.5 cm/s, and levels that begin at 5.
const HIGH: &str = r#"[records.synthetic]
pairs = 6
[strengths]
values = "0:0.1:0.8"
[pgv]
levels_cm_s = [5, 10, "20:20:100"]
[risk]
maf_surface = false
[[sites]]
name = "Here"
pgv = "here-pgv.csv"
[[sites]]
name = "There"
pgv = { file = "there-pgv.csv", unit = "m/s", kind = "poe", years = 50 }
"#;

/// The largest shares from below the first level and from above the last at these strengths, as a run has them.
fn of_a_run(study: &SmallStudy, set: &[&str], strengths: &[f64]) -> [f64; 2] {
    study.uplift(&[&["run", "study.toml", "--force", "-o", "r.h5", "-q"], set].concat()).ok();
    let csv = std::fs::read_to_string(study.path().join("r.urs.csv")).unwrap();
    assert!(csv.lines().next().unwrap().contains(",lower_tail_share,upper_tail_share,"), "{csv}");
    let rows = csv.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let is_tried =
        |cells: &Vec<&str>| strengths.iter().any(|strength| (cells[4].parse::<f64>().unwrap() - strength).abs() < 1e-9);
    let rows: Vec<_> = rows.filter(is_tried).collect();
    [7, 8].map(|column| rows.iter().map(|cells| cells[column].parse().unwrap()).fold(0.0, f64::max))
}

#[test]
fn a_check_proposes_levels_that_a_run_is_content_with() {
    let study = SmallStudy::with(HIGH);
    let plan = study.uplift(&["check", "study.toml", "--json"]).json();
    let check = &plan["levels"][0];
    let number = |value: &Value| value.as_f64().unwrap();
    let strengths: Vec<f64> = check["strengths"].as_array().unwrap().iter().map(number).collect();
    assert_eq!((check["im"].as_str(), number(&check["first_level"]), strengths.len()), (Some("PGV"), 5.0, 8));
    assert_eq!(strengths.last(), Some(&0.8));

    // the shares are a run's, to the bit: of the levels as they are, and of those proposed
    let share = number(&check["lower_tail_share"]);
    assert!(share > 0.01, "{check}");
    let above = number(&check["upper_tail_share"]);
    assert!(above > 0.01 && number(&check["last_level"]) == 100.0, "{check}");
    assert_eq!(of_a_run(&study, &[], &strengths), [share, above]);
    // and so is what is raised of either end
    let alarms = plan["alarms"].as_array().unwrap();
    let run = study.uplift(&["warnings", "r.h5", "--json"]).json();
    for kind in ["below-first-level", "beyond-last-level"] {
        let of = |alarms: &[Value]| alarms.iter().find(|alarm| alarm["kind"] == kind).cloned();
        assert_eq!(of(alarms), of(run.as_array().unwrap()), "{kind}");
    }
    let alarm = alarms.iter().find(|alarm| alarm["kind"] == "beyond-last-level").unwrap();
    assert!(
        alarm["what"].as_str().unwrap().contains("displacements may be too small (4.6 % of the risk above 100 cm/s)"),
        "{plan:#}"
    );
    let proposal = &check["proposal"];
    let line = proposal["line"].as_str().unwrap();
    let (key, levels) = line.split_once(" = ").unwrap();
    assert_eq!(key, "pgv.levels_cm_s");
    assert!(levels.starts_with('[') && levels.ends_with("5, 10, \"20:20:100\"]"), "{line}");
    let lowered = number(&proposal["lower_tail_share"]);
    assert!(lowered <= 0.01, "{proposal}");
    assert_eq!(of_a_run(&study, &["--set", line], &strengths)[0], lowered);

    let said = study.uplift(&["check", "study.toml", "--details"]).ok().stdout;
    let pasted = line.replace("pgv.levels", "Proposed: [pgv] levels");
    let high = "There, PGV, 10 % (4 cases): displacements too large (96.2 % of the risk below 5 cm/s)";
    for words in [
        "Levels    PGV, at the strengths tried (8 from 0.100 to 0.800)",
        "up to 96.2 % of the risk lies below",
        high,
        &pasted,
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    // levels that reach far enough are left alone
    let content = study.uplift(&["check", "study.toml", "--details", "--set", line]).ok().stdout;
    assert!(content.contains("Levels    PGV, at the strengths"), "{content}");
    assert!(!content.contains("too large") && !content.contains("Proposed"), "{content}");
    // and so are those raised as the warning says
    let to = alarm["what_to_do"].as_str().unwrap().strip_prefix("Raise the last of pgv.levels_cm_s to ").unwrap();
    let raised = line.replace("100\"]", &format!("100\", {to}]"));
    let content = study.uplift(&["check", "study.toml", "--details", "--set", &raised]).ok().stdout;
    assert!(!content.contains("too small"), "{to}:\n{content}");
}

#[test]
fn an_extrapolated_curve_is_named_by_check_and_run_alike() {
    let study = SmallStudy::with(&HIGH.replace("[risk]\n", "[risk]\nextrapolate = \"loglog\"\n"));
    study.write("here-pgv.csv", "iml,maf\n0.5,1.5\n1,0.4\n10,0.01\n60,3e-4\n");
    let check = study.uplift(&["check", "study.toml", "--details"]).ok().stdout;
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let run = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    for words in [
        "1 hazard curve extrapolated (Here, PGV, spans 0.5 to 60 cm/s, the levels 5 to 100)",
        "displacements may be too large (the hazard curve ends at 60 cm/s, at 74.2 % of the target rate, and is \
         extrapolated)",
        "Use a hazard curve down to 4.0e-6 per year, and raise pgv.levels_cm_s",
    ] {
        assert!(check.contains(words) && run.contains(words), "{words}\n{check}\n{run}");
    }
}

/// A study that names no levels.
fn without_levels() -> SmallStudy {
    SmallStudy::with(&HIGH.replace("levels_cm_s = [5, 10, \"20:20:100\"]\n", ""))
}

#[test]
fn default_levels_reach_as_far_as_the_curves_of_all_sites() {
    let study = without_levels();
    study.write("here-pgv.csv", "iml,maf\n0.3,2\n1,0.4\n10,0.01\n64.2,3e-4\n");
    let check = study.uplift(&["check", "study.toml", "--details", "--print-study"]).ok().stdout;
    let note = "default levels of PGV cut to 0.5 to 64.2 cm/s by the hazard curves of There and Here";
    let details = study.uplift(&["check", "study.toml", "--details"]).ok().stdout;
    assert!(details.contains(note), "{details}");
    let levels = "levels_cm_s = [\"0.5:0.1:0.9\", \"1:0.5:20\", \"25:5:60\", 64.2]";
    assert!(check.contains(levels), "{check}");
    // the same study in one run, in shards, and with these levels written
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let again = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    assert!(again.stdout.contains("done already"), "{again:?}");
    for (shard, part) in [("1/2", "one"), ("2/2", "two")] {
        study.uplift(&["run", "study.toml", "-o", part, "-q", "--shard", shard]).ok();
    }
    study.uplift(&["merge", "study.toml", "one", "two", "-o", "s.h5", "-q"]).ok();
    study.uplift(&["run", "study.toml", "-o", "w.h5", "-q", "--set", &format!("pgv.{levels}")]).ok();
    let set = study.uplift(&["check", "study.toml", "--details", "--set", &format!("pgv.{levels}")]).ok().stdout;
    assert!(!set.contains("default levels"), "{set}");
    let csv = |name: &str| std::fs::read_to_string(study.path().join(name)).unwrap();
    assert!(csv("r.urs.csv") == csv("s.urs.csv") && csv("r.urs.csv") == csv("w.urs.csv"));
    let swept = study.uplift(&["sweep", "study.toml", "--over", "oscillator.restitution=0.9,0.95", "-o", "sweep"]).ok();
    assert!(study.path().join("sweep/comparison.csv").is_file(), "{}", swept.stderr);
    // other levels than the default ones are not left out behind its back
    let own = ["check", "study.toml", "--set", "pgv.levels_cm_s=[0.1, 1, 10]"];
    study.uplift(&own).fails(4, &["the curve begins at 0.3 cm/s, the levels at 0.1 cm/s"]);
}

#[test]
fn what_is_wrong_with_one_curve_is_not_said_of_the_others() {
    let study = without_levels();
    study.write("here-pgv.csv", "iml,maf\n0.3,2\n1,0.4\nten,0.01\n");
    let failed = study.uplift(&["check", "study.toml"]).fails(4, &["here-pgv.csv", "ten"]);
    assert!(!failed.stderr.contains("There"), "{}", failed.stderr);
    // nor are default levels cut where curves are extrapolated beyond their ends
    study.write("here-pgv.csv", "iml,maf\n0.3,2\n1,0.4\n64.2,3e-4\n");
    let whole = ["check", "study.toml", "--print-study", "--set", "risk.extrapolate=loglog"];
    let printed = study.uplift(&whole).ok().stdout;
    assert!(printed.contains("levels_cm_s = [\"0.1:0.1:0.9\", \"1:0.5:20\", \"25:5:200\"]"), "{printed}");
}

#[test]
fn a_curve_much_shorter_than_the_default_levels_has_those_that_it_covers_named() {
    let study = without_levels();
    let check = ["check", "study.toml"];
    study.write("here-pgv.csv", "iml,maf\n2,0.4\n10,0.01\n300,1e-6\n");
    let levels = "begins at 2 cm/s, the levels at 0.5 cm/s. In [pgv] write: levels_cm_s = [\"2:0.5:20\", \"25:5:200\"]";
    study.uplift(&check).fails(4, &["Here", levels, "risk.extrapolate = \"loglog\""]);
    // to leave levels out would leave out most of the risk
    study.write("here-pgv.csv", "iml,maf\n0.3,2\n2,0.4\n10,0.01\n");
    let longer = "this one ends at 1.0e-2 per year, and the study asks for 4.0e-4";
    study.uplift(&check).fails(4, &["ends at 10 cm/s, the levels at 200 cm/s", longer]);
    // in m/s, and read as cm/s: as good a curve as one that ends soon
    study.write("here-pgv.csv", "iml,maf\n0.005,2\n0.01,0.4\n0.1,0.01\n1.5,1e-5\n");
    study.uplift(&check).fails(
        4,
        &["ends at 1.5 cm/s, the levels at 200 cm/s: its last level is 1.5 cm/s; usual is", "unit = \"m/s\" }"],
    );
    // rows without a rate are why it begins there
    study.write("here-pgv.csv", "iml,PoE in 1 year\n0.1,1\n0.2,1\n3,0.9\n10,0.1\n300,1e-5\n");
    let dropped =
        "the curve begins at 3 cm/s (2 rows of probability 1 dropped), the levels at 0.5 cm/s. In [pgv] write:";
    study
        .uplift(&["check", "study.toml", "--set", "sites.Here.pgv.kind=poe", "--set", "sites.Here.pgv.years=1"])
        .fails(4, &[dropped]);
}
