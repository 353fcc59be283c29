//! The hazard curves of a study's sites, with the weights of the stripes that follow from them.

use std::path::PathBuf;

use uplift_hazard::{CsvOptions, Extrapolation, HazardCurve, SecondColumn, read_path};
use uplift_motion::IntensityMeasure;
use uplift_risk::StripeWeights;

use super::checksum;
use crate::error::UpliftError;
use crate::study::{CurveFile, CurveKind, Extrapolate, MeasurePlan, ResolvedStudy};

/// The hazard of one site in one measure.
#[derive(Debug, Clone)]
pub struct SiteHazard {
    /// Name of the site.
    pub site: String,
    /// The measure.
    pub measure: IntensityMeasure,
    /// Where the curve was read.
    pub file: PathBuf,
    /// SHA-256 of the file.
    pub checksum: String,
    /// The curve in field units, cm/s or g.
    pub curve: HazardCurve,
    /// What each stripe weighs in the risk integral (Eq. 4.4).
    pub weights: StripeWeights,
}

/// Read the curves of every site and measure, `[measure][site]`, and notes about what was dropped from them.
///
/// # Errors
/// Everything that is wrong with them, at once.
pub fn read_hazard(study: &ResolvedStudy) -> Result<(Vec<Vec<SiteHazard>>, Vec<String>), UpliftError> {
    let mut mistakes = Vec::new();
    let mut notes = Vec::new();
    let mut all = Vec::new();
    for plan in &study.measures {
        let mut sites = Vec::new();
        for site in &study.sites {
            let Some(file) = site.curve(plan.measure) else { continue };
            match read_one(&site.name, file, plan, study, &mut notes) {
                Ok(hazard) => sites.push(hazard),
                Err(reason) => mistakes.push(format!("site {}, {}: {reason}", site.name, plan.measure.label())),
            }
        }
        all.push(sites);
    }
    if mistakes.is_empty() { Ok((all, notes)) } else { Err(UpliftError::Inputs(mistakes)) }
}

fn read_one(
    site: &str,
    file: &CurveFile,
    plan: &MeasurePlan,
    study: &ResolvedStudy,
    notes: &mut Vec<String>,
) -> Result<SiteHazard, String> {
    let mut options = CsvOptions::new(plan.measure.label(), file.unit.symbol());
    match file.kind {
        CurveKind::Maf => options.second_column = Some(SecondColumn::AnnualRate),
        CurveKind::Poe { years } => {
            options.second_column = Some(SecondColumn::Probability);
            options.years = Some(years);
        }
    }
    let read = read_path(&file.file, &options).map_err(|error| error.to_string())?;
    for (count, what) in
        [(read.dropped_zeros, "zeros at the end"), (read.dropped_certain, "probabilities of 1 at the start")]
    {
        if count > 0 {
            notes.push(format!(
                "site {site}, {}: {count} {what} of the hazard curve carry no rate and were dropped",
                plan.measure.label()
            ));
        }
    }
    let curve = read.curve.in_field_units(study.gravity_m_s2).map_err(|error| error.to_string())?;
    let extrapolation = match study.risk.extrapolate {
        Extrapolate::Refuse => Extrapolation::Refuse,
        Extrapolate::Loglog => Extrapolation::LogLog,
    };
    let weights = StripeWeights::from_hazard(&curve, &plan.levels, extrapolation).map_err(|error| {
        format!("{}: {error}; or leave the level out of [{}]", file.file.display(), plan.measure.key())
    })?;
    let bytes = std::fs::read(&file.file).map_err(|error| format!("{}: {error}", file.file.display()))?;
    Ok(SiteHazard {
        site: site.to_owned(),
        measure: plan.measure,
        file: file.file.clone(),
        checksum: checksum(&bytes),
        curve,
        weights,
    })
}
