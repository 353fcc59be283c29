//! What `uplift influence` and `uplift measures` found goes with the spectra to other programs.

use std::io::Read;

use serde_json::Value;
use uplift_labelled::LabelledReader;

use crate::common::{SMALL_STUDY, SmallStudy, repository};

const EXPORT: [&str; 7] = ["export", "r.h5", "--json", "--csv", "--mat", "--xlsx", "-q"];

fn json(study: &SmallStudy) -> Value {
    serde_json::from_slice(&std::fs::read(study.path().join("r.json")).unwrap()).unwrap()
}

fn head_of_table(study: &SmallStudy) -> String {
    std::fs::read_to_string(study.path().join("r.spectra.csv")).unwrap().lines().next().unwrap().to_owned()
}

fn sheets(study: &SmallStudy) -> String {
    part_of_workbook(study, "xl/workbook.xml")
}

fn part_of_workbook(study: &SmallStudy, name: &str) -> String {
    let file = std::fs::File::open(study.path().join("r.xlsx")).unwrap();
    let mut text = String::new();
    zip::ZipArchive::new(file).unwrap().by_name(name).unwrap().read_to_string(&mut text).unwrap();
    text
}

fn matlab_has(study: &SmallStudy, name: &str) -> bool {
    let bytes = std::fs::read(study.path().join("r.mat")).unwrap();
    bytes.windows(name.len()).any(|window| window == name.as_bytes())
}

#[test]
fn influence_and_efficiency_are_exported_once_they_are_there() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&EXPORT).ok();
    let none = json(&study);
    assert_eq!((&none["influence"], &none["efficiency"]), (&Value::Array(Vec::new()), &Value::Array(Vec::new())));
    assert!(none["spectra"][0]["disaggregation"].is_null());
    assert!(!head_of_table(&study).contains("level_p50") && !sheets(&study).contains("Influence"));

    study.uplift(&["influence", "r.h5", "-q"]).ok();
    study.uplift(&["measures", "r.h5", "-q"]).ok();
    study.uplift(&EXPORT).ok();
    let some = json(&study);
    // as the table beside the result has them
    let table = std::fs::read_to_string(study.path().join("r.influence.csv")).unwrap();
    let influence = some["influence"].as_array().unwrap();
    assert_eq!(influence.len(), table.lines().count() - 1);
    for (row, line) in influence.iter().zip(table.lines().skip(1)) {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!((row["site"].as_str().unwrap(), row["record"].as_str().unwrap()), (cells[0], cells[4]));
        assert_eq!(row["mean_change_pct"].as_f64(), cells[5].parse::<f64>().ok().filter(|value| value.is_finite()));
    }
    let of = &some["spectra"][0]["disaggregation"];
    assert_eq!(of["level_from"].as_array().unwrap().len(), 6);
    let shares: Vec<Vec<Option<f64>>> = serde_json::from_value(of["share"].clone()).unwrap();
    let sums: Vec<f64> = shares.iter().filter_map(|shares| shares.iter().copied().sum::<Option<f64>>()).collect();
    assert!(sums.len() > 5 && sums.iter().all(|sum| (sum - 1.0).abs() < 1e-9), "{sums:?}");
    let efficiency = some["efficiency"].as_array().unwrap();
    // PGV and PGA, by which records are scaled, and eight more
    assert_eq!((efficiency.len(), efficiency[0]["dispersion_rocking"].as_array().unwrap().len()), (10, 10));
    let names: Vec<&str> = efficiency.iter().map(|of| of["im"].as_str().unwrap()).collect();
    assert_eq!(names[..3], ["PGV", "PGA", "SA(0.5)"]);
    assert_eq!(efficiency[2]["scaled_to"], "PGV");
    assert!(efficiency[0]["trends"][0]["p_value"].as_array().unwrap().len() == 10, "{}", efficiency[0]);
    let head = head_of_table(&study);
    assert!(head.ends_with("level_p05,level_p50,level_p95,dispersion_rocking,dispersion_initiation"), "{head}");
    for name in [
        "share_pgv",
        "bin_pga",
        "u_without_pgv_m",
        "record",
        "dispersion_rocking_pga",
        "p_value_magnitude_pgv",
        "dispersion_level_sa_1s",
    ] {
        assert!(matlab_has(&study, name), "{name}");
    }
    let sheets = sheets(&study);
    for name in ["Influence", "Disaggregation", "Efficiency", "Flags and tails"] {
        assert!(sheets.contains(&format!("name=\"{name}\"")), "{name}: {sheets}");
    }

    // the influence is of the probabilities of the study, the efficiency of the stripes
    study.uplift(&[&EXPORT[..], &["--poe", "0.05"]].concat()).ok();
    let asked = json(&study);
    assert_eq!(asked["influence"], Value::Array(Vec::new()));
    assert_eq!(asked["efficiency"], some["efficiency"]);
}

#[test]
fn repaired_spectra_are_exported_where_there_are_some() {
    let study = SmallStudy::repaired();
    study.uplift(&["consistency", "r.h5", "-q"]).ok();
    study.uplift(&EXPORT).ok();
    let some = json(&study);
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let [u_m, c1] =
        ["u_m", "regression/c1"].map(|name| reader.array::<f64>(&format!("/consistency/pgv/{name}")).unwrap().values);
    let spectra = some["spectra"].as_array().unwrap();
    assert_eq!(spectra.len(), 12);
    // by PGV, the first site could not be repaired, the second was: its rarest probability stands fourth
    assert!(spectra[..3].iter().all(|spectrum| spectrum.get("u_consistent_m").is_none()));
    let said: Vec<f64> = serde_json::from_value(spectra[3]["u_consistent_m"].clone()).unwrap();
    assert_eq!(said, u_m[12..16]);
    assert_eq!(spectra[3]["fit_consistent"]["c1"].as_f64().unwrap(), c1[3]);
    let found = some["consistency"].as_array().unwrap();
    let of: Vec<[&str; 4]> = found
        .iter()
        .map(|row| ["site", "scaled_to", "shows", "verdict"].map(|key| row[key].as_str().unwrap()))
        .collect();
    assert_eq!(of[1], ["Athens &lt; 1", "PGV", "PGA", "inconsistent"]);
    assert_eq!(found.len(), 4);
    assert!(found[0]["least_effective_records"].is_null() && found[1]["least_effective_records"].as_f64() > Some(5.0));
    let few = some["alarms"].as_array().unwrap().iter().find(|alarm| alarm["kind"] == "few-effective-records");
    let least = found.iter().filter_map(|row| row["least_effective_records"].as_f64()).fold(f64::INFINITY, f64::min);
    let least = format!("{least:.1} effective records (20 advised)");
    assert!(few.is_some_and(|alarm| alarm["what"].as_str().unwrap().ends_with(&least)), "{few:?}, not {least}");
    // the table beside the result says the same
    let table = std::fs::read_to_string(study.path().join("r.consistency.csv")).unwrap();
    let column = |name: &str| table.lines().next().unwrap().split(',').position(|own| own == name).unwrap();
    let (ratio, bias) = (column("ratio"), column("bias"));
    for (index, line) in table.lines().skip(1).enumerate() {
        let cell = |column: usize| line.split(',').nth(column).unwrap().parse::<f64>().unwrap();
        let row = &found[index / 3];
        assert_eq!(row["ratio"][index % 3].as_f64().unwrap(), cell(ratio), "{line}");
        assert_eq!(row["bias"].as_f64().unwrap(), cell(bias), "{line}");
    }

    let spectra = std::fs::read_to_string(study.path().join("r.spectra.csv")).unwrap();
    // the ordinate before both limits of its band
    let repaired: Vec<&str> = spectra.lines().map(|line| line.rsplit(',').nth(2).unwrap()).collect();
    assert_eq!((repaired[0], repaired[1]), ("u_consistent_m", ""));
    assert_eq!(repaired[13].parse::<f64>().unwrap(), u_m[12]);
    for name in ["u_consistent_pgv_m", "c1_consistent_pga", "consistency_ratio_pga", "consistency_verdict_pgv"] {
        assert!(matlab_has(&study, name), "{name}");
    }
    for name in ["Consistency", "Consistent spectra", "Consistent coefficients"] {
        assert!(sheets(&study).contains(&format!("name=\"{name}\"")), "{name}");
    }

    // of other probabilities they are made again, and without a repair nothing is said of them
    study.uplift(&[&EXPORT[..], &["--poe", "0.02,0.05,0.3"]].concat()).ok();
    study.uplift(&["run", "study.toml", "-o", "plain/r.h5", "-q", "--set", "consistency.repair=\"none\""]).ok();
    study.uplift(&[&["export", "plain/r.h5"], &EXPORT[2..]].concat()).ok();
    for (folder, is_repaired) in [("", true), ("plain", false)] {
        let folder = study.path().join(folder);
        let text = std::fs::read_to_string(folder.join("r.json")).unwrap();
        assert!(text.contains("\"consistency\""), "{text}");
        assert_eq!(text.contains("_consistent"), is_repaired, "{text}");
        let head = std::fs::read_to_string(folder.join("r.spectra.csv")).unwrap();
        assert_eq!(head.contains("u_consistent_m"), is_repaired, "{head}");
    }
}

#[test]
fn what_has_one_hazard_curve_is_exported_as_ever() {
    let study = SmallStudy::with(
        &SMALL_STUDY.replace("pga = \"pga.csv\"\n", "").replace("[pga]\nlevels_g = [0.02, 0.1, 0.3, 1.0]\n", ""),
    );
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&EXPORT).ok();
    assert!(json(&study).get("consistency").is_none());
    assert!(!sheets(&study).contains("Consisten") && !matlab_has(&study, "consisten"));
}

#[test]
fn the_page_gets_stripes_hazard_and_warnings_without_a_path() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["export", "r.h5", "--web", "-q"]).ok();
    let text = std::fs::read_to_string(study.path().join("r.web.json")).unwrap();
    assert!(!text.contains(study.path().to_str().unwrap()), "a path of this machine");
    let page: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((page["format"].as_str(), page["synthetic"].as_bool()), (Some("uplift-web-1"), Some(true)));
    let result = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let (records, strengths) =
        (page["records"].as_array().unwrap().len(), result.axis::<f64>("strength").unwrap().len());
    for own in page["measures"].as_array().unwrap() {
        let (levels, peaks_m) = (own["levels"].as_array().unwrap(), own["peaks_m"].as_array().unwrap());
        assert_eq!(peaks_m.len(), records * strengths * levels.len());
        let stored = result.array::<f64>(&format!("/ida/{}/edp_m", own["im"].as_str().unwrap())).unwrap().values;
        // an infinite peak is null
        let same = |(a, b): (&Value, &f64)| a.as_f64() == Some(*b).filter(|peak_m| peak_m.is_finite());
        assert!(peaks_m.iter().zip(&stored).all(same));
    }
    let site = page["sites"][0]["name"].as_str().unwrap();
    let shown = study.uplift(&["spectrum", "r.h5", "--site", site, "--poe", "0.5,0.1,0.02", "--json"]).ok();
    let shown: Value = serde_json::from_str(&shown.stdout).unwrap();
    // a mean of one says nothing of records that miss the hazard at some rates
    assert!(text.contains("times the site's PGA") && !text.contains("have 1.0 times"));
    // those of risks that were asked for come in another order
    let sorted = |alarms: &Value| {
        let mut alarms: Vec<String> = alarms.as_array().unwrap().iter().map(Value::to_string).collect();
        alarms.sort();
        alarms
    };
    assert_eq!(sorted(&page["sites"][0]["curves"][0]["alarms"]), sorted(&shown["alarms"]));
    // it is the program's own, and may be written again
    study.uplift(&["export", "r.h5", "--web", "-q"]).ok();
}

/// Names in backticks in the row of `docs/tables.md` that begins with `` `<result>.KIND.csv` ``.
fn documented(page: &str, kind: &str) -> Vec<String> {
    let start = format!("| `<result>.{kind}.csv` | ");
    let row = page.lines().find_map(|line| line.strip_prefix(&start)).unwrap_or_else(|| panic!("no row of {kind}"));
    row.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

#[test]
fn tables_beside_a_result_have_the_columns_that_the_documents_name() {
    let study = SmallStudy::repaired();
    for job in [&["bootstrap", "--replicates", "100"][..], &["consistency"], &["influence"], &["measures"]] {
        study.uplift(&[&job[..1], &["r.h5", "-q"], &job[1..]].concat()).ok();
    }
    let page = std::fs::read_to_string(repository().join("docs/tables.md")).unwrap();
    let columns = |kind: &str| -> Vec<String> {
        let path = study.path().join(format!("r.{kind}.csv"));
        let table = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        table.lines().next().unwrap().split(',').map(str::to_owned).collect()
    };
    // not compared: what stands in words (covariates, names that begin alike), and bands over weighted hazard curves
    for (kind, is_whole) in [
        ("urs", true),
        ("regression", true),
        ("consistency", true),
        ("influence", true),
        ("bands", false),
        ("table-4-1", false),
        ("measures", false),
    ] {
        let (documented, written) = (documented(&page, kind), columns(kind));
        let is_name = |name: &&String| !name.contains('…') && !name.contains("_joint");
        let missing: Vec<_> = documented.iter().filter(is_name).filter(|name| !written.contains(name)).collect();
        assert!(missing.is_empty(), "{kind}: {missing:?} are not among {written:?}");
        let untold: Vec<_> = written.iter().filter(|name| is_whole && !documented.contains(name)).collect();
        assert!(untold.is_empty(), "{kind}: {untold:?} are not in the documents");
    }
}

/// Every export has the band that `spectrum --repaired` prints, without a bootstrap.
#[test]
fn repaired_spectra_have_their_quoted_band_in_every_export() {
    let study = SmallStudy::repaired();
    study.uplift(&["export", "r.h5", "--json", "--csv", "--mat", "--xlsx", "--poe", "0.02", "-q"]).ok();
    let spectra = json(&study)["spectra"].as_array().unwrap().clone();
    let spectrum = spectra.iter().find(|own| own["im"] == "PGA" && own.get("u_consistent_m").is_some()).unwrap();
    let strengths = json(&study)["strength"].as_array().unwrap().iter().map(Value::to_string).collect::<Vec<_>>();
    let site = spectrum["site"].as_str().unwrap();
    let asked = ["spectrum", "r.h5", "--repaired", "--measure", "pga", "--poe", "0.02", "--csv", "--site", site];
    let printed = study.uplift(&[&asked[..], &["--strength", &strengths.join(",")]].concat()).ok().stdout;
    let row = |line: &str| line.split(',').rev().take(3).map(|cell| cell.parse().ok()).collect::<Vec<Option<f64>>>();
    let expected: Vec<Vec<Option<f64>>> = printed.lines().skip(1).map(row).collect();
    assert!(expected.len() == strengths.len() && expected[0][0] > expected[0][2], "{printed}");
    for (place, name) in ["upper_consistent_m", "lower_consistent_m", "u_consistent_m"].iter().enumerate() {
        let exported: Vec<Option<f64>> = serde_json::from_value(spectrum[*name].clone()).unwrap();
        let expected: Vec<Option<f64>> =
            expected.iter().map(|row| row[place].filter(|value| value.is_finite())).collect();
        assert_eq!(exported, expected, "{name}");
        assert!(head_of_table(&study).contains(name), "{}", head_of_table(&study));
        assert!(matlab_has(&study, &name.replace("_m", "_pga_m")), "{name}");
    }
    let place = sheets(&study).split("<sheet ").position(|sheet| sheet.contains("\"Consistent spectra\""));
    let sheet = part_of_workbook(&study, &format!("xl/worksheets/sheet{}.xml", place.unwrap()));
    // a column of strengths, and three of either measure of the repaired site
    assert!(sheet.contains("<c r=\"G6\"") && !sheet.contains("<c r=\"H6\""), "{sheet:.3000}");
}

/// The percentiles of resamples are called as in every other format.
#[test]
fn percentiles_of_resamples_are_not_called_as_the_quoted_band() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-q", "-o", "r.h5", "--set", "bootstrap.confidence=0.8"]).ok();
    study.uplift(&["bootstrap", "r.h5", "-q", "--replicates", "20"]).ok();
    study.uplift(&["export", "r.h5", "--json", "-q"]).ok();
    let band = json(&study)["spectra"][0]["bands"][0].clone();
    assert!(["u10_m", "u50_m", "u90_m"].iter().all(|name| band[name].is_array()), "{band}");
    assert!(band.get("lower_m").is_none() && band.get("upper_m").is_none(), "{band}");
}
