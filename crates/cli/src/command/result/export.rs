//! `uplift export`: a result for other programs.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use uplift::Events;
use uplift::demand::{DemandOf, DemandOptions, export_demand};
use uplift::export::{ExportFormat, ExportOptions, export as export_result};
use uplift::fragility::{FragilityFormat, FragilityOf, FragilityOptions, export_fragility};
use uplift::result::AskedRisk;
use uplift::structure::CAPACITY_SHARE;
use uplift::study::Structure;
use uplift_motion::IntensityMeasure;

use crate::command::arguments::{Numbers, Overwriting, all_numbers, number_or_per_cent, numbers};
use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift export results/quick.h5 --xlsx\n  \
    uplift export results/quick.h5 --fragility openquake --strength 0.2 --displacement-m 0.1,0.3\n  \
    uplift export results/quick.h5 --fragility csv --structure configs/structures/pier.toml\n  \
    uplift export results/quick.h5 --demand Athens --return-period 475 --strength 0.2")]
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
    #[command(flatten, next_help_heading = "Fragility and demand")]
    assessment: AssessmentArguments,
    /// Output file, for one format [default: beside the result]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    risk: AskedRisk,
    #[command(flatten)]
    overwriting: Overwriting,
}

/// Fragilities or demands in place of spectra.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("assessment").args(["fragility", "demand"])
    .conflicts_with_all(["csv", "json", "mat", "xlsx", "web"]))]
struct AssessmentArguments {
    /// Fragilities for another program, in place of spectra
    #[arg(long, value_enum, value_name = "openquake|pelicun|csv", hide_possible_values = true,
        conflicts_with_all = ["poe", "return_period", "years"])]
    fragility: Option<FragilityFormat>,
    /// Demands for pelicun at the intensity that this site exceeds with --poe
    #[arg(long, value_name = "SITE")]
    demand: Option<String>,
    /// Displacements that are exceeded, m
    #[arg(long, value_name = "M[,…]", allow_negative_numbers = true, value_parser = numbers,
        requires_all = ["fragility", "strength"], conflicts_with = "demand")]
    displacement_m: Vec<Numbers>,
    /// Uplift strengths of the result
    #[arg(long, value_name = "STRENGTH[,…]", allow_negative_numbers = true, value_parser = numbers,
        requires = "assessment")]
    strength: Vec<Numbers>,
    /// Structure file, in place of strengths
    #[arg(long, value_name = "FILE", requires = "assessment", conflicts_with_all = ["displacement_m", "strength"])]
    structure: Option<PathBuf>,
    /// Share of the capacity that is a limit state too
    #[arg(long, value_name = "SHARE", requires = "structure", conflicts_with = "demand",
        default_value_t = CAPACITY_SHARE, allow_negative_numbers = true, value_parser = number_or_per_cent)]
    capacity_share: f64,
    /// Manifest of the records, if it was moved
    #[arg(long, value_name = "CSV", requires = "structure", conflicts_with = "strength")]
    manifest: Option<PathBuf>,
    /// Intensity measure [default: all; of demands the first]
    #[arg(long, requires = "assessment")]
    measure: Option<IntensityMeasure>,
}

impl AssessmentArguments {
    fn structure(&self) -> Result<Option<Box<Structure>>, CommandError> {
        Ok(self.structure.as_deref().map(Structure::load).transpose()?.map(Box::new))
    }

    /// What is exceeded.
    fn exceeded(&self) -> Result<FragilityOf, CommandError> {
        Ok(match self.structure()? {
            Some(structure) => FragilityOf::Structure {
                structure,
                manifest: self.manifest.clone(),
                capacity_share: self.capacity_share,
            },
            None => FragilityOf::Displacements {
                displacements_m: all_numbers(&self.displacement_m),
                strengths: all_numbers(&self.strength),
            },
        })
    }

    /// What is displaced.
    fn displaced(&self) -> Result<DemandOf, CommandError> {
        Ok(match self.structure()? {
            Some(structure) => DemandOf::Structure { structure, manifest: self.manifest.clone() },
            None => DemandOf::Strengths(all_numbers(&self.strength)),
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
    let ExportArguments { result, assessment, output, risk, overwriting, .. } = arguments;
    let (result, output, force) = (result.clone(), output.clone(), overwriting.force);
    if let Some(format) = assessment.fragility {
        let (of, measure) = (assessment.exceeded()?, assessment.measure);
        let report = export_fragility(&FragilityOptions { result, format, of, measure, output, force }, terminal)?;
        for note in &report.notes {
            terminal.note(note);
        }
        return print_files(&report.files, terminal);
    }
    let risk = risk.clone();
    if let Some(site) = assessment.demand.clone() {
        let (of, measure) = (assessment.displaced()?, assessment.measure);
        let report = export_demand(&DemandOptions { result, of, site, risk, measure, output, force }, terminal)?;
        terminal.note(&report.words());
        return print_files(&report.files, terminal);
    }
    let options = ExportOptions { result, formats: arguments.formats(), output, risk, force };
    print_files(&export_result(&options, terminal)?.files, terminal)
}
