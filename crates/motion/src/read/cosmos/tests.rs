//! Files written in the format and its dialects, and damaged ones.
#![allow(clippy::format_collect)]

use super::*;
use crate::recording::Orientation;
use proptest::prelude::*;

const OPTIONS: ReadOptions = ReadOptions { format: None, channel: None, dt_s: None, unit: None, gravity_m_s2: 10.0 };

/// A component as an agency would write it.
#[derive(Debug, Clone)]
struct Sample {
    title: &'static str,
    channel: &'static str,
    comments: &'static str,
    /// Number of an integer-header value and the value.
    integers: Vec<(usize, i64)>,
    reals: Vec<(usize, f64)>,
    data_line: String,
    values: String,
    end: &'static str,
}

impl Sample {
    fn new(data_line: &str, values: &str) -> Self {
        Self {
            title: "Corrected acceleration    (Format v01.20 with 13 text lines) Src: none",
            channel: "Sta Chan   2: 90 deg (Rcrdr Chan  5) Location: Roof",
            comments: "",
            integers: vec![(54, 90)],
            reals: vec![(62, 10.0)],
            data_line: data_line.to_owned(),
            values: values.to_owned(),
            end: "End-of-data for Chan  2 acceleration",
        }
    }

    fn three(unit: &str) -> Self {
        Self::new(
            &format!("       3 acceleration pts, approx    0 secs, units={unit},Format=(8F9.4)"),
            "   1.0000  -2.0000   3.0000",
        )
    }

    fn write(&self) -> String {
        let mut text = format!(
            "{}\nRecord of Invented Earthquake of Mon Jan  1, 2001 12:00 UTC\n\
             Hypocenter: 10.0 20.0 H=  9km(NONE) ML=5.5 Mw=5.25(NONE)\nOrigin: 01/01/2001, 12:00:00.0 UTC\n\
             Statn No: 05- 4711  Code:XX-ABCD   NONE Town Hall - Cellar\nCoords: 10.1 20.1  Site geology: none\n\
             Recorder: none\nRcrd start time:01/01/2001, 12:00:01.500 UTC (Q=5) RcrdId: none\n{}\n\
             Raw record length =  1.0 sec, Uncor max =  0.5 g, at  0.1 sec\n\
             Processed: 01/02/2001, NONE, Max =   -3.000 cm/sec2 at  0.02 sec\n\
             Record filtered below  0.25 Hz (periods over 4.00 secs), and above 20.0 Hz\n\
             Values used when parameter or data value is unknown/unspecified:   -999, -777.0\n",
            self.title, self.channel
        );
        let mut integers = [-999; 100];
        for &(number, value) in &self.integers {
            integers[number - 1] = value;
        }
        text += " 100 Integer-header values follow on  10 lines, Format= (10I8)\n";
        for row in integers.chunks(10) {
            text += &row.iter().map(|value| format!("{value:8}")).collect::<String>();
            text += "\n";
        }
        let mut reals = [-777.0; 100];
        for &(number, value) in &self.reals {
            reals[number - 1] = value;
        }
        text += " 100 Real-header values follow on  17 lines , Format = (6F13.6)\n";
        for row in reals.chunks(6) {
            text += &row.iter().map(|value| format!("{value:13.6}")).collect::<String>();
            text += "\n";
        }
        let count = self.comments.lines().count();
        text + &format!(
            "   {count} Comment line(s) follow, each starting with a \"|\":\n{}{}\n{}\n{}\n",
            self.comments, self.data_line, self.values, self.end
        )
    }

    fn read(&self) -> Result<Recording, String> {
        read_all(&self.write(), &OPTIONS).map(|mut recordings| recordings.remove(0))
    }
}

fn read_all(text: &str, options: &ReadOptions) -> Result<Vec<Recording>, String> {
    assert!(looks_like(text));
    read(text.as_bytes(), "a.V2c", options).map_err(|error| error.to_string())
}

#[test]
fn what_a_component_says() {
    let Recording { accelerogram, description, .. } = Sample::three("cm/sec2 (04)").read().unwrap();
    assert_eq!(accelerogram.acceleration_m_s2(), [0.01, -0.02, 0.03]);
    assert_eq!(accelerogram.dt_s(), 0.01);
    assert_eq!(description.event.as_deref(), Some("Invented Earthquake"));
    assert_eq!(description.event_time.as_deref(), Some("01/01/2001, 12:00:00.0 UTC"));
    assert_eq!(description.magnitude, Some(5.25));
    assert_eq!(description.station.as_deref(), Some("XX.ABCD"));
    assert_eq!(description.station_name.as_deref(), Some("Town Hall - Cellar"));
    assert_eq!(description.sensor.as_deref(), Some("Roof"));
    assert_eq!(description.channel.as_deref(), Some("Chan 2: 90 deg"));
    assert_eq!(description.orientation, Some(Orientation::Azimuth(90.0)));
    assert_eq!(description.low_cut_hz, Some(0.25));
    assert_eq!(description.start_time_s, Some(978_350_401.5));
    assert_eq!(description.stated_pga_m_s2, Some(0.03));
    assert!(!description.unprocessed);
    assert_eq!((description.epicentral_distance_km, description.vs30_m_s), (None, None));
}

#[test]
fn header_values_before_text() {
    let mut sample = Sample::three("cm/sec2 (04)");
    sample.comments = "| Recorder: none\n|<SCNL>EFGH.HNZ.YY.10    <AUTH> 2019\n";
    sample.integers = vec![(54, 360), (40, 2002), (42, 3), (43, 4), (44, 5), (45, 6)];
    sample.reals = vec![(62, 5.0), (13, 6.5), (15, 6.0), (17, 12.5), (4, 0.36), (30, 7.25), (54, 0.5), (64, -2.0)];
    let Recording { accelerogram, description, .. } = sample.read().unwrap();
    assert_eq!(accelerogram.dt_s(), 0.005);
    assert_eq!((description.magnitude, description.epicentral_distance_km), (Some(6.5), Some(12.5)));
    assert_eq!(description.vs30_m_s, Some(360.0));
    assert_eq!(description.start_time_s, Some(1_015_218_367.25));
    assert_eq!((description.low_cut_hz, description.stated_pga_m_s2), (Some(0.5), Some(0.02)));
    assert_eq!(description.station.as_deref(), Some("YY.EFGH"));
    assert_eq!(description.sensor.as_deref(), Some("10"));
    assert_eq!(description.channel.as_deref(), Some("HNZ"));
    // By the letter, for its azimuth is that of no vertical.
    assert_eq!(description.orientation, Some(Orientation::Vertical));
    for (title, unprocessed) in [
        ("Uncorrected acceleration  (Format v01.20 with 13 text lines)", true),
        ("Raw acceleration counts   (Format v01.20 with 13 text lines)", true),
        ("CORRECTED ACCELERATION    (FORMAT V01.25 WITH 13 TEXT LINES)", false),
    ] {
        sample.title = title;
        let description = sample.read().unwrap().description;
        assert_eq!((description.unprocessed, description.low_cut_hz.is_none()), (unprocessed, unprocessed), "{title}");
    }
    sample.integers = vec![(1, 1)];
    assert!(sample.read().unwrap().description.unprocessed);
}

#[test]
fn directions() {
    for (code, scnl, channel, expected) in [
        (360, "", "Sta Chan   1: 360 deg", Some(Orientation::Azimuth(360.0))),
        (400, "", "Sta Chan   1: Up", Some(Orientation::Vertical)),
        (402, "", "", Some(Orientation::Vertical)),
        (500, "", "", Some(Orientation::Horizontal(1))),
        (501, "", "", Some(Orientation::Horizontal(2))),
        (700, "", "Sta Chan   1: H1", Some(Orientation::Horizontal(1))),
        (601, "", "", Some(Orientation::Horizontal(2))),
        (0, "|<SCNL>A.HNE.B.--\n", "", Some(Orientation::Azimuth(90.0))),
        (0, "|<SCNL>A.HN2.B.--\n", "", Some(Orientation::Horizontal(2))),
        (0, "|<SCNL>A.HNZ.B.--\n", "", Some(Orientation::Vertical)),
        (35, "|<SCNL>A.HNN.B.--\n", "", Some(Orientation::Azimuth(35.0))),
        (-999, "", "Sta Cha: 1   UP      (Rcrdr Chan  1)", Some(Orientation::Vertical)),
        (-999, "", "Sta Chan   1:270 deg (Rcrdr Chan  1) Location:10", Some(Orientation::Azimuth(270.0))),
        (-999, "", "Sta Chan   1: Tran   (Rcrdr Chan  1)", Some(Orientation::Horizontal(2))),
        (2000, "", "Sta Chan   ?:Other   (Rcrdr Chan  ?) Location:", None),
    ] {
        let mut sample = Sample::three("cm/sec2 (04)");
        (sample.integers, sample.comments, sample.channel) = (vec![(54, code)], scnl, channel);
        assert_eq!(sample.read().unwrap().description.orientation, expected, "{code} {scnl} {channel}");
    }
}

#[test]
fn units() {
    for (unit, m_s2) in [
        ("cm/sec2(04)", 0.01),
        ("cm/s^2 (4)", 0.01),
        ("cm/s/s     ", 0.01),
        ("gal (10)", 0.01),
        ("g      (02)", 10.0),
        ("mg (11)", 0.01),
        ("ug (12)", 1e-5),
        ("in/sec2(07)", 0.0254),
        ("(04)", 0.01),
        // A code of the agency's own.
        ("cm/sec2(99)", 0.01),
    ] {
        let found = Sample::three(unit).read().unwrap().accelerogram.acceleration_m_s2()[0];
        assert!((found / m_s2 - 1.0).abs() < 1e-14, "{unit}: {found}");
    }
    for unit in ["cm/sec2 (02)", "g (50)", "counts (04)", "volts (51)", "cm/sec (05)", "furlong", "(51)"] {
        let message = Sample::three(unit).read().unwrap_err();
        assert!(message.contains("line 44: unknown acceleration unit in \"3 acceleration pts"), "{unit}: {message}");
    }
    // By header value 3, and by the caller.
    let mut silent = Sample::three("");
    silent.integers.push((3, 2));
    assert_eq!(silent.read().unwrap().accelerogram.acceleration_m_s2()[0], 10.0);
    silent.integers.pop();
    assert!(silent.read().unwrap_err().contains("does not say its unit"));
    let options = ReadOptions { unit: Some(AccelerationUnit::MPerS2), ..OPTIONS };
    assert_eq!(read_all(&silent.write(), &options).unwrap()[0].accelerogram.acceleration_m_s2()[0], 1.0);
}

#[test]
fn counts() {
    let mut sample = Sample::new(
        "   3  raw accel.   pts, approx  0 secs, units=counts (50),Format=(10I8)",
        "    1000   -2000   10000",
    );
    sample.title = "Raw acceleration counts   (Format v01.20 with 13 text lines)";
    sample.reals = vec![(62, 10.0), (22, 2.5), (42, 1.25), (64, 10000.0)];
    // 2.5 uV/count by 1.25 V/g are 2e-6 g/count.
    let Recording { accelerogram, description, .. } = sample.read().unwrap();
    for (found, expected) in accelerogram.acceleration_m_s2().iter().zip([0.02, -0.04, 0.2]) {
        assert!((found - expected).abs() < 1e-15, "{found}");
    }
    assert!(description.unprocessed && description.stated_pga_m_s2.is_none());
    sample.reals.push((47, 2.0));
    assert!((sample.read().unwrap().accelerogram.acceleration_m_s2()[2] - 0.1).abs() < 1e-15);
    for without in [vec![(62, 10.0), (22, 2.5)], vec![(62, 10.0), (42, 2.5)], vec![(62, 10.0), (22, 0.0), (42, 1.0)]] {
        sample.reals = without;
        let message = sample.read().unwrap_err();
        assert!(
            message.contains("line 44: \"3  raw accel.") && message.contains("give the processed record"),
            "{message}"
        );
    }
}

#[test]
fn time_steps() {
    let line = |middle: &str| format!("  3 acceleration pts, {middle}, units=cm/sec2(04),Format=(8F9.4)");
    let values = "   1.0000  -2.0000   3.0000";
    for (middle, real_62, dt_s) in [
        ("approx    0 secs", Some(10.0), 0.01),
        ("approx   30 secs", Some(10_000.0), 10.0),
        // In seconds, as the duration shows.
        ("approx   30 secs", Some(10.0), 10.0),
        ("a  200 pts/sec", None, 0.005),
    ] {
        let mut sample = Sample::new(&line(middle), values);
        sample.reals = real_62.map(|value| (62, value)).into_iter().collect();
        assert_eq!(sample.read().unwrap().accelerogram.dt_s(), dt_s, "{middle}");
    }
    for (middle, reals) in [
        ("approx   30 secs", vec![(62, 1.0)]),
        ("approx   30 secs", vec![(34, 10.0)]),
        ("approx 30 secs", vec![(62, -5.0)]),
    ] {
        let mut sample = Sample::new(&line(middle), values);
        sample.reals = reals;
        let message = sample.read().unwrap_err();
        assert!(message.contains("no time step (real-header value 62"), "{message}");
    }
    // Version 1.00 has other header values.
    let mut old = Sample::new(&line("a  200 pts/sec"), values);
    old.title = "Uncorrected Acceleration  (Format v01.00 with 13 text lines) Orig: none";
    assert_eq!(old.read().unwrap().accelerogram.dt_s(), 0.005);
}

#[test]
fn several_components_and_quantities() {
    let first = Sample::three("cm/sec2 (04)");
    let mut velocity =
        Sample::new("   2 velocity     pts, approx  0 secs, units=cm/sec(05),Format=(8F9.4)", "   9.0000   9.0000");
    velocity.title = "Velocity data             (Format v01.20 with 13 text lines) Src: none";
    velocity.end = "/&  ----------  End of data for channel  2  ----------";
    let mut third = Sample::three("g (02)");
    third.channel = "Sta Chan   3: Up";
    // A velocity without a head of its own.
    third.end = "\n   2 displacement pts, approx 0 secs, units=cm(06),Format=(8F9.4)\n   1.0000   1.0000\nEnd-of-data";
    let text = first.write() + &velocity.write() + &third.write();
    let recordings = read_all(&text, &OPTIONS).unwrap();
    let called: Vec<_> = recordings.iter().map(|r| r.description.channel.clone().unwrap()).collect();
    assert_eq!(called, ["Chan 2: 90 deg", "Chan 3: Up"]);
    assert_eq!(recordings[1].accelerogram.acceleration_m_s2(), [10.0, -20.0, 30.0]);

    let block = format!("{}\n{}\n", first.data_line, first.values);
    assert!(read_all(&(first.write() + &block), &OPTIONS).unwrap_err().contains("has no text above the accelerations"));

    let message = read_all(&velocity.write(), &OPTIONS).unwrap_err();
    assert_eq!(message, "a.V2c: no acceleration in this cosmos file, only velocity; give the acceleration file");
    let mut spectra = velocity.clone();
    spectra.title = "Response spectra          (Format v01.20 with 13 text lines) Src: none";
    spectra.data_line = "  91 periods, units=sec(01),Format=(8F9.4)".to_owned();
    assert!(read_all(&spectra.write(), &OPTIONS).unwrap_err().contains("only Response spectra"));
}

#[test]
fn line_ends_and_encodings() {
    let plain = Sample::three("cm/sec2 (04)");
    let text = plain.write();
    let expected = plain.read().unwrap();
    for variant in [text.replace('\n', "\r\n"), format!("\u{feff}{text}"), format!("{text}\r\n \r\n\x1a")] {
        assert_eq!(read(variant.as_bytes(), "x", &OPTIONS).unwrap()[0], expected);
    }
    let mut latin1 = text.replace("Cellar", "Cell?r").into_bytes();
    let at = latin1.iter().position(|&byte| byte == b'?').unwrap();
    latin1[at] = 0xe9;
    let found = read(&latin1, "x", &OPTIONS).unwrap();
    assert_eq!(found[0].description.station_name.as_deref(), Some("Town Hall - Cellér"));
    assert_eq!(found[0].accelerogram, expected.accelerogram);
}

#[test]
fn bad_files() {
    let sample = |values: &str| {
        let data_line = "   3 acceleration pts, approx 0 secs, units=g(02),Format=(8F9.4)";
        Sample::new(data_line, values).read().unwrap_err()
    };
    assert!(sample("   1.0000   2.0000").contains("header says 3 points, file has 2"));
    assert!(sample("   1.0000   2.0000   1.0000   2.0000").contains("header says 3 points, file has 4"));
    assert!(sample("   1.0000      NaN   1.0000").contains("line 45: \"NaN\" is not finite"));
    assert!(sample("   1.0000    1e400   1.0000").contains("line 45: \"1e400\" is too large"));
    assert!(sample("   1.0000********* 2.0000").contains("too wide for its field"));
    let huge = Sample::new("99999999999999999999999 acceleration pts, units=g,Format=(8F9.4)", "  1.0 2.0").read();
    assert!(huge.unwrap_err().contains("18446744073709551615 points, file has 2"));
    let text = Sample::three("g").write();
    for (from, to) in [
        ("13 text lines", "99999999999999999999 text lines"),
        ("100 Integer", "99999999999999999999 Integer"),
        ("100 Real", "99999999999999999999 Real"),
    ] {
        assert_eq!(read_all(&text.replace(from, to), &OPTIONS).unwrap().len(), 1, "{to}");
    }
    let message = read(b"1 2 3\n", "x", &OPTIONS).unwrap_err().to_string();
    assert!(message.contains("has no line with \"(Format v01.20"), "{message}");
    let bad_gravity = ReadOptions { gravity_m_s2: f64::NAN, ..OPTIONS };
    assert!(read_all(&text, &bad_gravity).unwrap_err().contains("gravity"));
}

proptest! {
    #[test]
    fn written_files_come_back(
        values in prop::collection::vec(-99_999_999..999_999_999_i32, 2..60),
        per_row in 1..10_usize, dt_ms in 1..40_u32, dos: bool,
    ) {
        // Fields of eleven characters, which a long number fills.
        let mut rows = Vec::new();
        for row in values.chunks(per_row) {
            rows.push(row.iter().map(|&value| format!("{:11.5}", f64::from(value) / 1e5)).collect::<String>());
        }
        let count = values.len();
        let seconds = f64::from(dt_ms) * count as f64 / 1000.0;
        let data_line =
            format!("{count:8} acceleration pts, approx {seconds:4.0} secs, units=cm/sec2(04),Format=({per_row}F11.5)");
        let mut sample = Sample::new(&data_line, &rows.join("\n"));
        sample.reals = vec![(62, dt_ms.into())];
        let mut text = sample.write();
        if dos {
            text = text.replace('\n', "\r\n");
        }
        let found = read_all(&(text.clone() + &text), &OPTIONS).unwrap();
        prop_assert_eq!(found.len(), 2);
        let written: Vec<f64> = values.iter().map(|&value| f64::from(value) / 1e5 / 100.0).collect();
        prop_assert_eq!(found[1].accelerogram.acceleration_m_s2(), &written[..]);
        prop_assert_eq!(found[1].accelerogram.dt_s(), f64::from(dt_ms) / 1000.0);
    }
}
