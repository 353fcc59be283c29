//! What is asked of a bootstrap.

use std::path::PathBuf;

use clap::{Args, value_parser};
use uplift_bootstrap::{Interval, Unit};
use uplift_job::typed::{RARE, one_of, whole_number};
use uplift_study::Bootstrap;

use super::report::ReferenceRow;

/// What is asked of a bootstrap. What is left open is as a study says: as `study`, else as the one in the result.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct BootstrapOptions {
    /// The section `[bootstrap]` of a study, in place of that of the study in the result.
    #[arg(skip)]
    pub study: Option<Bootstrap>,
    /// Records in a resample, e.g. 20,40,60 [default: the study's, else 20,40,60,80 and all]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = whole_number::<u32>(1..=100_000))]
    pub sizes: Option<Vec<u32>>,
    /// Number of resamples of each size [default: the study's, else 1000]
    #[arg(long, value_name = "N", value_parser = whole_number::<u64>(1..=1_000_000))]
    pub replicates: Option<u64>,
    /// Random seed [default: the study's]
    #[arg(long, help_heading = RARE, value_parser = value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,
    /// Method of the limits: percentile or bca
    #[arg(long, help_heading = RARE, value_parser = one_of(&Interval::ALL, Interval::key))]
    pub interval: Option<Interval>,
    /// Unit of a resample: record, pair or event (earthquake)
    #[arg(long, help_heading = RARE, value_parser = one_of(&Unit::ALL, Unit::key), conflicts_with = "plan")]
    pub unit: Option<Unit>,
    /// Add simultaneous bands, which hold for whole spectra
    #[arg(long)]
    pub simultaneous: bool,
    /// Draw the same resamples as another result
    #[arg(long, help_heading = RARE, value_name = "RESULT.h5", conflicts_with_all = ["sizes", "replicates", "seed"])]
    pub plan: Option<PathBuf>,
    /// Figures to compare with, which the report hands on: see [`read_reference`](super::read_reference).
    #[arg(skip)]
    pub reference: Vec<ReferenceRow>,
    /// What the caller typed; kept in the checkpoint.
    #[arg(skip)]
    pub command: String,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}
