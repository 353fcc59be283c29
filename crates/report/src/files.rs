//! Figures as files.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use uplift::UpliftError;
use uplift::result::write_atomically;
use uplift_plot::{Figure, Width, png, svg};

/// Of a PNG for print.
const DOTS_PER_INCH: f32 = 300.0;

/// Formats of figure files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FigureFormat {
    /// SVG.
    #[default]
    Svg,
    /// PNG, 300 dots an inch.
    Png,
    /// A file of each.
    Both,
}

/// How figures are written into a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FigureOptions {
    /// Format of the files.
    pub format: FigureFormat,
    /// Width of a journal's column (90 mm) or page (190 mm).
    pub width: Width,
}

impl Default for FigureOptions {
    fn default() -> Self {
        Self { format: FigureFormat::Svg, width: Width::Double }
    }
}

impl FigureOptions {
    /// Writes `figure` into `folder`, which is there; the files written.
    ///
    /// # Errors
    /// A file that cannot be written, and no font for a PNG.
    pub fn write(&self, figure: &Figure, folder: &Path) -> Result<Vec<PathBuf>, UpliftError> {
        let drawing = svg(figure, self.width).map_err(|reason| refused(figure, reason))?;
        let mut written = Vec::new();
        let mut write = |extension: &str, bytes: &[u8]| {
            let file = folder.join(format!("{}.{extension}", figure.id));
            write_atomically(&file, bytes)?;
            written.push(file);
            Ok::<(), UpliftError>(())
        };
        if self.format != FigureFormat::Svg {
            let image = png(&drawing.svg, DOTS_PER_INCH).map_err(|error| refused(figure, error))?;
            write("png", &image)?;
        }
        if self.format != FigureFormat::Png {
            write("svg", drawing.svg.as_bytes())?;
        }
        Ok(written)
    }
}

/// Refuses a name that does not tell the format of a figure, before anything is computed.
///
/// # Errors
/// [`UpliftError::Usage`] where `file` ends neither in .svg nor in .png.
pub fn check_figure_file(file: &Path) -> Result<(), UpliftError> {
    let told = file.extension().is_some_and(|extension| extension == "svg" || extension == "png");
    if told {
        return Ok(());
    }
    Err(UpliftError::Usage(format!("{}: give a name that ends in .svg or .png", file.display())))
}

/// Writes `figure`, as wide as a page, to `file`, whose ending tells the format.
///
/// # Errors
/// As [`check_figure_file`]; a file that cannot be written, and no font for a PNG.
pub fn write_figure_file(figure: &Figure, file: &Path) -> Result<(), UpliftError> {
    check_figure_file(file)?;
    let drawing = svg(figure, Width::Double).map_err(|reason| refused(figure, reason))?;
    if file.extension().is_some_and(|extension| extension == "png") {
        write_atomically(file, &png(&drawing.svg, DOTS_PER_INCH).map_err(|error| refused(figure, error))?)
    } else {
        write_atomically(file, drawing.svg.as_bytes())
    }
}

/// A figure that the drawing library does not draw.
pub(crate) fn refused(figure: &Figure, reason: impl Display) -> UpliftError {
    UpliftError::input(format!("{}: {reason}", figure.id))
}
