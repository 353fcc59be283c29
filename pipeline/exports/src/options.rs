//! What is asked of an export.

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use uplift_design::{CAPACITY_SHARE, LimitOptions};
use uplift_job::typed::{Numbers, Overwriting, number_or_per_cent, numbers};
use uplift_motion::IntensityMeasure;
use uplift_study::Structure;
use uplift_uniform_risk::TargetRisks;

use crate::error::ExportsError;
use crate::fragility::measures::FragilityFormat;

/// What is exported, and where it goes.
#[derive(Debug, Clone, PartialEq, Args)]
#[expect(clippy::struct_excessive_bools, reason = "a switch for each format")]
pub struct ExportOptions {
    /// Result file
    pub result: PathBuf,
    /// CSV table, one row an ordinate, with fit, flag and bands
    #[arg(long)]
    pub csv: bool,
    /// JSON with spectra, bands, coefficients and warnings
    #[arg(long)]
    pub json: bool,
    /// MATLAB file
    #[arg(long)]
    pub mat: bool,
    /// Excel workbook with spectra, bands, coefficients and hazard
    #[arg(long)]
    pub xlsx: bool,
    /// Stripes and hazard as JSON, for the browser page
    #[arg(long)]
    pub web: bool,
    /// Output file, for one format [default: beside the result]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Risks of the spectra, or the risk that sets the intensity of the demands.
    #[command(flatten)]
    pub risk: TargetRisks,
    /// Whether existing files are overwritten.
    #[command(flatten)]
    pub overwriting: Overwriting,
    /// Fragilities or demands in place of spectra.
    #[command(flatten, next_help_heading = "Fragility and demand")]
    pub assessment: AssessmentOptions,
}

/// Fragilities or demands in place of spectra.
#[derive(Debug, Clone, PartialEq, Args)]
#[command(group = ArgGroup::new("assessment").args(["fragility", "demand"])
    .conflicts_with_all(["csv", "json", "mat", "xlsx", "web"]))]
pub struct AssessmentOptions {
    /// Fragilities for another program, in place of spectra
    #[arg(long, value_enum, value_name = "openquake|pelicun|csv", hide_possible_values = true,
        conflicts_with_all = ["poe", "return_period", "years"])]
    pub fragility: Option<FragilityFormat>,
    /// Demands for pelicun at the intensity that this site exceeds with --poe
    #[arg(long, value_name = "SITE")]
    pub demand: Option<String>,
    /// Displacements that are exceeded, m
    #[arg(long, value_name = "M[,…]", allow_negative_numbers = true, value_parser = numbers,
        requires_all = ["fragility", "strength"], conflicts_with = "demand")]
    pub displacement_m: Vec<Numbers>,
    /// Uplift strengths of the result
    #[arg(long, value_name = "STRENGTH[,…]", allow_negative_numbers = true, value_parser = numbers,
        requires = "assessment")]
    pub strength: Vec<Numbers>,
    /// Structure file, in place of strengths
    #[arg(long, value_name = "FILE", requires = "assessment", conflicts_with_all = ["displacement_m", "strength"])]
    pub structure: Option<PathBuf>,
    /// Share of the capacity that is a limit state too
    #[arg(long, value_name = "SHARE", requires = "structure", conflicts_with = "demand",
        default_value_t = CAPACITY_SHARE, allow_negative_numbers = true, value_parser = number_or_per_cent)]
    pub capacity_share: f64,
    /// Manifest of the records, if it was moved
    #[arg(long, value_name = "CSV", requires = "structure", conflicts_with = "strength")]
    pub manifest: Option<PathBuf>,
    /// Intensity measure [default: all; of demands the first]
    #[arg(long, requires = "assessment")]
    pub measure: Option<IntensityMeasure>,
}

impl ExportOptions {
    /// Files that are read.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        let AssessmentOptions { structure, manifest, .. } = &self.assessment;
        [&self.result].into_iter().chain(structure).chain(manifest).map(PathBuf::as_path).collect()
    }
}

impl AssessmentOptions {
    /// The structure, where one is assessed.
    pub(crate) fn structure(&self) -> Result<Option<Structure>, ExportsError> {
        Ok(self.structure.as_deref().map(Structure::load).transpose()?)
    }

    /// Options of its limit states, by one measure or all.
    pub(crate) fn limits(&self, measure: Option<IntensityMeasure>) -> LimitOptions {
        LimitOptions { manifest: self.manifest.clone(), measure, capacity_share: self.capacity_share }
    }
}
