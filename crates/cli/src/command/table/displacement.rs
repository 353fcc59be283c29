//! The design tables of a result, ours beside a reference.

use std::io::Write;
use std::path::Path;

use serde_json::json;
use uplift_spectra::Noisy;

use crate::error::CommandError;
use crate::terminal::tell;
use uplift::reference::ReferenceTable;
use uplift::result::{DesignRow, ResultFile, StoredDesign};
use uplift::text::{finite, table as lines};
use uplift_study::ScaledTo;

/// A cell of the reference.
struct Reference {
    record_set: String,
    rule: String,
    scaling: ScaledTo,
    quantity: String,
    value: f64,
    /// Half of the last digit printed.
    rounding: f64,
}

impl Reference {
    fn is_of(&self, row: &DesignRow) -> bool {
        let same = |a: &str, b: &str| a.eq_ignore_ascii_case(b);
        same(&self.record_set, &row.record_set)
            && same(&self.rule, row.rule.unwrap_or_default())
            && same(&self.quantity, &row.quantity)
            && ScaledTo::parse(&row.scaling) == Some(self.scaling)
    }

    /// Whether the range holds the printed number, which stands for all that are rounded to it.
    fn is_within(&self, noisy: &Noisy) -> bool {
        noisy.lowest <= self.value + self.rounding && self.value - self.rounding <= noisy.highest
    }
}

/// A design value with its range and, where there is a reference, what it says and whether the range holds it.
pub(super) fn json_row(row: &DesignRow) -> serde_json::Value {
    json!({
        "record_set": row.record_set,
        "scaling": row.scaling,
        "scaled_by": row.scaled_by,
        "rule": row.rule,
        "quantity": row.quantity,
        "value": finite(row.noisy.value),
        "lowest": finite(row.noisy.lowest),
        "highest": finite(row.noisy.highest),
    })
}

/// Print the design tables of the result `file`.
pub(super) fn table(file: &ResultFile, reference: Option<&Path>, json: bool) -> Result<(), CommandError> {
    let Some(design) = file.design()? else {
        return Err(CommandError::input(format!(
            "{}: has no design example: add a section [design] to the study, which may be empty, and run it again",
            file.path().display()
        )));
    };
    let rows = &design.rows;
    let references = reference.map_or_else(|| Ok(Vec::new()), read_reference)?;
    let of = |row: &DesignRow| references.iter().find(|reference| reference.is_of(row));
    if reference.is_some() && rows.iter().all(|row| of(row).is_none()) {
        tell(&format!(
            "note: no row of the reference has a record set, scaling and quantity of the result: it has the sets {}, the result {}",
            distinct(references.iter().map(|reference| reference.record_set.as_str())).join(", "),
            distinct(rows.iter().map(|row| row.record_set.as_str())).join(", ")
        ));
    }
    let mut out = std::io::stdout().lock();
    if json {
        let rows: Vec<serde_json::Value> = rows
            .iter()
            .map(|row| {
                let mut value = json_row(row);
                if let Some(reference) = of(row) {
                    value["reference"] = json!(reference.value);
                    value["within"] = json!(reference.is_within(&row.noisy));
                }
                value
            })
            .collect();
        writeln!(out, "{:#}", serde_json::Value::Array(rows))?;
        return Ok(());
    }
    writeln!(out, "records: {}", file.head()?.record_set)?;
    print(&mut out, &design, reference.is_some(), &of)
}

/// One table a set and rule: a line a quantity and scaling, a column for each of those whose peak is scaled.
fn print<'a>(
    out: &mut impl Write,
    design: &StoredDesign,
    compared: bool,
    of: &dyn Fn(&DesignRow) -> Option<&'a Reference>,
) -> Result<(), CommandError> {
    let rows = &design.rows[..];
    let by = distinct(rows.iter().map(|row| row.scaled_by.as_str()));
    let (mut held, mut compared_with) = (vec![0; by.len()], 0);
    let mut rest = rows;
    while let Some(first) = rest.first() {
        let same = rest.iter().take_while(|row| row.record_set == first.record_set && row.rule == first.rule).count();
        let (of_table, others) = rest.split_at(same);
        rest = others;
        let rule = match first.rule {
            Some("ED") => ", equal displacement rule",
            Some(_) => ", equal energy rule",
            None => "",
        };
        writeln!(out, "\n{}{rule}, FS = {}", first.record_set, design.safety_factor)?;
        let mut header = vec!["quantity".to_owned(), "scaling".to_owned()];
        header.extend(by.iter().map(|by| format!("by {by}")));
        if compared {
            header.extend(["| reference".to_owned(), "within".to_owned()]);
        }
        let mut cells = Vec::new();
        // the ways of scaling one value stand together
        for values in of_table.chunks(by.len()) {
            let mut row = vec![values[0].quantity.clone(), values[0].scaling.clone()];
            row.extend(values.iter().map(DesignRow::ranged));
            if compared {
                row.extend(match of(&values[0]) {
                    None => ["| -".to_owned(), String::new()],
                    Some(reference) => {
                        compared_with += 1;
                        let within: Vec<&str> = values
                            .iter()
                            .zip(&mut held)
                            .filter(|(value, _)| reference.is_within(&value.noisy))
                            .map(|(value, held)| {
                                *held += 1;
                                value.scaled_by.as_str()
                            })
                            .collect();
                        [format!("| {}", values[0].shown(reference.value)), within.join(", ")]
                    }
                });
            }
            cells.push(row);
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        writeln!(out, "{}", lines(&header, &cells))?;
    }
    writeln!(
        out,
        "\nin brackets: lowest and highest over {} points from {} to {} times the abscissa",
        design.noise_points,
        1.0 - design.noise_relative,
        1.0 + design.noise_relative
    )?;
    if compared {
        let held: Vec<String> =
            by.iter().zip(held).map(|(by, held)| format!("{held} of {compared_with} by {by}")).collect();
        writeln!(out, "within: whose range holds the reference, as rounded: {}", held.join(", "))?;
    }
    Ok(())
}

fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found: Vec<&str> = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

fn read_reference(path: &Path) -> Result<Vec<Reference>, CommandError> {
    let table = ReferenceTable::read(path)?;
    let missing: Vec<&str> =
        ["record_set", "scaling", "quantity", "value"].into_iter().filter(|name| !table.has(name)).collect();
    if !missing.is_empty() {
        return Err(table.fail(format!("has no column {}", missing.join(", "))).into());
    }
    (0..table.rows())
        .map(|row| {
            let scaling = table.text("scaling", row);
            let digits = table.text("value", row);
            let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            Ok(Reference {
                record_set: table.text("record_set", row),
                rule: table.text("rule", row),
                scaling: ScaledTo::parse(&scaling).ok_or_else(|| {
                    table.fail(format!("row {}, scaling: {scaling:?} is neither unscaled nor as 0.5PGA", row + 1))
                })?,
                quantity: table.text("quantity", row),
                value: table.number("value", row)?,
                rounding: 0.5 * 0.1_f64.powi(i32::try_from(decimals).unwrap_or(i32::MAX)),
            })
        })
        .collect()
}
