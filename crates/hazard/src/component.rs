//! Which number stands for the two horizontal components of a ground motion.

use std::fmt;
use std::str::FromStr;

use crate::error::HazardError;
use crate::text::excerpt;

/// How two horizontal components are combined into the one intensity that a hazard curve is about.
///
/// Curves of one definition and records combined by another do not belong together: the ratio RotD100/RotD50 alone is
/// about 1.2 to 1.3.
///
/// # Source
/// Boore, Watson-Lamprey and Abrahamson (2006), "Orientation-independent measures of ground motion"; Boore (2010),
/// "Orientation-independent, nongeometric-mean measures"; Beyer and Bommer (2006), "Relationships between median values
/// and between aleatory variabilities for different definitions of the horizontal component of motion".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ComponentDefinition {
    /// Geometric mean of the two components as recorded.
    GeometricMean,
    /// Median geometric mean over rotations, by one rotation for all periods.
    GmRotI50,
    /// Median over all directions, period by period.
    RotD50,
    /// Maximum over all directions, period by period.
    RotD100,
    /// The larger of the two components as recorded.
    Larger,
    /// One component, whichever it is.
    Arbitrary,
}

impl ComponentDefinition {
    /// Names to suggest in a message.
    pub const ACCEPTED: &'static str = "geometric mean, GMRotI50, RotD50, RotD100, larger, arbitrary";

    /// Every definition.
    pub const ALL: [Self; 6] =
        [Self::GeometricMean, Self::GmRotI50, Self::RotD50, Self::RotD100, Self::Larger, Self::Arbitrary];

    /// Name in files and keys: one of [`ACCEPTED`](Self::ACCEPTED).
    pub fn key(self) -> &'static str {
        match self {
            Self::GeometricMean => "geometric mean",
            Self::GmRotI50 => "GMRotI50",
            Self::RotD50 => "RotD50",
            Self::RotD100 => "RotD100",
            Self::Larger => "larger",
            Self::Arbitrary => "arbitrary",
        }
    }

    /// The definition named by `text` without brackets; none for other text.
    fn named(text: &str) -> Option<Self> {
        const FILLING: [&str; 10] =
            ["component", "components", "horizontal", "of", "the", "two", "both", "as", "recorded", "direction"];
        let lower = text.to_ascii_lowercase();
        let words = lower.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !FILLING.contains(word));
        match words.collect::<String>().as_str() {
            "geometricmean" | "geomean" => Some(Self::GeometricMean),
            "gmroti50" => Some(Self::GmRotI50),
            "rotd50" => Some(Self::RotD50),
            "rotd100" | "maximum" | "maxdir" => Some(Self::RotD100),
            "larger" | "greater" | "envelope" => Some(Self::Larger),
            "arbitrary" | "random" => Some(Self::Arbitrary),
            _ => None,
        }
    }
}

impl fmt::Display for ComponentDefinition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())?;
        match self {
            Self::GeometricMean | Self::GmRotI50 | Self::RotD50 | Self::RotD100 => Ok(()),
            Self::Larger | Self::Arbitrary => f.write_str(" component"),
        }
    }
}

impl FromStr for ComponentDefinition {
    type Err = HazardError;

    /// Case, hyphens and words like "horizontal component" make no difference; what stands in brackets is the more
    /// exact name, as in `geometric mean (GMRotI50)`.
    fn from_str(text: &str) -> Result<Self, HazardError> {
        let found = match text.split_once('(') {
            None => Self::named(text),
            Some((general, exact)) => match (Self::named(general), Self::named(exact.trim_end().trim_end_matches(')')))
            {
                (Some(general), Some(exact)) if general == exact => Some(exact),
                (Some(Self::GeometricMean), Some(Self::GmRotI50)) => Some(Self::GmRotI50),
                _ => None,
            },
        };
        found.ok_or_else(|| HazardError::Component { found: excerpt(text) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ComponentDefinition::*;

    #[test]
    fn spellings() {
        for (text, definition) in [
            ("geometric mean", GeometricMean),
            ("Geometric-mean of the two horizontal components", GeometricMean),
            ("geomean", GeometricMean),
            ("as-recorded geometric mean", GeometricMean),
            ("GMRotI50", GmRotI50),
            (" gm_rot_i50 ", GmRotI50),
            ("geometric mean (GMRotI50)", GmRotI50),
            ("RotD50", RotD50),
            ("rotd50 component", RotD50),
            ("ROTD100", RotD100),
            ("maximum direction (RotD100)", RotD100),
            ("larger", Larger),
            ("larger of the two components", Larger),
            ("Greater of two horizontal", Larger),
            ("envelope", Larger),
            ("arbitrary component", Arbitrary),
            ("random horizontal", Arbitrary),
        ] {
            assert_eq!(text.parse(), Ok(definition), "{text}");
        }
    }

    #[test]
    fn names_are_read_back() {
        for definition in ComponentDefinition::ALL {
            assert_eq!(definition.to_string().parse(), Ok(definition));
        }
        assert_eq!(ComponentDefinition::ALL.map(ComponentDefinition::key).join(", "), ComponentDefinition::ACCEPTED);
    }

    #[test]
    fn anything_else_is_refused() {
        // GMRotD50 is another definition than GMRotI50, and brackets must not contradict what stands before them.
        for text in
            ["", "()", "rock", "mean", "GMRotD50", "geometric mean (GMRotD50)", "RotD50 (larger)", "vertical", "é("]
        {
            assert!(text.parse::<ComponentDefinition>().is_err(), "{text}");
        }
        let message = "\u{1b}GMRotD50".parse::<ComponentDefinition>().unwrap_err().to_string();
        assert_eq!(
            message,
            "unknown component definition \"\\u{1b}GMRotD50\"; use one of geometric mean, GMRotI50, RotD50, \
             RotD100, larger, arbitrary"
        );
    }
}
