//! Numbers as programs in Fortran, C and spreadsheets write them.

/// A finite number in decimal notation, with `E` or `D` exponent; None for anything else.
pub(super) fn parse_number(token: &str) -> Option<f64> {
    // Rust also reads the words "nan" and "infinity": only what looks like a number may pass.
    let numeric = |byte: u8| byte.is_ascii_digit() || b"+-.eEdD".contains(&byte);
    if !token.bytes().all(numeric) {
        return None;
    }
    let value =
        if token.contains(['d', 'D']) { token.replace(['d', 'D'], "E").parse::<f64>() } else { token.parse::<f64>() };
    value.ok().filter(|value| value.is_finite())
}

/// What is wrong with a token that [`parse_number`] refuses.
pub(super) fn why_no_number(token: &str) -> &'static str {
    let word = token.trim_start_matches(['+', '-']).to_lowercase();
    if word.starts_with("nan") || word.starts_with("inf") {
        "is not finite"
    } else if token.contains('*') {
        "is a number too wide for its field: the program that wrote the file lost it"
    } else if token.contains(',') && !word.contains(|c: char| c.is_alphabetic() && c != 'e' && c != 'd') {
        "is not a number: is its comma a decimal mark? Write a point"
    } else if token.parse::<f64>().is_ok_and(f64::is_infinite) {
        "is too large"
    } else {
        "is not a number"
    }
}

/// Appends the numbers of a line of fixed-width fields, between which blanks may be missing; on
/// failure the values are as before and the first bad token is returned.
pub(super) fn numbers_of_line<'a>(line: &'a str, values: &mut Vec<f64>) -> Result<(), &'a str> {
    let before = values.len();
    for token in line.split_whitespace() {
        if numbers_of_token(token, values).is_none() {
            values.truncate(before);
            return fixed_width_fields(line, values).ok_or_else(|| {
                values.truncate(before);
                token
            });
        }
    }
    Ok(())
}

/// Numbers of a token in which a sign may follow directly on a number: "1.2E-02-3.4E-03".
fn numbers_of_token(token: &str, values: &mut Vec<f64>) -> Option<()> {
    let mut rest = token;
    while !rest.is_empty() {
        let bytes = rest.as_bytes();
        let joint = (1..bytes.len()).find(|&i| b"+-".contains(&bytes[i]) && !b"eEdD".contains(&bytes[i - 1]));
        let end = match joint {
            // Fortran drops the letter before an exponent of three digits: "0.1234-101".
            Some(sign) if is_bare_exponent(&bytes[..sign], &bytes[sign + 1..]) => {
                values.push(parse_number(&format!("{}E{}", &rest[..sign], &rest[sign..sign + 4]))?);
                sign + 4
            }
            joint => {
                let end = joint.unwrap_or(bytes.len());
                values.push(parse_number(&rest[..end])?);
                end
            }
        };
        rest = &rest[end..];
    }
    Some(())
}

/// Whether exactly three digits follow the sign after a mantissa with a point: no value of a
/// fixed-width field lacks the point, so they can only be its exponent.
fn is_bare_exponent(mantissa: &[u8], after_sign: &[u8]) -> bool {
    let digits = after_sign.iter().take_while(|b| b.is_ascii_digit()).count();
    let ends = after_sign.get(3).is_none_or(|next| b"+-".contains(next));
    digits == 3 && ends && mantissa.contains(&b'.') && !mantissa.iter().any(|b| b"eEdD".contains(b))
}

/// Numbers of equally wide fields without any blank between them: each has one decimal point, so
/// the points tell how many fields the line has.
fn fixed_width_fields(line: &str, values: &mut Vec<f64>) -> Option<()> {
    let line = line.trim_end();
    let fields = line.bytes().filter(|&byte| byte == b'.').count();
    if fields < 2 || !line.is_ascii() || !line.len().is_multiple_of(fields) {
        return None;
    }
    let width = line.len() / fields;
    for start in (0..line.len()).step_by(width) {
        values.push(parse_number(line[start..start + width].trim_start())?);
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(line: &str) -> Result<Vec<f64>, &str> {
        let mut values = vec![7.0];
        let result = numbers_of_line(line, &mut values);
        assert_eq!(values.remove(0), 7.0);
        assert!(result.is_ok() || values.is_empty());
        result.map(|()| values)
    }

    #[test]
    fn notations() {
        for (token, value) in [
            ("1", 1.0),
            ("-.5", -0.5),
            ("+3.", 3.0),
            ("1.0D-03", 1e-3),
            ("-1.5d+2", -150.0),
            (".1611850E-03", 1.611_85e-4),
            ("1e-400", 0.0),
        ] {
            assert_eq!(parse_number(token), Some(value), "{token}");
        }
    }

    #[test]
    fn refusals_say_why() {
        for (token, reason) in [
            ("nan", "not finite"),
            ("-Infinity", "not finite"),
            ("1e999", "too large"),
            ("0,012", "decimal mark"),
            ("*****", "too wide"),
            ("abc", "not a number"),
            ("", "not a number"),
            ("1.2.3", "not a number"),
            ("e", "not a number"),
            ("0x10", "not a number"),
            ("1_000", "not a number"),
        ] {
            assert_eq!(parse_number(token), None, "{token}");
            assert!(why_no_number(token).contains(reason), "{token}: {}", why_no_number(token));
        }
    }

    #[test]
    fn signs_that_join_numbers() {
        assert_eq!(numbers("1.23E-02-4.56E-03"), Ok(vec![1.23e-2, -4.56e-3]));
        assert_eq!(numbers("  -1.5-2.5 +3.5-4.5D-01+1."), Ok(vec![-1.5, -2.5, 3.5, -0.45, 1.0]));
        assert_eq!(numbers("0.5-101"), Ok(vec![0.5e-101]));
        assert_eq!(numbers("0.5-101-0.25+102"), Ok(vec![0.5e-101, -0.25e102]));
        assert_eq!(numbers("0.5-101."), Ok(vec![0.5, -101.0]));
    }

    #[test]
    fn fields_that_touch() {
        assert_eq!(
            numbers("0.6503965E-030.6521557E-03-.6515572E-03 .6529259E-03"),
            Ok(vec![0.650_396_5e-3, 0.652_155_7e-3, -0.651_557_2e-3, 0.652_925_9e-3])
        );
        assert_eq!(numbers(" 0.00121212.002345 -.001234  \r"), Ok(vec![0.001_212, 12.002_345, -0.001_234]));
    }

    #[test]
    fn the_first_bad_token() {
        assert_eq!(numbers("0.1 0.2 0.3x 0.4y"), Err("0.3x"));
        assert_eq!(numbers("0.1 nan"), Err("nan"));
        assert_eq!(numbers("0.1 --0.2"), Err("--0.2"));
        assert_eq!(numbers("0.1 é.2"), Err("é.2"));
        assert_eq!(numbers(" "), Ok(vec![]));
    }
}
