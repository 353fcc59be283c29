//! How figures are written, as arguments.

use clap::{Args, ValueEnum};
use uplift_plot::{Look, Width};
use uplift_report::{FigureFormat, FigureOptions};

/// How figures are written.
#[derive(Debug, Args)]
pub(crate) struct FigureArguments {
    /// Format of the files
    #[arg(long, value_enum, default_value_t = Format::Svg)]
    format: Format,
    /// Width of a journal's column (90 mm) or page (190 mm)
    #[arg(long, value_enum, default_value_t = Columns::Double)]
    width: Columns,
    /// Write the title into the figure; left out, it is for the caption to say
    #[arg(long)]
    title: bool,
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
    pub(crate) fn options(&self) -> FigureOptions {
        FigureOptions {
            format: match self.format {
                Format::Svg => FigureFormat::Svg,
                Format::Png => FigureFormat::Png,
                Format::Both => FigureFormat::Both,
            },
            look: Look {
                width: match self.width {
                    Columns::Single => Width::Single,
                    Columns::Double => Width::Double,
                },
                title: self.title,
            },
        }
    }
}
