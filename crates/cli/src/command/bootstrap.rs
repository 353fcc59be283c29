//! `uplift bootstrap`: how sure the spectra are (Section 4.5, Table 4.1).

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use uplift_bootstrap::ResamplingPlan;
use uplift_ida::Watch;

use super::Terminal;
use super::confidence::{self, Report};
use super::result_of::ResultArguments;
use uplift::UpliftError;
use uplift::bootstrap::{BandSettings, Bands, StrengthBands, bands_of_strength, gather_bands};
use uplift::bootstrap::{BandsFile, Checkpoint, write_bands};
use uplift::events::{Events, Progress};
use uplift::result::{ResultFile, StoredStripes, check_target};
use uplift_study::{Bootstrap, IntervalKind};

/// Sample sizes of Section 4.5 below the whole set.
const SIZES: [u32; 4] = [20, 40, 60, 80];
/// Strengths done between two looks at the clock and at Ctrl-C.
const BATCH: usize = 16;
/// What is finished is kept so often.
const KEPT_EVERY: Duration = Duration::from_secs(30);

#[derive(Debug, Args)]
pub(super) struct BootstrapArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Records in a sample, for instance 20,40,60 [default: the study's, else 20,40,60,80 and the whole set]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=100_000))]
    sizes: Option<Vec<u32>>,
    /// Samples of each size [default: the study's, else 1000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    replicates: Option<u64>,
    /// Seed of the draws [default: the study's]
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    seed: Option<u64>,
    /// How limits are read: percentile or bca (bias-corrected and accelerated)
    #[arg(long, value_parser = ["percentile", "bca"])]
    interval: Option<String>,
    /// Also bands that hold whole spectra
    #[arg(long)]
    simultaneous: bool,
    /// Draw the records as another result did, from its stored plan
    #[arg(long, value_name = "RESULT.h5", conflicts_with_all = ["sizes", "replicates", "seed"])]
    plan: Option<PathBuf>,
    /// Table to compare with
    #[arg(
        long,
        value_name = "FILE.csv",
        help = "Table to compare with: CSV with the columns of Table 4.1 (site, sample_size, pgv_e_median_pct, pgv_r_90ci_pct, …)"
    )]
    reference: Option<PathBuf>,
    /// Print the rows as JSON
    #[arg(long, help = "Print the rows as JSON: site, im, poe, sample_size, e_median and r_90ci in per cent")]
    json: bool,
}

pub(super) fn bootstrap(arguments: &BootstrapArguments, session: &Terminal) -> Result<(), UpliftError> {
    let reference = arguments.reference.as_deref().map(confidence::read_reference).transpose()?;
    let found = arguments.result.find(session)?;
    let stored = ResultFile::open(&found.path)?.stripes()?;
    check_target(&stored.path)?;
    let wanted = found.bootstrap.unwrap_or_else(|| stored.bootstrap.clone());
    let settings = BandSettings {
        confidence: wanted.confidence,
        interval: match arguments.interval.as_deref() {
            Some("bca") => IntervalKind::Bca,
            Some(_) => IntervalKind::Percentile,
            None => wanted.interval,
        },
        simultaneous: arguments.simultaneous || wanted.simultaneous,
        strength_above: wanted.strength_above,
    };
    let (plan, plan_source) = plan(arguments, &wanted, &stored)?;
    announce(&stored, &plan, session);

    let start = Instant::now();
    let bands = compute(&stored, &plan, &settings, session)?;
    session.remark("", &format!("{:.1} s", start.elapsed().as_secs_f64()));
    let file =
        BandsFile { stored: &stored, plan: &plan, plan_source: &plan_source, settings: &settings, bands: &bands };
    write_bands(&file)?;
    checkpoint(&stored, &plan, &settings).remove();
    let report = Report { file: &file, reference: reference.as_deref() };
    let mut out = std::io::stdout().lock();
    if arguments.json { report.print_json(&mut out) } else { report.print(&mut out, session.is_quiet()) }
}

/// The draws, and where they come from.
fn plan(
    arguments: &BootstrapArguments,
    wanted: &Bootstrap,
    stored: &StoredStripes,
) -> Result<(ResamplingPlan, String), UpliftError> {
    if let Some(path) = &arguments.plan {
        return Ok((kept_plan(path, stored)?, format!("draws of {}", path.display())));
    }
    let records = stored.records.len();
    let sizes = arguments.sizes.clone().or_else(|| wanted.sizes.clone()).unwrap_or_else(|| {
        let all = u32::try_from(records).unwrap_or(u32::MAX);
        SIZES.into_iter().filter(|&size| size < all).chain([all]).collect()
    });
    let replicates = arguments.replicates.unwrap_or(wanted.replicates);
    let seed = arguments.seed.unwrap_or(stored.seed);
    let count = usize::try_from(replicates).unwrap_or(usize::MAX);
    let plan = ResamplingPlan::draw(records, &sizes, count, seed)
        .map_err(|error| UpliftError::Usage(format!("--sizes: {error}")))?;
    Ok((plan, format!("seed {seed}")))
}

/// The plan that a result keeps, for the same records.
fn kept_plan(path: &Path, stored: &StoredStripes) -> Result<ResamplingPlan, UpliftError> {
    let file = ResultFile::open(path)?;
    let fail = |reason: String| UpliftError::input(format!("{}: {reason}", path.display()));
    let Some(plan) = file.resampling_plan()? else {
        return Err(fail("keeps no resampling plan: run `uplift bootstrap` on it first".to_owned()));
    };
    if file.axes()?.records != stored.records {
        return Err(fail(format!(
            "its plan draws from other records than those of {}, or in another order",
            stored.path.display()
        )));
    }
    Ok(plan)
}

fn announce(stored: &StoredStripes, plan: &ResamplingPlan, session: &Terminal) {
    session.remark("records", &format!("{}", stored.record_set));
    let sizes: Vec<String> = plan.sizes().iter().map(u32::to_string).collect();
    session.remark(
        "plan",
        &format!(
            "samples of {} records, {} of each size, drawn with replacement from {}",
            sizes.join(", "),
            plan.replicates(),
            plan.record_count()
        ),
    );
    if let Some(size) = plan.sizes().iter().find(|&&size| size as usize > plan.record_count()) {
        session.note(&format!(
"samples of {size} records from a set of {} show how narrow the band would be with more records of the same kind",
            plan.record_count()
        ));
    }
}

/// The bands of all measures; what is finished outlives an interruption.
fn compute(
    stored: &StoredStripes,
    plan: &ResamplingPlan,
    settings: &BandSettings,
    session: &Terminal,
) -> Result<Vec<Bands>, UpliftError> {
    let checkpoint = checkpoint(stored, plan, settings);
    let keys: Vec<&'static str> = stored.measures.iter().map(|measure| measure.measure.key()).collect();
    let mut finished = checkpoint.load(&keys);
    // a damaged file may hold anything
    finished.retain(|(key, strength), done| {
        let measure = stored.measures.iter().find(|measure| measure.measure.key() == *key);
        let spectra = measure.map_or(0, |measure| {
            stored.sites.len() + measure.branches.iter().filter(|branches| !branches.is_empty()).count()
        });
        let replicates =
            if settings.simultaneous { stored.sites.len() * stored.poes.len() * plan.samples().len() } else { 0 };
        *strength < stored.strengths.len()
            && done.bands.len() == spectra * stored.poes.len() * plan.sizes().len()
            && done.replicates_m.len() == replicates
    });
    if !finished.is_empty() {
        session.remark("resumed", &format!("{} strengths from {}", finished.len(), checkpoint.path().display()));
    }
    let start = Instant::now();
    let strengths = stored.strengths.len();
    let per_strength = (stored.sites.len() * stored.poes.len() * plan.samples().len()) as u64;
    for measure in &stored.measures {
        let key = measure.measure.key();
        let left: Vec<usize> = (0..strengths).filter(|&strength| !finished.contains_key(&(key, strength))).collect();
        let total = per_strength * left.len() as u64;
        let progress = Progress::begin(session, measure.measure.label(), "ordinates", total);
        let mut kept = Instant::now();
        for batch in left.chunks(BATCH * rayon::current_num_threads()) {
            let done: Vec<Option<(usize, StrengthBands)>> = batch
                .par_iter()
                .map(|&strength| {
                    if progress.cancelled() {
                        return Ok(None);
                    }
                    let bands = bands_of_strength(stored, measure, strength, plan, settings)?;
                    progress.finished(per_strength);
                    Ok(Some((strength, bands)))
                })
                .collect::<Result<_, UpliftError>>()?;
            finished.extend(done.into_iter().flatten().map(|(strength, bands)| ((key, strength), bands)));
            let stopped = session.cancelled();
            if stopped || kept.elapsed() > KEPT_EVERY {
                checkpoint.save(&finished)?;
                kept = Instant::now();
            }
            if stopped {
                drop(progress);
                return Err(UpliftError::Paused {
                    what: "strengths",
                    done: finished.len() as u64,
                    total: (strengths * stored.measures.len()) as u64,
                    path: checkpoint.path().to_owned(),
                });
            }
        }
        drop(progress);
    }
    if start.elapsed() > KEPT_EVERY {
        // the result may not be writable, on a disk that has filled up for instance
        checkpoint.save(&finished)?;
    }
    Ok(stored
        .measures
        .iter()
        .map(|measure| {
            let own: Vec<&StrengthBands> = finished
                .range((measure.measure.key(), 0)..=(measure.measure.key(), usize::MAX))
                .map(|(_, b)| b)
                .collect();
            gather_bands(stored, measure, plan, settings, &own)
        })
        .collect())
}

/// The checkpoint of this very bootstrap: its fingerprint covers all numbers that the bands depend on.
fn checkpoint(stored: &StoredStripes, plan: &ResamplingPlan, settings: &BandSettings) -> Checkpoint {
    let mut hash = Sha256::new();
    let mut add = |values: &[f64]| {
        hash.update((values.len() as u64).to_le_bytes());
        for value in values {
            hash.update(value.to_le_bytes());
        }
    };
    add(&stored.targets_per_year);
    add(&stored.strengths);
    for measure in &stored.measures {
        add(&measure.levels);
        add(measure.edp_m.values());
        for weights in measure.weights.iter().chain(measure.branches.iter().flatten().map(|(_, weights)| weights)) {
            add(&weights.per_year());
        }
        let branch_weights: Vec<f64> = measure.branches.iter().flatten().map(|(weight, _)| *weight).collect();
        add(&branch_weights);
    }
    hash.update(format!("{:?} {} {:?}", plan.sizes(), plan.replicates(), settings));
    for count in plan.multiplicities() {
        hash.update(count.to_le_bytes());
    }
    Checkpoint::of(&stored.path, format!("{:x?}", hash.finalize()))
}
