//! Spectra and coefficients of many sites, one after the other: what they share is made once.

use rayon::prelude::*;
use uplift_regression::ExponentialFit;
use uplift_risk::{Ordinate, PooledDemand, RiskCurve, RiskError, RunWeights, StripeWeights};
use uplift_study::UniformRiskStudy;

use crate::coefficients::fit_spectrum;
use crate::error::UniformRiskError;
use crate::spectra::{Reading, pooled_demand};
use crate::stripes::Stripes;

/// What turns the hazard of any site into spectra: the demands of one measure, sorted once for each strength.
pub struct SiteRisk<'a> {
    study: &'a UniformRiskStudy,
    reading: Reading,
    /// One a strength.
    demands: Vec<PooledDemand>,
}

/// The spectra of one site and measure.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteSpectra {
    /// Ordinates over `[poe, strength]`, row-major.
    pub ordinates: Vec<Ordinate>,
    /// A fit of Eq. 4.11, or why there is none, over `[poe]`.
    pub fits: Vec<Result<ExponentialFit, String>>,
}

impl<'a> SiteRisk<'a> {
    /// Pool the demands of `stripes`.
    ///
    /// # Errors
    /// Numbers that do not fit together, which the check of the study rules out.
    pub fn new(study: &'a UniformRiskStudy, stripes: &Stripes) -> Result<Self, UniformRiskError> {
        Self::from_demands(study, stripes.peaks.axes().systems, |strength| pooled_demand(stripes, strength))
    }

    /// The same of demands that `demand` pools for each of the `strengths`.
    pub(crate) fn from_demands(
        study: &'a UniformRiskStudy,
        strengths: usize,
        demand: impl Fn(usize) -> Result<PooledDemand, UniformRiskError> + Sync + Send,
    ) -> Result<Self, UniformRiskError> {
        let demands = (0..strengths).into_par_iter().map(demand).collect::<Result<_, _>>()?;
        Ok(Self { study, reading: Reading::from_study(study)?, demands })
    }

    /// The spectra of the site whose hazard gives the stripes these weights: to the bit those of
    /// [`uniform_risk_spectra`](crate::spectra::uniform_risk_spectra) and
    /// [`fit_spectra`](crate::coefficients::fit_spectra).
    ///
    /// # Errors
    /// Weights of another number of levels.
    pub fn spectra(&self, weights: &StripeWeights) -> Result<SiteSpectra, String> {
        self.of_curves(|demand| RiskCurve::new(demand, weights))
    }

    /// The spectra of runs that weigh `weights`, those of a repair.
    ///
    /// # Errors
    /// Weights of another number of runs.
    pub fn weighted_spectra(&self, weights: &RunWeights) -> Result<SiteSpectra, String> {
        self.of_curves(|demand| RiskCurve::weighted(demand, weights))
    }

    fn of_curves<'d>(
        &'d self,
        curve: impl Fn(&'d PooledDemand) -> Result<RiskCurve<'d>, RiskError>,
    ) -> Result<SiteSpectra, String> {
        let mut by_strength = Vec::with_capacity(self.demands.len());
        for demand in &self.demands {
            let curve = curve(demand).map_err(|error| error.to_string())?;
            by_strength.push(self.reading.ordinates(&curve).map_err(|error| error.to_string())?);
        }
        let poes = self.reading.targets.len();
        let ordinates: Vec<Ordinate> =
            (0..poes).flat_map(|poe| by_strength.iter().map(move |ordinates| ordinates[poe])).collect();
        let fits = ordinates.chunks(self.demands.len()).map(|spectrum| fit_spectrum(self.study, spectrum)).collect();
        Ok(SiteSpectra { ordinates, fits })
    }
}
