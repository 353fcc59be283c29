//! The tests of a shaking table in the order of rising response, beside a printed order (Table A1.1).

use std::collections::BTreeMap;

use serde::Serialize;
use uplift_job::ReferenceTable;
use uplift_job::text::finite;
use uplift_result::{ResultFile, ShakeTable};
use uplift_validation::pairs::spearman;

use super::options::TableOptions;
use crate::error::ExportsError;

/// The tests of a result, in the order of their response.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TestsTable {
    /// Where the records come from, in a line.
    pub record_set: String,
    /// The structure file.
    pub structure: String,
    /// The tests.
    pub rows: Vec<TestRow>,
    /// How far both orders agree; none without a reference.
    pub agreement: Option<Agreement>,
}

/// A test.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TestRow {
    /// Its place in our order, from 1.
    pub order: u32,
    /// Its place in the reference, from 1.
    pub reference: Option<u32>,
    /// The level.
    pub level: String,
    /// What the excitation is called.
    pub exc_id: String,
    /// Its class.
    pub class: String,
    /// The record.
    pub record: String,
    /// Peak displacement, m; none where the frame overturns.
    pub u_m: Option<f64>,
    /// The same over the height of the columns.
    pub drift: Option<f64>,
    /// Peak force of a restrainer, N; none where the frame overturns, or has none.
    pub tendon_n: Option<f64>,
    /// Peak base shear, N.
    pub base_shear_n: Option<f64>,
}

/// How far two orders of the tests agree.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// Tests that are in both.
    pub tests: usize,
    /// Tests of the reference that are not among ours.
    pub reference_only: usize,
    /// Spearman's correlation of our displacements with the places of the reference, overturned ones the largest.
    pub spearman: Option<f64>,
    /// The same within each level, with the number of tests.
    pub by_level: Vec<(String, usize, Option<f64>)>,
}

pub(super) fn read(options: &TableOptions, file: &ResultFile) -> Result<TestsTable, ExportsError> {
    let table = file.shake_table()?;
    let reference = options.reference.as_deref().map(ReferenceTable::read).transpose()?;
    let printed = reference.as_ref().map(places).transpose()?;
    let order = table.order();
    let (mut rows, mut pairs) = (Vec::new(), Vec::new());
    let tests = (0..table.levels.len()).flat_map(|level| table.tests_at_level(level).map(move |test| (level, test)));
    for ((level, (excitation, test)), order) in tests.zip(order) {
        let name = &table.levels[level].name;
        let place = printed.as_ref().and_then(|all| all.get(&(name.clone(), excitation.exc_id.clone())).copied());
        if let Some(place) = place {
            pairs.push((level, f64::from(place), test.u_m));
        }
        rows.push(TestRow {
            order,
            reference: place,
            level: name.clone(),
            exc_id: excitation.exc_id.clone(),
            class: excitation.class.clone(),
            record: excitation.record.clone(),
            u_m: finite(test.u_m),
            drift: finite(test.drift),
            tendon_n: finite(test.tendon_n),
            base_shear_n: finite(test.base_shear_n),
        });
    }
    rows.sort_by_key(|row| row.order);
    let agreement = match (&reference, &printed) {
        (Some(reference), Some(printed)) => Some(agreement(&table, &pairs, printed.len(), reference)?),
        _ => None,
    };
    Ok(TestsTable { record_set: table.records, structure: table.structure, rows, agreement })
}

/// The place of each test; of one that stands there twice the first.
fn places(table: &ReferenceTable) -> Result<BTreeMap<(String, String), u32>, ExportsError> {
    if let Some(missing) = ["level", "exc_id"].into_iter().find(|name| !table.has(name)) {
        return Err(table
            .fail(format!(
                "it has no column {missing}: an order of tests has level and exc_id, a row a test from the first"
            ))
            .into());
    }
    let mut places = BTreeMap::new();
    for (row, place) in (0..table.rows()).zip(1..) {
        places.entry((table.text("level", row), table.text("exc_id", row))).or_insert(place);
    }
    Ok(places)
}

fn agreement(
    table: &ShakeTable,
    pairs: &[(usize, f64, f64)],
    printed: usize,
    reference: &ReferenceTable,
) -> Result<Agreement, ExportsError> {
    if pairs.is_empty() {
        return Err(reference
            .fail(
                "none of its tests is in the result: its columns level and exc_id must have the names of the study's \
             levels and excitations",
            )
            .into());
    }
    let correlation = |wanted: &dyn Fn(usize) -> bool| {
        let (places, found): (Vec<f64>, Vec<f64>) =
            pairs.iter().filter(|(level, ..)| wanted(*level)).map(|(_, place, u_m)| (*place, *u_m)).unzip();
        (places.len(), spearman(&places, &found))
    };
    let by_level = table.levels.iter().enumerate().map(|(index, level)| {
        let (count, found) = correlation(&|level| level == index);
        (level.name.clone(), count, found)
    });
    Ok(Agreement {
        tests: pairs.len(),
        reference_only: printed - pairs.len(),
        spearman: correlation(&|_| true).1,
        by_level: by_level.collect(),
    })
}
