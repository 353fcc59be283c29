//! Tidy tables beside the result of a study of displacement spectra.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::Array;
use uplift_job::outputs::{Output, OutputKind, beside};
use uplift_job::table::ColumnsOf;
use uplift_result::layout::percentile_name;
use uplift_result::{DesignRow, ResultFile, StoredDisplacements};
use uplift_study::{DisplacementStudy, ScaledTo, Structures};

use super::printed;
use crate::Table;
use crate::error::StudiesError;

/// The tables beside the result file `result`: spectra, and the design example.
fn displacement_csv_paths(result: &Path) -> [PathBuf; 2] {
    ["displacements.csv", "design.csv"].map(|ending| beside(result, ending))
}

/// All files but the result that a run of `study` with the result at `result` writes.
pub fn tables(study: &DisplacementStudy, result: &Path) -> Vec<Output> {
    let [spectra, design] = displacement_csv_paths(result);
    let spectra = Output::new(spectra, OutputKind::Table("overturned"));
    let design = study.design.is_some().then(|| Output::new(design, OutputKind::Table("quantity")));
    if study.output.csv { std::iter::once(spectra).chain(design).collect() } else { Vec::new() }
}

/// The tables of the result of `study` in `file`.
///
/// # Errors
/// A file that is damaged.
pub fn csv_tables(file: &ResultFile, study: &DisplacementStudy) -> Result<Vec<Table>, StudiesError> {
    let [spectra, designs] = displacement_csv_paths(file.path());
    let mut tables = vec![(spectra, spectra_table(study, &file.displacements()?))];
    if let Some(design) = file.design()?.filter(|design| !design.rows.is_empty()) {
        tables.push((designs, design_table(&design.rows)));
    }
    Ok(tables)
}

/// A line of a spectrum: what the structure is but for its abscissa.
fn lines(structures: &Structures) -> Vec<Vec<f64>> {
    match structures {
        Structures::Oscillators(family) => (family.uplift_displacement_m.iter())
            .flat_map(|&uplift_m| family.capacity_m.iter().map(move |&capacity_m| vec![uplift_m, capacity_m]))
            .collect(),
        Structures::Blocks(family) => family.height_m.iter().map(|&height_m| vec![height_m]).collect(),
    }
}

fn spectra_table(study: &DisplacementStudy, stored: &StoredDisplacements) -> Vec<Column> {
    let (line_names, abscissa_name): (&[&str], &str) = match study.structures {
        Structures::Oscillators(_) => (&["uplift_displacement_m", "capacity_m"], "strength"),
        Structures::Blocks(_) => (&["height_m"], "tan_alpha"),
    };
    let lines = lines(&study.structures);
    let (abscissa, percentiles) = (study.structures.abscissa(), &study.percentiles);
    let (to, by) = (&study.scaling.to, &study.scaling.by);
    let is_scaled = |place: usize| to[place] != ScaledTo::Unscaled;
    // motions that are not scaled stand there once
    let places = Array::from_fn([stored.sets.len(), to.len(), by.len(), lines.len(), abscissa.len()], |at| at);
    let rows = places.values().iter().copied().filter(|[_, to, by, ..]| is_scaled(*to) || *by == 0);
    // what rounding makes of those that a run prints; nothing is known of the others
    let repeated = printed(abscissa);
    let noisy = |[set, to, by, line, position]: [usize; 5], percentile| {
        let at = repeated.iter().position(|&at| at == position)?;
        Some(stored.rounding.as_ref()?.percentile_m[[set, to, by, line, percentile, at]])
    };
    ColumnsOf::new(rows)
        .with("record_set", |[set, ..]| stored.sets[set].name.as_str())
        .with("scaling", |[_, place, ..]| to[place].to_string())
        .with("scaled_by", |[_, place, whose, ..]| is_scaled(place).then(|| by[whose].key()))
        .each(line_names.iter().enumerate(), |columns, (of, name)| columns.with(*name, |[.., line, _]| lines[line][of]))
        .with(abscissa_name, |[.., position]| abscissa[position])
        .each(percentiles.iter().enumerate(), |columns, (percentile, percent)| {
            columns.with(percentile_name(*percent), |[set, to, by, line, position]| {
                stored.percentile_m[[set, to, by, line, percentile, position]]
            })
        })
        .with("overturned", |row| stored.overturned[row])
        .each(percentiles.iter().enumerate(), |columns, (percentile, percent)| {
            let name = percentile_name(*percent);
            let name = name.trim_end_matches("_m");
            columns
                .with(format!("{name}_rounding_lowest_m"), |row| noisy(row, percentile).map(|of| of.lowest))
                .with(format!("{name}_rounding_highest_m"), |row| noisy(row, percentile).map(|of| of.highest))
        })
        .build()
}

fn design_table(rows: &[DesignRow]) -> Vec<Column> {
    let has_rules = rows.iter().any(|row| row.rule.is_some());
    ColumnsOf::new(rows)
        .each(has_rules.then_some("rule"), |columns, name| columns.with(name, |row| row.rule.unwrap_or_default()))
        .with("record_set", |row| row.record_set.as_str())
        .with("scaling", |row| row.scaling.as_str())
        .with("scaled_by", |row| row.scaled_by.as_str())
        .with("quantity", |row| row.quantity.as_str())
        .with("value", |row| row.noisy.value)
        .with("lowest", |row| row.noisy.lowest)
        .with("highest", |row| row.noisy.highest)
        .with("rounding_lowest", |row| row.rounding.map_or(f64::NAN, |other| other.lowest))
        .with("rounding_highest", |row| row.rounding.map_or(f64::NAN, |other| other.highest))
        .build()
}
