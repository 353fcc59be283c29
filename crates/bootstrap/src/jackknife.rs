//! The spectrum without each record: which records carry the result.

use uplift_risk::{PooledDemand, RecordSample, ResamplingTable, StripeWeights};

use crate::BootstrapError;

/// Exact ordinates of `samples`, the records without a part of them each, m, `[target][sample]`.
///
/// - `targets_per_year`: target rates, 1/yr, `[target]`.
/// - `samples`: as [`left_out`](crate::left_out) makes them; without any, the ordinates of each target are none.
///
/// # Errors
/// Where there are samples: demand and weights with different numbers of levels; a target that is not positive and
/// finite.
pub fn without_each(
    demand: &PooledDemand,
    weights: &StripeWeights,
    targets_per_year: &[f64],
    samples: &[RecordSample],
) -> Result<Vec<Vec<f64>>, BootstrapError> {
    if samples.is_empty() {
        return Ok(vec![Vec::new(); targets_per_year.len()]);
    }
    let mut ordinates_m = vec![0.0; samples.len() * targets_per_year.len()];
    ResamplingTable::new(demand, weights)?.ordinates(samples, targets_per_year, &mut ordinates_m)?;
    Ok(ordinates_m.chunks_exact(samples.len()).map(<[f64]>::to_vec).collect())
}

/// What each record has in a number that is nearly a mean over the records, `[record]`: `all + (n − 1)(m − x)`, where
/// `x` is the number without the record and `m` the mean of these. Tukey's pseudo-values, moved so that their mean is
/// the number.
///
/// # Source
/// J. W. Tukey, Ann. Math. Stat. 29 (1958), 614.
pub fn contributions(all: f64, without_each: &[f64]) -> Vec<f64> {
    let records = without_each.len() as f64;
    let mean = without_each.iter().sum::<f64>() / records;
    without_each.iter().map(|without| all + (records - 1.0) * (mean - without)).collect()
}

/// Acceleration of BCa for samples of `size` records (Efron and Tibshirani, Eq. 14.15, from the jackknife).
///
/// - `without_each_m`: the ordinate without each record, m.
///
/// With d the mean of the values less each value, `a = Σ d³ / (6 (Σ d²)^1.5)`. This is the skewness of the mean of n
/// influences over 6, so samples of another size have it times `√(n/size)`. It is 0 where all values are alike and NaN
/// where one is infinite or there are none.
pub fn acceleration(without_each_m: &[f64], size: u32) -> f64 {
    let n = without_each_m.len() as f64;
    let mean = without_each_m.iter().sum::<f64>() / n;
    let moment = |power: i32| without_each_m.iter().map(|value| (mean - value).powi(power)).sum::<f64>();
    let (second, third) = (moment(2), moment(3));
    if n > 0.0 && second == 0.0 {
        return 0.0;
    }
    third / (6.0 * second.powf(1.5)) * (n / f64::from(size)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acceleration_by_hand() {
        // mean 2, d = 1, 1, −2: Σ d² = 6, Σ d³ = −6, a = −6/(6 · 6^1.5)
        let expected = -1.0 / 6.0_f64.powf(1.5);
        assert!((acceleration(&[1.0, 1.0, 4.0], 3) - expected).abs() < 1e-15);
        assert!((acceleration(&[1.0, 1.0, 4.0], 12) - 0.5 * expected).abs() < 1e-15);
        assert_eq!(acceleration(&[0.3; 4], 4), 0.0);
        assert!(acceleration(&[0.3, f64::INFINITY], 2).is_nan());
        assert!(acceleration(&[], 1).is_nan());
    }
}
