//! Reading results: one of version 0.1, one read off the grid of thresholds, damaged ones.

use std::collections::HashMap;

use serde_json::Value;
use uplift::bootstrap::resampling_plan;
use uplift::result::{Kind, ResultFile, StoredStripes, StudyOfResult};
use uplift::text::risk_name;
use uplift_labelled::{LabelledReader, LabelledWriter};

use crate::common::{SMALL_STUDY, SmallStudy, repository};

/// The lines of each panel of a figure in a report, by name.
fn lines(page: &str, id: &str) -> Vec<HashMap<String, Vec<(f64, f64)>>> {
    let figure = page.split_once(&format!("id=\"r1-{id}\">")).unwrap().1;
    let json = figure.split_once("<script type=\"application/json\">").unwrap().1.split_once("</script>").unwrap().0;
    let panels: Vec<Value> = serde_json::from_str(json).unwrap();
    let point = |point: &Value| (point[0].as_f64().unwrap(), point[1].as_f64().unwrap());
    let line = |line: &Value| {
        let points = line["points"].as_array().unwrap().iter().map(point).collect();
        (line["name"].as_str().unwrap().to_owned(), points)
    };
    panels.iter().map(|panel| panel["lines"].as_array().unwrap().iter().map(line).collect()).collect()
}

/// A number as the report gives it to its reader.
fn short(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap()
}

/// With `contour = "grid"` the spectra are those that the file, the tables and the CSV hold, not exact ordinates.
#[test]
fn figures_and_report_show_the_ordinates_of_the_file() {
    let study = SmallStudy::with(&SMALL_STUDY.replace("[risk]\n", "[risk]\ncontour = \"grid\"\n"));
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["report", "r.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    let file = ResultFile::open(&study.path().join("r.h5")).unwrap();
    let (spectra, stripes) = (file.spectra().unwrap(), StoredStripes::read(&file).unwrap());
    let mut differing = 0;
    for (of_measure, measure) in spectra.measures.iter().zip(&stripes.measures) {
        let key = of_measure.measure.key();
        let urs = lines(&page, &format!("urs-{key}"));
        for ([site, poe], u_m) in of_measure.u_m.blocks() {
            let drawn = |u_m: &[f64]| -> Vec<(f64, f64)> {
                let points = spectra.strengths.iter().zip(u_m).filter(|(_, u_m)| u_m.is_finite());
                points.map(|(&strength, &u_m)| (short(strength), short(u_m))).collect()
            };
            let name = risk_name(spectra.poes[poe], spectra.years);
            assert_eq!(urs[site][&name], drawn(u_m), "{key} {site} {name}");
            differing += usize::from(drawn(u_m) != drawn(measure.exact_m.block([site, poe])));
        }
    }
    assert!(differing > 0, "the grid is as fine as the stripes: the test shows nothing");
    // the summary of the report beside the table of the run
    let csv = std::fs::read_to_string(study.path().join("r.urs.csv")).unwrap();
    let row = csv.lines().find(|line| line.starts_with("Here,PGV,0.02,50.0,0.1,")).unwrap();
    let u_m: f64 = row.split(',').nth(5).unwrap().parse().unwrap();
    let shown = page.split_once("<tr><td>Here</td><td class=\"number\">").unwrap().1.split_once(' ').unwrap().0;
    assert!((shown.parse::<f64>().unwrap() / u_m - 1.0).abs() < 0.06, "{shown}: {u_m}");
}

/// A result that version 0.1.0 wrote, with bands and influence, of a study with a hazard curve that is gone.
#[test]
fn results_of_version_0_1_are_read() {
    let path = repository().join("tests/results/version-0.1.h5");
    let file = ResultFile::open(&path).unwrap();
    let head = file.head().unwrap();
    assert_eq!((file.kind(), head.version.as_str(), head.title.as_str()), (Kind::UniformRisk, "0.1.0", "tiny"));
    assert_eq!((head.seed, head.synthetic, head.warnings.len()), (Some(1), true, 4));
    let spectra = file.spectra().unwrap();
    assert_eq!(spectra.sites, ["Here"]);
    assert_eq!(spectra.measures.len(), 1);
    // read off a grid of 0.02 m, as its tables beside it said
    let expected = [
        0.995_850_776_958_750_8,
        0.439_700_877_627_547_06,
        0.119_700_877_627_547_04,
        0.059_815_476_946_484_94,
        0.079_700_877_627_547_05,
    ];
    assert_eq!(spectra.measures[0].u_m.values(), expected);
    let fit = spectra.measures[0].fits[[0, 0]];
    assert!((fit.c0_m - 7.8093).abs() < 1e-4 && (fit.c1 + 50.7230).abs() < 1e-4 && !fit.bound_active);
    let stripes = StoredStripes::read(&file).unwrap();
    assert_eq!(stripes.measures[0].edp_m.shape(), [3, 5, 3]);
    assert!(
        stripes.measures[0].exact_m.values().iter().zip(&expected).all(|(exact, grid)| (exact - grid).abs() < 0.02)
    );
    assert_eq!(stripes.bootstrap.replicates, 1000);
    assert_eq!(file.records().unwrap().ids, ["SYN001", "SYN002", "SYN003"]);
    assert_eq!(file.hazard().unwrap()[0].sites[0].curve.points().count(), 2);
    let bands = file.bands().unwrap().unwrap();
    assert_eq!((bands.sizes.as_slice(), bands.level_names()), (&[2, 3][..], ["5 %".to_owned(), "95 %".to_owned()]));
    assert_eq!(bands.measures[0].plain.limits_m[1].shape(), [1, 1, 2, 5]);
    assert_eq!(resampling_plan(&file).unwrap().unwrap().replicates(), 5);
    let study = StudyOfResult::read(&file, None).unwrap();
    assert_eq!(study.spectrum(&study.measures[0], 0, 0), expected);
    // its records are made again, and are the same motions
    assert_eq!(study.records().unwrap().records.len(), 3);
    assert!(file.displacements().is_err());

    let folder = SmallStudy::new();
    std::fs::copy(&path, folder.path().join("old.h5")).unwrap();
    for command in ["verify", "status", "table", "plot", "report"] {
        folder.uplift(&[command, "old.h5"]).ok();
    }
    folder.uplift(&["export", "old.h5", "--csv", "--json", "--mat", "-q"]).ok();
    for command in ["bootstrap", "influence", "measures"] {
        folder.uplift(&[command, "old.h5", "-q"]).ok();
    }
    let status = folder.uplift(&["status", "old.h5"]).ok().stdout;
    assert!(status.contains("added    bootstrap, influence, measures"), "{status}");
}

/// An array that does not run over its axes is named, with its file.
#[test]
fn damaged_files_are_refused() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["bootstrap", "r.h5", "--replicates", "5", "--sizes", "2,4", "-q"]).ok();
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let strengths = reader.axis::<f64>("strength").unwrap().len();
    for (array, dims, command, words) in [
        ("/urs/pgv/u_m", ["site", "strength", "poe"], "table", "runs over site, strength, poe"),
        ("/ida/pgv/edp_m", ["strength", "record", "pgv_level"], "influence", "runs over strength, record"),
        ("/bootstrap/pgv/e_median", ["site", "poe", "strength"], "report", "not over site, poe, sample_size"),
    ] {
        let mut writer = LabelledWriter::create(&study.path().join("d.h5")).unwrap();
        writer.carry_over(&reader, &[array]).unwrap();
        let lengths = dims.map(|dim| match dim {
            "strength" => strengths,
            "record" => 4,
            "site" => 2,
            "pgv_level" => 5,
            _ => reader.axis::<f64>(dim).unwrap().len(),
        });
        let values = vec![0.1; lengths.iter().product()];
        writer.array(array, &dims, &values, "m", "turned").unwrap();
        writer.finish().unwrap();
        study.uplift(&[command, "d.h5"]).fails(4, &["d.h5", array, words, "damaged"]);
        // and one that is not there
        let mut writer = LabelledWriter::create(&study.path().join("d.h5")).unwrap();
        writer.carry_over(&reader, &[array]).unwrap();
        writer.finish().unwrap();
        let code = if array.starts_with("/urs") || array.starts_with("/ida") { None } else { Some(4) };
        if let Some(code) = code {
            study.uplift(&[command, "d.h5"]).fails(code, &["d.h5", array]);
        }
    }
}
