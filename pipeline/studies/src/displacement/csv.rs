//! Tidy tables beside the result of a study of displacement spectra.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::outputs::{Output, OutputKind, beside};
use uplift_job::table::{ColumnsOf, write_table};
use uplift_result::DesignRow;
use uplift_result::layout::percentile_name;
use uplift_study::{DisplacementStudy, ScaledTo, Structures};

use super::{DisplacementOutcome, printed};
use crate::error::StudiesError;

/// The tables beside the result file `result`: spectra, and the design example.
pub fn displacement_csv_paths(result: &Path) -> [PathBuf; 2] {
    ["displacements.csv", "design.csv"].map(|ending| beside(result, ending))
}

/// All files but the result that a run of `study` with the result at `result` writes.
pub fn tables(study: &DisplacementStudy, result: &Path) -> Vec<Output> {
    let [spectra, design] = displacement_csv_paths(result);
    let spectra = Output::new(spectra, OutputKind::Table("overturned"));
    let design = study.design.is_some().then(|| Output::new(design, OutputKind::Table("quantity")));
    if study.output.csv { std::iter::once(spectra).chain(design).collect() } else { Vec::new() }
}

/// Write the tables of `outcome` and its `design` beside the result file `result`, and beside each where it comes from;
/// the tables.
///
/// # Errors
/// A file that cannot be written.
pub fn write_displacement_csv(
    result: &Path,
    outcome: &DisplacementOutcome<'_>,
    design: &[DesignRow],
) -> Result<Vec<PathBuf>, StudiesError> {
    let line = outcome.provenance.line(&outcome.study.title, &outcome.records.description);
    let [spectra, designs] = displacement_csv_paths(result);
    write_table(&spectra, &line, spectra_table(outcome))?;
    if design.is_empty() {
        return Ok(vec![spectra]);
    }
    write_table(&designs, &line, design_table(design))?;
    Ok(vec![spectra, designs])
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

fn spectra_table(outcome: &DisplacementOutcome<'_>) -> Vec<Column> {
    let study = outcome.study;
    let (line_names, abscissa_name): (&[&str], &str) = match study.structures {
        Structures::Oscillators(_) => (&["uplift_displacement_m", "capacity_m"], "strength"),
        Structures::Blocks(_) => (&["height_m"], "tan_alpha"),
    };
    let lines = lines(&study.structures);
    let (abscissa, percentiles) = (study.structures.abscissa(), &study.percentiles);
    let (mut record_set, mut scaling, mut scaled_by) = (Vec::new(), Vec::new(), Vec::new());
    let mut of_line: Vec<Vec<f64>> = vec![Vec::new(); line_names.len()];
    let (mut at, mut overturned) = (Vec::new(), Vec::new());
    let mut u_m: Vec<Vec<f64>> = vec![Vec::new(); percentiles.len()];
    // what rounding makes of those that a run prints; nothing is known of the others
    let repeated = printed(abscissa);
    let mut rounding: Vec<[Vec<Option<f64>>; 2]> = vec![[Vec::new(), Vec::new()]; percentiles.len()];
    for ((set, spectra), moved) in outcome.sets.iter().zip(outcome.spectra).zip(outcome.rounding) {
        for (to, target) in study.scaling.to.iter().enumerate() {
            for (by, whose) in study.scaling.by.iter().enumerate() {
                // motions that are not scaled stand there once
                let unscaled = *target == ScaledTo::Unscaled;
                if unscaled && by > 0 {
                    continue;
                }
                for (line, numbers) in lines.iter().enumerate() {
                    let row = (to * study.scaling.by.len() + by) * lines.len() + line;
                    for (position, &x) in abscissa.iter().enumerate() {
                        record_set.push(set.name());
                        scaling.push(target.to_string());
                        scaled_by.push((!unscaled).then(|| whose.key()));
                        for (column, number) in of_line.iter_mut().zip(numbers) {
                            column.push(*number);
                        }
                        at.push(x);
                        for (percentile, column) in u_m.iter_mut().enumerate() {
                            let place = (row * percentiles.len() + percentile) * abscissa.len() + position;
                            column.push(spectra.percentile_m[place]);
                            let ordinate = repeated
                                .iter()
                                .position(|&at| at == position)
                                .map(|at| moved[(row * percentiles.len() + percentile) * repeated.len() + at]);
                            let [lowest, highest] = &mut rounding[percentile];
                            lowest.push(ordinate.map(|noisy| noisy.lowest));
                            highest.push(ordinate.map(|noisy| noisy.highest));
                        }
                        overturned.push(spectra.overturned[row * abscissa.len() + position]);
                    }
                }
            }
        }
    }
    let mut columns = vec![
        Column::new("record_set".into(), record_set),
        Column::new("scaling".into(), scaling),
        Column::new("scaled_by".into(), scaled_by),
    ];
    columns.extend(line_names.iter().zip(of_line).map(|(name, values)| Column::new((*name).into(), values)));
    columns.push(Column::new(abscissa_name.into(), at));
    columns.extend(
        percentiles.iter().zip(u_m).map(|(percent, values)| Column::new(percentile_name(*percent).into(), values)),
    );
    columns.push(Column::new("overturned".into(), overturned));
    for (percent, ends) in percentiles.iter().zip(rounding) {
        let name = percentile_name(*percent);
        let name = name.trim_end_matches("_m");
        for (end, values) in ["lowest", "highest"].into_iter().zip(ends) {
            columns.push(Column::new(format!("{name}_rounding_{end}_m").into(), values));
        }
    }
    columns
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
