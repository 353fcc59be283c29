//! Whether results are as they were written.

use std::io::Write;

use uplift::verify::VerifyReport;

use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The files that are sound, and on standard error the arrays that nothing is known of.
pub(crate) fn print_verified(report: &VerifyReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    for file in &report.files {
        let name = file.file.display();
        let unknown = &file.unknown;
        if !unknown.is_empty() {
            terminal.say(&format!("{name}: {} arrays without a checksum: {}", unknown.len(), unknown.join(", ")));
        }
        if file.mistakes.is_empty() {
            writeln!(out, "{name}: unchanged, {} arrays and every byte", file.sound)?;
        }
    }
    Ok(())
}
