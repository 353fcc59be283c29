//! `uplift restrainer design`: stacks out of a catalogue.

use std::path::PathBuf;

use clap::Args;
use uplift::restrainer::{RestrainerDesignOptions, design as compute};
use uplift::study::Structure;

use crate::command::arguments::Overwriting;
use crate::error::CommandError;
use crate::show::{print_answer_json, print_json, print_restrainer_design};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift restrainer design configs/structures/column-j.toml \\\n    \
                  --catalogue configs/structures/disc-springs.csv --capacity-m 0.5\n\n\
                  The tendon, its prestress and its path come from [restrainer] in the structure file; before a stack \
                  is chosen its kind is \"tendon\". A worked design: docs/restrained-columns.md")]
pub(super) struct DesignArguments {
    /// Structure file: a restrained frame with its tendon
    structure: PathBuf,
    #[command(flatten)]
    options: RestrainerDesignOptions,
    /// Print JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
    #[command(flatten, next_help_heading = "Output")]
    overwriting: Overwriting,
}

pub(super) fn design(arguments: &DesignArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let structure = Structure::load(&arguments.structure)?;
    let options = RestrainerDesignOptions { force: arguments.overwriting.force, ..arguments.options.clone() };
    let report = compute(&structure, &options, terminal)?;
    match &options.urs {
        Some(urs) if arguments.json => print_answer_json(&report, urs),
        None if arguments.json => print_json(&report),
        urs => print_restrainer_design(&report, options.most, urs.as_deref(), terminal),
    }
}
