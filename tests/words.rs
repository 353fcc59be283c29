//! How many words the commands print, counted on a study of six sites, and that the answer comes first.

use crate::common::{SmallStudy, repository};

/// Six European sites, 30 records as files, few strengths.
pub(crate) fn six_sites() -> SmallStudy {
    let hazard = |file: &str| repository().join("hazard").join(file).display().to_string();
    let site = |name: &str| {
        let [pgv, pga] = ["pgv", "pga"].map(|measure| hazard(&format!("{}/{measure}.csv", name.to_lowercase())));
        format!("[[sites]]\nname = \"{name}\"\npgv = '{pgv}'\npga = '{pga}'\n")
    };
    let sites = ["Aachen", "Athens", "Baden", "Focsani", "Montreux", "Perugia"].map(site).concat();
    let study = SmallStudy::with(&format!(
        "title = \"six sites\"\n[records]\nmanifest = \"manifest.csv\"\n\
         [strengths]\nvalues = [0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.8]\n\
         [pgv]\nlevels_cm_s = [\"1:1:4\", 6, 10, 15, 25, 40, 60, 90, 140, 200]\n\
         [pga]\nlevels_g = [0.002, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8, 1.4, 2.0]\n\
         [hazard]\nconversions = [{{ from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }}]\n{sites}"
    ));
    study.uplift(&["records", "synthesize", "-o", "downloads", "--count", "30", "-q"]).ok();
    study.uplift(&["records", "import", "downloads", "-o", "manifest.csv", "-q"]).ok();
    study
}

/// Prints at most so many words, and a number in the first five lines.
fn brief(study: &SmallStudy, command: &str, most: usize) -> String {
    let arguments: Vec<&str> = command.split(' ').collect();
    let said = study.uplift(&arguments).ok().stdout;
    let words = said.split_whitespace().count();
    println!("{words:4} of {most}  uplift {command}");
    assert!(words <= most, "{words} words, {most} at most: uplift {command}\n{said}");
    let first: Vec<&str> = said.trim_start().lines().take(5).collect();
    let is_answer = |line: &&str| line.chars().any(|letter| letter.is_ascii_digit());
    assert!(first.iter().any(is_answer), "no number in the first lines: uplift {command}\n{said}");
    said
}

#[test]
fn runs_and_questions_print_few_words() {
    let study = six_sites();
    brief(&study, "check study.toml", 100);
    let run = brief(&study, "run study.toml -o r.h5", 120);
    // a row a site, with its numbers, before anything else
    let rows = run.lines().skip_while(|line| !line.starts_with("---")).skip(1);
    let names: Vec<&str> = rows.take(6).filter_map(|row| row.split_whitespace().next()).collect();
    assert_eq!(names, ["Aachen", "Athens", "Baden", "Focsani", "Montreux", "Perugia"], "{run}");
    // of many warnings three are shown, a short line each
    let (_, warnings) = run.split_once("\nWarnings\n").unwrap();
    let warnings: Vec<&str> = warnings.lines().take_while(|line| line.starts_with("  ")).collect();
    assert!(warnings.len() == 4 && warnings[3].ends_with(" more: uplift warnings r.h5"), "{run}");
    assert!(warnings.iter().all(|line| line.split_whitespace().count() <= 28), "{run}");

    brief(&study, "spectrum r.h5", 120);
    brief(&study, "spectrum r.h5 --site Athens --strength 0.13 --return-period 475", 80);
    let bands = brief(&study, "bootstrap r.h5 --replicates 20", 150);
    assert!(bands.lines().count() <= 30, "{bands}");
    brief(&study, "consistency r.h5", 150);
    brief(&study, "measures r.h5", 150);
    // what is repaired has one table more, and no word besides
    let repaired = brief(&study, "consistency r.h5 --repair --force", 150);
    // where there is no repair, how near the records come and what would bring them nearer
    for words in ["no weights give the site's PGA: at best, ", "times as often as at the site; add records with PGA"] {
        assert!(repaired.contains(words), "{repaired}");
    }
}

#[test]
#[ignore = "long: make test-long"]
fn questions_about_structures_are_answered_briefly() {
    let study = six_sites();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    for name in ["block.toml", "frame.toml", "pier.toml", "footbridge.toml"] {
        std::fs::copy(repository().join("configs/structures").join(name), study.path().join(name)).unwrap();
    }
    brief(&study, "design pier.toml --urs r.h5 --site Athens", 150);
    brief(&study, "design footbridge.toml --urs r.h5 --site Athens", 150);
    brief(&study, "design block.toml --urs r.h5 --site Montreux --spectrum-only", 150);
    brief(&study, "overturning block.toml --urs r.h5", 150);
    brief(&study, "risk frame.toml --urs r.h5 --site Athens", 150);
    brief(&study, "target block.toml --urs r.h5 --site Athens --vary width --overturning 2e-3 --tolerance 0.1", 150);
}

#[test]
fn restrainers_and_samples_are_reported_briefly() {
    let study = SmallStudy::new();
    for name in ["column-j.toml", "disc-springs.csv"] {
        std::fs::copy(repository().join("configs/structures").join(name), study.path().join(name)).unwrap();
    }
    brief(&study, "restrainer design column-j.toml --catalogue disc-springs.csv --capacity-m 0.5", 150);
    let rows = |factor: f64| -> String {
        let pair = |place: i32| {
            let [low, high] = [2 * place, 2 * place + 1].map(|place| factor * 0.01 * f64::from(place));
            format!("low,{low}\nhigh,{high}\n")
        };
        format!("level,u_m\n{}", (1..=15).map(pair).collect::<String>())
    };
    study.write("tests.csv", &rows(1.0));
    study.write("model.csv", &rows(1.3));
    brief(&study, "validate tests.csv model.csv --by level --replicates 20", 150);
}

#[test]
#[ignore = "long: make test-long"]
fn variants_are_compared_briefly() {
    brief(&six_sites(), "sweep study.toml --over oscillator.restitution=0.9,0.95 -o variants", 150);
}
