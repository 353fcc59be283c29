//! Influence of records and intensities in the result file and in tables beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;

use crate::error::UpliftError;
use crate::influence::Influence;
use crate::result::{StoredStripes, extend_result, line, sign, write_table};
use uplift_labelled::{LabelledError, LabelledWriter};

/// The groups that a new look replaces.
const REPLACED: [&str; 4] = ["/influence", "/disaggregation", "/axes/pgv_bin", "/axes/pga_bin"];

/// How a record changes a spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordInfluence {
    /// Position of the record.
    pub record: usize,
    /// Mean of the relative change of the ordinates without it, over the strengths above uplift.
    pub mean_change: f64,
    /// The largest of these changes, by magnitude, with its sign.
    pub largest_change: f64,
    /// The strength at which it is.
    pub strength: f64,
}

/// The influence of every record on one spectrum, the most influential first; empty where no ordinate lies above uplift.
pub fn record_influence(
    stored: &StoredStripes,
    influence: &Influence,
    spectrum_m: &[f64],
    row: usize,
) -> Vec<RecordInfluence> {
    let (records, strengths) = (stored.records.len(), stored.strengths.len());
    if influence.without_m.is_empty() {
        return Vec::new();
    }
    let mut all: Vec<RecordInfluence> = (0..records)
        .filter_map(|record| {
            let start = (row * records + record) * strengths;
            let changes: Vec<(f64, f64)> = influence.without_m[start..start + strengths]
                .iter()
                .zip(spectrum_m)
                .zip(&stored.strengths)
                .filter(|((_, full), _)| full.is_finite() && **full > stored.uplift_displacement_m)
                .map(|((without, full), &strength)| ((without - full) / full, strength))
                .collect();
            let &(largest_change, strength) = changes.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
            let mean_change = changes.iter().map(|change| change.0).sum::<f64>() / changes.len() as f64;
            Some(RecordInfluence { record, mean_change, largest_change, strength })
        })
        .collect();
    all.sort_by(|a, b| b.mean_change.abs().total_cmp(&a.mean_change.abs()).then(a.record.cmp(&b.record)));
    all
}

/// The table beside the result file.
pub fn influence_path(result: &Path) -> PathBuf {
    result.with_extension("influence.csv")
}

/// Write the influence into the result file, in place of an earlier one, and into a table beside it.
///
/// # Errors
/// Whatever keeps the files from being written; the result file is then as it was.
pub fn write_influence(
    stored: &StoredStripes,
    influences: &[Influence],
    rankings: &[Vec<Vec<RecordInfluence>>],
) -> Result<(), UpliftError> {
    extend_result(stored, &REPLACED, |writer| add(writer, stored, influences))?;
    write_table(
        &influence_path(&stored.path),
        &line(stored, "spectra without each record"),
        ranking_table(stored, influences, rankings),
    )
}

fn add(writer: &mut LabelledWriter, stored: &StoredStripes, influences: &[Influence]) -> Result<(), LabelledError> {
    sign(writer, "/influence")?;
    sign(writer, "/disaggregation")?;
    for (influence, measure) in influences.iter().zip(&stored.measures) {
        let key = influence.measure.key();
        if !influence.without_m.is_empty() {
            let dims = ["site", "poe", "record", "strength"];
            let long_name = "uniform risk displacement without the record";
            writer.array_f64(&format!("/influence/{key}/u_without_m"), &dims, &influence.without_m, "m", long_name)?;
        }
        let from: Vec<f64> = std::iter::once(0.0).chain(measure.levels.iter().copied()).collect();
        let bin = format!("{key}_bin");
        let long_name =
            format!("{} from which a bin reaches up to the next, the last without end", influence.measure.label());
        writer.axis_f64(&bin, &from, influence.measure.unit(), &long_name)?;
        let dims = ["site", "poe", "strength", &bin];
        let long_name = "share of the risk at the ordinate";
        writer.array_f64(&format!("/disaggregation/{key}/share"), &dims, &influence.shares, "1", long_name)?;
    }
    Ok(())
}

fn ranking_table(
    stored: &StoredStripes,
    influences: &[Influence],
    rankings: &[Vec<Vec<RecordInfluence>>],
) -> Vec<Column> {
    let (mut site, mut im, mut poe, mut record) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut mean, mut largest, mut strength) = (Vec::new(), Vec::new(), Vec::new());
    for (influence, rankings) in influences.iter().zip(rankings) {
        for (row, ranking) in rankings.iter().enumerate() {
            for entry in ranking {
                site.push(stored.sites[row / stored.poes.len()].as_str());
                im.push(influence.measure.label());
                poe.push(stored.poes[row % stored.poes.len()]);
                record.push(stored.records[entry.record].as_str());
                mean.push(100.0 * entry.mean_change);
                largest.push(100.0 * entry.largest_change);
                strength.push(entry.strength);
            }
        }
    }
    let years = vec![stored.years; site.len()];
    vec![
        Column::new("site".into(), site),
        Column::new("im".into(), im),
        Column::new("poe".into(), poe),
        Column::new("years".into(), years),
        Column::new("record".into(), record),
        Column::new("mean_change_pct".into(), mean),
        Column::new("largest_change_pct".into(), largest),
        Column::new("at_strength".into(), strength),
    ]
}
