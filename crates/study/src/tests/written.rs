//! The text that a result holds of its study: it stays as it is to the byte, for the same study is known by it, and it
//! is read again when the files of the study are gone.

use super::super::{AnyStudy, Kind, Study};
use super::Folder;
use super::{displacement, resolving, shake_table};

const BLOCKS: &str = "kind = \"displacement spectra\"\n[block]\nrestitution = 0.9\nheight_m = [2, \"4:1/2:5\"]\n\
    [records.synthetic]\npairs = 3\nseed = 0\n[design]\n[output]\nfile = \"x.h5\"";
const BARE_BLOCKS: &str = "kind = \"displacement spectra\"\n[block]\n[output]\nfile = \"x.h5\"";
const BARE_OSCILLATORS: &str = "kind = \"displacement spectra\"\n[oscillator]\n[design]\n[output]\nfile = \"x.h5\"";
const RISING: &str = "[pga]\n[oscillator]\npost_uplift_stiffness_per_s2 = 0.5\n[records]\nfirst = 4\n\
    [hazard]\nconversions = { from = \"larger\", to = \"arbitrary\", pga = 2, pgv = 3 }\n\
    [bootstrap]\nsizes = [20, 3]\ninterval = \"bca\"\nsimultaneous = true\n[output]\nfile = \"x.h5\"";
const BRANCHES: &str = "[pgv]\n[output]\nfile = \"x.h5\"\n[[sites]]\nname = \"a\"\n[sites.pgv]\nkind = \"poe\"\n\
    years = 50\n\
    branches = [{ file = \"pgv.csv\", weight = 0.25 }, { name = \"B\", file = \"pga.csv\", weight = 0.75 }]\n\
    [sites.pga]\nfile = \"pga.csv\"\nunit = \"cm/s2\"\n[site_table]\nwithin_km = 2\n\
    pgv = { file = \"pgv.csv\", branches = [{ file = \"pgv.csv\", weight = 0.25 }, { name = \"B\", file = \"pga.csv\", \
    weight = 0.75 }] }\n";

const SETS: &str = "[pgv]\n[records]\nat_level = \"pgv.csv\"\n[output]\nfile = \"x.h5\"";

/// The text of a study, and what it is of.
fn written(study: &str) -> (String, AnyStudy) {
    let folder = Folder::new(study);
    let study = Study::load_any(&folder.path("study.toml"), &[]).unwrap();
    (study.to_toml().unwrap(), study)
}

fn studies() -> Vec<(String, AnyStudy)> {
    let complete = resolving::COMPLETE.replace("../pgv.csv", "./pgv.csv");
    let studies = [&complete, RISING, BRANCHES, displacement::COMPLETE, BLOCKS, BARE_BLOCKS, BARE_OSCILLATORS, SETS];
    let studies = [&studies[..], &[shake_table::COMPLETE, shake_table::BARE]].concat();
    studies.iter().map(|study| written(study)).collect()
}

#[test]
fn to_the_byte() {
    let without_folder = |(text, study): (String, AnyStudy)| {
        let folder = study.output().folder().to_owned();
        let folder = if folder.ends_with("results") { folder.parent().unwrap().to_owned() } else { folder };
        text.replace(&format!("{}/", folder.display()), "")
    };
    let written: Vec<String> = studies().into_iter().map(without_folder).collect();
    insta::assert_snapshot!(written.join("\n=====\n"));
}

/// A study whose files are all gone is read as it was.
#[test]
fn stored_studies_are_read_without_their_files() {
    let mut kinds = Vec::new();
    for (text, study) in studies() {
        assert!(!study.output().folder().exists(), "the folder of the study is gone");
        let again = Study::stored(&text).unwrap();
        assert_eq!(again, study, "{text}");
        assert_eq!(again.to_toml().unwrap(), text);
        kinds.push(again.kind());
    }
    assert!(Kind::ALL.iter().all(|kind| kinds.contains(kind)));
}

/// Paths stay as they are written, whatever lies there; a section that an older version did not write has its defaults.
#[test]
fn stored_paths_are_not_touched() {
    let text = "[pgv]\n[records]\nmanifest = \"/gone/../manifest.csv\"\n[[sites]]\nname = \"x\"\n\
                pgv = \"/\"\n[output]\nfile = \"/\"";
    let AnyStudy::UniformRisk(study) = Study::stored(text).unwrap() else { panic!("of uniform risk") };
    let manifest = study.records.source.manifest().unwrap();
    assert_eq!((manifest.to_str(), study.output.file.to_str()), (Some("/gone/../manifest.csv"), Some("/")));
    assert_eq!((study.bootstrap.replicates, study.warnings.len()), (1000, 0));
    let elsewhere = study.records.source.by_manifest("here.csv".into());
    assert_eq!((elsewhere.manifest().unwrap().to_str(), elsewhere.tag()), (Some("here.csv"), None));
}

/// Its values are checked as those of a file are.
#[test]
fn stored_studies_are_checked() {
    let error = Study::stored("[pgv]\n[risk]\npoe = 2\nyaers = 3").unwrap_err();
    assert_eq!(error.to_string(), "the study in the result: 2 mistakes");
    let told: Vec<String> = error.mistakes().iter().map(ToString::to_string).collect();
    assert_eq!(told, ["risk.poe: the value is 2", "risk.yaers: unknown key `yaers`"]);
    assert!(Study::stored("= 3").unwrap_err().to_string().contains("the study in the result"));
}
