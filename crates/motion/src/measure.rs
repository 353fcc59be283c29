//! Intensity measures of a pair, and the factor that scales it to a level.

use std::fmt;
use std::str::FromStr;

use crate::combination::Peaks;
use crate::error::MotionError;
use crate::pair::RecordPair;

/// Intensity measure on which responses are conditioned.
///
/// A further measure is a further variant; whatever depends on the measure is a `match` over all of them, so that
/// nothing compiles until the new one is given its description, its value in [`IntensityMeasure::of_pair`] and
/// its place elsewhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum IntensityMeasure {
    /// Peak ground velocity \[cm/s\], geometric mean of the two horizontal components (Eq. 4.6).
    Pgv,
    /// Peak ground acceleration \[g\], geometric mean of the two horizontal components (Eq. 4.5).
    Pga,
}

/// How a measure is called.
struct Description {
    label: &'static str,
    key: &'static str,
    unit: &'static str,
    long_name: &'static str,
}

impl IntensityMeasure {
    /// Every measure.
    pub const ALL: [Self; 2] = [Self::Pgv, Self::Pga];

    /// The words that [`FromStr`] accepts, for messages.
    pub const ACCEPTED: &'static str = "pgv, pga";

    fn description(self) -> Description {
        match self {
            Self::Pgv => Description { label: "PGV", key: "pgv", unit: "cm/s", long_name: "peak ground velocity" },
            Self::Pga => Description { label: "PGA", key: "pga", unit: "g", long_name: "peak ground acceleration" },
        }
    }

    /// Short name for text and plots, e.g. "PGV".
    pub fn label(self) -> &'static str {
        self.description().label
    }

    /// Name in files and keys, e.g. "pgv".
    pub fn key(self) -> &'static str {
        self.description().key
    }

    /// Unit of the levels, e.g. "cm/s".
    pub fn unit(self) -> &'static str {
        self.description().unit
    }

    /// Name in full; how the components of a pair are combined belongs to it ([`Combination`](crate::Combination)).
    pub fn long_name(self) -> &'static str {
        self.description().long_name
    }

    /// The measure of an unscaled pair, in [`IntensityMeasure::unit`] (PGV in cm/s, Eq. 4.6; PGA
    /// in g, Eq. 4.5), with the acceleration of gravity `gravity_m_s2` \[m/s²\]; the geometric mean
    /// of the components.
    ///
    /// # Source
    ///
    /// Reggiani Manzo, dissertation, Section 4.3.1.
    pub fn of_pair(self, pair: &RecordPair, gravity_m_s2: f64) -> f64 {
        match self {
            Self::Pgv => 100.0 * geometric_mean(pair.h1.pgv_m_s(), pair.h2.pgv_m_s()),
            Self::Pga => geometric_mean(pair.h1.pga_m_s2(), pair.h2.pga_m_s2()) / gravity_m_s2,
        }
    }

    /// The measure that a pair with these `peaks` has, in [`IntensityMeasure::unit`], with the
    /// acceleration of gravity `gravity_m_s2` \[m/s²\].
    pub fn of_peaks(self, peaks: Peaks, gravity_m_s2: f64) -> f64 {
        match self {
            Self::Pgv => 100.0 * peaks.pgv_m_s,
            Self::Pga => peaks.pga_m_s2 / gravity_m_s2,
        }
    }
}

impl fmt::Display for IntensityMeasure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.label())
    }
}

/// Accepts the key or the label of a measure, in any case.
impl FromStr for IntensityMeasure {
    type Err = MotionError;

    fn from_str(word: &str) -> Result<Self, MotionError> {
        Self::ALL.into_iter().find(|measure| measure.key() == word.trim().to_lowercase()).ok_or_else(|| {
            MotionError::UnknownWord { what: "intensity measure", given: word.to_owned(), accepted: Self::ACCEPTED }
        })
    }
}

/// Geometric mean √(x y) of two values that are not negative, in their unit.
pub fn geometric_mean(x: f64, y: f64) -> f64 {
    (x * y).sqrt()
}

/// Factor by which a pair whose intensity measure is `im_of_pair` is multiplied to reach `level`
/// (both in the unit of the measure). The same factor applies to both components.
///
/// # Errors
///
/// [`MotionError::Scale`] unless `im_of_pair` is finite and above zero (a component without
/// motion has no measure to scale), `level` is finite and not negative, and so is the factor.
pub fn scale_factor(level: f64, im_of_pair: f64) -> Result<f64, MotionError> {
    let factor = level / im_of_pair;
    let measurable = im_of_pair.is_finite() && im_of_pair > 0.0;
    if measurable && level >= 0.0 && factor.is_finite() {
        Ok(factor)
    } else {
        Err(MotionError::Scale { level, measure: im_of_pair })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::accelerogram::Accelerogram;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    fn pair(h1: Vec<f64>, h2: Vec<f64>) -> RecordPair {
        RecordPair {
            id: "test".into(),
            h1: Accelerogram::new(0.5, h1).unwrap(),
            h2: Accelerogram::new(0.25, h2).unwrap(),
            metadata: BTreeMap::new(),
        }
    }

    #[test]
    fn measures_by_hand() {
        // PGA 4 and 9 m/s², PGV 4·0.5 = 2 and 9·0.25·2 = 4.5 m/s.
        let pair = pair(vec![4.0, 4.0], vec![-9.0, -9.0, -9.0]);
        assert_eq!(IntensityMeasure::Pga.of_pair(&pair, 10.0), 0.6);
        assert_eq!(IntensityMeasure::Pgv.of_pair(&pair, 10.0), 300.0);
        assert_eq!(scale_factor(75.0, 300.0).unwrap(), 0.25);
    }

    #[test]
    fn nothing_to_scale() {
        let silent = pair(vec![1.0; 3], vec![0.0; 3]);
        let measure = IntensityMeasure::Pgv.of_pair(&silent, 9.81);
        assert!(scale_factor(10.0, measure).is_err());
        for (level, im) in [
            (1.0, -1.0),
            (1.0, f64::NAN),
            (1.0, f64::INFINITY),
            (-1.0, 1.0),
            (f64::NAN, 1.0),
            (f64::INFINITY, 1.0),
            (1e300, 1e-300),
        ] {
            assert!(scale_factor(level, im).is_err(), "{level} {im}");
        }
    }

    #[test]
    fn names() {
        for measure in IntensityMeasure::ALL {
            assert_eq!(measure.label().parse::<IntensityMeasure>().unwrap(), measure);
            assert_eq!(measure.key().parse::<IntensityMeasure>().unwrap(), measure);
            assert!(IntensityMeasure::ACCEPTED.contains(measure.key()));
        }
        let message = "sa".parse::<IntensityMeasure>().unwrap_err().to_string();
        assert_eq!(message, "unknown intensity measure \"sa\"; use one of: pgv, pga");
    }

    proptest! {
        #[test]
        fn the_geometric_mean_lies_between_and_is_symmetric(x in 0.0..1e3_f64, y in 0.0..1e3_f64) {
            let mean = geometric_mean(x, y);
            prop_assert!(x.min(y) * (1.0 - 1e-15) <= mean && mean <= x.max(y) * (1.0 + 1e-15));
            prop_assert_eq!(mean, geometric_mean(y, x));
            prop_assert!((mean * mean - x * y).abs() <= 1e-15 * x * y);
            prop_assert_eq!(geometric_mean(x, x), x);
        }

        #[test]
        fn the_scaled_pair_has_the_level(
            h1 in prop::collection::vec(0.1..5.0_f64, 2..20),
            h2 in prop::collection::vec(-5.0..-0.1_f64, 2..20),
            level in 0.01..200.0_f64,
        ) {
            let unscaled = pair(h1, h2);
            for measure in IntensityMeasure::ALL {
                let factor = scale_factor(level, measure.of_pair(&unscaled, 9.81)).unwrap();
                let scaled = RecordPair {
                    h1: unscaled.h1.scaled(factor).unwrap(),
                    h2: unscaled.h2.scaled(factor).unwrap(),
                    ..unscaled.clone()
                };
                prop_assert!((measure.of_pair(&scaled, 9.81) / level - 1.0).abs() < 1e-13);
            }
        }
    }
}
