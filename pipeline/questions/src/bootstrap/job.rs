//! The bootstrap of a result, from its stripes to the bands in its file.

use std::path::Path;
use std::time::Instant;

use uplift_job::events::Events;
use uplift_job::outputs;
use uplift_result::LockedResult;
use uplift_uniform_risk::consistency::Reweighing;
use uplift_uniform_risk::{QuotedUnits, StoredStripes};

use super::bands::BandSettings;
use super::checkpoint::Checkpoint;
use super::compute::compute;
use super::draws::{announce, draws};
use super::options::BootstrapOptions;
use super::report::BootstrapReport;
use super::source::Source;
use super::write::{BandsFile, band_paths, tables, write_bands};
use crate::error::QuestionsError;

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
    let checkpoint = Checkpoint::new(&source, &options.command);
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
