//! The design tables of a result.

use std::io::Write;

use uplift::table::{DesignTable, DesignTableRow};
use uplift::text::table;

use crate::error::CommandError;
use crate::show::ROUNDING_DECIDES;

/// One table a set and rule: a line a quantity and scaling, a column for each of those whose peak is scaled.
pub(super) fn print_design(out: &mut impl Write, report: &DesignTable) -> Result<(), CommandError> {
    let by = ways(&report.rows);
    let (mut held, mut compared_with) = (vec![0; by.len()], 0);
    writeln!(out, "records: {}", report.record_set)?;
    let same =
        |a: &DesignTableRow, b: &DesignTableRow| a.row.record_set == b.row.record_set && a.row.rule == b.row.rule;
    for of_table in report.rows.chunk_by(same) {
        let first = &of_table[0].row;
        let rule = match first.rule {
            Some("ED") => ", equal displacement rule",
            Some(_) => ", equal energy rule",
            None => "",
        };
        writeln!(out, "\n{}{rule}, FS = {}", first.record_set, report.safety_factor)?;
        let mut header = vec!["quantity".to_owned(), "scaling".to_owned()];
        header.extend(by.iter().map(|by| format!("by {by}")));
        if report.compared {
            header.extend(["| reference".to_owned(), "within".to_owned()]);
        }
        let mut cells = Vec::new();
        // the ways of scaling one value stand together
        for values in of_table.chunks(by.len()) {
            let first = &values[0];
            let mut row = vec![first.row.quantity.clone(), first.row.scaling.clone()];
            row.extend(values.iter().map(|value| value.row.ranged()));
            if report.compared {
                compared_with += usize::from(first.reference.is_some());
                for (value, held) in values.iter().zip(&mut held) {
                    *held += usize::from(value.within == Some(true));
                }
                row.extend(theirs(values));
            }
            cells.push(row);
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        writeln!(out, "{}", table(&header, &cells))?;
    }
    writeln!(
        out,
        "\nin brackets: lowest and highest over {} points from {} to {} times the abscissa",
        report.noise_points,
        1.0 - report.noise_relative,
        1.0 + report.noise_relative
    )?;
    if report.rows.iter().any(|row| row.row.hangs_on_rounding()) {
        writeln!(out, "{ROUNDING_DECIDES}: lowest to highest of these")?;
        for value in &report.rows {
            if let Some(words) = value.row.rounding_words() {
                writeln!(out, "   {}: {words}", value.row.record_set)?;
            }
        }
    }
    if report.compared {
        let held: Vec<String> =
            by.iter().zip(held).map(|(by, held)| format!("{held} of {compared_with} by {by}")).collect();
        writeln!(out, "within: whose range holds the reference, as rounded: {}", held.join(", "))?;
    }
    Ok(())
}

/// What the reference says of a value, and by which ways of scaling the range holds it.
fn theirs(values: &[DesignTableRow]) -> [String; 2] {
    let Some(reference) = values[0].reference else { return ["| -".to_owned(), String::new()] };
    let within: Vec<&str> =
        values.iter().filter(|value| value.within == Some(true)).map(|value| value.row.scaled_by.as_str()).collect();
    [format!("| {}", values[0].row.shown(reference)), within.join(", ")]
}

/// Whose peak is scaled, each way once.
fn ways(rows: &[DesignTableRow]) -> Vec<&str> {
    let mut ways: Vec<&str> = Vec::new();
    for row in rows {
        if !ways.contains(&row.row.scaled_by.as_str()) {
            ways.push(&row.row.scaled_by);
        }
    }
    ways
}
