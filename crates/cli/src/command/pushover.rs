//! `uplift pushover`: columns pushed sideways.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::Args;
use uplift::pushover::{PushoverOptions, pushover as compute};
use uplift::study::Structure;
use uplift_report::{check_figure_file, plot_pushover};

use super::arguments::{ForceArgument, number};
use super::protocol::ProtocolShape;
use crate::error::CommandError;
use crate::show::{print_json, print_pushover};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Structures to start from: configs/structures/column-j.toml, shake-table.toml. \
                  Method and a worked design: docs/restrained-columns.md")]
pub(super) struct PushoverArguments {
    /// Structure file (TOML): a block, a frame, or a restrained frame with its [restrainer]
    structure: PathBuf,
    /// Push up to this displacement, m [default: a little beyond the capacity]
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    to_m: Option<f64>,
    /// Rows, evenly spaced from 0
    #[arg(long, value_name = "N", default_value_t = PushoverOptions::default().rows)]
    rows: u32,
    /// The linearised law beside the exact one (Eq. 5.2 to 5.7, 6.1, 6.2)
    #[arg(long)]
    linear: bool,
    /// Linear restrainers of these stiffnesses beside the structure's own, N/m
    #[arg(
        long, value_name = "K[,K…]", value_delimiter = ',', allow_negative_numbers = true, value_parser = number
    )]
    stiffness_n_m: Vec<f64>,
    /// Tendons that are lost
    #[arg(long, value_name = "N", default_value_t = 0)]
    lost: u32,
    /// Put the columns through a loading protocol; stoppers that yield dissipate
    #[arg(long)]
    protocol: bool,
    #[command(flatten, next_help_heading = "Protocol")]
    shape: ProtocolShape,
    /// Lay a measured curve over it: CSV with displacement_m (or _mm, drift, drift_percent) and force_n (or force_kn)
    #[arg(long, value_name = "FILE.csv", help_heading = "Measured")]
    measured: Option<PathBuf>,
    /// Write the rows to this CSV file; of a protocol its history
    #[arg(short, long, value_name = "FILE.csv", help_heading = "Output")]
    output: Option<PathBuf>,
    /// Draw force over displacement as SVG or PNG
    #[arg(long, value_name = "FILE.svg|png", help_heading = "Output")]
    plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
    #[command(flatten, next_help_heading = "Output")]
    overwriting: ForceArgument,
}

pub(super) fn pushover(arguments: &PushoverArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let force = arguments.overwriting.force;
    if let Some(figure) = &arguments.plot {
        let inputs: Vec<&PathBuf> = [&arguments.structure].into_iter().chain(&arguments.measured).collect();
        check_figure_file(figure, &inputs, force)?;
    }
    let options = PushoverOptions {
        to_m: arguments.to_m,
        rows: arguments.rows,
        linear: arguments.linear,
        stiffnesses_n_m: arguments.stiffness_n_m.clone(),
        lost: arguments.lost,
        protocol: arguments.protocol.then(|| arguments.shape.protocol()).transpose()?,
        measured: arguments.measured.clone(),
        table: arguments.output.clone(),
        force,
    };
    let structure = Structure::load(&arguments.structure)?;
    let mut report = compute(&structure, &options, terminal)?;
    if let Some(figure) = &arguments.plot {
        plot_pushover(&report, figure)?;
        report.files.push(figure.clone());
    }
    if arguments.json { print_json(&report) } else { print_pushover(&report, terminal) }
}
