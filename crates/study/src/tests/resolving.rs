use std::fs;
use std::path::Path;

use proptest::prelude::*;
use uplift_hazard::{CurveUnit, Extrapolation};
use uplift_motion::{Component, IntensityMeasure};
use uplift_oscillator::PostUplift;

use super::super::{Contour, CurveKind, RecordSource, Study};
use super::{Folder, load, render};

#[test]
fn defaults() {
    let folder = Folder::new("[pgv]\n[pga]\n");
    let study = folder.load(&[]).unwrap();
    assert_eq!((study.title.as_str(), study.seed, study.gravity_m_s2), ("", 1, 9.80665));
    assert_eq!(study.records.source, RecordSource::Synthetic { pairs: 105, seed: 1 });
    assert_eq!((study.records.component, study.records.first), (Component::H1, None));
    assert_eq!(study.oscillator.uplift_displacement_m, 0.0005);
    assert_eq!(study.oscillator.restitution, 0.95);
    assert!(study.oscillator.free_vibration);
    assert_eq!(study.oscillator.post_uplift, PostUplift::Zero);
    assert_eq!(study.strengths.len(), 301);
    let [pgv, pga] = study.measures.as_slice() else {
        panic!("two measures");
    };
    assert_eq!((pgv.measure, pgv.levels.len()), (IntensityMeasure::Pgv, 84));
    assert_eq!((pga.measure, pga.levels.len()), (IntensityMeasure::Pga, 82));
    assert_eq!([0, 8, 9, 47, 48, 83].map(|level| pgv.levels[level]), [0.1, 0.9, 1.0, 20.0, 25.0, 200.0]);
    assert_eq!((pga.levels[0], pga.levels[9], pga.levels[10], pga.levels[81]), (0.001, 0.0225, 0.025, 2.0));
    assert_eq!(study.risk.poe, [0.02, 0.1, 0.5]);
    assert_eq!(study.risk.years, 50.0);
    assert_eq!(study.risk.contour, Contour::Exact);
    assert_eq!(study.risk.extrapolate, Extrapolation::Refuse);
    assert!(study.risk.maf_surface);
    assert_eq!(study.risk.thresholds_m.len(), 3002);
    assert_eq!(study.risk.thresholds_m[..3], [0.0, 0.0005, 0.001]);
    assert_eq!(study.regression.strength_above, 0.05);
    assert!(study.output.csv);
    let results = std::env::current_dir().unwrap().join("results/study.h5");
    assert_eq!(study.output.file, results);
    assert!(study.warnings[0].what.contains("no [[sites]]"));
}

pub(super) const COMPLETE: &str = r#"
title = "A \"title\" – with ş"
seed = 9223372036854775807
gravity_m_s2 = 9.81
[records]
manifest = "manifest.csv"
tag = "ord105"
component = "random"
intensity = "rotd50"
first = 20
[records.select]
magnitude = "6.5:7.5"
d5_75_s = ":20"
pulse_like = false
[oscillator]
uplift_displacement_m = 1e-3
restitution = 1
free_vibration = false
capacity_m = 0.3
[strengths]
values = { start = 0.1, stop = 1, count = 7 }
[hazard]
component = "RotD50"
conversions = [{ from = "GMRotI50", to = "RotD50", pgv = 1, pga = 1.0 }, { from = "RotD100", to = "RotD50", pgv = 0.8 }]
[pgv]
levels_cm_s = [1, "2:1/3:4", 5.5]
[pga]
levels_g = "0.1:0.1:2"
[risk]
poe = 0.1
years = 475
contour = "grid"
thresholds_m = [0, "0.001:0.001:0.01"]
maf_surface = false
extrapolate = "loglog"
[[sites]]
name = "Athens"
pgv = "pgv.csv"
pga = { file = "pga.csv", unit = "m/s2", kind = "poe", years = 1 }
[[sites]]
name = "Focșani 2.1"
pgv = { file = "../pgv.csv", unit = "m/s", kind = "maf" }
pga = "pga.csv"
[site_table]
sites = "manifest.csv"
pga = "pga.csv"
within_km = 0.5
strengths = [0.1, "0.4:0.15:0.7"]
[regression]
strength_above = 0
[output]
file = "results/x.h5"
csv = false
"#;

/// What is asked against a measure that only a table of sites could have, and has not, is a mistake.
#[test]
fn consistency_against_what_a_table_of_sites_has_not() {
    let text = "[pgv]\n[consistency]\nagainst = \"pga\"\nrepair = \"weights\"\n[site_table]\nsites = \"manifest.csv\"\n\
                pgv = \"pgv.csv\"\n";
    let error = Folder::new(text).load(&[]).unwrap_err();
    assert!(error.mistakes().iter().any(|mistake| mistake.to_string().contains("no site has a curve of PGA")));
    let folder = Folder::new(&format!("{text}pga = \"pga.csv\"\n"));
    assert_eq!(folder.load(&[]).unwrap().consistency.against, Some(IntensityMeasure::Pga));
}

#[test]
fn a_study_of_spectral_acceleration_alone() {
    let text = "[measures.sa_0p5s]\n[measures.arias]\nlevels_cm_s = [1, 10, 100]\n[[sites]]\nname = \"x\"\n\
                sa_0p5s = { file = \"pga.csv\", unit = \"m/s2\" }\narias = \"pgv.csv\"\npgd = \"pgv.csv\"\n\
                [consistency]\nagainst = \"SA(0.50)\"\n";
    let folder = Folder::new(text);
    let study = folder.load(&[]).unwrap();
    let half: IntensityMeasure = "sa_0p5s".parse().unwrap();
    let measures: Vec<_> = study.measures.iter().map(|plan| (plan.measure, plan.levels.len())).collect();
    assert_eq!(measures, [(half, 82), (IntensityMeasure::Arias, 3)]);
    assert_eq!(study.consistency.against, Some(half));
    let site = &study.sites[0];
    assert_eq!(site.curve(half).unwrap().unit, CurveUnit::MPerS2);
    assert_eq!(site.curve(IntensityMeasure::Pgd).unwrap().unit, CurveUnit::Cm);
    assert_eq!(study.further_measures(), [half, IntensityMeasure::Pgd, IntensityMeasure::Arias]);
    let written = folder.path("written.toml");
    std::fs::write(&written, study.to_toml().unwrap()).unwrap();
    let again = Study::load(&written, &[]).unwrap();
    assert_eq!((&again.measures, &again.consistency), (&study.measures, &study.consistency));
    let error = folder.load(&["measures.sa_2s.levels_g=0.1:0.1:1"]).unwrap_err();
    assert_eq!(error.mistakes().len(), 1, "no curve: {error}");
}

/// A file that says unit and years itself needs neither in the study; what the study says is kept.
#[test]
fn a_curve_that_names_its_columns() {
    for (pgv, kind) in [
        ("\"pgv.csv\"", CurveKind::Poe { years: 50.0 }),
        ("{ file = \"pgv.csv\" }", CurveKind::Poe { years: 50.0 }),
        ("{ file = \"pgv.csv\", kind = \"poe\" }", CurveKind::Poe { years: 50.0 }),
        ("{ file = \"pgv.csv\", kind = \"poe\", years = 1 }", CurveKind::Poe { years: 1.0 }),
        ("{ file = \"pgv.csv\", kind = \"maf\" }", CurveKind::Maf),
    ] {
        let folder = Folder::new(&format!("[pgv]\n[[sites]]\nname = \"A\"\npgv = {pgv}\n"));
        fs::write(folder.path("pgv.csv"), "# source\nPGV (m/s),PoE in 50 years\n0.001,0.9\n3,1e-5\n").unwrap();
        let study = folder.load(&[]).unwrap();
        let curve = study.sites[0].curve(IntensityMeasure::Pgv).unwrap();
        assert_eq!((curve.unit, curve.kind), (CurveUnit::MPerS, kind), "{pgv}");
    }
}

#[test]
fn complete_study() {
    let text = COMPLETE.replace("../pgv.csv", "./pgv.csv");
    let folder = Folder::new(&text);
    let study = folder.load(&[]).unwrap();
    assert_eq!(study.seed, i64::MAX as u64);
    let manifest = folder.path("manifest.csv");
    let tag = Some("ord105".to_owned());
    assert_eq!(study.records.source, RecordSource::Manifest { manifest, tag });
    assert_eq!(study.oscillator.post_uplift, PostUplift::Negative { capacity_m: 0.3 });
    assert_eq!(study.strengths.len(), 7);
    let curve = study.sites[0].curve(IntensityMeasure::Pga).unwrap();
    assert_eq!(curve.file, Some(folder.path("pga.csv")));
    assert_eq!((curve.unit, curve.kind), (CurveUnit::MPerS2, CurveKind::Poe { years: 1.0 }));
    let curve = study.sites[1].curve(IntensityMeasure::Pgv).unwrap();
    assert_eq!((curve.unit, curve.kind), (CurveUnit::MPerS, CurveKind::Maf));
    let table = study.site_table.as_ref().unwrap();
    assert_eq!((table.export(IntensityMeasure::Pgv), table.within_km), (None, 0.5));
    assert_eq!(table.export(IntensityMeasure::Pga), Some(folder.path("pga.csv").as_path()));
    assert_eq!(table.strengths.as_deref(), Some(&[0.1, 0.4, 0.55, 0.7][..]));
    assert_eq!(study.output.file, folder.path("results/x.h5"));
    assert!(study.warnings.is_empty());
}

/// What is written loads to an equal study, from another folder.
#[test]
fn round_trip() {
    let complete = COMPLETE.replace("../pgv.csv", "./pgv.csv");
    let rising = "[pga]\n[oscillator]\npost_uplift_stiffness_per_s2 = 0.5\n";
    for text in [complete.as_str(), rising, "[pgv]\n[records.synthetic]\npairs = 7\nseed = 0"] {
        let folder = Folder::new(text);
        let study = folder.load(&[]).unwrap();
        let written = study.to_toml().unwrap();
        let elsewhere = Folder::new(&written);
        let again = elsewhere.load(&[]).unwrap();
        assert_eq!(again, study, "{written}");
        assert_eq!(again.to_toml().unwrap(), written);
    }
}

#[test]
fn byte_order_mark_and_windows_lines() {
    let study = load("\u{feff}title = \"x\"\r\n[pgv]\r\n").unwrap();
    assert_eq!(study.title, "x");
}

proptest! {
    /// Whatever the file says: an answer, and one that can be shown.
    #[test]
    fn any_text(text in "\\PC{0,200}|([a-z_\\[\\]{}=\"',. 0-9:\\n#\r\u{feff}-]{0,200})") {
        never_panics(&text);
    }

    /// The same where single lines of a real study are broken.
    #[test]
    fn broken_study(line in 0_usize..45, junk in "[\\[\\]{}=\"',.0-9a-z\\\\é-]{0,12}", keep in any::<bool>()) {
        let lines = COMPLETE.lines().enumerate().map(|(i, original)| match (i == line, keep) {
            (true, true) => format!("{original}{junk}"),
            (true, false) => junk.clone(),
            (false, _) => original.to_owned(),
        });
        never_panics(&lines.collect::<Vec<_>>().join("\n"));
    }
}

fn never_panics(text: &str) {
    let study = Study::parse(Path::new("study.toml"), text.to_owned());
    if let Err(error) = study.and_then(|study| study.resolve(&[])) {
        assert!(!error.mistakes().is_empty());
        assert!(!render(&error).contains("Failed to read contents"), "{text:?}");
    }
}
