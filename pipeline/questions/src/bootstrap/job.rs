//! The bootstrap of a result, from its stripes to the bands in its file.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, value_parser};
use uplift_bootstrap::{Interval, Unit};
use uplift_job::events::Events;
use uplift_job::outputs;
use uplift_job::typed::{RARE, one_of, whole_number};
use uplift_result::LockedResult;
use uplift_study::Bootstrap;
use uplift_uniform_risk::consistency::Reweighing;
use uplift_uniform_risk::{QuotedUnits, StoredStripes};

use super::bands::BandSettings;
use super::checkpoint::Checkpoint;
use super::compute::{Source, compute};
use super::draws::{announce, draws};
use super::report::{BootstrapReport, ReferenceRow};
use super::write::{BandsFile, band_paths, tables, write_bands};
use crate::error::QuestionsError;

/// What is asked of a bootstrap. What is left open is as a study says: as `study`, else as the one in the result.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct BootstrapOptions {
    /// The section `[bootstrap]` of a study, in place of that of the study in the result.
    #[arg(skip)]
    pub study: Option<Bootstrap>,
    /// Records in a resample, e.g. 20,40,60 [default: the study's, else 20,40,60,80 and all]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = whole_number::<u32>(1..=100_000))]
    pub sizes: Option<Vec<u32>>,
    /// Number of resamples of each size [default: the study's, else 1000]
    #[arg(long, value_name = "N", value_parser = whole_number::<u64>(1..=1_000_000))]
    pub replicates: Option<u64>,
    /// Random seed [default: the study's]
    #[arg(long, help_heading = RARE, value_parser = value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,
    /// Method of the limits: percentile or bca
    #[arg(long, help_heading = RARE, value_parser = one_of(&Interval::ALL, Interval::key))]
    pub interval: Option<Interval>,
    /// Unit of a resample: record, pair or event (earthquake)
    #[arg(long, help_heading = RARE, value_parser = one_of(&Unit::ALL, Unit::key), conflicts_with = "plan")]
    pub unit: Option<Unit>,
    /// Add simultaneous bands, which hold for whole spectra
    #[arg(long)]
    pub simultaneous: bool,
    /// Draw the same resamples as another result
    #[arg(long, help_heading = RARE, value_name = "RESULT.h5", conflicts_with_all = ["sizes", "replicates", "seed"])]
    pub plan: Option<PathBuf>,
    /// Figures to compare with, which the report hands on: see [`read_reference`](super::read_reference).
    #[arg(skip)]
    pub reference: Vec<ReferenceRow>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

/// How sure the spectra of the result at `result` are: bands from resampled records, written into the file and into
/// tables beside it (Section 4.5).
///
/// Finished strengths, and repaired sites, outlive whatever stops the job, in a checkpoint beside the result.
///
/// # Errors
/// A file that is missing, damaged, no result, or without sites; draws that cannot be made or do not belong to its
/// records; a file that cannot be written; [`JobError::Paused`](uplift_job::JobError::Paused) where `events` say so.
pub fn bootstrap(
    result: &Path,
    options: &BootstrapOptions,
    events: &dyn Events,
) -> Result<BootstrapReport, QuestionsError> {
    let (locked, file) = LockedResult::open(result, events)?;
    let stored = StoredStripes::read(&file)?;
    outputs::check(&tables(&stored.path), &[result], options.force)?;
    let study = options.study.as_ref().unwrap_or(&stored.bootstrap);
    let settings = BandSettings {
        confidence: study.confidence,
        interval: options.interval.unwrap_or(study.interval),
        simultaneous: options.simultaneous || study.simultaneous,
        strength_above: study.strength_above,
    };
    let reweighing = Reweighing::from_result(&file)?;
    let (plan, plan_source) = draws(options, study, (&file, &stored), (&settings, reweighing.is_some()), events)?;
    announce((&file, &stored), &plan, events)?;

    let start = Instant::now();
    let quoted = QuotedUnits::from_file(&file)?;
    let source =
        Source { stored: &stored, reweighing: reweighing.as_ref(), plan: &plan, quoted: &quoted, settings: &settings };
    let checkpoint = Checkpoint::new(&source);
    let bands = compute(&source, Some(&checkpoint), events)?;
    events.remark("", &format!("{:.1} s", start.elapsed().as_secs_f64()));
    write_bands(
        &locked,
        &BandsFile {
            stored: &stored,
            plan: &plan,
            plan_source: &plan_source,
            settings: &settings,
            bands: &bands,
            quoted: &quoted,
        },
    )?;
    checkpoint.remove();
    Ok(BootstrapReport::new(
        stored,
        band_paths(result),
        plan.sizes().to_vec(),
        settings,
        bands,
        options.reference.clone(),
    ))
}
