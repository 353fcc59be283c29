//! What an import of records found.

use std::io::Write;

use uplift::import::ImportReport;
use uplift::text::{counted, one_line};

use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Remarks of one kind that are shown.
const SHOWN: usize = 5;

/// Remarks on standard error, those of a kind together, the first of each.
pub(crate) fn tell_remarks(report: &ImportReport, terminal: &Terminal) {
    let Some(file) = report.remarks_file.as_ref().filter(|_| !terminal.is_quiet()) else { return };
    for remarks in &report.remarks {
        let texts = &remarks.texts;
        let more = texts.len().saturating_sub(SHOWN);
        terminal.say(&format!("{} ({}):", remarks.kind, texts.len()));
        for text in &texts[..texts.len() - more] {
            terminal.say(&format!("  - {}", one_line(text)));
        }
        if more > 0 {
            terminal.say(&format!("  - and {more} more: {}", file.display()));
        }
    }
}

/// The pairs found and their manifest, what was not read, what the manifest lacks.
pub(crate) fn print_import(report: &ImportReport, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(manifest) = report.manifest.as_ref().filter(|_| !terminal.is_quiet()) {
        let ImportReport { pairs, files, seconds, .. } = report;
        let (pairs, files) = (counted(*pairs, "pair"), counted(*files, "file"));
        writeln!(output(), "{pairs} from {files} in {seconds:.1} s: {}", manifest.display())?;
    }
    tell_remarks(report, terminal);
    if !report.blank_columns.is_empty() {
        terminal.say(&format!(
            "the record files give no {}: fill in these columns of the manifest, or put PEER's _SearchResults.csv \
             into the folder and import again",
            report.blank_columns.join(", no ")
        ));
    }
    Ok(())
}
