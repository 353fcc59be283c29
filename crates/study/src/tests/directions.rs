//! Azimuths and the third component in `[records]`.

use uplift_motion::{Component, Rotation};

use super::super::{AnyStudy, Study};
use super::{Folder, mistakes};

const ROTATED: &str = "[pgv]\n[records]\ncomponent = \"rotated\"\n";

#[test]
fn every_way_of_turning_a_pair_is_read_and_written() {
    let percentile = |azimuths, percentile| Rotation::Percentile { azimuths, percentile };
    for (section, rotation) in [
        ("", Rotation::Random),
        ("[records.rotation]\ntake = \"random\"", Rotation::Random),
        ("[records.rotation]\ntake = \"each\"", Rotation::Each { azimuths: 12 }),
        ("[records.rotation]\ntake = \"each\"\nazimuths = 180", Rotation::Each { azimuths: 180 }),
        ("[records.rotation]\ntake = \"percentile\"", percentile(12, 100)),
        ("[records.rotation]\ntake = \"percentile\"\nazimuths = 36\npercentile = 50", percentile(36, 50)),
    ] {
        let study = Folder::new(&format!("{ROTATED}{section}")).load(&[]).unwrap();
        assert_eq!(study.records.component, Component::Rotated(rotation), "{section}");
        let written = study.to_toml().unwrap();
        let AnyStudy::UniformRisk(again) = Study::stored(&written).unwrap() else { panic!("of uniform risk") };
        assert_eq!(again.records, study.records, "{written}");
    }
}

#[test]
fn keys_that_would_have_no_effect_are_mistakes_all_at_once() {
    let found = mistakes(&format!("{ROTATED}[records.rotation]\nazimuths = 4\npercentile = 50"), &[]);
    assert_eq!(
        found,
        [
            "records.rotation.azimuths: one azimuth of each pair is drawn",
            "records.rotation.percentile: no percentile is taken"
        ]
    );
    let found = mistakes("[pgv]\n[records.rotation]\ntake = \"percentile\"\nazimuths = 0\npercentile = 101", &[]);
    assert_eq!(
        found,
        [
            "records.rotation: azimuths are given, and component = \"h1\" has none",
            "records.rotation.azimuths: the value is 0",
            "records.rotation.percentile: the value is 101"
        ]
    );
    let each = format!("{ROTATED}at_level = \"pgv.csv\"\n[records.rotation]\ntake = ");
    assert_eq!(
        mistakes(&format!("{each}\"each\""), &[]),
        ["records.at_level: the table names pairs, and each azimuth of a pair is a record of its own"]
    );
    assert!(Folder::new(&format!("{each}\"percentile\"")).load(&[]).is_ok());
}

#[test]
fn the_third_component_is_of_records_that_have_one_and_of_what_feels_it() {
    let recorded = "[pgv]\n[records]\nmanifest = \"manifest.csv\"\nvertical = true";
    let study = Folder::new(recorded).load(&[]).unwrap();
    assert!(study.records.vertical && study.to_toml().unwrap().contains("vertical = true"));
    assert_eq!(
        mistakes("[pgv]\n[records]\nvertical = true", &[]),
        ["records.vertical: synthetic records have no third component"]
    );
    let displacement = "kind = \"displacement spectra\"\n[records]\nmanifest = \"manifest.csv\"\nvertical = true\n";
    let study = Folder::new(&format!("{displacement}[block]\n")).load_displacement(&[]).unwrap();
    assert!(study.records.vertical && study.to_toml().unwrap().contains("vertical = true"));
    let error = Folder::new(&format!("{displacement}[oscillator]\n")).load_displacement(&[]).unwrap_err();
    let found: Vec<String> = error.mistakes().iter().map(ToString::to_string).collect();
    assert_eq!(found, ["records.vertical: oscillators do not feel the vertical motion"]);
}
