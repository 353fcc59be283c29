use super::*;

fn refused(path: &Path, kind: OutputKind, inputs: &[&Path], force: bool) -> Option<String> {
    check(&[Output::new(path, kind)], inputs, force).err().map(|error| error.to_string())
}

#[test]
fn only_an_earlier_output_of_the_same_kind_gives_way() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    // as tables were once, and still give way
    let history = "# uplift 0.1.0 (abc); record a\ntime_s,displacement_m\n0,0\n";
    let cases: [(&str, OutputKind, &[u8], &[u8]); 6] = [
        ("a.csv", OutputKind::Table("time_s"), history.as_bytes(), b"# uplift 0.1.0 (abc)\nrecord_id,file_h1\n"),
        ("a.json", OutputKind::Json, b"{\n  \"provenance\": \"uplift 0.1.0\"", b"{\"records\": 1}"),
        ("a.mat", OutputKind::Matlab, b"MATLAB 5.0 MAT-file, uplift 0.1.0", b"MATLAB 5.0 MAT-file, Platform: GLNXA64"),
        ("a.svg", OutputKind::Figure, b"<svg width=\"1\">\n<desc>uplift 0.1.0</desc>", b"<svg width=\"1\">"),
        ("a.png", OutputKind::Figure, b"\x89PNG\r\ntEXtSoftware\0uplift 0.1.0", b"\x89PNG\r\n"),
        ("a.html", OutputKind::Page, b"<meta name=\"generator\" content=\"uplift 0.1.0\">", b"<p>uplift 0.1.0 is"),
    ];
    for (name, kind, ours, foreign) in cases {
        let path = place(name);
        assert_eq!(refused(&path, kind, &[], false), None, "{name}: nothing is there");
        std::fs::write(&path, ours).unwrap();
        assert_eq!(refused(&path, kind, &[], false), None, "{name}: ours");
        std::fs::write(&path, foreign).unwrap();
        assert!(refused(&path, kind, &[], false).unwrap().contains("--force"), "{name}: foreign");
        assert_eq!(refused(&path, kind, &[], true), None, "{name}: forced");
        assert_eq!(std::fs::read(&path).unwrap(), foreign, "{name}: only looked at");
        assert!(refused(&path, kind, &[&path], true).unwrap().contains("an input"), "{name}: an input");
    }
}

#[test]
fn of_another_result() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    std::fs::write(&path, "# uplift 0.1.0 (abc), 2026; one.h5; records\nsite,im\n").unwrap();
    let output = |result: &str| Output::new(&path, OutputKind::Table("site")).with_result(Path::new(result));
    check(&[output("results/one.h5")], &[Path::new("results/one.h5")], false).unwrap();
    let error = check(&[output("two.h5")], &[Path::new("two.h5")], false).unwrap_err();
    assert!(error.to_string().contains("not of two.h5"), "{error}");
    // nor of one whose name is a part of it
    for part in ["e.h5", "one.h", "ne.h5"] {
        assert!(check(&[output(part)], &[Path::new(part)], false).is_err(), "{part}");
    }
}

#[test]
fn a_table_is_recognised_by_the_metadata_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    let beside = metadata_path(&path);
    assert_eq!(beside, folder.path().join("a.csv-metadata.json"));
    let line = "uplift 0.1.0 (abc), 2026; one.h5; records: \"mine\"";
    let write = |names: &str, told: &str| {
        std::fs::write(&path, format!("{names}\n0,0\n")).unwrap();
        std::fs::write(&beside, told).unwrap();
    };
    let kind = OutputKind::Table("u_m");
    let ours = metadata_text(&path, line, ["site", "u_m"].into_iter());
    write("site,u_m", &ours);
    assert_eq!(refused(&path, kind, &[], false), None);
    let of =
        |result: &str| check(&[Output::new(&path, kind).with_result(Path::new(result))], &[Path::new(result)], false);
    of("one.h5").unwrap();
    assert!(of("two.h5").unwrap_err().to_string().contains("not of two.h5"));
    assert!(refused(&path, kind, &[&beside], true).unwrap().contains("an input"));
    // another table in its place, or another file beside it
    write("site,iml", &ours);
    assert!(refused(&path, kind, &[], false).unwrap().contains("a.csv already exists"));
    write("site,u_m", "{\"dc:title\": \"mine\"}");
    assert!(refused(&path, kind, &[], false).unwrap().contains("a.csv-metadata.json exists and is not"));
    assert_eq!(refused(&path, kind, &[], true), None);
    // a table that nothing is said of
    std::fs::remove_file(&beside).unwrap();
    assert!(refused(&path, kind, &[], false).unwrap().contains("a.csv already exists"));
}

#[test]
fn names_say_what_is_written() {
    let path = Path::new("folder/a.csv");
    let error = refused(path, OutputKind::Matlab, &[], true).unwrap();
    assert!(error.contains(".mat") && error.contains("e.g. a.mat"), "{error}");
    assert!(wrong_ending(Path::new("a.svg"), &["svg", "png"]).is_none());
    assert!(wrong_ending(Path::new("a"), &["svg", "png"]).unwrap().contains(".svg or .png"));
}

#[cfg(unix)]
#[test]
fn an_input_by_any_name() {
    let folder = tempfile::tempdir().unwrap();
    let [input, hard, soft] = ["input.csv", "hard.csv", "soft.csv"].map(|name| folder.path().join(name));
    std::fs::write(&input, "# uplift 1\nsite\n").unwrap();
    std::fs::hard_link(&input, &hard).unwrap();
    std::os::unix::fs::symlink(&input, &soft).unwrap();
    for path in [hard, soft] {
        assert!(refused(&path, OutputKind::Table("site"), &[&input], true).unwrap().contains("an input"));
    }
}

#[test]
fn files_beside_a_result_are_named_after_it() {
    let beside = |result: &str| beside(Path::new(result), "urs.csv").display().to_string();
    assert_eq!(beside("r/site.h5"), "r/site.urs.csv");
    assert_eq!(beside("r/site.v2.h5"), "r/site.v2.urs.csv");
    assert_eq!(beside("r/site.v2"), "r/site.v2.urs.csv");
}
