//! A fragility of demands of which many are zero: rocking structures do not move at all until the ground lifts them.

use crate::{
    FragilityError, LognormalFragility, StripeCount, Stripes, exceedance_counts, fit_lognormal, stripe_counts,
};

/// P(exceedance | im) = P(uplift | im) · P(exceedance | uplift, im), a lognormal distribution function each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZeroInflatedFragility {
    /// Of uplift, among all records.
    pub uplift: LognormalFragility,
    /// Of exceedance, among the records that uplift the structure.
    pub beyond: LognormalFragility,
}

impl ZeroInflatedFragility {
    /// Probability of exceedance at intensity `im` > 0, in the unit of the medians.
    pub fn probability(&self, im: f64) -> f64 {
        self.uplift.probability(im) * self.beyond.probability(im)
    }
}

/// Maximum-likelihood zero-inflated lognormal fragility of `threshold_m`, where demands up to `uplift_m` count as zero.
///
/// The likelihood is a product: of the records that uplift among all, and of those that exceed among these. Each factor
/// has its own maximum ([`fit_lognormal`]).
///
/// # Errors
/// A threshold that is negative, not finite or not above `uplift_m`; a factor without a maximum.
///
/// # Source
/// J. W. Baker, Earthquake Spectra 31 (2015), Eq. 11, for each factor; a hurdle at zero as in J. Mullahy, Journal of
/// Econometrics 33 (1986).
pub fn fit_zero_inflated(
    stripes: &Stripes,
    uplift_m: f64,
    threshold_m: f64,
) -> Result<ZeroInflatedFragility, FragilityError> {
    if threshold_m <= uplift_m {
        return Err(FragilityError::NotBeyondUplift { threshold_m, uplift_m });
    }
    let uplifted = stripe_counts(stripes, uplift_m)?;
    let exceeding = exceedance_counts(stripes, threshold_m)?;
    let beyond: Vec<StripeCount> = uplifted
        .iter()
        .zip(exceeding)
        .filter(|(uplifted, _)| uplifted.exceedances > 0)
        .map(|(uplifted, exceedances)| StripeCount { level: uplifted.level, exceedances, trials: uplifted.exceedances })
        .collect();
    Ok(ZeroInflatedFragility { uplift: fit_lognormal(&uplifted)?.fragility, beyond: fit_lognormal(&beyond)?.fragility })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_factor_is_met_exactly() {
        // 16 records at levels 2 and 8: 4 and 12 uplift, of which 1 and 9 go beyond 1 m: two levels, two parameters
        let mut edp_m = Vec::new();
        for record in 0..16 {
            edp_m.extend([
                if record < 1 {
                    2.0
                } else if record < 4 {
                    0.5
                } else {
                    0.0
                },
                if record < 9 {
                    f64::INFINITY
                } else if record < 12 {
                    0.5
                } else {
                    0.1
                },
            ]);
        }
        let stripes = Stripes::new(&[2.0, 8.0], &edp_m).unwrap();
        let fit = fit_zero_inflated(&stripes, 0.1, 1.0).unwrap();
        let near = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-9, "{value} {expected}");
        near(fit.uplift.probability(2.0), 0.25);
        near(fit.uplift.probability(8.0), 0.75);
        near(fit.beyond.probability(2.0), 0.25);
        near(fit.beyond.probability(8.0), 0.75);
        near(fit.probability(2.0), 1.0 / 16.0);
        near(fit.probability(8.0), 9.0 / 16.0);
        let same = fit_zero_inflated(&stripes, 0.1, 0.1).unwrap_err();
        assert_eq!(same, FragilityError::NotBeyondUplift { threshold_m: 0.1, uplift_m: 0.1 });
    }
}
