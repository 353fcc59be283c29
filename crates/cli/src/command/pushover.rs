//! `uplift pushover`: columns pushed sideways.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::Args;
use uplift::pushover::{PushoverOptions, pushover as compute};
use uplift::study::Structure;
use uplift_report::{check_figure_file, plot_pushover};

use super::arguments::Overwriting;
use super::protocol::ProtocolShape;
use crate::error::CommandError;
use crate::show::{print_json, print_pushover};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift pushover configs/structures/column-j.toml --plot pushover.svg\n\n\
                  Method and a worked design: docs/restrained-columns.md")]
pub(super) struct PushoverArguments {
    /// Structure file
    structure: PathBuf,
    #[command(flatten)]
    options: PushoverOptions,
    /// Apply a cyclic loading protocol
    #[arg(long)]
    protocol: bool,
    #[command(flatten, next_help_heading = "Protocol")]
    shape: ProtocolShape,
    /// Measured curve to compare: CSV with displacement_m (or _mm, drift) and force_n (or _kn)
    #[arg(long, value_name = "FILE.csv", help_heading = "Measured")]
    measured: Option<PathBuf>,
    /// Write the rows
    #[arg(short, long, value_name = "FILE.csv", help_heading = "Output")]
    output: Option<PathBuf>,
    /// Draw force over displacement
    #[arg(long, value_name = "FILE.svg|png", help_heading = "Output")]
    plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
    #[command(flatten, next_help_heading = "Output")]
    overwriting: Overwriting,
}

pub(super) fn pushover(arguments: &PushoverArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let force = arguments.overwriting.force;
    if let Some(figure) = &arguments.plot {
        let inputs: Vec<&PathBuf> = [&arguments.structure].into_iter().chain(&arguments.measured).collect();
        check_figure_file(figure, &inputs, force)?;
    }
    let options = PushoverOptions {
        protocol: arguments.protocol.then(|| arguments.shape.protocol()).transpose()?,
        measured: arguments.measured.clone(),
        table: arguments.output.clone(),
        force,
        ..arguments.options.clone()
    };
    let structure = Structure::load(&arguments.structure)?;
    let mut report = compute(&structure, &options, terminal)?;
    if let Some(figure) = &arguments.plot {
        plot_pushover(&report, figure)?;
        report.files.push(figure.clone());
    }
    if arguments.json { print_json(&report) } else { print_pushover(&report, terminal) }
}
