//! Studies of a shaking table.

use std::fs;

use super::super::{AnyStudy, ShakeTableStudy, Study, StudyError};
use super::Folder;

pub(super) const COMPLETE: &str = r#"kind = "shake table"
title = "table"
gravity_m_s2 = 9.81
structure = "pgv.csv"
excitations = "pga.csv"
length_scale = 5
[records]
manifest = "manifest.csv"
first = 3
[records.select]
magnitude = "6.5:"
[[levels]]
name = "low"
pgv_srss_m_s = 0.1675
[[levels]]
name = "high"
pgv_srss_m_s = 0.335
[model]
rest_amplitude_rad = 1e-4
start_rotation_rad = 1e-9
[spectra]
periods_s = ["0.1:0.1:0.5", 2]
[spectra.design]
ground_acceleration_g = 0.16
ground = "D"
shape = "type2"
[output]
file = "x.h5"
csv = false
"#;

pub(super) const BARE: &str = "kind = \"shake table\"\nstructure = \"pgv.csv\"\n[[levels]]\nname = \"a\"\n\
    pgv_srss_m_s = 1\n[records.synthetic]\npairs = 3\n[output]\nfile = \"x.h5\"";

fn load(folder: &Folder) -> Result<ShakeTableStudy, StudyError> {
    match Study::load_any(&folder.path("study.toml"), &[])? {
        AnyStudy::ShakeTable(study) => Ok(*study),
        other => panic!("a study of {}", other.kind().key()),
    }
}

pub(super) fn texts(error: &StudyError) -> String {
    error.mistakes().iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_complete_study_is_read_and_written_as_it_is() {
    for text in [COMPLETE, BARE] {
        let folder = Folder::new(text);
        let study = load(&folder).unwrap();
        fs::write(folder.path("study.toml"), study.to_toml().unwrap()).unwrap();
        assert_eq!(load(&folder).unwrap(), study);
    }
    let study = load(&Folder::new(COMPLETE)).unwrap();
    assert_eq!((study.length_scale, study.levels[1].pgv_srss_m_s), (5.0, 0.335));
    let bare = load(&Folder::new(BARE)).unwrap();
    assert_eq!((bare.length_scale, bare.excitations), (1.0, None));
    assert_eq!((bare.spectra.periods_s.len(), bare.spectra.design), (46, None));
    let design = study.spectra.design.unwrap().spectrum(study.gravity_m_s2);
    // plateau of ground type D, type 2: 1.8 times 2.5
    assert!((design.acceleration_m_s2(0.2).unwrap() / (0.16 * 9.81 * 4.5) - 1.0).abs() < 1e-15);
    assert_eq!((bare.model.rest_amplitude_rad, bare.model.start_rotation_rad), (1e-5, 1e-12));
}

/// 21 m/s is no table's: 21 cm/s were meant.
#[test]
fn a_level_in_another_unit_raises_a_warning() {
    let warnings = |text: &str| load(&Folder::new(text)).unwrap().warnings;
    assert_eq!(warnings(COMPLETE), []);
    let told: Vec<String> = warnings(&COMPLETE.replace("0.335", "21")).iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 1);
    assert!(told[0].contains("pgv_srss_m_s in [[levels]] is 21 m/s") && told[0].contains("cm/s"), "{told:?}");
    let told: Vec<String> = warnings(&COMPLETE.replace("0.16", "1.57")).iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 1);
    assert!(told[0].contains("ground_acceleration_g is 1.57 g") && told[0].contains("m/s2"), "{told:?}");
    let told = warnings(&COMPLETE.replace("length_scale = 5", "length_scale = 0.2"));
    assert_eq!(told.len(), 1);
    assert!(told[0].unlikely && told[0].what.contains("length_scale is 0.2; usual is from 1 to 100"), "{told:?}");
    assert_eq!(told[0].what_to_do, "correct length_scale, or leave it if it is meant");
}

#[test]
fn all_the_mistakes_are_reported_at_once() {
    let folder = Folder::new(
        "kind = \"shake table\"\nlength_scale = 0\n[records]\ntag = \"nf\"\n[[levels]]\nname = \"low\"\n[[levels]]\n\
         name = \"LOW\"\npgv_srss_m_s = 1e4\n[model]\nrest_amplitude_rad = 1\nkind = 2\n\
         [spectra]\nperiods_s = [0.5, 0.1]\n[spectra.design]\nground = \"F\"\n",
    );
    let told = texts(&load(&folder).unwrap_err());
    for words in [
        "which structure is on the table",
        "length_scale",
        "tags are given set by set",
        "the level has no velocity",
        "another level LOW",
        "the value is 10000 m/s",
        "rest_amplitude_rad",
        "model.kind: unknown key",
        "a grid must increase",
        "the design spectrum has no ground acceleration",
        "unknown ground: the text \"F\"",
    ] {
        assert!(told.contains(words), "{words:?} is not in:\n{told}");
    }
    let empty = texts(&load(&Folder::new("kind = \"shake table\"\nstructure = \"pgv.csv\"")).unwrap_err());
    assert!(empty.contains("how strongly does the table shake"), "{empty}");
}
