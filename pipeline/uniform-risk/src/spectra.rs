//! Uniform risk spectra and the risk surface: stripes and hazard joined (Eq. 4.4, 4.8).

use rayon::prelude::*;
use uplift_fragility::Stripes as Stripe;
use uplift_hazard::rate_from_probability;
use uplift_ida::Axes;
use uplift_inputs::{BranchHazard, SiteHazard};
use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_result::BranchSpectra;
use uplift_risk::{Ordinate, PooledDemand, RiskCurve, RiskError, ThresholdGrid};
use uplift_study::{Contour, UncertaintyKind, UniformRiskStudy};

use super::Stripes;
use crate::epistemic::branch_spectra;
use crate::error::UniformRiskError;

/// The spectra of one measure.
#[derive(Debug, Clone)]
pub struct Spectra {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Ordinates `[site, poe, strength]`.
    pub ordinates: Array<3, Ordinate>,
    /// Spectra of each branch, for the sites that have branches.
    pub branches: Vec<BranchSpectra>,
    /// Spectra over the possible structures, one a site, where all records shake the same ones: a structure is a
    /// branch, and all weigh alike.
    pub structures: Vec<BranchSpectra>,
    /// Mean annual frequencies `[site, strength, threshold]`, 1/yr, if the study keeps them.
    pub maf_per_year: Option<Array<3>>,
}

impl Spectra {
    /// The spectrum of one site and probability, `[strength]`.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn spectrum(&self, site: usize, poe: usize) -> &[Ordinate] {
        self.ordinates.block([site, poe])
    }
}

/// How ordinates are read: the target rates and the thresholds of a study.
pub struct Reading {
    /// Target rates, 1/yr, one a probability.
    pub targets: Vec<f64>,
    grid: ThresholdGrid,
    contour: Contour,
}

impl Reading {
    /// The target rates and thresholds of `study`.
    ///
    /// # Errors
    /// Probabilities and thresholds that the check of the study rules out.
    pub fn from_study(study: &UniformRiskStudy) -> Result<Self, UniformRiskError> {
        let rate = |&poe: &f64| rate_from_probability(poe, study.risk.years);
        let targets = study.risk.poe.iter().map(rate).collect::<Result<Vec<_>, _>>()?;
        let grid = ThresholdGrid::new(study.risk.thresholds_m.to_vec())?;
        Ok(Self { targets, grid, contour: study.risk.contour })
    }

    /// The ordinates of one strength, one a probability.
    ///
    /// # Errors
    /// Demands that are none.
    pub fn ordinates(&self, curve: &RiskCurve<'_>) -> Result<Vec<Ordinate>, RiskError> {
        match self.contour {
            Contour::Exact => curve.exact_ordinates(&self.targets),
            Contour::Grid => self.targets.iter().map(|&target| curve.grid_ordinate(&self.grid, target)).collect(),
        }
    }
}

/// All demands of one strength, sorted once for all sites.
///
/// # Errors
/// Demands that are none.
pub fn pooled_demand(stripes: &Stripes, strength: usize) -> Result<PooledDemand, UniformRiskError> {
    let Axes { motions: records, systems: strengths, scales: levels } = stripes.peaks.axes();
    let edp_m = &stripes.peaks.displacement_m()[strength * levels..];
    let shares = stripes.at_level.as_ref().and_then(|at_level| at_level.shares.as_deref());
    Ok(PooledDemand::new(&Stripe::with_shares(&stripes.levels, edp_m, (records, strengths * levels), shares)?)?)
}

/// The demands of one strength of a structure alone: of every so many-th record, from the `first` on.
fn demand_of_structure(
    stripes: &Stripes,
    strength: usize,
    (first, structures): (usize, usize),
) -> Result<PooledDemand, UniformRiskError> {
    let Axes { motions: records, systems: strengths, scales: levels } = stripes.peaks.axes();
    let edp_m = &stripes.peaks.displacement_m()[(first * strengths + strength) * levels..];
    let stride = structures * strengths * levels;
    Ok(PooledDemand::new(&Stripe::strided(&stripes.levels, edp_m, records / structures, stride)?)?)
}

/// Structures that all records of a study shake; 1 where there are none such.
fn shared_structures(study: &UniformRiskStudy) -> usize {
    match &study.uncertainty {
        Some(of) if of.kind == UncertaintyKind::Epistemic => study.structures_of_a_motion(),
        _ => 1,
    }
}

/// One strength.
#[derive(Default)]
struct OfStrength {
    /// `[site][poe]`.
    ordinates: Vec<Vec<Ordinate>>,
    /// `[site][branch][poe]`.
    branches: Vec<Vec<Vec<Ordinate>>>,
    /// `[site][structure][poe]`.
    structures: Vec<Vec<Vec<Ordinate>>>,
    /// Surface rows `[site]`.
    rows: Vec<Vec<f64>>,
}

/// The spectra of all sites from the stripes of one measure.
///
/// Each strength is sorted once and serves every site and probability.
///
/// # Errors
/// Numbers that do not fit together, which the checks of study and inputs rule out.
pub fn uniform_risk_spectra(
    study: &UniformRiskStudy,
    stripes: &Stripes,
    hazard: &[SiteHazard],
) -> Result<Spectra, UniformRiskError> {
    let reading = Reading::from_study(study)?;
    let (targets, grid) = (&reading.targets, &reading.grid);
    let strengths = stripes.peaks.axes().systems;
    let shared = shared_structures(study);

    let of_strength = |strength: usize| -> Result<OfStrength, UniformRiskError> {
        let demand = pooled_demand(stripes, strength)?;
        let read = |curve: &RiskCurve<'_>| reading.ordinates(curve);
        let mut done = OfStrength::default();
        for site in hazard {
            let curve = RiskCurve::new(&demand, &site.curve.weights)?;
            done.ordinates.push(read(&curve)?);
            if study.risk.maf_surface {
                done.rows.push(curve.mean_annual_frequencies(grid));
            }
            let of_branch = |branch: &BranchHazard| read(&RiskCurve::new(&demand, &branch.input.weights)?);
            done.branches.push(site.branches.iter().map(of_branch).collect::<Result<_, _>>()?);
        }
        if shared > 1 {
            done.structures = vec![Vec::new(); hazard.len()];
            for structure in 0..shared {
                let demand = demand_of_structure(stripes, strength, (structure, shared))?;
                for (site, of_site) in hazard.iter().zip(&mut done.structures) {
                    of_site.push(read(&RiskCurve::new(&demand, &site.curve.weights)?)?);
                }
            }
        }
        Ok(done)
    };
    let by_strength = (0..strengths).into_par_iter().map(of_strength).collect::<Result<Vec<OfStrength>, _>>()?;

    let branches = hazard
        .iter()
        .enumerate()
        .filter(|(_, site)| !site.branches.is_empty())
        .map(|(index, site)| {
            let shape = [site.branches.len(), targets.len(), strengths];
            let spectra_m = Array::from_fn(shape, |[branch, poe, strength]| {
                by_strength[strength].branches[index][branch][poe].displacement_m
            });
            let names = site.branches.iter().map(|branch| branch.name.clone()).collect();
            branch_spectra(index, names, site.branches.iter().map(|branch| branch.weight).collect(), spectra_m)
        })
        .collect();
    let of_structures = |site: usize| {
        let names = (1..=shared).map(|number| number.to_string()).collect();
        let spectra_m = Array::from_fn([shared, targets.len(), strengths], |[structure, poe, strength]| {
            by_strength[strength].structures[site][structure][poe].displacement_m
        });
        branch_spectra(site, names, vec![1.0; shared], spectra_m)
    };
    let structures = if shared > 1 { (0..hazard.len()).map(of_structures).collect() } else { Vec::new() };
    Ok(Spectra {
        branches,
        structures,
        measure: stripes.measure,
        ordinates: Array::from_fn([hazard.len(), targets.len(), strengths], |[site, poe, strength]| {
            by_strength[strength].ordinates[site][poe]
        }),
        maf_per_year: study.risk.maf_surface.then(|| {
            let shape = [hazard.len(), strengths, grid.thresholds_m().len()];
            Array::from_fn(shape, |[site, strength, threshold]| by_strength[strength].rows[site][threshold])
        }),
    })
}
