//! The tables of a result, ours beside a reference.

mod columns;
mod design;

use std::io::Write;
use std::path::Path;

use uplift::table::{
    COMPARED_ABOVE, COMPARED_FROM_M, CoefficientRow, CoefficientTable, ReferenceFit, TableReport, TableRows,
};
use uplift::text::{Table, kind_of_risks, risk_name, spectrum_words};

use super::alarms::print_warnings;
use super::shake_table;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The table of a result, of either kind, with what to know before it is used.
pub(crate) fn print_table(report: &TableReport, result: &Path, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    match &report.rows {
        TableRows::Coefficients(coefficients) => print_coefficients(&mut out, coefficients),
        TableRows::Design(designs) => design::print_design(&mut out, designs),
        TableRows::Columns(columns) => columns::print_columns(&mut out, columns),
        TableRows::Tests(tests) => shake_table::print_order(&mut out, tests),
    }?;
    // a quiet terminal gets what was asked for alone
    print_warnings(&mut out, &report.alarms, Some(result), terminal)
}

fn print_coefficients(out: &mut impl Write, report: &CoefficientTable) -> Result<(), CommandError> {
    writeln!(out, "u = c0 exp(c1 strength) + c2, metres; records: {}", report.record_set)?;
    // a fit without coefficients says so in the first of its columns
    let fitted =
        |row: &CoefficientRow, value: f64| if row.fit.c0_m.is_nan() { String::new() } else { format!("{value:.4}") };
    let c2 = |row: &CoefficientRow| match fitted(row, row.fit.c2_m) {
        none if none.is_empty() => none,
        shown => shown + if row.fit.bound_active { " *" } else { "  " },
    };
    let printed = |row: &CoefficientRow, value: fn(&ReferenceFit) -> Option<f64>| {
        row.reference.as_ref().and_then(value).map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"))
    };
    let ratio = |row: &CoefficientRow| row.reference.as_ref().and(row.median_ratio).map(|ratio| format!("{ratio:.2}"));
    let within = |row: &CoefficientRow| match row.reach.and_then(|reach| reach.within_ten_percent) {
        Some((from, to)) => format!("{from:.2} to {to:.2}"),
        None => "-".to_owned(),
    };
    let table = Table::from_rows(&report.rows)
        .left("site", |row| &row.site)
        .right("im", measure)
        .right("poe", |row| risk_name(row.poe, report.years))
        .right("c0", |row| if row.fit.c0_m.is_nan() { "no fit".to_owned() } else { fitted(row, row.fit.c0_m) })
        .right("c1", |row| fitted(row, row.fit.c1))
        .right("c2  ", c2)
        .right("rmse", |row| fitted(row, row.fit.rmse_m))
        .right("within 10 %", within)
        .when(report.compared, |table| {
            table
                .bar("c0", |row| printed(row, |of| Some(of.c0_m)))
                .right("c1", |row| printed(row, |of| Some(of.c1)))
                .right("c2", |row| printed(row, |of| Some(of.c2_m)))
                .right("rmse", |row| printed(row, |of| of.rmse_m))
                .bar("ratio", |row| ratio(row).unwrap_or_else(|| "-".to_owned()))
        });
    writeln!(out, "{table}")?;
    let starred = if report.rows.iter().any(|row| row.fit.bound_active) { "* c2 held at 0; " } else { "" };
    let poes: Vec<f64> = report.rows.iter().map(|row| row.poe).collect();
    let kind = kind_of_risks(&poes, report.years).map_or_else(String::new, |kind| kind + "; ");
    writeln!(
        out,
        "{starred}{kind}rmse with n - 3 degrees of freedom; within 10 %: strengths where the curve is that close"
    )?;
    if report.rows.iter().any(|row| row.repaired) {
        writeln!(out, "repaired: records weighted for hazard consistency")?;
    }
    if report.compared {
        writeln!(
            out,
            "Right of the bars: the reference, and the median ratio of the spectrum to its curve, at strengths above \
             {COMPARED_ABOVE} where it exceeds {} mm",
            1000.0 * COMPARED_FROM_M
        )?;
    }
    Ok(())
}

fn measure(row: &CoefficientRow) -> String {
    spectrum_words(&row.im, row.repaired)
}
