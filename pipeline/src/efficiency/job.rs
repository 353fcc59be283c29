//! Efficiency and sufficiency of the measures of a result.

use std::path::Path;

use super::covariates::covariates;
use super::of_measure::efficiency_by;
use super::report::EfficiencyReport;
use super::write::{efficiency_path, write_efficiency};
use crate::error::UpliftError;
use crate::events::Events;
use crate::outputs::{self, Output, OutputKind};
use crate::result::Addition;

/// How the efficiency of measures is written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct EfficiencyOptions {
    /// Whether whatever is at the place of the table gives way.
    pub force: bool,
}

/// How well each intensity measure of the result at `result` predicts the demand (efficiency), and what it leaves out
/// (sufficiency): written into the file and into a table beside it.
///
/// # Errors
/// A file that is missing, damaged, no result, or without sites; a file that cannot be written;
/// [`UpliftError::Interrupted`] where `events` say so.
pub fn efficiency(
    result: &Path,
    options: EfficiencyOptions,
    events: &dyn Events,
) -> Result<EfficiencyReport, UpliftError> {
    let (addition, file) = Addition::begin(result, events)?;
    let stored = file.stripes()?;
    let table = Output::new(efficiency_path(&stored.path), OutputKind::Table("dispersion_rocking"));
    outputs::check(&[table], &[result], options.force)?;
    let covariates = covariates(&file.records()?);
    let mut measures = Vec::new();
    for measure in &stored.measures {
        if events.cancelled() {
            return Err(UpliftError::Interrupted);
        }
        measures.push(efficiency_by(&stored, measure, &covariates)?);
    }
    write_efficiency(&addition, &stored, &covariates, &measures)?;
    Ok(EfficiencyReport::new(&stored, &covariates, &measures))
}
