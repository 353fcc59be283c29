//! What the columns of a structure have, beside a reference.

use std::io::Write;

use uplift::table::{ColumnsRow, ColumnsTable};
use uplift::text::table;

use crate::error::CommandError;

/// A row for each quantity, and one for each further number that the reference has for it.
pub(super) fn print_columns(out: &mut impl Write, report: &ColumnsTable) -> Result<(), CommandError> {
    let mut header = vec!["quantity", "ours"];
    if report.compared {
        header.extend(["| reference", "| difference, %"]);
    }
    let told = report.rows.iter().any(|row| row.source.is_some() || row.stiffness_n_m.is_some());
    if told {
        header.push("| of the reference");
    }
    let cells = |row: &ColumnsRow| {
        let mut cells = vec![row.quantity.clone(), row.value.map_or("none".to_owned(), number)];
        if report.compared {
            cells.push(format!("| {}", row.reference.map_or("-".to_owned(), number)));
            let difference = row.difference().map(|share| format!("{:+.2}", 100.0 * share));
            cells.push(format!("| {}", difference.unwrap_or("-".to_owned())));
        }
        if told {
            let held = row.stiffness_n_m.map(|stiffness| format!("linear, {:.0} kN/m", 1e-3 * stiffness));
            let words: Vec<String> = row.source.iter().cloned().chain(held).collect();
            cells.push(format!("| {}", words.join("; ")));
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
