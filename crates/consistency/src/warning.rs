//! What deserves a look in a repaired set.

use crate::range::HighLimit;
use crate::{Diagnosis, ScaledAnalysis, Words};

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
    pub(crate) fn from_analysis(
        analysis: &ScaledAnalysis<'_>,
        diagnosis: &Diagnosis,
        least_effective: f64,
    ) -> Vec<Self> {
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
                "the weights leave {records:.1} effective records at the level {}, fewer than {limit}: choose records \
                 whose {y}/{x} is like the site's",
                words.level(level)
            ),
            Self::OneRecord { record, share, level } => format!(
                "record {} has {:.0} % of the weight at the level {}",
                (words.record)(record),
                100.0 * share,
                words.level(level)
            ),
            Self::OneEvent { event, share, level } => format!(
                "the earthquake {} has {:.0} % of the weight at the level {}",
                (words.event)(event),
                100.0 * share,
                words.level(level)
            ),
            Self::NarrowScatter { target, sd_ln_ratio } => format!(
                "ln({y}/{x}) scatters by only {sd_ln_ratio:.3} at the level of {}, where {LEAST_SCATTER} and more is \
                 expected: the set lacks one side",
                (words.target)(target)
            ),
            Self::LowerTail => format!(
                "the levels begin too high for the most frequent target: add levels of {x} below {}",
                words.level(0)
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use uplift_hazard::{Extrapolation, HazardCurve};

    use super::*;
    use crate::words::with_words;
    use crate::{LeastEffective, RecordSet, Seismology, SetRecord};

    #[test]
    fn each_warning_has_its_limit_and_its_sentence() {
        let record = |pair: usize| SetRecord {
            scaled_to: 1.0,
            other: 0.01 * (pair as f64 / 20.0 - 1.0).exp(),
            pair,
            event: Some(7),
            seismology: Seismology::default(),
        };
        let set = RecordSet::new((0..41).map(record).collect()).unwrap();
        let rates = vec![0.5, 0.01, 1e-4, 1e-7];
        let x = HazardCurve::new("PGV", "cm/s", "", vec![0.5, 2.0, 10.0, 100.0], rates.clone()).unwrap();
        let y = HazardCurve::new("PGA", "g", "", vec![0.005, 0.02, 0.1, 1.0], rates).unwrap();
        let of = |levels: &[f64], change: &dyn Fn(&mut Diagnosis)| {
            let analysis = ScaledAnalysis::new(&set, levels, &x, &y, &[0.01, 0.001], Extrapolation::Refuse).unwrap();
            let mut diagnosis = analysis.diagnose(None, [0.2, 5.0]).unwrap();
            for stripe in &mut diagnosis.stripes {
                stripe.largest_event = Some((7, 0.4));
            }
            change(&mut diagnosis);
            Warning::from_analysis(&analysis, &diagnosis, 20.0)
        };
        let levels = [1.0, 3.0, 5.0, 40.0];
        assert_eq!(of(&levels, &|_| {}), []);
        assert_eq!(of(&[2.5, 3.0, 40.0], &|_| {}), [Warning::LowerTail]);
        // the first stripe is outside the range, the second in it
        let found = of(&levels, &|diagnosis| {
            diagnosis.least_effective = Some(LeastEffective { records: 12.34, level: 1 });
            for (level, share) in [(0, 0.9), (1, 0.3)] {
                diagnosis.stripes[level].largest_record_share = share;
                diagnosis.stripes[level].largest_record = 40;
                diagnosis.stripes[level].largest_event = Some((7, 2.0 * share));
            }
            let stripe = diagnosis.targets[1].stripe;
            diagnosis.stripes[stripe].sd_ln_ratio = 0.31;
        });
        let expected = [
            Warning::FewEffective { records: 12.34, level: 1, limit: 20.0 },
            Warning::OneRecord { record: 40, share: 0.3, level: 1 },
            Warning::OneEvent { event: 7, share: 0.6, level: 1 },
            Warning::NarrowScatter { target: 1, sd_ln_ratio: 0.31 },
        ];
        assert_eq!(found, expected);
        with_words(|words| {
            let sentences = expected.map(|warning| warning.sentence(words));
            assert!(sentences[0].starts_with("the weights leave 12.3 effective records at the level 2.5 cm/s"));
            assert_eq!(sentences[1], "record RSN40 has 30 % of the weight at the level 2.5 cm/s");
            assert_eq!(sentences[2], "the earthquake event 7 has 60 % of the weight at the level 2.5 cm/s");
            assert!(sentences[3].starts_with("ln(PGA/PGV) scatters by only 0.310 at the level of 10 % in 50 years"));
            assert!(Warning::LowerTail.sentence(words).ends_with("add levels of PGV below 1 cm/s"));
        });
    }
}
