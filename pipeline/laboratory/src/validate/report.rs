//! What a validation found.

use std::path::PathBuf;

use serde::Serialize;
use uplift_validation::BandRule;

use super::group::GroupReport;
use super::join::Unmatched;
use super::options::PRule;

/// What was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValidateReport {
    /// The table of measured peaks.
    pub measured: PathBuf,
    /// The table of computed peaks.
    pub computed: PathBuf,
    /// The column of the peaks.
    pub value: String,
    /// Their unit; empty of pure numbers.
    pub unit: &'static str,
    /// Columns that pairs are joined by; empty where the tables are two samples.
    pub key: Vec<String>,
    /// Columns that the peaks are grouped by.
    pub by: Vec<String>,
    /// Which p decides.
    pub p_rule: PRule,
    /// Significance that the power is for.
    pub significance: f64,
    /// Replicates of bands, and of swaps.
    pub replicates: u32,
    /// Their seed.
    pub seed: u64,
    /// Band of the measured distribution.
    pub band: BandRule,
    /// The groups.
    pub groups: Vec<GroupReport>,
    /// Rows that stand in no statistic.
    pub unmatched: Unmatched,
    /// What is probably mistaken, above all a unit.
    pub doubts: Vec<String>,
    /// What to know before using the numbers.
    pub notes: Vec<String>,
    /// The files written.
    pub files: Vec<PathBuf>,
}

impl ValidateReport {
    /// A group in words: `low, all`.
    pub fn name(group: &GroupReport) -> String {
        if group.of.is_empty() {
            return "all".to_owned();
        }
        group.of.iter().map(|value| value.as_deref().unwrap_or("all")).collect::<Vec<_>>().join(", ")
    }
}
