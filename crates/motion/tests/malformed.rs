//! Damaged and hostile files of every layout: refused, or read as what they still are, in time and memory that are in
//! proportion to them.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "../../hazard/tests/cost.rs"]
mod cost;

use std::io::Write;
use std::time::Instant;

use flate2::{Compression, write::GzEncoder};
use proptest::prelude::*;
use uplift_motion::{
    AccelerationUnit, MotionError, ReadOptions, RecordFile, RecordFormat, read_auto, read_record, read_record_file,
};

use cost::{bombs, costs_little};

/// A good file of every layout and dialect; each component has six values, the last of which is -6 or as here.
const SAMPLES: [(RecordFormat, &[u8], &str); 10] = [
    (RecordFormat::At2, include_bytes!("samples/sample-at2.txt"), "-.6000000E-02"),
    (RecordFormat::At2, include_bytes!("samples/old-at2.txt"), "0.60000000"),
    (RecordFormat::Esm, include_bytes!("samples/sample.esm"), "-6.000000"),
    (RecordFormat::Knet, include_bytes!("samples/sample.knet"), "-2"),
    (RecordFormat::Cosmos, include_bytes!("samples/sample.cosmos"), "-6.0000"),
    (RecordFormat::Cosmos, include_bytes!("samples/counts.cosmos"), "-6000"),
    (RecordFormat::Csmip, include_bytes!("samples/sample.csmip"), "-6.000000"),
    (RecordFormat::Csmip, include_bytes!("samples/film.csmip"), "-.600"),
    (RecordFormat::Columns, include_bytes!("samples/sample.columns"), "-6.0"),
    (RecordFormat::Columns, include_bytes!("samples/two.columns"), "-6.0"),
];

/// As the file shows by itself, and as each layout, with what a file may leave out.
fn all_options() -> impl Iterator<Item = ReadOptions> {
    let (dt_s, unit) = (Some(0.01), Some(AccelerationUnit::G));
    let formats = std::iter::once(None).chain(RecordFormat::ALL.into_iter().map(Some));
    formats.map(move |format| ReadOptions { format, dt_s, unit, ..ReadOptions::default() })
}

/// What is read is a valid accelerogram no longer than its text; an error has a message of moderate length that names
/// the file.
fn check(result: &Result<RecordFile, MotionError>, bytes: usize) {
    match result {
        Ok(file) => {
            assert!(file.recordings.iter().map(|recording| recording.accelerogram.len()).sum::<usize>() <= bytes);
            for recording in &file.recordings {
                assert!(recording.accelerogram.dt_s() > 0.0);
                assert!(recording.accelerogram.acceleration_m_s2().iter().all(|a| a.is_finite()));
            }
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("the file") && message.len() < 1000, "{message}");
        }
    }
}

fn read(bytes: &[u8]) -> Result<RecordFile, MotionError> {
    let result = read_record(bytes, "the file", &ReadOptions::default());
    check(&result, bytes.len().max(1 << 10));
    result
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn samples_are_read_in_every_dress() {
    for (format, bytes, _) in SAMPLES {
        let file = read(bytes).unwrap();
        assert_eq!(file.format, format);
        assert!(
            file.recordings.iter().all(|recording| recording.accelerogram.len() == 6 || format == RecordFormat::Knet)
        );
        let dos = String::from_utf8(bytes.to_vec()).unwrap().replace('\n', "\r\n");
        let half = bytes.len() / 2;
        for dress in [
            packed(bytes),
            // A packed file may have members.
            [packed(&bytes[..half]), packed(&bytes[half..])].concat(),
            format!("\u{feff}{dos}").into_bytes(),
            packed(format!("\u{feff}{dos}\u{1a}").as_bytes()),
        ] {
            assert_eq!(read(&dress).unwrap(), file, "{format}");
        }
    }
}

#[test]
fn every_cut_and_every_flipped_bit_gives_an_answer() {
    std::thread::scope(|scope| {
        for (format, bytes, last) in SAMPLES {
            scope.spawn(move || damaged_gives_an_answer(format, bytes, last));
        }
    });
}

fn damaged_gives_an_answer(format: RecordFormat, bytes: &[u8], last: &str) {
    let text = std::str::from_utf8(bytes).unwrap();
    // Where the last value of the first component begins: from there on a cut may only shorten it.
    let first = text.find("End").or(text.find("END")).or(text.find("veloc")).unwrap_or(text.len());
    let last_value = text[..first].rfind(last).unwrap();
    for cut in 0..bytes.len() {
        for options in all_options() {
            check(&read_record(&bytes[..cut], "the file", &options), cut);
        }
        // Columns do not say how many values they have.
        if cut <= last_value && format != RecordFormat::Columns {
            assert!(read(&bytes[..cut]).is_err(), "{format} cut at {cut}");
            let options = ReadOptions { format: Some(format), ..ReadOptions::default() };
            assert!(read_record(&bytes[..cut], "x", &options).is_err(), "{format} cut at {cut}");
        }
    }
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut damaged = bytes.to_vec();
            damaged[at] ^= 1 << bit;
            let _ = read(&damaged);
            let options = ReadOptions { format: Some(format), ..ReadOptions::default() };
            check(&read_record(&damaged, "the file", &options), bytes.len());
        }
    }
}

proptest! {
    /// A sample with bytes changed, put in and taken out; any bytes and any text by themselves, and within a sample.
    #[test]
    fn any_bytes_give_an_answer(
        (_, sample, _) in prop::sample::select(SAMPLES.to_vec()),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3_u8), 1..8),
        bytes in prop::collection::vec(any::<u8>(), 0..400),
        text in "[-+0-9.eEdD,;()=|< \\t\\n%#a-zA-Zé]{0,200}",
        at in any::<prop::sample::Index>(),
    ) {
        let mut changed = sample.to_vec();
        for (index, byte, change) in changes {
            let at = index.index(changed.len());
            match change {
                0 => changed[at] = byte,
                1 => changed.insert(at, byte),
                _ => { changed.remove(at); }
            }
        }
        let (begin, end) = sample.split_at(at.index(sample.len()));
        let [one, other] = [&bytes[..], text.as_bytes()].map(|middle| [begin, middle, end].concat());
        for damaged in [&changed[..], &bytes, text.as_bytes(), &one, &other] {
            for options in all_options() {
                check(&read_record(damaged, "the file", &options), damaged.len());
            }
        }
    }
}

#[test]
fn long_nonsense_is_answered_briefly_and_soon() {
    let pieces = "1-123|1.-123|1,|-|x|0.1 |1e5.|.|units |acc |dt = |time step |KEY: value\n|Memo\n|acc units\n|é";
    for piece in pieces.split('|') {
        let nonsense = piece.repeat(500_000 / piece.len()).into_bytes();
        for options in all_options() {
            check(&read_record(&nonsense, "the file", &options), nonsense.len());
        }
        for (_, sample, _) in SAMPLES {
            let _ = (read(&[&nonsense[..], sample].concat()), read(&[sample, &nonsense].concat()));
        }
    }
}

#[test]
fn tokens_that_are_no_values_are_refused() {
    for (format, bytes, last) in SAMPLES {
        let text = std::str::from_utf8(bytes).unwrap();
        let at = text.rfind(last).unwrap();
        for token in ["NaN", "-inf", "1e400", "****", "0x1F", "-6,0", "1_0", "\u{0}", "\u{1b}[1m", "é", "--6.0", "6.0."]
        {
            let damaged = format!("{}{token:>width$}{}", &text[..at], &text[at + last.len()..], width = last.len());
            let options = ReadOptions { format: Some(format), ..ReadOptions::default() };
            let error = read_record(damaged.as_bytes(), "x", &options).unwrap_err();
            assert!(
                matches!(error, MotionError::Number { .. } | MotionError::ColumnCount { .. }),
                "{format}, {token}: {error}"
            );
        }
    }
}

/// No memory for what is only declared.
#[test]
fn huge_counts_are_refused() {
    for (format, from, to) in [
        (RecordFormat::At2, "NPTS=      6", "NPTS= 18446744073709551615"),
        (RecordFormat::Esm, "NDATA: 6", "NDATA: 18446744073709551615"),
        (RecordFormat::Knet, "Duration Time(s)  1", "Duration Time(s)  1e300"),
        (RecordFormat::Cosmos, "   6 acceleration pts", "   99999999999999999999 acceleration pts"),
        (RecordFormat::Csmip, "     6 points of accel", "     99999999999999999999 points of accel"),
        (RecordFormat::Csmip, "NO. OF POINTS =  6", "NO. OF POINTS =  99999999999999999999"),
    ] {
        let sample = SAMPLES.into_iter().map(|(_, bytes, _)| std::str::from_utf8(bytes).unwrap());
        let text = sample.into_iter().find(|text| text.contains(from)).unwrap().replace(from, to);
        let error = read(text.as_bytes()).unwrap_err();
        assert!(matches!(error, MotionError::PointCount { declared: u64::MAX, .. }), "{format}: {error}");
    }
}

#[test]
fn other_files_are_refused() {
    let utf16: Vec<u8> = "\u{feff}NPTS= 2, DT= .01\n1 2\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let noise: Vec<u8> = (0..20_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    for bytes in
        [&utf16[..], &noise, b"", b"\n\n", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", b"PK\x03\x04", &[0; 5000], &[b'('; 5000]]
    {
        for options in all_options() {
            let result = read_record(bytes, "the file", &options);
            check(&result, bytes.len());
            assert!(result.is_err(), "{:?} of {:?}", options.format, &bytes[..bytes.len().min(10)]);
        }
    }
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let error = read_record_file(folder, &ReadOptions::default()).unwrap_err();
    assert!(matches!(error, MotionError::Unreadable { .. }), "{error}");
}

#[test]
fn packed_files_that_are_damaged_are_refused() {
    for (format, bytes, _) in SAMPLES {
        let whole = packed(bytes);
        for cut in 2..whole.len() {
            let error = read(&whole[..cut]).unwrap_err();
            assert!(matches!(error, MotionError::Compressed { .. }), "{format} cut at {cut}: {error}");
        }
        for at in 10..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 0x55;
            // The checksum finds what the format does not.
            let error = read(&damaged).unwrap_err();
            assert!(
                matches!(error, MotionError::Compressed { .. } | MotionError::TooLarge { .. }),
                "{format}: {error}"
            );
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
    for bomb in bombs(b"\0 1") {
        for options in all_options() {
            let error = read_record(&bomb, "the file", &options).unwrap_err();
            assert!(matches!(error, MotionError::TooLarge { .. }), "{error}");
        }
    }
}

fn read_costly_texts() {
    let sample = |format| std::str::from_utf8(SAMPLES.iter().find(|(f, ..)| *f == format).unwrap().1).unwrap();
    let commas = ",".repeat(8 << 20);
    let changed = |format, from: &str, to: &str| (format, sample(format).replace(from, to));
    for (format, text) in [
        changed(RecordFormat::At2, "Nowhere", &",".repeat(24 << 20)),
        changed(RecordFormat::Esm, "NETWORK", &"NETWORK: A\n".repeat(500_000)),
        changed(RecordFormat::Esm, "Town", &commas),
        changed(RecordFormat::Knet, "ABC001", &commas),
        changed(RecordFormat::Cosmos, "-999, -777.0", &format!("{commas}-777.0")),
        changed(RecordFormat::Csmip, "MW=5.5", &"MW=M".repeat(2 << 20)),
        changed(RecordFormat::Columns, "Station", &"acc units ".repeat(1 << 20)),
        // One of many components is not chosen, and not all of them are named.
        (RecordFormat::Cosmos, sample(RecordFormat::Cosmos).repeat(2_000)),
        (RecordFormat::Csmip, sample(RecordFormat::Csmip).repeat(2_000)),
    ] {
        for format in [None, Some(format)] {
            let start = Instant::now();
            let options = ReadOptions { format, ..ReadOptions::default() };
            let result = read_auto(text.as_bytes(), "the file", &options);
            if let Err(error) = result {
                assert!(error.to_string().len() < 1000, "{format:?}: {} bytes of message", error.to_string().len());
            }
            println!("{format:?}: {} bytes, {:?}", text.len(), start.elapsed());
        }
    }
}
