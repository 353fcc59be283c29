//! `uplift target`: the least strength, size, width, capacity or tendon stiffness for a target risk.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use uplift::structure::{TargetEvent, TargetFrequency, TargetOptions, target as run};
use uplift::typed::one_of;
use uplift_motion::IntensityMeasure;
use uplift_structure::Quantity;
use uplift_study::Structure;

use crate::command::arguments::{ForceArgument, KeepArgument, RARE, number, number_or_per_cent};
use crate::error::CommandError;
use crate::show::{print_json, print_target};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  uplift target configs/structures/pier.toml --urs results/study.h5 \
                  --vary width --overturning 2e-4",
    group = ArgGroup::new("frequency").required(true).args(["overturning", "per_year", "poe", "return_period"])
)]
pub(crate) struct TargetArguments {
    /// Structure file, e.g. configs/structures/frame.toml
    structure: PathBuf,
    /// Result file with the records and hazard
    #[arg(long, value_name = "RESULT")]
    urs: PathBuf,
    /// Manifest of the records, if it was moved
    #[arg(long, help_heading = RARE, value_name = "CSV")]
    manifest: Option<PathBuf>,
    /// Site [default: the only one]
    #[arg(long)]
    site: Option<String>,
    /// Intensity measure [default: pgv]
    #[arg(long)]
    measure: Option<IntensityMeasure>,
    /// Quantity to vary
    #[arg(long, value_parser = one_of(&Quantity::ALL, Quantity::key))]
    vary: Quantity,
    /// Target annual rate of overturning, e.g. 2e-4
    #[arg(
        long, value_name = "PER_YEAR", allow_negative_numbers = true, value_parser = number, conflicts_with = "exceed"
    )]
    overturning: Option<f64>,
    /// Target displacement, m, or `capacity`, instead of overturning
    #[arg(long, value_name = "M|capacity", allow_negative_numbers = true)]
    exceed: Option<String>,
    /// Divide the capacity of `--exceed capacity` by this safety factor
    #[arg(
        long, value_name = "FS", allow_negative_numbers = true, value_parser = number,
        default_value_t = 1.0
    )]
    safety_factor: f64,
    /// Target annual rate
    #[arg(long, value_name = "PER_YEAR", allow_negative_numbers = true, value_parser = number)]
    per_year: Option<f64>,
    /// Target probability, 0.01 or 1%, in --years
    #[arg(long, value_name = "P", allow_negative_numbers = true, value_parser = number_or_per_cent)]
    poe: Option<f64>,
    /// Target return period, years
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    return_period: Option<f64>,
    /// Years of the probability [default: the study's]
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number, requires = "poe")]
    years: Option<f64>,
    /// Smallest value to try, SI units [default: a quarter of the structure's]
    #[arg(long, help_heading = RARE, value_name = "VALUE", allow_negative_numbers = true, value_parser = number)]
    from: Option<f64>,
    /// Largest value to try [default: four times the structure's]
    #[arg(long, help_heading = RARE, value_name = "VALUE", allow_negative_numbers = true, value_parser = number)]
    to: Option<f64>,
    /// Relative tolerance of the value
    #[arg(
        long, help_heading = RARE, value_name = "SHARE", allow_negative_numbers = true, value_parser = number,
        default_value_t = 0.005
    )]
    tolerance: f64,
    /// Return periods, years, at whose levels the fragility is reported
    #[arg(
        long, help_heading = RARE,
        value_name = "YEARS[,…]",
        value_delimiter = ',',
        allow_negative_numbers = true,
        value_parser = number,
        default_values_t = [475.0, 2475.0]
    )]
    at: Vec<f64>,
    /// Dispersion of a generic lognormal fragility to compare with
    #[arg(long, help_heading = RARE, value_name = "BETA", allow_negative_numbers = true, value_parser = number)]
    generic_dispersion: Option<f64>,
    /// Probability of that fragility at the design level
    #[arg(
        long, help_heading = RARE,
        value_name = "P",
        allow_negative_numbers = true,
        value_parser = number_or_per_cent,
        default_value_t = 0.1,
        requires = "generic_dispersion"
    )]
    generic_probability: f64,
    /// Judge the proxy alone, without the wobbling frame
    #[arg(long)]
    proxy: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write all values tried with their risks
    #[arg(long, short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    #[command(flatten)]
    keeping: KeepArgument,
    #[command(flatten)]
    overwriting: ForceArgument,
}

impl TargetArguments {
    fn options(&self) -> Result<TargetOptions, CommandError> {
        let event = match self.exceed.as_deref() {
            Some("capacity") => TargetEvent::BeyondCapacity(self.safety_factor),
            _ if self.safety_factor != 1.0 => {
                return Err(CommandError::Usage(
                    "--safety-factor divides a capacity: give --exceed capacity".to_owned(),
                ));
            }
            None => TargetEvent::Overturning,
            Some(text) => TargetEvent::Beyond(
                number(text)
                    .map_err(|error| CommandError::Usage(format!("--exceed {text}: {error}, or `capacity`")))?,
            ),
        };
        let frequency = match (self.overturning.or(self.per_year), self.poe, self.return_period) {
            (Some(per_year), ..) => TargetFrequency::PerYear(per_year),
            (None, Some(poe), _) => TargetFrequency::Probability(poe, self.years),
            (None, None, years) => TargetFrequency::ReturnPeriod(years.unwrap_or_default()),
        };
        Ok(TargetOptions {
            manifest: self.manifest.clone(),
            site: self.site.clone(),
            measure: self.measure,
            from: self.from,
            to: self.to,
            tolerance: self.tolerance,
            return_periods: self.at.clone(),
            generic: self.generic_dispersion.map(|dispersion| (dispersion, self.generic_probability)),
            proxy: self.proxy,
            table: self.output.clone(),
            force: self.overwriting.force,
            ..TargetOptions::new(self.vary, event, frequency)
        })
    }
}

pub(crate) fn target(arguments: &TargetArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = arguments.options()?;
    let structure = Structure::load(&arguments.structure)?;
    let report = run(&structure, &arguments.urs, &options, terminal)?;
    arguments.keeping.keep(|| Ok(report.finding(&structure, &options)?), &arguments.urs, terminal)?;
    if arguments.json { print_json(&report) } else { print_target(&report, terminal) }?;
    for file in &report.files {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
