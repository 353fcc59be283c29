//! What a run tells when it is done, whatever the kind of its study.

use std::io::Write;

use uplift::analysis::ShardReport;
use uplift::run::{RunHead, RunReport};

use super::alarms::print_alarms;
use super::{displacement, shake_table, shown_path, uniform_risk};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The summary of a run; a quiet terminal shows nothing.
pub(crate) fn print_run(report: &RunReport, terminal: &Terminal) -> Result<(), CommandError> {
    if terminal.is_quiet() {
        return Ok(());
    }
    let mut out = output();
    match report {
        RunReport::UniformRisk(report) => uniform_risk::print_spectra(&mut out, report)?,
        RunReport::Displacement(report) => displacement::print_spectra(&mut out, report)?,
        RunReport::ShakeTable(report) => shake_table::print_tests(&mut out, &report.table)?,
    }
    print_end(&mut out, report.head())?;
    let result = report.head().files.first().map(|file| shown_path(file).display());
    let next = match report {
        RunReport::UniformRisk(report) if !report.spectra.is_empty() => "Coefficients (Table 4.2)",
        RunReport::Displacement(report) if report.has_design => "Design example",
        RunReport::ShakeTable(_) => "Every test, in the order of its response",
        RunReport::UniformRisk(_) | RunReport::Displacement(_) => return Ok(()),
    };
    if let Some(result) = result {
        writeln!(out, "{next}: uplift table {result}")?;
    }
    Ok(())
}

/// What every run ends with: alarms, files, time.
fn print_end(out: &mut impl Write, head: &RunHead) -> Result<(), CommandError> {
    print_alarms(out, &head.alarms)?;
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
