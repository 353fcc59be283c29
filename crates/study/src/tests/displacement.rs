//! Studies of displacement spectra.

use std::fs;
use std::path::{Path, PathBuf};

use uplift_motion::IntensityMeasure::{Pga, Pgv};
use uplift_spectra::{ScaledBy, Scaling};

use super::super::{AnyStudy, Designed, DisplacementStudy, RecordSource, ScaledTo, Structures, Study};
use super::Folder;

const KIND: &str = "kind = \"displacement spectra\"\n";

fn load(study: &str) -> DisplacementStudy {
    Folder::new(&format!("{KIND}{study}")).load_displacement(&[]).unwrap()
}

fn config(name: &str) -> DisplacementStudy {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs").join(name);
    match Study::load_any(&path, &[]).unwrap() {
        AnyStudy::Displacement(study) => *study,
        other => panic!("{name} is a study of {}", other.kind().key()),
    }
}

#[test]
fn defaults_are_those_of_the_chapters() {
    let bare = load("[oscillator]\n[design]");
    assert_eq!(bare.records.source, RecordSource::Synthetic { pairs: 105, seed: 1 });
    assert!(bare.record_sets.is_empty());
    let Structures::Oscillators(family) = &bare.structures else { panic!("oscillators") };
    assert_eq!((&family.uplift_displacement_m[..], &family.capacity_m[..]), (&[0.0005][..], &[f64::INFINITY][..]));
    assert_eq!((family.restitution, family.free_vibration, family.strengths.len()), (0.95, true, 301));

    // what the shipped studies set and do not call another value is the default
    let chapter_3 = config("chapter-3.toml");
    assert_eq!((&chapter_3.percentiles[..], &chapter_3.design), (&bare.percentiles[..], &bare.design));
    assert_eq!(chapter_3.scaling.to[..], bare.scaling.to[1..]);
    assert_eq!((&chapter_3.scaling.by, chapter_3.gravity_m_s2), (&bare.scaling.by, bare.gravity_m_s2));
    let chapter_2 = config("chapter-2.toml");
    let bare = load("[block]\n[design]");
    assert_eq!((&chapter_2.structures, &chapter_2.scaling), (&bare.structures, &bare.scaling));
    assert_eq!((&chapter_2.design, &chapter_2.percentiles), (&bare.design, &bare.percentiles));
    let Structures::Blocks(family) = &bare.structures else { panic!("blocks") };
    assert_eq!((&family.height_m[..], family.restitution), (&[2.0, 4.0, 10.0, 20.0, 80.0, 1000.0][..], None));
    let designed = Designed::Block { height_m: 10.0, endless_height_m: 1000.0 };
    assert_eq!(bare.design.unwrap().designed, designed);
}

pub(super) const COMPLETE: &str = r#"kind = "displacement spectra"
title = "sets"
gravity_m_s2 = 9.81
[records]
manifest = "manifest.csv"
first = 3
[records.select]
magnitude = "6.5:"
pulse_like = false
[[record_sets]]
name = "one"
tag = "nfp"
leave_out = [829, "RSN5", "Chi Chi"]
[[record_sets]]
name = "all"
[scaling]
to = ["2PGA", "unscaled", "0.25 pgv"]
by = "record"
[spectrum]
percentiles = [2.5, "10:40:90"]
[oscillator]
uplift_displacement_m = [1e-4, 1e-3]
capacity_m = [0.5, inf]
restitution = 1
free_vibration = false
[strengths]
values = "0:1/3:1"
[design]
width_m = 2
height_m = 8
safety_factor = 3
percentile = 84
noise_relative = 0
noise_points = 1
[output]
file = "x.h5"
csv = false
"#;

#[test]
fn a_complete_study_is_read_and_written_as_it_is() {
    let folder = Folder::new(COMPLETE);
    let study = folder.load_displacement(&[]).unwrap();
    assert_eq!(study.record_sets[0].leave_out, ["829", "RSN5", "Chi Chi"]);
    assert_eq!((study.record_sets[1].tag.as_deref(), study.records.first), (None, Some(3)));
    let to = |multiple, measure| ScaledTo::Median { multiple, measure };
    assert_eq!(study.scaling.to, [to(2.0, Pga), ScaledTo::Unscaled, to(0.25, Pgv)]);
    let (ways, places) = study.scaling.ways();
    assert_eq!((ways[1], &places[..]), (Scaling::Unscaled, &[0, 1, 2][..]));
    assert_eq!(ways[2], Scaling::To { measure: Pgv, multiple: 0.25, by: ScaledBy::Record });
    assert_eq!(config("chapter-2.toml").scaling.ways().1, [0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]);
    assert_eq!(study.percentiles[..], [2.5, 10.0, 50.0, 90.0]);
    assert_eq!((study.structures.lines(), study.structures.abscissa().len()), (4, 4));

    let written = study.to_toml().unwrap();
    fs::write(folder.path("study.toml"), &written).unwrap();
    assert_eq!(folder.load_displacement(&[]).unwrap(), study, "{written}");

    // blocks too, and what is overridden
    fs::write(folder.path("study.toml"), format!("{KIND}[block]\n[design]\n[output]\nfile = \"x.h5\"")).unwrap();
    for restitution in ["Housner", "0.9"] {
        let set =
            [&format!("block.restitution={restitution}"), "slenderness.values=0.1:0.1:0.3", "scaling.to=[\"1 PGV\"]"];
        let study = folder.load_displacement(&set).unwrap();
        assert_eq!((study.structures.abscissa().len(), study.scaling.ways().0.len()), (3, 2));
        let before = fs::read(folder.path("study.toml")).unwrap();
        fs::write(folder.path("study.toml"), study.to_toml().unwrap()).unwrap();
        assert_eq!(folder.load_displacement(&[]).unwrap(), study);
        fs::write(folder.path("study.toml"), before).unwrap();
    }
}

#[test]
fn percentiles_that_look_like_fractions_are_reported() {
    assert_eq!(load("[oscillator]\n[spectrum]\npercentiles = [0.5, 50]\n[design]").warnings, []);
    let told = load("[oscillator]\n[spectrum]\npercentiles = [0.16, 0.5]\n[design]\npercentile = 0.84").warnings;
    let what: Vec<&str> = told.iter().map(|warning| warning.what.as_str()).collect();
    assert!(told.iter().all(|warning| warning.unlikely) && what.len() == 2, "{what:?}");
    assert!(what[0].starts_with("the largest of spectrum.percentiles is 0.5 %; usual is from 2 to 100 %"), "{what:?}");
    assert!(what[1].starts_with("design.percentile is 0.84 %; usual is"), "{what:?}");
    assert_eq!(told[0].what_to_do, "correct spectrum.percentiles, or leave it if it is meant");
}

#[test]
fn all_the_mistakes_are_reported_at_once() {
    let folder = Folder::new(
        r#"kind = "displacement spectra"
seed = 3
[records]
tag = "nfp"
first = 200
[[record_sets]]
name = "far-field"
leave_out = [1.5]
[[record_sets]]
tag = ""
[[record_sets]]
name = "Far-field"
[scaling]
to = ["unscaled", "0.5 PGD", "1 PGA", "1.0 PGA"]
by = ["componant"]
[spectrum]
percentiles = [50, 120]
[oscillator]
uplift_displacement_m = [0.0005, 0.5]
capacity_m = [0.3, inf, 2]
heigth_m = 2
[slenderness]
values = 0.1
[design]
height_m = 0
noise_points = 20
[pgv]
"#,
    );
    insta::assert_snapshot!(folder.rendered(&folder.load_displacement(&[]).unwrap_err()));
}

/// The keys that `chapter-3.toml` shows as comments are keys: with their marks taken away, no more is wrong than that a
/// file is missing.
#[test]
fn commented_keys_are_keys() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/chapter-3.toml");
    let mut text = fs::read_to_string(&path).unwrap();
    for key in ["manifest =", "first =", "file ="] {
        let marked = format!("\n# {key}");
        assert!(text.contains(&marked), "{key}");
        text = text.replace(&marked, &format!("\n{key}"));
    }
    let error = Study::parse(&path, text).unwrap().resolve_any(&[]).unwrap_err();
    assert!(error.mistakes().iter().all(|mistake| mistake.message.starts_with("file not found")), "{error:?}");
}

/// Each study has exactly the mistake beside it.
#[test]
fn one_by_one() {
    for (study, expected) in [
        ("kind = \"displacement\"", "kind: unknown kind: the text \"displacement\""),
        (
            "kind = 3",
            "kind: expected one of \"uniform risk spectra\", \"displacement spectra\", \"shake table\", found the \
             number 3",
        ),
        ("", "the study has nothing to shake"),
        ("[block]\n[oscillator]", "block: a study has oscillators or blocks, not both"),
        ("[block]\n[strengths]\nvalues = 1", "strengths: blocks have no strength"),
        ("[block]\nrestitution = \"Hausner\"", "block.restitution: unknown restitution: the text \"Hausner\""),
        ("[block]\n[slenderness]\nvalues = [0.1, 1.5]", "slenderness.values[1]: the value is 1.5"),
        ("[block]\n[design]\nwidth_m = 1.6", "design.width_m: unknown key `width_m`"),
        ("[oscillator]\ncapacity_m = []", "oscillator.capacity_m: the list has 0 items"),
        (
            "[oscillator]\nuplift_displacement_m = \"0.0001:0.0001:9\"\n[strengths]\nvalues = \"0:1/300:1\"",
            "the lists and grids make 27090000 structures",
        ),
        ("[oscillator]\n[design]\nwidth_m = 20", "design.width_m: a column 20 m wide and 9.6 m high does not rock"),
        (
            "[oscillator]\nuplift_displacement_m = 2\n[design]",
            "design.width_m: a column of width 1.6 m, its capacity, is not above the uplift displacement 2 m",
        ),
        ("[oscillator]\n[scaling]\nby = []", "scaling.by: the list has 0 items"),
        (
            "[oscillator]\n[records]\nmanifest = \"manifest.csv\"\n[output]\nfile = \"manifest.csv\"",
            "output.file: the results would overwrite an input",
        ),
        (
            "[oscillator]\n[output]\nfile = \"notes.txt\"",
            "output.file: the result is an HDF5 file, but this name says otherwise",
        ),
    ] {
        let kind = if study.starts_with("kind") { "" } else { KIND };
        let folder = Folder::new(&format!("{kind}{study}"));
        let error = Study::load_any(&folder.path("study.toml"), &[]).unwrap_err();
        let found: Vec<String> = error.mistakes().iter().map(ToString::to_string).collect();
        assert!(found.len() == 1 && found[0].starts_with(expected), "{study}\n{found:?}");
    }
}

/// A command that needs uniform risk spectra says what takes the study, and nothing of its keys.
#[test]
fn the_wrong_kind_is_one_mistake() {
    let folder = Folder::new(COMPLETE);
    let error = folder.load(&[]).unwrap_err();
    insta::assert_snapshot!(folder.rendered(&error));
    // and the kind that needs not be said may be
    assert!(Folder::new("kind = \"uniform risk spectra\"\n[pgv]").load(&[]).is_ok());
}
