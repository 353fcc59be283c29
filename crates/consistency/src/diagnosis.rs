//! Everything that shares of the records make of an analysis.

use uplift_risk::RunWeights;

use crate::stripe::{Medians, ScaleFactors, StripeStatistics};
use crate::{ConsistencyError, Deviation, ScaledAnalysis, Verdict};

/// What the set, scaled to x, brings of y at a target rate.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetDiagnosis {
    /// The target rate ρ, 1/yr.
    pub rate_per_year: f64,
    /// The site's level of y at ρ; none where its curve does not reach ρ.
    pub site_level: Option<f64>,
    /// The implied level of y at ρ: 0 where y is implied less often than that at any level.
    pub implied_level: f64,
    /// Implied level over the site's.
    pub ratio: Option<f64>,
    /// Implied rate of the site's level over ρ: so many times as often is it reached.
    pub times_as_often: Option<f64>,
    /// The stripe nearest to the site's level of x at ρ, counted from 0.
    pub stripe: usize,
    /// By what the records are multiplied to reach that level of x, under their shares at that stripe.
    pub scale_factors: ScaleFactors,
    /// What the records are at that stripe.
    pub medians: Medians,
}

/// The stripe in the range at which the fewest records count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastEffective {
    /// Effective records there.
    pub records: f64,
    /// The stripe, counted from 0.
    pub level: usize,
}

/// What shares of the records make of an analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Implied hazard against the site's; none where the range is too narrow for a verdict.
    pub deviation: Option<Deviation>,
    /// At each target rate, `[target]`.
    pub targets: Vec<TargetDiagnosis>,
    /// At each stripe, `[level]`.
    pub stripes: Vec<StripeStatistics>,
    /// The stripe in the range with the fewest effective records; none where no stripe lies in the range.
    pub least_effective: Option<LeastEffective>,
}

impl Diagnosis {
    /// The verdict; none where the range is too narrow.
    pub fn verdict(&self) -> Option<Verdict> {
        self.deviation.as_ref().map(Deviation::verdict)
    }
}

impl ScaledAnalysis<'_> {
    /// Diagnoses the analysis.
    ///
    /// - `weights`: weights of a repair; none for records as they are, alike or with the shares of their level.
    /// - `scale_factor_limits`: scale factors outside these, lower and upper, are counted; nothing is left out.
    ///
    /// # Errors
    /// Weights of another number of levels or records.
    pub fn diagnose(
        &self,
        weights: Option<&RunWeights>,
        scale_factor_limits: [f64; 2],
    ) -> Result<Diagnosis, ConsistencyError> {
        let implied = self.implied(weights)?;
        let own;
        let shares = if let Some(weights) = weights {
            weights.shares()
        } else {
            own = self.own_shares();
            &own
        };
        let at_level = |level: usize| &shares[level * self.set().len()..][..self.set().len()];
        let stripes: Vec<StripeStatistics> = (0..self.levels().len())
            .map(|level| StripeStatistics::from_shares(self.set(), level, at_level(level)))
            .collect();
        let targets = self
            .targets()
            .iter()
            .map(|target| {
                let implied_level = implied.exact_ordinate(target.rate_per_year)?.displacement_m;
                let often = |level: f64| implied.mean_annual_frequency(level).map(|rate| rate / target.rate_per_year);
                let (shares, reached) = (at_level(target.stripe), (target.level, target.stripe));
                Ok(TargetDiagnosis {
                    rate_per_year: target.rate_per_year,
                    site_level: target.site_level,
                    implied_level,
                    ratio: target.site_level.map(|site_level| implied_level / site_level),
                    times_as_often: target.site_level.map(often).transpose()?,
                    stripe: target.stripe,
                    scale_factors: ScaleFactors::from_shares(self.set(), reached, shares, scale_factor_limits),
                    medians: Medians::from_shares(self.set(), shares),
                })
            })
            .collect::<Result<_, ConsistencyError>>()?;
        let deviation = self.range().is_wide().then(|| Deviation::from_analysis(self, &implied)).transpose()?;
        let least_effective = (0..stripes.len())
            .filter(|&level| self.is_in_range(level))
            .map(|level| LeastEffective { records: stripes[level].effective_records, level })
            .min_by(|a, b| a.records.total_cmp(&b.records));
        Ok(Diagnosis { deviation, targets, stripes, least_effective })
    }
}
