//! Whether the records bring the hazard of the other measure: `uplift consistency`, and what a run says of it.

use serde_json::Value;
use uplift::consistency::Verdict;
use uplift::result::ResultFile;
use uplift_motion::IntensityMeasure;

use crate::common::{Finished, SmallStudy, array, repository};

/// 105 synthetic pairs at Montreux and Athens, three strengths, the stripes of Chapter 4.
fn study(measures: &str, sites: &str, more: &str) -> SmallStudy {
    let hazard = repository().join("hazard").display().to_string();
    let site = |name: &str| {
        let file = |measure: &str| format!("{measure} = '{hazard}/{}/{measure}.csv'", name.to_lowercase());
        let curves: Vec<String> = sites.split(' ').map(file).collect();
        format!("[[sites]]\nname = \"{name}\"\n{}\n", curves.join("\n"))
    };
    SmallStudy::with(&format!(
        "[strengths]\nvalues = [0.1, 0.2, 0.4]\n{measures}\n[risk]\nmaf_surface = false\n[hazard]\nconversions = \
         [{{ from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }}]\n{}{}{more}",
        site("Montreux"),
        site("Athens")
    ))
}

const BOTH: &str = "[pgv]\nlevels_cm_s = [\"1:0.5:20\", \"25:5:200\"]\n[pga]";

fn json(finished: &Finished) -> Value {
    serde_json::from_str(&finished.stdout).unwrap()
}

fn row<'a>(report: &'a Value, site: &str, scaled_to: &str) -> &'a Value {
    let rows = report["rows"].as_array().unwrap();
    rows.iter().find(|row| row["site"] == site && row["scaled_to"] == scaled_to).unwrap()
}

/// The numbers of every plain array.
fn plain(study: &SmallStudy, name: &str) -> Vec<u64> {
    let file = ResultFile::open(&study.path().join(name)).unwrap();
    let spectra = file.spectra().unwrap();
    let mut numbers: Vec<f64> = Vec::new();
    for measure in &spectra.measures {
        for values in [&measure.u_m, &measure.lower_tail_share, &measure.upper_tail_share] {
            numbers.extend(values.values());
        }
        numbers.extend(measure.fits.values().iter().flat_map(|fit| [fit.c0_m, fit.c1, fit.c2_m, fit.rmse_m]));
    }
    numbers.into_iter().map(f64::to_bits).collect()
}

#[test]
#[ignore = "long: make test-long"]
fn asked_in_every_run_and_repaired_beside_the_plain_spectra() {
    let study = study(BOTH, "pgv pga", "");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let warnings = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    assert!(warnings.contains("Montreux by PGA: scaled records have "), "{warnings}");
    assert!(
        warnings.contains(" times the site's PGV.\n          Repair: uplift consistency r.h5 --repair"),
        "{warnings}"
    );
    let before = plain(&study, "r.h5");

    let asked = json(&study.uplift(&["consistency", "r.h5", "--json", "-q"]).ok());
    assert_eq!(asked["rows"].as_array().unwrap().len(), 4);
    let by_pga = row(&asked, "Montreux", "PGA");
    assert_eq!((&by_pga["shows"], &by_pga["verdict"]), (&Value::from("PGV"), &Value::from("inconsistent")));
    // by definition: exp of the mean, and levels over levels
    assert!(by_pga["bias"].as_f64().unwrap() > 1.33);
    for target in by_pga["targets"].as_array().unwrap() {
        let number = |key: &str| target[key].as_f64().unwrap();
        assert!((number("implied_level") / number("site_level") / number("ratio") - 1.0).abs() < 1e-12);
    }
    assert!(by_pga["repair"].is_null());

    let repaired = json(&study.uplift(&["consistency", "r.h5", "--repair", "--json", "-q"]).ok());
    let by_pga = row(&repaired, "Montreux", "PGA");
    assert!(by_pga["repair"]["max"].as_f64().unwrap() < 0.05 && by_pga["repair"]["failed"].is_null(), "{by_pga}");
    // the ordinates by both measures come together
    let all = repaired["agreement"].as_array().unwrap().last().unwrap();
    let mean = |key: &str| all[key][1].as_f64().unwrap();
    assert!(mean("plain") > 1.5 && (mean("repaired") - 1.0).abs() < 0.1, "{all}");
    assert_eq!(plain(&study, "r.h5"), before, "a repair changed a plain number");
    // asked again, the repair stays; asked for another risk, it is read off the same weights
    study.uplift(&["consistency", "r.h5", "-q"]).ok();
    let rows = |poes: &str| -> Vec<Value> {
        let table = json(&study.uplift(&["table", "r.h5", "--measure", "all", "--poe", poes, "--json"]).ok());
        let all = table["rows"].as_array().unwrap().iter();
        all.filter(|row| row["repaired"] == true && row["poe"] == 0.1).cloned().collect()
    };
    assert_eq!(rows("0.1"), rows("0.02,0.1,0.5"));
    assert_eq!(rows("0.1").len(), 4);
    let table = std::fs::read_to_string(study.path().join("r.consistency.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 4 * 3);

    // the same by the study's own key, in one go
    study.uplift(&["run", "study.toml", "-o", "k.h5", "-q", "--set", "consistency.repair=weights"]).ok();
    assert_eq!(plain(&study, "k.h5"), before);
    let spectra = |name: &str| -> Vec<u64> {
        let found = ResultFile::open(&study.path().join(name)).unwrap().consistency().unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].scaled_to, found[0].other), (IntensityMeasure::Pgv, IntensityMeasure::Pga));
        let u_m = found.iter().flat_map(|found| found.u_m.as_ref().unwrap().values().to_vec());
        u_m.map(f64::to_bits).collect()
    };
    assert_eq!(spectra("r.h5"), spectra("k.h5"));
    let told = study.uplift(&["run", "study.toml", "-o", "k.h5", "--set", "consistency.repair=weights"]).ok();
    assert!(told.stdout.contains("Repaired uniform risk spectra, "), "{}", told.stdout);
    // and on any number of threads
    study
        .uplift(&["run", "study.toml", "-o", "t.h5", "-q", "--threads", "1", "--set", "consistency.repair=weights"])
        .ok();
    assert_eq!(spectra("t.h5"), spectra("k.h5"));
}

#[test]
fn a_verdict_can_be_required() {
    let study = study(BOTH, "pgv pga", "");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
        .uplift(&["consistency", "r.h5", "-q", "--require", "off"])
        .fails(4, &["--require off", "Montreux by PGA: inconsistent"]);
    study.uplift(&["consistency", "r.h5", "-q", "--require", "sound"]).fails(2, &["--require"]);
    // the answer comes first: by which measure, and by what factor; then what to do
    let said = study.uplift(&["consistency", "r.h5"]).ok().stdout;
    let rows = json(&study.uplift(&["consistency", "r.h5", "--json", "-q"]).ok())["rows"].clone();
    let bias = rows.as_array().unwrap().iter().find(|row| row["scaled_to"] == "PGA").unwrap()["bias"].as_f64().unwrap();
    // of one risk the number would be another
    let miss = format!("ecords scaled to PGA have {bias:.2} times the site's PGV (mean over rates, ");
    let mut lines = said.lines();
    assert!(lines.next().is_some_and(|first| first.contains(&miss)), "{said}");
    assert_eq!(lines.next(), Some("Repair: uplift consistency r.h5 --repair"), "{said}");
    assert!(said.contains("times site's level, mean"), "{said}");
    // what decides: the mean, and the worst rate
    let legend = "\nconsistent: 0.9 to 1.1, factor 1.16 at worst; off: 0.75 to 1.33, factor 1.49 at worst\n";
    assert!(said.contains(legend), "{said}");
    // a mean that is right is not all that a verdict rests on
    let said = study.uplift(&["check", "study.toml", "--details"]).ok().stdout;
    let asked = json(&study.uplift(&["consistency", "r.h5", "--json", "-q"]).ok());
    let mut told = 0;
    for row in asked["rows"].as_array().unwrap().iter().filter(|row| row["verdict"] != "consistent") {
        let (bias, most) = (row["bias"].as_f64().unwrap(), row["max"].as_f64().unwrap().exp());
        let words = format!(
            "times the site's {}, and miss it by a factor of {most:.2} at the worst rate",
            row["shows"].as_str().unwrap()
        );
        let is_more = most > 1.1 * bias.max(1.0 / bias);
        assert_eq!(said.contains(&words), is_more, "{words}: {said}");
        told += usize::from(is_more);
    }
    assert!(told > 0, "{said}");
}

/// Each row of the table has what the records were before the repair, and what they are after it.
#[test]
fn a_repair_is_seen_to_have_worked() {
    let study = SmallStudy::repaired();
    let said = study.uplift(&["consistency", "r.h5", "--repair"]).ok().stdout;
    let found = study.uplift(&["consistency", "r.h5", "--json"]).json();
    let rows = found["rows"].as_array().unwrap();
    let repaired = rows.iter().filter(|row| row["repair"]["failed"].is_null()).count();
    assert!(repaired > 0 && repaired < rows.len(), "{found}");
    let first = format!("{repaired} of {} cases repaired: uplift spectrum r.h5 --repaired", rows.len());
    assert!(said.starts_with(&first), "{said}");
    let table = said.lines().skip_while(|line| !line.starts_with("site ")).skip(1);
    let shown: Vec<String> = table.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    for row in rows {
        let text = |key: &str| row[key].as_str().unwrap();
        let repair = &row["repair"];
        let number = |key: &str| repair[key].as_f64().unwrap();
        let after = if repair["failed"].is_null() {
            let verdict = Verdict::from_bias(number("bias"), number("max"));
            let records = format!("{:.0}/{}", number("least_effective"), repair["least_effective_of"]);
            format!(" {:.2} {verdict} {records}", number("bias"))
        } else {
            String::new()
        };
        let (begin, end) = (format!("{} {} ", text("site"), text("scaled_to")), format!("{}{after}", text("verdict")));
        assert!(shown.iter().any(|line| line.starts_with(&begin) && line.ends_with(&end)), "{begin}{end}: {said}");
    }
}

#[test]
#[ignore = "long: make test-long"]
fn the_curve_of_an_unanalysed_measure_is_enough() {
    let study = study("[pgv]", "pgv pga", "");
    let check = study.uplift(&["check", "study.toml", "--details"]).ok();
    assert!(check.stdout.contains("Hazard    Montreux by PGV: the records have"), "{}", check.stdout);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let asked = json(&study.uplift(&["consistency", "r.h5", "--json", "-q"]).ok());
    assert_eq!(asked["rows"].as_array().unwrap().len(), 2);
    assert_eq!(row(&asked, "Athens", "PGV")["shows"], "PGA");
    assert!(asked["agreement"].as_array().unwrap().is_empty());
    // it is an input like any other
    study.uplift(&["verify", "r.h5"]).ok();
    study.write(
        "study.toml",
        &std::fs::read_to_string(study.path().join("study.toml")).unwrap().replace("pga.csv", "x.csv"),
    );
    study.uplift(&["run", "study.toml", "-o", "x.h5", "-q"]).fails(3, &["x.csv"]);
}

#[test]
fn one_curve_alone_answers_nothing_and_is_no_error() {
    let study = study("[pgv]", "pgv", "");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let told = study.uplift(&["consistency", "r.h5"]).ok();
    assert!(told.stdout.contains("no site has hazard curves of two measures"), "{}", told.stdout);
    study.uplift(&["consistency", "r.h5", "--require", "off"]).fails(4, &["no site has hazard curves"]);
}

#[test]
fn mistakes_in_the_section_are_named() {
    let more = "[consistency]\nrepair = \"weight\"\nsmoothness = 0\nleast_effective = 0\nscale_factors = [5, 0.2]\n";
    let study = study(BOTH, "pgv pga", more);
    study.uplift(&["check", "study.toml"]).fails(
        3,
        &["4 mistakes", "did you mean `weights`", "0.001 to 10", "two factors are needed, the smaller first"],
    );
}

/// Influence, design and overturning by the repaired spectra, beside those by the plain ones.
#[test]
#[ignore = "long: make test-long"]
fn what_is_made_of_a_repair_is_made_of_its_weights() {
    // Montreux cannot be repaired, Athens is
    let (study, site) = (SmallStudy::repaired(), "Athens &lt; 1");
    let path = study.path().join("r.h5");
    let repaired_m = |im: &str| array(&path, &format!("/consistency/{im}/u_m"));

    let influence = json(&study.uplift(&["influence", "r.h5", "--json", "-q", "--top", "40"]).ok());
    let rows = influence["records"].as_array().unwrap();
    assert_eq!(rows.iter().filter(|row| row["repaired"] == true).count() * 3, rows.len());
    // left out, a record changes the repaired spectrum by what the file says
    let without_m = array(&path, "/influence/pga/consistent/u_without_m");
    let of_set_m = repaired_m("pga");
    let (strengths, records) = (4, 40);
    // [site, poe, …]: the second site, the first probability
    let (spectrum, rows_before) = (3 * strengths, 3 * records);
    let change = |record: usize| -> f64 {
        let of_set_m = &of_set_m[spectrum..][..strengths];
        let without_m = &without_m[(rows_before + record) * strengths..][..strengths];
        let rocking = of_set_m.iter().zip(without_m).filter(|(of_set_m, _)| **of_set_m > 5e-4);
        let changes: Vec<f64> = rocking.map(|(of_set_m, without_m)| without_m / of_set_m - 1.0).collect();
        changes.iter().sum::<f64>() / changes.len() as f64
    };
    let most = (0..records).map(|record| change(record).abs()).fold(0.0, f64::max);
    let told = rows
        .iter()
        .find(|row| row["repaired"] == true && row["site"] == site && row["im"] == "PGA" && row["poe"] == 0.02);
    let told = told.unwrap()["mean_change_pct"].as_f64().unwrap();
    assert!((told.abs() / (100.0 * most) - 1.0).abs() < 1e-9 && most > 1e-3, "{told} {most}");
    // shares of the risk are of the weighted runs, and all of it
    for share in ["share", "consistent/share"].map(|name| array(&path, &format!("/disaggregation/pga/{name}"))) {
        let ordinate = &share[(spectrum + 1) * 9..][..9];
        assert!((ordinate.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{ordinate:?}");
    }
    let table = std::fs::read_to_string(study.path().join("r.influence.csv")).unwrap();
    assert!(table.contains("PGA, repaired") || table.contains("\"PGA, repaired\""), "{table}");

    let frame = repository().join("configs/structures/frame.toml").display().to_string();
    let design = |more: &[&str]| {
        let asked = ["design", &frame, "--urs", "r.h5", "--site", site, "--measure", "pga", "--json", "-q"];
        json(&study.uplift(&[&asked[..], more].concat()).ok())
    };
    let (plain, repaired) = (design(&[]), design(&["--repaired"]));
    // one that is not by them is led to them by its own option
    let alarms = plain["alarms"].as_array().unwrap();
    assert!(alarms.iter().any(|alarm| alarm["what_to_do"] == "Use --repaired --measure pga"), "{alarms:?}");
    assert_eq!((&plain["repaired"], &repaired["repaired"]), (&Value::from(false), &Value::from(true)));
    let demand = |report: &Value| report["spectrum"]["zero_stiffness_demand_m"].as_f64().unwrap();
    let note = plain["notes"].as_array().unwrap().iter().find(|note| note.as_str().unwrap().contains("--repaired"));
    assert!(note.unwrap().as_str().unwrap().contains(&format!("{:.4} m", demand(&repaired))), "{note:?}");
    assert!(demand(&plain) > 1.2 * demand(&repaired));
    // its own analysis is weighed alike: the zero-stiffness oscillator at its strength is on the repaired spectrum
    let exact = repaired["exact"]["zero_stiffness_demand_of_spectrum_m"].as_f64().unwrap();
    assert!((exact / demand(&repaired) - 1.0).abs() < 0.25, "{exact} {}", demand(&repaired));
    let kinds = |report: &Value| -> Vec<String> {
        report["alarms"].as_array().unwrap().iter().map(|alarm| alarm["kind"].as_str().unwrap().to_owned()).collect()
    };
    assert!(kinds(&plain).contains(&"hazard-inconsistent".to_owned()));
    assert!(!kinds(&repaired).contains(&"hazard-inconsistent".to_owned()));

    let overturning = ["overturning", &frame, "--urs", "r.h5", "--site", site, "-q", "-o", "o.csv", "--json"];
    let overturning = json(&study.uplift(&overturning).ok());
    let by_pga = &overturning["overturning"][2]["sites"][0];
    assert_eq!(overturning["overturning"][2]["im"], "PGA");
    let rate = |of: &Value| of["per_year"].as_f64().unwrap();
    assert!(rate(&by_pga["repaired"]) < rate(by_pga), "{by_pga}");
    let table = std::fs::read_to_string(study.path().join("o.risk.csv")).unwrap();
    // the columns of bands follow it
    let head = table.lines().next().unwrap();
    assert!(head.contains(",maf_consistent_per_year,maf_records_lower_per_year,"), "{table}");

    study
        .uplift(&["design", &frame, "--urs", "r.h5", "--site", "Montreux", "--repaired"])
        .fails(2, &["no weights match both hazard curves of Montreux by PGV", "uplift consistency r.h5 --details"]);
}

// A disaggregation of the hazard by PGV at 10 % in 50 years, as the engine writes it.
#[test]
fn the_earthquakes_of_the_hazard_stand_beside_those_of_the_records() {
    let study = SmallStudy::repaired();
    let head = "#,,,,\"generated_by='OpenQuake engine 3.16.0', investigation_time=50.0, lon=0.0, lat=0.0\"";
    study.write("mr.csv", &format!("{head}\nimt,poe,mag,dist,mean\nPGV,0.1,5.5,10,0.025\nPGV,0.1,6.5,30,0.075\n"));
    let run = |file: &str, more: &[&str]| {
        study.uplift(&[&["consistency", "r.h5", "--force", "--disaggregation", file], more].concat())
    };
    let text = run("Montreux=mr.csv", &["--details"]).ok().stdout;
    assert!(text.contains("M of hazard") && text.contains("Montreux"), "{text}");
    let found = run("montreux=mr.csv", &["--json"]).json();
    let rows = found["earthquakes"].as_array().unwrap();
    assert_eq!(rows.len(), 1);
    let mean = rows[0]["mean_magnitude"].as_f64().unwrap();
    assert!((mean - 6.25).abs() < 0.02, "{mean}");
    run("mr.csv", &[]).fails(2, &["--disaggregation SITE=FILE", "Montreux"]);
    run("Montreux=r.urs.csv", &[]).fails(4, &["first line"]);
    run("Montreux=missing.csv", &[]).fails(4, &["missing.csv"]);
}

#[test]
#[ignore = "long: make test-long"]
fn other_keys_of_the_section_are_another_run() {
    let study = study(BOTH, "pgv pga", "");
    study.uplift(&["run", "study.toml"]).ok();
    let other = ["--set", "consistency.smoothness=0.1"];
    let asked = |arguments: &[&str]| study.uplift(&[arguments, &other].concat());
    for command in ["consistency", "bootstrap", "influence"] {
        asked(&[command, "study.toml", "-q"]).fails(2, &["other values of consistency.smoothness: run the study"]);
    }
    // as the message says
    asked(&["run", "study.toml", "-q"]).ok();
    asked(&["consistency", "study.toml", "-q"]).ok();
    // a repair that the study asks for is added
    let weights = ["consistency", "study.toml", "--set", "consistency.repair=\"weights\"", "--json", "-q"];
    let repaired = json(&study.uplift(&[&weights[..], &other].concat()).ok());
    assert!(row(&repaired, "Montreux", "PGA")["repair"]["failed"].is_null(), "{repaired}");
    assert!(row(&repaired, "Montreux", "PGA")["repair"]["max"].is_number(), "{repaired}");
}
