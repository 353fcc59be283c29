//! What is compared, and how.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde::Serialize;
use uplift_job::typed::number;
use uplift_validation::BandRule;

/// Which p of the Kolmogorov–Smirnov test decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum PRule {
    /// Of all orders of the values
    #[default]
    Exact,
    /// By Kolmogorov's distribution
    Kolmogorov,
    /// By the formula of MATLAB's kstest2
    Kstest2,
}

/// Heading of the options of the statistics.
const STATISTICS: &str = "Statistics";

/// What is compared, and how.
#[expect(clippy::doc_markdown, reason = "what --help prints has no backticks")]
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ValidateOptions {
    /// Measured peaks: CSV with a header, or a shake table's result
    pub measured: PathBuf,
    /// Computed peaks: CSV with a header, or a shake table's result
    pub computed: PathBuf,
    /// Column of the peaks with its unit
    #[arg(long, value_name = "COLUMN", default_value = "u_m")]
    pub value: String,
    /// Columns that identify a motion [default: exc_id, if there]
    #[arg(long, value_name = "COLUMN[,…]", value_delimiter = ',')]
    pub key: Vec<String>,
    /// Columns to group by
    #[arg(long, value_name = "COLUMN[,…]", value_delimiter = ',')]
    pub by: Vec<String>,
    /// p-value of the Kolmogorov-Smirnov test (Table 6.2 has kstest2)
    #[arg(long = "p", value_name = "P", value_enum, default_value_t = PRule::Exact, help_heading = STATISTICS)]
    pub p_rule: PRule,
    /// Add the p-value by permutations within pairs
    #[arg(long, help_heading = STATISTICS)]
    pub permutation: bool,
    /// Significance level of the power
    #[arg(
        long, value_name = "P", default_value_t = ValidateOptions::default().significance,
        allow_negative_numbers = true, value_parser = number, help_heading = STATISTICS
    )]
    pub significance: f64,
    /// Number of resamples and permutations
    #[arg(
        long, value_name = "N", default_value_t = ValidateOptions::default().replicates, help_heading = STATISTICS
    )]
    pub replicates: u32,
    /// Random seed
    #[arg(long, value_name = "N", default_value_t = ValidateOptions::default().seed, help_heading = STATISTICS)]
    pub seed: u64,
    /// Band of the measured distribution.
    #[arg(skip)]
    pub band: BandRule,
    /// Where the statistics are written, CSV.
    #[arg(skip)]
    pub table: Option<PathBuf>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

impl Default for ValidateOptions {
    fn default() -> Self {
        Self {
            measured: PathBuf::new(),
            computed: PathBuf::new(),
            value: "u_m".to_owned(),
            key: Vec::new(),
            by: Vec::new(),
            p_rule: PRule::Exact,
            significance: 0.1,
            replicates: 10_000,
            seed: 1,
            permutation: false,
            band: BandRule::Greenwood,
            table: None,
            force: false,
        }
    }
}
