//! What to know before numbers are used, the same wherever they are shown.

use std::io::Write;
use std::path::Path;

use uplift::alarms::{Alarm, Severity};

use super::shown_path;
use crate::error::CommandError;
use crate::terminal::output;

/// Warnings shown; `uplift warnings` prints them all.
pub(super) const SHOWN: usize = 3;

/// The worst warnings, a line each, and how to see the others of the `result`; nothing where there are none.
pub(super) fn print_warnings(
    out: &mut impl Write,
    alarms: &[Alarm],
    result: Option<&Path>,
) -> Result<(), CommandError> {
    let all =
        result.map_or_else(|| "--json".to_owned(), |path| format!("uplift warnings {}", shown_path(path).display()));
    print_warnings_up_to(out, alarms, &all, SHOWN)
}

/// So many of the worst warnings, and what shows `all` of them.
pub(super) fn print_warnings_up_to(
    out: &mut impl Write,
    alarms: &[Alarm],
    all: &str,
    shown: usize,
) -> Result<(), CommandError> {
    if alarms.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nWarnings")?;
    for alarm in alarms.iter().take(shown) {
        writeln!(out, "  {}", warning(alarm))?;
    }
    let more = alarms.len().saturating_sub(shown);
    if more > 0 { Ok(writeln!(out, "  {more} more: {all}")?) } else { Ok(()) }
}

/// Every warning with all that it is about.
pub(crate) fn print_all_warnings(alarms: &[Alarm]) -> Result<(), CommandError> {
    let out = &mut output();
    if alarms.is_empty() {
        writeln!(out, "No warnings.")?;
    }
    for alarm in alarms {
        writeln!(out, "{:<8}  {}", alarm.severity.word(), alarm.subject)?;
        writeln!(out, "          {}.", alarm.what)?;
        if !alarm.what_to_do.is_empty() {
            writeln!(out, "          {}", alarm.what_to_do)?;
        }
        if !alarm.also.is_empty() {
            writeln!(out, "          Also: {}", alarm.also.join("; "))?;
        }
    }
    Ok(())
}

/// What is wrong, by how much, and what to type.
pub(super) fn warning(alarm: &Alarm) -> String {
    let mark = if alarm.severity == Severity::Mistake { "mistake? " } else { "" };
    let remedy = if alarm.what_to_do.is_empty() { String::new() } else { format!(" {}", alarm.what_to_do) };
    format!("{mark}{alarm}.{remedy}")
}
