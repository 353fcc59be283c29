//! `uplift restrainer`: tendons and disc springs, looked at and chosen.

mod curve;
mod design;

use clap::{Args, Subcommand};

use crate::error::CommandError;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct RestrainerArguments {
    #[command(subcommand)]
    command: RestrainerCommand,
}

#[derive(Debug, Subcommand)]
enum RestrainerCommand {
    /// Force over elongation of a restrainer (Figures 5.9, 6.8)
    Curve(curve::CurveArguments),
    /// Stacks out of a catalogue that give the columns of a structure what they need (Sections 5.3.3, 6.3.3)
    Design(Box<design::DesignArguments>),
}

pub(super) fn restrainer(arguments: &RestrainerArguments, terminal: &Terminal) -> Result<(), CommandError> {
    match &arguments.command {
        RestrainerCommand::Curve(arguments) => curve::curve(arguments, terminal),
        RestrainerCommand::Design(arguments) => design::design(arguments, terminal),
    }
}
