//! What is asked of the overturning of a structure.

use std::path::PathBuf;

use clap::Args;
use uplift_job::typed::number;
use uplift_motion::IntensityMeasure;

/// What is asked of the overturning of a structure.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct OverturningOptions {
    /// Manifest of the records, where it is no longer where the study says.
    #[arg(skip)]
    pub manifest: Option<PathBuf>,
    /// Site [default: all]
    #[arg(long)]
    pub site: Option<String>,
    /// Intensity measure [default: all]
    #[arg(long)]
    pub measure: Option<IntensityMeasure>,
    /// Coefficient of restitution of oscillator, block and planar frame
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    pub restitution: Option<f64>,
    /// Count the equivalent oscillator alone, not the frame or block itself
    #[arg(long)]
    pub proxy: bool,
    /// Say what rounding makes of the numbers, with nine times the analyses.
    #[arg(skip)]
    pub sensitivity: bool,
    /// CSV file of the collapse fragility to write; the risk goes to one that ends in .risk.csv beside it.
    #[arg(skip)]
    pub table: Option<PathBuf>,
    /// Every shard of the analyses, as [`overturning_shard`](super::overturning_shard) wrote them with the same
    /// `sensitivity`; none to compute them here.
    #[arg(skip)]
    pub shards: Vec<PathBuf>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}
