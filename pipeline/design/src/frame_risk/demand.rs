//! The demand of a target rate on a frame and on its proxies with its confidence band; errors with bands from resampled
//! records.

use serde::Serialize;
use uplift_bootstrap::{Band, ResamplingPlan};
use uplift_fragility::Stripes as Stripe;
use uplift_risk::{PooledDemand, ResamplingTable, RiskCurve, RunWeights, SiteWeights, StripeWeights};
use uplift_structure::relative_error;

use super::super::certainty::{Scatter, record_bands};
use crate::error::DesignError;

/// Displacements at which a risk curve is reported.
const POINTS: usize = 60;

/// A number with its band; NaN where replicates have none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Banded {
    /// Of all records.
    pub value: f64,
    /// Lower limit.
    pub lower: f64,
    /// Upper limit.
    pub upper: f64,
}

/// The demand on one model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelDemand {
    /// What it is: `wobbling frame`, `planar frame`, `oscillator`, or a reading of the spectrum.
    pub model: &'static str,
    /// Demand of the target rate in the displacement of the deck, m, with its confidence band, as that of a design;
    /// infinite where it overturns more often.
    pub demand_m: Banded,
    /// What that band is of: `records` or `earthquakes`; none where a single record has none.
    pub band_of: Option<&'static str>,
    /// The same of records weighted so that they bring the site's hazard, m; none where the result has no repair, and
    /// for a spectrum.
    pub repaired_m: Option<f64>,
    /// Error against the frame itself, the first row: `demand/frame − 1`, with the band that the same resamples of the
    /// records give both. None of the frame itself.
    pub error: Option<Banded>,
    /// Annual frequency of exceeding displacements.
    pub risk_curve: Vec<RiskPoint>,
}

/// A point of a risk curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RiskPoint {
    /// Displacement, m.
    pub displacement_m: f64,
    /// Mean annual frequency of exceeding it, 1/yr.
    pub per_year: f64,
}

/// What a demand is asked of.
pub(super) struct Question<'a> {
    pub(super) levels: &'a [f64],
    pub(super) weights: &'a StripeWeights,
    pub(super) repaired: Option<&'a RunWeights>,
    pub(super) target_per_year: f64,
    pub(super) scatter: &'a Scatter,
    pub(super) plan: &'a ResamplingPlan,
    pub(super) confidence: f64,
}

/// A demand with its confidence band, and that of every resample, m.
pub(super) struct Resampled {
    pub(super) demand_m: f64,
    /// NaN of a single record.
    limits_m: [f64; 2],
    band_of: Option<&'static str>,
    pub(super) replicates_m: Vec<f64>,
    repaired_m: Option<f64>,
    risk_curve: Vec<RiskPoint>,
}

impl Question<'_> {
    /// The demand on a model whose peaks are `peaks_m` over `[record, level]`, all times `factor`.
    pub(super) fn ask(&self, peaks_m: &[f64], factor: f64) -> Result<Resampled, DesignError> {
        let pool = PooledDemand::new(&Stripe::new(self.levels, peaks_m)?)?;
        let demand_m = |weights: SiteWeights<'_>| -> Result<f64, DesignError> {
            Ok(factor * weights.curve(&pool)?.exact_ordinate(self.target_per_year)?.displacement_m)
        };
        let table = ResamplingTable::new(&pool, self.weights)?;
        let mut replicates_m = vec![0.0; self.plan.samples().len()];
        table.ordinates(self.plan.samples(), &[self.target_per_year], &mut replicates_m)?;
        for replicate_m in &mut replicates_m {
            *replicate_m *= factor;
        }
        let asked = (self.target_per_year, self.confidence);
        let bands = record_bands(&pool, self.weights.into(), self.scatter, asked)?;
        Ok(Resampled {
            band_of: bands.map(|bands| bands.source()),
            limits_m: bands.map_or([f64::NAN; 2], |bands| bands.quoted().map(|limit_m| factor * limit_m)),
            demand_m: demand_m(self.weights.into())?,
            replicates_m,
            repaired_m: self.repaired.map(|weights| demand_m(weights.into())).transpose()?,
            risk_curve: self.risk_curve(&pool, factor)?,
        })
    }

    /// From where nearly everything exceeds to the largest peak.
    fn risk_curve(&self, pool: &PooledDemand, factor: f64) -> Result<Vec<RiskPoint>, DesignError> {
        let curve = RiskCurve::new(pool, self.weights)?;
        let mut finite = pool.edp_m().iter().filter(|peak_m| peak_m.is_finite());
        let (Some(&largest_m), Some(&least_m)) = (finite.next(), finite.next_back()) else { return Ok(Vec::new()) };
        let least_m = least_m.max(1e-4 * largest_m);
        let ratio = largest_m / least_m;
        let point = |step: usize| {
            let displacement_m = least_m * ratio.powf(step as f64 / (POINTS - 1) as f64);
            let per_year = curve.mean_annual_frequency(displacement_m)?;
            Ok(RiskPoint { displacement_m: factor * displacement_m, per_year })
        };
        (0..POINTS).map(point).collect()
    }

    fn band(&self, value: f64, mut replicates: Vec<f64>) -> Banded {
        replicates.sort_by(f64::total_cmp);
        let band = Band::percentile(&replicates, self.confidence);
        Banded { value, lower: band.lower_m, upper: band.upper_m }
    }

    /// The row of a model, beside the frame itself if it is not that.
    pub(super) fn row(&self, model: &'static str, of: Resampled, frame: Option<&Resampled>) -> ModelDemand {
        let error = frame.map(|frame| {
            // 0 where both are zero, or both infinite: they say the same
            let error = |(proxy_m, frame_m): (&f64, &f64)| relative_error(*proxy_m, *frame_m).unwrap_or(0.0);
            let errors = of.replicates_m.iter().zip(&frame.replicates_m).map(error).collect();
            self.band(error((&of.demand_m, &frame.demand_m)), errors)
        });
        ModelDemand {
            model,
            demand_m: Banded { value: of.demand_m, lower: of.limits_m[0], upper: of.limits_m[1] },
            band_of: of.band_of,
            repaired_m: of.repaired_m,
            error,
            risk_curve: of.risk_curve,
        }
    }
}

impl Resampled {
    /// The same through a rule, from the displacement that it starts from to the one that it gives; without a risk
    /// curve or a repair, which are not the rule's.
    pub(super) fn through(
        &self,
        demand_m: f64,
        rule: impl Fn(f64) -> Result<f64, DesignError>,
    ) -> Result<Self, DesignError> {
        let replicates_m = self.replicates_m.iter().map(|of| rule(*of)).collect::<Result<_, _>>()?;
        let [lower_m, upper_m] = self.limits_m;
        let limits_m = if upper_m.is_nan() { self.limits_m } else { [rule(lower_m)?, rule(upper_m)?] };
        Ok(Self { demand_m, limits_m, replicates_m, repaired_m: None, risk_curve: Vec::new(), ..*self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two records, levels 1 and 2 with rates 1 and 1/2 a year and all beyond the last: one record's peaks are 1 and 2
    /// m, the other's 2 m and infinite.
    #[test]
    fn a_case_by_hand() {
        let weights = StripeWeights::new(&[1.0, 0.5], None).unwrap();
        let plan = ResamplingPlan::draw(2, &[2], 200, 1).unwrap();
        let question = Question {
            levels: &[1.0, 2.0],
            weights: &weights,
            repaired: None,
            target_per_year: 0.4,
            scatter: &Scatter { pairs: vec![vec![0], vec![1]], earthquakes: None },
            plan: &plan,
            confidence: 0.9,
        };
        // the weights of both levels are ½(1 − ½) and ½(1 − ½) + ½: 0.25 and 0.75, halved for each record
        let peaks_m = [1.0, 2.0, 2.0, f64::INFINITY];
        let frame = question.ask(&peaks_m, 1.0).unwrap();
        // overturning alone has 0.375 a year, what exceeds 1 m has 0.375 + 0.375 + 0.125
        assert_eq!(frame.demand_m, 2.0);
        let proxy = question.ask(&peaks_m, 3.0).unwrap();
        assert_eq!(proxy.demand_m, 6.0);
        let row = question.row("proxy", proxy, Some(&frame));
        // the same resamples of both: the error has no noise
        assert_eq!(row.error.unwrap(), Banded { value: 2.0, lower: 0.0, upper: 2.0 });
        assert!(row.demand_m.upper.is_infinite() && row.demand_m.lower <= 6.0);
        assert!(row.risk_curve.windows(2).all(|pair| pair[0].per_year >= pair[1].per_year));
        let own = question.row("frame", frame, None);
        assert_eq!((own.error, own.demand_m.value), (None, 2.0));
    }
}
