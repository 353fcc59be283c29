//! How uncertain the parameters of a fitted fragility are, since it is fitted to so many records.

use crate::{FragilityError, Stripes, fits_without_each};

/// Standard errors of the parameters of a lognormal fragility: its epistemic spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitSpread {
    /// Of the logarithm of the median: the dispersion that a fragility with uncertain median has beside its own.
    pub log_median: f64,
    /// Of the dispersion.
    pub dispersion: f64,
}

/// The spread of the [lognormal fragility](crate::fit_lognormal) of `threshold_m` by the jackknife: fitted without each
/// of the `units`, its records left out at all levels together, so that one record at many levels counts once.
///
/// - `units`: positions of the records of each pair or earthquake.
///
/// # Errors
/// A threshold that is negative or not finite; fewer than two units; no fit without one of them.
///
/// # Source
/// B. Efron and R. J. Tibshirani, An Introduction to the Bootstrap, 1993, Eq. 11.5.
pub fn lognormal_spread(
    stripes: &Stripes,
    threshold_m: f64,
    units: &[Vec<usize>],
) -> Result<FitSpread, FragilityError> {
    if units.len() < 2 {
        return Err(FragilityError::TooFewUnits { units: units.len() });
    }
    let fits = fits_without_each(stripes, threshold_m, units)?;
    let parameters: Vec<[f64; 2]> =
        fits.iter().map(|fit| [fit.fragility.median().ln(), fit.fragility.dispersion()]).collect();
    let n = units.len() as f64;
    let [log_median, dispersion] = [0, 1].map(|parameter| {
        let mean = parameters.iter().map(|own| own[parameter]).sum::<f64>() / n;
        let squares: f64 = parameters.iter().map(|own| (own[parameter] - mean).powi(2)).sum();
        ((n - 1.0) / n * squares).sqrt()
    });
    Ok(FitSpread { log_median, dispersion })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Records that exceed 1 m from a level of their own on: of a lognormal capacity, their number.
    fn demands(levels: &[f64], capacities: &[f64]) -> Vec<f64> {
        let of_record = |&capacity: &f64| levels.iter().map(move |&level| if level > capacity { 2.0 } else { 0.5 });
        capacities.iter().flat_map(of_record).collect()
    }

    #[test]
    fn it_is_that_of_a_mean_where_capacities_are_known_closely() {
        // capacities at the quantiles of a lognormal of median 1 and dispersion 0.5, levels so close that each is
        // known: the fit tends to the sample's mean, whose standard error is 0.5/√n
        let n = 200;
        let capacities: Vec<f64> =
            (0..n).map(|i| (0.5 * crate::normal_quantile((f64::from(i) + 0.5) / f64::from(n))).exp()).collect();
        let levels: Vec<f64> = (0..400).map(|i| 0.15 * 1.01_f64.powi(i)).collect();
        let edp_m = demands(&levels, &capacities);
        let stripes = Stripes::new(&levels, &edp_m).unwrap();
        let units: Vec<Vec<usize>> = (0..capacities.len()).map(|record| vec![record]).collect();
        let spread = lognormal_spread(&stripes, 1.0, &units).unwrap();
        let expected = 0.5 / f64::from(n).sqrt();
        assert!((spread.log_median / expected - 1.0).abs() < 0.1, "{spread:?} {expected}");
        // records that come in twos of the same earthquake tell half as much
        let twice: Vec<f64> = edp_m.chunks(levels.len()).flat_map(|row| [row, row]).flatten().copied().collect();
        let twice = Stripes::new(&levels, &twice).unwrap();
        let twos: Vec<Vec<usize>> = (0..capacities.len()).map(|pair| vec![2 * pair, 2 * pair + 1]).collect();
        let same = lognormal_spread(&twice, 1.0, &twos).unwrap();
        assert!((same.log_median / spread.log_median - 1.0).abs() < 1e-6, "{same:?} {spread:?}");
        assert!((same.dispersion / spread.dispersion - 1.0).abs() < 1e-6, "{same:?} {spread:?}");
    }

    #[test]
    fn it_needs_a_fit_without_each_unit() {
        let levels = [1.0, 2.0, 4.0];
        let edp_m = demands(&levels, &[0.5, 3.0, 5.0]);
        let stripes = Stripes::new(&levels, &edp_m).unwrap();
        assert_eq!(
            lognormal_spread(&stripes, 1.0, &[vec![0, 1, 2]]).unwrap_err(),
            FragilityError::TooFewUnits { units: 1 }
        );
        assert!(lognormal_spread(&stripes, 1.0, &[vec![0, 1], vec![2]]).is_err());
    }
}
