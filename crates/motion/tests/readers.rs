//! Readers against files written in every dialect, and against damaged ones.
#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;

use proptest::prelude::*;
use uplift_motion::{
    AccelerationUnit, Accelerogram, MotionError, ReadOptions, read_at2, read_auto, read_columns, read_path,
};

/// In g, so that values come back as they were written.
const UNIT_GRAVITY: ReadOptions =
    ReadOptions { format: None, channel: None, dt_s: None, unit: None, gravity_m_s2: 1.0 };

/// How a writer of AT2 files prints.
#[derive(Debug, Clone, Copy)]
struct Style {
    old_point_line: bool,
    fortran_exponent: bool,
    line_end: &'static str,
    per_row: usize,
}

fn styles() -> impl Strategy<Value = Style> {
    (any::<bool>(), any::<bool>(), any::<bool>(), 1..9_usize).prop_map(
        |(old_point_line, fortran_exponent, dos, per_row)| Style {
            old_point_line,
            fortran_exponent,
            line_end: if dos { "\r\n" } else { "\n" },
            per_row,
        },
    )
}

fn at2(dt_s: f64, values_g: &[f64], style: Style) -> String {
    let end = style.line_end;
    let count = values_g.len();
    let mut text = format!("PEER STRONG MOTION DATABASE RECORD{end}Event, 1/1/2000, Station, 090{end}");
    write!(text, "ACCELERATION TIME SERIES IN UNITS OF G{end}").unwrap();
    if style.old_point_line {
        write!(text, "{count:>5}    {dt_s}    NPTS, DT{end}").unwrap();
    } else {
        write!(text, "NPTS= {count:>6}, DT= {dt_s} SEC,   4 POLE @    30.0 HZ{end}").unwrap();
    }
    for row in values_g.chunks(style.per_row) {
        for value in row {
            // Wide enough for a round trip of the mantissa; only a plus leaves a blank.
            let mut field = format!("{value:.17E}");
            if style.fortran_exponent {
                field = field.replace('E', "D");
            }
            let blank = if value.is_sign_positive() { " " } else { "" };
            write!(text, "{blank}{field}").unwrap();
        }
        text += end;
    }
    text
}

fn values() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(prop_oneof![-2.0..2.0_f64, -1e-90..1e-90_f64, Just(0.0), Just(-0.0)], 2..80)
}

proptest! {
    #[test]
    fn written_at2_comes_back(values_g in values(), dt_s in 0.001..0.1_f64, style in styles()) {
        let text = at2(dt_s, &values_g, style);
        let record = read_at2(text.as_bytes(), "x", &UNIT_GRAVITY).unwrap();
        prop_assert_eq!(record.accelerogram.dt_s(), dt_s);
        prop_assert_eq!(record.accelerogram.acceleration_m_s2(), &values_g[..]);
        prop_assert_eq!(read_auto(text.as_bytes(), "x", &UNIT_GRAVITY).unwrap(), record.accelerogram);
    }

    #[test]
    fn fields_without_blanks_come_back(values in prop::collection::vec(1_000_000..9_999_999_i32, 2..40)) {
        // 0.ddddddd: the fields touch; the points tell them apart.
        let mut text = format!("a\nb\nUNITS OF G\nNPTS= {}, DT= .01 SEC\n", values.len());
        for row in values.chunks(8) {
            for value in row {
                write!(text, "0.{value}").unwrap();
            }
            text += "\n";
        }
        let expected: Vec<f64> = values.iter().map(|v| format!("0.{v}").parse().unwrap()).collect();
        let record = read_at2(text.as_bytes(), "x", &UNIT_GRAVITY).unwrap();
        prop_assert_eq!(record.accelerogram.acceleration_m_s2(), &expected[..]);
    }

    #[test]
    fn columns_come_back(
        values in values(), separator in prop_oneof![Just(" "), Just("\t"), Just(","), Just(";"), Just(" , ")],
    ) {
        let options = ReadOptions { unit: Some(AccelerationUnit::MPerS2), dt_s: Some(0.005), ..UNIT_GRAVITY };
        let (mut one, mut two) = (String::from("# one\n"), String::from("time acceleration\n"));
        for (i, value) in values.iter().enumerate() {
            writeln!(one, "{value:e}").unwrap();
            writeln!(two, "{:.3}{separator}{value:e}", i as f64 * 0.005).unwrap();
        }
        let expected = Accelerogram::new(0.005, values).unwrap();
        prop_assert_eq!(read_auto(one.as_bytes(), "x", &options).unwrap(), expected.clone());
        let found = read_columns(two.as_bytes(), "x", &options).unwrap();
        prop_assert_eq!(found.acceleration_m_s2(), expected.acceleration_m_s2());
        prop_assert!((found.dt_s() / 0.005 - 1.0).abs() < 1e-13);
    }
}

#[test]
fn the_reader_is_chosen_by_content_then_by_name() {
    let style = Style { old_point_line: true, fortran_exponent: false, line_end: "\n", per_row: 5 };
    let text = at2(0.01, &[0.1, -0.2, 0.3], style);
    assert!(read_auto(text.as_bytes(), "record.txt", &UNIT_GRAVITY).is_ok());
    let error = read_auto(b"1\n2\n", "RECORD.AT2", &UNIT_GRAVITY).unwrap_err();
    assert!(matches!(error, MotionError::NoPointCount { .. }), "{error}");
    let error = read_auto(b"1\n2\n", "record.txt", &UNIT_GRAVITY).unwrap_err();
    assert!(matches!(error, MotionError::MissingUnitAndTimeStep { .. }), "{error}");
    let options = ReadOptions { unit: Some(AccelerationUnit::G), ..UNIT_GRAVITY };
    let error = read_auto(b"1\n2\n", "record.txt", &options).unwrap_err();
    assert!(matches!(error, MotionError::MissingTimeStep { .. }), "{error}");
    let options = ReadOptions { gravity_m_s2: 0.0, ..UNIT_GRAVITY };
    let error = read_auto(text.as_bytes(), "record.txt", &options).unwrap_err();
    assert!(matches!(error, MotionError::Gravity { .. }), "{error}");
}

#[test]
fn unreadable_files_are_named() {
    let missing = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("no-such-file.AT2");
    let message = read_path(&missing, &UNIT_GRAVITY).unwrap_err().to_string();
    assert!(message.ends_with("no-such-file.AT2: there is no such file"), "{message}");
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    assert!(matches!(read_path(folder, &UNIT_GRAVITY), Err(MotionError::Unreadable { .. })));
}

#[test]
#[cfg(unix)]
fn a_device_is_refused() {
    let message = read_path(std::path::Path::new("/dev/zero"), &UNIT_GRAVITY).unwrap_err().to_string();
    assert!(message.contains("/dev/zero") && message.contains("device"), "{message}");
}
