//! Which table is asked for.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use uplift_motion::{IntensityMeasure, MotionError};
use uplift_uniform_risk::TargetRisks;

/// Which table, and what stands beside it. A reference has, for uniform risk spectra, the columns `site`, `poe_50y`
/// (or `poe`), `c0_m`, `c1`, `c2_m`, `rmse_m`; for displacement spectra, which have neither measure nor risk,
/// `record_set`, `scaling`, `quantity`, `value` and, for oscillators, `rule`; for a shaking table `level` and `exc_id`
/// in the order of the tests.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct TableOptions {
    /// Result file, or a structure file with columns
    pub result: PathBuf,
    /// Table to compare with
    #[arg(long, value_name = "FILE.csv")]
    pub reference: Option<PathBuf>,
    /// Intensity measure [default: pgv]
    #[arg(long, alias = "im", value_name = "pgv|pga|sa_1s|...|all")]
    pub measure: Option<TableMeasure>,
    /// The risks of the spectra.
    #[command(flatten)]
    pub risk: TargetRisks,
}

/// By which intensity measures the rows of a table are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableMeasure {
    /// This one, and what is to be known of it alone.
    Only(IntensityMeasure),
    /// Every measure of the result.
    All,
}

impl FromStr for TableMeasure {
    type Err = MotionError;

    fn from_str(word: &str) -> Result<Self, MotionError> {
        if word.trim().eq_ignore_ascii_case("all") { Ok(Self::All) } else { word.parse().map(Self::Only) }
    }
}

impl TableOptions {
    /// The measure of the rows of a result that has spectra by `known` ones, in order; none for all. Where none is
    /// asked for it is PGV, as Table 4.2 is, or the first measure of a study without it.
    pub(crate) fn measure_of_rows(&self, known: &[IntensityMeasure]) -> Option<IntensityMeasure> {
        match self.measure {
            None => Some(known.first().copied().unwrap_or(IntensityMeasure::Pgv)),
            Some(TableMeasure::Only(measure)) => Some(measure),
            Some(TableMeasure::All) => None,
        }
    }
}
