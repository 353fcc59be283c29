//! Tables, numbers and texts as the terminal and the page show them.

mod risk;
mod table;
mod typed;
mod visible;

pub use risk::{kind_of_risks, per_cent, risk_in_words, risk_name, risks_in_words, rounded, share};
pub use table::{Table, TableOf};
pub use typed::{shown_path, typed, typed_path};
pub use uplift_plausible::counted;
pub use visible::{is_obeyed, one_line, visible};

/// A number for a table or JSON, which have no infinity and no NaN: none for these. Zero has no sign there.
pub fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value + 0.0)
}

/// Which spectrum, by the measure that records are scaled to: `PGV`, or `PGV, repaired`.
pub fn spectrum_words(measure: &str, repaired: bool) -> String {
    if repaired { format!("{measure}, repaired") } else { measure.to_owned() }
}

/// Which hazard repaired numbers are of at a site with weighted curves: their bands have no second one over these.
pub const HAZARD_OF_REPAIR: &str = "the mean of the weighted hazard curves; their spread is left out";

/// What is in a list, each once, in the order of the list.
pub fn distinct<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for own in all {
        if !found.contains(&own) {
            found.push(own);
        }
    }
    found
}

/// Positions of the values nearest to those `wanted`, each once.
pub fn nearest(values: &[f64], wanted: &[f64]) -> Vec<usize> {
    let distance = |index: usize, wanted: f64| (values[index] - wanted).abs();
    let mut found: Vec<usize> = wanted
        .iter()
        .filter_map(|&wanted| (0..values.len()).min_by(|&a, &b| distance(a, wanted).total_cmp(&distance(b, wanted))))
        .collect();
    found.dedup();
    found
}

/// A displacement in metres to the tenth of a millimetre.
pub fn metres(value: f64) -> String {
    if value.is_infinite() { "censored".to_owned() } else { format!("{value:.4}") }
}

/// A displacement of a structure in metres to the tenth of a millimetre; "overturns" where it is infinite.
pub fn metres_or_overturns(value_m: f64) -> String {
    if value_m.is_infinite() { "overturns".to_owned() } else { format!("{value_m:.4}") }
}

/// The relative error of a demand: `+12.3 %`, or `×25` from ten times the demand on. It is infinite where a structure
/// that stands was expected to overturn, and NaN where there is none.
pub fn relative_error_in_words(error: f64) -> String {
    match error {
        _ if error.is_nan() => "-".to_owned(),
        _ if error.is_infinite() => "too safe".to_owned(),
        _ if error >= 9.0 => format!("×{}", two_digits(1.0 + error)),
        _ => format!("{:+.1} %", 100.0 * error),
    }
}

/// A displacement with the two digits that a record set can tell.
pub fn two_digits(value: f64) -> String {
    significant(value, 2)
}

/// A peak of a single motion with three digits: the others change with the last digits of the motion.
pub fn three_digits(value: f64) -> String {
    significant(value, 3)
}

/// A number with so many digits that count.
fn significant(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return "-".to_owned();
    }
    if value.is_infinite() {
        return "∞".to_owned();
    }
    // what rounding makes of it decides where the first digit stands
    let after_first = digits - 1;
    let written = format!("{value:.after_first$e}");
    let exponent = written.split_once('e').and_then(|(_, exponent)| exponent.parse::<isize>().ok()).unwrap_or(0);
    let value = written.parse::<f64>().unwrap_or(value);
    let decimals = if value == 0.0 { 0 } else { after_first.saturating_add_signed(-exponent) };
    format!("{value:.decimals$}")
}

/// A length as an engineer rounds it, m: `1.05`, and below 0.1 m two digits, `0.014`.
pub fn to_the_centimetre(value_m: f64) -> String {
    if value_m.abs() < 0.1 { two_digits(value_m) } else { format!("{value_m:.2}") }
}

/// A displacement with its confidence band in a sentence: `0.35 m (0.24 to 0.84)`.
pub fn metres_with_band(u_m: f64, band_m: Option<[f64; 2]>) -> String {
    with_band((u_m, band_m), " m", ["", " to "])
}

/// The same where nothing else says what the brackets hold: `0.35 m (90 % band 0.24 to 0.84)`.
pub fn metres_with_named_band(u_m: f64, band_m: Option<[f64; 2]>, confidence: f64) -> String {
    with_band((u_m, band_m), " m", [&format!("{} band ", per_cent(confidence)), " to "])
}

/// The same in a cell of a table, whose heading has the unit: `0.35 (0.24–0.84)`.
pub fn cell_with_band(u_m: f64, band_m: Option<[f64; 2]>) -> String {
    with_band((u_m, band_m), "", ["", "–"])
}

/// A displacement in a unit, with what opens its band and what parts the limits.
fn with_band((u_m, band_m): (f64, Option<[f64; 2]>), unit: &str, [opening, between]: [&str; 2]) -> String {
    match band_m.map(|limits_m| limits_m.map(two_digits)) {
        _ if u_m.is_nan() => "none".to_owned(),
        Some([lower, _]) if u_m.is_infinite() && lower != "∞" => {
            format!("overturns ({opening}lower limit {lower}{unit})")
        }
        _ if u_m.is_infinite() => "overturns".to_owned(),
        Some([lower, upper]) => format!("{}{unit} ({opening}{lower}{between}{upper})", two_digits(u_m)),
        None => two_digits(u_m) + unit,
    }
}

/// A number with a few digits, in powers of ten where it is very large or small.
pub fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        let digits = 5_usize.saturating_sub(format!("{:.0}", value.abs().trunc()).len()).max(1);
        format!("{value:.digits$}")
    } else {
        format!("{value:.3e}")
    }
}

/// A frequency a year, or a bound of it, with the two digits that a record set can tell: `7.4e-5`; `0` for none.
pub fn rate(per_year: f64) -> String {
    if per_year == 0.0 { "0".to_owned() } else { format!("{per_year:.1e}") }
}

/// A size in bytes, in kB, MB or GB.
pub fn bytes(number: u64) -> String {
    match number {
        ..1_000_000 => format!("{} kB", number.div_ceil(1000)),
        1_000_000..1_000_000_000 => format!("{} MB", number.div_ceil(1_000_000)),
        _ => format!("{:.1} GB", number as f64 / 1e9),
    }
}

/// What there is of a need in [`bytes`], rounded down: as much as is needed is never there where it is not.
pub fn bytes_free(number: u64) -> String {
    let unit = match number {
        ..1_000_000 => 1000,
        1_000_000..1_000_000_000 => 1_000_000,
        _ => 100_000_000,
    };
    bytes(number - number % unit)
}

/// "60 records of 30 pairs", where pairs have several; else "30 records", "1 record".
pub fn records_in_words(records: usize, pairs: usize) -> String {
    let of_pairs = if pairs < records { format!(" of {}", counted(pairs, "pair")) } else { String::new() };
    counted(records, "record") + &of_pairs
}

/// What a plan costs: `30 pairs x 26 levels = 780 analyses`.
pub fn cost_in_words(factors: &[String], analyses: u64) -> String {
    let plural = if analyses == 1 { "analysis" } else { "analyses" };
    format!("{} = {} {plural}", factors.join(" x "), thousands(analyses))
}

/// A whole number with its thousands set apart.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (position, digit) in digits.chars().enumerate() {
        if position > 0 && (digits.len() - position).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Names listed in a message before the rest are counted.
const NAMES_SHOWN: usize = 10;

/// The first of some names, and how many more there are.
pub fn first_names<S: AsRef<str>>(names: &[S]) -> String {
    let shown: Vec<&str> = names.iter().take(NAMES_SHOWN).map(AsRef::as_ref).collect();
    let more = names.len() - shown.len();
    if more > 0 { format!("{} and {more} more", shown.join(", ")) } else { shown.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(thousands(2_370_375), "2,370,375");
        assert_eq!(thousands(12), "12");
        assert_eq!(metres(f64::INFINITY), "censored");
    }

    #[test]
    fn what_is_there_is_rounded_down_and_what_is_needed_up() {
        for (number, needed, free) in [(1_020_000, "2 MB", "1 MB"), (1500, "2 kB", "1 kB"), (3_000_000, "3 MB", "3 MB")]
        {
            assert_eq!((bytes(number).as_str(), bytes_free(number).as_str()), (needed, free));
        }
    }

    #[test]
    fn one_is_no_plural() {
        assert_eq!([1.0, 50.0].map(|years| risk_in_words(0.001, years)), ["0.1 % in 1 year", "0.1 % in 50 years"]);
        let told = [(60, 30), (30, 30), (2, 1), (1, 1)].map(|(records, pairs)| records_in_words(records, pairs));
        assert_eq!(told, ["60 records of 30 pairs", "30 records", "2 records of 1 pair", "1 record"]);
        let factors = |counts: [usize; 2]| [counted(counts[0], "pair"), counted(counts[1], "level")];
        assert_eq!(cost_in_words(&factors([30, 26]), 780), "30 pairs x 26 levels = 780 analyses");
        assert_eq!(cost_in_words(&factors([1, 1]), 1), "1 pair x 1 level = 1 analysis");
    }

    #[test]
    fn displacements_have_two_digits_and_a_band() {
        assert_eq!(
            ["0.35", "0.10", "0.034", "1.2", "12", "0.00034"],
            [0.346, 0.0996, 0.0341, 1.24, 12.3, 3.4e-4].map(two_digits)
        );
        assert_eq!(["0.346", "0.0997", "1.23", "1230"], [0.34561, 0.09966, 1.2345, 1234.5].map(three_digits));
        assert_eq!(cell_with_band(0.346, Some([0.24, f64::INFINITY])), "0.35 (0.24–∞)");
        assert_eq!(metres_with_band(0.346, Some([0.24, 0.841])), "0.35 m (0.24 to 0.84)");
        assert_eq!(metres_with_band(f64::INFINITY, Some([0.24, f64::INFINITY])), "overturns (lower limit 0.24 m)");
        assert_eq!([metres_with_band(f64::INFINITY, None), metres_with_band(f64::NAN, None)], ["overturns", "none"]);
        assert_eq!([metres_with_band(0.5, None), cell_with_band(0.5, None)], ["0.50 m", "0.50"]);
    }

    #[test]
    fn each_nearest_value_once() {
        assert_eq!(nearest(&[0.0, 0.1, 0.3], &[0.11, 0.12, 0.4]), [1, 2]);
        assert!(nearest(&[], &[0.1]).is_empty());
    }
}
