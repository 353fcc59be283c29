//! Spectra and coefficients of many sites, one after the other: what they share is made once.

use rayon::prelude::*;
use uplift_bootstrap::{QUOTED_CONFIDENCE, truth_limits};
use uplift_job::Array;
use uplift_regression::ExponentialFit;
use uplift_result::{FRACTILES, SiteSpread, Spread};
use uplift_risk::{Ordinate, PooledDemand, RiskCurve, RiskError, SiteWeights, StripeWeights};
use uplift_study::UniformRiskStudy;

use crate::coefficients::fit_spectrum;
use crate::epistemic::spread;
use crate::error::UniformRiskError;
use crate::spectra::{Reading, pooled_demand};
use crate::stripes::Stripes;

/// What turns the hazard of any site into spectra: the demands of one measure, sorted once for each strength.
pub struct SiteRisk<'a> {
    study: &'a UniformRiskStudy,
    reading: Reading,
    /// One a strength.
    demands: Vec<PooledDemand>,
    bands: Option<Bands>,
}

/// Which bands are asked for.
struct Bands {
    /// Positions of the records that count as one.
    units: Vec<Vec<usize>>,
    /// Positions of the strengths.
    strengths: Vec<usize>,
}

/// The spectra of one site and measure.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteSpectra {
    /// Ordinates over `[poe, strength]`, row-major.
    pub ordinates: Vec<Ordinate>,
    /// A fit of Eq. 4.11, or why there is none, over `[poe]`.
    pub fits: Vec<Result<ExponentialFit, String>>,
    /// 90 % bands, lower limit first, m, over `[poe, strength]` of the strengths of
    /// [`SiteRisk::with_bands`]; empty without.
    pub bands_m: Vec<[f64; 2]>,
    /// Mean and [`FRACTILES`](uplift_result::FRACTILES) over weighted hazard curves, m, over `[poe, strength]` of the
    /// strengths of [`SiteRisk::spread_m`]; empty without.
    pub spread_m: Vec<SiteSpread>,
}

impl SiteSpectra {
    /// The ordinates and the bands at the position of a probability.
    pub fn at_poe(&self, poe: usize) -> (&[Ordinate], &[[f64; 2]]) {
        let poes = self.fits.len();
        let [ordinates, bands] = [self.ordinates.len() / poes, self.bands_m.len() / poes];
        (&self.ordinates[poe * ordinates..][..ordinates], &self.bands_m[poe * bands..][..bands])
    }

    /// Mean and fractiles over weighted hazard curves at the position of a probability; empty where there are none.
    pub fn spread_at_poe(&self, poe: usize) -> &[SiteSpread] {
        let strengths = self.spread_m.len() / self.fits.len();
        &self.spread_m[poe * strengths..][..strengths]
    }
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
        Ok(Self { study, reading: Reading::from_study(study)?, demands, bands: None })
    }

    /// The same with the band of each ordinate at the strengths of these positions: [`truth_limits`].
    ///
    /// - `units`: positions of the records that count as one, as [`QuotedUnits`](crate::QuotedUnits) has them.
    #[must_use]
    pub fn with_bands(self, units: Vec<Vec<usize>>, strengths: Vec<usize>) -> Self {
        Self { bands: Some(Bands { units, strengths }), ..self }
    }

    /// The spectra of the site whose hazard gives the stripes these weights: to the bit those of
    /// [`uniform_risk_spectra`](crate::spectra::uniform_risk_spectra) and
    /// [`fit_spectra`](crate::coefficients::fit_spectra); or, of weights of runs, those of a repair.
    ///
    /// # Errors
    /// Weights of another number of levels or runs.
    pub fn spectra<'w>(&self, weights: impl Into<SiteWeights<'w>>) -> Result<SiteSpectra, String> {
        self.weighed(weights.into()).map_err(|error| error.to_string())
    }

    fn weighed(&self, weights: SiteWeights<'_>) -> Result<SiteSpectra, RiskError> {
        let ordinates = |demand| self.reading.ordinates(&weights.curve(demand)?);
        let by_strength: Vec<Vec<Ordinate>> = self.demands.iter().map(ordinates).collect::<Result<_, _>>()?;
        let poes = self.reading.targets.len();
        let ordinates: Vec<Ordinate> =
            (0..poes).flat_map(|poe| by_strength.iter().map(move |ordinates| ordinates[poe])).collect();
        let fits = ordinates.chunks(self.demands.len()).map(|spectrum| fit_spectrum(self.study, spectrum)).collect();
        let mut limits_by_strength = Vec::new();
        if let Some(Bands { units, strengths }) = &self.bands {
            let of = |&strength: &usize| {
                truth_limits(&self.demands[strength], weights, units, &self.reading.targets, QUOTED_CONFIDENCE)
            };
            limits_by_strength = strengths.iter().map(of).collect::<Result<_, _>>()?;
        }
        let of_poe = |poe: usize| limits_by_strength.iter().map(move |limits| limits[poe]);
        let bands_m = (0..poes).flat_map(of_poe).collect();
        Ok(SiteSpectra { ordinates, fits, bands_m, spread_m: Vec::new() })
    }

    /// Mean and fractiles over weighted hazard curves, over `[poe, strength]` of the strengths of these positions: to
    /// the bit those of a site with these branches.
    ///
    /// - `branches`: weight of each curve, and what it makes the stripes weigh.
    ///
    /// # Errors
    /// Weights of another number of levels.
    pub fn spread_m(&self, branches: &[(f64, StripeWeights)], strengths: &[usize]) -> Result<Vec<SiteSpread>, String> {
        let poes = self.reading.targets.len();
        let mut spectra_m = Vec::with_capacity(branches.len() * poes * strengths.len());
        for (_, weights) in branches {
            let ordinates = |&strength: &usize| {
                let curve = RiskCurve::new(&self.demands[strength], weights)?;
                self.reading.ordinates(&curve)
            };
            let by_strength: Vec<Vec<Ordinate>> =
                strengths.iter().map(ordinates).collect::<Result<_, _>>().map_err(|error| error.to_string())?;
            spectra_m.extend((0..poes).flat_map(|poe| by_strength.iter().map(move |own| own[poe].displacement_m)));
        }
        let spectra_m = Array::new([branches.len(), poes, strengths.len()], spectra_m).map_err(|e| e.to_string())?;
        let weights: Vec<f64> = branches.iter().map(|(weight, _)| *weight).collect();
        let Spread { mean_m, fractiles_m } = spread(&weights, &spectra_m);
        let of = |place: usize| {
            let mut own = [mean_m.values()[place]; 1 + FRACTILES.len()];
            own[1..].iter_mut().zip(&fractiles_m).for_each(|(own, fractile_m)| *own = fractile_m.values()[place]);
            own
        };
        Ok((0..poes * strengths.len()).map(of).collect())
    }
}
