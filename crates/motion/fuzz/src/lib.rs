//! What must hold for the readers of records, whatever bytes they are given.

use std::io::Write as _;

use flate2::{Compression, write::GzEncoder};
use uplift_motion::{
    AccelerationUnit, IntensityMeasure, MotionError, Orientation, ReadOptions, RecordFile, RecordFormat,
    RecordingDescription, SelectedComponent, SelectedSet, ezgm_selection_from, read_record, selection_from,
};

const NAME: &str = "the file";
/// Two bytes with which every file packed with gzip begins.
const GZIP: &[u8] = b"\x1f\x8b";
/// Largest unpacked file that is read, bytes.
const LARGEST_BYTES: usize = 64 << 20;

/// Reads `bytes` as a layout.
///
/// # Panics
/// Where the answer is not one that a reader may give; so do the functions below.
pub fn read_as(format: RecordFormat, bytes: &[u8]) {
    check(&read(Some(format), bytes), bytes);
}

/// Reads `bytes` as the layout that they show; packed, plain text is the same.
pub fn read_any(bytes: &[u8]) {
    let plain = read(None, bytes);
    check(&plain, bytes);
    if !bytes.starts_with(GZIP)
        && let Ok(plain) = plain
    {
        let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
        packed.write_all(bytes).expect("a vector takes everything");
        let packed = packed.finish().expect("a vector takes everything");
        assert_eq!(read(None, &packed).expect("what is read plain is read packed"), plain);
    }
}

/// Reads `bytes` as a selection of records, and as the two lists of `EzGM` with an empty line between them.
pub fn read_selection(bytes: &[u8]) {
    for measure in IntensityMeasure::WITHOUT_PERIOD {
        check_selection(&selection_from(bytes, NAME, measure), bytes);
    }
    let middle = bytes.windows(2).position(|pair| pair == b"\n\n").map_or(bytes.len(), |at| at + 1);
    let lists = [&bytes[..middle], bytes.get(middle + 1..).unwrap_or_default()];
    check_selection(&ezgm_selection_from(lists, [NAME; 2], SelectedComponent::Pair), bytes);
}

fn check_selection(result: &Result<SelectedSet, MotionError>, bytes: &[u8]) {
    match result {
        Ok(set) => {
            assert!(!set.records.is_empty() && set.records.len() <= bytes.len());
            assert!(set.level.is_none_or(|level| level.is_finite() && level > 0.0), "{:?}", set.level);
            for record in &set.records {
                let factor: f64 = record.factor.parse().expect("a factor is a number");
                assert!(factor.is_finite() && factor > 0.0, "factor {factor}");
                assert!(record.name.to_string().len() < 1000 && record.position > 0);
            }
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains(NAME), "no file in: {message}");
            assert!(message.len() < 1000, "{} bytes of message", message.len());
        }
    }
}

fn read(format: Option<RecordFormat>, bytes: &[u8]) -> Result<RecordFile, MotionError> {
    // What a file may leave out is given, so that nothing stops there.
    let (dt_s, unit) = (Some(0.01), Some(AccelerationUnit::G));
    read_record(bytes, NAME, &ReadOptions { format, dt_s, unit, ..ReadOptions::default() })
}

fn check(result: &Result<RecordFile, MotionError>, bytes: &[u8]) {
    match result {
        Ok(file) => {
            let most = if bytes.starts_with(GZIP) { LARGEST_BYTES } else { bytes.len() };
            let mut samples = 0;
            for recording in &file.recordings {
                let motion = &recording.accelerogram;
                samples += motion.len();
                assert!(motion.len() >= 2);
                assert!(motion.dt_s().is_finite() && motion.dt_s() > 0.0, "time step {} s", motion.dt_s());
                assert!(motion.acceleration_m_s2().iter().all(|a| a.is_finite()));
                check_description(&recording.description);
            }
            assert!(!file.recordings.is_empty() && samples <= most, "{samples} samples of {most} bytes");
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains(NAME), "no file in: {message}");
            assert!(message.len() < 1000, "{} bytes of message", message.len());
        }
    }
}

/// Numbers are finite, and within the range of what they say.
fn check_description(description: &RecordingDescription) {
    let numbers = [
        description.magnitude,
        description.epicentral_distance_km,
        description.rupture_distance_km,
        description.vs30_m_s,
        description.low_cut_hz,
        description.start_time_s,
        description.stated_pga_m_s2,
    ];
    assert!(numbers.into_iter().flatten().all(f64::is_finite), "{description:?}");
    assert!([description.vs30_m_s, description.low_cut_hz].into_iter().flatten().all(|value| value > 0.0));
    assert!(description.stated_pga_m_s2.is_none_or(|pga| pga >= 0.0));
    if let Some(Orientation::Azimuth(degrees)) = description.orientation {
        assert!((0.0..=360.0).contains(&degrees), "azimuth {degrees}");
    }
}
