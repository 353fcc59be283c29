//! What is asked of a design.

use std::path::PathBuf;

use clap::Args;
use uplift_job::typed::number;
use uplift_motion::IntensityMeasure;
use uplift_uniform_risk::OneRisk;

/// What is asked of a design.
#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
#[derive(Debug, Clone, PartialEq, Args)]
pub struct DesignOptions {
    /// Manifest of the records, where it is no longer where the study says.
    #[arg(skip)]
    pub manifest: Option<PathBuf>,
    /// Site [default: the only one]
    #[arg(long)]
    pub site: Option<String>,
    /// The risk of the demand.
    #[command(flatten)]
    pub risk: OneRisk,
    /// Intensity measure [default: pgv]
    #[arg(long)]
    pub measure: Option<IntensityMeasure>,
    /// Use records weighted for hazard consistency (uplift consistency --repair)
    #[arg(long)]
    pub repaired: bool,
    /// Safety factor on the demand (Eq. 3.15)
    #[arg(
        long,
        value_name = "FS",
        default_value_t = DesignOptions::default().safety_factor,
        allow_negative_numbers = true,
        value_parser = number,
    )]
    pub safety_factor: f64,
    /// Apply the rules to the spectrum without analysing the structure
    #[arg(long, conflicts_with_all = ["shard", "shards"])]
    pub spectrum_only: bool,
    /// Judge only the equivalent oscillator
    #[arg(long)]
    pub proxy: bool,
    /// Say what a small change of the strength and rounding make of the numbers, with 16 times the analyses.
    #[arg(skip)]
    pub sensitivity: bool,
    /// Every shard of the structure's own analysis, as [`design_shard`](super::design_shard) wrote them with the same
    /// `sensitivity`; none to compute it here.
    #[arg(skip)]
    pub shards: Vec<PathBuf>,
}

impl Default for DesignOptions {
    /// The safety factor of Section 3.4.5, 2.5.
    fn default() -> Self {
        Self {
            manifest: None,
            site: None,
            risk: OneRisk::default(),
            measure: None,
            repaired: false,
            safety_factor: 2.5,
            spectrum_only: false,
            proxy: false,
            sensitivity: false,
            shards: Vec::new(),
        }
    }
}
