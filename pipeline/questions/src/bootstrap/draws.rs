//! Which records each replicate draws, and who decided it.

use std::path::Path;

use uplift_bootstrap::{BootstrapError, ResamplingPlan, Unit};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_result::ResultFile;
use uplift_study::Bootstrap;
use uplift_uniform_risk::StoredStripes;
use uplift_uniform_risk::consistency::Question;

use super::BootstrapOptions;
use super::asked::resampling_plan;
use super::bands::BandSettings;
use super::needs::needs;
use crate::error::QuestionsError;

/// Sample sizes of Section 4.5 below the whole set.
const SIZES: [u32; 4] = [20, 40, 60, 80];

/// The draws, and where they come from in words; what `options` leave open is as `study` says.
pub(super) fn draws(
    options: &BootstrapOptions,
    study: &Bootstrap,
    (file, stored): (&ResultFile, &StoredStripes),
    (settings, is_repaired): (&BandSettings, bool),
    events: &dyn Events,
) -> Result<(ResamplingPlan, String), QuestionsError> {
    if let Some(path) = &options.plan {
        return Ok((kept_draws(path, stored)?, format!("draws of {}", path.display())));
    }
    let records = stored.records.len();
    let own = file.stored_study()?;
    let unit = own.drawn_unit(Some(options.unit.unwrap_or(study.unit)));
    // samples of so many pairs, where each of their azimuths or structures is a record
    let of_a_pair = if own.keeps_pairs_together() { own.records_of_a_pair() } else { 1 };
    let of_a_pair = u32::try_from(of_a_pair).unwrap_or(u32::MAX);
    let sizes = options.sizes.clone().or_else(|| study.sizes.clone()).unwrap_or_else(|| {
        let all = u32::try_from(records).unwrap_or(u32::MAX);
        // a smaller sample may leave a level with records of its own without any
        let of_levels = stored.measures.iter().any(|measure| measure.shares.is_some());
        SIZES
            .map(|size| size.saturating_mul(of_a_pair))
            .into_iter()
            .filter(|&size| size < all && !of_levels)
            .chain([all])
            .collect()
    });
    let replicates = options.replicates.unwrap_or(study.replicates);
    let seed = options.seed.unwrap_or(stored.seed);
    refuse_endless(&sizes, replicates, records)?;
    needs(stored, sizes.len(), replicates, (settings, is_repaired)).require(&stored.path, events)?;
    let count = usize::try_from(replicates).unwrap_or(usize::MAX);
    let plan = match unit {
        Unit::Record => ResamplingPlan::draw(records, &sizes, count, seed),
        Unit::Pair => ResamplingPlan::draw_pairs(&Question::from_result(file)?.pair_of(), &sizes, count, seed),
        Unit::Event => ResamplingPlan::draw_events(&Question::from_result(file)?.event_of(), &sizes, count, seed),
    };
    let plan = plan.map_err(|error| match error {
        BootstrapError::OneEvent | BootstrapError::OnePair => {
            JobError::Usage(format!("--unit {}: {error}", unit.key()))
        }
        error => JobError::Usage(format!("--sizes: {error}")),
    })?;
    let plan = without_empty_levels(plan, stored, seed, events)?;
    let unit = match plan.unit() {
        Unit::Record => "",
        Unit::Pair => ", pairs with all their records",
        Unit::Event => ", earthquakes with all their records",
    };
    Ok((plan, format!("seed {seed}{unit}")))
}

/// Where levels have records of their own: samples that would leave one without any are drawn anew.
fn without_empty_levels(
    plan: ResamplingPlan,
    stored: &StoredStripes,
    seed: u64,
    events: &dyn Events,
) -> Result<ResamplingPlan, QuestionsError> {
    let shares: Vec<&[f64]> = stored.measures.iter().filter_map(|measure| measure.shares.as_deref()).collect();
    if shares.is_empty() {
        return Ok(plan);
    }
    let is_whole = |drawn: &[u32]| {
        let has_some = |level: &[f64]| level.iter().zip(drawn).any(|(&share, &times)| share > 0.0 && times > 0);
        shares.iter().all(|shares| shares.chunks_exact(drawn.len()).all(has_some))
    };
    let (plan, refused) = plan.drawn_anew(seed, is_whole)?;
    if refused > 0 {
        events.note(&format!(
            "{refused} of {} samples left a level without any of its records and were drawn anew: the percentile bands \
             are narrower for it (docs/method.md, section 3.1)",
            plan.samples().len()
        ));
    }
    Ok(plan)
}

/// Records in a sample for each record of the set, at most: the band of a hundred times as many is a tenth as wide, and
/// says nothing more of the records.
const MOST_OF_SET: u64 = 100;
/// Samples of that many records are drawn whatever the set.
const ALWAYS: u64 = 1000;

/// Refuses samples far larger than the set that they are drawn from, which take long and tell nothing.
fn refuse_endless(sizes: &[u32], replicates: u64, records: usize) -> Result<(), QuestionsError> {
    let most = ALWAYS.max(MOST_OF_SET * records as u64);
    let Some(size) = sizes.iter().find(|&&size| u64::from(size) > most) else { return Ok(()) };
    Err(JobError::Usage(format!(
        "--sizes: samples of {size} records from a set of {records}, {replicates} of them: at most {most} are drawn, \
         {MOST_OF_SET} times the set or {ALWAYS}: give sizes of the order of the set"
    ))
    .into())
}

/// The draws that the result at `path` keeps, from the same records.
fn kept_draws(path: &Path, stored: &StoredStripes) -> Result<ResamplingPlan, QuestionsError> {
    let file = ResultFile::open(path)?;
    let fail = |reason: String| JobError::input(format!("{}: {reason}", path.display()));
    let Some(plan) = resampling_plan(&file)? else {
        return Err(fail("keeps no resampling plan: run `uplift bootstrap` on it first".to_owned()).into());
    };
    if file.axes()?.records != stored.records {
        return Err(fail(format!(
            "its plan draws from other records than those of {}, or in another order",
            stored.path.display()
        ))
        .into());
    }
    Ok(plan)
}

/// Tells what is drawn from what.
pub(super) fn announce(
    (file, stored): (&ResultFile, &StoredStripes),
    plan: &ResamplingPlan,
    events: &dyn Events,
) -> Result<(), QuestionsError> {
    events.remark("records", &stored.record_set);
    let sizes: Vec<String> = plan.sizes().iter().map(u32::to_string).collect();
    events.remark(
        "plan",
        &format!(
            "samples of {} records, {} of each size, drawn with replacement from {}",
            sizes.join(", "),
            plan.replicates(),
            plan.record_count()
        ),
    );
    if plan.unit() != Unit::Record {
        let groups = if plan.unit() == Unit::Pair { "pairs" } else { "earthquakes" };
        let drawn: Vec<String> = plan.sizes().iter().map(|&size| plan.units_drawn(size).to_string()).collect();
        events.remark(
            "",
            &format!(
                "with their {groups}, {} of {}: a sample has so many records on average",
                drawn.join(", "),
                plan.unit_count()
            ),
        );
        if plan.unit() == Unit::Event && !Question::from_result(file)?.shares_earthquakes() {
            events.note(
                "no two pairs are known to share an earthquake: the band is that of pairs drawn one by one (column \
                 event of the manifest)",
            );
        }
    }
    if let Some(size) = plan.sizes().iter().find(|&&size| size as usize > plan.record_count()) {
        events.note(&format!(
            "samples of {size} records from a set of {} show how narrow the band would be with more records of the \
             same kind",
            plan.record_count()
        ));
    }
    Ok(())
}
