//! Levels with records of their own: what a table of them does to a run, and what is asked of its result.

use std::fmt::Write as _;

use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_labelled::LabelledReader;
use uplift_risk::StripeWeights;

use crate::common::{SmallStudy, array, repository, same_bits};

pub const LEVELS: [f64; 5] = [1.0, 3.0, 10.0, 30.0, 100.0];

pub const STUDY: &str = r#"title = "sets"
[records.synthetic]
pairs = 6
[strengths]
values = [0, 0.05, "0.1:0.1:0.8"]
[pgv]
levels_cm_s = [1, 3, 10, 30, 100]
[risk]
thresholds_m = [0, 0.0005, "0.01:0.01:1"]
[[sites]]
name = "Here"
pgv = "here-pgv.csv"
"#;

fn study() -> SmallStudy {
    SmallStudy::with(STUDY)
}

/// The names of the records of the plain result `plain.h5`, which this makes.
fn plain(study: &SmallStudy) -> Vec<String> {
    study.uplift(&["run", "study.toml", "-o", "plain.h5", "-q"]).ok();
    let reader = LabelledReader::open(&study.path().join("plain.h5")).unwrap();
    reader.axis::<String>("record").unwrap()
}

/// Runs the study with the table `rows` into `sets.h5`.
pub fn run(study: &SmallStudy, rows: &str) -> String {
    study.write("sets.csv", rows);
    let arguments = ["run", "study.toml", "--set", "records.at_level=sets.csv", "-o", "sets.h5", "--force"];
    let finished = study.uplift(&arguments).ok();
    finished.stderr + &finished.stdout
}

#[test]
fn a_check_looks_at_the_last_level_by_the_hazard_alone() {
    let study = study();
    let mut rows = "record_id,pgv_cm_s\n".to_owned();
    for record in plain(&study) {
        for level in &LEVELS[..4] {
            writeln!(rows, "{record},{level}").unwrap();
        }
    }
    study.write("sets.csv", &rows);
    let set = ["--set", "records.at_level=sets.csv", "--set", "pgv.levels_cm_s=[1, 3, 10, 30]"];
    let said = study.uplift(&[&["check", "study.toml", "--details"], &set[..]].concat()).ok().stdout;
    let caution = said.lines().find(|line| line.starts_with("  Here, PGV, 2 %")).unwrap_or_else(|| panic!("{said}"));
    assert!(caution.contains("the last level, 30 cm/s, is exceeded at 55 % of the target rate"), "{caution}");
    assert!(!said.contains("ordinates tried") && !said.contains("Levels    PGV"), "{said}");
}

#[test]
fn a_table_of_all_records_at_all_levels_is_the_plain_study() {
    let study = study();
    let records = plain(&study);
    let pgv = array(&study.path().join("plain.h5"), "/records/pgv_cm_s");
    let (mut bare, mut full) = ("record_id,pgv_cm_s\n".to_owned(), "pgv_cm_s,weight,factor,record_id\n".to_owned());
    for (record, pgv) in records.iter().zip(&pgv).rev() {
        for level in LEVELS {
            writeln!(bare, "{record},{level}").unwrap();
            writeln!(full, "{level},{},{},{record}", 3.0 * level, level / pgv).unwrap();
        }
    }
    let arrays = [
        "/ida/pgv/edp_m",
        "/urs/pgv/u_m",
        "/urs/pgv/lower_tail_share",
        "/urs/pgv/upper_tail_share",
        "/risk/pgv/maf_per_year",
        "/regression/pgv/c0_m",
    ];
    let of = |file: &str, name: &str| array(&study.path().join(file), name);
    for rows in [&bare, &full] {
        run(&study, rows);
        for name in arrays {
            assert!(same_bits(&of("plain.h5", name), &of("sets.h5", name)), "{name}");
        }
        let expected: Vec<f64> = pgv.iter().flat_map(|pgv| LEVELS.map(|level| level / pgv)).collect();
        assert!(same_bits(&of("sets.h5", "/ida/pgv/factor"), &expected));
    }
    // one record counts a little more at one level: other numbers, by shares now, and close to those without
    let first = format!("{},{}", 3.0 * LEVELS[3], LEVELS[3] / pgv[0]);
    run(&study, &full.replace(&first, &first.replacen("90", "90.0001", 1)));
    assert!(same_bits(&of("plain.h5", arrays[0]), &of("sets.h5", arrays[0])));
    let (plain, found) = (of("plain.h5", arrays[4]), of("sets.h5", arrays[4]));
    assert!(!same_bits(&plain, &found));
    assert!(plain.iter().zip(&found).all(|(a, b)| (a - b).abs() <= 1e-6 * a.max(1e-12)));
}

/// Four to six records a level, weights at one of them, factors a tenth larger at another.
fn some(records: &[String], pgv: &[f64]) -> (String, Vec<f64>) {
    let mut rows = "# made up\nrecord_id;pgv_cm_s;factor;weight\n".to_owned();
    let mut shares = vec![0.0; LEVELS.len() * records.len()];
    for (index, (record, pgv)) in records.iter().zip(pgv).enumerate() {
        for (level, value) in LEVELS.iter().enumerate().filter(|(level, _)| (index + level) % 3 > 0 || *level == 0) {
            let weight = if level == 2 { 1 + index } else { 1 };
            let factor = value / pgv * if level == 3 { 1.1 } else { 1.0 };
            writeln!(rows, "{record};{value};{factor};{weight}").unwrap();
            shares[level * records.len() + index] = weight as f64;
        }
    }
    for row in shares.chunks_exact_mut(records.len()) {
        let sum: f64 = row.iter().sum();
        for share in row {
            *share /= sum;
        }
    }
    (rows, shares)
}

#[test]
fn every_level_has_its_own_records_and_these_their_factors_and_weights() {
    let study = study();
    let records = plain(&study);
    let at = |file: &str| study.path().join(file);
    let pgv = array(&at("plain.h5"), "/records/pgv_cm_s");
    let (rows, shares) = some(&records, &pgv);
    let said = run(&study, &rows);
    assert!(said.contains("a set for each of 5 levels (4 to 6 a level, which count as"), "{said}");
    let warnings = study.uplift(&["warnings", "sets.h5"]).ok().stdout;
    for words in ["4 of 22 factors miss the level", "by more"] {
        assert!(warnings.contains(words), "{words}: {warnings}");
    }
    let stored = array(&at("sets.h5"), "/ida/pgv/share");
    // divided by the sum in another order of roundings
    assert!(
        stored.len() == shares.len() && stored.iter().zip(&shares).all(|(a, b)| (a - b).abs() <= 2e-16),
        "{stored:?}"
    );

    // runs of the same factor are those of the plain study, and there are no others
    let (plain, found) = (array(&at("plain.h5"), "/ida/pgv/edp_m"), array(&at("sets.h5"), "/ida/pgv/edp_m"));
    let strengths = plain.len() / LEVELS.len() / records.len();
    let mut analyses = 0;
    for (cell, (plain, found)) in plain.iter().zip(&found).enumerate() {
        let (record, level) = (cell / LEVELS.len() / strengths, cell % LEVELS.len());
        if shares[level * records.len() + record] == 0.0 {
            assert!(found.is_nan());
            continue;
        }
        analyses += 1;
        assert_eq!(found.to_bits() == plain.to_bits(), level != 3, "{record} {level}");
    }
    let reader = LabelledReader::open(&at("sets.h5")).unwrap();
    assert_eq!(reader.attribute::<u64>("/ida/pgv", "analyses").unwrap(), analyses);

    // the risk is Σ w Σ p over the runs that exceed, computed here from the file's own demands
    let curve: Vec<f64> = vec![0.5, 2.0, 20.0, 300.0];
    let rates = curve.iter().map(|im: &f64| format!("{:e}", 0.2 * im.powf(-2.0)).parse().unwrap()).collect();
    let hazard = HazardCurve::new("PGV", "cm/s", "test", curve, rates).unwrap();
    let weights = StripeWeights::from_hazard(&hazard, &LEVELS, Extrapolation::Refuse).unwrap().per_year();
    let maf = array(&at("sets.h5"), "/risk/pgv/maf_per_year");
    let thresholds = reader.axis::<f64>("threshold").unwrap();
    for strength in 0..strengths {
        for (index, threshold) in thresholds.iter().enumerate() {
            let mut rate = 0.0;
            for (level, weight) in weights.iter().enumerate() {
                for record in 0..records.len() {
                    if found[(record * strengths + strength) * LEVELS.len() + level] > *threshold {
                        rate += weight * shares[level * records.len() + record];
                    }
                }
            }
            let of_file = maf[strength * thresholds.len() + index];
            assert!((of_file - rate).abs() <= 1e-12 * rate, "{strength} {threshold}: {of_file} {rate}");
        }
    }
}

#[test]
fn shards_threads_and_earlier_results_change_no_bit() {
    let study = study();
    let records = plain(&study);
    let pgv = array(&study.path().join("plain.h5"), "/records/pgv_cm_s");
    run(&study, &some(&records, &pgv).0);
    let of = |file: &str| array(&study.path().join(file), "/ida/pgv/edp_m");
    let same = |file: &str| {
        let spectra = |file: &str| array(&study.path().join(file), "/urs/pgv/u_m");
        same_bits(&of("sets.h5"), &of(file)) && same_bits(&spectra("sets.h5"), &spectra(file))
    };
    let set = ["--set", "records.at_level=sets.csv", "-q"];
    // where a plain result lies whose levels are the same, and whose factors are not
    std::fs::copy(study.path().join("plain.h5"), study.path().join("over.h5")).unwrap();
    study.uplift(&[&["run", "study.toml", "-o", "over.h5", "--force", "--threads", "1"], &set[..]].concat()).ok();
    assert!(same("over.h5"));
    // and the other way
    study.uplift(&["run", "study.toml", "-o", "over.h5", "--force", "-q"]).ok();
    assert!(same_bits(&of("plain.h5"), &of("over.h5")));
    for (shard, file) in [("1/2", "first"), ("2/2", "second")] {
        study.uplift(&[&["run", "study.toml", "-o", file, "--shard", shard], &set[..]].concat()).ok();
    }
    study.uplift(&[&["merge", "study.toml", "first", "second", "-o", "joined.h5"], &set[..]].concat()).ok();
    assert!(same("joined.h5"));
}

#[test]
fn what_can_be_asked_is_answered_and_the_rest_refused_in_words() {
    let study = study();
    let records = plain(&study);
    let pgv = array(&study.path().join("plain.h5"), "/records/pgv_cm_s");
    run(&study, &some(&records, &pgv).0);
    study.uplift(&["bootstrap", "sets.h5", "--sizes", "60", "--replicates", "20", "-q"]).ok();
    study.uplift(&["influence", "sets.h5", "-q"]).ok();
    study.uplift(&["report", "sets.h5", "-q"]).ok();
    study.uplift(&["plot", "sets.h5", "-q"]).ok();
    study.uplift(&["export", "sets.h5", "--json", "-q"]).ok();
    study.uplift(&["verify", "sets.h5"]).ok();
    // without the first record, by hand: a study of the others with the same weights
    let at = |file: &str| study.path().join(file);
    let without = array(&at("sets.h5"), "/influence/pgv/u_without_m");
    let (rows, _) = some(&records, &pgv);
    let others: Vec<&str> = rows.lines().filter(|line| !line.starts_with(&format!("{};", records[0]))).collect();
    study.write("others.csv", &others.join("\n"));
    let others = ["run", "study.toml", "--set", "records.at_level=others.csv", "-o", "others.h5", "-q"];
    study.uplift(&others).ok();
    let spectra = array(&at("others.h5"), "/urs/pgv/u_m");
    assert_eq!(without.len(), spectra.len() * records.len());
    let strengths = LabelledReader::open(&at("others.h5")).unwrap().axis::<f64>("strength").unwrap().len();
    // [poe, record, strength] and [poe, strength]
    for (of_poe, spectrum) in without.chunks_exact(records.len() * strengths).zip(spectra.chunks_exact(strengths)) {
        assert!(same_bits(&of_poe[..strengths], spectrum));
    }

    let words = ["records of their own (records.at_level)"];
    study.uplift(&["measures", "sets.h5"]).fails(4, &words);
    let said = study.uplift(&["consistency", "sets.h5"]).ok().stdout;
    assert!(said.contains("no site has hazard curves of two measures"), "{said}");
    // a sample of one has no record of some level
    study
        .uplift(&["bootstrap", "sets.h5", "--sizes", "1", "--replicates", "50", "-q", "--force"])
        .fails(4, &["none of its records is in the sample", "draw more records, or give the level more of them"]);
    study.uplift(&["overturning", &pier(), "--urs", "sets.h5"]).fails(4, &words);
    // the spectrum serves a design all the same, and the structure itself is not analysed
    let sheet = study.uplift(&["design", &pier(), "--urs", "sets.h5", "--details"]).ok().stdout;
    assert!(sheet.contains("the structure itself is not analysed") && sheet.contains(words[0]), "{sheet}");
}

fn pier() -> String {
    repository().join("configs/structures/pier.toml").display().to_string()
}

#[test]
fn all_mistakes_are_reported_with_their_numbers() {
    let study = study();
    let refused = |rows: &str, words: &[&str]| {
        study.write("sets.csv", rows);
        study.uplift(&["check", "study.toml", "--set", "records.at_level=sets.csv"]).fails(4, words);
    };
    refused(
        "record_id,pgv_cm_s\nRSN1,1\nRSN2,3\nSYN001,2\n",
        &[
            "2 records are not among the records of the study: RSN1, RSN2",
            "the study has no level of 2 cm/s",
            "names no record at the study's 10, 30, 100 cm/s",
            "pgv.levels_cm_s = [1, 2, 3]",
        ],
    );
    refused("record_id,pga_g\nSYN001,0.1\n", &["no column pgv_cm_s", "found record_id, pga_g"]);
    refused("record_id,pgv_cm_s,wieght\nSYN001,1,2\n", &["unknown column `wieght`: did you mean `weight`?"]);
    refused("record_id,pgv_cm_s,factor\nSYN001,1,0\n", &["row 1: factor is \"0\": a number above 0 is needed"]);
    let set = |set: &[&str], words: &[&str]| {
        study.write("sets.csv", "record_id,pgv_cm_s\nSYN001,1\n");
        let own = ["check", "study.toml", "--set", "records.at_level=sets.csv"];
        study.uplift(&[&own[..], set].concat()).fails(3, words);
    };
    set(&["--set", "pga.levels_g=[0.1, 1]", "--set", "sites.0.pga=here-pgv.csv"], &["levels of one measure"]);
    // two curves of a site: what so few records bring of the other is said as of any set
    study.write("sets.csv", "record_id,pgv_cm_s\nSYN001,1\nSYN002,3\nSYN001,10\nSYN003,30\nSYN001,100\n");
    let two = ["check", "study.toml", "--set", "records.at_level=sets.csv", "--set", "sites.0.pga=pga.csv"];
    let said = study.uplift(&[&two[..], &["--details"]].concat()).ok().stdout;
    for words in ["3 synthetic pairs", "(1 a level)", "Here by PGV: the records have"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    set(&["--set", "records.first=2"], &["says which records are used"]);
}
