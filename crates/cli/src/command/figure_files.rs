//! Figures as files.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use uplift::UpliftError;
use uplift::result::write_atomically;
use uplift_plot::{Figure, Width, png, svg};

/// Of a PNG for print.
const DOTS_PER_INCH: f32 = 300.0;

/// How figures are written.
#[derive(Debug, Args)]
pub(super) struct FigureArguments {
    /// Format of the files
    #[arg(long, value_enum, default_value_t = Format::Svg)]
    format: Format,
    /// Width of a journal's column (90 mm) or page (190 mm)
    #[arg(long, value_enum, default_value_t = Columns::Double)]
    width: Columns,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Svg,
    Png,
    Both,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Columns {
    Single,
    Double,
}

impl FigureArguments {
    /// Write `figure` into `folder`; the files written.
    pub(super) fn write(&self, figure: &Figure, folder: &Path) -> Result<Vec<PathBuf>, UpliftError> {
        let width = match self.width {
            Columns::Single => Width::Single,
            Columns::Double => Width::Double,
        };
        let drawing = svg(figure, width).map_err(|error| UpliftError::input(format!("{}: {error}", figure.id)))?;
        let mut written = Vec::new();
        let mut write = |extension: &str, bytes: &[u8]| {
            let file = folder.join(format!("{}.{extension}", figure.id));
            write_atomically(&file, bytes)?;
            written.push(file);
            Ok::<(), UpliftError>(())
        };
        if self.format != Format::Svg {
            let image = png(&drawing.svg, DOTS_PER_INCH).map_err(|error| UpliftError::input(error.to_string()))?;
            write("png", &image)?;
        }
        if self.format != Format::Png {
            write("svg", drawing.svg.as_bytes())?;
        }
        Ok(written)
    }
}

/// A folder for figures.
pub(super) fn provide_folder(folder: &Path) -> Result<(), UpliftError> {
    std::fs::create_dir_all(folder)
        .map_err(|error| UpliftError::input(format!("{} cannot be written: {error}", folder.display())))
}
