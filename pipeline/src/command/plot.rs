//! `uplift plot`: the figures of a result as files.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::Session;
use super::result_of::ResultArguments;
use super::run::shown_path;
use crate::error::UpliftError;
use crate::figures::FigureSource;
use crate::plot::{Width, png, svg};
use crate::result::StoredStripes;

/// Of a PNG for print.
const DOTS_PER_INCH: f32 = 300.0;

#[derive(Debug, Args)]
pub(super) struct PlotArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Folder for the figures [default: beside the result, named after it]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Only figures whose name contains this, for instance urs
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
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

pub(super) fn plot(arguments: &PlotArguments, session: &Session) -> Result<(), UpliftError> {
    let path = arguments.result.find(session)?.path;
    let figures = FigureSource::new(StoredStripes::read(&path)?)?.figures()?;
    let wanted = arguments.only.as_deref().unwrap_or_default();
    let chosen: Vec<_> = figures.iter().filter(|figure| figure.id.contains(wanted)).collect();
    if chosen.is_empty() {
        let names: Vec<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
        return Err(UpliftError::Usage(format!("--only {wanted}: the result has the figures {}", names.join(", "))));
    }
    let folder = arguments.output.clone().unwrap_or_else(|| path.with_extension("figures"));
    std::fs::create_dir_all(&folder).map_err(|error| cannot_write(&folder, &error))?;
    let width = match arguments.width {
        Columns::Single => Width::Single,
        Columns::Double => Width::Double,
    };
    let mut out = std::io::stdout().lock();
    for figure in chosen {
        let drawing = svg(figure, width).map_err(|error| UpliftError::input(format!("{}: {error}", figure.id)))?;
        let mut files = Vec::new();
        if arguments.format != Format::Png {
            files.push(("svg", drawing.svg.clone().into_bytes()));
        }
        if arguments.format != Format::Svg {
            let image = png(&drawing.svg, DOTS_PER_INCH).map_err(|error| UpliftError::input(error.to_string()))?;
            files.push(("png", image));
        }
        for (extension, bytes) in files {
            let file = folder.join(format!("{}.{extension}", figure.id));
            std::fs::write(&file, bytes).map_err(|error| cannot_write(&file, &error))?;
            if !session.quiet {
                writeln!(out, "{}", shown_path(&file).display())?;
            }
        }
    }
    Ok(())
}

fn cannot_write(path: &Path, error: &std::io::Error) -> UpliftError {
    UpliftError::input(format!("{} cannot be written: {error}", path.display()))
}
