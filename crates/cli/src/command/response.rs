//! `uplift response`: one record through one oscillator or one rigid block, or components of one through a frame.

use std::path::PathBuf;

use clap::Args;
use uplift::response::{Response, ResponseOptions, response as respond};
use uplift_report::{check_figure_file, plot_block_response, plot_frame_response, plot_response};

use super::arguments::Overwriting;
use crate::error::CommandError;
use crate::show::{print_block_response, print_frame_response, print_json, print_response};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift response motion.at2 --strength 0.1 --plot history.svg\n  \
    uplift response motion.at2 --block --width-m 0.6 --height-m 3\n  \
    uplift response --structure configs/structures/footbridge.toml --h1 x.at2 --h2 y.at2")]
pub(super) struct ResponseArguments {
    #[command(flatten)]
    options: ResponseOptions,
    // the heading of the options before would hold here too
    /// Print JSON
    #[arg(long, help_heading = None::<&'static str>)]
    json: bool,
    /// Write the time history with uplifts and impacts
    #[arg(long, value_name = "FILE.csv", help_heading = None::<&'static str>)]
    history: Option<PathBuf>,
    /// Draw the time history
    #[arg(long, value_name = "FILE.svg|png", help_heading = None::<&'static str>)]
    plot: Option<PathBuf>,
    #[command(flatten, next_help_heading = None::<&'static str>)]
    overwriting: Overwriting,
}

pub(super) fn response(arguments: &ResponseArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let (figure, force) = (arguments.plot.as_deref(), arguments.overwriting.force);
    let (history, history_file) = (figure.is_some(), arguments.history.clone());
    let options = ResponseOptions { history, history_file, force, ..arguments.options.clone() };
    if let Some(figure) = figure {
        check_figure_file(figure, &options.inputs(), force)?;
    }
    let response = respond(&options)?;
    if let Some(figure) = figure {
        match &response {
            Response::Oscillator(report) => plot_response(report, figure),
            Response::Block(report) => plot_block_response(report, figure),
            Response::Frame(report) => plot_frame_response(report, figure),
        }?;
    }
    if arguments.json {
        return print_json(&response);
    }
    match &response {
        Response::Oscillator(report) => print_response(report, figure, terminal),
        Response::Block(report) => print_block_response(report, figure, terminal),
        Response::Frame(report) => print_frame_response(report, figure, terminal),
    }
}
