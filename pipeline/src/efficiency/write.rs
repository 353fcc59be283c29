//! Efficiency and sufficiency in the result file and in a table beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_fragility::Dispersion;
use uplift_regression::Line;

use crate::efficiency::{Covariate, Predictor};
use crate::error::UpliftError;
use crate::result::layout::{axis, efficiency, sufficiency};
use crate::result::{StoredStripes, extend_result, line, sign, write_table};
use crate::text::finite;
use uplift_labelled::{LabelledError, LabelledWriter};

/// The groups that a new look replaces.
const REPLACED: [&str; 2] = [efficiency::ROOT, sufficiency::ROOT];

/// The table beside the result file.
pub fn predictors_path(result: &Path) -> PathBuf {
    result.with_extension("measures.csv")
}

/// Write efficiency and sufficiency into the result file, in place of earlier ones, and into a table beside it.
///
/// # Errors
/// Whatever keeps the files from being written; the result file is then as it was.
pub fn write_predictors(
    stored: &StoredStripes,
    covariates: &[Covariate],
    predictors: &[Predictor],
) -> Result<(), UpliftError> {
    extend_result(stored, &REPLACED, |writer| add(writer, covariates, predictors))?;
    write_table(
        &predictors_path(&stored.path),
        &line(stored, "efficiency and sufficiency"),
        predictors_table(stored, covariates, predictors),
    )
}

fn add(writer: &mut LabelledWriter, covariates: &[Covariate], predictors: &[Predictor]) -> Result<(), LabelledError> {
    sign(writer, efficiency::ROOT)?;
    sign(writer, sufficiency::ROOT)?;
    for predictor in predictors {
        let measure = predictor.measure;
        let of = |value: fn(&Dispersion) -> f64| -> Vec<f64> { predictor.dispersions.iter().map(value).collect() };
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
        for (path, values, unit, long_name) in stripes {
            writer.array_f64(&path, &[axis::STRENGTH, &axis::level(measure)], &values, unit, long_name)?;
        }
        let of_strength = [
            (efficiency::rocking(measure), &predictor.rocking, "median dispersion of the stripes whose median rocks"),
            (
                efficiency::undefined(measure),
                &predictor.undefined,
                "share of these stripes that have none, for zeros or overturning",
            ),
            (
                efficiency::initiation(measure),
                &predictor.initiation,
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
            &predictor.initiation_records,
            "1",
            long_name,
        )?;
        for (covariate, lines) in covariates.iter().zip(&predictor.lines) {
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

fn predictors_table(stored: &StoredStripes, covariates: &[Covariate], predictors: &[Predictor]) -> Vec<Column> {
    let strengths = stored.strengths.len();
    let im: Vec<&str> =
        predictors.iter().flat_map(|predictor| std::iter::repeat_n(predictor.measure.label(), strengths)).collect();
    let strength: Vec<f64> = predictors.iter().flat_map(|_| stored.strengths.iter().copied()).collect();
    let join = |value: fn(&Predictor) -> &Vec<f64>| -> Vec<Option<f64>> {
        predictors
            .iter()
            .flat_map(|predictor| value(predictor).iter().copied().map(finite))
            .collect()
    };
    let mut columns = vec![
        Column::new("im".into(), im),
        Column::new("strength".into(), strength),
        Column::new("dispersion_rocking".into(), join(|predictor| &predictor.rocking)),
        Column::new("undefined_share".into(), join(|predictor| &predictor.undefined)),
        Column::new("dispersion_initiation".into(), join(|predictor| &predictor.initiation)),
    ];
    for (index, covariate) in covariates.iter().enumerate() {
        let of = |value: fn(&Line) -> f64| -> Vec<Option<f64>> {
            predictors
                .iter()
                .flat_map(|predictor| predictor.lines[index].iter().map(move |line| line.as_ref().map(value)))
                .collect()
        };
        columns.push(Column::new(format!("{}_slope", covariate.key).into(), of(|line| line.slope)));
        columns.push(Column::new(format!("{}_p_value", covariate.key).into(), of(|line| line.p_value)));
    }
    columns
}
