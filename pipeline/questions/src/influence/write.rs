//! Influence of records and intensities in the result file and in tables beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::Array;
use uplift_job::outputs::beside;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_job::text::spectrum_words;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::layout::axis;
use uplift_result::{DISAGGREGATION, DISAGGREGATION_REPAIRED, INFLUENCE, INFLUENCE_REPAIRED, LockedResult, sign};
use uplift_uniform_risk::StoredStripes;

use super::change::{CHANGES, Influence, RecordInfluence};
use crate::error::QuestionsError;

/// The groups that a new look replaces.
fn replaced(stored: &StoredStripes) -> Vec<String> {
    let bins = stored.measures.iter().map(|own| axis::path(&axis::BIN.for_measure(own.measure)));
    [INFLUENCE.root(), DISAGGREGATION.root()].map(str::to_owned).into_iter().chain(bins).collect()
}

/// The table beside the result file.
pub(super) fn influence_path(result: &Path) -> PathBuf {
    beside(result, "influence.csv")
}

/// Write the influence into the result file, in place of an earlier one, and into a table beside it.
///
/// * `rankings` — what `rank_records` says of each measure's spectra `[site, poe]`
///
/// # Errors
/// Whatever keeps the files from being written; the result file is then as it was.
pub(super) fn write_influence(
    locked: &LockedResult,
    stored: &StoredStripes,
    influences: &[Influence],
    rankings: &[Array<2, Vec<RecordInfluence>>],
) -> Result<(), QuestionsError> {
    locked.write(&replaced(stored), |writer| add(writer, stored, influences))?;
    Ok(write_table(
        &influence_path(&stored.path),
        &stored.line("spectra without each record"),
        ranking_table(stored, influences, rankings),
    )?)
}

fn add(writer: &mut LabelledWriter, stored: &StoredStripes, influences: &[Influence]) -> Result<(), LabelledError> {
    sign(writer, INFLUENCE.root())?;
    sign(writer, DISAGGREGATION.root())?;
    let left_out = if stored.units.are_records() { "record" } else { "pair of the record" };
    for found in influences {
        let Some(measure) = stored.measures.iter().find(|own| own.measure == found.measure) else { continue };
        let (influence, disaggregation) =
            if found.repaired { (INFLUENCE_REPAIRED, DISAGGREGATION_REPAIRED) } else { (INFLUENCE, DISAGGREGATION) };
        let names = [("<im>", found.measure.key()), ("<left_out>", left_out)];
        if let Some(without_m) = &found.without_m {
            influence.write_array(writer, &names, without_m.values())?;
        }
        if !found.repaired {
            let from: Vec<f64> = std::iter::once(0.0).chain(measure.levels.iter().copied()).collect();
            let names = [names[0], ("<unit>", found.measure.unit()), ("<label>", found.measure.label())];
            axis::BIN.write(writer, &names, &from)?;
        }
        disaggregation.write_array(writer, &names, found.shares.values())?;
    }
    Ok(())
}

fn ranking_table(
    stored: &StoredStripes,
    influences: &[Influence],
    rankings: &[Array<2, Vec<RecordInfluence>>],
) -> Vec<Column> {
    let rows = influences.iter().zip(rankings).flat_map(|(influence, rankings)| {
        rankings
            .blocks()
            .flat_map(move |(place, ranking)| ranking[0].iter().map(move |entry| (influence, place, entry)))
    });
    ColumnsOf::new(rows)
        .with("site", |(_, [site, _], _)| stored.sites[site].as_str())
        .with("im", |(influence, ..)| spectrum_words(influence.measure.label(), influence.repaired))
        .with("poe", |(_, [_, poe], _)| stored.poes[poe])
        .with("years", |_| stored.years)
        .with("record", |(.., entry)| stored.units.name(entry.record))
        .each(CHANGES, |columns, (name, _, value)| columns.with(name, |(.., entry)| value(entry)))
        .build()
}
