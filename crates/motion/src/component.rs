//! In which directions of a pair a planar model is shaken.

use std::fmt;

use serde::Serialize;

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::pair::{Horizontal, RecordPair};
use crate::rotation::turned;

/// What of each pair is analysed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Component {
    /// The first component of every pair.
    H1,
    /// The second of every pair.
    H2,
    /// Both, as two analyses.
    Both,
    /// One of the two, drawn for every pair.
    Random,
    /// The pair as it is seen from other azimuths.
    Rotated(Rotation),
}

/// From which azimuths θ a pair is seen: a(θ) = h1 cos θ + h2 sin θ. A symmetric structure peaks alike at θ and
/// θ + 180°, so azimuths are below 180°. It is serialised as the section of a study file.
///
/// # Source
/// D. M. Boore (2010), "Orientation-independent, nongeometric-mean measures of seismic intensity from two horizontal
/// components of motion", of measures; here the same is asked of the response.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(tag = "take", rename_all = "lowercase")]
pub enum Rotation {
    /// From one, drawn for every pair.
    Random,
    /// From so many, evenly spaced from 0° on, each a record of its own.
    Each {
        /// How many.
        azimuths: u8,
    },
    /// From so many, evenly spaced from 0° on; the record's peak is a percentile of theirs.
    Percentile {
        /// How many.
        azimuths: u8,
        /// The smallest peak that so many per cent of the azimuths do not exceed: 100 is the worst.
        percentile: u8,
    },
}

/// What chance gives a pair, for those that ask it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawn {
    /// For [`Component::Random`].
    pub horizontal: Horizontal,
    /// For [`Rotation::Random`], degrees from 0 to 180.
    pub azimuth_deg: f64,
}

/// One record of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    /// A component.
    Component(Horizontal),
    /// The pair seen from an azimuth, degrees from h1 towards h2.
    Azimuth(f64),
    /// A percentile of the peaks from so many azimuths.
    Percentile {
        /// How many, evenly spaced from 0° on.
        azimuths: u8,
        /// As of [`Rotation::Percentile`].
        percentile: u8,
    },
}

/// `azimuths` evenly spaced over 180°, from 0° on.
fn azimuths_deg(azimuths: u8) -> impl Iterator<Item = f64> {
    (0..azimuths).map(move |index| 180.0 * f64::from(index) / f64::from(azimuths))
}

impl Component {
    /// The records that a pair yields, in order.
    pub fn directions(self, drawn: Drawn) -> Vec<Direction> {
        use Horizontal::{H1, H2};
        match self {
            Self::H1 => vec![Direction::Component(H1)],
            Self::H2 => vec![Direction::Component(H2)],
            Self::Both => vec![Direction::Component(H1), Direction::Component(H2)],
            Self::Random => vec![Direction::Component(drawn.horizontal)],
            Self::Rotated(Rotation::Random) => vec![Direction::Azimuth(drawn.azimuth_deg)],
            Self::Rotated(Rotation::Each { azimuths }) => azimuths_deg(azimuths).map(Direction::Azimuth).collect(),
            Self::Rotated(Rotation::Percentile { azimuths, percentile }) => {
                vec![Direction::Percentile { azimuths, percentile }]
            }
        }
    }

    /// Number of records that a pair yields.
    pub fn records_per_pair(self) -> usize {
        match self {
            Self::H1 | Self::H2 | Self::Random | Self::Rotated(Rotation::Random | Rotation::Percentile { .. }) => 1,
            Self::Both => 2,
            Self::Rotated(Rotation::Each { azimuths }) => usize::from(azimuths),
        }
    }

    /// Whether chance decides what a pair yields.
    pub fn is_drawn(self) -> bool {
        matches!(self, Self::Random | Self::Rotated(Rotation::Random))
    }

    /// The word for it, `h1` or `rotated`.
    pub fn key(self) -> &'static str {
        match self {
            Self::H1 => "h1",
            Self::H2 => "h2",
            Self::Both => "both",
            Self::Random => "random",
            Self::Rotated(_) => "rotated",
        }
    }
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())?;
        match self {
            Self::Rotated(rotation) => write!(f, " ({rotation})"),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Rotation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Random => f.write_str("a random azimuth a pair"),
            Self::Each { azimuths } => write!(f, "each of {azimuths} azimuths"),
            Self::Percentile { azimuths, percentile: 100 } => write!(f, "the worst of {azimuths} azimuths"),
            Self::Percentile { azimuths, percentile } => write!(f, "percentile {percentile} of {azimuths} azimuths"),
        }
    }
}

/// As a table says what was analysed, and an identifier of a record after that of its pair.
impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Component(horizontal) => horizontal.fmt(f),
            // azimuths are no closer than a degree, and drawn ones have two decimals
            Self::Azimuth(degrees) => write!(f, "{}deg", (degrees * 100.0).round() / 100.0),
            Self::Percentile { azimuths, percentile } => write!(f, "percentile {percentile} of {azimuths} azimuths"),
        }
    }
}

impl RecordPair {
    /// What shakes a planar model along `direction`: one motion, or one an azimuth of a percentile.
    ///
    /// # Errors
    /// [`MotionError::UnequalTimeSteps`] of components that are to be added; no motion where their sum is not finite.
    pub fn along(&self, direction: Direction) -> Result<Vec<Accelerogram>, MotionError> {
        match direction {
            Direction::Component(horizontal) => Ok(vec![self.component(horizontal).clone()]),
            Direction::Azimuth(degrees) => Ok(vec![turned(self, degrees)?]),
            Direction::Percentile { azimuths, .. } => {
                azimuths_deg(azimuths).map(|degrees| turned(self, degrees)).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use Horizontal::{H1, H2};

    fn pair(h1: &[f64], h2: &[f64]) -> RecordPair {
        let motion = |samples: &[f64]| Accelerogram::new(0.01, samples.to_vec()).unwrap();
        RecordPair { id: "RSN1".into(), h1: motion(h1), h2: motion(h2), metadata: BTreeMap::new() }
    }

    fn drawn(horizontal: Horizontal) -> Drawn {
        Drawn { horizontal, azimuth_deg: 12.34 }
    }

    #[test]
    fn what_a_pair_yields() {
        let component = |which| Direction::Component(which);
        for chance in [H1, H2].map(drawn) {
            assert_eq!(Component::H1.directions(chance), [component(H1)]);
            assert_eq!(Component::H2.directions(chance), [component(H2)]);
            assert_eq!(Component::Both.directions(chance), [component(H1), component(H2)]);
            assert_eq!(Component::Random.directions(chance), [component(chance.horizontal)]);
            assert_eq!(Component::Rotated(Rotation::Random).directions(chance), [Direction::Azimuth(12.34)]);
            let each = Component::Rotated(Rotation::Each { azimuths: 4 });
            assert_eq!(each.directions(chance), [0.0, 45.0, 90.0, 135.0].map(Direction::Azimuth));
            let worst = Component::Rotated(Rotation::Percentile { azimuths: 4, percentile: 100 });
            for asked in [Component::H1, Component::Both, Component::Random, each, worst] {
                assert_eq!(asked.directions(chance).len(), asked.records_per_pair());
            }
        }
    }

    /// At 0° the pair is its first component and at 90° its second, to the bit and the last sample.
    #[test]
    fn quarter_turns_are_the_components() {
        let pair = pair(&[0.3, -0.0, 1e-300, 0.1], &[0.7, 5e-324, -0.2]);
        let bits = |motion: &Accelerogram| -> Vec<u64> {
            motion.acceleration_m_s2().iter().map(|value| value.to_bits()).collect()
        };
        let along = |degrees| pair.along(Direction::Azimuth(degrees)).unwrap().remove(0);
        assert_eq!(bits(&along(0.0)), bits(&pair.h1));
        assert_eq!(bits(&along(90.0)), bits(&pair.h2));
        // the shorter component goes on with zero
        let expected = [(0.3 + 0.7) * 0.5_f64.sqrt(), 0.0, -0.2 * 0.5_f64.sqrt(), 0.1 * 0.5_f64.sqrt()];
        // three roundings of numbers below 1
        let found = along(45.0);
        for (found, expected) in found.acceleration_m_s2().iter().zip(expected) {
            assert!((found - expected).abs() < 4e-16, "{found} {expected}");
        }
        let half = pair.along(Direction::Percentile { azimuths: 2, percentile: 100 }).unwrap();
        assert_eq!(half, [pair.h1.clone(), pair.h2.clone()]);
    }

    /// A vector that turns as the azimuth does is seen alike from every azimuth, a moment later.
    #[test]
    fn a_circular_motion_looks_the_same_from_everywhere() {
        let steps = 360;
        let angle = |step: u32| f64::from(step).to_radians();
        let samples = |of: fn(f64) -> f64| (0..2 * steps).map(|step| of(angle(step))).collect::<Vec<f64>>();
        let pair = pair(&samples(f64::cos), &samples(f64::sin));
        for degrees in [0.0, 30.0, 77.0, 179.0] {
            let seen = turned(&pair, degrees).unwrap();
            let at = |step: u32| seen.acceleration_m_s2()[step as usize];
            for step in 0..steps {
                let expected = (angle(step) - degrees.to_radians()).cos();
                assert!((at(step) - expected).abs() < 1e-14, "{degrees} {step}");
            }
        }
    }

    #[test]
    fn components_of_different_time_steps_are_not_added() {
        let mut pair = pair(&[1.0, 2.0], &[1.0, 2.0]);
        pair.h2 = Accelerogram::new(0.02, vec![1.0, 2.0]).unwrap();
        assert!(matches!(pair.along(Direction::Azimuth(30.0)), Err(MotionError::UnequalTimeSteps { .. })));
        assert!(pair.along(Direction::Component(H2)).is_ok());
    }

    #[test]
    fn words() {
        let rotated = |rotation| Component::Rotated(rotation).to_string();
        assert_eq!([Component::H1, Component::Both].map(|component| component.to_string()), ["h1", "both"]);
        assert_eq!(rotated(Rotation::Random), "rotated (a random azimuth a pair)");
        assert_eq!(rotated(Rotation::Each { azimuths: 12 }), "rotated (each of 12 azimuths)");
        let percentile = |percentile| Rotation::Percentile { azimuths: 12, percentile };
        assert_eq!(rotated(percentile(100)), "rotated (the worst of 12 azimuths)");
        assert_eq!(rotated(percentile(50)), "rotated (percentile 50 of 12 azimuths)");
        assert_eq!(Direction::Azimuth(180.0 / 7.0).to_string(), "25.71deg");
        assert_eq!(Direction::Component(H2).to_string(), "h2");
    }
}
