//! `uplift records import`: from a folder of downloads to a manifest.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::terminal::tell;
use clap::Args;
use polars::prelude::Column;

use super::{CommandError, FileArguments, Terminal};
use uplift::import::{ImportOptions, Imported, Warning, import as import_folder, manifest_columns};
use uplift::result::{write_atomically, write_table};

/// Remarks of one kind that are shown.
const SHOWN: usize = 5;

#[derive(Debug, Args)]
pub(super) struct ImportArguments {
    /// Folder with record files, in folders of their own if you like
    folder: PathBuf,
    /// The manifest to write (CSV); a folder gets a manifest.csv
    #[arg(short, long, value_name = "SET")]
    output: PathBuf,
    #[command(flatten)]
    files: FileArguments,
    /// Leave out the search for velocity pulses, which takes most of the time
    #[arg(long)]
    no_pulses: bool,
}

pub(super) fn import(arguments: &ImportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let output =
        if arguments.output.is_dir() { arguments.output.join("manifest.csv") } else { arguments.output.clone() };
    if output.extension().is_none_or(|extension| extension != "csv") {
        return Err(CommandError::Usage(format!(
            "-o {}: give a name that ends in .csv, or a folder",
            output.display()
        )));
    }
    if output.exists() {
        return Err(CommandError::Usage(format!(
            "{} is there already, perhaps with columns of yours: give another name, or remove it",
            output.display()
        )));
    }
    if !arguments.folder.is_dir() {
        return Err(CommandError::input(format!("{} is not a folder", arguments.folder.display())));
    }
    let folder = output.parent().unwrap_or(Path::new(""));
    if !folder.as_os_str().is_empty() && !folder.is_dir() {
        return Err(CommandError::input(format!("{} is not a folder: make it first", folder.display())));
    }
    let FileArguments { format, unit, dt_s, gravity_m_s2 } = arguments.files;
    let options = ImportOptions { format, dt_s, unit, gravity_m_s2, pulses: !arguments.no_pulses };
    let start = std::time::Instant::now();
    let imported = import_folder(&arguments.folder, &options, terminal)?;
    let remarks = output.with_extension("remarks.txt");
    let told = tell_remarks(&imported, &remarks, terminal.is_quiet());
    if !told.is_empty() {
        write_atomically(&remarks, told.as_bytes())?;
    }
    if imported.pairs.is_empty() {
        return Err(CommandError::input(format!(
            "no pair of horizontal components in {}: {} files read, {} components found",
            arguments.folder.display(),
            imported.files,
            imported.components
        )));
    }
    let line =
        format!("uplift {} ({}), records import, {} pairs", uplift::VERSION, uplift::COMMIT, imported.pairs.len());
    let columns = manifest_columns(&imported.pairs, folder, &options);
    write_table(&output, &line, columns.clone())?;
    let without: Vec<&str> = ["magnitude", "rrup_km", "vs30"]
        .into_iter()
        .filter(|key| columns.iter().any(|column| column.name() == key && all_blank(column)))
        .collect();
    if !without.is_empty() {
        terminal.say(&format!(
            "no file says {}: fill in the columns of the manifest, or put PEER's _SearchResults.csv into the folder and import again",
            without.join(", ")
        ));
    }
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{} pairs from {} files in {:.1} s: {}",
        imported.pairs.len(),
        imported.files,
        start.elapsed().as_secs_f64(),
        output.display()
    )?;
    Ok(())
}

fn all_blank(column: &Column) -> bool {
    column.str().is_ok_and(|cells| cells.iter().all(|cell| cell.is_none_or(str::is_empty)))
}

/// Remarks on standard error, those of a kind together, the first of each; all of them are returned, for the file `remarks`.
fn tell_remarks(imported: &Imported, remarks: &Path, quiet: bool) -> String {
    let mut kinds: Vec<(&str, Vec<&Warning>)> = Vec::new();
    for warning in &imported.warnings {
        match kinds.iter_mut().find(|(kind, _)| *kind == warning.kind) {
            Some((_, warnings)) => warnings.push(warning),
            None => kinds.push((warning.kind, vec![warning])),
        }
    }
    let mut sections: Vec<(&str, Vec<&str>)> = kinds
        .into_iter()
        .map(|(kind, warnings)| (kind, warnings.iter().map(|warning| warning.text.as_str()).collect()))
        .collect();
    if !imported.passed_over.is_empty() {
        sections.push(("not read", imported.passed_over.iter().map(String::as_str).collect()));
    }
    let mut all = String::new();
    for (kind, texts) in sections {
        let head = format!("{kind} ({}):\n", texts.len());
        let lines: Vec<String> = texts.iter().map(|text| format!("  - {text}\n")).collect();
        if !quiet {
            let more = texts.len().saturating_sub(SHOWN);
            tell(format!("{head}{}", lines[..texts.len() - more].concat()).trim_end());
            if more > 0 {
                tell(&format!("  - and {more} more: {}", remarks.display()));
            }
        }
        all += &(head + &lines.concat());
    }
    all
}
