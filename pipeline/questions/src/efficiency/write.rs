//! Efficiency and sufficiency in the result file and in a table beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::outputs::beside;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_job::text::finite;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::declared::Quantity;
use uplift_result::layout::attribute::efficiency::SCALED_TO;
use uplift_result::layout::axis;
use uplift_result::{EFFICIENCY, EFFICIENCY_OF_STRIPES, LockedResult, StoredEfficiency, TRENDS, sign};
use uplift_uniform_risk::StoredStripes;

use super::measure_efficiency::{Covariate, MeasureEfficiency, rank};
use crate::error::QuestionsError;

/// The groups that a new look replaces, with the axes of the measures that were computed from the runs of others.
fn replaced(earlier: &[StoredEfficiency]) -> Vec<String> {
    let told = earlier.iter().filter(|of| of.scaled_to != of.measure);
    let axes = told.map(|of| axis::path(&axis::COMMON_LEVEL.for_measure(of.measure)));
    [EFFICIENCY.root(), TRENDS.root()].map(str::to_owned).into_iter().chain(axes).collect()
}

/// The table beside the result file.
pub(super) fn efficiency_path(result: &Path) -> PathBuf {
    beside(result, "measures.csv")
}

/// Write efficiency and sufficiency into the result file, in place of the `earlier` ones, and into a table beside it.
///
/// # Errors
/// Whatever keeps the files from being written; the result file is then as it was.
pub(super) fn write_efficiency(
    locked: &LockedResult,
    (stored, earlier): (&StoredStripes, &[StoredEfficiency]),
    covariates: &[Covariate],
    measures: &[MeasureEfficiency],
) -> Result<(), QuestionsError> {
    locked.write(&replaced(earlier), |writer| add(writer, covariates, measures))?;
    Ok(write_table(
        &efficiency_path(&stored.path),
        &stored.line("efficiency and sufficiency"),
        efficiency_table(stored, covariates, measures),
    )?)
}

fn add(
    writer: &mut LabelledWriter,
    covariates: &[Covariate],
    measures: &[MeasureEfficiency],
) -> Result<(), LabelledError> {
    sign(writer, EFFICIENCY.root())?;
    sign(writer, TRENDS.root())?;
    for found in measures {
        let MeasureEfficiency { own, .. } = found;
        let measure = own.measure;
        let axis = if own.scaled_to == measure { axis::STRIPE_LEVEL } else { axis::COMMON_LEVEL };
        let levels = axis.for_measure(measure);
        if own.scaled_to != measure {
            let names = [("<im>", measure.key()), ("<unit>", measure.unit()), ("<measure>", measure.long_name())];
            axis.write(writer, &names, &found.levels)?;
        }
        let names = [("<im>", measure.key()), ("<levels>", &levels)];
        let lengths = [(axis::STRENGTH.name, own.rocking.len()), (&levels, found.levels.len())];
        EFFICIENCY_OF_STRIPES.write(writer, &names, &lengths, &found.dispersions)?;
        SCALED_TO.write(writer, &names, own.scaled_to.key())?;
        EFFICIENCY.write(writer, &names, &lengths, own)?;
        for (covariate, trend) in covariates.iter().zip(&own.trends) {
            let names = [names[0], ("<covariate>", covariate.key), ("<with>", covariate.long_name)];
            TRENDS.write(writer, &names, &lengths, trend)?;
        }
    }
    Ok(())
}

/// A measure, and a strength with its place.
type Row<'a> = (&'a MeasureEfficiency, (usize, &'a f64));

fn efficiency_table(stored: &StoredStripes, covariates: &[Covariate], measures: &[MeasureEfficiency]) -> Vec<Column> {
    let rows = measures.iter().flat_map(|of| stored.strengths.iter().enumerate().map(move |at| (of, at)));
    let with_figure = |columns: ColumnsOf<_>, figure: &'static Quantity<StoredEfficiency>| {
        columns.with(figure.exported_name(), move |(of, (at, _)): Row<'_>| figure.number(&of.own, at).and_then(finite))
    };
    let mut figures = EFFICIENCY.exported();
    let columns = ColumnsOf::new(rows)
        .with("im", |(of, _)| of.own.measure.label())
        .with("scaled_to", |(of, _)| of.own.scaled_to.label())
        .with("strength", |(_, (_, &strength))| strength)
        .each(figures.next(), with_figure)
        .with("rank", |(of, (at, _))| rank(measures, &of.own, at))
        .each(figures, with_figure);
    let trends = covariates.iter().enumerate().flat_map(|own| TRENDS.exported().map(move |trend| (own, trend)));
    let with_trend = |columns: ColumnsOf<_>,
                      ((index, covariate), trend): ((usize, &Covariate), &'static Quantity<_>)| {
        let name = format!("{}_{}", covariate.key, trend.exported_name());
        columns.with(name, move |(of, (at, _)): Row<'_>| trend.number(&of.own.trends[index], at).and_then(finite))
    };
    columns.each(trends, with_trend).build()
}
