//! Efficiency and sufficiency in the result file and in a table beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_fragility::Dispersion;
use uplift_job::outputs::beside;
use uplift_job::table::write_table;
use uplift_job::text::finite;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_regression::Line;
use uplift_result::layout::{axis, efficiency, sufficiency};
use uplift_result::{Addition, StoredEfficiency, sign};
use uplift_uniform_risk::StoredStripes;

use super::of_measure::{Covariate, MeasureEfficiency};
use super::report::rank;
use crate::error::QuestionsError;

/// The groups that a new look replaces, with the axes of the measures that were told of others' runs.
fn replaced(earlier: &[StoredEfficiency]) -> Vec<String> {
    let told = earlier.iter().filter(|of| of.scaled_to != of.measure);
    let axes = told.map(|of| axis::path(&axis::common_level(of.measure)));
    [efficiency::ROOT, sufficiency::ROOT].map(str::to_owned).into_iter().chain(axes).collect()
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
    addition: &Addition,
    (stored, earlier): (&StoredStripes, &[StoredEfficiency]),
    covariates: &[Covariate],
    measures: &[MeasureEfficiency],
) -> Result<(), QuestionsError> {
    addition.write(&replaced(earlier), |writer| add(writer, covariates, measures))?;
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
    sign(writer, efficiency::ROOT)?;
    sign(writer, sufficiency::ROOT)?;
    for found in measures {
        let measure = found.measure;
        let of = |value: fn(&Dispersion) -> f64| -> Vec<f64> { found.dispersions.iter().map(value).collect() };
        let stripes: [(String, Vec<f64>, &str, &str); 5] = [
            (efficiency::median_m(measure), of(|scatter| scatter.median_m), "m", "median demand"),
            (
                efficiency::dispersion(measure),
                of(|scatter| scatter.by_percentiles),
                "1",
                "half the logarithm of the 84th over the 16th percentile",
            ),
            (
                efficiency::ln_deviation(measure),
                of(|scatter| scatter.of_logarithm),
                "1",
                "standard deviation of the logarithm of the demand",
            ),
            (efficiency::zeros(measure), of(|scatter| scatter.zeros as f64), "1", "demands of zero"),
            (efficiency::overturned(measure), of(|scatter| scatter.overturned as f64), "1", "overturned runs"),
        ];
        let levels = if found.scaled_to == measure { axis::level(measure) } else { axis::common_level(measure) };
        if found.scaled_to != measure {
            let long_name = format!("level of {} that every record is brought to", measure.long_name());
            writer.axis_f64(&levels, &found.levels, measure.unit(), &long_name)?;
        }
        for (path, values, unit, long_name) in stripes {
            writer.array_f64(&path, &[axis::STRENGTH, &levels], &values, unit, long_name)?;
        }
        writer.attribute(&efficiency::group(measure), "scaled_to", found.scaled_to.key())?;
        let of_strength = [
            (
                efficiency::reaching(measure),
                &found.reaching,
                "deviation of the logarithm of the level at which a displacement is reached, median over displacements",
            ),
            (efficiency::rocking(measure), &found.rocking, "median dispersion of the stripes whose median rocks"),
            (
                efficiency::undefined(measure),
                &found.undefined,
                "share of these stripes that have none, for zeros or overturning",
            ),
            (
                efficiency::initiation(measure),
                &found.initiation,
                "deviation of the logarithm of the level at first uplift",
            ),
        ];
        for (path, values, long_name) in of_strength {
            writer.array_f64(&path, &[axis::STRENGTH], values, "1", long_name)?;
        }
        let long_name = "records whose level at first uplift is known";
        writer.array_u32(
            &efficiency::initiation_records(measure),
            &[axis::STRENGTH],
            &found.initiation_records,
            "1",
            long_name,
        )?;
        for (covariate, lines) in covariates.iter().zip(&found.lines) {
            let of = |value: fn(&Line) -> f64| -> Vec<f64> {
                lines.iter().map(|line| line.as_ref().map_or(f64::NAN, value)).collect()
            };
            for (name, values, long_name) in [
                ("slope", of(|line| line.slope), "change of the mean logarithmic residual with it"),
                ("slope_error", of(|line| line.slope_error), "standard error of the slope"),
                ("p_value", of(|line| line.p_value), "probability of such a slope if there were none"),
                ("r_squared", of(|line| line.r_squared), "share of the variance explained"),
            ] {
                let long_name = format!("{}: {long_name}", covariate.long_name);
                let path = sufficiency::array(measure, covariate.key, name);
                writer.array_f64(&path, &[axis::STRENGTH], &values, "1", &long_name)?;
            }
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
