//! Reading a hazard curve at any level or rate: straight lines between its points in log–log axes.

use crate::curve::{HazardCurve, HazardPoint};
use crate::error::{HazardError, check_positive};

/// What to do with a value outside the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Extrapolation {
    /// It is an error.
    #[default]
    Refuse,
    /// The first or last segment is continued as a straight line in log–log axes.
    LogLog,
}

impl Extrapolation {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Refuse, Self::LogLog];

    /// Name in files and keys: refuse, loglog.
    pub fn key(self) -> &'static str {
        match self {
            Self::Refuse => "refuse",
            Self::LogLog => "loglog",
        }
    }
}

impl HazardCurve {
    /// Annual rate of exceeding `im` (in the curve's unit), 1/yr, by log–log interpolation; exact at the points.
    ///
    /// # Errors
    /// [`HazardError::LevelOutside`] outside the curve, [`HazardError::Argument`] unless `im` is finite and above 0.
    pub fn rate_at(&self, im: f64) -> Result<f64, HazardError> {
        self.rate_at_extrapolated(im, Extrapolation::Refuse)
    }

    /// [`HazardCurve::rate_at`] with a choice of what happens outside the curve.
    ///
    /// # Errors
    /// As [`HazardCurve::rate_at`]; with [`Extrapolation::LogLog`] instead of `LevelOutside` only
    /// [`HazardError::ExtrapolationRange`], where the result is no longer a finite number above 0.
    pub fn rate_at_extrapolated(&self, im: f64, extrapolation: Extrapolation) -> Result<f64, HazardError> {
        check_positive("intensity level", im)?;
        let (first, last) = (self.first(), self.last());
        let outside = im < first.im || im > last.im;
        if outside && extrapolation == Extrapolation::Refuse {
            return Err(HazardError::LevelOutside {
                measure: self.measure().to_owned(),
                value: im,
                unit: self.unit().to_owned(),
                first: first.im,
                last: last.im,
            });
        }
        let (left, right) = self.segment(self.im().partition_point(|&level| level < im));
        let rate = log_log((left.im, left.maf), (right.im, right.maf), im);
        self.check_range(rate, im, self.unit(), outside)
    }

    /// Level, in the curve's unit, that is exceeded at an annual `rate`, 1/yr: the uniform hazard value. Inverse of
    /// [`HazardCurve::rate_at`].
    ///
    /// # Errors
    /// [`HazardError::RateOutside`] outside the curve, [`HazardError::Argument`] unless `rate` is finite and above 0.
    pub fn im_at_rate(&self, rate: f64) -> Result<f64, HazardError> {
        self.im_at_rate_extrapolated(rate, Extrapolation::Refuse)
    }

    /// [`HazardCurve::im_at_rate`] with a choice of what happens outside the curve.
    ///
    /// # Errors
    /// As [`HazardCurve::im_at_rate`]; with [`Extrapolation::LogLog`] instead of `RateOutside` only
    /// [`HazardError::ExtrapolationRange`], where the result is no longer a finite number above 0.
    pub fn im_at_rate_extrapolated(&self, rate: f64, extrapolation: Extrapolation) -> Result<f64, HazardError> {
        check_positive("annual rate [1/yr]", rate)?;
        let (first, last) = (self.first(), self.last());
        let outside = rate > first.maf || rate < last.maf;
        if outside && extrapolation == Extrapolation::Refuse {
            let measure = self.measure().to_owned();
            return Err(HazardError::RateOutside { measure, value: rate, first: first.maf, last: last.maf });
        }
        let (left, right) = self.segment(self.maf().partition_point(|&maf| maf > rate));
        let im = log_log((left.maf, left.im), (right.maf, right.im), rate);
        self.check_range(im, rate, "1/yr", outside)
    }

    /// The segment that ends at point `end`; the first or last one for ends outside.
    fn segment(&self, end: usize) -> (HazardPoint, HazardPoint) {
        let end = end.clamp(1, self.len() - 1);
        (self.point(end - 1), self.point(end))
    }

    fn check_range(&self, result: f64, value: f64, unit: &str, outside: bool) -> Result<f64, HazardError> {
        if result.is_finite() && result > 0.0 {
            return Ok(result);
        }
        debug_assert!(outside, "interpolation stays between two valid points");
        let (measure, unit) = (self.measure().to_owned(), unit.to_owned());
        Err(HazardError::ExtrapolationRange { measure, value, unit })
    }
}

/// The straight line through two points in log–log axes, at `x`; between the points never outside their ordinates.
fn log_log((x0, y0): (f64, f64), (x1, y1): (f64, f64), x: f64) -> f64 {
    if x == x0 {
        return y0;
    }
    if x == x1 {
        return y1;
    }
    let slope = ln_ratio(y1, y0) / ln_ratio(x1, x0);
    let exponent = slope * ln_ratio(x, x0);
    let y = if exponent.abs() < 700.0 { y0 * exponent.exp() } else { (y0.ln() + exponent).exp() };
    if x > x0.min(x1) && x < x0.max(x1) { y.clamp(y0.min(y1), y0.max(y1)) } else { y }
}

/// ln(a/b) for positive a and b, without overflow, and with all digits where they are close.
fn ln_ratio(a: f64, b: f64) -> f64 {
    let ratio = a / b;
    if ratio > 0.5 && ratio < 2.0 {
        ((a - b) / b).ln_1p()
    } else if ratio.is_normal() {
        ratio.ln()
    } else {
        a.ln() - b.ln()
    }
}
