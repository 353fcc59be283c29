//! What to know before numbers are used, the same wherever they are shown.

use std::io::Write;
use std::path::Path;

use uplift::alarms::{Alarm, Severity, synthetic_records};

use super::{print_more, typed_path};
use crate::error::CommandError;
use crate::terminal::{Output, Terminal, output};

/// Warnings shown at most, without `--details`.
const SHOWN: usize = 3;

/// What shows the others.
pub(super) const DETAILS: &str = "--details";

/// The worst warnings, a line each, of an answer from `result`; all of them in detail. A quiet terminal gets no others
/// than probable mistakes.
pub(super) fn print_warnings(
    out: &mut impl Write,
    alarms: &[Alarm],
    result: Option<&Path>,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let lines = warnings(alarms, result, terminal);
    print_lines(out, &lines, terminal.shows_details()).map(drop)
}

/// The same of a `result` itself, of which another command shows the others.
pub(super) fn print_result_warnings(
    out: &mut impl Write,
    alarms: &[Alarm],
    result: &Path,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let lines = warnings(alarms, Some(result), terminal);
    let shown = number_shown(&lines, terminal.shows_details());
    print_shown(out, &lines[..shown], lines.len() - shown, &format!("uplift warnings {}", typed_path(result)))
}

/// That the records are synthetic, of answers that have no other warning of a result.
pub(super) fn print_synthetic(out: &mut impl Write, synthetic: bool, terminal: &Terminal) -> Result<(), CommandError> {
    let alarms: Vec<Alarm> = synthetic.then(synthetic_records).into_iter().collect();
    print_warnings(out, &alarms, None, terminal)
}

/// As [`print_warnings`], and that there is more to see, said once.
pub(super) fn print_warnings_and_more(
    out: &mut impl Write,
    alarms: &[Alarm],
    result: &Path,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    print_warnings(out, alarms, Some(result), terminal)?;
    if alarms.len() > SHOWN { Ok(()) } else { print_more(out, terminal) }
}

/// Prints an answer about a structure, its details if they are asked for, then its warnings and those of the result.
pub(super) fn print_in_parts<R>(
    report: &R,
    (answer, details): (
        impl FnOnce(&mut Output, &R) -> Result<(), CommandError>,
        impl FnOnce(&mut Output, &R) -> Result<(), CommandError>,
    ),
    (alarms, result): (&[Alarm], &Path),
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let out = &mut output();
    answer(out, report)?;
    if terminal.shows_details() {
        details(out, report)?;
    }
    print_warnings_and_more(out, alarms, result, terminal)
}

/// The first lines, or `all`, and how to see the others; nothing where there are none. Whether some are left out.
pub(super) fn print_lines(out: &mut impl Write, lines: &[String], all: bool) -> Result<bool, CommandError> {
    let shown = number_shown(lines, all);
    let more = lines.len() - shown;
    print_shown(out, &lines[..shown], more, DETAILS)?;
    Ok(more > 0)
}

fn number_shown(lines: &[String], all: bool) -> usize {
    if all { lines.len() } else { lines.len().min(SHOWN) }
}

/// These lines, and `what_to_type` to see so many `more`; nothing where there are none of either.
pub(super) fn print_shown(
    out: &mut impl Write,
    lines: &[String],
    more: usize,
    what_to_type: &str,
) -> Result<(), CommandError> {
    if !lines.is_empty() || more > 0 {
        writeln!(out, "\nWarnings")?;
    }
    for line in lines {
        writeln!(out, "  {line}")?;
    }
    if more > 0 { Ok(writeln!(out, "  {more} more: {what_to_type}")?) } else { Ok(()) }
}

/// Every warning with all that it is about.
pub(crate) fn print_all_warnings(alarms: &[Alarm], result: &Path) -> Result<(), CommandError> {
    let out = &mut output();
    if alarms.is_empty() {
        writeln!(out, "No warnings.")?;
    }
    for alarm in alarms {
        let Alarm { severity, subject, what, .. } = alarm;
        writeln!(out, "{:<8}  {subject}: {what}{}", severity.word(), full_stop(alarm))?;
        if !alarm.what_to_do.is_empty() {
            writeln!(out, "          {}", remedy(alarm, Some(result)))?;
        }
        if !alarm.also.is_empty() {
            writeln!(out, "          Also: {}", alarm.also.join("; "))?;
        }
    }
    Ok(())
}

/// Whether something about the inputs is probably not meant.
pub(super) fn is_doubted(alarms: &[Alarm]) -> bool {
    alarms.iter().any(|alarm| alarm.severity == Severity::Mistake)
}

/// What is wrong, by how much, and what to type: with the name of the `result`, where it is known.
pub(super) fn warning(alarm: &Alarm, result: Option<&Path>) -> String {
    let mark = if alarm.severity == Severity::Mistake { "mistake? " } else { "" };
    format!("{mark}{alarm}{} {}", full_stop(alarm), remedy(alarm, result)).trim_end().to_owned()
}

fn warnings(alarms: &[Alarm], result: Option<&Path>, terminal: &Terminal) -> Vec<String> {
    let also = |alarm: &Alarm| {
        let is_shown = terminal.shows_details() && !alarm.also.is_empty();
        if is_shown { format!("\n    Also: {}", alarm.also.join("; ")) } else { String::new() }
    };
    told(alarms, terminal).map(|alarm| warning(alarm, result) + &also(alarm)).collect()
}

/// Those that this terminal gets: a quiet one no others than probable mistakes.
pub(super) fn told<'a>(alarms: &'a [Alarm], terminal: &Terminal) -> impl Iterator<Item = &'a Alarm> {
    let is_quiet = terminal.is_quiet();
    alarms.iter().filter(move |alarm| !is_quiet || alarm.severity == Severity::Mistake)
}

/// What to type, with the name of the `result`, where it is known.
fn remedy(alarm: &Alarm, result: Option<&Path>) -> String {
    sentence(&result.map_or_else(|| alarm.what_to_do.clone(), |result| alarm.remedy(&typed_path(result))))
}

fn full_stop(alarm: &Alarm) -> &'static str {
    if alarm.what.ends_with(['.', '?', '!']) { "" } else { "." }
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
