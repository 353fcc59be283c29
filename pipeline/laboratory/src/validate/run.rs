//! The job: two tables in, every statistic of every group out.

use std::path::Path;

use rayon::prelude::*;
use uplift_ida::Watch;
use uplift_job::JobError;
use uplift_job::events::{Events, Progress};
use uplift_job::machine::require_memory;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_validation::{ValidationError, holm_adjusted};

use super::doubts::doubts;
use super::group::{GroupReport, memory_of_group};
use super::join::{Joined, Unmatched, as_samples, by_key};
use super::options::{PRule, ValidateOptions};
use super::peaks::{Peaks, unit_of};
use super::report::ValidateReport;
use super::write::{self, COLUMN};
use crate::error::LaboratoryError;

/// Groups beyond which a column is not meant to be grouped by.
const MOST_GROUPS: usize = 400;
const MOST_REPLICATES: u32 = 10_000_000;
/// Memory for each byte of the tables: rows, keys, pairs of them, and what the threads of their reader set apart.
const MEMORY_OF_A_BYTE: u64 = 80;
/// The column that the key stands in where none is named.
const USUAL_KEY: &str = "exc_id";

/// Compares computed peaks with measured ones.
///
/// # Errors
/// Tables that cannot be read, or have nothing in common; options out of their range; a table that would replace
/// something else or cannot be written.
pub fn validate(options: &ValidateOptions, events: &dyn Events) -> Result<ValidateReport, LaboratoryError> {
    check(options)?;
    let keys = if options.key.is_empty() { vec![USUAL_KEY.to_owned()] } else { options.key.clone() };
    let length = |file: &Path| std::fs::metadata(file).map_or(0, |data| data.len());
    let input = length(&options.measured).saturating_add(length(&options.computed));
    require_memory(input.saturating_mul(MEMORY_OF_A_BYTE), "the tables")?;
    let read = |what, file: &Path| Peaks::read(what, file, &options.value, &keys, &options.by);
    let (measured, computed) = (read("measured", &options.measured)?, read("computed", &options.computed)?);
    check_columns(options, &measured, &computed)?;
    let are_pairs = measured.missing_keys.is_empty() && computed.missing_keys.is_empty();
    let (joined, unmatched) = if are_pairs { by_key(&measured, &computed)? } else { as_samples(&measured, &computed)? };
    let wanted = groups(&joined, &options.by)?;
    let at_once = wanted.len().min(rayon::current_num_threads());
    let most = measured.rows.len().max(computed.rows.len());
    require_memory((at_once * memory_of_group(most)) as u64, "the statistics")?;
    let progress = Progress::begin(events, "groups", "groups", wanted.len() as u64);
    let found: Vec<Option<Result<GroupReport, ValidationError>>> = wanted
        .into_par_iter()
        .map(|of| {
            let peers = joined.peers(|cells| is_of(&of, cells));
            if progress.cancelled() || peers.measured.is_empty() || peers.computed.is_empty() {
                return None;
            }
            let group = GroupReport::from_peaks(of, &peers, are_pairs, options, &|| progress.cancelled());
            progress.finished(1);
            Some(group)
        })
        .collect();
    drop(progress);
    if events.cancelled() {
        return Err(JobError::Interrupted.into());
    }
    let mut groups = found
        .into_iter()
        .flatten()
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| JobError::input(error.to_string()))?;
    let adjusted = holm_adjusted(&groups.iter().map(|group| group.p).collect::<Vec<_>>());
    for (group, p) in groups.iter_mut().zip(adjusted) {
        group.p_holm = p;
    }
    let mut report = ValidateReport {
        measured: options.measured.clone(),
        computed: options.computed.clone(),
        value: options.value.clone(),
        unit: unit_of(&options.value),
        key: if are_pairs { keys } else { Vec::new() },
        by: options.by.clone(),
        p_rule: options.p_rule,
        significance: options.significance,
        replicates: options.replicates,
        seed: options.seed,
        band: options.band,
        doubts: doubts(&options.value, &groups),
        notes: notes(options, &groups, &unmatched, are_pairs),
        groups,
        unmatched,
        files: Vec::new(),
    };
    if report.groups.is_empty() {
        return Err(JobError::input("no group has both measured and computed peaks".to_owned()).into());
    }
    if let Some(table) = &options.table {
        events.writing_into(table.parent().unwrap_or(Path::new("")));
        write::write(&report, table)?;
        report.files.push(table.clone());
    }
    Ok(report)
}

/// Refuses what cannot be, before anything is computed; all of it.
fn check(options: &ValidateOptions) -> Result<(), LaboratoryError> {
    let mut mistakes = Vec::new();
    if !(options.significance > 0.0 && options.significance < 1.0) {
        mistakes.push(format!("significance {}: give one above 0 and below 1, 0.1 for instance", options.significance));
    }
    if !(1..=MOST_REPLICATES).contains(&options.replicates) {
        mistakes.push(format!("{} replicates: give from 1 to {MOST_REPLICATES}", options.replicates));
    }
    for (place, name) in options.by.iter().enumerate().filter(|(place, name)| options.by[..*place].contains(name)) {
        mistakes.push(format!("--by names {name} twice, the second time in place {}", place + 1));
    }
    if !mistakes.is_empty() {
        return Err(JobError::Usage(mistakes.join("\n")).into());
    }
    let outputs: Vec<Output> =
        options.table.iter().map(|table| Output::new(table, OutputKind::Table(COLUMN))).collect();
    Ok(outputs::check(&outputs, &[&options.measured, &options.computed], options.force)?)
}

/// Refuses columns that were asked for and are nowhere.
fn check_columns(options: &ValidateOptions, measured: &Peaks, computed: &Peaks) -> Result<(), LaboratoryError> {
    let mut mistakes = Vec::new();
    for table in [measured, computed] {
        // the usual key may be missing, one that was named may not
        for name in table.missing_keys.iter().filter(|_| !options.key.is_empty()) {
            mistakes.push(format!("{}: it has no column {name}, which --key names", table.name));
        }
    }
    for name in measured.missing_groups.iter().filter(|name| computed.missing_groups.contains(name)) {
        mistakes.push(format!("neither table has the column {name}, which --by names"));
    }
    if mistakes.is_empty() { Ok(()) } else { Err(JobError::Inputs(mistakes).into()) }
}

/// Every combination of values of the columns, and all of the first, in the order in which values stand in the tables.
fn groups(joined: &Joined, by: &[String]) -> Result<Vec<Vec<Option<String>>>, LaboratoryError> {
    let cells = joined.groups();
    let mut combinations: Vec<Vec<Option<String>>> = vec![vec![None; by.len()]];
    for place in (0..by.len()).rev() {
        let mut values: Vec<&String> = Vec::new();
        for row in &cells {
            if !values.contains(&&row[place]) {
                values.push(&row[place]);
            }
            if values.len() > MOST_GROUPS {
                return Err(too_many_groups(by));
            }
        }
        // of one value alone, all is that value: a group twice would count twice in Holm's p
        let all = (place == 0 && values.len() > 1).then_some(None);
        let choices: Vec<Option<String>> = all.into_iter().chain(values.into_iter().cloned().map(Some)).collect();
        combinations = combinations
            .iter()
            .flat_map(|before| {
                choices.iter().map(move |choice| {
                    let mut combination = before.clone();
                    combination[place].clone_from(choice);
                    combination
                })
            })
            .collect();
        if combinations.len() > MOST_GROUPS {
            return Err(too_many_groups(by));
        }
    }
    Ok(combinations)
}

fn too_many_groups(by: &[String]) -> LaboratoryError {
    JobError::Usage(format!("--by {} makes more than {MOST_GROUPS} groups: name columns with few values", by.join(",")))
        .into()
}

fn is_of(of: &[Option<String>], cells: &[String]) -> bool {
    of.iter().zip(cells).all(|(wanted, cell)| wanted.as_ref().is_none_or(|wanted| wanted == cell))
}

/// What to know before using the numbers.
fn notes(options: &ValidateOptions, groups: &[GroupReport], unmatched: &Unmatched, are_pairs: bool) -> Vec<String> {
    let mut notes = unmatched.notes();
    if are_pairs {
        notes.push(
            "the peaks are paired, and the tests assume independence: if both rise and fall together, p is too large. \
             Use --permutation"
                .to_owned(),
        );
    } else {
        notes.push(format!(
            "the tables have no common column {USUAL_KEY}, so their rows are two independent samples: if a column \
             identifies the motion, name it by --key"
        ));
    }
    if groups.len() > 1 {
        notes.push(format!(
            "of {} groups {:.1} fall below p = {} by chance alone; use Holm's p",
            groups.len(),
            options.significance * groups.len() as f64,
            options.significance
        ));
    }
    if options.p_rule == PRule::Exact && groups.iter().any(|group| !group.kolmogorov_smirnov.is_exact) {
        notes.push("very many peaks: p is Kolmogorov's, to which the exact p tends".to_owned());
    }
    if let Some(fewest) = groups.iter().map(|group| group.replicates).min().filter(|few| *few < options.replicates) {
        notes.push(format!("many peaks: the bands have only {fewest} replicates"));
    }
    if groups.iter().any(|group| group.kolmogorov_smirnov.has_ties) {
        notes.push("some peaks are equal: the exact p of their groups is too large rather than too small".to_owned());
    }
    if groups.iter().any(|group| group.censored.is_some()) {
        notes.push(
            "peaks above a limit (>x) rank above all values. Bias, dispersion and Pearson's correlation leave them \
             out; a median that they may move is a lower bound (>m) without an error"
                .to_owned(),
        );
    }
    if groups.iter().any(|group| group.measured_collapses + group.computed_collapses > 0) {
        notes.push(
            "collapses count as infinite in ranks, medians and distributions; bias, dispersion and Pearson's \
             correlation use pairs of finite peaks above 0"
                .to_owned(),
        );
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::super::peaks::PeakValue;
    use super::*;

    /// The sets of Table 6.2: all of a level, then its classes.
    #[test]
    fn groups_in_order() {
        let row = |class: &str, level: &str| (vec![class.to_owned(), level.to_owned()], PeakValue::Finite(1.0));
        let rows = vec![row("NFP", "low"), row("FF", "low"), row("NFP", "high")];
        let joined = Joined::Samples { measured: rows.clone(), computed: rows };
        let found = groups(&joined, &["class".to_owned(), "level".to_owned()]).unwrap();
        let names: Vec<String> = found
            .iter()
            .map(|of| of.iter().map(|cell| cell.as_deref().unwrap_or("all")).collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(names, ["all low", "NFP low", "FF low", "all high", "NFP high", "FF high"]);
        assert_eq!(groups(&joined, &[]).unwrap(), [Vec::<Option<String>>::new()]);
    }
}
