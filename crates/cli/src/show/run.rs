//! What a run found, whatever the kind of its study.

use std::io::Write;

use uplift::analysis::ShardReport;
use uplift::run::{RunHead, RunReport};

use super::alarms::print_warnings;
use super::spectrum::print_displacements;
use super::{displacement, shake_table, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The spectrum, warnings, and where the files are; a quiet terminal gets the spectrum alone.
pub(crate) fn print_run(report: &RunReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    match report {
        RunReport::UniformRisk(report) => {
            for found in report.displacements.iter().chain(&report.repaired) {
                print_displacements(&mut out, found, terminal)?;
            }
        }
        RunReport::Displacement(report) => displacement::print_spectra(&mut out, report)?,
        RunReport::ShakeTable(report) => shake_table::print_tests(&mut out, &report.table)?,
    }
    if terminal.is_quiet() { Ok(()) } else { print_end(&mut out, report.head()) }
}

/// What every run ends with: warnings, files, and what to look at next.
fn print_end(out: &mut impl Write, head: &RunHead) -> Result<(), CommandError> {
    let Some((result, tables)) = head.files.split_first() else { return Ok(()) };
    print_warnings(out, &head.alarms, Some(result))?;
    let result = shown_path(result).display();
    let time = if head.done_already {
        "done already; --again runs the study anew".to_owned()
    } else {
        format!("{:.1} s", head.seconds)
    };
    writeln!(out, "\nResult   {result} ({time})")?;
    for table in tables {
        writeln!(out, "Table    {}", shown_path(table).display())?;
    }
    Ok(writeln!(out, "Report   uplift report {result}")?)
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
