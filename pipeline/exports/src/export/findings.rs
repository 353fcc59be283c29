//! What structures were asked under a result, as every format takes it: a row each number of an answer.

use polars::prelude::Column;
use rust_xlsxwriter::XlsxError;
use serde_json::{Map, Value, json};
use uplift_job::text::finite;
use uplift_result::{FindingRow, StoredFinding};

use super::Export;
use super::matlab::level_5::{MatFile, Shape};
use super::workbook::sheet::{Sheet, Shown};

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "structure";

/// Texts of a row by the name of its column.
type Text = fn(&StoredFinding, &FindingRow) -> String;
const TEXTS: [(&str, Text); 8] = [
    (FIRST_COLUMN, |of, _| of.finding.structure.clone()),
    ("structure_file", |of, _| if of.is_of_earlier_file { "earlier" } else { "last" }.to_owned()),
    ("asked", |of, _| of.finding.question()),
    ("quantity", |_, row| row.quantity.clone()),
    ("site", |_, row| row.site.clone()),
    ("im", |_, row| row.im.clone()),
    ("unit", |_, row| row.unit.clone()),
    ("band", |_, row| row.band.clone()),
];
/// Numbers of a row by the name of its column.
type Number = fn(&FindingRow) -> f64;
const NUMBERS: [(&str, Number); 3] =
    [("value", |row| row.value), ("lower", |row| row.limits[0]), ("upper", |row| row.limits[1])];

impl Export {
    /// Every number of every answer.
    fn finding_rows(&self) -> impl Iterator<Item = (&StoredFinding, &FindingRow)> {
        self.findings.iter().flat_map(|of| of.finding.rows.iter().map(move |row| (of, row)))
    }

    fn finding_texts(&self, text: Text) -> Vec<String> {
        self.finding_rows().map(|(of, row)| text(of, row)).collect()
    }

    fn finding_numbers(&self, number: Number) -> Vec<f64> {
        self.finding_rows().map(|(_, row)| number(row)).collect()
    }

    /// The table of answers.
    pub(super) fn finding_columns(&self) -> Vec<Column> {
        let texts = TEXTS.map(|(name, text)| Column::new(name.into(), self.finding_texts(text)));
        // nothing where there is no band
        let known = |number| self.finding_numbers(number).into_iter().map(|of: f64| (!of.is_nan()).then_some(of));
        let numbers = NUMBERS.map(|(name, number)| Column::new(name.into(), known(number).collect::<Vec<_>>()));
        texts.into_iter().chain(numbers).collect()
    }

    /// The answers, each with what it was asked for and what `--json` printed.
    pub(super) fn findings_json(&self) -> Value {
        let row = |row: &FindingRow| {
            json!({
                "quantity": row.quantity,
                "site": row.site,
                "im": row.im,
                "value": finite(row.value),
                "lower": finite(row.limits[0]),
                "upper": finite(row.limits[1]),
                "unit": row.unit,
                "band": row.band,
            })
        };
        let answer = |of: &StoredFinding| {
            let request: Map<String, Value> =
                of.finding.request.iter().map(|(name, value)| (name.clone(), value.as_str().into())).collect();
            json!({
                "structure": of.finding.structure,
                "structure_sha256": of.finding.structure_sha256(),
                "is_of_earlier_file": of.is_of_earlier_file,
                "command": of.finding.inquiry.key(),
                "request": request,
                "created": of.created,
                "version": of.version,
                "rows": of.finding.rows.iter().map(row).collect::<Vec<_>>(),
                "document": of.finding.printed(),
            })
        };
        self.findings.iter().map(answer).collect()
    }

    /// Columns over the numbers of all answers.
    pub(super) fn add_findings(&self, file: &mut MatFile) {
        let rows = Shape::column(self.finding_rows().count());
        for (name, text) in TEXTS {
            let texts = self.finding_texts(text);
            file.texts(&format!("finding_{name}"), &texts.iter().map(String::as_str).collect::<Vec<_>>());
        }
        for (name, number) in NUMBERS {
            file.numbers(&format!("finding_{name}"), &rows, &self.finding_numbers(number));
        }
    }

    /// A line each number.
    pub(super) fn findings_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let names = TEXTS.iter().map(|(name, _)| *name).chain(NUMBERS.iter().map(|(name, _)| *name));
        for (column, name) in names.enumerate() {
            sheet.heading((0, column), &name.replace('_', " "), true)?;
        }
        for (index, (of, row)) in self.finding_rows().enumerate() {
            for (column, (_, text)) in TEXTS.iter().enumerate() {
                sheet.text((1 + index, column), &text(of, row))?;
            }
            for (column, (_, number)) in NUMBERS.iter().enumerate() {
                sheet.number((1 + index, TEXTS.len() + column), number(row), Shown::Plain, "infinite")?;
            }
        }
        sheet.finish((1, 1), &[18.0, 14.0, 60.0, 40.0, 18.0, 9.0, 9.0, 20.0, 14.0, 14.0, 14.0])
    }
}
