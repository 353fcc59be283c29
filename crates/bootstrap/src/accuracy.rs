//! The two figures of Table 4.1.

/// Error of the median spectrum `e_median`, a ratio (Eq. 4.9): the largest `|u_median − u|` over the
/// strengths, over u there.
///
/// - `median_m`: median of the replicates, m, `[strength]`.
/// - `spectrum_m`: the spectrum of all records, m, `[strength]`.
///
/// None where it does not exist: an ordinate that is not finite, or a difference where the spectrum is 0. No
/// difference at all is 0.
pub fn error_of_median(median_m: &[f64], spectrum_m: &[f64]) -> Option<f64> {
    largest_ratio(median_m.iter().zip(spectrum_m).map(|(median, spectrum)| ((median - spectrum).abs(), *spectrum)))
}

/// Range of the confidence interval `r_90CI`, a ratio (Eq. 4.10): the largest `u95 − u5` over the strengths,
/// over the median there.
///
/// - `lower_m`, `median_m`, `upper_m`: the band, m, `[strength]`.
///
/// None as for [`error_of_median`].
pub fn range_of_interval(lower_m: &[f64], median_m: &[f64], upper_m: &[f64]) -> Option<f64> {
    largest_ratio(
        lower_m.iter().zip(upper_m).zip(median_m).map(|((lower, upper), median)| ((upper - lower).abs(), *median)),
    )
}

/// The largest numerator over its own denominator.
fn largest_ratio(ratios: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let mut largest = (0.0, 1.0);
    let mut any = false;
    for (numerator, denominator) in ratios {
        if !numerator.is_finite() || !denominator.is_finite() {
            return None;
        }
        any = true;
        if numerator > largest.0 {
            largest = (numerator, denominator);
        }
    }
    (any && largest.1 > 0.0).then(|| largest.0 / largest.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_difference_is_over_its_own_ordinate() {
        // differences 0.1 and 0.05: the first counts, over 2, although 0.05/0.1 is a larger ratio
        assert_eq!(error_of_median(&[2.1, 0.15], &[2.0, 0.1]), Some((2.1_f64 - 2.0) / 2.0));
        assert_eq!(range_of_interval(&[1.0, 0.0], &[2.0, 0.1], &[2.5, 0.2]), Some(0.75));
    }

    #[test]
    fn says_where_there_is_no_ratio() {
        assert_eq!(error_of_median(&[0.0; 3], &[0.0; 3]), Some(0.0));
        assert_eq!(error_of_median(&[0.1], &[0.0]), None);
        assert_eq!(error_of_median(&[f64::INFINITY], &[1.0]), None);
        assert_eq!(range_of_interval(&[0.1], &[0.2], &[f64::INFINITY]), None);
        assert_eq!(error_of_median(&[], &[]), None);
    }
}
