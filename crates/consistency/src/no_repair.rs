//! Why a set cannot be repaired by weights.

use crate::nearest::{Nearest, three};
use crate::range::{HighLimit, LowLimit};
use crate::solver::FIT_RATES;
use crate::{Exponents, LeastEffective, RateRange, Reach, Words};

/// Why there is no repaired spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoRepair {
    /// The rates at which both hazards can be compared are too few: no verdict either.
    NarrowRange(RateRange),
    /// No weights give the site's hazard.
    OutOfReach {
        /// How many rates, and on which side.
        reach: Reach,
        /// The nearest that any weights come at each level by itself.
        nearest: Nearest,
    },
    /// An exponent grew beyond all bounds.
    Runaway {
        /// The exponents.
        exponents: Exponents,
        /// What they come to.
        nearest: Nearest,
    },
    /// The best weights do not give the site's hazard.
    NotReached {
        /// What they give.
        nearest: Nearest,
    },
    /// The weights leave next to no records.
    TooFew {
        /// Where the fewest are left.
        least: LeastEffective,
        /// Geometric mean of y there, under the weights: about what the site's records have.
        other_level: f64,
    },
}

impl NoRepair {
    /// The reachable hazard that is nearest to the site's; none where that is not the reason.
    pub fn nearest(&self) -> Option<&Nearest> {
        match self {
            Self::OutOfReach { nearest, .. } | Self::Runaway { nearest, .. } | Self::NotReached { nearest } => {
                Some(nearest).filter(|nearest| !nearest.is_met())
            }
            Self::NarrowRange(_) | Self::TooFew { .. } => None,
        }
    }

    /// A sentence that says it, and what to do.
    pub fn sentence(&self, words: &Words<'_>) -> String {
        let (x, y) = (words.scaled_to, words.other);
        let (lower, higher) = (format!("records of lower {y}/{x}"), format!("records of higher {y}/{x}"));
        match self {
            Self::NarrowRange(range) => {
                let high = match range.high_limit {
                    HighLimit::Target => "1.5 times the largest target rate".to_owned(),
                    HighLimit::FirstStripe => format!("half the rate at the first level of {x}"),
                    HighLimit::OtherCurve => format!("half the rate at the first level of the curve of {y}"),
                };
                let low = match range.low_limit {
                    LowLimit::Target => "a quarter of the smallest target rate".to_owned(),
                    LowLimit::LastStripe => format!("twice the rate at the last level of {x}"),
                    LowLimit::OtherCurve => format!("twice the rate at the last level of the curve of {y}"),
                };
                format!(
                    "only rates from {:.2e} per year ({high}) down to {:.2e} ({low}) can be compared, less than a \
                     factor of 5: add levels, or points of the curve, there",
                    range.high_per_year, range.low_per_year
                )
            }
            Self::OutOfReach { reach, nearest } => {
                let missing = if reach.set_above > 0 { lower } else { higher };
                let told = if nearest.is_met() {
                    format!("each is missed by less than a tenth; add {missing}")
                } else {
                    nearest.sentence(words)
                };
                format!("no weights give the site's {y} at {} of {FIT_RATES} rates: {told}", reach.out_of_reach())
            }
            Self::Runaway { exponents, nearest } if nearest.is_met() => {
                let largest = exponents.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(f64::NAN);
                let missing = if largest > 0.0 { higher } else { lower };
                format!("the weights run away (exponent {largest:.0}), so that few records are left: add {missing}")
            }
            Self::Runaway { nearest, .. } | Self::NotReached { nearest } => format!(
                "no weights give the site's {y}: {}{}",
                nearest.sentence(words),
                if words.has_level_sets { ", or more records at each level" } else { "" }
            ),
            Self::TooFew { least, other_level } => format!(
                "the weights leave {:.1} effective records at the level {}, fewer than 5: add records with {y} near \
                 {} {} there",
                least.records,
                words.level(least.level),
                three(*other_level),
                words.other_unit
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Miss;
    use crate::words::with_words;

    #[test]
    fn each_reason_against_a_repair_has_its_sentence() {
        let range = RateRange {
            high_per_year: 1e-3,
            low_per_year: 5e-4,
            high_limit: HighLimit::FirstStripe,
            low_limit: LowLimit::OtherCurve,
        };
        let (met, miss) = (Nearest::default(), Miss { level: 0.6, rate_per_year: 1e-3, times: 1.8, scaled_to: 48.0 });
        let nearest = Nearest { too_often: Some(miss), too_rarely: None };
        with_words(|words| {
            for (reason, parts) in [
                (
                    NoRepair::NarrowRange(range),
                    ["1.00e-3 per year (half the rate at the first level of PGV)", "5.00e-4"],
                ),
                (
                    NoRepair::OutOfReach { reach: Reach { set_above: 12, set_below: 0 }, nearest },
                    [
                        "the site's PGA at 12 of 12 rates: at best, 0.6 g is exceeded 1.8 times",
                        "add records with PGA below 0.6 g at",
                    ],
                ),
                (
                    NoRepair::OutOfReach { reach: Reach { set_above: 1, set_below: 2 }, nearest: met },
                    ["at 3 of 12 rates", "by less than a tenth; add records of lower PGA/PGV"],
                ),
                (
                    NoRepair::Runaway { exponents: [0.0, -61.0, 3.0, 0.0], nearest: met },
                    ["exponent -61", "add records of lower"],
                ),
                (
                    NoRepair::Runaway { exponents: [0.0, -61.0, 3.0, 0.0], nearest },
                    ["no weights give the site's PGA: at best, 0.6 g is exceeded 1.8 times", "PGV 48 cm/s"],
                ),
                (NoRepair::NotReached { nearest }, ["0.6 g is exceeded 1.8 times", "below 0.6 g at PGV 48 cm/s"]),
                (
                    NoRepair::TooFew { least: LeastEffective { records: 3.21, level: 2 }, other_level: 0.3141 },
                    ["3.2 effective records at the level 40 cm/s", "PGA near 0.314 g there"],
                ),
            ] {
                let sentence = reason.sentence(words);
                assert!(parts.iter().all(|part| sentence.contains(part)), "{sentence}");
            }
            let of_levels = Words { has_level_sets: true, ..*words };
            let missed = NoRepair::NotReached { nearest }.sentence(&of_levels);
            assert!(missed.ends_with("PGV 48 cm/s, or more records at each level"), "{missed}");
        });
    }
}
