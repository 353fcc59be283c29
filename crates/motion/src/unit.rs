//! Units of acceleration at the boundary; inside, everything is in m/s².

use std::str::FromStr;

use crate::error::MotionError;

/// Standard acceleration of gravity \[m/s²\], the default wherever a study sets none.
///
/// # Source
///
/// 3rd General Conference on Weights and Measures (1901).
pub const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Unit in which a file gives acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AccelerationUnit {
    /// Multiples of the acceleration of gravity.
    G,
    /// Metres per second squared.
    MPerS2,
    /// Centimetres per second squared (gal).
    CmPerS2,
}

impl AccelerationUnit {
    /// The words that [`FromStr`] accepts, for messages.
    pub const ACCEPTED: &'static str = "g, m/s2, cm/s2, gal";

    /// Its word, e.g. "cm/s2".
    pub fn symbol(self) -> &'static str {
        match self {
            Self::G => "g",
            Self::MPerS2 => "m/s2",
            Self::CmPerS2 => "cm/s2",
        }
    }

    /// Converts `value`, in this unit, to m/s², with the acceleration of gravity
    /// `gravity_m_s2` \[m/s²\].
    pub fn to_m_s2(self, value: f64, gravity_m_s2: f64) -> f64 {
        match self {
            Self::G => value * gravity_m_s2,
            Self::MPerS2 => value,
            Self::CmPerS2 => value / 100.0,
        }
    }
}

/// Accepts any case, and the usual spellings of "per second squared": `/s2`, `/s^2`, `/s**2`,
/// `/s/s`, `/s²`, `/sec2`, `/sec/sec`.
impl FromStr for AccelerationUnit {
    type Err = MotionError;

    fn from_str(word: &str) -> Result<Self, MotionError> {
        let spelling = word
            .trim()
            .to_lowercase()
            .replace("sec", "s")
            .replace('²', "2")
            .replace(['^', '*'], "")
            .replace("/s/s", "/s2");
        match spelling.as_str() {
            "g" => Ok(Self::G),
            "m/s2" => Ok(Self::MPerS2),
            "cm/s2" | "gal" => Ok(Self::CmPerS2),
            _ => Err(MotionError::UnknownWord {
                what: "unit of acceleration",
                given: word.to_owned(),
                accepted: Self::ACCEPTED,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_acceleration_in_three_units() {
        let g = 9.81;
        for (word, value) in [("g", 0.5), ("m/s2", 4.905), ("cm/s2", 490.5), ("gal", 490.5)] {
            let unit: AccelerationUnit = word.parse().unwrap();
            assert_eq!(unit.symbol().parse::<AccelerationUnit>().unwrap(), unit);
            assert!((unit.to_m_s2(value, g) - 4.905).abs() < 1e-15, "{word}");
        }
    }

    #[test]
    fn spellings() {
        for word in ["CM/S2", "cm/sec/sec", "cm/s^2", "Cm/Sec**2", " gal ", "cm/s²", "cm/s/s"] {
            assert_eq!(word.parse::<AccelerationUnit>().unwrap(), AccelerationUnit::CmPerS2);
        }
    }

    #[test]
    fn unknown_unit_lists_the_known_ones() {
        for word in ["", "mm/s2", "cm/s", "ft/s2", "G G"] {
            let message = word.parse::<AccelerationUnit>().unwrap_err().to_string();
            assert_eq!(message, format!("unknown unit of acceleration \"{word}\"; use one of: g, m/s2, cm/s2, gal"));
        }
    }
}
