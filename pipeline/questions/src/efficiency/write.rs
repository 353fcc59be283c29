//! Efficiency and sufficiency in the result file and in a table beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::outputs::beside;
use uplift_job::table::write_table;
use uplift_job::text::finite;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_regression::Line;
use uplift_result::layout::axis;
use uplift_result::{EFFICIENCY, EFFICIENCY_OF_STRIPES, LockedResult, REACHING, StoredEfficiency, TRENDS, sign};
use uplift_uniform_risk::StoredStripes;

use super::of_measure::{Covariate, MeasureEfficiency};
use super::report::rank;
use crate::error::QuestionsError;

/// The groups that a new look replaces, with the axes of the measures that were told of others' runs.
fn replaced(earlier: &[StoredEfficiency]) -> Vec<String> {
    let told = earlier.iter().filter(|of| of.scaled_to != of.measure);
    let axes = told.map(|of| axis::path(&axis::common_level(of.measure)));
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
        let measure = found.measure;
        let levels = if found.scaled_to == measure { axis::level(measure) } else { axis::common_level(measure) };
        if found.scaled_to != measure {
            let long_name = format!("level of {} that every record is brought to", measure.long_name());
            writer.axis_f64(&levels, &found.levels, measure.unit(), &long_name)?;
        }
        let stored = found.stored(covariates);
        let names = [("<im>", measure.key()), ("<levels>", &levels)];
        let lengths = [(axis::STRENGTH, stored.rocking.len()), (&levels, found.levels.len())];
        EFFICIENCY_OF_STRIPES.write(writer, &names, &lengths, &found.dispersions)?;
        writer.attribute(&EFFICIENCY.of_measure(measure), "scaled_to", found.scaled_to.key())?;
        REACHING.write(writer, &names, &lengths, &stored)?;
        EFFICIENCY.write(writer, &names, &lengths, &stored)?;
        for (covariate, trend) in covariates.iter().zip(&stored.trends) {
            let names = [names[0], ("<covariate>", covariate.key), ("<with>", covariate.long_name)];
            TRENDS.write(writer, &names, &lengths, trend)?;
        }
    }
    Ok(())
}

fn efficiency_table(stored: &StoredStripes, covariates: &[Covariate], measures: &[MeasureEfficiency]) -> Vec<Column> {
    let strengths = stored.strengths.len();
    let im: Vec<&str> =
        measures.iter().flat_map(|efficiency| std::iter::repeat_n(efficiency.measure.label(), strengths)).collect();
    let scaled_to: Vec<&str> =
        measures.iter().flat_map(|efficiency| std::iter::repeat_n(efficiency.scaled_to.label(), strengths)).collect();
    let strength: Vec<f64> = measures.iter().flat_map(|_| stored.strengths.iter().copied()).collect();
    let rank: Vec<Option<u32>> =
        measures.iter().flat_map(|of| (0..strengths).map(move |index| rank(measures, of, index))).collect();
    let join = |value: fn(&MeasureEfficiency) -> &Vec<f64>| -> Vec<Option<f64>> {
        measures.iter().flat_map(|efficiency| value(efficiency).iter().copied().map(finite)).collect()
    };
    let mut columns = vec![
        Column::new("im".into(), im),
        Column::new("scaled_to".into(), scaled_to),
        Column::new("strength".into(), strength),
        Column::new("dispersion_level".into(), join(|efficiency| &efficiency.reaching)),
        Column::new("rank".into(), rank),
        Column::new("dispersion_rocking".into(), join(|efficiency| &efficiency.rocking)),
        Column::new("undefined_share".into(), join(|efficiency| &efficiency.undefined)),
        Column::new("dispersion_initiation".into(), join(|efficiency| &efficiency.initiation)),
    ];
    for (index, covariate) in covariates.iter().enumerate() {
        let of = |value: fn(&Line) -> f64| -> Vec<Option<f64>> {
            measures
                .iter()
                .flat_map(|efficiency| efficiency.lines[index].iter().map(move |line| line.as_ref().map(value)))
                .collect()
        };
        columns.push(Column::new(format!("{}_slope", covariate.key).into(), of(|line| line.slope)));
        columns.push(Column::new(format!("{}_p_value", covariate.key).into(), of(|line| line.p_value)));
    }
    columns
}
