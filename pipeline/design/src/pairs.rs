//! The pairs of a study, which shake frames that wobble.

use uplift_ida::{Plan, StripeRecord, System};
use uplift_inputs::RecordSet;
use uplift_job::checksum::motion_key;
use uplift_motion::{Accelerogram, IntensityMeasure, RecordPair};
use uplift_uniform_risk::{plan_motions, with_verticals};

use crate::error::DesignError;

/// Pairs of a study, each with a key of both components, and how many records are of each.
#[derive(Debug, Default)]
pub(super) struct Pairs {
    pub(super) all: Vec<RecordPair>,
    pub(super) keys: Vec<String>,
    pub(super) per_pair: usize,
}

impl Pairs {
    pub(super) fn new(pairs: Vec<RecordPair>, per_pair: usize) -> Self {
        let key = |pair: &RecordPair| [&pair.h1, &pair.h2].map(motion_key).join(" and ");
        Self { keys: pairs.iter().map(key).collect(), all: pairs, per_pair }
    }

    /// The amplitude of a pair in the measure: both records of a pair have its intensity.
    pub(super) fn amplitude(&self, set: &RecordSet, measure: IntensityMeasure, pair: usize) -> f64 {
        measure.amplitude(set.records[pair * self.per_pair].intensity(measure))
    }

    /// The vertical component of every pair, each so `many` times; none where the study does not ask for it.
    pub(super) fn verticals<'a>(&self, set: &'a RecordSet, many: usize) -> Vec<&'a Accelerogram> {
        verticals(set, self.per_pair).flat_map(|vertical| std::iter::repeat_n(vertical, many)).collect()
    }

    /// Wobbling frames under both components of every pair.
    pub(super) fn shaking<'a>(
        &'a self,
        set: &'a RecordSet,
        (measure, levels): (IntensityMeasure, &[f64]),
        wobbling: &'a [System],
    ) -> Result<Plan<'a>, DesignError> {
        let stripes = self.level(set, (measure, levels), wobbling)?;
        Ok(with_verticals(stripes, self.verticals(set, 1))?)
    }

    /// The same without vertical components.
    pub(super) fn level<'a>(
        &'a self,
        set: &'a RecordSet,
        (measure, levels): (IntensityMeasure, &[f64]),
        wobbling: &'a [System],
    ) -> Result<Plan<'a>, DesignError> {
        let record = |(index, pair): (usize, &'a RecordPair)| StripeRecord {
            id: &pair.id,
            accelerogram: &pair.h1,
            intensity: self.amplitude(set, measure, index),
        };
        let records = self.all.iter().enumerate().map(record).collect();
        let stripes = plan_motions((measure, levels), records, wobbling, true)?;
        Ok(stripes.across(self.all.iter().map(|pair| &pair.h2).collect())?)
    }
}

/// The vertical component of every pair of so many records; none where the study does not ask for it.
pub(super) fn verticals(set: &RecordSet, per_pair: usize) -> impl Iterator<Item = &Accelerogram> {
    let of_pair = set.records.iter().step_by(per_pair).filter_map(|record| record.vertical.as_ref());
    of_pair.map(|vertical| &vertical.accelerogram)
}
