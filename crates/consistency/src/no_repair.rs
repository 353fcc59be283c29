//! Why a set cannot be repaired by weights.

use crate::range::{HighLimit, LowLimit};
use crate::solver::FIT_RATES;
use crate::{Exponents, LeastEffective, RateRange, Reach, Words};

/// Why there is no repaired spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoRepair {
    /// The rates at which both hazards can be compared are too few: no verdict either.
    NarrowRange(RateRange),
    /// No weights give the site's hazard.
    OutOfReach(Reach),
    /// An exponent grew beyond all bounds.
    Runaway {
        /// The exponents.
        exponents: Exponents,
    },
    /// The best weights do not give the site's hazard.
    NotReached {
        /// The largest |ln(implied rate/site's rate)|.
        largest_residual: f64,
    },
    /// The weights leave next to no records.
    TooFew(LeastEffective),
}

impl NoRepair {
    /// A sentence that says it, and what to do.
    pub fn sentence(&self, words: &Words<'_>) -> String {
        let (x, y) = (words.scaled_to, words.other);
        let (lower, higher) = (format!("records of lower {y}/{x}"), format!("records of higher {y}/{x}"));
        match self {
            Self::NarrowRange(range) => {
                let high = match range.high_limit {
                    HighLimit::Target => "1.5 times the largest target rate".to_owned(),
                    HighLimit::FirstStripe => format!("half the rate of the first stripe of {x}"),
                    HighLimit::OtherCurve => format!("half the rate at the first level of the curve of {y}"),
                };
                let low = match range.low_limit {
                    LowLimit::Target => "a quarter of the smallest target rate".to_owned(),
                    LowLimit::LastStripe => format!("twice the rate of the last stripe of {x}"),
                    LowLimit::OtherCurve => format!("twice the rate at the last level of the curve of {y}"),
                };
                format!(
                    "only rates from {:.2e} per year ({high}) down to {:.2e} ({low}) can be compared, less than a \
                     factor of 5: add stripes or levels of the curve there",
                    range.high_per_year, range.low_per_year
                )
            }
            Self::OutOfReach(reach) => {
                let side = |count: usize, side: &str, missing: &str| match count {
                    0 => String::new(),
                    count => format!(
                        "at {count} of {FIT_RATES} rates every record exceeds {y} {side} often than the site's \
                         hazard: {missing} are missing"
                    ),
                };
                let sides = [side(reach.set_above, "more", &lower), side(reach.set_below, "less", &higher)];
                format!(
                    "no weights can give the site's {y}: {}",
                    sides.iter().filter(|text| !text.is_empty()).cloned().collect::<Vec<_>>().join("; ")
                )
            }
            Self::Runaway { exponents } => {
                let largest = exponents.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(f64::NAN);
                let missing = if largest > 0.0 { higher } else { lower };
                format!("the weights run away (exponent {largest:.0}), so that few records are left: add {missing}")
            }
            Self::NotReached { largest_residual } => format!(
                "the best weights still miss the rates of the site's {y} by up to {:.0} %: add {lower} and {higher}{}",
                100.0 * largest_residual.exp_m1(),
                if words.has_level_sets { ", or more records at each level" } else { "" }
            ),
            Self::TooFew(least) => format!(
                "the weights leave {:.1} effective records at the stripe {}, fewer than 5: choose records whose \
                 {y}/{x} is like the site's",
                least.records,
                words.level(least.level)
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::with_words;

    #[test]
    fn each_reason_against_a_repair_has_its_sentence() {
        let range = RateRange {
            high_per_year: 1e-3,
            low_per_year: 5e-4,
            high_limit: HighLimit::FirstStripe,
            low_limit: LowLimit::OtherCurve,
        };
        with_words(|words| {
            for (reason, parts) in [
                (
                    NoRepair::NarrowRange(range),
                    ["1.00e-3 per year (half the rate of the first stripe of PGV)", "5.00e-4"],
                ),
                (
                    NoRepair::OutOfReach(Reach { set_above: 12, set_below: 0 }),
                    ["at 12 of 12 rates every record exceeds PGA more often", "records of lower PGA/PGV are missing"],
                ),
                (
                    NoRepair::OutOfReach(Reach { set_above: 1, set_below: 2 }),
                    ["at 1 of 12", "at 2 of 12 rates every record exceeds PGA less often"],
                ),
                (NoRepair::Runaway { exponents: [0.0, -61.0, 3.0, 0.0] }, ["exponent -61", "add records of lower"]),
                (NoRepair::NotReached { largest_residual: 0.2 }, ["22 %", "records of higher PGA/PGV"]),
                (NoRepair::TooFew(LeastEffective { records: 3.21, level: 2 }), ["3.2 effective", "40 cm/s"]),
            ] {
                let sentence = reason.sentence(words);
                assert!(parts.iter().all(|part| sentence.contains(part)), "{sentence}");
            }
            let of_levels = Words { has_level_sets: true, ..*words };
            let missed = NoRepair::NotReached { largest_residual: 0.2 }.sentence(&of_levels);
            assert!(missed.ends_with("records of higher PGA/PGV, or more records at each level"), "{missed}");
        });
    }
}
