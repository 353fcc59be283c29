//! The intensity measures of the engines: names and the units that the engines fix for them.

use crate::error::{HazardError, Place};
use crate::text::excerpt;

/// Unit of the levels of a measure that `OpenQuake` names.
///
/// # Errors
/// [`HazardError::Row`] for a measure whose unit is not known here.
///
/// # Source
/// `OpenQuake` engine, module `hazardlib.imt`.
pub(super) fn openquake_unit(measure: &str, place: impl FnOnce() -> Place) -> Result<&'static str, HazardError> {
    match measure {
        "PGA" | "AvgSA" => Ok("g"),
        "PGV" => Ok("cm/s"),
        "PGD" => Ok("cm"),
        "IA" => Ok("m/s"),
        "CAV" => Ok("g s"),
        _ if is_spectral_acceleration(measure) => Ok("g"),
        _ => Err(unknown(measure, place())),
    }
}

/// Whether a measure is `SA(0.2)`, or `SA(0.2,10)` with the damping in per cent.
fn is_spectral_acceleration(measure: &str) -> bool {
    const LONGEST: usize = 40;
    let parameters = measure.strip_prefix("SA(").and_then(|rest| rest.strip_suffix(')'));
    let is_number = |text: &str| text.trim().parse::<f64>().is_ok_and(|value| value.is_finite() && value >= 0.0);
    measure.len() <= LONGEST && parameters.is_some_and(|parameters| parameters.split(',').all(is_number))
}

/// Name and unit of a measure that the USGS names: `PGA`, `PGV`, `SA0P2` (0.2 s), or `0.2 s`.
///
/// # Errors
/// [`HazardError::Row`] for another measure.
///
/// # Source
/// nshmp-haz, class `Imt`.
pub(super) fn usgs_measure(name: &str, place: impl FnOnce() -> Place) -> Result<(String, &'static str), HazardError> {
    match name {
        "PGA" => return Ok((name.to_owned(), "g")),
        "PGV" => return Ok((name.to_owned(), "cm/s")),
        _ => {}
    }
    let period = name
        .strip_prefix("SA")
        .map(|period| period.replace('P', "."))
        .or_else(|| name.strip_suffix('s').map(|period| period.trim_end().to_owned()));
    match period.and_then(|period| period.parse::<f64>().ok()) {
        Some(period) if period.is_finite() && period > 0.0 => Ok((spectral_acceleration(period), "g")),
        _ => Err(unknown(name, place())),
    }
}

/// Name of the spectral acceleration at a period, s.
pub(super) fn spectral_acceleration(period_s: f64) -> String {
    format!("SA({period_s:?})")
}

fn unknown(measure: &str, place: Place) -> HazardError {
    let reason = format!(
        "unknown unit of intensity measure {}; export PGA, PGV or SA, or write two columns yourself",
        excerpt(measure)
    );
    HazardError::Row { place, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_openquake() {
        for measure in ["SA(0.2)", "SA(1)", "SA(0.2,10)", "SA(0.2, 10.0)", "PGA"] {
            assert_eq!(openquake_unit(measure, || Place::Point(0)), Ok("g"), "{measure}");
        }
        let long = format!("SA(0.{})", "2".repeat(1000));
        for measure in
            ["SA", "SA(", "SA()", "SA(0.2", "SA(0.2\u{1b}[1m)", "SA(-1)", "SA(nan)", "SA(0.2)g", "sa(0.2)", &long]
        {
            let message = openquake_unit(measure, || Place::Point(0)).unwrap_err().to_string();
            assert!(message.contains("unknown unit of intensity measure") && message.len() < 250, "{message}");
            assert!(!message.contains('\u{1b}'));
        }
    }

    #[test]
    fn names_of_the_usgs() {
        for (name, expected) in [
            ("PGA", Some(("PGA", "g"))),
            ("PGV", Some(("PGV", "cm/s"))),
            ("SA0P2", Some(("SA(0.2)", "g"))),
            ("SA0P075", Some(("SA(0.075)", "g"))),
            ("SA10P0", Some(("SA(10.0)", "g"))),
            ("1.0 s", Some(("SA(1.0)", "g"))),
            ("SA", None),
            ("s", None),
            ("SAinf", None),
            ("AI", None),
        ] {
            let found = usgs_measure(name, || Place::Point(0)).ok();
            assert_eq!(found, expected.map(|(measure, unit)| (measure.to_owned(), unit)), "{name}");
        }
    }
}
