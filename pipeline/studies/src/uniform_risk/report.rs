//! What a run of a study of uniform risk tells.

use std::path::PathBuf;

use serde::Serialize;
use uplift_job::Array;
use uplift_job::alarm::Alarm;
use uplift_job::frame::RunHead;
use uplift_motion::IntensityMeasure;
use uplift_uniform_risk::consistency::ConsistencyReport;
use uplift_uniform_risk::{BranchSpectra, Coefficients, Precision, Spectra, SpectrumReport, Stripes};

use super::Outcome;

/// What a run tells.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// What every kind tells.
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
    /// The spectra of weights by which they do, where the study asks for them.
    #[serde(skip)]
    pub repaired: Vec<SpectrumReport>,
    /// Strengths of the spectra.
    #[serde(skip)]
    pub strengths: Vec<f64>,
    /// Probabilities of exceedance.
    #[serde(skip)]
    pub poes: Vec<f64>,
    /// Years that they refer to.
    #[serde(skip)]
    pub years: f64,
    /// The spectra, one a measure, site and probability.
    #[serde(skip)]
    pub spectra: Vec<SpectrumReport>,
    /// Their spread over weighted hazard curves, for the sites that have some.
    #[serde(skip)]
    pub branches: Vec<BranchReport>,
    /// Their spread over the structures that may be, where all records shake the same ones.
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

/// One fit; the numbers are none where there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the symbols of Eq. 4.11")]
pub struct CoefficientsReport {
    pub site: String,
    pub im: &'static str,
    pub poe: f64,
    pub c0: Option<f64>,
    pub c1: Option<f64>,
    pub c2: Option<f64>,
    pub rmse: Option<f64>,
    pub bound_active: Option<bool>,
}

/// The spread of one spectrum over weighted hazard curves or structures that may be, over the strengths, m.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchReport {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Position of the probability.
    #[serde(skip)]
    pub poe: usize,
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
    /// The report on what was computed and written.
    pub(super) fn from_outcome(outcome: &Outcome<'_>, alarms: Vec<Alarm>, files: Vec<PathBuf>, seconds: f64) -> Self {
        let study = outcome.study;
        let fits = |coefficients: &Coefficients| -> Vec<CoefficientsReport> {
            let im = coefficients.measure.label();
            let report = |([site, poe], fit): ([usize; 2], &[Result<uplift_regression::ExponentialFit, _>])| {
                let fit = fit[0].as_ref().ok();
                CoefficientsReport {
                    site: study.sites[site].name.clone(),
                    im,
                    poe: study.risk.poe[poe],
                    c0: fit.map(|fit| fit.c0),
                    c1: fit.map(|fit| fit.c1),
                    c2: fit.map(|fit| fit.c2),
                    rmse: fit.map(|fit| fit.rmse),
                    bound_active: fit.map(|fit| fit.bound_active),
                }
            };
            coefficients.fits.blocks().map(report).collect()
        };
        let records = (outcome.records.description.as_str(), outcome.records.synthetic);
        Self {
            head: outcome.provenance.head(&study.title, records, alarms, files, seconds),
            measures: outcome.stripes.iter().map(MeasureReport::from_outcome).collect(),
            coefficients: outcome.coefficients.iter().flat_map(fits).collect(),
            precision: outcome.precision.to_vec(),
            consistency: outcome.consistency.report(&plain_m(outcome)),
            repaired: outcome.consistency.repaired_spectra(),
            strengths: study.strengths.to_vec(),
            poes: study.risk.poe.clone(),
            years: study.risk.years,
            spectra: spectra(outcome),
            branches: branches(outcome, |spectra| &spectra.branches),
            structures: branches(outcome, |spectra| &spectra.structures),
        }
    }
}

/// The displacements `[site, poe, strength]` of each measure, m.
fn plain_m(outcome: &Outcome<'_>) -> Vec<(IntensityMeasure, Array<3>)> {
    let displacements = |spectra: &Spectra| spectra.ordinates.map(|ordinate| ordinate.displacement_m);
    outcome.spectra.iter().map(|spectra| (spectra.measure, displacements(spectra))).collect()
}

fn spectra(outcome: &Outcome<'_>) -> Vec<SpectrumReport> {
    let mut reports = Vec::new();
    for spectra in outcome.spectra {
        for ([site, poe], spectrum) in spectra.ordinates.blocks() {
            reports.push(SpectrumReport {
                site: outcome.study.sites[site].name.clone(),
                im: spectra.measure.label(),
                poe,
                u_m: spectrum.iter().map(|ordinate| ordinate.displacement_m).collect(),
            });
        }
    }
    reports
}

fn branches(outcome: &Outcome<'_>, of: fn(&Spectra) -> &[BranchSpectra]) -> Vec<BranchReport> {
    let mut reports = Vec::new();
    for spectra in outcome.spectra {
        for branches in of(spectra) {
            for poe in 0..outcome.study.risk.poe.len() {
                let of_poe = |values: &Array<2>| values.block([poe]).to_vec();
                let [low, .., high] = &branches.spread.fractiles_m;
                reports.push(BranchReport {
                    site: outcome.study.sites[branches.site].name.clone(),
                    im: spectra.measure.label(),
                    poe,
                    probability: outcome.study.risk.poe[poe],
                    low_m: of_poe(low),
                    mean_m: of_poe(&branches.spread.mean_m),
                    high_m: of_poe(high),
                });
            }
        }
    }
    reports
}

impl MeasureReport {
    fn from_outcome(stripes: &Stripes) -> Self {
        Self {
            im: stripes.measure.label(),
            analyses: stripes.analyses,
            analyses_computed: stripes.computed,
            seconds: stripes.seconds,
            analyses_per_second: uplift_engine::analysis::rate(stripes.computed, stripes.seconds),
        }
    }
}
