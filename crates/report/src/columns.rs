//! Figures of columns, restrainers and protocols, written.

use std::path::{Path, PathBuf};

use uplift::UpliftError;
use uplift::outputs::{self, provide_folder};
use uplift::pushover::{ProtocolReport, PushoverReport};
use uplift::restrainer::RestrainerCurve;
use uplift::study::Structure;

use crate::figures::{column_figures, protocol_figure, pushover_figure, restrainer_figure};
use crate::files::{FigureOptions, write_figure_file};
use crate::plot::none_called;
use crate::sheet::elevation;

/// Name of the drawing of a structure.
const ELEVATION: &str = "elevation";

/// Draws a pushover as `file`, in the format of its ending.
///
/// # Errors
/// A file that cannot be written.
pub fn plot_pushover(report: &PushoverReport, file: &Path) -> Result<(), UpliftError> {
    write_figure_file(&pushover_figure(report), file)
}

/// Draws a restrainer as `file`, in the format of its ending.
///
/// # Errors
/// A file that cannot be written.
pub fn plot_restrainer(report: &RestrainerCurve, file: &Path) -> Result<(), UpliftError> {
    write_figure_file(&restrainer_figure(report), file)
}

/// Draws a loading protocol as `file`, in the format of its ending.
///
/// # Errors
/// A file that cannot be written.
pub fn plot_protocol(report: &ProtocolReport, file: &Path) -> Result<(), UpliftError> {
    write_figure_file(&protocol_figure(report), file)
}

/// Draws every figure of a structure's columns into `folder`, and its elevation (as Fig. 5.4a and 6.3); the files
/// written.
///
/// # Errors
/// A figure that it does not have; a folder that cannot be written, or where the figures would replace something else.
pub fn plot_columns(
    structure: &Structure,
    report: &PushoverReport,
    folder: &Path,
    only: Option<&str>,
    options: FigureOptions,
    force: bool,
) -> Result<Vec<PathBuf>, UpliftError> {
    let figures = column_figures(report)?;
    let wanted = only.unwrap_or_default();
    let chosen: Vec<_> = figures.iter().filter(|figure| figure.id.contains(wanted)).collect();
    let drawn = ELEVATION.contains(wanted);
    if chosen.is_empty() && !drawn {
        let names = figures.iter().map(|figure| figure.id.as_str()).chain([ELEVATION]);
        return Err(none_called(wanted, "structure", names));
    }
    let ids = chosen.iter().map(|figure| figure.id.as_str()).chain(drawn.then_some(ELEVATION));
    outputs::check(&options.outputs(ids, folder), &[&structure.file], force)?;
    provide_folder(folder)?;
    let mark = outputs::mark();
    let mut files = Vec::new();
    for figure in chosen {
        files.extend(options.write(figure, folder, &mark)?);
    }
    if drawn {
        files.extend(options.write_svg(ELEVATION, &elevation(&structure.description), folder, &mark)?);
    }
    Ok(files)
}
