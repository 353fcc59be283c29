//! Figures as files.

use std::path::Path;

use uplift::UpliftError;
use uplift::result::write_atomically;
use uplift_plot::{Figure, Width, png, svg};

/// Resolution of a PNG, for print.
const DOTS_PER_INCH: f32 = 300.0;

/// Draw `figure` and write it to `path`: a PNG of 300 dots per inch where the name ends in `.png`, else an SVG.
///
/// # Errors
/// A figure that cannot be drawn, on a machine without fonts for instance; a file that cannot be written.
pub fn write_figure(figure: &Figure, width: Width, path: &Path) -> Result<(), UpliftError> {
    let drawing = svg(figure, width).map_err(|error| UpliftError::input(format!("{}: {error}", figure.id)))?;
    if path.extension().is_some_and(|extension| extension == "png") {
        let image = png(&drawing.svg, DOTS_PER_INCH).map_err(|error| UpliftError::input(error.to_string()))?;
        write_atomically(path, &image)
    } else {
        write_atomically(path, drawing.svg.as_bytes())
    }
}
