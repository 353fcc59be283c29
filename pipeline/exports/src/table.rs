//! The tables of a result, ours beside a reference: coefficients of the spectra (Table 4.2), or the design example
//! (Tables 2.1 to 2.3 and 3.2 to 3.7).

mod coefficients;
mod columns;
mod design;
mod options;
mod tests_of_table;

use serde::Serialize;
use uplift_study::Structure;

pub use coefficients::{COMPARED_ABOVE, CoefficientRow, CoefficientTable, ReferenceFit};
pub use columns::{ColumnsRow, ColumnsTable};
pub use design::{DesignTable, DesignTableRow};
pub use options::{TableMeasure, TableOptions};
pub use tests_of_table::{Agreement, TestRow, TestsTable};
pub use uplift_alarms::COMPARED_FROM_M;

use uplift_alarms::{Scope, alarms, alarms_of, fit_alarms, ranked};
use uplift_job::alarm::Alarm;
use uplift_job::events::Events;
use uplift_job::text::counted;
use uplift_questions::bootstrap::resampled;
use uplift_result::{Kind, ResultFile};
use uplift_uniform_risk::at_target_risks;

use crate::error::ExportsError;

/// A table of a result, with what to know before it is used.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TableReport {
    /// The table.
    pub rows: TableRows,
    /// What to know before using it, the worst first.
    pub alarms: Vec<Alarm>,
}

/// The rows of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum TableRows {
    /// Of uniform risk spectra.
    Coefficients(CoefficientTable),
    /// Of displacement spectra.
    Design(DesignTable),
    /// Of the columns of a structure.
    Columns(ColumnsTable),
    /// Of a shaking table.
    Tests(TestsTable),
}

/// Reads the table of a result, or what the columns of a structure have, and what a reference says beside each row.
///
/// # Errors
/// A file that is missing, damaged or no result; a result without such a table; a reference that cannot be read.
pub fn table(options: &TableOptions, events: &dyn Events) -> Result<TableReport, ExportsError> {
    if Structure::is_written_in(&options.result) {
        let rows = TableRows::Columns(columns::read(options)?);
        return Ok(TableReport { rows, alarms: Vec::new() });
    }
    let file = at_target_risks(ResultFile::open(&options.result)?, &options.risk)?;
    let rows = match file.kind() {
        Kind::UniformRisk => coefficients::read(options, &file, events).map(TableRows::Coefficients),
        Kind::Displacement => design::read(options, &file, events).map(TableRows::Design),
        Kind::ShakeTable => tests_of_table::read(options, &file).map(TableRows::Tests),
    }?;
    file.tell_made_of_another(events)?;
    tell_findings(&file, events)?;
    // bands tell which measures disagree, at whatever risk
    let file = resampled(file, events)?;
    let mut alarms = match options.measure {
        Some(TableMeasure::Only(measure)) if file.kind() == Kind::UniformRisk => {
            alarms_of(&file, &Scope { measure: Some(measure), ..Scope::default() })
        }
        _ => alarms(&file),
    }?;
    if let TableRows::Coefficients(_) = rows {
        alarms.extend(fit_alarms(&file, options.measure_of_rows(&file.measures()))?);
    }
    Ok(TableReport { rows, alarms: ranked(alarms) })
}

/// Says which structures were asked something under the result.
fn tell_findings(file: &ResultFile, events: &dyn Events) -> Result<(), ExportsError> {
    let findings = file.findings()?;
    let mut structures: Vec<&str> = findings.iter().map(|of| of.finding.structure.as_str()).collect();
    structures.dedup();
    if !structures.is_empty() {
        let text = format!("{} for {}: see uplift report", counted(findings.len(), "answer"), structures.join(", "));
        events.remark("asked", &text);
    }
    Ok(())
}
