//! `uplift export`: a result for other programs.

use std::path::PathBuf;

use clap::Args;
use uplift::Events;
use uplift::export::{ExportFormat, ExportOptions, export as export_result};
use uplift::fragility::{FragilityFormat, FragilityOf, FragilityOptions, export_fragility};
use uplift::result::AskedRisk;
use uplift::study::Structure;
use uplift_motion::IntensityMeasure;

use crate::command::arguments::{ForceArgument, Numbers, number_or_per_cent, numbers};
use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift export results/quick.h5 --xlsx\n  \
    uplift export results/quick.h5 --fragility openquake --strength 0.2 --displacement-m 0.1,0.3\n  \
    uplift export results/quick.h5 --fragility csv --structure configs/structures/pier.toml")]
#[expect(clippy::struct_excessive_bools, reason = "a switch for each format")]
pub(crate) struct ExportArguments {
    /// Result file
    result: PathBuf,
    /// CSV table, one row an ordinate, with fit, flag and bands
    #[arg(long)]
    csv: bool,
    /// JSON with spectra, bands, coefficients and warnings
    #[arg(long)]
    json: bool,
    /// MATLAB file
    #[arg(long)]
    mat: bool,
    /// Excel workbook with spectra, bands, coefficients and hazard
    #[arg(long)]
    xlsx: bool,
    /// Stripes and hazard as JSON, for the browser page
    #[arg(long)]
    web: bool,
    #[command(flatten, next_help_heading = "Fragility")]
    fragility: FragilityArguments,
    /// Output file, for one format [default: beside the result]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    risk: AskedRisk,
    #[command(flatten)]
    overwriting: ForceArgument,
}

/// Fragilities in place of spectra.
#[derive(Debug, Args)]
struct FragilityArguments {
    /// Fragilities for another program, in place of spectra
    #[arg(long, value_enum, value_name = "openquake|pelicun|csv", hide_possible_values = true,
        conflicts_with_all = ["csv", "json", "mat", "xlsx", "web", "poe", "return_period", "years"])]
    fragility: Option<FragilityFormat>,
    /// Displacements that are exceeded, m
    #[arg(long, value_name = "M[,…]", allow_negative_numbers = true, value_parser = numbers,
        requires_all = ["fragility", "strength"])]
    displacement_m: Vec<Numbers>,
    /// Uplift strengths of the result, for --displacement-m
    #[arg(long, value_name = "STRENGTH[,…]", allow_negative_numbers = true, value_parser = numbers,
        requires = "displacement_m")]
    strength: Vec<Numbers>,
    /// Structure file: fragilities of its limit states
    #[arg(long, value_name = "FILE", requires = "fragility", conflicts_with = "displacement_m")]
    structure: Option<PathBuf>,
    /// Share of the capacity that is a limit state too
    #[arg(long, value_name = "SHARE", requires = "structure", default_value = "0.5", allow_negative_numbers = true,
        value_parser = number_or_per_cent)]
    capacity_share: f64,
    /// Manifest of the records, if it was moved
    #[arg(long, value_name = "CSV", requires = "structure")]
    manifest: Option<PathBuf>,
    /// Intensity measure of the fragilities [default: all]
    #[arg(long, requires = "fragility")]
    measure: Option<IntensityMeasure>,
}

impl FragilityArguments {
    /// What is exceeded.
    fn of(&self) -> Result<FragilityOf, CommandError> {
        let all = |several: &[Numbers]| several.iter().flat_map(|Numbers(all)| all.iter().copied()).collect();
        Ok(match &self.structure {
            Some(file) => FragilityOf::Structure {
                structure: Box::new(Structure::load(file)?),
                manifest: self.manifest.clone(),
                capacity_share: self.capacity_share,
            },
            None => FragilityOf::Displacements {
                displacements_m: all(&self.displacement_m),
                strengths: all(&self.strength),
            },
        })
    }
}

impl ExportArguments {
    fn formats(&self) -> Vec<ExportFormat> {
        let wanted = [
            (self.csv, ExportFormat::Csv),
            (self.json, ExportFormat::Json),
            (self.mat, ExportFormat::Matlab),
            (self.xlsx, ExportFormat::Workbook),
            (self.web, ExportFormat::Web),
        ];
        wanted.into_iter().filter_map(|(wanted, format)| wanted.then_some(format)).collect()
    }
}

pub(crate) fn export(arguments: &ExportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(format) = arguments.fragility.fragility {
        let options = FragilityOptions {
            result: arguments.result.clone(),
            format,
            of: arguments.fragility.of()?,
            measure: arguments.fragility.measure,
            output: arguments.output.clone(),
            force: arguments.overwriting.force,
        };
        let report = export_fragility(&options, terminal)?;
        for note in &report.notes {
            terminal.note(note);
        }
        return print_files(&report.files, terminal);
    }
    let options = ExportOptions {
        result: arguments.result.clone(),
        formats: arguments.formats(),
        output: arguments.output.clone(),
        risk: arguments.risk.clone(),
        force: arguments.overwriting.force,
    };
    print_files(&export_result(&options, terminal)?.files, terminal)
}
