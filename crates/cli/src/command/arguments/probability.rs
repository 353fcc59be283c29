//! A probability as it is typed.

/// Reads `0.1`, `10%` or `10 %`, whatever the number.
pub(crate) fn number_or_per_cent(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number.trim_end(), 100.0),
        None => (text.trim(), 1.0),
    };
    Ok(number.parse::<f64>().map_err(|_| "write a probability, 0.1 or 10%".to_owned())? / unit)
}

/// Reads a probability: `0.1`, `10%` or `10 %`.
pub(crate) fn probability(text: &str) -> Result<f64, String> {
    let value = number_or_per_cent(text)?;
    if value > 0.0 && value < 1.0 {
        return Ok(value);
    }
    let hint = if !text.contains('%') && value > 1.0 && value < 100.0 {
        format!("; {value} per cent is {value}%")
    } else {
        String::new()
    };
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
        for (text, words) in
            [("10", "10 per cent is 10%"), ("0", "between 0 and 1"), ("200%", "between"), ("x", "0.1 or 10%")]
        {
            assert!(probability(text).is_err_and(|error| error.contains(words)), "{text}");
        }
    }
}
