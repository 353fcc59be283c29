//! `uplift design`: a structure against a uniform risk spectrum, and against its own risk.

use std::path::PathBuf;

use clap::Args;
use uplift::structure::{DesignOptions, design as run, design_shard};
use uplift_report::{check_design_sheet, write_design_sheet};

use crate::command::arguments::{Overwriting, StructureArguments};
use crate::error::CommandError;
use crate::show::{print_answer_json, print_design, print_shard};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift design configs/structures/pier.toml --urs results/study.h5")]
pub(crate) struct DesignArguments {
    #[command(flatten)]
    structure: StructureArguments,
    #[command(flatten)]
    options: DesignOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write a design sheet
    #[arg(long, value_name = "FILE.html", conflicts_with = "shard")]
    report: Option<PathBuf>,
    #[command(flatten)]
    overwriting: Overwriting,
}

pub(crate) fn design(arguments: &DesignArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let StructureArguments { urs, manifest, shard, shards, .. } = &arguments.structure;
    if let Some(file) = &arguments.report {
        check_design_sheet(file, urs, &arguments.structure.inputs(), arguments.overwriting.force)?;
    }
    let is_written = arguments.json || arguments.report.is_some();
    let sensitivity = arguments.structure.asks_for_sensitivity(is_written, terminal);
    let (manifest, shards) = (manifest.clone(), shards.clone());
    let options = DesignOptions { manifest, shards, sensitivity, ..arguments.options.clone() };
    let structure = arguments.structure.load()?;
    if let Some(shard) = shard {
        return print_shard(&design_shard(&structure, urs, &options, *shard, terminal)?, terminal);
    }
    let report = run(&structure, urs, &options, terminal)?;
    if let Some(file) = &arguments.report {
        write_design_sheet(&structure, &report, file)?;
    }
    arguments.structure.keeping.keep(|| Ok(report.finding(&structure)?), urs, terminal)?;
    if arguments.json { print_answer_json(&report, urs) } else { print_design(&report, terminal) }?;
    if let Some(file) = &arguments.report {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
