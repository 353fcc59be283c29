//! A file with a hazard curve, read as a study uses it: its unit, its kind, its definition of the measure.

use std::path::{Path, PathBuf};

use uplift_hazard::{CsvCurve, CsvOptions, HazardCurve, SecondColumn, read_path};
use uplift_motion::{Combination, IntensityMeasure};
use uplift_risk::StripeWeights;
use uplift_study::{CurveFile, CurveKind, MeasurePlan, UniformRiskStudy, definition_of, levels_key};

use super::other_unit::{file_of, with_remedy};

/// Whether the files of PGV and PGA of a `site` each cover the levels of the other; none where there are not both.
pub(super) fn are_interchanged(
    study: &UniformRiskStudy,
    site: &str,
    file: &CurveFile,
    plan: &MeasurePlan,
) -> Option<bool> {
    let other = match plan.measure {
        IntensityMeasure::Pgv => IntensityMeasure::Pga,
        IntensityMeasure::Pga => IntensityMeasure::Pgv,
        _ => return None,
    };
    let other_file = file_of(study, site, other)?;
    let other_plan = study.measures.iter().find(|plan| plan.measure == other)?;
    let covers = |path: Option<&PathBuf>, file: &CurveFile, plan: &MeasurePlan| {
        let curve = curve_of(study, (site, file), path?)?;
        Some(curve.first().im <= *plan.levels.first()? && *plan.levels.last()? <= curve.last().im)
    };
    let this_covers_others = covers(file.file.as_ref(), other_file, other_plan)?;
    Some(this_covers_others && covers(other_file.file.as_ref(), file, plan)?)
}

/// What is at `path`, which the study says as the `file` of a `site`: in field units, for the records' definition of
/// the measure; and whether its own definition is known, without which it stays as it is.
pub(super) fn read_converted(
    study: &UniformRiskStudy,
    (site, file): (&str, &CurveFile),
    path: &Path,
) -> Result<(CsvCurve, bool), String> {
    let read = read_path(path, &csv_options(file, path)).map_err(|error| with_remedy(&error, study, site, file))?;
    let curve = read.curve.in_field_units(study.gravity_m_s2).map_err(|error| error.to_string())?;
    let converted = by_the_records_definition(study, file.measure, &curve)
        .map_err(|reason| format!("{}: {reason}", path.display()))?;
    let is_defined = converted.is_some();
    Ok((CsvCurve { curve: converted.unwrap_or(curve), ..read }, is_defined))
}

/// The curve at `path`, as a study uses it; none where something is wrong with it.
pub(super) fn curve_of(study: &UniformRiskStudy, of: (&str, &CurveFile), path: &Path) -> Option<HazardCurve> {
    Some(read_converted(study, of, path).ok()?.0.curve)
}

/// How the numbers at `path` are read, which a study says as `file`.
fn csv_options(file: &CurveFile, path: &Path) -> CsvOptions {
    let mut options = CsvOptions::new(file.measure.label(), file.unit_of(path).symbol());
    match file.kind {
        CurveKind::Maf => options.second_column = Some(SecondColumn::AnnualRate),
        CurveKind::Poe { years } => {
            options.second_column = Some(SecondColumn::Probability);
            options.years = Some(years);
        }
    }
    options
}

/// The curve for the definition of the measure that the records are combined by; none where the definition of the curve
/// is not known.
pub(super) fn by_the_records_definition(
    study: &UniformRiskStudy,
    measure: IntensityMeasure,
    curve: &HazardCurve,
) -> Result<Option<HazardCurve>, String> {
    let wanted = definition_of(study.records.intensity);
    let Some(own) = curve.component().or(study.hazard.component) else {
        // what was written before there were such words is taken for the geometric mean, and for nothing else
        if study.records.intensity == Combination::GeometricMean {
            return Ok(None);
        }
        return Err(format!(
            "the curve does not say how the horizontal components are combined, and the records use {wanted}. If \
             the curve does too, write [hazard] component = \"{}\"",
            wanted.key()
        ));
    };
    if own == wanted {
        return Ok(Some(curve.clone()));
    }
    let Some(factor) = study.hazard.factor(own, wanted, measure) else {
        let key = measure.key();
        let (from, to) = (own.key(), wanted.key());
        return Err(format!(
            "the curve gives {own}, the records {wanted}. Use a curve of {wanted}, set records.intensity, or convert \
             the levels with the ratio of the two: [hazard] conversions = [{{ from = \"{from}\", to = \"{to}\", \
             {key} = … }}] (docs/hazard.md)"
        ));
    };
    curve.converted(factor, wanted).map(Some).map_err(|error| error.to_string())
}

/// What each stripe of the study weighs at a site of this hazard.
pub(super) fn stripe_weights(
    study: &UniformRiskStudy,
    plan: &MeasurePlan,
    curve: &HazardCurve,
) -> Result<StripeWeights, String> {
    StripeWeights::from_hazard(curve, &plan.levels, study.risk.extrapolate)
        .map_err(|error| format!("{error}; or leave the level out of {}", levels_key(plan.measure)))
}
