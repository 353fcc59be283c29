//! A straight line by ordinary least squares, with the test of its slope.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::RegressionError;

/// The line y = intercept + slope x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Value at x = 0.
    pub intercept: f64,
    /// Change of y with x.
    pub slope: f64,
    /// Standard error of the slope.
    pub slope_error: f64,
    /// Probability of a slope at least as steep, up or down, if there were none: Student's t with n −
    /// 2 degrees of freedom.
    pub p_value: f64,
    /// Share of the variance of y that the line explains; NaN where y does not vary.
    pub r_squared: f64,
    /// Points fitted.
    pub points: usize,
}

/// The line of least squares through `(x, y)`.
///
/// # Errors
/// Inputs of different lengths, fewer than three points, a value that is not finite, or an x that does not vary.
pub fn fit_line(x: &[f64], y: &[f64]) -> Result<Line, RegressionError> {
    if x.len() != y.len() {
        return Err(RegressionError::LengthMismatch { strengths: x.len(), displacements: y.len() });
    }
    if x.len() < 3 {
        return Err(RegressionError::TooFewPoints { points: x.len() });
    }
    for (what, values) in [("x", x), ("y", y)] {
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            return Err(RegressionError::NotFinite { what, index, value: values[index] });
        }
    }
    let n = x.len() as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / n;
    let (mean_x, mean_y) = (mean(x), mean(y));
    let sum = |a: &[f64], mean_a: f64, b: &[f64], mean_b: f64| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - mean_a) * (b - mean_b)).sum()
    };
    let (xx, xy, yy) = (sum(x, mean_x, x, mean_x), sum(x, mean_x, y, mean_y), sum(y, mean_y, y, mean_y));
    // the rounding of the mean alone leaves about this
    if xx <= n * (mean_x * f64::EPSILON).powi(2) {
        return Err(RegressionError::TooFewStrengths { distinct: 1 });
    }
    let slope = xy / xx;
    let intercept = mean_y - slope * mean_x;
    let residual: f64 = x.iter().zip(y).map(|(x, y)| (y - intercept - slope * x).powi(2)).sum();
    let slope_error = (residual / (n - 2.0) / xx).sqrt();
    let p_value = if slope_error > 0.0 {
        StudentsT::new(0.0, 1.0, n - 2.0).map_or(f64::NAN, |t| 2.0 * t.sf((slope / slope_error).abs()))
    } else if slope == 0.0 {
        1.0
    } else {
        0.0
    };
    let r_squared = if yy > 0.0 { 1.0 - residual / yy } else { f64::NAN };
    Ok(Line { intercept, slope, slope_error, p_value, r_squared, points: x.len() })
}

#[cfg(test)]
mod tests {
    use super::*;

    // By hand: mean x 2, mean y 3; Sxx = 2, Sxy = 2, slope 1, intercept 1; residuals 1, −2, 1: s² = 6, error √3,
    // t = 1/√3 with one degree of freedom (Cauchy): p = 1 − 2/π atan(1/√3) = 1 − 1/3.
    #[test]
    fn three_points_by_hand() {
        let line = fit_line(&[1.0, 2.0, 3.0], &[3.0, 1.0, 5.0]).unwrap();
        assert!((line.slope - 1.0).abs() < 1e-14 && (line.intercept - 1.0).abs() < 1e-14);
        assert!((line.slope_error - 3.0_f64.sqrt()).abs() < 1e-14);
        assert!((line.p_value - 2.0 / 3.0).abs() < 1e-10, "{}", line.p_value);
        assert!((line.r_squared - 0.25).abs() < 1e-14);
    }

    #[test]
    fn a_line_is_met_exactly_and_a_constant_has_no_slope() {
        let line = fit_line(&[0.0, 1.0, 2.0, 4.0], &[1.0, 3.0, 5.0, 9.0]).unwrap();
        assert!((line.slope - 2.0).abs() < 1e-14 && line.p_value < 1e-12 && line.r_squared > 1.0 - 1e-12);
        let flat = fit_line(&[0.0, 1.0, 2.0], &[0.5; 3]).unwrap();
        assert_eq!((flat.slope, flat.p_value), (0.0, 1.0));
        assert!(flat.r_squared.is_nan());
    }

    #[test]
    fn refuses_what_has_no_line() {
        assert!(fit_line(&[1.0, 2.0], &[1.0, 2.0]).is_err());
        assert!(fit_line(&[1.0, 2.0, 3.0], &[1.0, 2.0]).is_err());
        assert!(fit_line(&[6.3; 5], &[1.0, 2.0, 3.0, 4.0, 5.0]).is_err());
        assert!(fit_line(&[1.0, 2.0, f64::NAN], &[1.0, 2.0, 3.0]).is_err());
    }
}
