//! Many sites whose records are weighed: each as the same curves are as one of the sites of a study.

use std::fmt::Write as _;

use serde_json::Value;
use uplift_labelled::LabelledReader;

use crate::common::SmallStudy;
use crate::site_table::{PGA_LEVELS, PGV_LEVELS, SITES, Site, files, many, openquake, read, rows};

/// Two sites of the table as sites of the study.
const NAMES: [&str; 2] = ["alpha", "delta"];

#[test]
fn every_site_is_repaired_as_one_of_the_sites_is() {
    let both = ["alpha", "delta"]
        .map(|name| format!("[[sites]]\nname = \"{name}\"\npgv = \"{name}/pgv.csv\"\npga = \"{name}/pga.csv\"\n"));
    let study = many(&format!(
        "[records.synthetic]\npairs = 40\n[strengths]\nvalues = [0.05, 0.1, 0.2, 0.4]\n\
         [pgv]\nlevels_cm_s = [0.5, 1, 2, 4, 8, 15, 30, 60, 120]\n\
         [pga]\nlevels_g = [0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.6, 1.2]\n\
         [risk]\npoe = [0.1, 0.5]\nmaf_surface = false\n[regression]\nstrength_above = 0\n\
         [site_table]\npgv = \"pgv-export.csv\"\npga = \"pga-export.csv\"\nbands = true\n\
         {}[consistency]\nrepair = \"weights\"\n",
        both.concat()
    ));
    // of PGA such that the records come near it at some sites, and nowhere near at one
    let with = |factor: f64| -> Vec<Site> {
        let of = |&(name, lon, lat, k0): &Site| (name, lon, lat, if name == "gamma" { 4e-3 * k0 } else { factor * k0 });
        SITES.iter().map(of).collect()
    };
    study.write("pga-export.csv", &openquake("PGA", &PGA_LEVELS, &with(1.6e-4)));
    for name in ["alpha", "delta"] {
        study.uplift(&["hazard", "import", "pgv-export.csv", "pga-export.csv", "-o", name, "--name", name]).ok();
    }
    study.uplift(&["run", "study.toml", "-o", "r.h5", "--set", "risk.extrapolate=loglog"]).ok();
    let file = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let spectra = rows(&read(study.path(), "r.sites.csv"), &["u_m", "u_consistent_m"]);
    let coefficients = read(study.path(), "r.sites.coefficients.csv");
    let columns = ["bias", "verdict", "least_effective", "c0_consistent_m", "no_repair"];
    let coefficients = rows(&coefficients, &columns);
    for (measure, label) in [("pgv", "PGV"), ("pga", "PGA")] {
        let array = |name: &str| file.array::<f64>(&format!("/consistency/{measure}/{name}")).unwrap().values;
        let other = if measure == "pgv" { "pga" } else { "pgv" };
        let (u_m, bias, c0) = (array("u_m"), array(&format!("{other}_bias")), array("regression/c0_m"));
        for (site, name) in ["alpha", "delta"].into_iter().enumerate() {
            for (poe, key) in ["0.1", "0.5"].into_iter().enumerate() {
                let ours = &spectra[&format!("{name} {label} {key}")];
                for (strength, row) in ours.iter().enumerate() {
                    let expected = u_m[(site * 2 + poe) * 4 + strength];
                    assert_eq!(row[1].parse::<f64>().unwrap().to_bits(), expected.to_bits(), "{name} {label} {key}");
                }
                assert!(ours.iter().any(|row| row[0] != row[1]), "{ours:?}");
                let row = &coefficients[&format!("{name} {label} {key}")][0];
                assert_eq!(row[0].parse::<f64>().unwrap().to_bits(), bias[site].to_bits());
                assert_eq!(row[3].parse::<f64>().unwrap().to_bits(), c0[site * 2 + poe].to_bits());
                assert!(row[2].parse::<f64>().unwrap() > 1.0 && !row[1].is_empty() && row[4].is_empty(), "{row:?}");
            }
        }
    }
    // no hazard, and a hazard that no weights of these records bring
    assert!(coefficients["sea PGV 0.1"][0][4].starts_with("PGV: no hazard"), "{:?}", coefficients["sea PGV 0.1"]);
    assert!(coefficients["gamma PGV 0.1"][0][4].len() > 20, "{:?}", coefficients["gamma PGV 0.1"]);
    assert!(spectra["gamma PGV 0.1"].iter().all(|row| !row[0].is_empty() && row[1].is_empty()));
    let warnings = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    assert!(warnings.contains("2 of 5 sites have no repaired spectrum: the column `no_repair` says why"), "{warnings}");
    let map: Value = serde_json::from_str(&read(study.path(), "r.sites.geojson")).unwrap();
    let alpha = map["features"].as_array().unwrap().iter().find(|site| site["properties"]["name"] == "alpha").unwrap();
    let on_map = alpha["properties"]["pgv_10pct_50yr_consistent_u_m_at_0.2"].as_f64().unwrap();
    assert_eq!(on_map.to_bits(), spectra["alpha PGV 0.1"][2][1].parse::<f64>().unwrap().to_bits());
    bands_are_those_of_sites(&study, &alpha["properties"]);
}

/// The bands of the table are to the bit those that the sites of the study have.
fn bands_are_those_of_sites(study: &SmallStudy, on_map: &Value) {
    let table = read(study.path(), "r.sites.csv");
    let plain = rows(&table, &["u_m", "lower_m", "upper_m"]);
    let repaired = rows(&table, &["u_consistent_m", "lower_consistent_m", "upper_consistent_m"]);
    let all = ["spectrum", "r.h5", "--strength", "0.05,0.1,0.2,0.4", "--poe", "0.1,0.5", "--csv", "--measure"];
    for measure in ["pgv", "pga"] {
        for (more, ours) in [(&[][..], &plain), (&["--repaired"], &repaired)] {
            let csv = study.uplift(&[&all[..], &[measure], more].concat()).ok().stdout;
            let expected = rows(&csv, &["u_m", "lower_m", "upper_m"]);
            assert_eq!(expected.len(), 2 * 2);
            for (key, expected) in &expected {
                let numbers = |rows: &[Vec<String>]| -> Vec<f64> {
                    rows.iter().flatten().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()
                };
                let (ours, expected) = (numbers(&ours[key]), numbers(expected));
                assert!(ours.len() == 4 * 3 && ours.iter().all(|value| value.is_finite()), "{key} {ours:?}");
                assert_eq!(ours, expected, "{key}");
                assert!(ours.chunks(3).all(|row| row[1] < row[0] && row[0] < row[2]), "{key} {ours:?}");
            }
        }
    }
    let [lower_m, upper_m] = ["lower_m", "upper_m"].map(|limit| {
        [format!("pgv_10pct_50yr_{limit}_at_0.2"), format!("pgv_10pct_50yr_consistent_{limit}_at_0.2")]
            .map(|key| on_map[&key].as_f64().unwrap())
    });
    for (at, of) in [&plain, &repaired].into_iter().enumerate() {
        let row = &of["alpha PGV 0.1"][2];
        assert_eq!([&row[1], &row[2]].map(|cell| cell.parse::<f64>().unwrap()), [lower_m[at], upper_m[at]]);
    }
}

/// A study by PGV alone, of the records that `more` says; the exports of both measures are at hand, and two sites of
/// theirs stand in it as sites.
fn by_pgv(more: &str) -> SmallStudy {
    let site = |name| format!("[[sites]]\nname = \"{name}\"\npgv = \"{name}/pgv.csv\"\npga = \"{name}/pga.csv\"\n");
    let sites = NAMES.map(site).concat();
    let study = many(&format!(
        "[records.synthetic]\npairs = 105\n[strengths]\nvalues = [0.05, 0.1, 0.2, 0.4]\n\
         [pgv]\nlevels_cm_s = [\"0.5:0.25:8\", \"9:1:40\", \"45:5:120\"]\n\
         [risk]\npoe = [0.1, 0.5]\nmaf_surface = false\nextrapolate = \"loglog\"\n[regression]\nstrength_above = 0\n\
         [site_table]\npgv = \"pgv-export.csv\"\npga = \"pga-export.csv\"\n{sites}\
         [consistency]\nrepair = \"weights\"\n{more}"
    ));
    study.write("pgv-export.csv", &openquake("PGV", &PGV_LEVELS, &SITES));
    let rarer: Vec<Site> = SITES.iter().map(|&(name, lon, lat, k0)| (name, lon, lat, 1.6e-4 * k0)).collect();
    study.write("pga-export.csv", &openquake("PGA", &PGA_LEVELS, &rarer));
    for name in NAMES {
        study.uplift(&["hazard", "import", "pgv-export.csv", "pga-export.csv", "-o", name, "--name", name]).ok();
    }
    study
}

/// Runs it; every number of a site of the table is to the bit that of the site of the study, and all are given back,
/// `[site, poe, strength]`.
fn run_and_compare(study: &SmallStudy, result: &str, more: &[&str]) -> Vec<f64> {
    study.uplift(&[&["run", "study.toml", "-o", &format!("{result}.h5"), "-q"][..], more].concat()).ok();
    let file = LabelledReader::open(&study.path().join(format!("{result}.h5"))).unwrap();
    let array = |name: &str| file.array::<f64>(&format!("/consistency/pgv/{name}")).unwrap().values;
    let (u_m, bias, c0_m) = (array("u_m"), array("pga_bias"), array("regression/c0_m"));
    let spectra = rows(&read(study.path(), &format!("{result}.sites.csv")), &["u_m", "u_consistent_m"]);
    let columns = ["bias", "c0_consistent_m", "no_repair", "least_effective"];
    let coefficients = rows(&read(study.path(), &format!("{result}.sites.coefficients.csv")), &columns);
    let number = |text: &str| text.parse::<f64>().unwrap();
    for (site, name) in NAMES.into_iter().enumerate() {
        for (poe, key) in ["0.1", "0.5"].into_iter().enumerate() {
            let ours = &spectra[&format!("{name} PGV {key}")];
            assert!(ours.iter().any(|row| row[0] != row[1]), "{ours:?}");
            for (strength, row) in ours.iter().enumerate() {
                assert_eq!(number(&row[1]).to_bits(), u_m[(site * 2 + poe) * 4 + strength].to_bits(), "{name} {key}");
            }
            let row = &coefficients[&format!("{name} PGV {key}")][0];
            assert_eq!(number(&row[0]).to_bits(), bias[site].to_bits(), "{name}");
            assert_eq!(number(&row[1]).to_bits(), c0_m[site * 2 + poe].to_bits(), "{name} {key}");
            assert!(row[2].is_empty() && number(&row[3]) > 1.0, "{row:?}");
        }
    }
    assert!(coefficients.keys().all(|key| key.contains(" PGV ")), "there are no spectra by PGA");
    assert!(coefficients["sea PGV 0.1"][0][2].starts_with("PGV: no hazard"), "{:?}", coefficients["sea PGV 0.1"]);
    u_m
}

#[test]
#[ignore = "long: make test-long"]
fn the_other_hazard_may_use_an_unanalysed_measure() {
    let study = by_pgv("");
    let told = study.uplift(&["check", "study.toml"]).ok();
    assert!(format!("{}{}", told.stdout, told.stderr).contains("5 found in the export of PGA"), "{}", told.stderr);
    let plain = run_and_compare(&study, "r", &[]);
    run_and_compare(&study, "one", &["--threads", "1"]);
    assert_eq!(files(study.path(), "r"), files(study.path(), "one"));
    let checksums =
        LabelledReader::open(&study.path().join("r.h5")).unwrap().attribute::<String>("/", "input_checksums");
    assert!(checksums.unwrap().contains("site table PGA\""));
    // of other definitions of the measures both are other curves
    let of = "hazard.conversions=[{ from = \"RotD50\", to = \"geometric mean\", pgv = 0.95, pga = 0.8 }]";
    let converted = run_and_compare(&study, "c", &["--set", "hazard.component=RotD50", "--set", of]);
    assert_ne!(plain, converted);
    // without a repair it is not looked at
    study.uplift(&["run", "study.toml", "-o", "n.h5", "-q", "--set", "consistency.repair=none"]).ok();
    assert!(!read(study.path(), "n.sites.csv").contains("consistent"));
    let [with, without] =
        ["r", "n"].map(|name| rows(&read(study.path(), &format!("{name}.sites.csv")), &["u_m", "flag"]));
    assert_eq!(with, without);
}

#[test]
#[ignore = "long: make test-long"]
fn levels_with_records_of_their_own_are_repaired_at_every_site() {
    let study = by_pgv("");
    let alike = run_and_compare(&study, "r", &[]);
    let file = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let (names, levels) = (file.axis::<String>("record").unwrap(), file.axis::<f64>("pgv_level").unwrap());
    let pgv = file.array::<f64>("/records/pgv_cm_s").unwrap().values;
    // five of six records at each level, with weights
    let mut table = "record_id,pgv_cm_s,factor,weight\n".to_owned();
    for (index, level) in levels.iter().enumerate() {
        for (record, (name, pgv)) in names.iter().zip(&pgv).enumerate() {
            if (record + index / 4) % 6 > 0 {
                writeln!(table, "{name},{level},{},{}", level / pgv, 1 + record % 4).unwrap();
            }
        }
    }
    study.write("sets.csv", &table);
    let set = ["--set", "records.at_level=sets.csv"];
    let own = run_and_compare(&study, "sets", &set);
    assert_ne!(own, alike, "each level has other records");
    run_and_compare(&study, "one", &[&set[..], &["--threads", "1"]].concat());
    assert_eq!(files(study.path(), "sets"), files(study.path(), "one"));
    let map: Value = serde_json::from_str(&read(study.path(), "sets.sites.geojson")).unwrap();
    let alpha = map["features"].as_array().unwrap().iter().find(|site| site["properties"]["name"] == "alpha").unwrap();
    assert_eq!(
        alpha["properties"]["pgv_10pct_50yr_consistent_u_m_at_0.2"].as_f64().unwrap().to_bits(),
        own[2].to_bits()
    );
}

#[test]
#[ignore = "long: make test-long"]
fn a_measure_that_only_the_table_has_may_be_asked_against() {
    let study = by_pgv("against = \"pga\"\n");
    study.uplift(&["check", "study.toml"]).ok();
    let text = read(study.path(), "study.toml");
    study.write("study.toml", &text.replace("\npga = \"alpha/pga.csv\"", "").replace("\npga = \"delta/pga.csv\"", ""));
    study.uplift(&["check", "study.toml"]).ok();
    study.write("study.toml", &read(study.path(), "study.toml").replace("pga = \"pga-export.csv\"\n", ""));
    study.uplift(&["check", "study.toml"]).fails(3, &["consistency.against", "no site has a curve of PGA"]);
    study.uplift(&["check", "study.toml", "--set", "site_table.d5_75=\"pga-export.csv\""]).fails(3, &["d5_75"]);
}
