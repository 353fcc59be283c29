//! How figures are written, as arguments.

use std::ops::RangeInclusive;

use clap::{Args, ValueEnum};
use uplift_plot::{Look, Width};
use uplift_report::{DOTS_PER_INCH, FigureFormat, FigureOptions};

/// From half a column to a poster: narrower, the letters of a legend do not fit.
const WIDTHS_MM: RangeInclusive<i64> = 60..=500;

/// How figures are written.
#[derive(Debug, Args)]
pub(crate) struct FigureArguments {
    /// File format
    #[arg(long, value_enum, default_value_t = Format::Svg)]
    format: Format,
    /// Width: one column (90 mm) or a page (190 mm)
    #[arg(long, value_enum, default_value_t = Columns::Double)]
    width: Columns,
    /// Other width, mm; below 140 mm panels are stacked
    #[arg(
        long,
        value_name = "MM",
        conflicts_with = "width",
        value_parser = clap::value_parser!(u16).range(WIDTHS_MM)
    )]
    width_mm: Option<u16>,
    /// Resolution of a PNG, dots per inch
    #[arg(
        long,
        value_name = "N",
        default_value_t = DOTS_PER_INCH,
        value_parser = clap::value_parser!(u16).range(72..=1200)
    )]
    dpi: u16,
    /// Write the title into the figure
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
                width: match (self.width_mm, self.width) {
                    (Some(width), _) => Width::Millimetres(width),
                    (None, Columns::Single) => Width::Single,
                    (None, Columns::Double) => Width::Double,
                },
                title: self.title,
            },
            dots_per_inch: self.dpi,
        }
    }
}
