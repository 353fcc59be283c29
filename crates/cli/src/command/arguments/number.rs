//! A number as it is typed.

/// Reads `0.2` or `2e-4`; of a decimal comma it is said what to write.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    text.parse::<f64>().map_err(|_| {
        let pointed = text.replace(',', ".");
        match pointed.parse::<f64>() {
            Ok(_) => format!("{text} has a decimal comma, and the decimal mark is a point: write {pointed}"),
            Err(_) => "write a number, 0.2 or 2e-4, without a unit".to_owned(),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_is_named() {
        assert_eq!(number(" 2e-4"), Ok(2e-4));
        assert!(number("0,2").is_err_and(|error| error.ends_with("write 0.2")));
        for text in ["1,234,567", "0.2 m", "x", ""] {
            assert!(number(text).is_err_and(|error| error.starts_with("write a number")), "{text}");
        }
    }
}
