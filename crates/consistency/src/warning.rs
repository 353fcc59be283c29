//! What deserves a look in a repaired set.

use crate::range::HighLimit;
use crate::{Diagnosis, ScaledAnalysis};

/// A record that has more than this share at a stripe is named.
const LARGEST_RECORD_SHARE: f64 = 0.25;

/// An event that has more than this share at a stripe is named.
const LARGEST_EVENT_SHARE: f64 = 0.5;

/// ln q should scatter by this much at least at the stripes of the targets.
const LEAST_SCATTER: f64 = 0.35;

/// Something about a repaired set that its reader should know; the limits are judgement, not calibrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Warning {
    /// Few records count at a stripe in the range.
    FewEffective {
        /// Effective records there.
        records: f64,
        /// The stripe, counted from 0.
        level: usize,
        /// How many were asked for.
        limit: f64,
    },
    /// One record has much of the weight at a stripe in the range.
    OneRecord {
        /// The first record of the pair, counted from 0.
        record: usize,
        /// Its largest share.
        share: f64,
        /// The stripe, counted from 0.
        level: usize,
    },
    /// One earthquake has much of the weight at a stripe in the range.
    OneEvent {
        /// The caller's number of the event.
        event: usize,
        /// Its largest share.
        share: f64,
        /// The stripe, counted from 0.
        level: usize,
    },
    /// ln q hardly scatters at the stripe of a target: the set lacks one side.
    NarrowScatter {
        /// The target, in the order given.
        target: usize,
        /// Standard deviation of ln q there.
        sd_ln_ratio: f64,
    },
    /// The stripes begin too high for the largest target rate.
    LowerTail,
}

impl Warning {
    /// All that there is to say of a repaired analysis.
    pub(crate) fn of(analysis: &ScaledAnalysis<'_>, diagnosis: &Diagnosis, least_effective: f64) -> Vec<Self> {
        let mut warnings = Vec::new();
        if let Some(least) = diagnosis.least_effective
            && least.records < least_effective
        {
            let (records, level) = (least.records, least.level);
            warnings.push(Self::FewEffective { records, level, limit: least_effective });
        }
        let in_range = || diagnosis.stripes.iter().enumerate().filter(|(level, _)| analysis.is_in_range(*level));
        let records = in_range().map(|(level, stripe)| (stripe.largest_record, stripe.largest_record_share, level));
        if let Some((record, share, level)) = records.max_by(|a, b| a.1.total_cmp(&b.1))
            && share > LARGEST_RECORD_SHARE
        {
            warnings.push(Self::OneRecord { record, share, level });
        }
        let events =
            in_range().filter_map(|(level, stripe)| stripe.largest_event.map(|(event, share)| (event, share, level)));
        if let Some((event, share, level)) = events.max_by(|a, b| a.1.total_cmp(&b.1))
            && share > LARGEST_EVENT_SHARE
        {
            warnings.push(Self::OneEvent { event, share, level });
        }
        for (target, at) in diagnosis.targets.iter().enumerate() {
            let sd_ln_ratio = diagnosis.stripes[at.stripe].sd_ln_ratio;
            if sd_ln_ratio < LEAST_SCATTER {
                warnings.push(Self::NarrowScatter { target, sd_ln_ratio });
            }
        }
        if analysis.range().high_limit == HighLimit::FirstStripe {
            warnings.push(Self::LowerTail);
        }
        warnings
    }

    /// A sentence that says it, and what to do.
    pub fn sentence(&self, words: &Words<'_>) -> String {
        let (x, y) = (words.scaled_to, words.other);
        match *self {
            Self::FewEffective { records, level, limit } => format!(
                "the weights leave {records:.1} effective records at the stripe {}, fewer than {limit}: choose records \
                 whose {y}/{x} is like the site's",
                words.level(level)
            ),
            Self::OneRecord { record, share, level } => format!(
                "record {} has {:.0} % of the weight at the stripe {}",
                (words.record)(record),
                100.0 * share,
                words.level(level)
            ),
            Self::OneEvent { event, share, level } => format!(
                "the earthquake {} has {:.0} % of the weight at the stripe {}",
                (words.event)(event),
                100.0 * share,
                words.level(level)
            ),
            Self::NarrowScatter { target, sd_ln_ratio } => format!(
                "ln({y}/{x}) scatters by only {sd_ln_ratio:.2} at the level of {}, where 0.35 and more is expected: the \
                 set lacks one side",
                (words.target)(target)
            ),
            Self::LowerTail => format!(
                "the stripes begin too high for the most frequent target: add stripes of {x} below {}",
                words.level(0)
            ),
        }
    }
}

/// The words of a site, for sentences.
#[derive(Clone, Copy)]
pub struct Words<'a> {
    /// The measure that the set is scaled to: PGV.
    pub scaled_to: &'a str,
    /// Its unit: cm/s.
    pub scaled_to_unit: &'a str,
    /// The other measure: PGA.
    pub other: &'a str,
    /// Stripe levels of x, `[level]`.
    pub levels: &'a [f64],
    /// The name of a record, by its position.
    pub record: &'a dyn Fn(usize) -> String,
    /// The name of an earthquake, by the caller's number.
    pub event: &'a dyn Fn(usize) -> String,
    /// The name of a target by its position: 2 % in 50 years.
    pub target: &'a dyn Fn(usize) -> String,
}

impl Words<'_> {
    /// A stripe: its level with the unit.
    pub(crate) fn level(&self, level: usize) -> String {
        let value = self.levels.get(level).copied().unwrap_or(f64::NAN);
        format!("{value} {}", self.scaled_to_unit)
    }
}

impl std::fmt::Debug for Words<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Words").field("scaled_to", &self.scaled_to).field("other", &self.other).finish_non_exhaustive()
    }
}
