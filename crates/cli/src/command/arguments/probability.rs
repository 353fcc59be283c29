//! A probability as it is typed.

/// Reads `0.1`, `10%` or `10 %`. What it may be is said where it is used, but per cent outside 0 to 100 are refused
/// here: there `150%` would be called 1.5.
pub(crate) fn number_or_per_cent(text: &str) -> Result<f64, String> {
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
pub(crate) fn probability(text: &str) -> Result<f64, String> {
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
