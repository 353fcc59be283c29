//! How the peaks of two horizontal components make one intensity.

use std::fmt;
use std::str::FromStr;

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::measure::geometric_mean;
use crate::pair::RecordPair;

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
            Self::RotD50 => Rotated::of(pair).map(|rotated| rotated.median()),
            Self::RotD100 => Rotated::of(pair).map(|rotated| rotated.largest()),
        }
    }

    /// Peaks of `pair` in every combination, in the order of [`Combination::ALL`]; none where the time
    /// steps differ.
    pub fn all_peaks_of(pair: &RecordPair) -> [Option<Peaks>; 3] {
        let rotated = Rotated::of(pair).ok();
        let of_rotated = |peaks: fn(&Rotated) -> Peaks| rotated.as_ref().map(peaks);
        [Some(geometric_mean_of(pair)), of_rotated(Rotated::median), of_rotated(Rotated::largest)]
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

fn geometric_mean_of(RecordPair { h1, h2, .. }: &RecordPair) -> Peaks {
    Peaks {
        pga_m_s2: geometric_mean(h1.pga_m_s2(), h2.pga_m_s2()),
        pgv_m_s: geometric_mean(h1.pgv_m_s(), h2.pgv_m_s()),
    }
}

/// Directions, one a degree; the motion in the opposite direction has the same peak.
const DIRECTIONS: usize = 180;

/// Peaks in every direction, in ascending order.
struct Rotated {
    acceleration_m_s2: Vec<f64>,
    velocity_m_s: Vec<f64>,
}

impl Rotated {
    fn of(pair: &RecordPair) -> Result<Self, MotionError> {
        let (h1_s, h2_s) = (pair.h1.dt_s(), pair.h2.dt_s());
        if h1_s != h2_s {
            return Err(MotionError::UnequalTimeSteps { h1_s, h2_s });
        }
        let [a1, a2] = [&pair.h1, &pair.h2].map(Accelerogram::acceleration_m_s2);
        let [v1, v2] = [&pair.h1, &pair.h2].map(Accelerogram::velocity_m_s);
        let last = |velocity: &[f64]| velocity.last().copied().unwrap_or(0.0);
        let sorted = |mut peaks: Vec<f64>| {
            peaks.sort_unstable_by(f64::total_cmp);
            peaks
        };
        Ok(Self {
            acceleration_m_s2: sorted(rotated_peaks(&together([a1, a2], [0.0; 2]))),
            velocity_m_s: sorted(rotated_peaks(&together([&v1, &v2], [last(&v1), last(&v2)]))),
        })
    }

    fn median(&self) -> Peaks {
        let median = |peaks: &[f64]| 0.5 * (peaks[DIRECTIONS / 2 - 1] + peaks[DIRECTIONS / 2]);
        Peaks { pga_m_s2: median(&self.acceleration_m_s2), pgv_m_s: median(&self.velocity_m_s) }
    }

    fn largest(&self) -> Peaks {
        let largest = |peaks: &[f64]| peaks[DIRECTIONS - 1];
        Peaks { pga_m_s2: largest(&self.acceleration_m_s2), pgv_m_s: largest(&self.velocity_m_s) }
    }
}

/// The points of a plane motion; the shorter component goes on with the value `after` its end.
fn together([x, y]: [&[f64]; 2], after: [f64; 2]) -> Vec<[f64; 2]> {
    let at = |component: &[f64], index: usize, after: f64| component.get(index).copied().unwrap_or(after);
    (0..x.len().max(y.len())).map(|index| [at(x, index, after[0]), at(y, index, after[1])]).collect()
}

/// Farthest of `points` in the `direction`, and how far it reaches.
fn farthest(points: &[[f64; 2]], [cos, sin]: [f64; 2]) -> ([f64; 2], f64) {
    let mut farthest = ([0.0; 2], 0.0);
    for &[x, y] in points {
        let reach = (x * cos + y * sin).abs();
        if reach > farthest.1 {
            farthest = ([x, y], reach);
        }
    }
    farthest
}

/// Peak of x cos θ + y sin θ for every direction.
fn rotated_peaks(points: &[[f64; 2]]) -> Vec<f64> {
    let directions: Vec<[f64; 2]> = (0..DIRECTIONS)
        .map(|degrees| {
            let (sin, cos) = (degrees as f64).to_radians().sin_cos();
            [cos, sin]
        })
        .collect();
    // What a few points reach in every direction, no point nearer to the origin can exceed anywhere.
    let few: Vec<[f64; 2]> = directions.iter().step_by(30).map(|&direction| farthest(points, direction).0).collect();
    let radius = directions.iter().map(|&direction| farthest(&few, direction).1).fold(f64::INFINITY, f64::min);
    // Rounding must not cut a point that matters.
    let squared = radius * radius * (1.0 - 1e-12);
    let far: Vec<[f64; 2]> = points.iter().copied().filter(|[x, y]| x * x + y * y >= squared).collect();
    directions.iter().map(|&direction| farthest(&far, direction).1).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
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
    fn the_shorter_component_goes_on_without_acceleration() {
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
        // All 180 directions over all points, nothing left out.
        #[test]
        fn points_left_out_change_nothing(points in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 2..200)) {
            let plane: Vec<[f64; 2]> = points.iter().map(|&(x, y)| [x, y]).collect();
            for (degrees, found) in rotated_peaks(&plane).into_iter().enumerate() {
                let (sin, cos) = (degrees as f64).to_radians().sin_cos();
                let expected = points.iter().fold(0.0_f64, |m, (x, y)| m.max((x * cos + y * sin).abs()));
                prop_assert_eq!(found, expected);
            }
        }

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
