//! `uplift records select`: which records a study takes, and a manifest of them.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, SetArguments, Terminal, refuse_foreign, refuse_overwriting};
use uplift::inputs::manifest;
use uplift::result::write_table;

#[derive(Debug, Args)]
pub(super) struct SelectArguments {
    #[command(flatten)]
    set: SetArguments,
    /// Write a manifest of the chosen records
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(super) fn select(arguments: &SelectArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let selection = arguments.set.criteria.selection();
    if selection.is_empty() {
        return Err(CommandError::Usage("say which records, e.g. --magnitude 6.5:7.5 --pulse-like false".to_owned()));
    }
    let set = &arguments.set.set;
    if let Some(output) = &arguments.output {
        refuse_overwriting(output, &[set])?;
        refuse_foreign(output)?;
    }
    let (pairs, count) = arguments.set.read(terminal)?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "# {} of {count} records; for a study:\n[records]", pairs.len())?;
    writeln!(out, "manifest = {}", toml::Value::from(set.display().to_string()))?;
    if let Some(tag) = &arguments.set.tag {
        writeln!(out, "tag = {}", toml::Value::from(tag.as_str()))?;
    }
    writeln!(out, "intensity = \"{}\"\n\n[records.select]", arguments.set.intensity)?;
    for (criterion, range) in &selection.ranges {
        writeln!(out, "{} = \"{range}\"", criterion.key)?;
    }
    if let Some(pulse_like) = selection.pulse_like {
        writeln!(out, "pulse_like = {pulse_like}")?;
    }
    let Some(output) = &arguments.output else { return Ok(()) };
    let ids: BTreeSet<&str> = pairs.iter().map(|(pair, _)| pair.id.as_str()).collect();
    let folder = output.parent().unwrap_or(Path::new(""));
    let columns = manifest::rows_of(set, &ids, folder).map_err(uplift::UpliftError::Inputs)?;
    let line =
        format!("uplift {} ({}), {} of {count} records: {selection}", uplift::VERSION, uplift::COMMIT, pairs.len());
    write_table(output, &line, columns)?;
    terminal.say(&format!("{} records: {}", pairs.len(), output.display()));
    Ok(())
}
