//! Two horizontal components of one ground motion, and which of them a planar model receives.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;

/// One of the two horizontal components of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Horizontal {
    /// The first component.
    H1,
    /// The second component.
    H2,
}

impl fmt::Display for Horizontal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::H1 => "h1",
            Self::H2 => "h2",
        })
    }
}

/// Which components of each pair are analysed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Component {
    /// The first of every pair.
    H1,
    /// The second of every pair.
    H2,
    /// Both, as two analyses.
    Both,
    /// One of the two, drawn for every pair.
    Random,
}

impl Component {
    /// The words that [`FromStr`] accepts, for messages.
    pub const ACCEPTED: &'static str = "h1, h2, both, random";

    /// The components to analyse, in order; `drawn` is what [`Component::Random`] yields and is
    /// ignored otherwise.
    pub fn of_pair(self, drawn: Horizontal) -> &'static [Horizontal] {
        match (self, drawn) {
            (Self::Both, _) => &[Horizontal::H1, Horizontal::H2],
            (Self::H1, _) | (Self::Random, Horizontal::H1) => &[Horizontal::H1],
            (Self::H2, _) | (Self::Random, Horizontal::H2) => &[Horizontal::H2],
        }
    }

    /// Number of analyses a pair yields.
    pub fn analyses_per_pair(self) -> usize {
        self.of_pair(Horizontal::H1).len()
    }
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::H1 => "h1",
            Self::H2 => "h2",
            Self::Both => "both",
            Self::Random => "random",
        })
    }
}

/// Accepts any case.
impl FromStr for Component {
    type Err = MotionError;

    fn from_str(word: &str) -> Result<Self, MotionError> {
        match word.trim().to_lowercase().as_str() {
            "h1" => Ok(Self::H1),
            "h2" => Ok(Self::H2),
            "both" => Ok(Self::Both),
            "random" => Ok(Self::Random),
            _ => Err(MotionError::UnknownWord { what: "component", given: word.to_owned(), accepted: Self::ACCEPTED }),
        }
    }
}

/// The two horizontal components of one ground motion.
///
/// They need not have the same length, time step or start.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordPair {
    /// Name of the record in tables and results.
    pub id: String,
    /// First horizontal component.
    pub h1: Accelerogram,
    /// Second horizontal component.
    pub h2: Accelerogram,
    /// What is known about the record (event, magnitude, distance, …), as text.
    pub metadata: BTreeMap<String, String>,
}

impl RecordPair {
    /// One of the two accelerograms.
    pub fn component(&self, which: Horizontal) -> &Accelerogram {
        match which {
            Horizontal::H1 => &self.h1,
            Horizontal::H2 => &self.h2,
        }
    }

    /// The accelerograms to analyse, each with the component it is; `drawn` is what
    /// [`Component::Random`] yields.
    pub fn components(
        &self,
        chosen: Component,
        drawn: Horizontal,
    ) -> impl Iterator<Item = (Horizontal, &Accelerogram)> {
        let which = chosen.of_pair(drawn).iter();
        which.map(|&horizontal| (horizontal, self.component(horizontal)))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn chosen_components() {
        use Horizontal::{H1, H2};
        let motion = |a: f64| Accelerogram::new(0.01, vec![a; 2]).unwrap();
        let pair = RecordPair { id: "RSN1".into(), h1: motion(1.0), h2: motion(2.0), metadata: BTreeMap::new() };
        let chosen = |component, drawn| {
            pair.components(component, drawn).map(|(which, motion)| (which, motion.pga_m_s2())).collect::<Vec<_>>()
        };
        for drawn in [H1, H2] {
            assert_eq!(chosen(Component::H1, drawn), [(H1, 1.0)]);
            assert_eq!(chosen(Component::H2, drawn), [(H2, 2.0)]);
            assert_eq!(chosen(Component::Both, drawn), [(H1, 1.0), (H2, 2.0)]);
        }
        assert_eq!(chosen(Component::Random, H1), [(H1, 1.0)]);
        assert_eq!(chosen(Component::Random, H2), [(H2, 2.0)]);
    }

    #[test]
    fn words() {
        for (word, analyses) in [("h1", 1), ("h2", 1), ("both", 2), ("random", 1)] {
            let component: Component = word.to_uppercase().parse().unwrap();
            assert_eq!(component.to_string(), word);
            assert_eq!(component.analyses_per_pair(), analyses);
        }
        let message = "h3".parse::<Component>().unwrap_err().to_string();
        assert_eq!(message, "unknown component \"h3\"; use one of: h1, h2, both, random");
    }
}
