//! The period of an oscillator, as it names a spectral ordinate.

use std::fmt;

/// Natural period of an oscillator, whole microseconds, so that two spellings of one period are one measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Period {
    microseconds: u32,
}

impl Period {
    /// The shortest period \[s\]: that of a hundred cycles a second, which no record holds more of.
    pub const SHORTEST_S: f64 = 0.01;
    /// The longest period \[s\]: beyond it records hold the filter rather than the ground.
    pub const LONGEST_S: f64 = 20.0;

    /// The period of `period_s` \[s\]; none outside [`Period::SHORTEST_S`] to [`Period::LONGEST_S`], or with parts of
    /// a microsecond.
    pub fn from_s(period_s: f64) -> Option<Self> {
        let microseconds = period_s * 1e6;
        let is_whole = (microseconds - microseconds.round()).abs() < 1e-3;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "20 s are 2e7 microseconds")]
        let period = Self { microseconds: microseconds.round() as u32 };
        ((Self::SHORTEST_S..=Self::LONGEST_S).contains(&period_s) && is_whole).then_some(period)
    }

    /// The period \[s\].
    pub fn s(self) -> f64 {
        f64::from(self.microseconds) / 1e6
    }

    /// Its part of a key, with `p` for the decimal point: `1s`, `0p5s`.
    pub(super) fn key(self) -> String {
        format!("{}s", self.s()).replace('.', "p")
    }

    /// Reads `1s`, `0p5s`, `0.5s` or `0.5`, in small letters.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let number = text.trim();
        let number = number.strip_suffix('s').unwrap_or(number).replacen('p', ".", 1);
        let is_decimal = number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
        is_decimal.then(|| number.parse().ok()).flatten().and_then(Self::from_s)
    }
}

/// As engines of hazard write it, seconds with a decimal point: `1.0`, `0.5`.
impl fmt::Display for Period {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.s())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn spellings_of_one_period() {
        let half = Period::from_s(0.5).unwrap();
        for text in ["0p5s", "0.5s", "0.5", "0.50", "00p500s", " .5 "] {
            assert_eq!(Period::parse(text), Some(half), "{text}");
        }
        assert_eq!((half.key().as_str(), half.to_string().as_str()), ("0p5s", "0.5"));
        let one = Period::parse("1s").unwrap();
        assert_eq!((one.key().as_str(), one.to_string().as_str()), ("1s", "1.0"));
    }

    #[test]
    fn no_periods() {
        for text in ["", "s", "0", "0.005s", "20.1", "1e0", "-1", "nan", "inf", "1 s s", "0.1234567", "1p5p5s"] {
            assert_eq!(Period::parse(text), None, "{text}");
        }
    }

    proptest! {
        #[test]
        fn keys_and_names_come_back(microseconds in 10_000..=20_000_000_u32) {
            let period = Period { microseconds };
            prop_assert_eq!(Period::parse(&period.key()), Some(period));
            prop_assert_eq!(Period::parse(&period.to_string()), Some(period));
            prop_assert_eq!(Period::from_s(period.s()), Some(period));
        }
    }
}
