//! Influence of records and intensities in the result file and in tables beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;

use super::change::{Influence, RecordInfluence};
use crate::error::UpliftError;
use crate::result::{StoredStripes, extend_result, line, sign, write_table};
use uplift_labelled::{LabelledError, LabelledWriter};

/// The groups that a new look replaces.
const REPLACED: [&str; 4] = ["/influence", "/disaggregation", "/axes/pgv_bin", "/axes/pga_bin"];

/// The table beside the result file.
pub(super) fn influence_path(result: &Path) -> PathBuf {
    result.with_extension("influence.csv")
}

/// Write the influence into the result file, in place of an earlier one, and into a table beside it.
///
/// # Errors
/// Whatever keeps the files from being written; the result file is then as it was.
pub(super) fn write_influence(
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
