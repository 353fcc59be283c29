//! How the peaks of two horizontal components make one intensity.

use std::fmt;
use std::str::FromStr;

use crate::error::MotionError;
use crate::measure::geometric_mean;
use crate::pair::RecordPair;
use crate::rotation::{OfDirections, Rotated, largest, median};

/// How the peaks of the two horizontal components of a pair make one intensity.
///
/// A hazard curve must be of the same definition: they differ by 10 to 50 per cent.
///
/// # Source
///
/// The geometric mean: Eq. 4.5 and 4.6. The others: D. M. Boore, "Orientation-independent,
/// nongeometric-mean measures of seismic intensity from two horizontal components of motion",
/// Bull. Seism. Soc. Am. 100 (2010) 1830–1835.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Combination {
    /// Geometric mean √(peak₁ peak₂) of the components as recorded (Eq. 4.5, 4.6).
    #[default]
    GeometricMean,
    /// Median over all directions of the peak of the motion in that direction.
    RotD50,
    /// Largest peak over all directions.
    RotD100,
}

impl Combination {
    /// Every definition.
    pub const ALL: [Self; 3] = [Self::GeometricMean, Self::RotD50, Self::RotD100];

    /// The words that [`FromStr`] accepts, for messages.
    pub const ACCEPTED: &'static str = "geometric-mean, rotd50, rotd100";

    /// Name in files and keys, e.g. "rotd50".
    pub fn key(self) -> &'static str {
        match self {
            Self::GeometricMean => "geometric-mean",
            Self::RotD50 => "rotd50",
            Self::RotD100 => "rotd100",
        }
    }

    /// Name in full, e.g. "geometric mean of two horizontal components".
    pub fn long_name(self) -> &'static str {
        match self {
            Self::GeometricMean => "geometric mean of two horizontal components",
            Self::RotD50 => "median over all horizontal directions (RotD50)",
            Self::RotD100 => "largest over all horizontal directions (RotD100)",
        }
    }

    /// How the values of all directions make one, for the definitions that look at all directions.
    pub(crate) fn over_directions(self) -> Option<OfDirections> {
        match self {
            Self::GeometricMean => None,
            Self::RotD50 => Some(median),
            Self::RotD100 => Some(largest),
        }
    }

    /// Peaks of `pair`: acceleration \[m/s²\] and velocity \[m/s\].
    ///
    /// Motion in a direction is a(θ) = a₁ cos θ + a₂ sin θ, for θ = 0°, 1°, … 179°; the median of
    /// 180 peaks lies halfway between the 90th and the 91st. The components begin together; the
    /// shorter one goes on without acceleration.
    ///
    /// # Errors
    ///
    /// [`MotionError::UnequalTimeSteps`] for a rotated measure where the components have different
    /// time steps.
    pub fn peaks_of(self, pair: &RecordPair) -> Result<Peaks, MotionError> {
        match self {
            Self::GeometricMean => Ok(geometric_mean_of(pair)),
            Self::RotD50 => Rotated::from_pair(pair).map(|rotated| rotated.peaks(median)),
            Self::RotD100 => Rotated::from_pair(pair).map(|rotated| rotated.peaks(largest)),
        }
    }

    /// Peaks of `pair` in every combination, in the order of [`Combination::ALL`]; none where the time
    /// steps differ.
    pub fn all_peaks_of(pair: &RecordPair) -> [Option<Peaks>; 3] {
        let rotated = Rotated::from_pair(pair).ok();
        let of_rotated = |chosen: OfDirections| rotated.as_ref().map(|rotated| rotated.peaks(chosen));
        [Some(geometric_mean_of(pair)), of_rotated(median), of_rotated(largest)]
    }
}

impl fmt::Display for Combination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

/// Accepts any case.
impl FromStr for Combination {
    type Err = MotionError;

    fn from_str(word: &str) -> Result<Self, MotionError> {
        let key = word.trim().to_lowercase();
        Self::ALL.into_iter().find(|combination| combination.key() == key).ok_or_else(|| MotionError::UnknownWord {
            what: "combination of components",
            given: word.to_owned(),
            accepted: Self::ACCEPTED,
        })
    }
}

/// Peaks of a pair in one [`Combination`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// Peak ground acceleration \[m/s²\].
    pub pga_m_s2: f64,
    /// Peak ground velocity \[m/s\].
    pub pgv_m_s: f64,
}

impl Peaks {
    /// Peak ground acceleration \[g\], with the acceleration of gravity `gravity_m_s2` \[m/s²\].
    pub fn pga_g(self, gravity_m_s2: f64) -> f64 {
        self.pga_m_s2 / gravity_m_s2
    }

    /// Peak ground velocity \[cm/s\].
    pub fn pgv_cm_s(self) -> f64 {
        100.0 * self.pgv_m_s
    }
}

fn geometric_mean_of(RecordPair { h1, h2, .. }: &RecordPair) -> Peaks {
    Peaks {
        pga_m_s2: geometric_mean(h1.pga_m_s2(), h2.pga_m_s2()),
        pgv_m_s: geometric_mean(h1.pgv_m_s(), h2.pgv_m_s()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accelerogram::Accelerogram;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    fn pair(dt_s: [f64; 2], h1: Vec<f64>, h2: Vec<f64>) -> RecordPair {
        RecordPair {
            id: "test".into(),
            h1: Accelerogram::new(dt_s[0], h1).unwrap(),
            h2: Accelerogram::new(dt_s[1], h2).unwrap(),
            metadata: BTreeMap::new(),
        }
    }

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found} {expected}");
    }

    // A motion along 30° has the peak |cos(θ - 30°)| in the direction θ. At 90° from it the peak is zero, and
    // 44 pairs of directions lie more than 45° away: the 90th and the 91st in order are the two at 45°.
    #[test]
    fn motion_along_one_line() {
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        let line = pair([0.5; 2], vec![3.0 * cos; 3], vec![3.0 * sin; 3]);
        let peaks = Combination::RotD100.peaks_of(&line).unwrap();
        close(peaks.pga_m_s2, 3.0);
        close(peaks.pgv_m_s, 3.0);
        let median = 3.0 * 45_f64.to_radians().cos();
        let peaks = Combination::RotD50.peaks_of(&line).unwrap();
        close(peaks.pga_m_s2, median);
        close(peaks.pgv_m_s, median);
        close(Combination::GeometricMean.peaks_of(&line).unwrap().pga_m_s2, 3.0 * (sin * cos).sqrt());
    }

    #[test]
    fn the_shorter_component_is_padded_with_zeros() {
        // The first keeps its velocity of 2 m/s while the second comes to 3 m/s.
        let unequal = pair([1.0; 2], vec![2.0, 2.0], vec![0.0, 0.0, 2.0, 2.0]);
        let peaks = Combination::RotD100.peaks_of(&unequal).unwrap();
        assert!((peaks.pgv_m_s / 13_f64.sqrt() - 1.0).abs() < 1e-4, "{}", peaks.pgv_m_s);
        close(peaks.pga_m_s2, 2.0);
        let steps = pair([0.01, 0.02], vec![1.0; 3], vec![1.0; 3]);
        let error = Combination::RotD50.peaks_of(&steps).unwrap_err();
        assert!(matches!(error, MotionError::UnequalTimeSteps { h1_s: 0.01, h2_s: 0.02 }));
        assert!(Combination::GeometricMean.peaks_of(&steps).is_ok());
    }

    #[test]
    fn words() {
        for combination in Combination::ALL {
            assert_eq!(combination.to_string().to_uppercase().parse::<Combination>().unwrap(), combination);
            assert!(Combination::ACCEPTED.contains(combination.key()));
        }
        assert!("larger".parse::<Combination>().is_err());
    }

    proptest! {
        #[test]
        fn rotated_peaks_are_ordered(points in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 2..50)) {
            let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
            let pair = pair([0.01; 2], x, y);
            let half = Combination::RotD50.peaks_of(&pair).unwrap();
            let largest = Combination::RotD100.peaks_of(&pair).unwrap();
            prop_assert_eq!(&Combination::all_peaks_of(&pair)[1..], &[Some(half), Some(largest)]);
            prop_assert!(half.pga_m_s2 <= largest.pga_m_s2 && half.pgv_m_s <= largest.pgv_m_s);
            prop_assert!(largest.pga_m_s2 >= pair.h1.pga_m_s2().max(pair.h2.pga_m_s2()) * (1.0 - 1e-15));
        }
    }
}
