//! Levels with records of their own: whether these bring the hazard of the other measure, and their repair.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;
use uplift::bootstrap::resampling_plan;
use uplift::result::{ResultFile, StoredStripes};
use uplift_consistency::{
    KNOTS, LevelSets, RecordSet, RepairOptions, ScaledAnalysis, Scratch, Seismology, SetRecord, Solver,
};
use uplift_fragility::weighted_quantile;
use uplift_hazard::{CsvOptions, Extrapolation, read_path};
use uplift_labelled::LabelledReader;
use uplift_risk::{RiskCurve, RunWeights};

use crate::common::{SmallStudy, array, repository, same_bits};

/// 105 synthetic pairs at Montreux, scaled to PGV, two strengths; the site's PGA beside.
fn study() -> SmallStudy {
    let [pgv, pga] = ["pgv", "pga"].map(|key| repository().join(format!("hazard/montreux/{key}.csv")));
    let study = SmallStudy::with(&format!(
        "[strengths]\nvalues = [0.1, 0.3]\n[pgv]\n[consistency]\nrepair = \"weights\"\n[risk]\nmaf_surface = false\n\
         [bootstrap]\nsizes = [105]\nreplicates = 20\n[hazard]\nconversions = \
         [{{ from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }}]\n\
         [[sites]]\nname = \"Montreux\"\npgv = '{}'\npga = '{}'\n",
        pgv.display(),
        pga.display()
    ));
    study.uplift(&["run", "study.toml", "-o", "plain.h5", "-q"]).ok();
    study
}

/// The records of the plain result: their names, and PGV in cm/s.
fn records(study: &SmallStudy) -> (Vec<String>, Vec<f64>) {
    let file = study.path().join("plain.h5");
    (LabelledReader::open(&file).unwrap().axis::<String>("record").unwrap(), array(&file, "/records/pgv_cm_s"))
}

fn levels(study: &SmallStudy) -> Vec<f64> {
    LabelledReader::open(&study.path().join("plain.h5")).unwrap().axis::<f64>("pgv_level").unwrap()
}

/// Every array of floating-point numbers below `group`, with its path.
fn arrays(file: &Path, group: &str) -> Vec<(String, Vec<f64>)> {
    let reader = LabelledReader::open(file).unwrap();
    let (mut groups, mut found) = (vec![group.to_owned()], Vec::new());
    while let Some(group) = groups.pop() {
        for name in reader.children(&group).unwrap() {
            let path = format!("{group}/{name}");
            match reader.array::<f64>(&path) {
                Ok(array) => found.push((path, array.values)),
                Err(_) if reader.children(&path).is_ok() => groups.push(path),
                Err(_) => {}
            }
        }
    }
    found
}

#[test]
#[ignore = "long: make test-long"]
fn the_same_records_at_every_level_are_diagnosed_repaired_and_resampled_as_the_plain_set() {
    let study = study();
    let (names, pgv) = records(&study);
    let mut rows = "record_id,pgv_cm_s,factor\n".to_owned();
    for level in levels(&study) {
        for (name, pgv) in names.iter().zip(&pgv) {
            writeln!(rows, "{name},{level},{}", level / pgv).unwrap();
        }
    }
    study.write("sets.csv", &rows);
    study.uplift(&["run", "study.toml", "--set", "records.at_level=sets.csv", "-o", "sets.h5", "-q"]).ok();
    let both = ["plain.h5", "sets.h5"].map(|name| study.path().join(name));
    for file in &both {
        study.uplift(&["consistency", file.to_str().unwrap(), "--keep-weights", "-q"]).ok();
        study.uplift(&["bootstrap", file.to_str().unwrap(), "-q"]).ok();
        study.uplift(&["influence", file.to_str().unwrap(), "-q"]).ok();
    }
    for (group, least) in [("/consistency", 25), ("/bootstrap", 8), ("/influence", 2), ("/disaggregation", 2)] {
        let [plain, sets] = [&both[0], &both[1]].map(|file| arrays(file, group));
        assert!(plain.len() >= least && plain.len() == sets.len(), "{group}: {}", plain.len());
        for ((name, plain), (_, sets)) in plain.iter().zip(&sets) {
            let alike = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
            assert!(plain.len() == sets.len() && plain.iter().zip(sets).all(alike), "{name}");
            // synthetic records have no earthquakes, and two strengths no fit
            let is_known = !name.contains("event") && !name.contains("/regression/");
            assert!(plain.iter().any(|value| value.is_finite()) || !is_known, "{name} says nothing");
        }
    }
}

/// Five of six records at each level, with weights; at every fourth level factors of another definition of PGV.
fn some(study: &SmallStudy) -> String {
    let (names, pgv) = records(study);
    let mut rows = "record_id,pgv_cm_s,factor,weight\n".to_owned();
    for (index, level) in levels(study).iter().enumerate() {
        for (record, (name, pgv)) in
            names.iter().zip(&pgv).enumerate().filter(|(record, _)| (record + index / 4) % 6 > 0)
        {
            let definition = if index % 4 == 1 { 1.2 } else { 1.0 };
            writeln!(rows, "{name},{level},{},{}", definition * level / pgv, 1 + record % 4).unwrap();
        }
    }
    rows
}

#[test]
#[ignore = "long: make test-long"]
fn levels_are_weighed_with_their_own_records_factors_and_shares() {
    let study = study();
    study.write("sets.csv", &some(&study));
    study.uplift(&["run", "study.toml", "--set", "records.at_level=sets.csv", "-o", "sets.h5", "-q"]).ok();
    let asked = study.uplift(&["consistency", "sets.h5", "--keep-weights", "--json", "-q"]).ok().stdout;
    study.uplift(&["bootstrap", "sets.h5", "-q", "--replicates", "1", "--sizes", "105"]).ok();
    let path = study.path().join("sets.h5");
    let file = ResultFile::open(&path).unwrap();
    let (stored, stripes, hazard) =
        (file.records().unwrap(), StoredStripes::read(&file).unwrap(), file.hazard().unwrap());
    let (measure, records) = (&stripes.measures[0], stored.ids.len());
    let shares = measure.shares.clone().unwrap();
    // what the file has, put together here: factors [record, level] over level/intensity
    let factors = array(&path, "/ida/pgv/factor");
    let relative = |(cell, _): (usize, &f64)| {
        let (level, record) = (cell / records, cell % records);
        factors[record * measure.levels.len() + level] / (measure.levels[level] / stored.pgv_cm_s[record])
    };
    let relative = shares.iter().enumerate().map(relative).collect();
    let row = |(pair, (&scaled_to, &other)): (usize, (&f64, &f64))| SetRecord {
        scaled_to,
        other,
        pair,
        event: None,
        seismology: Seismology::default(),
    };
    let rows = stored.pgv_cm_s.iter().zip(&stored.pga_g).enumerate().map(row).collect();
    let set = RecordSet::new(rows).unwrap().at_level(LevelSets::new(records, relative, Some(shares)).unwrap()).unwrap();
    let other = read_path(&repository().join("hazard/montreux/pga.csv"), &CsvOptions::new("PGA", "g")).unwrap().curve;
    let (own, targets) = (&hazard[0].sites[0].curve, &stripes.targets_per_year);
    let analysis = ScaledAnalysis::new(&set, &measure.levels, own, &other, targets, Extrapolation::Refuse).unwrap();
    let repaired = analysis.repair(&RepairOptions::default()).unwrap();
    let same =
        |name: &str, expected: &[f64]| assert!(same_bits(&array(&path, &format!("/consistency/pgv/{name}")), expected));
    same("exponent", &repaired.fit.exponents);
    same("weight", repaired.weights.shares());
    let of_stripes: Vec<f64> = repaired.diagnosis.stripes.iter().map(|stripe| stripe.effective_records).collect();
    same("effective_records", &of_stripes);
    same("pga_implied", &analysis.diagnose(None, [0.2, 5.0]).unwrap().deviation.unwrap().implied_levels);
    same("pga_repaired", &repaired.diagnosis.deviation.as_ref().unwrap().implied_levels);
    // the spectrum, and the one resample, by weights of its own
    let plan = resampling_plan(&file).unwrap().unwrap();
    let solver = Solver::new(&analysis, 0.05).unwrap();
    let mut scratch = Scratch::default();
    let drawn = plan.samples()[0].multiplicities();
    let fit = solver.solve(drawn, &repaired.fit.exponents, &mut scratch).unwrap();
    let mut of_sample = analysis.own_shares();
    solver.shares(drawn, &fit.exponents, &mut scratch, &mut of_sample).unwrap();
    let of_sample = RunWeights::new(analysis.stripes(), &of_sample).unwrap();
    assert_ne!(solver.solve(&set.once(), &[0.0; KNOTS], &mut scratch).unwrap().exponents, fit.exponents);
    for (array_name, weights) in
        [("/consistency/pgv/u_m", &repaired.weights), ("/bootstrap/pgv/consistent/u50_m", &of_sample)]
    {
        let found = array(&path, array_name);
        for strength in 0..2 {
            let demand = measure.demand(strength).unwrap();
            let expected = RiskCurve::weighted(&demand, weights).unwrap().exact_ordinates(targets).unwrap();
            for (poe, ordinate) in expected.iter().enumerate() {
                assert_eq!(found[poe * 2 + strength].to_bits(), ordinate.displacement_m.to_bits(), "{array_name}");
            }
        }
    }
    // of the records of a stripe, and not of all
    let asked: Value = serde_json::from_str(&asked).unwrap();
    let repair = &asked["rows"][0]["repair"];
    assert!((87..=88).contains(&repair["least_effective_of"].as_u64().unwrap()), "{repair}");
    assert!(repair["max"].as_f64().unwrap() < 0.1, "{repair}");
    study.uplift(&["report", "sets.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("sets.html")).unwrap();
    assert!(page.contains("r1-urs-pgv"));
    study.uplift(&["plot", "sets.h5", "-q"]).ok();
    assert!(study.path().join("sets.figures/bands-pgv-repaired.svg").is_file());
    assert!(study.path().join("sets.figures/ida.svg").is_file());
    // half of the weight lies below the median of a stripe
    let demands = measure.stripes(0).unwrap();
    let mut stripe: Vec<(f64, f64)> = demands.weighted_stripe(20).collect();
    stripe.sort_by(|a, b| a.0.total_cmp(&b.0));
    let median = weighted_quantile(&stripe, 0.5);
    let below: f64 = stripe.iter().filter(|(demand, _)| *demand <= median).map(|(_, share)| share).sum();
    assert!((below - 0.5).abs() < 0.05, "{below}");
}

#[test]
fn factors_of_another_unit_and_levels_of_few_records_are_raised() {
    let study = study();
    let (names, pgv) = records(&study);
    let mut rows = "record_id,pgv_cm_s,factor\n".to_owned();
    for (index, level) in levels(&study).iter().enumerate() {
        for (name, pgv) in names.iter().zip(&pgv).take(if index == 3 { 12 } else { 60 }) {
            // levels in m/s, taken for cm/s
            writeln!(rows, "{name},{level},{}", 100.0 * level / pgv).unwrap();
        }
    }
    study.write("sets.csv", &rows);
    let set = ["--set", "records.at_level=sets.csv", "--set", "consistency.repair=none"];
    let check = study.uplift(&[&["check", "study.toml"], &set[..]].concat()).ok().stdout;
    let words = "factors of records.at_level are more than 3 times off the PGV of their level over that of the record";
    assert!(check.contains(words) && check.contains("100 times too large. Check the units of levels"), "{check}");
    let run = study.uplift(&[&["run", "study.toml", "-o", "sets.h5"], &set[..]].concat()).ok().stdout;
    for words in [words, "mistake?"] {
        assert!(run.contains(words), "{words}: {run}");
    }
    let warnings = study.uplift(&["warnings", "sets.h5"]).ok().stdout;
    assert!(warnings.contains("PGV 0.4 cm/s: its 12 records count as 12.0"), "{warnings}");
}
