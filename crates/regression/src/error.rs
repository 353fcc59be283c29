//! Why a fit is not possible.

/// Data that Eq. 4.11 cannot be fitted to.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RegressionError {
    /// The two inputs differ in length.
    #[error("{strengths} strengths but {displacements} displacements; give one displacement per strength")]
    LengthMismatch {
        /// Number of strengths.
        strengths: usize,
        /// Number of displacements.
        displacements: usize,
    },
    /// Fewer points than three coefficients and one degree of freedom need.
    #[error("{points} points; three coefficients and an error estimate need at least 4")]
    TooFewPoints {
        /// Number of points.
        points: usize,
    },
    /// A value that is not a finite number.
    #[error("{what} at index {index} is {value}; leave censored or missing ordinates out of the fit")]
    NotFinite {
        /// "strength" or "displacement".
        what: &'static str,
        /// Index into the input, counted from 0.
        index: usize,
        /// The value found.
        value: f64,
    },
    /// Fewer than three different strengths.
    #[error("{distinct} different strengths; three coefficients need at least 3")]
    TooFewStrengths {
        /// Number of different strengths.
        distinct: usize,
    },
    /// All displacements are the same: any c1 fits equally well.
    #[error("all {points} displacements equal {value}: a constant does not determine c0 and c1")]
    Constant {
        /// Number of points.
        points: usize,
        /// The common value, m.
        value: f64,
    },
    /// A coefficient or an error leaves the range of numbers.
    #[error(
        "the fit with c1 = {c1} has {what} outside the range of numbers; scale the data or move the strengths nearer \
         to 0"
    )]
    Overflow {
        /// The exponent of the best fit.
        c1: f64,
        /// What overflows.
        what: &'static str,
    },
}
