//! The spectra of a study as work: motions x structures x scalings of each set.

use std::path::Path;

use uplift_engine::analysis::{LabelledPlan, ShardReport, Work, carry_out_shard};
use uplift_ida::Shard;
use uplift_job::events::Events;
use uplift_job::text::{cost_in_words, counted};
use uplift_spectra::NUDGES;
use uplift_study::DisplacementStudy;

use super::inputs::{Inputs, KeyedMotions};
use super::rounding::rounding_plan;
use super::spectra::with_free_vibration;
use super::{carry_out_designs, needs};
use crate::error::StudiesError;

impl KeyedMotions<'_> {
    /// The spectra of every set, then for every set what rounding does to those that are printed.
    ///
    /// # Errors
    /// A scaling that no motion can have.
    pub fn work(&self, study: &DisplacementStudy) -> Result<Work<'_>, StudiesError> {
        let ways = study.scaling.ways().0;
        let mut plans = Vec::new();
        for (set, motions) in self.motions.iter().zip(&self.keys) {
            let plan = set.plan(&ways, self.structures, with_free_vibration(study))?;
            let factors = [
                counted(motions.len(), "motion"),
                counted(ways.len(), "scaling"),
                counted(self.structures.len(), "structure"),
            ];
            let text = cost_in_words(&factors, plan.analyses());
            let remark = Some((format!("{}:", set.name()), text));
            plans.push(LabelledPlan { label: set.name().to_owned(), remark, plan, motions, known: None });
        }
        for (set, motions) in self.motions.iter().zip(&self.keys) {
            let plan = rounding_plan(study, set, self.printed)?;
            let text = format!("printed ordinates again, at {NUDGES} neighbouring scale factors");
            let remark = Some((format!("{}:", set.name()), text));
            plans.push(LabelledPlan { label: format!("{}, rounding", set.name()), remark, plan, motions, known: None });
        }
        Ok(Work::new(&study.title, plans))
    }
}

/// Carries out one shard of the spectra of a study into a file, and its share of the design examples.
///
/// # Errors
/// Inputs that cannot be used; a shard that cannot be written.
pub fn run_shard(
    study: &DisplacementStudy,
    (path, shard): (&Path, Shard),
    events: &dyn Events,
) -> Result<ShardReport, StudiesError> {
    let inputs = Inputs::read(study, events)?;
    events.remark("records", &inputs.records.description);
    let sets = inputs.sets(study)?;
    needs(study, &inputs.records, &sets.motions).for_shard(shard).with_rows_of(&[path]).require(path, events)?;
    let work = sets.work(study)?;
    let total = work.analyses() / shard.count;
    carry_out_shard(work, (path, shard), events, &|checkpoint| {
        carry_out_designs(study, &sets, shard, (checkpoint, total), events).map(|_| ())
    })
}
