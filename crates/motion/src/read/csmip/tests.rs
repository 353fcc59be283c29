//! Files written in the format and its dialects, and damaged ones.
#![allow(clippy::format_collect)]

use super::*;
use crate::recording::Orientation;
use crate::unit::AccelerationUnit;
use proptest::prelude::*;

const OPTIONS: ReadOptions = ReadOptions { format: None, channel: None, dt_s: None, unit: None, gravity_m_s2: 10.0 };

const VELOCITY: &str =
    "     2 points of veloc data equally spaced at  .010 sec, in cm/sec.  (8f10.6)\n   .000001   .000002\n";

/// A component of Volume 2.
fn volume_2(channel: &str, data_line: &str, values: &str) -> String {
    let mut text = format!(
        "Corrected accelerogram   4711-S0001-00001.01       Chan  {channel}     from\n\
         Uncorrected Accelerogram Data             Processed: 01/02/01, NONE\n\
         Invented Earthquake\n\
         January 1, 2001 12:00 PST               (Origin(NONE): 01/01/01, 20:00:00.5 UTC)\n\
         15.XX.4711.--.HN                     Start time:  1/01/01, 20:00:01.5 UTC (GPS)\n\
         Station No. 4711    10.000N, 20.000W      None s/n 1  (3 Chns of  3 at Sta)\n\
         Town Hall                                 NONE\n\
         Chan  {channel}\n\
         Invented Earthquake     January 1, 2001 12:00 PST\n\
         Hypocenter(NONE): 10.2N, 20.1W, H=9km. ML=5.5(NONE), MW=5.25\n\
         Instr Period =  .0109 sec,  Damping =  .670\n                        Record length = 60.000 sec.\n\
         \u{20}                                    Uncor Max  =   .009 g , at  30.590 sec.\n\
         RMS accel of (uncor) record  =        .\n\
         Accelerogram bandpass filtered with ramps at  .050- .100 and 23.00-25.00 cyc/sec\n\
         \u{20}    3 points of instrument- and baseline-corrected accel, veloc and displ data\n\
         At equally-spaced intervals of    .010  sec.\n\
         Peak acceleration =    -3.000    cm/sec/sec  at     .020   sec.\n\
         Peak   velocity   =      .000      cm/sec    at     .000   sec.\n\
         Peak displacement =      .000        cm      at     .000   sec.\n\
         Initial velocity  =      .000   cm/sec;   Initial displacement =     .000   cm\n\
         Invented Earthquake\n\n4711-S0001-00001.01      Town Hall    Chan  {channel}\n\n"
    );
    for _ in 0..7 {
        text += "    1  100    1    312000-9990    1\n";
    }
    for _ in 0..13 {
        text += "  .0108814-999.00000-999.00000\n";
    }
    text + &format!("{data_line}\n{values}\n{VELOCITY}/&  ----------  End of data for channel  1  ----------\n")
}

const DATA_LINE: &str = "     3 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)    ";
const VALUES: &str = "  1.000000 -2.000000  3.000000";

/// A component of Volume 1, with the real-header value of its peak.
fn volume_1(unit_line: &str, values: &str) -> String {
    let mut text = format!(
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 02/08/94, NONE\n\
         INVENTED EARTHQUAKE\nJANUARY 17, 1994 04:31 PST              (ORIGIN: TO BE DETERMINED)\n\
         4711-S0001-94021.02               TRIGGER TIME: 01/17/94, 12:31:04.5 UTC\n\
         STATION NO. 4711   33.929N, 118.260W     SMA-1  S/N 1\nTOWN HALL\nCHAN  1:  90 DEG\n\
         INVENTED EARTHQUAKE\nHYPOCENTER: NONE\nINSTR PERIOD =  .0397 SEC\n\
         NO. OF POINTS =  3  RECORD LENGTH =  .020 SEC\n{unit_line}\nRMS ACCEL OF COMPLETE RECORD =  .021 G.\n"
    );
    for _ in 0..7 {
        text += "    1    1    1    3\n";
    }
    text += "      .040      .592    59.998      .021-999.00000     1.775 -.1999000    11.576\n";
    for _ in 0..6 {
        text += "    25.200-999.00000\n";
    }
    text + values + "\n/&  ----------  END OF DATA FOR CHANNEL  1  ----------\n"
}

const OLD_UNIT: &str = "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  -.200 G, AT   .010 SEC.";

fn read_all(text: &str) -> Result<Vec<Recording>, String> {
    assert!(looks_like(text));
    read(text.as_bytes(), "a.V2", &OPTIONS).map_err(|error| error.to_string())
}

fn read_one(data_line: &str, values: &str) -> Result<Recording, String> {
    read_all(&volume_2("1: 360 Deg", data_line, values)).map(|mut recordings| recordings.remove(0))
}

#[test]
fn what_a_component_of_volume_2_says() {
    let text = volume_2("1: 360 Deg      (Sta Chn: 1)   Location: Roof - North", DATA_LINE, VALUES)
        + &volume_2("2:  Up ", DATA_LINE, VALUES);
    let recordings = read_all(&text).unwrap();
    assert_eq!(recordings.len(), 2);
    let Recording { accelerogram, description, .. } = &recordings[0];
    assert_eq!(accelerogram.acceleration_m_s2(), [0.01, -0.02, 0.03]);
    assert_eq!(accelerogram.dt_s(), 0.01);
    assert_eq!(description.event.as_deref(), Some("Invented Earthquake"));
    assert_eq!(description.event_time.as_deref(), Some("01/01/01, 20:00:00.5 UTC"));
    assert_eq!(description.magnitude, Some(5.25));
    assert_eq!(description.station.as_deref(), Some("XX.4711"));
    assert_eq!(description.station_name.as_deref(), Some("Town Hall"));
    assert_eq!(description.sensor.as_deref(), Some("Roof - North"));
    assert_eq!(description.channel.as_deref(), Some("Chan 1: 360 Deg"));
    assert_eq!(description.orientation, Some(Orientation::Azimuth(360.0)));
    assert_eq!(description.low_cut_hz, Some(0.1));
    assert_eq!(description.start_time_s, Some(978_379_201.5));
    assert_eq!(description.stated_pga_m_s2, Some(0.03));
    assert!(!description.unprocessed);
    assert_eq!(recordings[1].description.channel.as_deref(), Some("Chan 2: Up"));
    assert_eq!(recordings[1].description.orientation, Some(Orientation::Vertical));
    assert_eq!(recordings[1].description.sensor, None);
}

#[test]
fn dialects_of_the_data_line() {
    for (line, first_m_s2, dt_s) in [
        (DATA_LINE, 0.01, 0.01),
        ("  3 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)", 0.01, 0.02),
        ("3 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)", 10.0, 0.005),
        ("  3 points of accel data equally spaced at  .020 sec, in g. (8f10.6)", 10.0, 0.02),
        ("     3 Accelerogram points at 200 pts/sec in units of g .      Format: (8f10.6)  ", 10.0, 0.005),
        ("  3 points of accel data equally spaced at  .020 sec, in g/10.", 1.0, 0.02),
    ] {
        let motion = read_one(line, VALUES).unwrap().accelerogram;
        assert_eq!((motion.acceleration_m_s2()[0], motion.dt_s()), (first_m_s2, dt_s), "{line}");
    }
    let unknown = read_one("  3 points of accel data equally spaced at  .020 sec, in furlong. (8f10.6)", VALUES);
    assert!(unknown.unwrap_err().contains("line 46: unknown acceleration unit"));
    let silent = volume_2("1: 360 Deg", "  3 points of accel data equally spaced at  .020 sec", VALUES);
    assert!(read_all(&silent).unwrap_err().contains("does not say its unit"));
    let options = ReadOptions { unit: Some(AccelerationUnit::MPerS2), ..OPTIONS };
    assert_eq!(read(silent.as_bytes(), "x", &options).unwrap()[0].accelerogram.acceleration_m_s2()[0], 1.0);
    let no_step = read_one("  3 points of accel data equally spaced at some sec, in g", VALUES).unwrap_err();
    assert!(no_step.contains("line 46: cannot read the time step in \"3 points"), "{no_step}");
}

#[test]
fn volume_1_with_a_data_line() {
    let unit_line = "Units of uncor data are sec and g .        Max  =  -.200 g , at    .010 sec.";
    let values =
        "     3 Accelerogram points at 100 pts/sec in units of g .      Format: (8f9.6)\n  .100000 -.199900  .000000";
    let recordings = read_all(&volume_1(unit_line, values)).unwrap();
    let [Recording { accelerogram, description, .. }] = &recordings[..] else { panic!("{}", recordings.len()) };
    assert_eq!(accelerogram.acceleration_m_s2(), [1.0, -0.1999 * 10.0, 0.0]);
    assert_eq!(accelerogram.dt_s(), 0.01);
    // The header value, for the text has three digits.
    assert_eq!(description.stated_pga_m_s2, Some(0.1999 * 10.0));
    assert!(description.unprocessed && description.low_cut_hz.is_none());
    assert_eq!(description.event.as_deref(), Some("INVENTED EARTHQUAKE"));
    assert_eq!(description.event_time, None);
    assert_eq!(description.station.as_deref(), Some("4711"));
    assert_eq!(description.station_name.as_deref(), Some("TOWN HALL"));
    assert_eq!(description.channel.as_deref(), Some("Chan 1: 90 DEG"));
    assert_eq!(description.start_time_s, Some(758_809_864.5));
}

#[test]
fn volume_1_with_pairs() {
    let even = "   .000  1.000   .010 -1.999   .020  0.500";
    let recordings = read_all(&(volume_1(OLD_UNIT, even) + &volume_1(OLD_UNIT, even))).unwrap();
    assert_eq!(recordings.len(), 2);
    let motion = &recordings[1].accelerogram;
    assert_eq!(motion.dt_s(), 0.01);
    assert!(motion.acceleration_m_s2().iter().zip([1.0, -1.999, 0.5]).all(|(a, b)| (a - b).abs() < 1e-15));
    assert_eq!(recordings[1].description.stated_pga_m_s2, Some(0.1999 * 10.0));

    let message = |values: &str| read_all(&volume_1(OLD_UNIT, values)).unwrap_err();
    let uneven = message("   .000  1.000   .013 -1.999   .020  0.500");
    assert!(uneven.contains("line 28: time 0.013 s") && uneven.contains("or give its Volume 2 file"), "{uneven}");
    assert!(message("   .000  1.000   .010 -1.999").contains("header says 3 points, file has 2"));
    assert!(message("   .010  1.000   .010 -1.999   .010  1.000").contains("time step is 0 s"));
    let no_unit = volume_1("MAX  =  -.200 G", even);
    assert!(read_all(&no_unit).unwrap_err().contains("does not say its unit"));
}

#[test]
fn nothing_but_other_quantities() {
    let velocity = volume_2("1: 360 Deg", VELOCITY.lines().next().unwrap(), "   .000001   .000002");
    assert_eq!(
        read_all(&velocity).unwrap_err(),
        "a.V2: no acceleration in this csmip file, only velocity or displacement; give the acceleration file"
    );
    let spectra = format!("Response and Fourier Amplitude Spectra\n{velocity}");
    assert!(
        read_all(&spectra[..spectra.find("     2 points").unwrap()]).unwrap_err().contains("only response spectra")
    );
}

#[test]
fn bad_files() {
    let message = |values: &str| read_one(DATA_LINE, values).unwrap_err();
    assert!(message("  1.000000 -2.000000").contains("header says 3 points, file has 2"));
    assert!(message("  1.000000 -2.000000  1.000000\n  1.000000").contains("header says 3 points, file has 4"));
    assert!(message("  1.000000       NaN  1.000000").contains("line 47: \"NaN\" is not finite"));
    assert!(message("  1.000000     1e400  1.000000").contains("line 47: \"1e400\" is too large"));
    assert!(message("  1.000000**********  1.000000").contains("too wide for its field"));
    let huge = DATA_LINE.replace("    3", "99999999999999999999999");
    assert!(read_one(&huge, VALUES).unwrap_err().contains("18446744073709551615 points, file has 3"));
    let error = read(b"1 2 3\n", "x", &OPTIONS).unwrap_err().to_string();
    assert!(error.contains("no line with \"Corrected accelerogram\""), "{error}");
}

proptest! {
    #[test]
    fn written_files_come_back(
        values in prop::collection::vec(-9_999_999..99_999_999_i32, 2..60), per_row in 1..10_usize, declared: bool,
    ) {
        // Fields of ten characters, which a long number fills.
        let mut rows = Vec::new();
        for row in values.chunks(per_row) {
            rows.push(row.iter().map(|&value| format!("{:10.4}", f64::from(value) / 1e4)).collect::<String>());
        }
        let count = values.len();
        let format = if declared { format!("({per_row}f10.4)") } else { String::new() };
        let line = format!("{count:6} points of accel data equally spaced at  .010 sec, in cm/sec2. {format}");
        let text = volume_2("1: 360 Deg", &line, &rows.join("\n"));
        let found = read_all(&(text.clone() + &text)).unwrap();
        prop_assert_eq!(found.len(), 2);
        let written: Vec<f64> = values.iter().map(|&value| f64::from(value) / 1e4 / 100.0).collect();
        prop_assert_eq!(found[1].accelerogram.acceleration_m_s2(), &written[..]);
    }
}
