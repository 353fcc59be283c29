use std::fs;

use super::super::{Place, Study};
use super::{Folder, load, mistakes, render};

#[test]
fn many_at_once() {
    let folder = Folder::new(
        r#"title = 2024
gravity_m_s2 = -9.81
[records]
manifest = "no/such.csv"
component = "h3"
first = 0
[oscillator]
restitution = 1.2
capacity_m = 0.0001
[strengths]
values = ["0:0.333:1"]
[pgv]
levels_m_s = [0.01, 0.02]
[pga]
levels_g = [0.1, 0.3, 0.2]
[risk]
poe = [0.02, 2]
thresholds_m = []
contour = "exakt"
[[sites]]
name = "Athens"
pgv = "pgv.csv"
[[sites]]
name = "athens"
pgv = { file = "pgv.csv", unit = "g" }
pga = { file = "pga.csv", kind = "poe" }
"#,
    );
    let error = folder.load(&[]).unwrap_err();
    insta::assert_snapshot!(folder.rendered(&error));
}

#[test]
fn measures_that_are_none() {
    let folder = Folder::new(
        "[measures.pgv]
[measures.d5_95]
[measures.\"SA(1.0)\"]
[measures.sa_99s]
[consistency]
against = \"d5_75\"
[[sites]]
name = \"x\"
sa_1.0s = \"pga.csv\"
d5_95 = \"pga.csv\"
",
    );
    insta::assert_snapshot!(folder.rendered(&folder.load(&[]).unwrap_err()));
    assert!(mistakes("[pgv]\n[consistency]\nagainst = \"sa\"\n", &[])[0].contains("unknown intensity measure \"sa\""));
}

#[test]
fn unknown_keys_and_sections() {
    let folder = Folder::new(
        "sede = 2
[strenghts]
values = \"0:1/300:1\"
[pgv]
levels = [1, 2]
[pga]
levels_cm_s = [1, 2]
[risk]
poe_percent = [2]
maf_surfaces = true
something = 1
[oscillator]
capacity_mm = 300
[[site]]
name = \"Athens\"
[Records]
",
    );
    let error = folder.load(&[]).unwrap_err();
    insta::assert_snapshot!(folder.rendered(&error));
}

#[test]
fn syntax() {
    let folder = Folder::new("title = \"unfinished\n[pgv\n[strengths]\nvalues = 0:1/300:1\n");
    let error = folder.load(&[]).unwrap_err();
    insta::assert_snapshot!(folder.rendered(&error));
    let folder = Folder::new("[pgv]\n[risk]\nyears = 50\nyears = 475\n[pgv]\n");
    let error = folder.load(&[]).unwrap_err();
    insta::assert_snapshot!("keys_twice", folder.rendered(&error));
}

#[test]
fn places() {
    let error = load("[pgv]\n# ş\n[risk]\n  poe = [ 0.1, \"ş\", 3 ]\n").unwrap_err();
    let places: Vec<_> = error.mistakes().iter().map(|m| (m.key.as_str(), m.place.clone())).collect();
    let at = |span, column| Place::File { span, line: 4, column };
    assert_eq!(places, [("risk.poe[1]", at(33..37, 16)), ("risk.poe[2]", at(39..40, 21))]);
}

/// Each study has exactly the mistakes beside it.
#[test]
fn one_by_one() {
    for (study, expected) in [
        ("", "the study has no intensity measure"),
        ("pgv = 3", "pgv: expected a section, found the number 3"),
        ("[[pgv]]", "pgv: expected a section, found a list of sections"),
        ("[pgv]\nlevels_cm_s = [1]", "pgv.levels_cm_s: too few values in the grid: 1"),
        ("[pgv]\nlevels_cm_s = [0, 1]", "pgv.levels_cm_s[0]: the value is 0 cm/s"),
        ("[pgv]\nlevels_cm_s = [1, nan]", "pgv.levels_cm_s[1]: the value is NaN cm/s"),
        (
            "[pgv]\nlevels_cm_s = [\"1:1:5\", \"5:1:9\"]",
            "pgv.levels_cm_s[1]: 5 cm/s follows 5 cm/s, but a grid must increase",
        ),
        ("[pgv]\nlevels_cm_s = 10:20:50", "pgv.levels_cm_s: expected a grid [cm/s], found the date 10:20:50"),
        (
            "[pgv]\nlevels_cm_s = [\"0.05:0.05:3000\", \"3000.05:0.05:6000\"]",
            "pgv.levels_cm_s: the grid has more than 100000 values",
        ),
        ("[pgv]\n[strengths]\nvalues = -0.1", "strengths.values: the value is -0.1"),
        ("[pgv]\n[strengths]\nvalues = { start = 0, stop = 1 }", "strengths.values: the grid has no count"),
        (
            "[pgv]\n[strengths]\nvalues = { start = 0, stop = 1, count = 1000000000 }",
            "strengths.values.count: the value is 1000000000",
        ),
        (
            "[pgv]\n[strengths]\nvalues = { start = 0, stop = 1, count = 3, step = 1 }",
            "strengths.values.step: unknown key `step`",
        ),
        (
            "[pgv]\n[strengths]\nvalues = { start = 1, stop = 0, count = 3 }",
            "strengths.values: \"1:-1/2:0\" has the step -1/2",
        ),
        ("[pgv]\n[risk]\npoe = [0.1, 0.1]", "risk.poe[1]: 0.1 is given twice"),
        ("[pgv]\n[risk]\npoe = []", "risk.poe: the list is empty"),
        ("[pgv]\n[risk]\npoe = 1", "risk.poe: the value is 1"),
        ("[pgv]\n[risk]\nyears = \"fifty\"", "risk.years: expected a number [yr], found the text \"fifty\""),
        ("[pgv]\n[risk]\ncontour = \"grid\"\nthresholds_m = 1", "risk.thresholds_m: too few values in the grid: 1"),
        ("seed = -1\n[pgv]", "seed: the value is -1"),
        ("seed = 99999999999999999999\n[pgv]", "seed: expected a whole number, found the number 1e20"),
        ("seed = 1.5\n[pgv]", "seed: expected a whole number, found the number 1.5"),
        (
            "[pgv]\n[oscillator]\ncapacity_m = 0.3\npost_uplift_stiffness_per_s2 = 1",
            "oscillator.post_uplift_stiffness_per_s2: a positive stiffness after uplift excludes a capacity",
        ),
        (
            "[pgv]\n[oscillator]\nfree_vibration = \"yes\"",
            "oscillator.free_vibration: expected true or false, found the text \"yes\"",
        ),
        ("[pgv]\n[records]\ntag = \"x\"", "records.tag: a tag chooses rows of a manifest: add records.manifest"),
        ("[pgv]\n[records]\nfirst = 106", "records.first: 106 is more than the 105 records there are"),
        (
            "[pgv]\n[records]\nmanifest = \"manifest.csv\"\n[records.synthetic]\nfirst = 1",
            "records.synthetic.first: unknown key `first`",
        ),
        ("[pgv]\n[records.synthetic]\npairs = 1000000", "records.synthetic.pairs: the value is 1000000"),
        ("[pgv]\n[records]\nmanifest = \" \"", "records.manifest: the text is empty"),
        ("[pgv]\n[sites]\nname = \"x\"", "sites: expected a list of sections, found a section"),
        ("[pgv]\nx = 1\n", "pgv.x: unknown key `x`"),
        (
            "[pgv]\n[[sites]]\nname = \"a/b\"\npgv = \"pgv.csv\"",
            "sites[0].name: the name cannot name a group of the result file",
        ),
        ("[pgv]\n[[sites]]\npgv = \"pgv.csv\"", "sites[0].name: the site has no name"),
        ("[pgv]\n[[sites]]\nname = \"x\"", "sites[0].pgv: x has no PGV curve, and the study has a section [pgv]"),
        (
            "[pgv]\n[[sites]]\nname = \"x\"\npgv = 3",
            "sites[0].pgv: expected the path of a hazard curve, found the number 3",
        ),
        ("[pgv]\n[[sites]]\nname = \"x\"\npgv = {}", "sites[0].pgv.file: the curve has no file"),
        (
            "[pgv]\n[[sites]]\nname = \"x\"\npgv = { file = \"pgv.csv\", years = 50 }",
            "sites[0].pgv.years: annual frequencies have no time",
        ),
        ("sites = [1]\n[pgv]", "sites[0]: expected a section, found the number 1"),
    ] {
        assert_eq!(mistakes(study, &[]), [expected], "{study}");
    }
}

#[test]
fn files_that_cannot_be() {
    let folder = Folder::new("[pgv]\n[records]\nmanifest = \".\"\n[output]\nfile = \".\"");
    let error = folder.load(&[]).unwrap_err();
    let told: Vec<_> = error.mistakes().iter().map(|m| m.message.split(':').next()).collect();
    assert_eq!(told, [Some("this is a folder"), Some("this is a folder")]);
    for overwritten in ["study.toml", "pgv.csv", "../{}/manifest.csv"] {
        let name = folder.path("").file_name().unwrap().to_str().unwrap().to_owned();
        let text = format!(
            "[pgv]\n[records]\nmanifest = \"manifest.csv\"\n[[sites]]\nname = \"x\"\npgv = \"pgv.csv\"\n[output]\n\
             file = \"{}\"",
            overwritten.replace("{}", &name)
        );
        fs::write(folder.path("study.toml"), text).unwrap();
        let error = folder.load(&[]).unwrap_err();
        assert!(error.mistakes()[0].message.starts_with("the results would overwrite an input"));
    }
}

#[test]
fn study_files_that_cannot_be_read() {
    let folder = Folder::new("");
    fs::write(folder.path("latin.toml"), b"[pgv]\ntitle = \"Foc\xbaani\"").unwrap();
    fs::write(folder.path("large.toml"), vec![b'#'; (4 << 20) + 1]).unwrap();
    for (name, expected) in [
        ("missing.toml", "missing.toml: there is no such file: give its path"),
        ("", "it is a folder: give a file, e.g. "),
        ("latin.toml", "line 2 is not UTF-8 text; save it as UTF-8"),
        ("large.toml", "it has more than 4194304 bytes; is it a study file?"),
    ] {
        let error = Study::load(&folder.path(name), &[]).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
        assert!(error.mistakes().is_empty());
        assert!(render(&error).contains(expected));
    }
}

#[test]
fn files_of_another_kind_are_named() {
    let folder = Folder::new("");
    let utf_16: Vec<u8> = "\u{feff}[pgv]".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let files: [(&str, &[u8]); 9] = [
        ("library.toml", b"[block]\nsize_m = [1]\n"),
        ("r.h5", b"\x89HDF\r\n\x1a\n\0\0\xff"),
        ("named.toml", b"\x89HDF\r\n\x1a\n\0\0\xff"),
        ("z.zip", b"PK\x03\x04\xff"),
        ("a.AT2", b"A DATABASE\nsome event\nUNITS OF G\nNPTS= 4, DT= .01 SEC\n"),
        ("samples.txt", b"0.00 1.5e-3\r\n0.01 -2e-3\r\n"),
        ("t.csv", b"iml,maf\n1,2\n"),
        ("pier.toml", b"kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 8000\n"),
        ("wide.toml", &utf_16),
    ];
    for (name, content) in files {
        fs::write(folder.path(name), content).unwrap();
    }
    for (name, expected) in [
        ("r.h5", "it is a result, not a study: `uplift status`"),
        ("named.toml", "it is a result, not a study"),
        ("z.zip", "it is a zip archive, not a study: `uplift records import`"),
        ("a.AT2", "it is a record, not a study: `uplift response`"),
        ("samples.txt", "it is a record, not a study: `uplift response`"),
        ("t.csv", "it is a table, not a study"),
        ("pier.toml", "it is a structure, not a study: `uplift design`"),
        ("library.toml", "it is a library, not a study: `uplift library`"),
        ("wide.toml", "it is UTF-16 text"),
    ] {
        let error = Study::load_any(&folder.path(name), &[]).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    fs::write(folder.path("study.toml"), "[pgv]\n[[sites]]\nname = 'A'\n").unwrap();
    fs::write(folder.path("chapter.toml"), "kind = \"displacement spectra\"\n").unwrap();
    for (name, expected) in [
        ("r.h5", "it is a result, not a structure: the structure comes first, and the result after --urs"),
        ("study.toml", "it is a study, not a structure: `uplift run`"),
        ("chapter.toml", "it is a study, not a structure"),
    ] {
        let error = crate::Structure::load(&folder.path(name)).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    assert!(crate::Structure::load(&folder.path("pier.toml")).is_ok());
    for (name, expected) in [
        ("pier.toml", "it is a structure, not a library: `uplift design`"),
        ("study.toml", "it is a study, not a library: `uplift run`"),
    ] {
        let error = crate::LibraryStudy::load(&folder.path(name), &[]).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    assert!(crate::LibraryStudy::load(&folder.path("library.toml"), &[]).is_ok());
}

#[test]
fn backslashes_in_paths() {
    for path in ["C:\\Users\\me\\set.csv", "C:\\records\\set.csv", "C:\\temp\\new.csv"] {
        let error = load(&format!("[records]\nmanifest = \"{path}\"\n[pgv]\n")).unwrap_err();
        assert!(!error.mistakes().is_empty());
        for mistake in error.mistakes() {
            let help = mistake.help.as_deref().unwrap();
            assert!(help.contains("'single quotes'") && help.contains("write / in place of"), "{path}: {help}");
        }
    }
}

#[test]
fn a_flood_is_counted() {
    let unknown: Vec<String> = (0..250).map(|i| format!("key{i} = 1")).collect();
    let error = load(&unknown.join("\n")).unwrap_err();
    assert_eq!(error.mistakes().len(), 100);
    assert!(error.to_string().ends_with("251 mistakes, the first 100 are listed"));
}

/// Large nonsense is refused in a moment: nothing here may take time or memory beyond the size of the file.
#[test]
fn large_nonsense() {
    let numbered = |item: &dyn Fn(usize) -> String| (0..150_000).map(item).collect::<String>();
    let numbers = numbered(&|i| format!("{i},"));
    for (text, expected) in [
        (numbered(&|i| format!("k{i}=1\n")), "the first 100 are listed"),
        (numbered(&|_| "= ]\n".to_owned()), "the first 100 are listed"),
        (format!("[pgv]\n[risk]\npoe = [{numbers}]"), "1 mistake"),
        (format!("[pgv]\nlevels_cm_s = [{numbers}]"), "1 mistake"),
        (format!("[pgv]\n{}", numbered(&|_| "[[sites]]\n".to_owned())), "1 mistake"),
        (format!("x = {}1{}", "[".repeat(100_000), "]".repeat(100_000)), "mistake"),
        (format!("[pgv]\n[{}]", "a.".repeat(100_000) + "a"), "mistake"),
    ] {
        let error = load(&text).unwrap_err();
        assert!(error.to_string().ends_with(expected) || expected == "mistake", "{error}");
        assert!(!error.mistakes().is_empty());
    }
}

#[test]
fn warnings() {
    let text = "gravity_m_s2 = 981\n[pgv]\n[strengths]\nvalues = [0, 0.5, 1]\n[risk]\nthresholds_m = [0, 10, 1000]";
    let study = load(text).unwrap();
    let starts = [
        "gravity_m_s2 is 981 m/s2; usual is from 9.7 to 9.9",
        "the largest of risk.thresholds_m is 1000 m; usual is from",
        "no [[sites]]",
        "regression.strength_above = 0.05 leaves 2",
    ];
    assert_eq!(study.warnings.len(), starts.len());
    for (warning, start) in study.warnings.iter().zip(starts) {
        assert!(warning.what.starts_with(start), "{warning}");
        assert!(!warning.what_to_do.is_empty());
    }
}
