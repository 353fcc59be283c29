//! What to know before numbers are used, the same wherever they are shown.

use std::io::Write;
use std::path::Path;

use uplift::alarms::{Alarm, Severity, synthetic_records};

use super::shown_path;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Warnings shown at most; `uplift warnings` prints them all.
pub(super) const SHOWN: usize = 3;
/// Words that those shown have at most, but for the first and for probable mistakes.
const WORDS: usize = 33;

/// The worst warnings, a line each, and how to see the others, of a `result` by its path; in detail all of them, and
/// nothing where there are none.
pub(super) fn print_warnings(
    out: &mut impl Write,
    alarms: &[Alarm],
    result: Option<&Path>,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    if terminal.is_quiet() {
        return Ok(());
    }
    let all =
        result.map_or_else(|| "--details".to_owned(), |path| format!("uplift warnings {}", shown_path(path).display()));
    print_warnings_up_to(out, alarms, &all, if terminal.shows_details() { usize::MAX } else { SHOWN })
}

/// That the records are synthetic, of answers that have no other warning of a result.
pub(super) fn print_synthetic(out: &mut impl Write, synthetic: bool, terminal: &Terminal) -> Result<(), CommandError> {
    let alarms: Vec<Alarm> = synthetic.then(synthetic_records).into_iter().collect();
    print_warnings(out, &alarms, None, terminal)
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
    let lines: Vec<_> = alarms.iter().map(|alarm| (alarm.severity, warning(alarm))).collect();
    print_lines(out, &lines, all, shown)
}

/// The first of the lines, `shown` at most and no more than are read, and what shows `all`.
pub(super) fn print_lines(
    out: &mut impl Write,
    lines: &[(Severity, String)],
    all: &str,
    shown: usize,
) -> Result<(), CommandError> {
    writeln!(out, "\nWarnings")?;
    let mut words = 0;
    let mut is_read = |(severity, line): &&(Severity, String)| {
        let is_first = words == 0;
        words += line.split_whitespace().count();
        is_first || shown == usize::MAX || *severity == Severity::Mistake || words <= WORDS
    };
    let shown = lines.iter().take(shown).take_while(&mut is_read).count();
    for (_, line) in &lines[..shown] {
        writeln!(out, "  {line}")?;
    }
    let more = lines.len() - shown;
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
        let end = if alarm.what.ends_with(['.', '?', '!']) { "" } else { "." };
        writeln!(out, "          {}{end}", alarm.what)?;
        if !alarm.what_to_do.is_empty() {
            writeln!(out, "          {}", sentence(&alarm.what_to_do))?;
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
    let remedy = if alarm.what_to_do.is_empty() { String::new() } else { format!(" {}", sentence(&alarm.what_to_do)) };
    let end = if alarm.what.ends_with(['.', '?', '!']) { "" } else { "." };
    format!("{mark}{alarm}{end}{remedy}")
}

/// Words that begin a sentence; one of the study's keys keeps its letters.
fn sentence(words: &str) -> String {
    let (first, rest) = words.split_at(words.find(' ').unwrap_or(words.len()));
    if first.chars().all(char::is_alphabetic) {
        let mut letters = first.chars();
        let begin: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
        return begin + letters.as_str() + rest;
    }
    words.to_owned()
}
