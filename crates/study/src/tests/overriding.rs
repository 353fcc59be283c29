use uplift_hazard::CurveUnit;
use uplift_motion::IntensityMeasure;

use super::{Folder, mistakes};
use crate::CurveKind;

const STUDY: &str = r#"
[pgv]
[risk]
poe = [0.02, 0.1]
[[sites]]
name = "Athens"
pgv = "pgv.csv"
[[sites]]
name = "Sion 2.1"
pgv = "pgv.csv"
"#;

#[test]
fn values_are_toml_or_text() {
    let folder = Folder::new(STUDY);
    let overrides = [
        "risk.years=100",
        "risk.poe[1]=0.2",
        "title=Two words",
        "strengths.values=0:1/10:1",
        "oscillator.free_vibration = false",
        "records.component=\"h2\"",
        "pgv.levels_cm_s=10:20:30",
        "pgv.levels_cm_s=[10, \"20:10:40\"]",
    ];
    let study = folder.load(&overrides).unwrap();
    assert_eq!(study.risk.years, 100.0);
    assert_eq!(study.risk.poe, [0.02, 0.2]);
    assert_eq!(study.title, "Two words");
    assert_eq!(study.strengths.len(), 11);
    assert!(!study.oscillator.free_vibration);
    assert_eq!(study.records.component, uplift_motion::Component::H2);
    assert_eq!(study.measures[0].levels[..], [10.0, 20.0, 30.0, 40.0]);
}

/// 10:20:30 is a time of day in TOML, and a grid here.
#[test]
fn a_grid_that_looks_like_a_time() {
    let folder = Folder::new(STUDY);
    let study = folder.load(&["pgv.levels_cm_s=10:20:50"]).unwrap();
    assert_eq!(study.measures[0].levels[..], [10.0, 30.0, 50.0]);
}

#[test]
fn sites_by_position_and_by_name() {
    let folder = Folder::new(STUDY);
    let pga = folder.path("pga.csv");
    for (key, site) in
        [("sites.0.pgv", 0), ("sites[0].pgv", 0), ("sites.Athens.pgv", 0), ("sites.\"Sion 2.1\".pgv.file", 1)]
    {
        let start = if key.ends_with("file") { vec!["sites[1].pgv={}".to_owned()] } else { vec![] };
        let setting = format!("{key}={}", pga.display());
        let overrides: Vec<&str> = start.iter().chain([&setting]).map(String::as_str).collect();
        let study = folder.load(&overrides).unwrap();
        let curve = study.sites[site].curve(IntensityMeasure::Pgv).unwrap();
        assert_eq!(curve.file.as_ref(), Some(&pga), "{key}");
    }
    let study = folder.load(&["sites.1.name=Athens II"]).unwrap();
    assert_eq!(study.sites[1].name, "Athens II");
}

/// A curve that is a path alone keeps it, from where it was written, when its unit or kind is set.
#[test]
fn the_path_of_a_curve_takes_further_keys() {
    let folder = Folder::new(STUDY);
    let before = folder.load(&[]).unwrap();
    let study = folder.load(&["sites.Athens.pgv.unit=m/s", "sites.Athens.pgv.kind=poe", "sites.Athens.pgv.years=50"]);
    let (before, curve) = (&before.sites[0].curves[0], &study.unwrap().sites[0].curves[0]);
    assert_eq!(curve.file, before.file);
    assert_eq!((before.unit, before.kind), (CurveUnit::CmPerS, CurveKind::Maf));
    assert_eq!((curve.unit, curve.kind), (CurveUnit::MPerS, CurveKind::Poe { years: 50.0 }));
    let error = folder.load(&["sites.Athens.name.unit=m/s"]).unwrap_err();
    assert!(folder.rendered(&error).contains("it is the text \"Athens\", and has no `unit`"));
}

#[test]
fn the_key_of_a_site_is_taken() {
    let folder = Folder::new(STUDY);
    for name in ["Athens", "Bern 1.5", "L'Aquila", "Vs30=800", "[3]", "5", "two words"] {
        let named = format!("sites.0.name={name:?}");
        let key = folder.load(&[&named]).unwrap().key_of_site(name);
        assert!(!key.contains('\''), "{key}");
        let study = folder.load(&[&named, &format!("{key}.pgv.unit=m/s")]).unwrap();
        assert_eq!(study.sites[0].curves[0].unit, CurveUnit::MPerS, "{key}");
    }
}

#[test]
fn per_cent_are_answered_with_the_fraction() {
    let folder = Folder::new(STUDY);
    for (given, meant) in [("risk.poe=2%", "write 0.02 for 2 %"), ("risk.poe=[\"2.8 %\"]", "write 0.028 for 2.8 %")] {
        let error = folder.load(&[given]).unwrap_err();
        assert!(folder.rendered(&error).contains(meant), "{}", folder.rendered(&error));
    }
    for given in ["oscillator.uplift_displacement_m=2%", "risk.years=nan,inf", "risk.years=0,02,0,1"] {
        let error = folder.load(&[given]).unwrap_err();
        assert!(folder.rendered(&error).contains("write a number without quotes or unit"), "{given}");
    }
}

#[test]
fn commas_are_answered() {
    let folder = Folder::new(STUDY);
    for (given, meant) in [
        ("risk.poe=0.02,0.1", "write the list [0.02, 0.1] where several numbers may stand"),
        ("pgv.levels_cm_s=1,2,5", "the list [1, 2, 5]"),
        ("risk.years=2,5", "write 2.5 with a point, or the list [2, 5] where several numbers may stand, whichever"),
        ("oscillator.uplift_displacement_m=0,02", "write 0.02 with a point"),
        ("risk.years=1,000", "write 1000, or 1.000 with a point, whichever is meant"),
        ("risk.years=1,000,000", "write 1000000"),
        ("risk.years=1,000.5", "write 1000.5"),
    ] {
        let error = folder.load(&[given]).unwrap_err();
        assert!(folder.rendered(&error).contains(meant), "{}", folder.rendered(&error));
    }
}

#[test]
fn units_are_read_as_people_write_them_and_never_guessed() {
    let folder = Folder::new(STUDY);
    let pga = format!("sites.Athens.pga={}", folder.path("pga.csv").display());
    let study = folder.load(&[&pga, "sites.Athens.pga.unit=gal"]).unwrap();
    assert_eq!(study.sites[0].curve(IntensityMeasure::Pga).unwrap().unit, CurveUnit::CmPerS2);
    for unit in ["mm/s", "g", "%g"] {
        let error = folder.load(&[&format!("sites.Athens.pgv.unit={unit}")]).unwrap_err();
        let told = folder.rendered(&error);
        assert!(told.contains(&format!("levels in \"{unit}\" are not read")) && told.contains("cm/s, m/s"), "{told}");
        assert!(!told.contains("did you mean"), "{told}");
    }
}

#[test]
fn sections_come_into_being() {
    let study = Folder::new("").load(&["pga.levels_g=0.1:0.1:2"]).unwrap();
    assert_eq!(study.measures[0].measure, IntensityMeasure::Pga);
    assert_eq!(study.measures[0].levels.len(), 20);
    let study = Folder::new("").load(&["pga={}"]).unwrap();
    assert_eq!(study.measures[0].levels.len(), 82);
}

/// Paths of the command line start from the current directory, which is the crate's in tests.
#[test]
fn paths_start_from_the_current_directory() {
    let folder = Folder::new("[pgv]\n[output]\nfile = \"a/b.h5\"");
    let inside = folder.load(&[]).unwrap();
    assert_eq!(inside.output.file, folder.path("a/b.h5"));
    let study = folder.load(&["output.file=a/b.h5", "records.manifest=Cargo.toml"]).unwrap();
    let current = std::fs::canonicalize(".").unwrap();
    assert_eq!(study.output.file, current.join("a/b.h5"));
}

#[test]
fn mistakes_name_the_override() {
    let overrides = [
        "risk.poe=2",
        "risk.yeers=100",
        "rsik.years=100",
        "sites.Athen.pgv=x.csv",
        "sites.7.pgv=x.csv",
        "risk.years.months=3",
        "records.manifest=no such file.csv",
        "no value",
        "=3",
        "risk..years=3",
        "sites[x].pgv=3",
        "title=2024",
    ];
    let folder = Folder::new(STUDY);
    let error = folder.load(&overrides).unwrap_err();
    let current = std::fs::canonicalize(".").unwrap();
    let shown = folder.rendered(&error);
    insta::assert_snapshot!(shown.replace(&current.display().to_string(), "[current]"));
}

#[test]
fn only_overrides_in_the_way_are_reported() {
    let told = mistakes("[pgv]\n[risk]\nyears = -1", &["risk.years=50", "seed=-3"]);
    assert_eq!(told, ["--set seed=-3: seed: the value is -3"]);
}
