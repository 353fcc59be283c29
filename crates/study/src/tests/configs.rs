use std::fs;
use std::path::{Path, PathBuf};

use super::super::{LibraryStudy, RecordSource, Study, UniformRiskStudy};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs")
}

fn config(name: &str) -> UniformRiskStudy {
    Study::load(&folder().join(name), &[]).unwrap()
}

/// Every study that comes with the program loads, without a warning.
#[test]
fn all_load() {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder()).unwrap() {
        let entry = entry.unwrap();
        if entry.path().extension().is_none_or(|extension| extension != "toml") {
            continue; // structures, the schema
        }
        let name = entry.file_name().into_string().unwrap();
        if name == "rocking-library.toml" {
            let library = LibraryStudy::load(&folder().join(&name), &[]).unwrap();
            assert!(library.blocks.is_some() && library.oscillators.is_some() && !library.title.is_empty());
            continue;
        }
        let study = Study::load_any(&folder().join(&name), &[]).unwrap();
        assert_eq!(study.warnings(), [], "{name}");
        assert!(!study.title().is_empty());
        let stem = study.output().file.file_stem().unwrap().to_str().unwrap().to_owned();
        assert_eq!(format!("{stem}.toml"), name);
        names.push(name);
    }
    assert_eq!(names.len(), 12);
}

/// Of the six sites, what is set out in full in `europe.toml` is the default.
#[test]
fn europe_spells_out_the_defaults() {
    let europe = config("europe.toml");
    let sites: Vec<&str> = europe.sites.iter().map(|site| site.name.as_str()).collect();
    assert_eq!(sites, ["Aachen", "Athens", "Baden", "Focsani", "Montreux", "Perugia"]);
    let bare = super::load("[pgv]\n[pga]").unwrap();
    assert_eq!(europe.records, bare.records);
    assert_eq!(europe.oscillator, bare.oscillator);
    assert_eq!(europe.strengths[..], bare.strengths[..]);
    for (ours, default) in europe.measures.iter().zip(&bare.measures) {
        assert_eq!(ours.levels[..], default.levels[..]);
    }
    assert_eq!(europe.risk.thresholds_m[..], bare.risk.thresholds_m[..]);
    assert_eq!(europe.risk.poe, bare.risk.poe);
    assert_eq!((europe.seed, europe.gravity_m_s2), (bare.seed, bare.gravity_m_s2));
    assert_eq!(europe.regression, bare.regression);
}

/// The keys that `europe.toml` shows as comments are keys: with their marks taken away, the
/// mistakes are only that files are missing and that some exclude each other.
#[test]
fn commented_keys_of_europe_are_keys() {
    let text = fs::read_to_string(folder().join("europe.toml")).unwrap();
    let uncommented =
        ["manifest =", "tag =", "first =", "at_level =", "capacity_m =", "post_uplift_stiffness_per_s2 =", "file ="];
    let mut text = text;
    for key in uncommented {
        let marked = format!("\n# {key}");
        assert!(text.contains(&marked), "{key}");
        text = text.replace(&marked, &format!("\n{key}"));
    }
    let error = Study::parse(&folder().join("europe.toml"), text).unwrap().resolve(&[]).unwrap_err();
    for mistake in error.mistakes() {
        assert!(!mistake.message.contains("unknown"), "{mistake}");
    }
}

#[test]
fn one_site_each() {
    for name in ["Aachen", "Athens", "Baden", "Focsani", "Montreux", "Perugia"] {
        let study = config(&format!("{}.toml", name.to_lowercase()));
        assert_eq!(study.sites.len(), 1);
        assert_eq!(study.sites[0], *config("europe.toml").sites.iter().find(|site| site.name == name).unwrap());
    }
}

/// Small enough for a few seconds: an analysis takes some ten microseconds.
#[test]
fn quick_is_small() {
    let study = config("quick.toml");
    let levels: usize = study.measures.iter().map(|plan| plan.levels.len()).sum();
    let records = usize::try_from(study.records.first.unwrap()).unwrap();
    assert!(records * study.strengths.len() * levels < 50_000);
    assert!(matches!(study.records.source, RecordSource::Synthetic { .. }));
}
