//! The stripes and hazard of a result: what the questions asked after a run start from.

use std::path::PathBuf;

use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve, rate_from_probability};
use uplift_motion::IntensityMeasure;
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};
use uplift_study::{Bootstrap, MeasurePlan};

use super::RecordUnits;
use super::RiskAxes;
use super::file::ResultFile;
use super::layout::{axis, ida};
use crate::array::Array;
use crate::error::UpliftError;

/// The stripes of a result, for another look at them.
#[derive(Debug, Clone)]
pub struct StoredStripes {
    /// The file.
    pub path: PathBuf,
    /// By what its numbers are known, see [`Head::study_digest`](super::Head::study_digest).
    pub study_digest: String,
    /// Where the records come from, in a line.
    pub record_set: String,
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

/// Levels with records of their own.
pub(crate) struct SetsOfLevels {
    /// Scale factors `[record, level]`, NaN where a record does not belong to a level.
    pub(crate) factors: Vec<f64>,
    /// How much each record counts `[level, record]`; none where all count alike.
    pub(crate) shares: Option<Vec<f64>>,
}

impl StoredStripes {
    /// Position of the probability `wanted`, or of the smallest.
    ///
    /// # Errors
    /// A probability that the result does not have.
    pub fn poe_index(&self, wanted: Option<f64>) -> Result<usize, UpliftError> {
        poe_index(&self.poes, wanted)
    }

    /// Position of the probability whose return period is `years`, which may be rounded as is usual: 475 years for
    /// 474.6, 10 % in 50 years.
    ///
    /// # Errors
    /// A return period that the result does not have.
    pub fn return_period_index(&self, years: f64) -> Result<usize, UpliftError> {
        let apart = |rate: &f64| (years * rate - 1.0).abs();
        let nearest = (0..self.targets_per_year.len())
            .min_by(|&a, &b| apart(&self.targets_per_year[a]).total_cmp(&apart(&self.targets_per_year[b])))
            .filter(|&index| apart(&self.targets_per_year[index]) < 0.005);
        nearest.ok_or_else(|| UpliftError::Choice {
            option: "--return-period",
            wanted: Some(years.to_string()),
            known: self.targets_per_year.iter().map(|rate| format!("{:.1}", 1.0 / rate)).collect(),
        })
    }
}

/// Position of the probability `wanted` among `poes`, or of the smallest.
///
/// # Errors
/// A probability that is not among them.
pub(super) fn poe_index(poes: &[f64], wanted: Option<f64>) -> Result<usize, UpliftError> {
    let found = match wanted {
        Some(wanted) => poes.iter().position(|poe| (poe - wanted).abs() <= 1e-6 * poe),
        None => (0..poes.len()).min_by(|&a, &b| poes[a].total_cmp(&poes[b])),
    };
    found.ok_or_else(|| UpliftError::Choice {
        option: "--poe",
        wanted: wanted.map(|wanted| format!("{wanted:?}")),
        known: poes.iter().map(|poe| format!("{poe:?}")).collect(),
    })
}

impl StoredMeasure {
    /// The stripes of one strength.
    ///
    /// # Errors
    /// Demands that are not demands, in a file that was changed.
    pub fn stripes(&self, strength: usize) -> Result<Stripes<'_>, UpliftError> {
        let [records, strengths, levels] = self.edp_m.shape();
        let edp_m = &self.edp_m.values()[strength * levels..];
        Ok(Stripes::with_shares(&self.levels, edp_m, (records, strengths * levels), self.shares.as_deref())?)
    }

    /// All demands of one strength, pooled.
    ///
    /// # Errors
    /// As [`StoredMeasure::stripes`].
    pub fn demand(&self, strength: usize) -> Result<PooledDemand, UpliftError> {
        Ok(PooledDemand::new(&self.stripes(strength)?)?)
    }
}

impl ResultFile {
    /// The stripes of a result of uniform risk, with the hazard that they are weighed by.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn stripes(&self) -> Result<StoredStripes, UpliftError> {
        let axes = self.axes_with_sites()?;
        let study = self.stored_study()?;
        let targets_per_year = axes
            .poes
            .iter()
            .map(|&poe| rate_from_probability(poe, axes.years))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| UpliftError::from(error).in_file(&self.path))?;
        let measures = self
            .measures()
            .into_iter()
            .map(|measure| self.stored_measure(&axes, &targets_per_year, measure, study.risk.extrapolate))
            .collect::<Result<Vec<_>, UpliftError>>()?;
        let RiskAxes { records, strengths, poes, years, sites } = axes;
        Ok(StoredStripes {
            path: self.path.clone(),
            study_digest: self.head()?.study_digest(),
            record_set: self.record_set()?,
            units: RecordUnits::new(&study, &records),
            records,
            strengths,
            poes,
            years,
            targets_per_year,
            sites,
            uplift_displacement_m: study.oscillator.uplift_displacement_m,
            seed: self.reader.attribute_u64("/", "seed")?,
            bootstrap: study.bootstrap,
            measures,
        })
    }

    pub(super) fn stored_measure(
        &self,
        axes: &RiskAxes,
        targets_per_year: &[f64],
        measure: IntensityMeasure,
        extrapolation: Extrapolation,
    ) -> Result<StoredMeasure, UpliftError> {
        let level = axis::level(measure);
        let levels = self.reader.axis_f64(&level)?;
        let lengths = [
            (axis::RECORD, axes.records.len()),
            (axis::STRENGTH, axes.strengths.len()),
            (level.as_str(), levels.len()),
        ];
        let edp_m = self.array(&ida::edp_m(measure), lengths)?;
        let shares = self.shares_of_levels(axes.records.len(), measure, levels.len())?;
        let (mut weights, mut branches) = (Vec::new(), Vec::new());
        for site in &axes.sites {
            let weigh = |curve: &HazardCurve| self.weigh(site, curve, &levels, extrapolation);
            weights.push(weigh(&self.site_curve(site, measure)?)?);
            let of_site = self.branches(site, measure)?.into_iter();
            let of_site = of_site.map(|branch| Ok((branch.weight, weigh(&branch.curve)?)));
            branches.push(of_site.collect::<Result<Vec<_>, UpliftError>>()?);
        }
        let exact_m = Array::from_fn([axes.sites.len(), axes.poes.len(), axes.strengths.len()], |_| 0.0);
        let mut measure = StoredMeasure { measure, levels, edp_m, shares, weights, branches, exact_m };
        measure.exact_m = exact_ordinates(&measure, targets_per_year).map_err(|error| error.in_file(&self.path))?;
        Ok(measure)
    }

    /// What the stripes of a measure weigh by each of the weighted curves of a site; none where it has but one.
    ///
    /// # Errors
    /// A file that is damaged; levels outside a curve.
    pub(crate) fn branch_weights(
        &self,
        site: &str,
        plan: &MeasurePlan,
        extrapolation: Extrapolation,
    ) -> Result<Vec<(f64, StripeWeights)>, UpliftError> {
        let weigh = |curve: &HazardCurve| self.weigh(site, curve, &plan.levels, extrapolation);
        let branches = self.branches(site, plan.measure)?;
        branches.iter().map(|branch| Ok((branch.weight, weigh(&branch.curve)?))).collect()
    }

    /// The records of each level; none where they are the same at all of them.
    ///
    /// # Errors
    /// A file that is damaged.
    pub(crate) fn sets_of_levels(
        &self,
        records: usize,
        measure: IntensityMeasure,
        levels: usize,
    ) -> Result<Option<SetsOfLevels>, UpliftError> {
        let (path, level) = (ida::factor(measure), axis::level(measure));
        if !self.reader.exists(&path) {
            return Ok(None);
        }
        let factors = self.array(&path, [(axis::RECORD, records), (level.as_str(), levels)])?.into_values();
        Ok(Some(SetsOfLevels { factors, shares: self.shares_of_levels(records, measure, levels)? }))
    }

    /// How much each record counts `[level, record]`; none where all count alike.
    fn shares_of_levels(
        &self,
        records: usize,
        measure: IntensityMeasure,
        levels: usize,
    ) -> Result<Option<Vec<f64>>, UpliftError> {
        let (path, level) = (ida::share(measure), axis::level(measure));
        let lengths = [(level.as_str(), levels), (axis::RECORD, records)];
        self.reader.exists(&path).then(|| Ok(self.array(&path, lengths)?.into_values())).transpose()
    }

    /// What the stripes at `levels` weigh by the curve of a site.
    pub(super) fn weigh(
        &self,
        site: &str,
        curve: &HazardCurve,
        levels: &[f64],
        extrapolation: Extrapolation,
    ) -> Result<StripeWeights, UpliftError> {
        StripeWeights::from_hazard(curve, levels, extrapolation)
            .map_err(|error| self.fail(format!("hazard of {site}: {error}")))
    }
}

/// Exact ordinates `[site, poe, strength]` of all spectra, m.
fn exact_ordinates(measure: &StoredMeasure, targets_per_year: &[f64]) -> Result<Array<3>, UpliftError> {
    let [_, strengths, _] = measure.edp_m.shape();
    // [strength][site][poe]: each strength is sorted once
    let mut by_strength = Vec::with_capacity(strengths);
    for strength in 0..strengths {
        let demand = measure.demand(strength)?;
        let of_site = |weights| RiskCurve::new(&demand, weights)?.exact_ordinates(targets_per_year);
        by_strength.push(measure.weights.iter().map(of_site).collect::<Result<Vec<_>, _>>()?);
    }
    let shape = [measure.weights.len(), targets_per_year.len(), strengths];
    Ok(Array::from_fn(shape, |[site, poe, strength]| by_strength[strength][site][poe].displacement_m))
}
