//! The stripes and hazard of a result: what the questions asked after a run start from.

use std::path::PathBuf;

use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve, rate_from_probability};
use uplift_job::{Array, COMMIT, JobError, VERSION, in_file, now};
use uplift_motion::IntensityMeasure;
use uplift_result::{ResultFile, RiskAxes, StoredBranch, StoredPeaks};
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};
use uplift_study::{Bootstrap, MeasurePlan};

use crate::error::UniformRiskError;
use crate::units::RecordUnits;

/// The stripes of a result, for another look at them.
#[derive(Debug, Clone)]
pub struct StoredStripes {
    /// The file.
    pub path: PathBuf,
    /// By what its numbers are known, see [`Head::study_digest`](uplift_result::Head::study_digest).
    pub study_digest: String,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// Names of the records.
    pub records: Vec<String>,
    /// What of them tells something by itself.
    pub units: RecordUnits,
    /// Uplift strengths.
    pub strengths: Vec<f64>,
    /// Probabilities of exceedance.
    pub poes: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// Target rates of the probabilities, 1/yr (Eq. 4.8).
    pub targets_per_year: Vec<f64>,
    /// Names of the sites.
    pub sites: Vec<String>,
    /// Displacement at uplift, m.
    pub uplift_displacement_m: f64,
    /// Seed of the study.
    pub seed: u64,
    /// What the study says about the bootstrap.
    pub bootstrap: Bootstrap,
    /// The measures, PGV first.
    pub measures: Vec<StoredMeasure>,
}

/// The stripes of one measure.
#[derive(Debug, Clone)]
pub struct StoredMeasure {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Its levels, cm/s or g.
    pub levels: Vec<f64>,
    /// Peak displacements `[record, strength, level]`, m; NaN where a record does not belong to a level.
    pub edp_m: Array<3>,
    /// How much each record counts `[level, record]`; none where all count alike.
    pub shares: Option<Vec<f64>>,
    /// What each stripe weighs at each site.
    pub weights: Vec<StripeWeights>,
    /// Weighted alternatives of each site, `[site]` of (weight, what each stripe weighs); none where it has no
    /// branches.
    pub branches: Vec<Vec<(f64, StripeWeights)>>,
    /// Exact ordinates `[site, poe, strength]`, m, computed from the stripes. They are those of the spectra unless the
    /// study reads its spectra off the grid of thresholds (`risk.contour = "grid"`): what is resampled or left out is
    /// always read exactly, so that only like is compared with like. The spectra themselves are
    /// [`ResultFile::spectra`].
    pub exact_m: Array<3>,
}

impl StoredStripes {
    /// The stripes of a result of uniform risk, with the hazard that they are weighed by.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn read(file: &ResultFile) -> Result<Self, UniformRiskError> {
        let axes = file.axes_with_sites()?;
        let study = file.stored_study()?;
        let targets_per_year = axes
            .poes
            .iter()
            .map(|&poe| rate_from_probability(poe, axes.years))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| in_file(UniformRiskError::from(error), file.path()))?;
        let measures = file
            .measures()
            .into_iter()
            .map(|measure| stored_measure(file, &axes, &targets_per_year, measure, study.risk.extrapolate))
            .collect::<Result<Vec<_>, UniformRiskError>>()?;
        let RiskAxes { records, strengths, poes, years, sites } = axes;
        let head = file.head()?;
        Ok(Self {
            path: file.path().to_owned(),
            study_digest: head.study_digest(),
            record_set: head.record_set,
            synthetic: head.synthetic,
            units: RecordUnits::new(&study, &records),
            records,
            strengths,
            poes,
            years,
            targets_per_year,
            sites,
            uplift_displacement_m: study.oscillator.uplift_displacement_m,
            seed: file.seed()?,
            bootstrap: study.bootstrap,
            measures,
        })
    }

    /// One line for the head of a table made from these: program, time, `what` it holds, file and records.
    pub fn line(&self, what: &str) -> String {
        let file = self.path.file_name().unwrap_or_default().to_string_lossy();
        let (digest, records) = (&self.study_digest, &self.record_set);
        format!(
            "uplift {VERSION} ({COMMIT}), {}; {what}; result {file}; study digest {digest}; records: {records}",
            now()
        )
        .replace(['\n', '\r'], " ")
    }

    /// Position of the probability `wanted`, or of the smallest.
    ///
    /// # Errors
    /// A probability that the result does not have.
    pub fn poe_index(&self, wanted: Option<f64>) -> Result<usize, UniformRiskError> {
        poe_index(&self.poes, wanted)
    }

    /// Position of the probability whose return period is `years`, which may be rounded as is usual: 475 years for
    /// 474.6, 10 % in 50 years.
    ///
    /// # Errors
    /// A return period that the result does not have.
    pub fn return_period_index(&self, years: f64) -> Result<usize, UniformRiskError> {
        let apart = |rate: &f64| (years * rate - 1.0).abs();
        let nearest = (0..self.targets_per_year.len())
            .min_by(|&a, &b| apart(&self.targets_per_year[a]).total_cmp(&apart(&self.targets_per_year[b])))
            .filter(|&index| apart(&self.targets_per_year[index]) < 0.005);
        Ok(nearest.ok_or_else(|| JobError::Choice {
            option: "--return-period",
            noun: "return period",
            wanted: Some(years.to_string()),
            known: self.targets_per_year.iter().map(|rate| format!("{:.1}", 1.0 / rate)).collect(),
        })?)
    }
}

/// Position of the probability `wanted` among `poes`, or of the smallest.
pub(crate) fn poe_index(poes: &[f64], wanted: Option<f64>) -> Result<usize, UniformRiskError> {
    let found = match wanted {
        Some(wanted) => poes.iter().position(|poe| (poe - wanted).abs() <= 1e-6 * poe),
        None => (0..poes.len()).min_by(|&a, &b| poes[a].total_cmp(&poes[b])),
    };
    Ok(found.ok_or_else(|| JobError::Choice {
        option: "--poe",
        noun: "probability",
        wanted: wanted.map(|wanted| format!("{wanted:?}")),
        known: poes.iter().map(|poe| format!("{poe:?}")).collect(),
    })?)
}

impl StoredMeasure {
    /// The stripes of one strength.
    ///
    /// # Errors
    /// Demands that are not demands, in a file that was changed.
    pub fn stripes(&self, strength: usize) -> Result<Stripes<'_>, UniformRiskError> {
        let [records, strengths, levels] = self.edp_m.shape();
        let edp_m = &self.edp_m.values()[strength * levels..];
        Ok(Stripes::with_shares(&self.levels, edp_m, (records, strengths * levels), self.shares.as_deref())?)
    }

    /// All demands of one strength, pooled.
    ///
    /// # Errors
    /// As [`StoredMeasure::stripes`].
    pub fn demand(&self, strength: usize) -> Result<PooledDemand, UniformRiskError> {
        Ok(PooledDemand::new(&self.stripes(strength)?)?)
    }
}

/// The stripes of `measure` over `axes`, with the hazard that they are weighed by and exact ordinates at the targets.
pub(super) fn stored_measure(
    file: &ResultFile,
    axes: &RiskAxes,
    targets_per_year: &[f64],
    measure: IntensityMeasure,
    extrapolation: Extrapolation,
) -> Result<StoredMeasure, UniformRiskError> {
    let StoredPeaks { levels, edp_m, shares } = file.peaks(axes, measure)?;
    let (mut weights, mut branches) = (Vec::new(), Vec::new());
    for site in &axes.sites {
        let weigh = |curve: &HazardCurve| weigh(file, site, curve, &levels, extrapolation);
        weights.push(weigh(&file.site_curve(site, measure)?)?);
        let of_site = file.branches(site, measure)?.into_iter();
        let of_site = of_site.map(|branch| Ok((branch.weight, weigh(&branch.curve)?)));
        branches.push(of_site.collect::<Result<Vec<_>, UniformRiskError>>()?);
    }
    let exact_m = Array::from_fn([axes.sites.len(), axes.poes.len(), axes.strengths.len()], |_| 0.0);
    let mut measure = StoredMeasure { measure, levels, edp_m, shares, weights, branches, exact_m };
    measure.exact_m = exact_ordinates(&measure, targets_per_year).map_err(|error| in_file(error, file.path()))?;
    Ok(measure)
}

/// What the stripes of a measure weigh by each of the weighted curves of a site; none where it has but one.
///
/// # Errors
/// A file that is damaged; levels outside a curve.
pub fn branch_weights(
    file: &ResultFile,
    site: &str,
    plan: &MeasurePlan,
    extrapolation: Extrapolation,
) -> Result<Vec<(f64, StripeWeights)>, UniformRiskError> {
    let branches = file.branches(site, plan.measure)?;
    let weigh = |branch: &StoredBranch| weigh(file, site, &branch.curve, &plan.levels, extrapolation);
    branches.iter().map(|branch| Ok((branch.weight, weigh(branch)?))).collect()
}

/// What the stripes at `levels` weigh by the curve of a site.
pub(super) fn weigh(
    file: &ResultFile,
    site: &str,
    curve: &HazardCurve,
    levels: &[f64],
    extrapolation: Extrapolation,
) -> Result<StripeWeights, UniformRiskError> {
    StripeWeights::from_hazard(curve, levels, extrapolation)
        .map_err(|error| file.fail(format!("hazard of {site}: {error}")).into())
}

/// Exact ordinates `[site, poe, strength]` of all spectra, m.
fn exact_ordinates(measure: &StoredMeasure, targets_per_year: &[f64]) -> Result<Array<3>, UniformRiskError> {
    let [_, strengths, _] = measure.edp_m.shape();
    let shape = [measure.weights.len(), targets_per_year.len(), strengths];
    // who asks for none needs no strength sorted
    if targets_per_year.is_empty() {
        return Ok(Array::from_fn(shape, |_| f64::NAN));
    }
    // [strength][site][poe]: each strength is sorted once
    let mut by_strength = Vec::with_capacity(strengths);
    for strength in 0..strengths {
        let demand = measure.demand(strength)?;
        let of_site = |weights| RiskCurve::new(&demand, weights)?.exact_ordinates(targets_per_year);
        by_strength.push(measure.weights.iter().map(of_site).collect::<Result<Vec<_>, _>>()?);
    }
    Ok(Array::from_fn(shape, |[site, poe, strength]| by_strength[strength][site][poe].displacement_m))
}
