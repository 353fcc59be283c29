//! Which records each level has, and how much they count there.

use uplift_study::MeasurePlan;

use super::{far_factors, relative_factors};
use crate::record::Record;

/// Which record is run at which level, by what factor, and how much it counts there.
#[derive(Debug, Clone, PartialEq)]
pub struct AtLevel {
    /// Scale factors `[record, level]`; NaN where a record does not belong to a level.
    pub factors: Vec<f64>,
    /// How much each record counts `[level, record]`, 0 where it does not belong to the level; none where every record
    /// belongs to every level and counts alike.
    pub shares: Option<Vec<f64>>,
    /// SHA-256 of the table.
    pub checksum: String,
}

/// How many records each level has.
struct Counts {
    /// Of the level with the fewest, and with the most.
    records: [usize; 2],
    /// To how many records that count alike they amount, 1/Σp², at the level where it is fewest, and most.
    effective: [f64; 2],
}

impl AtLevel {
    /// Scale factors of the record at `index`, `[level]`.
    pub fn factors_of(&self, index: usize, levels: usize) -> &[f64] {
        &self.factors[index * levels..(index + 1) * levels]
    }

    /// Factors over the ones that bring the `records` to the levels of `plan`, `[level, record]`.
    pub fn relative_factors(&self, records: &[Record], plan: &MeasurePlan) -> Vec<f64> {
        let intensities: Vec<f64> = records.iter().map(|record| record.intensity(plan.measure)).collect();
        relative_factors(&self.factors, plan.measure, &plan.levels, &intensities)
    }

    /// Factors that are probably of another unit, in words.
    pub fn far_factors(&self, records: &[Record], plan: &MeasurePlan) -> Option<String> {
        let names: Vec<String> = records.iter().map(|record| record.id.clone()).collect();
        far_factors(&self.relative_factors(records, plan), &names, (plan.measure, &plan.levels))
    }

    /// How many records the levels have, in words: `4 to 12 a level, which count as 3.2 to 12`.
    pub fn words(&self, levels: usize) -> String {
        let Counts { records: [fewest, most], effective: [least, largest] } = self.counts(levels);
        let range = |from: String, to: String| if from == to { from } else { format!("{from} to {to}") };
        let rounded = |count: f64| format!("{}", (10.0 * count).round() / 10.0);
        let (count, effective) = (range(fewest.to_string(), most.to_string()), range(rounded(least), rounded(largest)));
        if count == effective {
            format!("{count} a level")
        } else {
            format!("{count} a level, which count as {effective}")
        }
    }

    fn counts(&self, levels: usize) -> Counts {
        let all = self.factors.len() / levels;
        let Some(shares) = &self.shares else { return Counts { records: [all; 2], effective: [all as f64; 2] } };
        let mut counts = Counts { records: [usize::MAX, 0], effective: [f64::INFINITY, 0.0] };
        for row in shares.chunks_exact(all) {
            let records = row.iter().filter(|share| **share > 0.0).count();
            let effective = 1.0 / row.iter().map(|share| share * share).sum::<f64>();
            counts.records = [counts.records[0].min(records), counts.records[1].max(records)];
            counts.effective = [counts.effective[0].min(effective), counts.effective[1].max(effective)];
        }
        counts
    }
}
