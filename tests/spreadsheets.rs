//! Tables as spreadsheets of every country save them: decimal commas between semicolons, byte order marks, CRLF and
//! UTF-16.

use crate::common::{SMALL_STUDY, SmallStudy};

const FROM_MANIFEST: &str = "[records]\nmanifest = \"manifest.csv\"\n";

fn utf_16(text: &str) -> Vec<u8> {
    format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect()
}

/// The spectra of the small study, with the curve of its first site saved another way.
fn spectra(curve: &[u8]) -> String {
    let study = SmallStudy::new();
    study.write_bytes("here-pgv.csv", curve);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let text = std::fs::read_to_string(study.path().join("r.urs.csv")).unwrap();
    text.lines().skip(1).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_curve_is_the_same_however_it_is_saved() {
    let plain = "iml,maf\n0.5,0.8\n2.5,0.05\n20,0.0005\n300,2.5e-6\n";
    let european = plain.replace(',', ";").replace('.', ",");
    let expected = spectra(plain.as_bytes());
    for text in [
        european.clone(),
        european.replace('\n', "\r\n"),
        format!("\u{feff}{european}"),
        european.replace(';', "\t"),
        european.replace("iml;maf\n", "\"iml\";\"maf\"\n"),
    ] {
        assert!(spectra(text.as_bytes()) == expected, "{text}");
    }
}

#[test]
fn a_curve_that_can_be_read_in_two_ways_is_refused() {
    let study = SmallStudy::new();
    for (curve, words) in [
        (
            b"iml;maf\n0,5;0,8\n2.5;0,05\n300;1e-6\n".as_slice(),
            &["line 2", "0,5 has a decimal comma", "2.5 (line 3)"][..],
        ),
        (b"iml;maf\n1;1,500\n300;1,250\n", &["line 2: 1,500 may be 1.500 or 1500"]),
        (b"iml,maf\n0,5,0,8\n300,0,1\n", &["line 2", "decimal commas", "semicolons between the columns"]),
        (&utf_16("iml;maf\n0,5;0,8\n"), &["UTF-16", "CSV UTF-8"]),
    ] {
        study.write_bytes("here-pgv.csv", curve);
        study.uplift(&["check", "study.toml"]).fails(4, &[&["here-pgv.csv"], words].concat());
    }
}

#[test]
fn a_manifest_with_decimal_commas() {
    let records = "[records]\nfirst = 4\n[records.synthetic]\npairs = 4\n";
    let study = SmallStudy::with(&SMALL_STUDY.replace(records, FROM_MANIFEST));
    study.uplift(&["records", "synthesize", "-o", "set", "--count", "4", "-q"]).ok();
    let manifest = |rows: [&str; 2]| {
        format!(
            "\u{feff}record_id;file_h1;file_h2;magnitude;rrup_km;set_tags\r\n{}\r\n{}\r\n",
            format_args!("A;set/SYN001_H1.AT2;set/SYN001_H2.AT2;{}", rows[0]),
            format_args!("B;set/SYN002_H1.AT2;set/SYN002_H2.AT2;{}", rows[1])
        )
    };
    study.write("manifest.csv", &manifest(["6,5;12,25;1,5", "7;-999;2,5"]));
    study.uplift(&["check", "study.toml"]).ok();
    let listed = study.uplift(&["records", "list", "manifest.csv", "--magnitude", "6.4:6.6"]).ok();
    assert!(listed.stdout.contains("1 of 2 records") && listed.stdout.contains("6.5"), "{}", listed.stdout);
    // what is chosen is written with points, and tags stay as they are
    study.uplift(&["records", "select", "manifest.csv", "--magnitude", "6.4:6.6", "-o", "chosen.csv"]).ok();
    let chosen = std::fs::read_to_string(study.path().join("chosen.csv")).unwrap();
    assert!(chosen.contains(",6.5,12.25,\"1,5\""), "{chosen}");
    for (rows, words) in [
        (["6,5;12.25;", "7;10;"], &["row 1 below the header, magnitude", "6,5 has a decimal comma", "12.25"][..]),
        (["6;1,250;", "7;1,500;"], &["row 1 below the header, rrup_km", "1,250 may be 1.250 or 1250"]),
    ] {
        study.write("manifest.csv", &manifest(rows));
        study.uplift(&["check", "study.toml"]).fails(4, &[&["manifest.csv"], words].concat());
    }
    study.write_bytes("manifest.csv", &utf_16("record_id;file_h1;file_h2\nA;a;b\n"));
    study.uplift(&["check", "study.toml"]).fails(4, &["manifest.csv", "UTF-16"]);
}
