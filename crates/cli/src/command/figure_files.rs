//! Figures as files.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use uplift::UpliftError;
use uplift_plot::{Figure, Width};
use uplift_report::write_figure;

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
        let extensions: &[&str] = match self.format {
            Format::Svg => &["svg"],
            Format::Png => &["png"],
            Format::Both => &["png", "svg"],
        };
        let write = |extension: &&str| {
            let file = folder.join(format!("{}.{extension}", figure.id));
            write_figure(figure, width, &file)?;
            Ok(file)
        };
        extensions.iter().map(write).collect()
    }
}

/// A folder for figures.
pub(super) fn provide_folder(folder: &Path) -> Result<(), UpliftError> {
    std::fs::create_dir_all(folder)
        .map_err(|error| UpliftError::input(format!("{} cannot be written: {error}", folder.display())))
}
