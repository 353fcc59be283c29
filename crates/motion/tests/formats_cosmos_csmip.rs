//! Readers of COSMOS and CSMIP volumes against real files.
//!
//! The files may not be redistributed: the test looks for them beside the records where the variable
//! `UPLIFT_RECORDS` points, else beside the repository, and is skipped where they are absent.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::path::PathBuf;

use uplift_motion::{
    Orientation, ReadOptions, RecordFormat, Recording, RecordingDescription, read_path, read_record_file,
};

fn file(path: &str) -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/records");
    let records = std::env::var_os("UPLIFT_RECORDS").map_or_else(|| beside.into(), PathBuf::from);
    let file = records.join("../formats").join(path);
    if !file.is_file() {
        println!("skipped: no {path} (set UPLIFT_RECORDS)");
        return None;
    }
    Some(file)
}

fn read(path: &str, format: RecordFormat) -> Option<Vec<Recording>> {
    let record = read_record_file(&file(path)?, &ReadOptions::default()).unwrap();
    assert_eq!(record.format, format);
    Some(record.recordings)
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

#[test]
fn cosmos_volume_1() {
    let Some(recordings) = read("cosmos/Cosmos12TimeSeriesTest.v1", RecordFormat::Cosmos) else { return };
    let [Recording { accelerogram, description, .. }] = &recordings[..] else { panic!("{}", recordings.len()) };
    assert_eq!((accelerogram.len(), accelerogram.dt_s()), (7000, 0.01));
    // Stated: -161.962 cm/sec2 at 27.850 s.
    assert_near(accelerogram.acceleration_m_s2()[2785], -1.619_62, 5e-6);
    assert_near(accelerogram.pga_m_s2(), 1.619_62, 5e-6);
    assert_eq!(accelerogram.acceleration_m_s2()[..3], [-0.000_01 / 100.0, 0.000_13 / 100.0, 0.0]);
    assert_eq!(accelerogram.acceleration_m_s2()[6999], -0.000_03 / 100.0);
    let expected = RecordingDescription {
        event: Some("Somewhere in Los Angeles, CA".into()),
        event_time: Some("06/16/2005, 20:53:26.1 UTC (SCSN)".into()),
        magnitude: Some(4.8),
        epicentral_distance_km: Some(45.03),
        station: Some("CE.J2236".into()),
        station_name: Some("Yucaipa - Bryant & Oak Glen".into()),
        vs30_m_s: Some(120.0),
        sensor: Some("building location description".into()),
        channel: Some("Chan 1: 340 deg".into()),
        orientation: Some(Orientation::Azimuth(340.0)),
        low_cut_hz: Some(4.0),
        // 2005-06-16 20:53:04.4
        start_time_s: Some(1_118_955_184.4),
        stated_pga_m_s2: Some(161.962 / 100.0),
        ..RecordingDescription::default()
    };
    assert_eq!(*description, expected);
}

#[test]
fn cosmos_volume_2() {
    let name = "cosmos/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c";
    let Some(recordings) = read(name, RecordFormat::Cosmos) else { return };
    let [Recording { accelerogram, description, .. }] = &recordings[..] else { panic!("{}", recordings.len()) };
    assert_eq!((accelerogram.len(), accelerogram.dt_s()), (42_000, 0.005));
    // Stated: -6.851512 cm/sec2 at 76.215 s.
    assert_near(accelerogram.acceleration_m_s2()[15_243], -0.068_515_12, 5e-9);
    assert_near(accelerogram.pga_m_s2(), 0.068_515_12, 5e-9);
    assert_eq!(accelerogram.acceleration_m_s2()[0], 3.437_285e-4 / 100.0);
    let expected = RecordingDescription {
        event: Some("Point MacKenzie Earthquake".into()),
        event_time: Some("2018/11/30 17:29:29 UTC".into()),
        magnitude: Some(7.0),
        epicentral_distance_km: Some(290.060_822),
        station: Some("AK.BMR".into()),
        station_name: Some("Bremner River, AK, USA".into()),
        channel: Some("BNZ".into()),
        orientation: Some(Orientation::Vertical),
        low_cut_hz: Some(0.03),
        // 2018-11-30 17:29:39.13749
        start_time_s: Some(1_543_598_979.137_49),
        stated_pga_m_s2: Some(6.851_512 / 100.0),
        ..RecordingDescription::default()
    };
    assert_eq!(*description, expected);
}

#[test]
fn csmip_volume_2() {
    let Some(recordings) = read("dmg/CE89146.V2", RecordFormat::Csmip) else { return };
    assert_eq!(recordings.len(), 3);
    // Stated at 30.585, 30.585 and 30.575 s.
    for (recording, (orientation, channel, peak_cm_s2, peak_index)) in recordings.iter().zip([
        (Orientation::Azimuth(360.0), "Chan 1: 360 Deg", 77.280, 6117),
        (Orientation::Vertical, "Chan 2: Up", 20.529, 6117),
        (Orientation::Azimuth(90.0), "Chan 3: 90 Deg", -44.200, 6115),
    ]) {
        let Recording { accelerogram, description, .. } = recording;
        assert_eq!((accelerogram.len(), accelerogram.dt_s()), (12_000, 0.005));
        assert_near(accelerogram.acceleration_m_s2()[peak_index], peak_cm_s2 / 100.0, 5e-6 + 1e-12);
        assert_near(accelerogram.pga_m_s2(), f64::abs(peak_cm_s2) / 100.0, 5e-6 + 1e-12);
        let expected = RecordingDescription {
            station: Some("89146".into()),
            station_name: Some("Willow Creek".into()),
            channel: Some(channel.into()),
            orientation: Some(orientation),
            low_cut_hz: Some(0.3),
            // 2012-02-13 21:06:45
            start_time_s: Some(1_329_167_205.0),
            stated_pga_m_s2: Some(f64::abs(peak_cm_s2) / 100.0),
            ..RecordingDescription::default()
        };
        assert_eq!(*description, expected);
    }
    assert_eq!(recordings[0].accelerogram.acceleration_m_s2()[0], -0.000_010 / 100.0);
    assert_eq!(recordings[2].accelerogram.acceleration_m_s2()[15], 0.000_143 / 100.0);

    let options = ReadOptions { channel: Some(3), ..ReadOptions::default() };
    let path = file("dmg/CE89146.V2").unwrap();
    assert_eq!(read_path(&path, &options).unwrap(), recordings[2].accelerogram);
    let message = read_path(&path, &ReadOptions::default()).unwrap_err().to_string();
    assert!(message.contains("components of this file are Chan 1: 360 Deg, Chan 2: Up, Chan 3: 90 Deg;"), "{message}");
}

/// Cut anywhere in its head, and with bytes changed there: an answer, never a panic.
#[test]
fn damaged_real_files_give_an_answer() {
    for name in ["cosmos/Cosmos12TimeSeriesTest.v1", "dmg/CE89146.V2"] {
        let Some(path) = file(name) else { return };
        let bytes = std::fs::read(path).unwrap();
        let head = &bytes[..bytes.len().min(6000)];
        for length in 0..head.len() {
            let error = uplift_motion::read_record(&head[..length], "cut", &ReadOptions::default()).unwrap_err();
            assert!(error.to_string().contains("cut"), "{error}");
        }
        for at in (0..head.len()).step_by(7) {
            for byte in *b"\x009-X\n\xff" {
                let mut changed = bytes.clone();
                changed[at] = byte;
                changed.truncate(20_000);
                let _ = uplift_motion::read_record(&changed, "changed", &ReadOptions::default());
            }
        }
    }
}
