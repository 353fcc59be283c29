//! Probabilities, shares and return periods as people read them: digits that say something, and never 0 or 100 % of
//! what is neither.

/// Digits of a return period that somebody asks for, 475 or 12,345: one that needs more was not asked for.
const ASKED_DIGITS: usize = 6;
/// Digits of a probability that somebody asks for, 0.02 or 0.0975.
const SHORT_DIGITS: usize = 4;

/// A probability in per cent, four digits of it; one far below that as it is, 1e-9. Near 100 % as many nines as tell it
/// from 100.
pub fn per_cent(probability: f64) -> String {
    if probability > 0.0 && probability < 1e-6 {
        let text = format!("{probability:.5e}");
        return text.parse::<f64>().map_or(text, |short| format!("{short:e}"));
    }
    let value = 100.0 * probability;
    let short = rounded(value, SHORT_DIGITS);
    if short < 100.0 || probability >= 1.0 {
        return format!("{short} %");
    }
    // the first decimals that tell it from certain
    let longer = (1..16).map(|decimals| format!("{value:.decimals$} %"));
    longer.into_iter().find(|text| !text.starts_with("100")).unwrap_or_else(|| "nearly 100 %".to_owned())
}

/// A share in per cent, a decimal of it; what is too little or too much for that is not 0 and not 100 %.
pub fn share(of_all: f64) -> String {
    match of_all {
        little if little > 0.0 && little < 5e-4 => "below 0.1 %".to_owned(),
        most if most < 1.0 && most > 0.9995 => "above 99.9 %".to_owned(),
        _ => format!("{} %", (1000.0 * of_all).round() / 10.0),
    }
}

/// The name of a risk: its probability, `2 %`, or its return period, `475 years`, where that is what was asked for.
pub fn risk_name(poe: f64, years: f64) -> String {
    asked_return_period(poe, years).map_or_else(|| per_cent(poe), |period| format!("{period} years"))
}

/// A risk in words: `2 % in 50 years`, or `475 years (9.991 % in 50 years)`.
pub fn risk_in_words(poe: f64, years: f64) -> String {
    let probability = format!("{}{}", per_cent(poe), in_years(years));
    asked_return_period(poe, years).map_or(probability.clone(), |period| format!("{period} years ({probability})"))
}

/// ` in 50 years`.
fn in_years(years: f64) -> String {
    format!(" in {years} year{}", if years == 1.0 { "" } else { "s" })
}

/// Several risks, parted by `between`: `2 %, 10 % in 50 years`, or `475 years, 2 % in 50 years`.
pub fn risks_in_words(poes: &[f64], years: f64, between: &str) -> String {
    let is_probability = |poe: f64| asked_return_period(poe, years).is_none();
    let behind = in_years(years);
    // behind all of them at once where none is a return period
    if poes.iter().all(|&poe| is_probability(poe)) {
        return poes.iter().map(|&poe| risk_name(poe, years)).collect::<Vec<_>>().join(between) + &behind;
    }
    let name = |&poe: &f64| risk_name(poe, years) + if is_probability(poe) { &behind } else { "" };
    poes.iter().map(name).collect::<Vec<_>>().join(between)
}

/// What the names of several risks are ([`risk_name`]), for the foot of their table: `probabilities in 50 years`; none
/// where all are return periods.
pub fn kind_of_risks(poes: &[f64], years: f64) -> Option<String> {
    let is_probability = |&poe: &f64| asked_return_period(poe, years).is_none();
    poes.iter().any(is_probability).then(|| format!("probabilities{}", in_years(years)))
}

/// The return period that a probability stands for, years, where it is a round number and the probability is none.
fn asked_return_period(poe: f64, years: f64) -> Option<f64> {
    let inside = poe > 0.0 && poe < 1.0;
    if !inside || near(poe, rounded(poe, SHORT_DIGITS), 1e-12) {
        return None;
    }
    // Eq. 4.8; a probability near 1 leaves few digits of the rate
    let exponent = -(-poe).ln_1p();
    let period = years / exponent;
    let tolerance = (4.0 * f64::EPSILON / ((1.0 - poe) * exponent)).clamp(1e-9, 1e-6);
    Some(rounded(period, ASKED_DIGITS)).filter(|&round| near(period, round, tolerance))
}

fn near(value: f64, other: f64, tolerance: f64) -> bool {
    (value - other).abs() <= tolerance * value.abs()
}

/// A number with so many digits.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_period(years: f64, period: f64) -> f64 {
        -(-years / period).exp_m1()
    }

    #[test]
    fn probabilities_have_the_digits_that_say_something() {
        for (probability, said) in [
            (0.02, "2 %"),
            (0.1, "10 %"),
            (0.0025, "0.25 %"),
            (0.099_912_37, "9.991 %"),
            (1e-6, "0.0001 %"),
            (2.5e-7, "2.5e-7"),
            (1e-9, "1e-9"),
            (0.0, "0 %"),
            (1.0, "100 %"),
        ] {
            assert_eq!(per_cent(probability), said);
        }
    }

    #[test]
    fn several_risks_are_probabilities_or_return_periods() {
        assert_eq!(risks_in_words(&[0.02, 0.1], 50.0, " / "), "2 % / 10 % in 50 years");
        let period = of_period(50.0, 475.0);
        assert_eq!(risks_in_words(&[period], 50.0, ", "), "475 years");
        assert_eq!(risks_in_words(&[period, 0.02], 50.0, ", "), "475 years, 2 % in 50 years");
        assert_eq!(kind_of_risks(&[period], 50.0), None);
        assert_eq!(kind_of_risks(&[period, 0.1], 50.0).as_deref(), Some("probabilities in 50 years"));
    }

    #[test]
    fn what_is_not_certain_is_not_a_hundred_per_cent() {
        for (probability, said) in [(0.999, "99.9 %"), (0.9995, "99.95 %"), (0.999_999_9, "99.99999 %")] {
            assert_eq!(per_cent(probability), said);
        }
        for nines in 1..=12 {
            let said = per_cent(1.0 - 10_f64.powi(-nines));
            assert!(said.starts_with('9') && !said.contains("100"), "{nines}: {said}");
        }
        assert_eq!(
            [0.0, 1e-5, 0.078, 0.99999, 1.0].map(share),
            ["0 %", "below 0.1 %", "7.8 %", "above 99.9 %", "100 %"]
        );
    }

    #[test]
    fn a_return_period_that_was_asked_for_is_named() {
        for period in [475.0, 2475.0, 10_000.0, 12_345.0, 72.5, 1e9, 43.0, 3.0, 2.0] {
            let poe = of_period(50.0, period);
            assert_eq!(risk_name(poe, 50.0), format!("{period} years"));
        }
        assert_eq!(risk_in_words(of_period(50.0, 475.0), 50.0), "475 years (9.991 % in 50 years)");
        for poe in [0.02, 0.1, 0.5, 0.0975, 1e-9, 0.999] {
            assert_eq!(risk_name(poe, 50.0), per_cent(poe));
        }
        assert_eq!(risk_in_words(0.02, 50.0), "2 % in 50 years");
        // neither the one nor the other is round
        assert_eq!(risk_name(0.012_345_67, 50.0), "1.235 %");
    }
}
