//! The spectra computed, written as tables and summed up.

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_block::Overturning;
use uplift_job::events::{Events, Progress};
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::write_table;

use super::compute::{PulseSpectra, Spectrum, compute};
use super::plan::{PulsePlan, wavelet};
use super::tables::{PULSE_FIGURES, WAVELET_COLUMN, tables};
use crate::error::LaboratoryError;

/// Which spectra are computed, and where their tables go.
#[derive(Debug, Clone, PartialEq)]
pub struct PulseOptions {
    /// The spectra.
    pub plan: PulsePlan,
    /// Folder for the tables; none for no tables.
    pub folder: Option<PathBuf>,
    /// Whether existing files are overwritten.
    pub force: bool,
}

/// What the spectra say.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PulseReport {
    /// Slenderness α of the block of the nondimensional spectra, rad.
    pub slenderness_rad: f64,
    /// Coefficient of restitution; none for Housner's (Eq. 2.3).
    pub restitution: Option<f64>,
    /// A summary for each wavelet.
    pub wavelets: Vec<Summary>,
    /// The files written.
    pub files: Vec<PathBuf>,
    /// What was computed.
    #[serde(skip)]
    pub plan: PulsePlan,
    /// The spectra, one set for each wavelet.
    #[serde(skip)]
    pub spectra: Vec<PulseSpectra>,
}

/// Computes rocking spectra of a rigid block under Ricker wavelets and writes their tables.
///
/// # Errors
/// Blocks or pulses that cannot be; a folder that cannot be written; an interruption.
///
/// # Source
/// Reggiani Manzo, Sections 2.2 and 2.3.
pub fn pulses(options: &PulseOptions, events: &dyn Events) -> Result<PulseReport, LaboratoryError> {
    let plan = &options.plan;
    plan.check()?;
    if let Some(folder) = &options.folder {
        let table = |id| Output::new(folder.join(format!("{id}.csv")), OutputKind::Table(WAVELET_COLUMN));
        let nothing: [&Path; 0] = [];
        outputs::check(&PULSE_FIGURES.map(table), &nothing, options.force)?;
    }
    for note in plan.without_uplift() {
        events.note(&note);
    }
    let progress = Progress::begin(events, "pulses", "motions", plan.points());
    let computed = compute(plan, &progress);
    drop(progress);
    let spectra = computed?;
    let mut files = Vec::new();
    if let Some(folder) = &options.folder {
        events.writing_into(folder);
        files = write_tables(plan, &spectra, folder)?;
    }
    Ok(PulseReport {
        slenderness_rad: plan.slenderness_rad,
        restitution: plan.restitution,
        wavelets: spectra.iter().map(summary).collect(),
        files,
        plan: plan.clone(),
        spectra,
    })
}

fn write_tables(plan: &PulsePlan, spectra: &[PulseSpectra], folder: &Path) -> Result<Vec<PathBuf>, LaboratoryError> {
    let mut files = Vec::new();
    for table in tables(spectra) {
        let file = folder.join(format!("{}.csv", table.id));
        write_table(&file, &provenance(plan), table.columns)?;
        files.push(file);
    }
    Ok(files)
}

/// First line of the tables.
fn provenance(plan: &PulsePlan) -> String {
    let restitution = plan.restitution.map_or("Housner's restitution".to_owned(), |r| format!("restitution {r}"));
    let periods: Vec<String> =
        plan.shapes.iter().map(|&shape| format!("{} s ({})", plan.blocks.period_s(shape), wavelet(shape))).collect();
    format!(
        "uplift {} ({}); Ricker wavelets, {restitution}; alpha = {} rad, or as given; \
         blocks with a size: a_p = {} g, T_p = {}; overturned = inf",
        uplift_job::VERSION,
        uplift_job::COMMIT,
        plan.slenderness_rad,
        plan.blocks.amplitude_g,
        periods.join(", ")
    )
}

/// The overturned part of the spectra of one wavelet. Bounds are values of the grids; none where no point overturns.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// The wavelet.
    pub wavelet: &'static str,
    /// Points of the spectrum over ωₚ/p.
    pub points: usize,
    /// Points that overturn without impact.
    pub overturned_without_impact: usize,
    /// Points that overturn after one impact or more.
    pub overturned_after_impact: usize,
    /// Smallest aₚ/(g tan α) at which a block overturns.
    pub smallest_overturning_acceleration: Option<f64>,
    /// Largest ωₚ/p at which a block overturns.
    pub largest_overturning_frequency: Option<f64>,
    /// Largest base 2b ωₚ²/aₚ at which a block overturns (Section 2.3.2: roughly nine).
    pub largest_overturning_base: Option<f64>,
    /// Whether that is the last base of the grid, so that larger ones may overturn too.
    pub larger_bases_may_overturn: bool,
}

/// Sum up the spectra of one wavelet.
pub fn summary(spectra: &PulseSpectra) -> Summary {
    let spectrum = &spectra.by_frequency;
    let ways = |way| spectrum.points.iter().filter(|point| point.overturning == way).count();
    let half_widths = &spectra.by_half_width.plan.sizes;
    let largest_half_width = largest_overturning_size(&spectra.by_half_width);
    Summary {
        wavelet: wavelet(spectra.shape),
        points: spectrum.points.len(),
        overturned_without_impact: ways(Overturning::WithoutImpact),
        overturned_after_impact: ways(Overturning::AfterImpact),
        smallest_overturning_acceleration: overturned(spectrum)
            .map(|(_, acceleration)| acceleration)
            .min_by(f64::total_cmp),
        largest_overturning_frequency: largest_overturning_size(spectrum),
        largest_overturning_base: largest_half_width.map(|half_width| 2.0 * half_width),
        larger_bases_may_overturn: largest_half_width.is_some() && largest_half_width == half_widths.last().copied(),
    }
}

/// Size and acceleration of the points that overturn.
fn overturned(spectrum: &Spectrum) -> impl Iterator<Item = (f64, f64)> {
    let overturns = |point: &uplift_block::SpectrumPoint| point.overturning != Overturning::None;
    spectrum.rows().filter(move |(_, _, point)| overturns(point)).map(|(size, acceleration, _)| (size, acceleration))
}

fn largest_overturning_size(spectrum: &Spectrum) -> Option<f64> {
    overturned(spectrum).map(|(size, _)| size).max_by(f64::total_cmp)
}
