//! The reachable hazard nearest to the site's, where no weights give that.

use crate::Words;
use crate::solver::{FIT_RATES, LARGEST_RESIDUAL};

/// A level of y at which the nearest reachable hazard misses the site's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// The site's level of y, in the unit of its curve.
    pub level: f64,
    /// The site's rate of it, 1/yr.
    pub rate_per_year: f64,
    /// The nearest reachable rate of that level over the site's.
    pub times: f64,
    /// The site's level of x at the same rate. Weights can give the site's rate only where some records have, scaled to
    /// it, a y on the other side of `level`.
    pub scaled_to: f64,
}

/// The levels of y that the nearest reachable hazard exceeds most too often, and most too rarely.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Nearest {
    /// Where it is exceeded most too often; none where nowhere more than a tenth.
    pub too_often: Option<Miss>,
    /// Where it is exceeded most too rarely.
    pub too_rarely: Option<Miss>,
}

impl Nearest {
    /// The worst of `misses` on each side, but for those within a tenth.
    pub(crate) fn from_misses(misses: &[Miss; FIT_RATES]) -> Self {
        let by_times = |a: &&Miss, b: &&Miss| a.times.total_cmp(&b.times);
        let most = misses.iter().max_by(by_times).filter(|miss| miss.times.ln() > LARGEST_RESIDUAL);
        let least = misses.iter().min_by(by_times).filter(|miss| miss.times.ln() < -LARGEST_RESIDUAL);
        Self { too_often: most.copied(), too_rarely: least.copied() }
    }

    /// Whether the site's hazard is missed nowhere.
    pub fn is_met(&self) -> bool {
        *self == Self::default()
    }

    /// The side on which it misses more.
    #[must_use]
    pub fn worst_side(&self) -> Self {
        let far = |miss: Option<Miss>| miss.map_or(0.0, |miss| miss.times.ln().abs());
        if far(self.too_often) < far(self.too_rarely) {
            Self { too_often: None, ..*self }
        } else {
            Self { too_rarely: None, ..*self }
        }
    }

    /// How far off it is, and which records would bring it nearer.
    pub fn sentence(&self, words: &Words<'_>) -> String {
        let often = self.too_often.map(|miss| (miss, "below"));
        let rarely = self.too_rarely.map(|miss| (miss, "above"));
        let (mut missed, mut cures) = (Vec::new(), Vec::new());
        for (Miss { level, times, scaled_to, .. }, side) in often.into_iter().chain(rarely) {
            let level = format!("{} {}", three(level), words.other_unit);
            missed.push(format!("{level} is exceeded {} times", three(times)));
            let scaled_to = format!("{} {} {}", words.scaled_to, three(scaled_to), words.scaled_to_unit);
            cures.push(format!("{side} {level} at {scaled_to}"));
        }
        let (missed, cures) = (missed.join(" and "), cures.join(" and "));
        format!("at best, {missed} as often as at the site; add records with {} {cures}", words.other)
    }
}

/// A number with three digits.
pub(crate) fn three(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::with_words;

    #[test]
    fn the_worst_of_each_side_is_named_with_its_cure() {
        let miss = |times: f64| Miss { level: 0.1 * times, rate_per_year: 1e-3, times, scaled_to: 7.0 };
        let met = Nearest::from_misses(&[miss(1.0); FIT_RATES]);
        assert!(met.is_met());
        let mut misses = [miss(1.09); FIT_RATES];
        assert!(Nearest::from_misses(&misses).is_met());
        (misses[2], misses[5], misses[7], misses[9]) = (miss(1.2), miss(1.8123), miss(0.85), miss(0.2));
        let nearest = Nearest::from_misses(&misses);
        assert_eq!((nearest.too_often, nearest.too_rarely), (Some(misses[5]), Some(misses[9])));
        with_words(|words| {
            assert_eq!(
                nearest.sentence(words),
                "at best, 0.181 g is exceeded 1.81 times and 0.02 g is exceeded 0.2 times as often as at the site; \
                 add records with PGA below 0.181 g at PGV 7 cm/s and above 0.02 g at PGV 7 cm/s"
            );
            assert_eq!(
                nearest.worst_side().sentence(words),
                "at best, 0.02 g is exceeded 0.2 times as often as at the site; add records with PGA above 0.02 g at \
                 PGV 7 cm/s"
            );
        });
        let often = Nearest { too_rarely: None, ..nearest };
        assert_eq!(often.worst_side(), often);
    }
}
