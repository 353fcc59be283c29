//! The tables of a result, ours beside a reference.

mod columns;
mod design;

use std::io::Write;

use uplift::table::{COMPARED_ABOVE, COMPARED_FROM_M, CoefficientRow, CoefficientTable, TableReport, TableRows};
use uplift::text::{kind_of_risks, risk_name, spectrum_words, table};

use super::alarms::print_alarms;
use super::shake_table;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The table of a result, of either kind, with what to know before it is used.
pub(crate) fn print_table(report: &TableReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    match &report.rows {
        TableRows::Coefficients(coefficients) => print_coefficients(&mut out, coefficients),
        TableRows::Design(designs) => design::print_design(&mut out, designs),
        TableRows::Columns(columns) => columns::print_columns(&mut out, columns),
        TableRows::Tests(tests) => shake_table::print_order(&mut out, tests),
    }?;
    // a quiet terminal gets what was asked for alone
    if terminal.is_quiet() { Ok(()) } else { print_alarms(&mut out, &report.alarms) }
}

fn print_coefficients(out: &mut impl Write, report: &CoefficientTable) -> Result<(), CommandError> {
    writeln!(out, "u = c0 exp(c1 strength) + c2, metres; records: {}", report.record_set)?;
    let mut header = vec!["site", "im", "poe", "c0", "c1", "c2  ", "rmse"];
    if report.compared {
        header.extend(["| c0", "c1", "c2", "rmse", "| ratio"]);
    }
    let cells = |row: &CoefficientRow| {
        let mut cells = vec![row.site.clone(), measure(row), risk_name(row.poe, report.years)];
        cells.extend(ours(row));
        if report.compared {
            cells.extend(theirs(row));
        }
        cells
    };
    let rows: Vec<Vec<String>> = report.rows.iter().map(cells).collect();
    writeln!(out, "{}", table(&header, &rows))?;
    let starred = if report.rows.iter().any(|row| row.bound_active) { "* c2 held at 0; " } else { "" };
    let poes: Vec<f64> = report.rows.iter().map(|row| row.poe).collect();
    let kind = kind_of_risks(&poes, report.years).map_or_else(String::new, |kind| kind + "; ");
    writeln!(out, "{starred}{kind}rmse with n - 3 degrees of freedom")?;
    if report.rows.iter().any(|row| row.repaired) {
        writeln!(out, "repaired: of records weighted so that they bring the site's hazard of both measures")?;
    }
    if report.compared {
        writeln!(
            out,
            "right of the bars: the reference, and the median ratio of our spectrum to its curve over strengths in \
             ({COMPARED_ABOVE}, 1] where that exceeds {} mm",
            1000.0 * COMPARED_FROM_M
        )?;
    }
    Ok(())
}

fn measure(row: &CoefficientRow) -> String {
    spectrum_words(&row.im, row.repaired)
}

fn ours(row: &CoefficientRow) -> Vec<String> {
    if row.c0_m.is_nan() {
        return vec!["no fit".to_owned(), String::new(), String::new(), String::new()];
    }
    let bound = if row.bound_active { " *" } else { "  " };
    vec![
        format!("{:.4}", row.c0_m),
        format!("{:.4}", row.c1),
        format!("{:.4}{bound}", row.c2_m),
        format!("{:.4}", row.rmse_m),
    ]
}

fn theirs(row: &CoefficientRow) -> Vec<String> {
    let Some(reference) = &row.reference else {
        return ["| -", "-", "-", "-", "| -"].map(str::to_owned).to_vec();
    };
    vec![
        format!("| {:.4}", reference.c0_m),
        format!("{:.4}", reference.c1),
        format!("{:.4}", reference.c2_m),
        reference.rmse_m.map_or_else(|| "-".to_owned(), |rmse| format!("{rmse:.4}")),
        row.median_ratio.map_or_else(|| "| -".to_owned(), |ratio| format!("| {ratio:.2}")),
    ]
}
