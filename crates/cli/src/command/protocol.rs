//! `uplift protocol`: cyclic loading protocols.

use std::path::PathBuf;

use clap::Args;
use uplift::UpliftError;
use uplift::pushover::{ProtocolOptions, protocol as compute};
use uplift_report::{check_figure_file, plot_protocol};
use uplift_statics::LoadingProtocol;

use super::arguments::{Overwriting, number};
use crate::error::CommandError;
use crate::show::{print_json, print_protocol};
use crate::terminal::Terminal;

/// Sets of equal cycles; left out, those of Section 5.4.
#[derive(Debug, Args)]
pub(super) struct ProtocolShape {
    /// Amplitude of the first set, as a drift ratio
    #[arg(long, value_name = "DRIFT", default_value_t = 0.0036, allow_negative_numbers = true, value_parser = number)]
    first: f64,
    /// Factor from the amplitude of a set to that of the next
    #[arg(long, value_name = "R", default_value_t = 1.25, allow_negative_numbers = true, value_parser = number)]
    ratio: f64,
    /// Number of sets
    #[arg(long, value_name = "N", default_value_t = 18)]
    sets: u32,
    /// Cycles in a set
    #[arg(long, value_name = "N", default_value_t = 2)]
    cycles: u32,
    /// Rate of drift, 1/s
    #[arg(long, value_name = "RATE", default_value_t = 1.38e-4, allow_negative_numbers = true, value_parser = number)]
    rate: f64,
}

impl ProtocolShape {
    pub(super) fn protocol(&self) -> Result<LoadingProtocol, CommandError> {
        LoadingProtocol::new(self.first, self.ratio, self.sets, self.cycles, self.rate)
            .map_err(|error| CommandError::from(UpliftError::from(error)))
    }
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift protocol --sets 12 -o protocol.csv --plot protocol.svg")]
pub(super) struct ProtocolArguments {
    #[command(flatten)]
    shape: ProtocolShape,
    #[command(flatten)]
    options: ProtocolOptions,
    /// Draw the protocol
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwriting: Overwriting,
}

pub(super) fn protocol(arguments: &ProtocolArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let force = arguments.overwriting.force;
    if let Some(figure) = &arguments.plot {
        let nothing: [PathBuf; 0] = [];
        check_figure_file(figure, &nothing, force)?;
    }
    let options = ProtocolOptions { protocol: arguments.shape.protocol()?, force, ..arguments.options.clone() };
    let mut report = compute(&options, terminal)?;
    if let Some(figure) = &arguments.plot {
        plot_protocol(&report, figure)?;
        report.files.push(figure.clone());
    }
    if arguments.json { print_json(&report) } else { print_protocol(&report, terminal) }
}
