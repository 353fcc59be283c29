//! What must hold for the readers of hazard curves, whatever bytes they are given.

use std::io::Cursor;

use libfuzzer_sys::Corpus;
use tempfile::NamedTempFile;
use uplift_hazard::{
    CsvOptions, Declared, ExportedCurve, ExportedCurves, HazardCurve, HazardError, SecondColumn, SiteSelection,
    read_csv, read_realization_weights,
};

const NAME: &str = "the file";

/// Reads a two-column table with and without a declaration of the second column.
///
/// # Panics
/// Where the answer is not one that a reader may give; so do the functions below.
pub fn table(bytes: &[u8]) -> Corpus {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return Corpus::Reject;
    };
    for second_column in [None, Some(SecondColumn::AnnualRate), Some(SecondColumn::Probability)] {
        let options = CsvOptions { second_column, years: Some(50.0), ..CsvOptions::new("PGV", "cm/s") };
        match read_csv(text, NAME, &options) {
            Ok(read) => {
                check_curve(&read.curve);
                assert!(2 * (read.curve.len() + read.dropped_zeros + read.dropped_certain) <= bytes.len());
            }
            Err(error) => check_message(&error),
        }
    }
    let (measure, _) = Declared::in_table(text);
    assert!(measure.is_none_or(|measure| !measure.is_empty()));
    Corpus::Keep
}

/// Reads an export that begins as `begins` wants, in every way there is: curve by curve, and by each selection.
pub fn export(bytes: &[u8], begins: impl FnOnce(u8) -> bool) -> Corpus {
    let begin = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start().first();
    if !begin.is_some_and(|&byte| begins(byte)) {
        return Corpus::Reject;
    }
    let open = || ExportedCurves::from_reader(Cursor::new(bytes.to_vec()), NAME);
    match open() {
        Ok(curves) => {
            let mut items = 0;
            for item in curves {
                items += 1;
                item.as_ref().map_or_else(check_message, |curve| check_exported(std::slice::from_ref(curve)));
                // Packed, a file may have a thousand times as many.
                assert!(items <= bytes.len() || bytes.starts_with(b"\x1f\x8b"), "the iteration does not end");
            }
        }
        Err(error) => check_message(&error),
    }
    let nearest = SiteSelection::Nearest { longitude_deg: 10.0, latitude_deg: 50.0 };
    for selection in [SiteSelection::Name("Athens".to_owned()), nearest] {
        match open().and_then(|curves| curves.select(&selection)) {
            Ok(curves) => {
                assert!(!curves.is_empty());
                check_exported(&curves);
            }
            Err(error) => check_message(&error),
        }
    }
    Corpus::Keep
}

/// Reads the weights of realizations, which are read from files alone.
pub fn realizations(bytes: &[u8]) {
    thread_local!(static FILE: NamedTempFile = NamedTempFile::new().expect("a temporary file"));
    FILE.with(|file| {
        file.as_file().set_len(0).expect("the file can be emptied");
        std::fs::write(file, bytes).expect("the file can be written");
        match read_realization_weights(file.path()) {
            Ok(weights) => {
                assert!(weights.len() <= bytes.len() || bytes.starts_with(b"\x1f\x8b"));
                assert!(weights.values().all(|realization| realization.weight > 0.0));
                let sum: f64 = weights.values().map(|realization| realization.weight).sum();
                assert!((sum - 1.0).abs() <= 1e-3, "the weights add up to {sum}");
            }
            Err(error) => check_message(&error),
        }
    });
}

fn check_exported(curves: &[ExportedCurve]) {
    for curve in curves {
        check_curve(&curve.curve);
        assert!((-180.0..=360.0).contains(&curve.site.longitude_deg));
        assert!((-90.0..=90.0).contains(&curve.site.latitude_deg));
        assert!(curve.distance_km.is_none_or(|km| (0.0..20_100.0).contains(&km)), "{:?} km", curve.distance_km);
        assert!(curve.investigation_years.is_none_or(|years| years.is_finite() && years > 0.0));
        assert!(curve.vs30_m_s.is_none_or(f64::is_finite));
    }
}

fn check_curve(curve: &HazardCurve) {
    let (levels, rates) = (curve.im(), curve.maf());
    assert!(levels.len() == rates.len() && levels.len() >= 2);
    assert!(levels.iter().chain(rates).all(|value| value.is_finite() && *value > 0.0));
    assert!(levels.windows(2).all(|pair| pair[0] < pair[1]), "levels {levels:?}");
    assert!(rates.windows(2).all(|pair| pair[0] > pair[1]), "rates {rates:?}");
    // What a curve is asked for between its points is between them.
    let middle = levels[0] + 0.5 * (levels[1] - levels[0]);
    let rate = curve.rate_at(middle).expect("a level of the curve");
    assert!((rates[1]..=rates[0]).contains(&rate), "{rate} is not between {} and {}", rates[1], rates[0]);
}

fn check_message(error: &HazardError) {
    let message = error.to_string();
    assert!(message.len() < 2000, "{} bytes of message", message.len());
    assert!(!message.chars().any(char::is_control), "{message:?}");
}
