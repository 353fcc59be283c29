//! Files of ESM, K-NET and KiK-net: real ones against what their heads state, written ones read back, cut ones
//! refused.
//!
//! The real files may not be redistributed: the test looks for them beside the repository, and is skipped
//! where they are absent.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::fmt::Write as _;
use std::path::PathBuf;

use proptest::prelude::*;
use uplift_motion::{
    AccelerationUnit, Orientation, ReadOptions, RecordFile, RecordFormat, Recording, read_auto, read_record,
    read_record_file,
};

fn formats_folder() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let shared =
        std::env::var_os("UPLIFT_RECORDS").and_then(|records| PathBuf::from(records).parent().map(PathBuf::from));
    let folder = shared.unwrap_or_else(|| beside.into()).join("formats");
    folder.is_dir().then_some(folder)
}

/// Every file of a folder of real files, in the order of their names.
fn real_files(folder: &str) -> Vec<(PathBuf, Recording)> {
    let Some(formats) = formats_folder() else {
        println!("skipped: no folder of real files (formats beside that of UPLIFT_RECORDS)");
        return Vec::new();
    };
    let mut paths: Vec<_> =
        std::fs::read_dir(formats.join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(!paths.is_empty());
    let options = ReadOptions::default();
    let read = |path: PathBuf| {
        let RecordFile { format, mut recordings } = read_record_file(&path, &options).unwrap();
        assert_eq!(format, if folder == "esm" { RecordFormat::Esm } else { RecordFormat::Knet });
        assert_eq!(recordings.len(), 1);
        (path, recordings.remove(0))
    };
    paths.into_iter().map(read).collect()
}

/// The value of a head line, read with nothing of the reader under test.
fn stated(path: &std::path::Path, key: &str) -> f64 {
    let text = std::fs::read_to_string(path).unwrap();
    let line = text.lines().find(|line| line.starts_with(key)).unwrap();
    line[key.len()..].trim().trim_end_matches("Hz").parse().unwrap()
}

#[test]
fn real_esm_files_meet_their_heads() {
    let files = real_files("esm");
    for (path, Recording { accelerogram, description, .. }) in &files {
        assert_eq!(accelerogram.len() as f64, stated(path, "NDATA:"));
        assert_eq!(accelerogram.dt_s(), stated(path, "SAMPLING_INTERVAL_S:"));
        // Both are printed with six decimals.
        let pga_cm_s2 = stated(path, "PGA_CM/S^2:").abs();
        let deviation = (100.0 * accelerogram.pga_m_s2() - pga_cm_s2).abs();
        println!("{}: PGA {pga_cm_s2} cm/s2, deviates by {deviation:.1e}", path.display());
        assert!(deviation < 1e-9);
        assert!((100.0 * description.stated_pga_m_s2.unwrap() - pga_cm_s2).abs() < 1e-9);
        let at_s = stated(path, "TIME_PGA_S:");
        let values = accelerogram.acceleration_m_s2();
        let peak = values.iter().position(|a| (a.abs() - accelerogram.pga_m_s2()).abs() < 1e-12).unwrap();
        assert!((peak as f64 * accelerogram.dt_s() - at_s).abs() < 1e-9, "{}", path.display());
    }
    // The two horizontal components of one station.
    let [(_, east), (_, north)] = files.as_slice() else { return };
    assert_eq!(east.description.orientation, Some(Orientation::Azimuth(90.0)));
    assert_eq!(north.description.orientation, Some(Orientation::Azimuth(0.0)));
    for description in [&east.description, &north.description] {
        assert_eq!(description.station.as_deref(), Some("HI.ARS1"));
        assert_eq!(description.event_time.as_deref(), Some("20190728_160908"));
        assert_eq!(description.magnitude, Some(4.6));
        assert_eq!(description.epicentral_distance_km, Some(88.1));
        assert_eq!(description.low_cut_hz, Some(0.1));
        assert_eq!((description.vs30_m_s, description.sensor.as_deref()), (None, None));
        // 28 July 2019, 16:09:19.870
        assert_eq!(description.start_time_s, Some(1_564_330_159.87));
        assert!(!description.unprocessed);
    }
}

#[test]
fn real_knet_and_kiknet_files_meet_their_heads() {
    for folder in ["knet", "kiknet"] {
        for (path, Recording { accelerogram, description, .. }) in real_files(folder) {
            let frequency_hz = stated(&path, "Sampling Freq(Hz)");
            assert_eq!(accelerogram.dt_s(), 1.0 / frequency_hz);
            assert_eq!(accelerogram.len() as f64, stated(&path, "Duration Time(s)") * frequency_hz);
            // Printed with three decimals.
            let pga_gal = stated(&path, "Max. Acc. (gal)");
            let deviation = (100.0 * accelerogram.pga_m_s2() - pga_gal).abs();
            println!("{}: PGA {pga_gal} gal, deviates by {deviation:.1e}", path.display());
            assert!(deviation <= 0.5e-3 + 1e-9);
            assert!((100.0 * description.stated_pga_m_s2.unwrap() - pga_gal).abs() < 1e-9);
            let mean = accelerogram.acceleration_m_s2().iter().sum::<f64>() / accelerogram.len() as f64;
            assert!(mean.abs() < 1e-12);

            let suffix = path.extension().unwrap().to_str().unwrap();
            assert_eq!(description.channel.as_deref(), Some(suffix));
            let azimuth = if suffix.starts_with("EW") { 90.0 } else { 0.0 };
            assert_eq!(description.orientation, Some(Orientation::Azimuth(azimuth)));
            assert!(description.unprocessed);
            let (station, sensor, start_time_s) = match folder {
                // 24 January 2018, 19:51:28, and 6 October 2000, 13:31:09: 15 s before the record time
                "knet" => ("BO.AOM001", None, 1_516_823_488.0),
                _ => ("BO.AICH04", Some("surface"), 970_839_069.0),
            };
            assert_eq!(description.station.as_deref(), Some(station));
            assert_eq!(description.sensor.as_deref(), sensor);
            assert_eq!(description.start_time_s, Some(start_time_s));
        }
    }
}

#[test]
fn real_files_cut_short_are_refused() {
    for folder in ["esm", "knet", "kiknet"] {
        for (path, _) in real_files(folder) {
            let bytes = std::fs::read(&path).unwrap();
            // Up to the last value, which a cut may only shorten.
            let end = bytes.trim_ascii_end().len() - 10;
            for cut in (0..200).map(|part| end * part / 199) {
                let result = read_record(&bytes[..cut], "cut", &ReadOptions::default());
                assert!(result.is_err(), "{} cut at {cut}", path.display());
            }
        }
    }
}

/// An ESM file of `values` in cm/s².
fn esm(values: &[f64], dt_s: f64, end: &str) -> String {
    let count = values.len();
    let mut text = format!(
        "EVENT_NAME: Nowhere{end}EVENT_DATE_YYYYMMDD: 20200102{end}EVENT_TIME_HHMMSS: 030405{end}MAGNITUDE_W: {end}\
         NETWORK: XX{end}STATION_CODE: YY{end}SAMPLING_INTERVAL_S: {dt_s}{end}NDATA: {count}{end}STREAM: HN2{end}\
         UNITS: cm/s^2{end}DATA_TYPE: ACCELERATION{end}USER5: {end}"
    );
    for value in values {
        write!(text, "{value:e}{end}").unwrap();
    }
    text
}

/// A K-NET file of `counts`, 10 a second and rows of eight, of 4 gal each.
fn knet(counts: &[i32], end: &str) -> String {
    let duration_s = counts.len() / 10;
    let mut text = format!(
        "Origin Time       2020/01/02 03:04:05{end}Mag.              5.0{end}Station Code      YYY001{end}\
         Record Time       2020/01/02 03:04:30{end}Sampling Freq(Hz) 10Hz{end}Duration Time(s)  {duration_s}{end}\
         Dir.              U-D{end}Scale Factor      4000(gal)/1000{end}Max. Acc. (gal)   0.1{end}Memo.{end}"
    );
    for row in counts.chunks(8) {
        for count in row {
            write!(text, "{count:>9}").unwrap();
        }
        text += end;
    }
    text
}

fn line_end() -> impl Strategy<Value = &'static str> {
    prop_oneof![Just("\n"), Just("\r\n")]
}

proptest! {
    #[test]
    fn written_esm_comes_back(
        values in prop::collection::vec(-1e3..1e3_f64, 2..60), dt_s in 0.001..0.1_f64, end in line_end(),
    ) {
        let options = ReadOptions { unit: Some(AccelerationUnit::G), dt_s: Some(9.0), ..ReadOptions::default() };
        let file = read_record(esm(&values, dt_s, end).as_bytes(), "x", &options).unwrap();
        prop_assert_eq!(file.format, RecordFormat::Esm);
        let motion = &file.recordings[0].accelerogram;
        let expected: Vec<f64> = values.iter().map(|value| value / 100.0).collect();
        prop_assert_eq!(motion.acceleration_m_s2(), &expected[..]);
        prop_assert_eq!(motion.dt_s(), dt_s);
        prop_assert_eq!(file.recordings[0].description.orientation, Some(Orientation::Horizontal(2)));
    }

    #[test]
    fn written_knet_comes_back(
        // within a shock table's acceleration; with the offset, over all counts of 24 bits
        counts in prop::collection::vec(-100_000..100_000_i32, 10..80), offset in -8_388_608..8_388_608_i32,
        end in line_end(),
    ) {
        let file = read_record(knet(&counts, end).as_bytes(), "x", &ReadOptions::default()).unwrap();
        prop_assert_eq!(file.format, RecordFormat::Knet);
        let motion = &file.recordings[0].accelerogram;
        let mean = counts.iter().map(|&count| i64::from(count)).sum::<i64>() as f64 / counts.len() as f64;
        for (found, &count) in motion.acceleration_m_s2().iter().zip(&counts) {
            prop_assert!((found - (f64::from(count) - mean) * 0.04).abs() < 1e-8);
        }
        prop_assert_eq!(motion.len(), counts.len());
        prop_assert_eq!(motion.dt_s(), 0.1);
        // An offset of all counts makes no difference.
        let shifted: Vec<i32> = counts.iter().map(|count| count + offset).collect();
        let shifted = read_auto(knet(&shifted, end).as_bytes(), "x", &ReadOptions::default()).unwrap();
        for (a, b) in shifted.acceleration_m_s2().iter().zip(motion.acceleration_m_s2()) {
            prop_assert!((a - b).abs() < 1e-7);
        }
    }

    #[test]
    fn written_columns_come_back(
        values in prop::collection::vec(-1e3..1e3_f64, 2..60), dt_s in 0.001..0.1_f64, end in line_end(),
        head in 0..3_usize,
    ) {
        let head = [
            format!("# dt = {dt_s} s, units: cm/s^2{end}"),
            format!("Station 12 of Nowhere{end}time step: {dt_s}{end}acceleration [gal]{end}"),
            format!("% sampling interval (s): {dt_s}{end}%{end}% acceleration in cm/sec2{end}"),
        ][head].clone();
        let mut text = head;
        for value in &values {
            write!(text, "{value:e}{end}").unwrap();
        }
        let options = ReadOptions { unit: Some(AccelerationUnit::G), dt_s: Some(9.0), ..ReadOptions::default() };
        let motion = read_auto(text.as_bytes(), "x", &options).unwrap();
        let expected: Vec<f64> = values.iter().map(|value| value / 100.0).collect();
        prop_assert_eq!(motion.acceleration_m_s2(), &expected[..]);
        prop_assert_eq!(motion.dt_s(), dt_s);
    }
}
