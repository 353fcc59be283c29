//! `uplift hazard plot`: curves in one figure.

use std::path::PathBuf;

use clap::Args;

use super::{CommandError, NamedCurve, SiteArguments, TableArguments, Terminal, distinct, read};
use crate::command::records::refuse_overwriting;
use uplift::result::write_atomically;
use uplift_plot::{Width, png, svg};
use uplift_report::figures::hazard_figure;

/// Of a PNG for print.
const DOTS_PER_INCH: f32 = 300.0;
/// Curves that a figure can tell apart, and then some.
const MOST_CURVES: usize = 50;

#[derive(Debug, Args)]
pub(super) struct PlotArguments {
    /// Tables with two columns, or exports of OpenQuake or the USGS
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The figure, .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    site: SiteArguments,
    #[command(flatten)]
    table: TableArguments,
}

pub(super) fn plot(arguments: &PlotArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let output = &arguments.output;
    let extension = output.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if !["svg", "png"].contains(&extension) {
        return Err(CommandError::Usage(format!("-o {}: give a name that ends in .svg or .png", output.display())));
    }
    let inputs: Vec<&std::path::Path> = arguments.files.iter().map(PathBuf::as_path).collect();
    refuse_overwriting(output, &inputs)?;
    let mut curves = Vec::new();
    for file in distinct(&arguments.files) {
        curves.extend(read(file, &arguments.site, &arguments.table)?);
    }
    if curves.len() > MOST_CURVES {
        return Err(CommandError::Usage(format!(
            "{} curves cannot be told apart in one figure: pick a site by --name or --near LON,LAT",
            curves.len()
        )));
    }
    let named: Vec<(String, _)> = curves.into_iter().map(|NamedCurve { name, curve }| (name, curve)).collect();
    let figure = hazard_figure(&named);
    let drawing = svg(&figure, Width::Double).map_err(CommandError::input)?;
    let bytes = match extension {
        "png" => png(&drawing.svg, DOTS_PER_INCH).map_err(|error| CommandError::input(error.to_string()))?,
        _ => drawing.svg.into_bytes(),
    };
    write_atomically(output, &bytes)?;
    terminal.say(&output.display().to_string());
    Ok(())
}
