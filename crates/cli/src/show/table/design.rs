//! The design tables of a result.

use std::io::Write;

use uplift::table::{DesignTable, DesignTableRow};
use uplift::text::Table;

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
        // the ways of scaling one value stand together
        let table = Table::from_rows(of_table.chunks(by.len()))
            .left("quantity", |values| &values[0].row.quantity)
            .right("scaling", |values| &values[0].row.scaling)
            .each(by.iter().enumerate(), |table, (way, by)| {
                table.right(format!("by {by}"), |values| values.get(way).map_or(String::new(), |of| of.row.ranged()))
            })
            .when(report.compared, |table| table.bar("reference", reference).right("within", within));
        writeln!(out, "{table}")?;
        if report.compared {
            compared_with += of_table.chunks(by.len()).filter(|values| values[0].reference.is_some()).count();
            for (value, at) in of_table.iter().zip((0..by.len()).cycle()) {
                held[at] += usize::from(value.within == Some(true));
            }
        }
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
        writeln!(out, "within: the range holds the rounded reference: {}", held.join(", "))?;
    }
    Ok(())
}

/// What the reference says of a value.
fn reference(values: &[DesignTableRow]) -> String {
    values[0].reference.map_or_else(|| "-".to_owned(), |reference| values[0].row.shown(reference))
}

/// By which ways of scaling the range of a value holds the reference.
fn within(values: &[DesignTableRow]) -> String {
    let within = values.iter().filter(|value| value.within == Some(true) && values[0].reference.is_some());
    within.map(|value| value.row.scaled_by.as_str()).collect::<Vec<&str>>().join(", ")
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
