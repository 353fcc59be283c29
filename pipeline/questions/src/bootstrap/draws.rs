//! Which records each replicate draws, and who decided it.

use std::path::Path;

use uplift_bootstrap::{BootstrapError, ResamplingPlan, Unit};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::machine::{Needs, PROGRAM_BYTES};
use uplift_result::ResultFile;
use uplift_study::Bootstrap;
use uplift_uniform_risk::StoredStripes;
use uplift_uniform_risk::consistency::Question;

use super::bands::BandSettings;
use super::options::BootstrapOptions;
use super::resampled::resampling_plan;
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

/// Where levels have records of their own: samples that would leave one without any are drawn again.
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
            "{refused} of {} samples left a level without records and were drawn again, which narrows the percentile \
             bands (docs/method.md, section 3.1)",
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
        "--sizes: {replicates} samples of {size} records from a set of {records}: the largest size is {most}, \
         {MOST_OF_SET} times the set or {ALWAYS}"
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
            "resamples of {} records, {} of each size, from {}",
            sizes.join(", "),
            plan.replicates(),
            plan.record_count()
        ),
    );
    if plan.unit() != Unit::Record {
        let groups = if plan.unit() == Unit::Pair { "pairs" } else { "earthquakes" };
        let drawn: Vec<String> = plan.sizes().iter().map(|&size| plan.units_drawn(size).to_string()).collect();
        events.remark("", &format!("with their {groups}, {} of {}, on average", drawn.join(", "), plan.unit_count()));
        if plan.unit() == Unit::Event && !Question::from_result(file)?.shares_earthquakes() {
            events.note(
                "no two pairs share an earthquake (column event of the manifest): the band is that of pairs drawn one \
                 by one",
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

/// What `replicates` samples of each of so many `sizes` take.
///
/// A demand of the result has 8 bytes; a sample 12 bytes a record and some for itself, and 4 more where the draws are
/// written; a replicate 8 bytes an ordinate of the one site that a thread is at, and where whole spectra are wanted of
/// all of them, twice while they are put in order or kept. Repaired spectra are made of all demands of a measure, 12
/// bytes each in the order of their size and 16 for their sums, of the weights of 80 replicates by every thread, and of
/// all replicates of a site, twice while they are gathered; of one with weighted hazard curves by each of these, and
/// once more while they are gathered.
pub(super) fn needs(
    stored: &StoredStripes,
    sizes: usize,
    replicates: u64,
    (settings, is_repaired): (&BandSettings, bool),
) -> Needs {
    let product = |factors: &[usize]| factors.iter().fold(1_u64, |product, &f| product.saturating_mul(f as u64));
    let samples = usize::try_from(replicates).unwrap_or(usize::MAX).saturating_mul(sizes);
    let (records, strengths) = (stored.records.len(), stored.strengths.len());
    let (sites, poes, measures) = (stored.sites.len(), stored.poes.len(), stored.measures.len());
    let levels: usize = stored.measures.iter().map(|measure| measure.levels.len()).sum();
    let demands = product(&[8, records, strengths, levels]);
    let draws = product(&[16, samples, records + 8]);
    let branches = stored.measures.iter().flat_map(|measure| &measure.branches).map(Vec::len).max().unwrap_or(0);
    let threads = rayon::current_num_threads();
    let at_work = product(&[8, threads, samples, poes, 2 + branches]);
    let kept = if settings.simultaneous { product(&[16, measures, strengths, sites, poes, samples]) } else { 0 };
    let most_levels = stored.measures.iter().map(|measure| measure.levels.len()).max().unwrap_or(0);
    let repaired = if is_repaired {
        let times = (2 * (1 + usize::from(settings.simultaneous))).max(1 + branches);
        let of_site = product(&[8, strengths, poes, samples, times]);
        let weights = product(&[8, 80, threads, records, most_levels]);
        product(&[28, records, strengths, most_levels]).saturating_add(weights).saturating_add(of_site)
    } else {
        0
    };
    let bands = product(&[if is_repaired { 80 } else { 40 }, measures, strengths, sites, poes, sizes]);
    let sum = |terms: &[u64]| terms.iter().fold(0_u64, |sum, &term| sum.saturating_add(term));
    Needs {
        memory_bytes: sum(&[PROGRAM_BYTES, demands, draws, at_work.max(repaired), kept, bands]),
        disk_bytes: sum(&[draws / 4, bands, kept / 2]),
        disk_least_bytes: 0,
    }
}
