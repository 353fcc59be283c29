//! The stripes of a study as work: records x strengths x levels of each measure.

use std::path::Path;

use uplift_engine::analysis::{LabelledPlan, ShardReport, Work, carry_out_shard};
use uplift_ida::{Cells, Shard, System};
use uplift_inputs::{RecordSet, motion_keys, read_records};
use uplift_job::events::Events;
use uplift_job::text::{cost_in_words, counted};
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::{plan_own_stripes, systems_under};

use super::EarlierStripes;
use super::plan::{hazard_of, needs};
use crate::error::StudiesError;

/// What the stripes of a study are made of.
pub struct Inputs {
    /// The records.
    pub records: RecordSet,
    systems: Vec<System>,
    /// Keys of the records' motions.
    motions: Vec<String>,
}

impl Inputs {
    /// Reads the records of `study`.
    ///
    /// # Errors
    /// Records that cannot be used.
    pub fn read(study: &UniformRiskStudy, events: &dyn Events) -> Result<Self, StudiesError> {
        let records = read_records(study, events)?;
        Ok(Self { systems: systems_under(study, &records)?, motions: motion_keys(&records.records), records })
    }

    /// The stripes of every measure, but for what is known of them from results at `earlier`.
    ///
    /// # Errors
    /// A record that cannot be scaled.
    pub fn work<'a>(&'a self, study: &'a UniformRiskStudy, earlier: &[&Path]) -> Result<Work<'a>, StudiesError> {
        let earlier: Vec<EarlierStripes> = earlier.iter().filter_map(|path| EarlierStripes::open(path)).collect();
        let mut plans = Vec::new();
        for measure in &study.measures {
            let plan = plan_own_stripes(study, measure, &self.records, &self.systems)?;
            // another factor is another run, and an earlier result is looked at by levels alone
            let is_known = !earlier.is_empty() && self.records.at_level.is_none();
            let known = is_known.then(|| {
                let mut cells = Cells::unknown(&plan);
                for earlier in &earlier {
                    if cells.count() < plan.analyses() {
                        let _ = earlier.fill(study, measure, &self.records, &self.motions, &mut cells);
                    }
                }
                cells
            });
            let label = measure.measure.label().to_owned();
            let own = if self.records.at_level.is_some() { " (records of their own)" } else { "" };
            let azimuths = match plan.histories_per_peak() {
                1 => String::new(),
                azimuths => format!(" x {azimuths} azimuths"),
            };
            let structures = match study.structures_of_a_motion() {
                1 => String::new(),
                structures => {
                    format!(" ({} motions x {structures} structures)", self.records.records.len() / structures)
                }
            };
            let factors = [
                counted(self.records.records.len(), "record") + &structures,
                counted(study.strengths.len(), "strength"),
                counted(measure.levels.len(), "level") + own + &azimuths,
            ];
            let text = cost_in_words(&factors, plan.analyses());
            let remark = Some((label.clone(), text));
            plans.push(LabelledPlan { label, remark, plan, motions: &self.motions, known });
        }
        Ok(Work::new(&study.title, plans))
    }
}

/// Carries out one shard of the stripes of a study into a file, but for what is known from an `earlier` result.
///
/// # Errors
/// Inputs that cannot be used; a shard that cannot be written.
pub fn run_shard(
    study: &UniformRiskStudy,
    (path, shard): (&Path, Shard),
    earlier: Option<&Path>,
    events: &dyn Events,
) -> Result<ShardReport, StudiesError> {
    // a mistake in the hazard is found before, not when the shards are joined
    hazard_of(study, events)?;
    let inputs = Inputs::read(study, events)?;
    events.remark("records", &inputs.records.description);
    needs(study, &inputs.records, None).for_shard(shard).with_rows_of(&[path]).require(path, events)?;
    carry_out_shard(inputs.work(study, &earlier.into_iter().collect::<Vec<_>>())?, (path, shard), events, &|_| Ok(()))
}
