//! The influence of records and intensities on the spectra of a result.

use std::path::Path;

use clap::Args;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::typed::{number, probability};
use uplift_job::{Array, JobError};
use uplift_result::LockedResult;
use uplift_uniform_risk::StoredStripes;
use uplift_uniform_risk::consistency::Reweighing;

use super::change::{Influence, RecordInfluence, influence_by, influence_on_repaired, rank_records};
use super::report::InfluenceReport;
use super::write::{influence_path, write_influence};
use crate::error::QuestionsError;

/// The report on the influence; the files hold all of it.
#[derive(Debug, Clone, Copy, PartialEq, Args)]
pub struct InfluenceOptions {
    /// Number of records shown for each site
    #[arg(long, value_name = "N", default_value_t = InfluenceOptions::default().top)]
    pub top: usize,
    /// Probability of exceedance, 0.1 or 10% [default: the smallest]
    #[arg(long, value_parser = probability)]
    pub poe: Option<f64>,
    /// Return period in years instead
    #[arg(long, value_name = "YEARS", conflicts_with = "poe", value_parser = number)]
    pub return_period: Option<f64>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

impl Default for InfluenceOptions {
    fn default() -> Self {
        Self { poe: None, return_period: None, top: 3, force: false }
    }
}

/// Which records carry the spectra of the result at `result` (jackknife), and which intensities make their risk
/// (disaggregation): written into the file and into a table beside it.
///
/// # Errors
/// A file that is missing, damaged, no result, or without sites; a probability that it does not have; a file that
/// cannot be written; [`JobError::Interrupted`] where `events` say so.
pub fn influence(
    result: &Path,
    options: &InfluenceOptions,
    events: &dyn Events,
) -> Result<InfluenceReport, QuestionsError> {
    let (locked, file) = LockedResult::open(result, events)?;
    let stored = StoredStripes::read(&file)?;
    let table = Output::new(influence_path(&stored.path), OutputKind::Table("mean_change_pct"));
    outputs::check(&[table], &[result], options.force)?;
    let poe = match options.return_period {
        Some(years) => stored.return_period_index(years)?,
        None => stored.poe_index(options.poe)?,
    };
    let reweighing = Reweighing::from_result(&file)?;
    let mut influences: Vec<Influence> = Vec::new();
    for measure in &stored.measures {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        influences.push(influence_by(&stored, measure)?);
        if let Some(reweighing) = &reweighing {
            let repaired = influence_on_repaired(&stored, measure, reweighing, events);
            influences.push(repaired.map_err(|error| uplift_job::in_file(error, &stored.path))?);
        }
    }
    let shape = [stored.sites.len(), stored.poes.len()];
    let rankings: Vec<Array<2, Vec<RecordInfluence>>> = influences
        .iter()
        .map(|influence| {
            let Influence { exact_m, without_m, .. } = influence;
            let rank = |at| without_m.as_ref().map(|without_m| rank_records(&stored, exact_m, without_m, at));
            Array::from_fn(shape, |at| rank(at).unwrap_or_default())
        })
        .collect();
    write_influence(&locked, &stored, &influences, &rankings)?;
    Ok(InfluenceReport::new(&stored, &influences, &rankings, poe, options.top))
}
