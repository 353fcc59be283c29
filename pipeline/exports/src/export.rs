//! Spectra, bands and coefficients, or the tests of a shaking table, for other programs: a tidy table, JSON, a MATLAB
//! file, a workbook.

mod added;
mod bands;
mod findings;
mod json;
mod matlab;
mod shake_table;
mod source;
mod table;
mod web;
mod workbook;

use std::path::{Path, PathBuf};

use shake_table::TestsExport;
pub use source::Export;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind, beside};
use uplift_job::table::{write_atomically, write_table};
use uplift_questions::bootstrap::resampled;
use uplift_result::{Kind, ResultFile};
use uplift_studies::shake_table::TESTS_COLUMN;
use uplift_uniform_risk::{TargetRisks, at_target_risks};
pub use web::calculator;

pub use crate::fragility::measures::FragilityFormat;
pub use crate::options::{AssessmentOptions, ExportOptions};
pub use crate::report::ExportReport;

use crate::demand::demand;
use crate::error::ExportsError;
use crate::fragility::fragility;

/// Formats of other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ExportFormat {
    /// A tidy table, a row each ordinate: `site`, `im`, `poe`, `years`, `strength`, `u_m`, `fit_m`, then more.
    Csv,
    /// One object with the spectra, their bands and their coefficients.
    Json,
    /// A file that MATLAB and `scipy.io` load; `u_pgv_m` is strength × probability × site.
    Matlab,
    /// A workbook of Excel: a sheet each of spectra, bands, coefficients, hazard, and of where they come from.
    Workbook,
    /// The stripes and hazard curves of the result for the page of `make web`, as JSON.
    Web,
}

impl ExportFormat {
    /// How the files end that are named after a result of this kind.
    fn extension(self, of: Kind) -> &'static str {
        match self {
            Self::Csv if of == Kind::ShakeTable => "tests.csv",
            Self::Csv => "spectra.csv",
            Self::Json => "json",
            Self::Matlab => "mat",
            Self::Workbook => "xlsx",
            Self::Web => "web.json",
        }
    }

    fn kind(self, of: Kind) -> OutputKind {
        match self {
            Self::Csv if of == Kind::ShakeTable => OutputKind::Table(TESTS_COLUMN),
            Self::Csv => OutputKind::Table("fit_m"),
            Self::Json | Self::Web => OutputKind::Json,
            Self::Matlab => OutputKind::Matlab,
            Self::Workbook => OutputKind::Workbook,
        }
    }
}

/// How the table ends of what structures were asked.
const FINDINGS: &str = "structures.csv";

/// Writes the spectra, bands and coefficients of a result for other programs; or fragilities or demands of its
/// oscillators, or of a structure under its records.
///
/// # Errors
/// No format, or several for one file; a file that is no result, is damaged or has no spectra; a file that would
/// overwrite the result or what is not this program's, or cannot be written; for fragilities and demands a strength, a
/// displacement, a site or a measure that the result or the other program does not have, an intensity outside the
/// levels or the hazard curve, records or a structure that cannot be used.
pub fn export(options: &ExportOptions, events: &dyn Events) -> Result<ExportReport, ExportsError> {
    if let Some(format) = options.assessment.fragility {
        return fragility(format, options, events);
    }
    if let Some(site) = &options.assessment.demand {
        return demand(site, options, events);
    }
    let formats = options.formats();
    if formats.is_empty() {
        return Err(JobError::Usage("give a format: --csv, --json, --mat, --xlsx or --web".to_owned()).into());
    }
    if let (Some(_), several @ 2..) = (&options.output, formats.len()) {
        return Err(JobError::Usage(format!("-o takes one format, and {several} are given")).into());
    }
    let result = ResultFile::open(&options.result)?;
    let kind = result.kind();
    let file = |format: &ExportFormat| {
        options.output.clone().unwrap_or_else(|| beside(&options.result, format.extension(kind)))
    };
    let output = |format: &ExportFormat| Output::new(file(format), format.kind(kind)).with_result(&options.result);
    let mut outputs: Vec<Output> = formats.iter().map(output).collect();
    // answers about structures are no ordinates: they have a table of their own
    let has_findings = formats.contains(&ExportFormat::Csv) && !result.findings()?.is_empty();
    let findings = has_findings.then(|| match &options.output {
        Some(table) => table.with_extension(FINDINGS),
        None => beside(&options.result, FINDINGS),
    });
    outputs.extend(
        findings
            .iter()
            .map(|table| Output::new(table, OutputKind::Table(findings::FIRST_COLUMN)).with_result(&options.result)),
    );
    if kind == Kind::ShakeTable {
        if options.risk != TargetRisks::default() {
            return Err(JobError::Usage(
                "the tests of a shaking table have no risk: leave --poe and the like out".into(),
            )
            .into());
        }
        outputs::check(&outputs, &[&options.result], options.overwriting.force)?;
        let export = TestsExport::from_file(&result)?;
        return write_each(&formats, file, events, |format, file| match format {
            ExportFormat::Csv => Ok(write_table(file, &export.provenance, export.columns())?),
            ExportFormat::Json => Ok(write_atomically(file, format!("{:#}\n", export.json()).as_bytes())?),
            ExportFormat::Matlab => Ok(write_atomically(file, &export.matlab()?)?),
            ExportFormat::Workbook => Ok(write_atomically(file, &export.workbook()?)?),
            ExportFormat::Web => Err(result.fail("holds tests of a shaking table, and --web writes spectra").into()),
        });
    }
    let result = at_target_risks(result, &options.risk)?;
    outputs::check(&outputs, &[&options.result], options.overwriting.force)?;
    let result = resampled(result, events)?;
    let export = Export::from_file(&result)?;
    let mut report = write_each(&formats, file, events, |format, file| match format {
        ExportFormat::Csv => Ok(write_table(file, export.provenance(), export.columns())?),
        ExportFormat::Json => Ok(write_atomically(file, format!("{:#}\n", export.json()).as_bytes())?),
        ExportFormat::Matlab => Ok(write_atomically(file, &export.matlab()?)?),
        ExportFormat::Workbook => Ok(write_atomically(file, &export.workbook()?)?),
        ExportFormat::Web => {
            Ok(write_atomically(file, format!("{}\n", serde_json::json!(web::web(&result)?)).as_bytes())?)
        }
    })?;
    if let Some(table) = findings {
        write_table(&table, export.provenance(), export.finding_columns())?;
        report.files.push(table);
    }
    // after what was written again
    result.tell_made_of_another(events)?;
    Ok(report)
}

/// Writes each of the `formats` to its file, unless `events` stop it before.
fn write_each(
    formats: &[ExportFormat],
    file: impl Fn(&ExportFormat) -> PathBuf,
    events: &dyn Events,
    write: impl Fn(&ExportFormat, &Path) -> Result<(), ExportsError>,
) -> Result<ExportReport, ExportsError> {
    let mut files = Vec::new();
    for format in formats {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        let file = file(format);
        write(format, &file)?;
        files.push(file);
    }
    Ok(ExportReport { files, notes: Vec::new() })
}

impl ExportOptions {
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
