//! The tests as a table beside the result.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::outputs::{Output, OutputKind, beside};
use uplift_job::table::ColumnsOf;
use uplift_result::{ResultFile, ShakeTable, TABLE_ORDER, TABLE_TESTS};
use uplift_study::ShakeTableStudy;

use crate::Table;
use crate::error::StudiesError;

/// A column of every such table, and of no other.
pub const COLUMN: &str = "base_shear_n";

/// The table beside the result file `result`.
fn shake_table_csv_path(result: &Path) -> PathBuf {
    beside(result, "tests.csv")
}

/// All files but the result that a run of `study` with the result at `result` writes.
pub fn tables(study: &ShakeTableStudy, result: &Path) -> Vec<Output> {
    let table = Output::new(shake_table_csv_path(result), OutputKind::Table(COLUMN));
    if study.output.csv { vec![table] } else { Vec::new() }
}

/// The table of the result in `file`.
///
/// # Errors
/// A file that is damaged.
pub fn csv_tables(file: &ResultFile) -> Result<Vec<Table>, StudiesError> {
    Ok(vec![(shake_table_csv_path(file.path()), columns(&file.shake_table()?))])
}

/// A row a test, `[level, excitation]`: what `uplift validate` reads.
pub fn columns(table: &ShakeTable) -> Vec<Column> {
    let rows =
        (0..table.levels.len()).flat_map(|level| table.excitations.iter().map(move |excitation| (level, excitation)));
    let mut columns = ColumnsOf::new(rows)
        .with("exc_id", |(_, excitation)| excitation.exc_id.as_str())
        .with("class", |(_, excitation)| excitation.class.as_str())
        .with("level", |(level, _)| table.levels[level].name.as_str())
        .with("record", |(_, excitation)| excitation.record.as_str())
        .with("rsn", |(_, excitation)| excitation.rsn.as_str())
        .build();
    columns.push(Column::new(TABLE_ORDER.quantities[0].name.into(), table.order()));
    columns.extend(TABLE_TESTS.quantities.iter().map(|quantity| {
        let number = |at| quantity.number(table, at).filter(|value| !value.is_nan());
        Column::new(quantity.name.into(), (0..table.tests.len()).map(number).collect::<Vec<Option<f64>>>())
    }));
    columns
}
