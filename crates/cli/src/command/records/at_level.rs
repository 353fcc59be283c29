//! `uplift records at-level`: from what tools of record selection write to a table of sets at each level.

use std::path::PathBuf;

use clap::Args;
use uplift::records::{AtLevelOptions, at_level as write_at_level};
use uplift_motion::IntensityMeasure;

use crate::command::arguments::{ForceArgument, number};
use crate::error::CommandError;
use crate::show::print_at_level;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct AtLevelArguments {
    /// What the tool wrote, a file a level
    #[arg(
        required = true,
        value_name = "FILE",
        help = "What the tool wrote, a file a level: haselREC's ..._summary_selection.txt, CS_Selection's \
                Output_File.dat, EzGM's GMR_H1_names.txt or GMR_names.txt (GMR_sf_used.txt lies beside it), Djura's \
                records_....json"
    )]
    selections: Vec<PathBuf>,
    /// Manifest of a record set (CSV) that has the records, as `uplift records import` writes it
    #[arg(long, value_name = "SET")]
    manifest: PathBuf,
    /// The measure that they were selected for
    #[arg(
        long,
        value_name = "MEASURE",
        help = "The measure that they were selected for: pgv, pga, sa_1s (SA at 0.5 s is sa_0p5s), ..."
    )]
    measure: IntensityMeasure,
    /// The level of each file, in their order, in cm/s or g; haselREC and Djura write it themselves
    #[arg(long = "level", value_name = "LEVEL,...", value_delimiter = ',', value_parser = number)]
    levels: Vec<f64>,
    /// Let each pair stand as two records, one a component, for a study with component = "both"
    #[arg(long)]
    both: bool,
    /// The table to write (CSV)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(super) fn at_level(arguments: &AtLevelArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = AtLevelOptions {
        selections: arguments.selections.clone(),
        manifest: arguments.manifest.clone(),
        measure: arguments.measure,
        levels: arguments.levels.clone(),
        both: arguments.both,
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    print_at_level(&write_at_level(&options)?, terminal)
}
