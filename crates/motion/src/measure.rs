//! Intensity measures of a pair, and the factor that scales it to a level.

mod names;
mod period;
mod value;

use crate::error::MotionError;

pub use period::Period;

/// Intensity measure on which responses are conditioned, or which is compared with such.
///
/// A further measure is a further variant; whatever depends on the measure is a `match` over all of them, so that
/// nothing compiles until the new one is given its names, its value of a component and its place elsewhere.
///
/// They rise in the order in which they are reported: PGV first, as in Chapter 4.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum IntensityMeasure {
    /// Peak ground velocity \[cm/s\] (Eq. 4.6).
    Pgv,
    /// Peak ground acceleration \[g\] (Eq. 4.5).
    Pga,
    /// Pseudo-spectral acceleration SA(T) of 5 % damping \[g\].
    Sa(Period),
    /// Average spectral acceleration \[g\]: geometric mean of SA at [`AVERAGED_PERIODS`](crate::AVERAGED_PERIODS)
    /// periods at equal steps, both ends included.
    ///
    /// # Source
    ///
    /// L. Eads, E. Miranda and D. G. Lignos, Earthquake Eng. Struct. Dyn. 44 (2015) 2057–2073.
    AvgSa {
        /// The shortest period.
        from: Period,
        /// The longest period.
        to: Period,
    },
    /// Peak ground displacement \[cm\].
    Pgd,
    /// Cumulative absolute velocity \[cm/s\].
    Cav,
    /// Arias intensity \[cm/s\].
    Arias,
    /// Housner's spectrum intensity \[cm\]: the integral of the pseudo-velocity of 5 % damping from 0.1 to 2.5 s.
    SpectrumIntensity,
    /// Significant duration D5-75 \[s\].
    D575,
    /// Significant duration D5-95 \[s\].
    D595,
}

impl IntensityMeasure {
    /// The measures of Chapter 4, which every study and result knows of its records.
    pub const OF_CHAPTER_4: [Self; 2] = [Self::Pgv, Self::Pga];

    /// The measures that no period belongs to.
    pub const WITHOUT_PERIOD: [Self; 8] =
        [Self::Pgv, Self::Pga, Self::Pgd, Self::Cav, Self::Arias, Self::SpectrumIntensity, Self::D575, Self::D595];

    /// Whether it is one of [`OF_CHAPTER_4`](Self::OF_CHAPTER_4).
    pub fn is_of_chapter_4(self) -> bool {
        Self::OF_CHAPTER_4.contains(&self)
    }

    /// The power of the scale factor with which the measure grows: 1 for what is linear in the acceleration, 2 for the
    /// Arias intensity, 0 for durations.
    pub fn power(self) -> u8 {
        match self {
            Self::Pgv
            | Self::Pga
            | Self::Sa(_)
            | Self::AvgSa { .. }
            | Self::Pgd
            | Self::Cav
            | Self::SpectrumIntensity => 1,
            Self::Arias => 2,
            Self::D575 | Self::D595 => 0,
        }
    }

    /// Whether records can be scaled to its levels: not to those of a duration, which no factor changes.
    pub fn can_be_scaled_to(self) -> bool {
        self.power() > 0
    }

    /// The number that grows as the scale factor does where the measure is `value`, in its unit or its root: of it
    /// `level` over that of a record is the factor.
    pub fn amplitude(self, value: f64) -> f64 {
        if self.power() == 2 { value.sqrt() } else { value }
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
    use super::*;
    use crate::accelerogram::Accelerogram;
    use crate::pair::RecordPair;
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
        assert_eq!(IntensityMeasure::Pga.pair_value(&pair, 10.0), 0.6);
        assert_eq!(IntensityMeasure::Pgv.pair_value(&pair, 10.0), 300.0);
        assert_eq!(scale_factor(75.0, 300.0).unwrap(), 0.25);
    }

    #[test]
    fn nothing_to_scale() {
        let silent = pair(vec![1.0; 3], vec![0.0; 3]);
        let measure = IntensityMeasure::Pgv.pair_value(&silent, 9.81);
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
            let half = Period::from_s(0.5).unwrap();
            let further = [IntensityMeasure::Sa(half), IntensityMeasure::Pgd, IntensityMeasure::Arias];
            for measure in IntensityMeasure::OF_CHAPTER_4.into_iter().chain(further) {
                let [level_amplitude, amplitude] =
                    [level, measure.pair_value(&unscaled, 9.81)].map(|value| measure.amplitude(value));
                let factor = scale_factor(level_amplitude, amplitude).unwrap();
                let scaled = RecordPair {
                    h1: unscaled.h1.scaled(factor).unwrap(),
                    h2: unscaled.h2.scaled(factor).unwrap(),
                    ..unscaled.clone()
                };
                prop_assert!((measure.pair_value(&scaled, 9.81) / level - 1.0).abs() < 1e-12);
            }
        }
    }
}
