//! What a run tells when it is done, whatever the kind of its study.

use std::io::Write;

use uplift::analysis::ShardReport;
use uplift::run::{RunHead, RunReport};

use super::{displacement, shown_path, uniform_risk};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Warnings printed; all of them are in the result file.
const WARNINGS_SHOWN: usize = 12;

/// The summary of a run; a quiet terminal shows nothing.
pub(crate) fn print_run(report: &RunReport, terminal: &Terminal) -> Result<(), CommandError> {
    if terminal.is_quiet() {
        return Ok(());
    }
    let mut out = output();
    match report {
        RunReport::UniformRisk(report) => uniform_risk::print_spectra(&mut out, report)?,
        RunReport::Displacement(report) => displacement::print_spectra(&mut out, report)?,
    }
    print_end(&mut out, report.head())?;
    let result = report.head().files.first().map(|file| shown_path(file).display());
    let next = match report {
        RunReport::UniformRisk(report) if !report.spectra.is_empty() => "Coefficients (Table 4.2)",
        RunReport::Displacement(report) if report.has_design => "Design example",
        RunReport::UniformRisk(_) | RunReport::Displacement(_) => return Ok(()),
    };
    if let Some(result) = result {
        writeln!(out, "{next}: uplift table {result}")?;
    }
    Ok(())
}

/// What every run ends with: warnings, files, time.
fn print_end(out: &mut impl Write, head: &RunHead) -> Result<(), CommandError> {
    let warnings = &head.warnings;
    if !warnings.is_empty() {
        writeln!(out, "\nBefore you use these numbers:")?;
        for warning in warnings.iter().take(WARNINGS_SHOWN) {
            writeln!(out, "  - {warning}")?;
        }
        if warnings.len() > WARNINGS_SHOWN {
            let more = warnings.len() - WARNINGS_SHOWN;
            writeln!(out, "  - {more} more in the attribute `warnings` of the result file")?;
        }
    }
    writeln!(out, "\nDone in {:.1} s. Results:", head.seconds)?;
    for file in &head.files {
        writeln!(out, "  {}", shown_path(file).display())?;
    }
    Ok(())
}

/// Which shard was computed, and where it is.
pub(crate) fn print_shard(report: &ShardReport, terminal: &Terminal) -> Result<(), CommandError> {
    if terminal.is_quiet() {
        return Ok(());
    }
    let ShardReport { shard, shards, rows, file } = report;
    let file = shown_path(file).display();
    Ok(writeln!(output(), "shard {shard} of {shards}, {rows} analysis rows: {file}")?)
}
