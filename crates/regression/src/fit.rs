//! The fit of Eq. 4.11.

use crate::error::RegressionError;
use crate::reduced::{Reduced, Solution};
use crate::root::rising_root;

/// Smallest decay searched, |c1| times the range of strengths: here the exponential differs from a straight line
/// by 1e-4 of its drop.
const FLATTEST: f64 = 1e-3;
/// Largest decay searched, |c1| times the smallest distance between the end and the next strength: here all but the end
/// point see an exponential of 5e-18, a change of c1 no longer shows.
const STEEPEST: f64 = 40.0;
/// Decay in the same measure beyond which c1 is not resolved: the second strength sees 1e-13 of the end's exponential.
const UNRESOLVED: f64 = 30.0;
/// Cap on |c1| times the range, for strengths that nearly coincide.
const STEEPEST_OVER_RANGE: f64 = 1e6;
/// Scan points per decade of c1.
const SCAN_PER_DECADE: f64 = 10.0;
/// Displacements that agree to this share of the largest are constant: their differences are rounding.
const CONSTANT: f64 = 1e-13;

/// The curve u(η) = c0 exp(c1 η) + c2 (Eq. 4.11).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponential {
    /// Amplitude at η = 0, m.
    pub c0: f64,
    /// Exponent, per unit of η; negative where demand falls with strength.
    pub c1: f64,
    /// Offset, m.
    pub c2: f64,
}

impl Exponential {
    /// Displacement, m, at the normalised uplift strength η = `f_up`/(m g).
    pub fn at(&self, strength: f64) -> f64 {
        self.c0 * (self.c1 * strength).exp() + self.c2
    }
}

/// A fitted curve and how well it fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExponentialFit {
    /// Amplitude at η = 0, m.
    pub c0: f64,
    /// Exponent, per unit of η.
    pub c1: f64,
    /// Offset, m, not negative.
    pub c2: f64,
    /// Root mean square error with n − 3 degrees of freedom, m.
    pub rmse: f64,
    /// Root mean square error over all n points, m.
    pub rmse_plain: f64,
    /// Largest absolute residual, m.
    pub max_abs_residual: f64,
    /// Strength at which it occurs.
    pub max_abs_residual_strength: f64,
    /// c2 is held at 0: without the bound the best c2 would be negative.
    pub bound_active: bool,
    /// The best c1 lies at an end of the range searched: the data are a straight line or a step rather than an
    /// exponential, and the coefficients have no meaning one by one, though the curve is as near to the data
    /// as the range allows.
    pub at_search_limit: bool,
    /// Number of points fitted.
    pub points: usize,
}

impl ExponentialFit {
    /// The fitted curve, to evaluate.
    pub fn curve(&self) -> Exponential {
        Exponential { c0: self.c0, c1: self.c1, c2: self.c2 }
    }
}

/// Fits u = c0 exp(c1 η) + c2 (Eq. 4.11) with c2 ≥ 0 to `displacements` (m, or any unit) at
/// `strengths` η by least squares.
///
/// Neither c0 nor the sign of c1 is constrained; spectra give c0 > 0 and c1 < 0. The points may be in any order and
/// repeat strengths. Which ones to fit is the caller's choice (the dissertation takes η > 0.05).
///
/// For a given c1 the best c0 and c2 are known in closed form, so the search has one dimension: c1 of either sign, with
/// abs(c1) from 0.001/(range of strengths) to 40/(distance of the end strength from the next), at most 1e6/(range), the
/// exponentials between a straight line and a single point. It is scanned in steps of a factor 10^(1/10), across which
/// the exponential hardly changes its shape, and every change of the error's slope from falling to rising is solved for
/// a root of that slope, to the last digits of c1. The best of these minima and of the ends is the result. A better
/// minimum could hide between two scan points only if the exponentials there were nearly uncorrelated with the data.
///
/// # Errors
/// [`RegressionError`] for inputs of different length, fewer than 4 points, fewer than 3 different strengths, values
/// that are not finite, displacements that are all equal, and results outside the range of numbers.
///
/// # Source
/// Reggiani Manzo, dissertation, Section 4.6, Eq. 4.11 and Table 4.2.
pub fn fit(strengths: &[f64], displacements: &[f64]) -> Result<ExponentialFit, RegressionError> {
    check(strengths, displacements)?;
    let (low, high) = extremes(strengths);
    let range = high - low;
    // Scaling by a power of two changes no digit and keeps squares in range.
    let scale = power_of_two_below(displacements.iter().fold(0.0, |largest, u| u.abs().max(largest)));
    let u: Vec<f64> = displacements.iter().map(|u| u / scale).collect();

    let falling = Reduced::new(strengths.iter().map(|eta| (eta - low) / range).collect(), u.clone());
    let rising = Reduced::new(strengths.iter().map(|eta| (high - eta) / range).collect(), u);
    let (falling, falling_limit) = search(&falling);
    let (rising, rising_limit) = search(&rising);
    let (best, at_search_limit, c1, end) = if falling.sse <= rising.sse {
        (falling, falling_limit, -falling.s / range, low)
    } else {
        (rising, rising_limit, rising.s / range, high)
    };

    // In two steps, for amplitudes that only the whole product brings into range.
    let half = (-c1 * end / 2.0).exp();
    let c0 = best.amplitude * half * scale * half;
    let c2 = best.offset * scale;
    if !c0.is_normal() || !c1.is_finite() {
        return Err(RegressionError::Overflow { c1, what: "c0" });
    }
    if !c2.is_finite() {
        return Err(RegressionError::Overflow { c1, what: "c2" });
    }
    // Residuals with the exponential taken from its largest end, as accurate as the data.
    let residual = |eta: f64, u: f64| u - scale * (best.amplitude * (c1 * (eta - end)).exp() + best.offset);
    let (max_abs_residual, max_abs_residual_strength) = strengths
        .iter()
        .zip(displacements)
        .map(|(&eta, &u)| (residual(eta, u).abs(), eta))
        .fold((0.0, low), |largest, this| if this.0 > largest.0 { this } else { largest });
    let points = strengths.len();
    let rmse = |degrees: usize| (best.sse / degrees as f64).sqrt() * scale;
    Ok(ExponentialFit {
        c0,
        c1,
        c2,
        rmse: rmse(points - 3),
        rmse_plain: rmse(points),
        max_abs_residual,
        max_abs_residual_strength,
        bound_active: best.bound_active,
        at_search_limit,
        points,
    })
}

/// The best solution over all decays, and whether it is one of the two ends of the range.
fn search(problem: &Reduced) -> (Solution, bool) {
    let next = problem.x.iter().copied().filter(|&x| x > 0.0).fold(1.0, f64::min);
    let steepest = (STEEPEST / next).min(STEEPEST_OVER_RANGE);
    let steps = ((steepest / FLATTEST).log10() * SCAN_PER_DECADE).ceil();
    let ratio = (steepest / FLATTEST).powf(1.0 / steps);

    let mut last = problem.solve(FLATTEST);
    let mut best = last;
    while last.s < steepest {
        // The end itself, not the number next to it by rounding.
        let s = if last.s * ratio < steepest / ratio.sqrt() { last.s * ratio } else { steepest };
        let this = problem.solve(s);
        if this.sse < best.sse {
            best = this;
        }
        if last.slope < 0.0 && this.slope >= 0.0 {
            let root = rising_root(|s| problem.solve(s).slope, (last.s, last.slope), (this.s, this.slope));
            let minimum = problem.solve(root);
            if minimum.sse <= best.sse {
                best = minimum;
            }
        }
        last = this;
    }
    let at_limit = best.s <= FLATTEST || best.s >= steepest || best.s * next > UNRESOLVED;
    (best, at_limit)
}

fn check(strengths: &[f64], displacements: &[f64]) -> Result<(), RegressionError> {
    if strengths.len() != displacements.len() {
        let (strengths, displacements) = (strengths.len(), displacements.len());
        return Err(RegressionError::LengthMismatch { strengths, displacements });
    }
    let points = strengths.len();
    for (what, values) in [("strength", strengths), ("displacement", displacements)] {
        if let Some((index, &value)) = values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            return Err(RegressionError::NotFinite { what, index, value });
        }
    }
    if points < 4 {
        return Err(RegressionError::TooFewPoints { points });
    }
    let (low, high) = extremes(strengths);
    let between = strengths.iter().any(|&eta| low < eta && eta < high);
    if !between {
        return Err(RegressionError::TooFewStrengths { distinct: if low < high { 2 } else { 1 } });
    }
    let (smallest, largest) = extremes(displacements);
    // Halves, since the difference of two finite numbers may overflow.
    if largest / 2.0 - smallest / 2.0 <= CONSTANT * (largest / 2.0).abs().max((smallest / 2.0).abs()) {
        return Err(RegressionError::Constant { points, value: displacements[0] });
    }
    if !(high - low).is_finite() {
        return Err(RegressionError::Overflow { c1: 0.0, what: "the range of strengths" });
    }
    Ok(())
}

fn extremes(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)))
}

/// The power of two not above `value` (positive and finite).
fn power_of_two_below(value: f64) -> f64 {
    let exponent_bits = value.to_bits() & (0x7ff << 52);
    // Subnormal numbers have no exponent of their own.
    f64::from_bits(exponent_bits).max(f64::MIN_POSITIVE)
}
