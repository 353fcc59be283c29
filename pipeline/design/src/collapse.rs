//! How often a structure overturns, and at which intensity: counts, a fragility, a risk (Section 2.4.3, Eq. 2.1 to
//! 2.3).

use uplift_fragility::{FragilityError, LognormalFit, StripeCount, Stripes as Stripe, fit_lognormal, stripe_counts};
use uplift_risk::{PooledDemand, RunWeights, SiteWeights, StripeWeights};
use uplift_uniform_risk::EventRisk;

use super::risk::{OVERTURNING_M, bounded, risk_of_exceeding};
use crate::error::DesignError;

/// Overturning of one model by one measure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Collapse {
    /// Overturned records at each level, `[level]`.
    pub(super) counts: Vec<StripeCount>,
    /// The lognormal fragility of maximum likelihood, or why there is none.
    pub(super) fit: Result<LognormalFit, FragilityError>,
    /// The risk of overturning, `[site]`: from the counts, with no curve fitted.
    pub(super) risks: Vec<EventRisk>,
    /// The same with repaired weights, `[site]`; none where there are none.
    pub(super) repaired: Vec<Option<EventRisk>>,
    /// The same by the fitted fragility in place of the counts, `[site]`; none without a fit.
    pub(super) fitted: Option<Vec<EventRisk>>,
}

/// Counts, fits and weighs what overturned among `demands_m`.
///
/// * `levels` — of the stripes, ascending
/// * `demands_m` — over `[record, level]`, m; infinite where overturned
/// * `pairs` — the positions of each pair's records
/// * `weights` — what each stripe weighs, and each run after a repair, `[site]`
/// * `years` — that the probabilities refer to
/// * `may_overturn` — false for a system that cannot
pub(super) fn collapse(
    levels: &[f64],
    (demands_m, pairs): (&[f64], &[Vec<usize>]),
    weights: &[(&StripeWeights, Option<&RunWeights>)],
    years: f64,
    may_overturn: bool,
) -> Result<Collapse, DesignError> {
    let stripes = Stripe::new(levels, demands_m)?;
    let counts = stripe_counts(&stripes, OVERTURNING_M)?;
    let demand = PooledDemand::new(&stripes)?;
    let risk = |weights: SiteWeights<'_>| {
        let risk = risk_of_exceeding(&demand, &weights, OVERTURNING_M, years)?;
        Ok::<_, DesignError>(if may_overturn { bounded(risk, &weights, pairs) } else { risk })
    };
    let risks = weights.iter().map(|(stripes, _)| risk(SiteWeights::Alike(stripes))).collect::<Result<_, _>>()?;
    let of_repair =
        |(_, runs): &(_, Option<&RunWeights>)| runs.map(|runs| risk(SiteWeights::Repaired(runs))).transpose();
    let repaired = weights.iter().map(of_repair).collect::<Result<_, _>>()?;
    let fit = fit_lognormal(&counts);
    let fitted = fit.as_ref().ok().map(|fit| {
        let probabilities: Vec<f64> = levels.iter().map(|&level| fit.fragility.probability(level)).collect();
        let of_site = |(stripes, _): &(&StripeWeights, _)| {
            let parts = stripes.disaggregate(&probabilities)?;
            let tails = [parts.lower_tail_per_year, parts.upper_tail_per_year];
            Ok(EventRisk::new(parts.total_per_year(), tails, years)?)
        };
        weights.iter().map(of_site).collect::<Result<Vec<_>, DesignError>>()
    });
    Ok(Collapse { counts, fit, risks, repaired, fitted: fitted.transpose()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two records that are a pair each.
    fn alone() -> [Vec<usize>; 2] {
        [vec![0], vec![1]]
    }

    /// Two records, levels 1, 2, 4 with rates 1, 1/2, 1/4 per year, nothing below: one overturns from 2 on, the other
    /// at 4 and, weaving, at 1.
    #[test]
    fn a_case_by_hand() {
        let inf = f64::INFINITY;
        let weights = StripeWeights::new(&[1.0, 0.5, 0.25], None).unwrap();
        // the record that does not overturn at the first level counts thrice there
        let runs = RunWeights::new(&weights, &[0.75, 0.25, 0.5, 0.5, 0.5, 0.5]).unwrap();
        let found = collapse(
            &[1.0, 2.0, 4.0],
            (&[0.1, inf, inf, inf, 0.3, inf], &alone()),
            &[(&weights, Some(&runs))],
            2.0,
            true,
        )
        .unwrap();
        let counts: Vec<(u32, u32)> = found.counts.iter().map(|count| (count.exceedances, count.trials)).collect();
        assert_eq!(counts, [(1, 2), (1, 2), (2, 2)]);
        // ½ (½ + ½)(1 − ½) + ½ (½ + 1)(½ − ¼) + 1 · ¼
        let rate = 0.25 + 0.1875 + 0.25;
        let risk = found.risks[0];
        assert_eq!(risk.per_year, rate);
        assert_eq!(risk.probability, -(-2.0 * rate).exp_m1());
        assert_eq!((risk.lower_tail_share, risk.upper_tail_share), (0.0, 0.25 / rate));
        // the first level: a quarter for a half
        assert_eq!(found.repaired[0].unwrap().per_year, rate - 0.25 * 0.25);
        // the fit is another fragility, and so another number, of the same integral
        let fragility = found.fit.unwrap().fragility;
        let [p1, p2, p4] = [1.0, 2.0, 4.0].map(|level| fragility.probability(level));
        let by_hand = 0.25 * (p1 + p2) + 0.125 * (p2 + p4) + 0.25 * p4;
        assert!((found.fitted.unwrap()[0].per_year - by_hand).abs() < 1e-15);
    }

    #[test]
    fn a_structure_that_never_overturns_has_no_fit() {
        let weights = StripeWeights::new(&[1.0, 0.5], None).unwrap();
        let found = collapse(&[1.0, 2.0], (&[0.1, 0.2, 0.3, 1e9], &alone()), &[(&weights, None)], 50.0, true).unwrap();
        assert_eq!(found.fit, Err(FragilityError::NoExceedance));
        assert_eq!((found.risks[0].per_year, found.risks[0].upper_tail_share), (0.0, 0.0));
        assert!(found.fitted.is_none());
        // beyond the last level everything may overturn
        assert!(found.risks[0].at_most_per_year.unwrap() > 0.5);
        let cannot =
            collapse(&[1.0, 2.0], (&[0.1, 0.2, 0.3, 1e9], &alone()), &[(&weights, None)], 50.0, false).unwrap();
        assert_eq!(cannot.risks[0].at_most_per_year, None);
    }
}
