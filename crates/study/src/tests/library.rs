use super::super::{LibraryStudy, RecordSource};
use super::Folder;
use super::shake_table::texts;

fn load(text: &str) -> Result<LibraryStudy, super::StudyError> {
    LibraryStudy::load(&Folder::new(text).path("study.toml"), &[])
}

#[test]
fn empty_sections_have_defaults_and_overrides_apply() {
    let library = load("[block]\n[oscillator]\n").unwrap();
    let blocks = library.blocks.unwrap();
    assert_eq!((&blocks.size_m[..], &blocks.slenderness_rad[..]), (&[1.0, 2.5, 5.0, 10.0][..], &[0.1, 0.2, 0.3][..]));
    assert_eq!(blocks.restitution, None);
    assert_eq!(library.oscillators.unwrap().strengths[..], [0.05, 0.1, 0.2, 0.4]);
    assert!(matches!(library.records.source, RecordSource::Synthetic { pairs: 105, .. }));
    let folder = Folder::new("[block]\nrestitution = [0.8, 0.9]\n");
    let changed = LibraryStudy::load(&folder.path("study.toml"), &["levels.pga=[2, 4]".to_owned()]).unwrap();
    assert_eq!((&changed.pga_levels[..], changed.oscillators), (&[2.0, 4.0][..], None));
    assert_eq!(changed.blocks.unwrap().restitution.unwrap()[..], [0.8, 0.9]);
}

#[test]
fn all_the_mistakes_are_reported_at_once() {
    let told = texts(
        &load(
            "kind = \"library\"\n[records]\nmanifest = \"manifest.csv\"\nvertical = true\ntag = \"nf\"\n[block]\n\
             size_m = -1\nslenderness_rad = [0.1, 1.2]\nheight_m = 2\nrestitution = 1.5\n[strengths]\nvalues = [0]\n\
             [levels]\npga = [2, 1]\nsa = [1]\n",
        )
        .unwrap_err(),
    );
    for words in [
        "kind: unknown key",
        "the ground would fall faster than gravity",
        "tags are given set by set",
        "block.size_m",
        "slenderness_rad[1]: the value is 1.2 rad",
        "unknown key `height_m`",
        "block.restitution",
        "only oscillators have strengths",
        "strengths.values[0]: the value is 0",
        "a grid must increase",
        "unknown key `sa`",
    ] {
        assert!(told.contains(words), "{words:?} is not in:\n{told}");
    }
    assert!(texts(&load("title = \"x\"").unwrap_err()).contains("the library has nothing to shake"));
    let many = load("[block]\nsize_m = \"1:1:1000\"\nslenderness_rad = \"0.001:0.001:0.5\"\n");
    assert!(texts(&many.unwrap_err()).contains("the grids make 500000 blocks and oscillators"));
}
