//! What is there of a run.

use std::io::Write;

use uplift::result::Overview;
use uplift::status::{BootstrapStatus, ResultStatus, SlicesStatus, StatusReport, SweepStatus, UnfinishedStatus};

use uplift::text::{counted, one_line};

use super::{shown_path, typed_path};
use crate::error::CommandError;
use crate::terminal::output;

/// Missing slices that are named.
const SLICES_NAMED: usize = 10;

/// The result, the checkpoint of an unfinished run, and who writes it now.
pub(crate) fn print_status(report: &StatusReport) -> Result<(), CommandError> {
    let mut out = output();
    if let Some(result) = &report.result {
        print_result(&mut out, result)?;
    }
    for unfinished in &report.unfinished {
        print_unfinished(&mut out, unfinished)?;
    }
    for SlicesStatus { count, done } in &report.slices {
        let missing = (1..=*count).filter(|number| !done.contains(number)).map(|number| number.to_string());
        let missing: Vec<String> = missing.take(SLICES_NAMED + 1).collect();
        let missing = match &missing[..] {
            [] => "ready for `uplift merge`".to_owned(),
            [named @ .., _] if named.len() == SLICES_NAMED => format!("missing {}, …", named.join(", ")),
            named => format!("missing {}", named.join(", ")),
        };
        writeln!(out, "slices of the sites: {} of {count}; {missing}", done.len())?;
    }
    if let Some(sweep) = &report.sweep {
        print_sweep(&mut out, sweep)?;
    }
    if let Some(BootstrapStatus { file, strengths, command }) = &report.bootstrap {
        let words = command.as_ref().and_then(|command| command.split_once(" bootstrap "));
        let resume = words.map_or_else(
            || "to resume it type `uplift bootstrap` with the same options".to_owned(),
            |(_, words)| format!("to resume it type: uplift bootstrap {}", one_line(words)),
        );
        let file = shown_path(file).display();
        writeln!(out, "{file}: an interrupted bootstrap, {strengths} strengths finished; {resume}")?;
    }
    if let Some(holder) = &report.written_by {
        writeln!(out, "being written now, by {holder}")?;
    }
    Ok(())
}

fn print_sweep(out: &mut impl Write, sweep: &SweepStatus) -> Result<(), CommandError> {
    let SweepStatus { folder, results, is_certain, lacks_comparison, unfinished } = sweep;
    let (folder, finished) = (shown_path(folder).display(), counted(results.len(), "variant"));
    let is_finished = unfinished.is_empty() && !lacks_comparison;
    match (is_certain, is_finished, &results[..]) {
        (true, false, _) => {
            writeln!(out, "{folder}: unfinished sweep, {finished} finished; the same `uplift sweep` resumes it")?;
        }
        // results beside it need not be its own
        (false, false, _) => writeln!(out, "{folder}: unfinished sweep or run; the same command resumes it")?,
        (true, true, _) => writeln!(out, "{folder}: finished sweep, {finished}")?,
        (false, true, results) => writeln!(out, "{folder}: {}", counted(results.len(), "result"))?,
    }
    for unfinished in unfinished {
        print_unfinished(out, unfinished)?;
    }
    let Some(first) = results.first().filter(|_| is_finished) else { return Ok(()) };
    Ok(writeln!(out, "  more: uplift status {}", typed_path(first))?)
}

/// A title behind what it is of; nothing where there is none.
fn after(title: &str) -> String {
    if title.is_empty() { String::new() } else { format!(": {}", one_line(title)) }
}

fn print_result(out: &mut impl Write, result: &ResultStatus) -> Result<(), CommandError> {
    let ResultStatus { created, version, commit, study, title, record_set, .. } = result;
    let file = shown_path(&result.file).display();
    writeln!(out, "{file}: finished {created}, uplift {version} ({commit})")?;
    writeln!(out, "  study    {study}{}", after(title))?;
    if !result.overrides.is_empty() {
        writeln!(out, "  changed  {}", one_line(&format!("--set {}", result.overrides.join(" --set "))))?;
    }
    writeln!(out, "  digest   {}", result.study_digest)?;
    writeln!(out, "  records  {record_set}")?;
    for other in &result.made_of_another {
        writeln!(out, "  not of it: {} was made of another result of this name", shown_path(other).display())?;
    }
    match &result.content {
        Overview::Displacement { structure, analyses, sets, has_design } => {
            writeln!(out, "  spectra  displacement spectra of {structure}s, {analyses} analyses")?;
            for (set, records) in sets {
                writeln!(out, "  set      {set}: {records} records, {} motions", 2 * records)?;
            }
            if *has_design {
                writeln!(out, "  design   uplift table {file}")?;
            }
        }
        Overview::ShakeTable { structure, analyses, levels, excitations } => {
            writeln!(out, "  tests    {analyses} of {structure}: {excitations} excitations at {}", levels.join(", "))?;
        }
        Overview::UniformRisk { analyses, sites, added, has_repair } => {
            for (measure, analyses) in analyses {
                writeln!(out, "  {measure:<8} {analyses} analyses")?;
            }
            let added: Vec<&str> = has_repair.then_some("repair").into_iter().chain(added.iter().copied()).collect();
            for (what, names) in [("sites", sites.join(", ")), ("added", added.join(", "))] {
                if !names.is_empty() {
                    writeln!(out, "  {what:<8} {names}")?;
                }
            }
        }
    }
    for (index, asked) in result.asked.iter().enumerate() {
        let label = if index == 0 { "answers" } else { "" };
        let before = if asked.is_of_earlier_file { " (its file has changed since: run the command again)" } else { "" };
        writeln!(out, "  {label:<7}  {}{before}", one_line(&format!("{}: {}", asked.structure, asked.question)))?;
    }
    Ok(())
}

fn print_unfinished(out: &mut impl Write, unfinished: &UnfinishedStatus) -> Result<(), CommandError> {
    let UnfinishedStatus { file, title, shard, shards, done, analyses, is_kept_for_others, damaged_bytes } = unfinished;
    if *is_kept_for_others {
        let file = shown_path(file).display();
        return Ok(writeln!(out, "{file}: checkpoint with analyses of other settings")?);
    }
    let what =
        if *shards > 1 { format!("shard {shard} of {shards}") } else { "checkpoint of an unfinished run".to_owned() };
    let share = 100.0 * *done as f64 / (*analyses).max(1) as f64;
    let title = after(title);
    writeln!(out, "{}: {what}, {done} of {analyses} analyses ({share:.0} %){title}", shown_path(file).display())?;
    if *damaged_bytes > 0 {
        writeln!(out, "  analyses that were cut off or damaged ({damaged_bytes} bytes) will be computed again")?;
    }
    Ok(())
}
