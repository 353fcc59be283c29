//! What the columns of a structure have, beside a reference.

use std::io::Write;

use uplift::table::{ColumnsRow, ColumnsTable};
use uplift::text::Table;

use crate::error::CommandError;

/// A row for each quantity, and one for each further number that the reference has for it.
pub(super) fn print_columns(out: &mut impl Write, report: &ColumnsTable) -> Result<(), CommandError> {
    let told = report.rows.iter().any(|row| row.source.is_some() || row.stiffness_n_m.is_some());
    let or_none = |none: &str, value: Option<f64>| value.map_or(none.to_owned(), number);
    let difference = |row: &ColumnsRow| row.difference().map(|share| format!("{:+.2}", 100.0 * share));
    let of_reference = |row: &ColumnsRow| {
        let held = row.stiffness_n_m.map(|stiffness| format!("linear, {:.0} kN/m", 1e-3 * stiffness));
        row.source.iter().cloned().chain(held).collect::<Vec<String>>().join("; ")
    };
    let table = Table::from_rows(&report.rows)
        .left("quantity", |row| &row.quantity)
        .right("ours", |row| or_none("none", row.value))
        .when(report.compared, |table| {
            table
                .bar("reference", |row| or_none("-", row.reference))
                .bar("difference, %", |row| difference(row).unwrap_or("-".to_owned()))
        })
        .when(told, |table| table.bar("of the reference", of_reference));
    Ok(writeln!(out, "{} ({})\n{table}", report.structure, report.file.display())?)
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
