//! `uplift records`: folders of downloads become manifests, records are listed, shown, chosen and made.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use polars_io::prelude::{CsvParseOptions, CsvReadOptions, SerReader};

use crate::common::{SMALL_STUDY, SmallStudy, real_records, repository, uplift};

/// A record that moves and comes to rest: its velocity is sin(0.1 i) exp(-0.01 i).
fn wave(points: u32, scale: f64) -> Vec<f64> {
    (0..points)
        .map(|i| {
            let i = f64::from(i);
            scale * ((0.1 * i).cos() - 0.1 * (0.1 * i).sin()) * (-0.01 * i).exp()
        })
        .collect()
}

fn at2(title: &str, unit: &str, dt_s: f64, values: &[f64]) -> String {
    let mut text = format!("A DATABASE\n{title}\n{unit}\nNPTS= {}, DT= {dt_s} SEC\n", values.len());
    for row in values.chunks(5) {
        for value in row {
            write!(text, " {value:.9E}").unwrap();
        }
        text.push('\n');
    }
    text
}

const G: &str = "ACCELERATION TIME SERIES IN UNITS OF G";

/// Rows of a CSV file by column.
pub fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    let table = CsvReadOptions::default()
        .with_infer_schema_length(Some(0))
        .with_parse_options(CsvParseOptions::default().with_comment_prefix(Some("#")))
        .try_into_reader_with_file_path(Some(path.to_owned()))
        .unwrap()
        .finish()
        .unwrap();
    (0..table.height())
        .map(|row| {
            table
                .columns()
                .iter()
                .map(|column| (column.name().to_string(), column.str().unwrap().get(row).unwrap_or("").to_owned()))
                .collect()
        })
        .collect()
}

/// A download as PEER gives it, with what goes wrong in such folders.
pub fn download() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    let title = |component: &str| format!("Some Event, 1/2/1999, A Station, {component}");
    for (name, component, scale) in [
        ("RSN12_EVENT_STA360.AT2", "360", 0.02),
        ("RSN12_EVENT_STA090.AT2", "90", 0.03),
        ("RSN12_EVENT_STA-UP.AT2", "UP", 0.01),
    ] {
        write(name, &at2(&title(component), G, 0.01, &wave(3000, scale)));
    }
    write("RSN12_EVENT_STA090.VT2", &at2(&title("90"), "VELOCITY TIME SERIES IN UNITS OF CM/S", 0.01, &wave(9, 1.0)));
    // one of another length and with a rounded step, one without a partner, one twice, one cut
    write("more/RSN13_EVENT_STB000.AT2", &at2(&title("0"), G, 0.0066, &wave(2000, 0.5)));
    write("more/RSN13_EVENT_STB090.AT2", &at2(&title("90"), G, 0.0066, &wave(1990, 0.4)));
    write("more/RSN14_EVENT_STC000.AT2", &at2(&title("0"), G, 0.01, &wave(2500, 0.35)));
    write("more/copy/RSN12_EVENT_STA360.AT2", &at2(&title("360"), G, 0.01, &wave(3000, 0.02)));
    // two other events, whose numbers look like directions
    write("more/eq001.txt", &at2(&title(""), G, 0.01, &wave(700, 0.5)));
    write("more/eq002.txt", &at2(&title(""), G, 0.01, &wave(700, 0.6)));
    let cut = at2(&title("0"), G, 0.01, &wave(500, 0.5));
    write("more/RSN15_EVENT_STD000.AT2", &cut[..cut.len() / 2]);
    write(
        "_SearchResults.csv",
        "PEER Ground Motion Database\n\n -- Summary of Metadata of Selected Records --\n\
         Result ID, Spectral Ordinate, Record Sequence Number, Scale Factor, Earthquake Name, Year, Station Name, \
         Magnitude, Mechanism, Rjb (km), Rrup (km), Vs30 (m/sec), Lowest Useable Frequency (Hz), Horizontal-1 Acc. \
         Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename\n\
         1,SRSS,12,1.0,\"Some Event, Somewhere\",1999,\"A Station\",6.7,strike slip,10.1,12.3,450.0,0.125,\
         RSN12_EVENT_STA360.AT2,RSN12_EVENT_STA090.AT2,RSN12_EVENT_STA-UP.AT2\n\
         2,SRSS,99,1.0,Other,2000,Nowhere,7.0,reverse,20.1,22.3,350.0,0.25,x.AT2,y.AT2,z.AT2\n\n -- Spectra --\nT,a\n\
         0.1,0.2\n",
    );
    folder
}

/// Of equal motions the files of the search are kept, whatever the copies are called.
#[test]
fn copies_do_not_displace_the_files_of_a_search() {
    let folder = download();
    for (copy, file) in [("A_000.AT2", "STA360"), ("A_090.AT2", "STA090")] {
        let file = format!("RSN12_EVENT_{file}.AT2");
        std::fs::copy(folder.path().join("more").join(&file), folder.path().join(copy))
            .or_else(|_| std::fs::copy(folder.path().join(&file), folder.path().join(copy)))
            .unwrap();
    }
    let done = uplift(folder.path(), &["records", "import", ".", "-o", "set.csv"]).ok();
    assert!(done.stderr.contains("A_000.AT2: the same motion as"), "{}", done.stderr);
    assert!(done.stderr.contains("no pair of files here: RSN99\n"), "{}", done.stderr);
    let rows = rows(&folder.path().join("set.csv"));
    assert_eq!(
        (rows[0]["record_id"].as_str(), rows[0]["event"].as_str()),
        ("RSN12_EVENT_STA", "Some Event, Somewhere")
    );
}

#[test]
fn a_folder_of_downloads_becomes_a_manifest() {
    let folder = download();
    let done = uplift(folder.path(), &["records", "import", ".", "-o", "set.csv"]).ok();
    assert!(done.stdout.contains("2 pairs"), "{}", done.stdout);
    // what is not in the manifest comes before remarks on what is
    let place = |words: &str| done.stderr.find(words).unwrap();
    assert!(place("not read (") < place("RSN13_EVENT_STB: its components"), "{}", done.stderr);
    for remark in [
        "RSN14_EVENT_STC000.AT2: its other horizontal component",
        "RSN12_EVENT_STA360.AT2: the same motion as",
        "RSN13_EVENT_STB: its components have 2000 and 1990 points",
        "RSN13_EVENT_STB: a time step of 0.0066 s",
        "1 of 2 records of the search have no pair of files here: RSN99",
        "header says 500 points",
        "eq002.txt: these point in nearly the same direction",
    ] {
        assert!(done.stderr.contains(remark), "{remark:?} is not in:\n{}", done.stderr);
    }
    let rows = rows(&folder.path().join("set.csv"));
    let [first, second] = rows.as_slice() else { panic!("{rows:?}") };
    // as the search results list them, which is not the order of the names
    assert!(
        first["file_h1"].ends_with("RSN12_EVENT_STA360.AT2") && first["file_h2"].ends_with("RSN12_EVENT_STA090.AT2")
    );
    for (column, value) in [
        ("record_id", "RSN12_EVENT_STA"),
        ("format", "at2"),
        ("event", "Some Event, Somewhere"),
        ("magnitude", "6.7"),
        ("rrup_km", "12.3"),
        ("vs30", "450.0"),
        ("lowest_usable_hz", "0.125"),
        ("dt_h1_s", "0.01"),
        ("points_h1", "3000"),
        ("direction_h2", "90"),
        ("file_v", "RSN12_EVENT_STA-UP.AT2"),
        ("pulse_like", "no"),
    ] {
        assert_eq!(first[column], value, "{column}");
    }
    assert_eq!(first["warnings"], "");
    assert_eq!(second["warnings"], "not synchronised; rounded time step");
    // The components differ in scale alone, so all directions follow from one line through the origin.
    let peak = wave(3000, 1.0).iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let number = |column: &str| first[column].parse::<f64>().unwrap();
    assert!((number("pga_g") / (peak * 0.0006_f64.sqrt()) - 1.0).abs() < 1e-4);
    let length = 0.02_f64.hypot(0.03);
    assert!((number("pga_rotd100_g") / (peak * length) - 1.0).abs() < 1e-3);
    assert!((number("pga_rotd50_g") / (peak * length * 0.5_f64.sqrt()) - 1.0).abs() < 0.01);
    // Nothing of an import is a record.
    let again = uplift(folder.path(), &["records", "import", ".", "-o", "again.csv"]).ok();
    assert!(again.stdout.contains("2 pairs") && !again.stderr.contains("set.csv"), "{}", again.stderr);
}

#[test]
fn a_study_runs_on_what_was_imported() {
    let folder = download();
    uplift(folder.path(), &["records", "import", ".", "-o", "set.csv", "--quiet"]).ok();
    let study = SmallStudy::with(&SMALL_STUDY.replace(
        "first = 4\n[records.synthetic]\npairs = 4\n",
        "manifest = \"set.csv\"\nintensity = \"rotd50\"\n[records.select]\nmagnitude = \"6:7\"\n[hazard]\n\
         component = \"RotD50\"\n",
    ));
    std::fs::copy(folder.path().join("set.csv"), study.path().join("moved.csv")).unwrap();
    let text = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("study.toml", &text.replace("set.csv", folder.path().join("set.csv").to_str().unwrap()));
    let done = study.uplift(&["run", "study.toml"]).ok();
    assert!(done.stderr.contains("1 recorded pair (set.csv, magnitude 6:7)"), "{}\n{}", done.stdout, done.stderr);
    let warnings = study.uplift(&["warnings", "results/study.h5"]).ok().stdout;
    assert!(warnings.contains("1 of 2 records have no magnitude in the manifest"), "{warnings}");
    // a manifest that was moved does not find its files, and says so
    let moved = study.path().join("moved.csv");
    study
        .uplift(&["check", "study.toml", "--set", &format!("records.manifest={}", moved.display())])
        .fails(4, &["moved.csv", "file_h1", "is missing"]);
    // nor is a file that has changed taken for the one imported
    let path = folder.path().join("RSN12_EVENT_STA090.AT2");
    std::fs::write(&path, at2("Some Event, 1/2/1999, A Station, 90", G, 0.01, &wave(3000, 0.031))).unwrap();
    study.uplift(&["run", "study.toml"]).fails(4, &["RSN12_EVENT_STA", "STA090.AT2", "SHA-256", "import"]);
}

#[test]
fn synthetic_records_are_made_listed_shown_and_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let made = ["records", "synthesize", "-o", "set", "--count", "6", "--seed", "3", "--magnitude", "6.5:7.5"];
    let done = uplift(at, &made).ok();
    assert!(done.stdout.contains("6 synthetic pairs") && done.stderr.contains("not for design"), "{}", done.stderr);
    uplift(at, &made).fails(2, &["manifest.csv already exists"]);
    let help = uplift(at, &["records", "synthesize", "-h"]).ok().stdout;
    let words: Vec<&str> = help.split_whitespace().collect();
    assert!(words.join(" ").contains("(never an input) and remove the records of a replaced set"), "{help}");
    uplift(at, &["records", "synthesize", "-o", "x", "--magnitude", "5"]).fails(2, &["magnitude is 5", "6 to 8"]);
    uplift(at, &["records", "synthesize", "-o", "x", "--count", "-3"]).fails(2, &["-3", "a whole number of pairs"]);
    uplift(at, &["records", "synthesize", "-o", "x", "--vs30", "500:"]).fails(2, &["both ends"]);
    assert!(!at.join("x").exists());

    // what is synthetic stays so, whichever way it comes back
    uplift(at, &["records", "import", "set", "-o", "imported.csv"]).ok();
    uplift(at, &["records", "import", "set", "-o", "imported.csv"]).fails(2, &["imported.csv already exists"]);
    let study = SmallStudy::new();
    for manifest in ["set/manifest.csv", "imported.csv"] {
        let set = format!("records.manifest={}", at.join(manifest).display());
        let done = study.uplift(&["run", "study.toml", "--force", "--set", &set]).ok();
        assert!(
            done.stderr.contains("synthetic pairs") && done.stdout.contains("Synthetic records: not for design"),
            "{}",
            done.stdout
        );
    }

    let listed = uplift(at, &["records", "list", "set/manifest.csv"]).ok().stdout;
    assert!(listed.contains("SYN006") && listed.contains("6 of 6 records"), "{listed}");
    let shown = uplift(at, &["records", "show", "set/manifest.csv", "SYN001"]).ok().stdout;
    assert!(shown.contains("SYN001_H1.AT2") && shown.contains("rotd100"), "{shown}");
    let shown = uplift(at, &["records", "show", "set/SYN001_H1.AT2"]).ok().stdout;
    assert!(shown.contains("at2 format, 1 component") && shown.contains("PGD"), "{shown}");
    uplift(at, &["records", "show", "set/manifest.csv", "SYN01"]).fails(4, &["did you mean `SYN001`?", "records list"]);

    let rows_of = |name: &str| rows(&at.join(name));
    let magnitudes = |rows: &[BTreeMap<String, String>]| -> Vec<f64> {
        rows.iter().map(|row| row["magnitude"].parse().unwrap()).collect()
    };
    let all = magnitudes(&rows_of("set/manifest.csv"));
    let middle = all.iter().sum::<f64>() / 6.0;
    let above = format!("{middle}:");
    let chosen = uplift(at, &["records", "select", "set/manifest.csv", "--magnitude", &above, "-o", "some.csv"]).ok();
    assert!(chosen.stdout.contains("[records.select]\nmagnitude = "), "{}", chosen.stdout);
    let some = magnitudes(&rows_of("some.csv"));
    assert_eq!(some, all.iter().copied().filter(|m| *m >= middle).collect::<Vec<_>>());
    assert!(!some.is_empty() && some.len() < 6);
    // the manifest of another folder finds the files all the same
    uplift(at, &["records", "list", "some.csv", "--pulse-like", "false"]).ok();
    let set = ["records", "select", "set/manifest.csv"];
    uplift(at, &[&set[..], &["--magnitude", "9:"]].concat()).fails(4, &["none of 6 records", "magnitude 9:"]);
    uplift(at, &[&set[..], &["--magnitude", "7:6"]].concat()).fails(2, &["6.5:7.5"]);
    uplift(at, &set).fails(2, &["say which records"]);
    uplift(at, &[&set[..], &["--magnitude", "6:", "-o", "set/manifest.csv"]].concat()).fails(2, &["overwrite"]);
}

#[test]
fn what_is_no_folder_of_records() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    uplift(at, &["records", "import", "absent", "-o", "a.csv"]).fails(4, &["absent: there is no such folder or file"]);
    uplift(at, &["records", "import", ".", "-o", "a.csv"]).fails(4, &["holds no files"]);
    std::fs::write(at.join("a.txt"), "1\n2\n3\n").unwrap();
    std::fs::write(at.join("b.bin"), [0_u8, 159, 146, 150]).unwrap();
    uplift(at, &["records", "import", ".", "-o", "a.csv"]).fails(4, &["no pair", "a.txt", "b.bin"]);
    uplift(at, &["records", "import", ".", "-o", "a.txt"]).fails(2, &[".csv"]);
    uplift(at, &["records", "import", ".", "-o", "no/such/a.csv"]).fails(4, &["no/such"]);
    uplift(at, &["records", "list", "absent.csv"]).fails(4, &["absent.csv"]);
    uplift(at, &["records", "show", "b.bin"]).fails(4, &["b.bin"]);
    assert!(!at.join("a.csv").exists());
}

// PGA and PGV of the manifest of the real records were computed independently; it prints five digits.
#[test]
#[ignore = "long: make test-long"]
fn real_records_measure_what_their_manifest_says() {
    let Some(records) = real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("set.csv");
    let done = uplift(folder.path(), &["records", "import", records.to_str().unwrap(), "-o", output.to_str().unwrap()]);
    let done = done.ok();
    assert!(done.stdout.contains("138 pairs") && !done.stderr.contains("mistake?"), "{}", done.stderr);
    let file = |row: &BTreeMap<String, String>, column: &str| {
        Path::new(&row[column]).file_name().unwrap().to_string_lossy().into_owned()
    };
    let known: BTreeMap<String, BTreeMap<String, String>> =
        rows(&records.join("manifest.csv")).into_iter().map(|row| (file(&row, "file_h1"), row)).collect();
    let imported = rows(&output);
    assert_eq!(imported.len(), 138);
    for row in &imported {
        // h1 and h2 may be named the other way round
        let golden = known.get(&file(row, "file_h1")).or_else(|| known.get(&file(row, "file_h2"))).unwrap();
        for (ours, theirs) in [("pga_g", "geomean_pga_g"), ("pgv_cm_s", "geomean_pgv_cms")] {
            let number = |text: &str| text.parse::<f64>().unwrap();
            let (found, expected) = (number(&row[ours]), number(&golden[theirs]));
            assert!(
                (found - expected).abs() <= 6e-6 * expected.max(1.0) + 5e-4 * expected,
                "{}: {ours} {found} {expected}",
                row["record_id"]
            );
        }
    }
}

#[test]
fn real_files_of_other_formats_are_paired() {
    let formats = std::env::var_os("UPLIFT_FORMATS")
        .map_or_else(|| repository().join("../shared/formats"), std::path::PathBuf::from);
    if !formats.is_dir() {
        println!("skipped: no files of other formats (set UPLIFT_FORMATS)");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("set.csv");
    let done =
        uplift(folder.path(), &["records", "import", formats.to_str().unwrap(), "-o", output.to_str().unwrap()]).ok();
    let rows = rows(&output);
    let formats: Vec<&str> = rows.iter().map(|row| row["format"].as_str()).collect();
    for format in ["esm", "knet", "csmip"] {
        assert!(formats.contains(&format), "{format}: {}", done.stderr);
    }
    // two files of single components of other stations have no partner
    assert!(!done.stderr.contains("not read"), "{}", done.stderr);
}
