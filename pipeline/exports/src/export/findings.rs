//! What structures were asked under a result, as every format takes it: a row each number of an answer.

use polars::prelude::Column;
use rust_xlsxwriter::XlsxError;
use serde_json::{Map, Value, json};
use uplift_result::declared::{Field, Quantity};
use uplift_result::{FINDINGS, FindingRow, StoredFinding};

use super::Export;
use super::json::cell;
use super::matlab::level_5::{MatFile, Shape};
use super::workbook::sheet::{Sheet, Shown};

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "structure";

/// What each row has of its answer, before its own arrays, by the name of the column.
const OF_ANSWER: [(&str, Text); 3] = [
    (FIRST_COLUMN, |of| of.finding.structure.clone()),
    ("structure_file", |of| if of.is_of_earlier_file { "earlier" } else { "last" }.to_owned()),
    ("asked", |of| of.finding.question()),
];

type Text = fn(&StoredFinding) -> String;

/// A column over all rows.
enum Cells {
    Texts(Vec<String>),
    Numbers(Vec<f64>),
}

impl Export {
    /// Every number of every answer: the rows of the answer, and the place among them.
    fn finding_rows(&self) -> impl Iterator<Item = (&StoredFinding, usize)> {
        self.findings.iter().flat_map(|of| (0..of.finding.rows.len()).map(move |at| (of, at)))
    }

    /// All columns with their names.
    fn finding_cells(&self) -> Vec<(&'static str, Cells)> {
        let of_answer =
            |(name, text): (_, Text)| (name, Cells::Texts(self.finding_rows().map(|(of, _)| text(of)).collect()));
        let of_row = |quantity: &'static Quantity<Vec<FindingRow>>| {
            let rows = self.finding_rows().map(|(of, at)| (&of.finding.rows, at));
            let cells = match &quantity.field {
                Field::Text(place) => Cells::Texts(rows.map(|(rows, at)| (place.get)(rows, at).clone()).collect()),
                _ => Cells::Numbers(rows.filter_map(|(rows, at)| quantity.number(rows, at)).collect()),
            };
            (quantity.name, cells)
        };
        OF_ANSWER.into_iter().map(of_answer).chain(FINDINGS.quantities.iter().map(of_row)).collect()
    }

    /// The table of answers.
    pub(super) fn finding_columns(&self) -> Vec<Column> {
        let column = |(name, cells): (&str, Cells)| match cells {
            Cells::Texts(texts) => Column::new(name.into(), texts),
            // nothing where there is no band
            Cells::Numbers(numbers) => {
                let known = numbers.into_iter().map(|number| (!number.is_nan()).then_some(number));
                Column::new(name.into(), known.collect::<Vec<_>>())
            }
        };
        self.finding_cells().into_iter().map(column).collect()
    }

    /// The answers, each with what it was asked for and what `--json` printed.
    pub(super) fn findings_json(&self) -> Value {
        let row = |rows: &Vec<FindingRow>, at: usize| -> Value {
            FINDINGS.quantities.iter().map(|own| (own.name.to_owned(), cell(own, rows, at))).collect()
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
                "rows": (0..of.finding.rows.len()).map(|at| row(&of.finding.rows, at)).collect::<Vec<_>>(),
                "document": of.finding.printed(),
            })
        };
        self.findings.iter().map(answer).collect()
    }

    /// Columns over the numbers of all answers.
    pub(super) fn add_findings(&self, file: &mut MatFile) {
        let rows = Shape::column(self.finding_rows().count());
        for (name, cells) in self.finding_cells() {
            let name = format!("finding_{name}");
            match cells {
                Cells::Texts(texts) => file.texts(&name, &texts.iter().map(String::as_str).collect::<Vec<_>>()),
                Cells::Numbers(numbers) => file.numbers(&name, &rows, &numbers),
            }
        }
    }

    /// A line each number.
    pub(super) fn findings_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        for (column, (name, cells)) in self.finding_cells().into_iter().enumerate() {
            sheet.heading((0, column), &name.replace('_', " "), true)?;
            match cells {
                Cells::Texts(texts) => {
                    texts.iter().zip(1..).try_for_each(|(text, line)| sheet.text((line, column), text))
                }
                Cells::Numbers(numbers) => numbers
                    .iter()
                    .zip(1..)
                    .try_for_each(|(number, line)| sheet.number((line, column), *number, Shown::Plain, "infinite")),
            }?;
        }
        sheet.finish((1, 1), &[18.0, 14.0, 60.0, 40.0, 18.0, 9.0, 9.0, 20.0, 14.0, 14.0, 14.0])
    }
}
