//! Figures of results, curves, pulses, responses, overturnings and validations, written.

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift::events::Events;
use uplift::hazard_curves::{CurveOptions, read as read_curves};
use uplift::library::LibraryReport;
use uplift::outputs::{self, Output, beside, provide_folder};
use uplift::pulses::{PULSE_FIGURES, PulseReport};
use uplift::response::{BlockResponseReport, FrameResponseReport, ResponseReport, ShakingRecord};
use uplift::result::ResultFile;
use uplift::structure::{FrameRiskReport, OverturningReport};
use uplift::sweep::SweepReport;
use uplift::validate::ValidateReport;
use uplift::{JobError, UpliftError};
use uplift_plot::Figure;

use crate::figures::{
    LIBRARY_FIGURES, block_history_figure, distributions_figure, frame_figure, frame_risk_figure, hazard_figure,
    history_figure, library_figures, overturning_figure, pairs_figure, pulse_figures, result_figures, sweep_figure,
};
use crate::files::{FigureOptions, check_figure_file, write_figure_file};

/// Curves that a figure can distinguish, and then some.
const MOST_CURVES: usize = 50;

/// Which figures of a result are drawn, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotOptions {
    /// The result file.
    pub result: PathBuf,
    /// Folder for the figures; beside the result and named after it if none is given.
    pub folder: Option<PathBuf>,
    /// Only figures whose name contains this, for instance `urs`.
    pub only: Option<String>,
    /// Uplift strengths of the maps of many sites; a few if none is given.
    pub strengths: Vec<f64>,
    /// How they are written.
    pub figures: FigureOptions,
    /// Whether existing files are overwritten.
    pub force: bool,
}

/// What was drawn.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PlotReport {
    /// The files, in the order of the figures.
    pub files: Vec<PathBuf>,
}

/// Draws the figures of a result, of either kind.
///
/// # Errors
/// A file that is no result or damaged, a figure or a strength that it does not have, a folder that cannot be written.
pub fn plot(options: &PlotOptions, events: &dyn Events) -> Result<PlotReport, UpliftError> {
    let figures = result_figures(&options.result, &options.strengths)?;
    let wanted = options.only.as_deref().unwrap_or_default();
    let chosen: Vec<_> = figures.iter().filter(|figure| figure.id.contains(wanted)).collect();
    if chosen.is_empty() {
        return Err(none_called(wanted, "result", figures.iter().map(|figure| figure.id.as_str())));
    }
    let folder = options.folder.clone().unwrap_or_else(|| beside(&options.result, "figures"));
    let ids = chosen.iter().map(|figure| figure.id.as_str());
    let outputs: Vec<Output> =
        options.figures.outputs(ids, &folder).into_iter().map(|output| output.with_result(&options.result)).collect();
    outputs::check(&outputs, &[&options.result], options.force)?;
    let result = ResultFile::open(&options.result)?;
    let mark = result.mark()?;
    let mut files = Vec::new();
    for figure in chosen {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        files.extend(options.figures.write(figure, &folder, &mark)?);
    }
    // after what was drawn again
    result.tell_made_of_another(events)?;
    Ok(PlotReport { files })
}

/// That no figure `of` something has a name that contains `wanted`, but those of `names`.
pub(crate) fn none_called<'a>(wanted: &str, of: &str, names: impl Iterator<Item = &'a str>) -> UpliftError {
    let names = names.collect::<Vec<_>>().join(", ");
    JobError::Usage(format!("no figure is called {wanted}: the {of} has the figures {names}")).into()
}

/// Refuses a `folder` where the figures of [`plot_pulses`] would replace something else, before anything is computed.
///
/// # Errors
/// As [`outputs::check`].
pub fn check_pulse_figures(folder: &Path, figures: FigureOptions, force: bool) -> Result<(), UpliftError> {
    let nothing: [&Path; 0] = [];
    Ok(outputs::check(&figures.outputs(PULSE_FIGURES.into_iter(), folder), &nothing, force)?)
}

/// Draws the rocking spectra of Figures 2.2 to 2.7 into `folder`; the files written.
///
/// # Errors
/// A folder that cannot be written.
pub fn plot_pulses(report: &PulseReport, folder: &Path, figures: FigureOptions) -> Result<Vec<PathBuf>, UpliftError> {
    write_figures(&pulse_figures(&report.plan, &report.spectra), folder, figures)
}

/// Refuses a `folder` where the figures of [`plot_library`] would replace something else, before anything is computed.
///
/// # Errors
/// As [`outputs::check`].
pub fn check_library_figures(folder: &Path, figures: FigureOptions, force: bool) -> Result<(), UpliftError> {
    let nothing: [&Path; 0] = [];
    Ok(outputs::check(&figures.outputs(LIBRARY_FIGURES.into_iter(), folder), &nothing, force)?)
}

/// Draws shares and median responses of a library into `folder`; the files written.
///
/// # Errors
/// A folder that cannot be written.
pub fn plot_library(
    report: &LibraryReport,
    folder: &Path,
    figures: FigureOptions,
) -> Result<Vec<PathBuf>, UpliftError> {
    write_figures(&library_figures(report), folder, figures)
}

fn write_figures(drawn: &[Figure], folder: &Path, figures: FigureOptions) -> Result<Vec<PathBuf>, UpliftError> {
    provide_folder(folder)?;
    let mut files = Vec::new();
    for figure in drawn {
        files.extend(figures.write(figure, folder, &outputs::mark())?);
    }
    Ok(files)
}

/// Draws the time history of a response to `file`, .svg or .png.
///
/// # Errors
/// A report without a history; a file that cannot be written.
pub fn plot_response(report: &ResponseReport, file: &Path) -> Result<(), UpliftError> {
    let Some(history) = &report.history else { return Err(no_history()) };
    let title = format!("{}, strength {}", shaken(&report.shaken_by), report.strength);
    write_figure_file(&history_figure(&title, history, report.uplift_displacement_m), file)
}

/// Draws the time history of a block's response to `file`, .svg or .png.
///
/// # Errors
/// As [`plot_response`].
pub fn plot_block_response(report: &BlockResponseReport, file: &Path) -> Result<(), UpliftError> {
    let Some(history) = &report.history else { return Err(no_history()) };
    let BlockResponseReport { size_m, slenderness_rad, .. } = report;
    let title = format!("{}, block of R = {size_m:.4} m, α = {slenderness_rad:.4}", shaken(&report.shaken_by));
    write_figure_file(&block_history_figure(&title, history, *slenderness_rad), file)
}

/// Draws the response of a frame to `file`, .svg or .png: the path of its deck in plan, drifts, forces.
///
/// # Errors
/// As [`plot_response`].
pub fn plot_frame_response(report: &FrameResponseReport, file: &Path) -> Result<(), UpliftError> {
    if report.runs.iter().any(|run| run.history.is_none()) {
        return Err(no_history());
    }
    write_figure_file(&frame_figure(report), file)
}

fn no_history() -> UpliftError {
    JobError::Usage("the response was computed without its time history: request it".to_owned()).into()
}

/// The record and its scale, for a title.
fn shaken(by: &ShakingRecord) -> String {
    format!("{} times {}", by.record.file_name().unwrap_or_default().to_string_lossy(), by.scale)
}

/// Draws the collapse fragility of a structure as `file`, in the format of its ending.
///
/// # Errors
/// As [`write_figure_file`].
pub fn plot_overturning(report: &OverturningReport, file: &Path) -> Result<(), UpliftError> {
    write_figure_file(&overturning_figure(report), file)
}

/// Draws the distributions of measured and computed peaks to `file`, .svg or .png.
///
/// # Errors
/// A file that cannot be written.
pub fn plot_validation(report: &ValidateReport, file: &Path) -> Result<(), UpliftError> {
    write_figure_file(&distributions_figure(report), file)
}

/// Draws computed over measured peaks, motion by motion, to `file`, .svg or .png.
///
/// # Errors
/// Peaks that are no pairs; a file that cannot be written.
pub fn plot_validation_pairs(report: &ValidateReport, file: &Path) -> Result<(), UpliftError> {
    if report.key.is_empty() {
        return Err(JobError::Usage(
            "computed over measured peaks needs pairs: name the column that identifies the motion by --key".to_owned(),
        )
        .into());
    }
    write_figure_file(&pairs_figure(report), file)
}

/// Draws the risk of a frame beside its proxies as `file`, in the format of its ending.
///
/// # Errors
/// As [`write_figure_file`].
pub fn plot_frame_risk(report: &FrameRiskReport, file: &Path) -> Result<(), UpliftError> {
    write_figure_file(&frame_risk_figure(report), file)
}

/// Draws the spectra of all variants of a study as `file`, in the format of its ending.
///
/// # Errors
/// As [`write_figure_file`].
pub fn plot_sweep(report: &SweepReport, file: &Path) -> Result<(), UpliftError> {
    write_figure_file(&sweep_figure(report), file)
}

/// Which hazard curves are drawn, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct HazardPlotOptions {
    /// Tables with two columns, or exports of an engine.
    pub files: Vec<PathBuf>,
    /// Which of their curves, and what a table does not say.
    pub curves: CurveOptions,
    /// The figure, .svg or .png.
    pub output: PathBuf,
    /// Whether existing files are overwritten.
    pub force: bool,
}

/// Draws hazard curves in one figure.
///
/// # Errors
/// Curves that cannot be read, or are too many for one figure; a figure that would overwrite one of the files, or
/// cannot be written.
pub fn plot_hazard(options: &HazardPlotOptions, events: &dyn Events) -> Result<PlotReport, UpliftError> {
    check_figure_file(&options.output, &options.files, options.force)?;
    let curves = read_curves(&options.files, &options.curves, events)?;
    if curves.len() > MOST_CURVES {
        return Err(JobError::Usage(format!(
            "{} curves are too many for one figure: pick a site by --name or --near LON,LAT",
            curves.len()
        ))
        .into());
    }
    write_figure_file(&hazard_figure(&curves), &options.output)?;
    Ok(PlotReport { files: vec![options.output.clone()] })
}
