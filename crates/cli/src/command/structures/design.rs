//! `uplift design`: a structure against a uniform risk spectrum, and against its own risk.

use std::path::PathBuf;

use clap::Args;
use uplift::structure::{DesignOptions, design as run, design_shard};
use uplift_motion::IntensityMeasure;
use uplift_report::{check_design_sheet, write_design_sheet};

use crate::command::arguments::{ForceArgument, OneRiskArguments, StructureArguments, number};
use crate::error::CommandError;
use crate::show::{print_design, print_json, print_shard};
use crate::terminal::Terminal;

#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift design configs/structures/pier.toml --urs results/study.h5")]
pub(crate) struct DesignArguments {
    #[command(flatten)]
    structure: StructureArguments,
    /// Site [default: the only one]
    #[arg(long)]
    site: Option<String>,
    #[command(flatten)]
    risk: OneRiskArguments,
    /// Intensity measure [default: pgv]
    #[arg(long)]
    measure: Option<IntensityMeasure>,
    /// Use records weighted for hazard consistency (uplift consistency --repair)
    #[arg(long)]
    repaired: bool,
    /// Safety factor on the demand (Eq. 3.15)
    #[arg(
        long,
        value_name = "FS",
        default_value_t = DesignOptions::default().safety_factor,
        allow_negative_numbers = true,
        value_parser = number,
    )]
    safety_factor: f64,
    /// Apply the rules to the spectrum without analysing the structure
    #[arg(long)]
    spectrum_only: bool,
    /// Judge the proxy alone, without the wobbling frame
    #[arg(long)]
    proxy: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write a design sheet
    #[arg(long, value_name = "FILE.html", conflicts_with = "shard")]
    report: Option<PathBuf>,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(crate) fn design(arguments: &DesignArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let StructureArguments { urs, manifest, shard, shards, .. } = &arguments.structure;
    if let Some(file) = &arguments.report {
        check_design_sheet(file, urs, &arguments.structure.inputs(), arguments.overwriting.force)?;
    }
    let options = DesignOptions {
        manifest: manifest.clone(),
        site: arguments.site.clone(),
        risk: arguments.risk.asked(),
        measure: arguments.measure,
        repaired: arguments.repaired,
        safety_factor: arguments.safety_factor,
        spectrum_only: arguments.spectrum_only,
        proxy: arguments.proxy,
        shards: shards.clone(),
    };
    let structure = arguments.structure.load()?;
    if let Some(shard) = shard {
        return print_shard(&design_shard(&structure, urs, &options, *shard, terminal)?, terminal);
    }
    let report = run(&structure, urs, &options, terminal)?;
    if let Some(file) = &arguments.report {
        write_design_sheet(&structure, &report, file)?;
    }
    arguments.structure.keeping.keep(|| Ok(report.finding(&structure)?), urs, terminal)?;
    if arguments.json { print_json(&report) } else { print_design(&report, terminal) }?;
    if let Some(file) = &arguments.report {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
