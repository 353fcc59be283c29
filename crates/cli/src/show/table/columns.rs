//! What the columns of a structure have, beside a reference.

use std::io::Write;

use uplift::table::{ColumnsRow, ColumnsTable};
use uplift::text::table;

use crate::error::CommandError;

/// A row for each quantity; what the reference has and nobody computes stands below.
pub(super) fn print_columns(out: &mut impl Write, report: &ColumnsTable) -> Result<(), CommandError> {
    let mut header = vec!["quantity", "ours"];
    if report.compared {
        header.extend(["| reference", "| difference, %"]);
    }
    let cells = |row: &ColumnsRow| {
        let mut cells = vec![row.quantity.clone(), row.value.map_or("none".to_owned(), number)];
        if report.compared {
            cells.push(format!("| {}", row.reference.map_or("-".to_owned(), number)));
            let difference = row.value.zip(row.reference).map(|(ours, theirs)| 100.0 * (ours / theirs - 1.0));
            cells.push(format!("| {}", difference.map_or("-".to_owned(), |share| format!("{share:+.2}"))));
        }
        cells
    };
    let rows: Vec<Vec<String>> = report.rows.iter().map(cells).collect();
    writeln!(out, "{} ({})", report.structure, report.file.display())?;
    Ok(writeln!(out, "{}", table(&header, &rows))?)
}

/// Six digits, in powers of ten where they would be too many or few.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e7).contains(&value.abs()) {
        let digits = 6_usize.saturating_sub(format!("{:.0}", value.abs().trunc()).len());
        format!("{value:.digits$}")
    } else {
        format!("{value:.5e}")
    }
}
