//! Damaged and hostile files of every format: refused, or read as what they still are, in time and memory that are in
//! proportion to them.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod cost;

use std::io::{Cursor, Write};
use std::path::Path;
use std::time::Instant;

use flate2::{Compression, write::GzEncoder};
use uplift_hazard::{
    CsvOptions, ExportedCurves, HazardCurve, HazardError, SiteSelection, read_csv, read_export, read_path,
    read_realization_weights,
};

use cost::{bombs, costs_little};

/// What a file can be read as.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Reader {
    Table,
    Export,
    Realizations,
}

/// A good file of every format and dialect, and the number of curves or weights in it.
const SAMPLES: [(Reader, &[u8], usize); 8] = [
    (Reader::Table, include_bytes!("samples/rates.csv"), 1),
    (Reader::Table, include_bytes!("samples/probabilities.csv"), 1),
    (Reader::Export, include_bytes!("samples/openquake.csv"), 2),
    (Reader::Export, include_bytes!("samples/curves.xml"), 3),
    (Reader::Export, include_bytes!("samples/fields.xml"), 3),
    (Reader::Export, include_bytes!("samples/service.json"), 1),
    (Reader::Export, include_bytes!("samples/precomputed.json"), 2),
    (Reader::Realizations, include_bytes!("samples/realizations.csv"), 3),
];

fn options() -> CsvOptions {
    CsvOptions { years: Some(50.0), ..CsvOptions::new("PGV", "cm/s") }
}

fn check(curve: &HazardCurve) {
    assert!(curve.im().windows(2).all(|pair| pair[0] < pair[1]));
    assert!(curve.maf().windows(2).all(|pair| pair[0] > pair[1]));
}

/// The number of curves or weights; where sites of a file differ, of those that are good.
fn read_file(reader: Reader, path: &Path) -> Result<usize, HazardError> {
    match reader {
        Reader::Table => read_path(path, &options()).map(|read| check(&read.curve)).map(|()| 1),
        Reader::Export => count(ExportedCurves::open(path)?),
        Reader::Realizations => read_realization_weights(path).map(|weights| weights.len()),
    }
}

/// The same without a file where the reader can do without.
fn read(reader: Reader, bytes: &[u8]) -> Result<usize, HazardError> {
    match (reader, std::str::from_utf8(bytes)) {
        (Reader::Table, Ok(text)) => read_csv(text, "sample", &options()).map(|read| check(&read.curve)).map(|()| 1),
        (Reader::Export, _) => count(ExportedCurves::from_reader(Cursor::new(bytes.to_vec()), "sample")?),
        _ => {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("sample");
            std::fs::write(&path, bytes).unwrap();
            read_file(reader, &path)
        }
    }
}

/// The good curves; an error where there are none.
fn count(curves: ExportedCurves) -> Result<usize, HazardError> {
    let (mut good, mut last) = (0, None);
    for curve in curves {
        match curve {
            Ok(curve) => {
                check(&curve.curve);
                good += 1;
            }
            Err(error) => last = Some(error),
        }
    }
    last.filter(|_| good == 0).map_or(Ok(good), Err)
}

/// An error with a message of moderate length that names the file.
fn refused(reader: Reader, bytes: &[u8]) -> String {
    let message = read(reader, bytes).unwrap_err().to_string();
    assert!(message.contains("sample") && message.len() < 1200, "{message}");
    assert!(!message.chars().any(char::is_control), "{message:?}");
    message
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn samples_are_read_in_every_dress() {
    for (reader, bytes, expected) in SAMPLES {
        let dos = String::from_utf8(bytes.to_vec()).unwrap().replace('\n', "\r\n");
        for dress in [bytes.to_vec(), packed(bytes), format!("\u{feff}{dos}").into_bytes(), packed(dos.as_bytes())] {
            let found =
                if reader == Reader::Table && dress.starts_with(b"\x1f") { Ok(1) } else { read(reader, &dress) };
            assert_eq!(found, Ok(expected), "{reader:?}");
        }
    }
}

#[test]
fn every_cut_and_every_flipped_bit_gives_an_answer() {
    std::thread::scope(|scope| {
        for (index, (reader, bytes, _)) in SAMPLES.into_iter().enumerate() {
            scope.spawn(move || damaged_gives_an_answer(index, reader, bytes));
        }
    });
}

fn damaged_gives_an_answer(index: usize, reader: Reader, bytes: &[u8]) {
    let answers = |bytes: &[u8]| read(reader, bytes).map_err(|_| refused(reader, bytes)).is_ok();
    let end = bytes.trim_ascii_end().len();
    for cut in 0..end {
        // Rows of a CSV stand each for themselves; XML, JSON and weights are whole or nothing.
        assert!(!answers(&bytes[..cut]) || index < 3 || cut + 4 > end, "{index} cut at {cut}");
    }
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut damaged = bytes.to_vec();
            damaged[at] ^= 1 << bit;
            answers(&damaged);
        }
    }
}

#[test]
fn values_that_are_no_numbers_are_refused() {
    for (reader, bytes, count) in SAMPLES {
        let text = std::str::from_utf8(bytes).unwrap();
        let value = ["2.0E-02", "0.02", "2.5E-01"].into_iter().find(|value| text.contains(value)).unwrap();
        for token in ["NaN", "-inf", "1e400", "1,5", "0x1F", "1_0", "****", "\u{0}", "\u{1b}[1m", "½", "-0.1", ""] {
            let damaged = text.replacen(value, token, 1);
            match read(reader, damaged.as_bytes()) {
                // The other sites of the file are as they were.
                Ok(found) => assert!(found < count, "{token} in {text}"),
                Err(_) => _ = refused(reader, damaged.as_bytes()),
            }
        }
    }
}

#[test]
fn other_files_are_refused() {
    let utf16: Vec<u8> = "\u{feff}iml,maf\n1,0.2\n2,0.1\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let noise: Vec<u8> = (0..20_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    for (reader, _, _) in SAMPLES {
        for bytes in [
            &utf16[..],
            &noise,
            b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
            b"PK\x03\x04",
            b"\x1f\x8b",
            b"\x1f\x8b\x08",
            &[0; 5000],
        ] {
            refused(reader, bytes);
        }
        for (other, bytes, _) in SAMPLES {
            if other != reader {
                refused(reader, bytes);
            }
        }
    }
    let folder = tempfile::tempdir().unwrap();
    for reader in [Reader::Table, Reader::Export, Reader::Realizations] {
        let message = read_file(reader, folder.path()).unwrap_err().to_string();
        assert!(message.contains("not a file"), "{message}");
    }
}

#[test]
fn packed_files_that_are_cut_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sample.gz");
    for (reader, bytes, expected) in SAMPLES {
        let whole = packed(bytes);
        std::fs::write(&path, &whole).unwrap();
        assert_eq!(read_file(reader, &path).unwrap(), expected);
        for cut in 1..whole.len() {
            std::fs::write(&path, &whole[..cut]).unwrap();
            // All rows of a CSV may be there before the end of the packed file is missed.
            let found = read_file(reader, &path);
            assert!(found.is_err() || (reader == Reader::Export && found.unwrap() <= expected), "cut at {cut}");
            if reader == Reader::Export {
                let all = read_export(&path, &SiteSelection::All);
                assert!(all.is_err(), "cut at {cut}");
            }
        }
    }
}

#[test]
fn bombs_cost_little() {
    costs_little(read_bombs);
}

#[test]
fn texts_made_to_cost_much_cost_little() {
    costs_little(read_costly_texts);
}

fn read_bombs() {
    for bomb in bombs(b"\0<{[1, \n#") {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bomb.gz");
        std::fs::write(&path, &bomb).unwrap();
        for reader in [Reader::Table, Reader::Export, Reader::Realizations] {
            let message = read_file(reader, &path).unwrap_err().to_string();
            assert!(message.contains("bomb.gz") && message.len() < 300, "{message}");
        }
    }
}

fn read_costly_texts() {
    let comment = |text: &str| format!("# {text} investigation_time=1.0, imt='PGA'\n");
    let rows = |columns: &str, values: &str| {
        let rows =
            (0..20_000).map(|i| format!("\n{:.2},{:.2},{values}", 0.1 * f64::from(i % 1000), f64::from(i / 1000)));
        format!("lon,lat,{columns}{}\n", rows.collect::<String>())
    };
    let long = "x".repeat(900_000);
    let names = format!("lon,lat,poe-1,poe-2{}{}\n1,2,.5,.1\n", ",x".repeat(250_000), ",name".repeat(100_000));
    let block = |i: u32| {
        let longitude = 1e-4 * f64::from(i);
        format!(
            r#"{{"imt":"PGA","data":[{{"longitude":{longitude:.4},"latitude":1,"xvals":[1,2],"yvals":[0.2,0.1]}}]}}"#
        )
    };
    let blocks = (0..20_000).map(block).collect::<Vec<_>>().join(",");
    let answer = |url: &str, label: &str| {
        let metadata = format!(r#"{{"ylabel":"annual {label}"}}"#);
        format!(r#"{{"url":"{url}","response":{{"metadata":{metadata},"hazardCurves":[{blocks}]}}}}"#)
    };
    let nested = |path: &str, depth: usize| {
        let open = format!(
            "<hazardCurves IMT=\"PGA\" investigationTime=\"1\" sourceModelTreePath=\"{path}\" \
             gsimTreePath=\"b\"><IMLs>1 2</IMLs><hazardCurve>"
        );
        let close = "<p><pos>1 2</pos></p><poEs>.5 .1</poEs></hazardCurve></hazardCurves>";
        format!("<nrml>{}{}</nrml>", open.repeat(depth), close.repeat(depth))
    };
    for (what, text, expected) in [
        ("a long comment kept by many curves", comment(&long) + &rows("poe-1,poe-2", ".5,.1"), Some(20_000)),
        ("many column names", comment("") + &names, None),
        ("a long address kept by many curves", answer(&long, ""), Some(20_000)),
        ("a long label looked at for many curves", answer("", &long), Some(20_000)),
        ("objects in objects", format!("[{}{{}}]", "{\"\":0},".repeat(900_000)), None),
        ("curves in curves", nested("b1", 60_000), Some(1)),
        ("a long path kept by many curves", nested(&long, 10), None),
    ] {
        let start = Instant::now();
        let found = read(Reader::Export, text.as_bytes());
        match expected {
            Some(expected) => assert_eq!(found.unwrap(), expected, "{what}"),
            None => _ = refused(Reader::Export, text.as_bytes()),
        }
        // As a list nothing is kept but the curves.
        let list = ExportedCurves::from_reader(Cursor::new(text.clone()), "x")
            .and_then(|curves| curves.select(&SiteSelection::All));
        assert_eq!(list.is_ok(), expected.is_some_and(|count| count > 1), "{what}");
        println!("{what}: {} bytes, {:?}", text.len(), start.elapsed());
    }
}
