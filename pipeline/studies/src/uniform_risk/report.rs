//! The report of a run of a study of uniform risk.

use std::path::PathBuf;

use serde::Serialize;
use uplift_job::study_run::RunHead;
use uplift_result::{Fit, ResultFile, SiteRanges, Spectrum, SpreadOver, StoredSpread};
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::consistency::{Answer, ConsistencyReport};
use uplift_uniform_risk::{
    DisplacementOptions, DisplacementReport, Precision, StoredStripes, Stripes, displacements, precision,
};

use super::site_table::SHOWN_ON_MAP;
use crate::error::StudiesError;

/// The report of a run.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// What every kind reports.
    #[serde(flatten)]
    pub head: RunHead,
    /// The analysis of each measure.
    pub measures: Vec<MeasureReport>,
    /// The fits of Eq. 4.11 (Table 4.2), one a measure, site and probability.
    pub coefficients: Vec<CoefficientsReport>,
    /// Whether the records are enough, by each measure.
    pub precision: Vec<Precision>,
    /// Whether the records bring the hazard of the other measure.
    pub consistency: ConsistencyReport,
    /// Displacements with their confidence bands, of the smallest probability by the first measure; none without sites.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub displacements: Option<DisplacementReport>,
    /// The same of the repaired spectra, where the study asks for them.
    #[serde(skip)]
    pub repaired: Option<DisplacementReport>,
    /// Between which displacements the sites of its table lie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub site_table: Option<SiteRanges>,
    /// Their spread over weighted hazard curves, for the sites that have some.
    #[serde(skip)]
    pub branches: Vec<BranchReport>,
    /// Their spread over the possible structures, where all records shake the same ones.
    #[serde(rename = "structure_spread", skip_serializing_if = "Vec::is_empty")]
    pub structures: Vec<BranchReport>,
}

/// The analysis by one measure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureReport {
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Those of them that were not known from before.
    pub analyses_computed: u64,
    /// Wall time for these, s.
    pub seconds: f64,
    /// How fast they were.
    pub analyses_per_second: u64,
}

/// The fit of one spectrum.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoefficientsReport {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// The probability of exceedance.
    pub poe: f64,
    /// Its coefficients.
    #[serde(flatten)]
    pub fit: Fit,
    /// Whether c2 is held at 0; none where there is no fit.
    pub bound_active: Option<bool>,
}

/// The spread of one spectrum over weighted hazard curves or possible structures, over the strengths, m.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchReport {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// The probability of exceedance.
    #[serde(rename = "poe")]
    pub probability: f64,
    /// 5 % fractile.
    #[serde(rename = "u05_m")]
    pub low_m: Vec<f64>,
    /// Weighted mean.
    pub mean_m: Vec<f64>,
    /// 95 % fractile.
    #[serde(rename = "u95_m")]
    pub high_m: Vec<f64>,
}

impl RunReport {
    /// The report on the result in `file`, with a `head` and the analyses by each of its `measures`.
    ///
    /// - `known`: consistency and precision of a run that has just computed them; read off the file else.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn read(
        file: &ResultFile,
        head: RunHead,
        measures: Vec<MeasureReport>,
        known: Option<(&Answer, &[Precision])>,
    ) -> Result<Self, StudiesError> {
        let (study, spectra) = (file.stored_study()?, file.spectra()?);
        let shown = |repaired: bool| -> Result<Option<DisplacementReport>, StudiesError> {
            let asked = DisplacementOptions { repaired, ..DisplacementOptions::default() };
            let is_there = !study.sites.is_empty() && (!repaired || file.has_repair());
            Ok(is_there.then(|| displacements(file, &asked)).transpose()?)
        };
        let spreads = if study.sites.is_empty() { Vec::new() } else { file.spreads()? };
        let spread_over = |over: SpreadOver| {
            let of_kind = spreads.iter().filter(|own| own.over == over);
            of_kind.flat_map(|own| (0..study.risk.poe.len()).map(|poe| BranchReport::new(&study, own, poe))).collect()
        };
        let plain_m: Vec<_> = spectra.measures.iter().map(|own| (own.measure, own.u_m.clone())).collect();
        let (answer, precision) = match known {
            Some((answer, precision)) => (answer.clone(), precision.to_vec()),
            None => recomputed(file, &study)?,
        };
        let (displacements, repaired) = (shown(false)?, shown(true)?);
        let digest = file.head()?.study_digest();
        let of_table = |path: &PathBuf| SiteRanges::read(path, &digest, &SHOWN_ON_MAP);
        let is_listed = study.site_table.is_some();
        let site_table = head.files.first().filter(|_| is_listed).map(of_table).transpose()?.flatten();
        Ok(Self {
            head,
            measures,
            coefficients: spectra.rows().map(|own| CoefficientsReport::new(&own)).collect(),
            precision,
            consistency: answer.report(&plain_m),
            displacements,
            repaired,
            site_table,
            branches: spread_over(SpreadOver::HazardCurves),
            structures: spread_over(SpreadOver::Structures),
        })
    }
}

/// Consistency and precision of a result, as its run had them.
fn recomputed(file: &ResultFile, study: &UniformRiskStudy) -> Result<(Answer, Vec<Precision>), StudiesError> {
    if study.sites.is_empty() {
        return Ok((Answer::from_result(file, None)?, Vec::new()));
    }
    let stored = StoredStripes::read(file)?;
    let answer = Answer::from_result(file, Some(&stored))?;
    let mut precisions = Vec::new();
    for of in &stored.measures {
        let weights: Vec<_> = of.weights.iter().collect();
        let demand = |strength| of.demand(strength);
        precisions.extend(precision(study, of.measure, demand, &weights, answer.question())?);
    }
    Ok((answer, precisions))
}

impl CoefficientsReport {
    fn new(spectrum: &Spectrum<'_>) -> Self {
        let fit = spectrum.fit;
        Self {
            site: spectrum.site.to_owned(),
            im: spectrum.measure.label(),
            poe: spectrum.poe,
            fit,
            bound_active: fit.curve().map(|_| fit.bound_active),
        }
    }
}

impl BranchReport {
    fn new(study: &UniformRiskStudy, spread: &StoredSpread, poe: usize) -> Self {
        let [mean, low, .., high] = spread.limits_m(poe);
        Self {
            site: study.sites[spread.site].name.clone(),
            im: spread.measure.label(),
            probability: study.risk.poe[poe],
            low_m: low.to_vec(),
            mean_m: mean.to_vec(),
            high_m: high.to_vec(),
        }
    }
}

impl MeasureReport {
    /// Analyses by a measure that were all known from before.
    pub fn stored(im: &'static str, analyses: u64) -> Self {
        Self { im, analyses, analyses_computed: 0, seconds: 0.0, analyses_per_second: 0 }
    }

    pub(super) fn new(stripes: &Stripes) -> Self {
        Self {
            im: stripes.measure.label(),
            analyses: stripes.analyses,
            analyses_computed: stripes.computed,
            seconds: stripes.seconds,
            analyses_per_second: uplift_engine::analysis::rate(stripes.computed, stripes.seconds),
        }
    }
}
