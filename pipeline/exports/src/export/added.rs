//! What `uplift influence` and `uplift measures` added to a result, as every format takes it.

use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_questions::influence::{RecordInfluence, level_of_share, rank_records};
use uplift_result::{ResultFile, StoredEfficiency, StoredInfluence};
use uplift_uniform_risk::StoredStripes;

use crate::error::ExportsError;

/// Shares of the risk whose levels are reported: below them lie 5 %, half and 95 % of it.
pub(super) const SHARES: [f64; 3] = [0.05, 0.5, 0.95];

/// The additions of a result; none where its commands were not run.
#[derive(Debug, Default)]
pub(super) struct Added {
    /// Names of the records; of the pairs where their records are left out together.
    pub(super) records: Vec<String>,
    /// Of the probabilities of the study alone: none of a result that was asked for others.
    pub(super) influence: Vec<Influence>,
    pub(super) efficiency: Vec<StoredEfficiency>,
}

/// Influence of records and intensities on the spectra of one measure.
#[derive(Debug)]
pub(super) struct Influence {
    pub(super) stored: StoredInfluence,
    levels: Vec<f64>,
    /// The records of each spectrum `[site, poe]`, the most influential first.
    pub(super) ranking: Array<2, Vec<RecordInfluence>>,
}

impl Added {
    pub(super) fn read(file: &ResultFile) -> Result<Self, ExportsError> {
        let efficiency = file.efficiency()?;
        if file.is_at_target_risks() || !file.has_influence() {
            return Ok(Self { efficiency, ..Self::default() });
        }
        let stripes = StoredStripes::read(file)?;
        let shape = [stripes.sites.len(), stripes.poes.len()];
        let mut influence = Vec::new();
        for stored in file.influence()? {
            let Some(measure) = stripes.measures.iter().find(|of| of.measure == stored.measure) else { continue };
            let ranking = Array::from_fn(shape, |at| {
                stored
                    .without_m
                    .as_ref()
                    .map_or_else(Vec::new, |without| rank_records(&stripes, &measure.exact_m, without, at))
            });
            influence.push(Influence { stored, levels: measure.levels.clone(), ranking });
        }
        let records = (0..stripes.records.len()).map(|record| stripes.units.name(record).to_owned()).collect();
        Ok(Self { records, influence, efficiency })
    }

    pub(super) fn influence_by(&self, measure: IntensityMeasure) -> Option<&Influence> {
        self.influence.iter().find(|influence| influence.stored.measure == measure)
    }

    pub(super) fn efficiency_of(&self, measure: IntensityMeasure) -> Option<&StoredEfficiency> {
        self.efficiency.iter().find(|efficiency| efficiency.measure == measure)
    }
}

impl Influence {
    /// The level below which a share of the risk at an ordinate lies, in the unit of the measure; NaN where there is no
    /// ordinate.
    pub(super) fn level(&self, [site, poe]: [usize; 2], strength: usize, share: f64) -> f64 {
        level_of_share(&self.levels, self.stored.shares.block([site, poe, strength]), share)
    }
}
