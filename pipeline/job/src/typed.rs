//! Numbers and words as they are typed: what reads the options of jobs on a command line, and an option of many.

use std::ops::RangeInclusive;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Heading of the options that few need.
pub const RARE: &str = "Rarely needed";

/// Whether files that are there are overwritten.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Args)]
pub struct Overwriting {
    /// Overwrite existing outputs (never an input)
    #[arg(long)]
    pub force: bool,
}

/// Reads the `key` of one of `all`.
pub fn one_of<T: Copy + Send + Sync>(
    all: &'static [T],
    key: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.iter().map(|&one| key(one)))
        .try_map(move |word| all.iter().copied().find(|&one| key(one) == word).ok_or("unknown"))
}

/// Reads `0.2` or `2e-4`; of a decimal comma it is said what to write, of a list that one number is wanted.
///
/// # Errors
/// Text that is no number, with what to write.
pub fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    text.parse::<f64>().map_err(|_| {
        let pointed = text.replace(',', ".");
        let is_number = |part: &str| part.trim().parse::<f64>().is_ok();
        match text.split_once(',') {
            Some((whole, decimals)) if is_number(&pointed) && whole.len() + decimals.len() < 5 => {
                format!("the decimal mark is a point: write {pointed}")
            }
            Some(_) if text.split(',').all(is_number) => {
                "give one number, and repeat the command for the others".to_owned()
            }
            None if let Some(quotient) = quotient(text) => format!("write a number, {quotient:e}"),
            _ => "write a number, 0.2 or 2e-4, without a unit".to_owned(),
        }
    })
}

/// Reads a whole number within a range.
pub fn whole_number<T: TryFrom<u64>>(
    range: RangeInclusive<u64>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync {
    move |text| {
        let number = text.trim().parse().ok().filter(|number| range.contains(number));
        let (first, last) = (range.start(), range.end());
        number.and_then(|number| T::try_from(number).ok()).ok_or(format!("write a whole number, {first} to {last}"))
    }
}

/// Several numbers, parted by commas.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers(pub Vec<f64>);

/// Those of an option, however often it is given.
pub fn all_numbers(several: &[Numbers]) -> Vec<f64> {
    several.iter().flat_map(|Numbers(all)| all.iter().copied()).collect()
}

/// Reads `0.1,0.2`; `0,13` is a number with a decimal comma.
///
/// # Errors
/// Text that is no such list, with what to write.
pub fn numbers(text: &str) -> Result<Numbers, String> {
    if let Some(decimals) = text.strip_prefix("0,").filter(|rest| rest.bytes().all(|byte| byte.is_ascii_digit())) {
        return Err(format!("the decimal mark is a point: write 0.{decimals}"));
    }
    text.split(',').map(number).collect::<Result<_, _>>().map(Numbers)
}

/// `1/20000` to three digits; none of other text.
fn quotient(text: &str) -> Option<f64> {
    let (above, below) = text.split_once('/')?;
    let quotient = above.trim().parse::<f64>().ok()? / below.trim().parse::<f64>().ok()?;
    format!("{quotient:.2e}").parse().ok().filter(|quotient: &f64| quotient.is_finite())
}

/// Reads `0.1`, `10%` or `10 %`. What it may be is said where it is used, but per cent outside 0 to 100 are refused
/// here: there `150%` would be called 1.5.
///
/// # Errors
/// Text that is neither, with what to write.
pub fn number_or_per_cent(text: &str) -> Result<f64, String> {
    let value = |number: &str| number.trim().parse::<f64>().map_err(|_| "write a probability, 0.1 or 10%".to_owned());
    let Some(number) = text.trim().strip_suffix('%') else { return value(text) };
    let per_cent = value(number)?;
    if per_cent > 0.0 && per_cent < 100.0 {
        Ok(per_cent / 100.0)
    } else {
        Err("a probability lies between 0 and 100 %".to_owned())
    }
}

/// Reads a probability: `0.1`, `10%` or `10 %`.
///
/// # Errors
/// Text that is none, with what to write.
pub fn probability(text: &str) -> Result<f64, String> {
    let value = number_or_per_cent(text)?;
    if value > 0.0 && value < 1.0 {
        return Ok(value);
    }
    let hint = if value > 1.0 && value < 100.0 { format!("; {value} per cent is {value}%") } else { String::new() };
    Err(format!("a probability lies between 0 and 1{hint}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_is_named() {
        assert_eq!(number(" 2e-4"), Ok(2e-4));
        assert!(number("0,2").is_err_and(|error| error.ends_with("write 0.2")));
        for text in ["475,2475", "1,234,567"] {
            assert!(number(text).is_err_and(|error| error.starts_with("give one number")), "{text}");
        }
        assert_eq!(number("1/20000"), Err("write a number, 5e-5".to_owned()));
        assert!(numbers("0,13").is_err_and(|error| error.contains("write 0.13")));
        assert!(numbers("0.1,x").is_err());
        assert_eq!(numbers("0.1,0.2"), Ok(Numbers(vec![0.1, 0.2])));
        for text in ["0.2 m", "x", "", "1/0", "m/s"] {
            assert!(number(text).is_err_and(|error| error.starts_with("write a number")), "{text}");
        }
    }

    #[test]
    fn numbers_and_per_cent() {
        for (text, value) in [("0.1", 0.1), ("10%", 0.1), ("10 %", 0.1), ("2%", 0.02), ("1e-9", 1e-9), ("0.5 %", 0.005)]
        {
            assert_eq!(probability(text), Ok(value), "{text}");
        }
        for (text, words) in [
            ("10", "10 per cent is 10%"),
            ("0", "between 0 and 1"),
            ("200%", "between 0 and 100 %"),
            ("x", "0.1 or 10%"),
        ] {
            assert!(probability(text).is_err_and(|error| error.contains(words)), "{text}");
        }
    }
}
