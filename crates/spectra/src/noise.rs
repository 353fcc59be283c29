//! How much a value moves in a small sweep around its point.
//!
//! Rocking is chaotic: a median of some thirty responses can move by nearly half when the strength changes by one
//! percent. A comparison with someone else's value means little without that noise beside it.

use uplift_structure::relative_error;

use crate::error::SpectraError;

/// A relative change of the scale factors that is nothing but rounding: some last places of a double.
///
/// A response of hundreds of impacts may turn it into a displacement of another size (docs/method.md, section 1.5).
pub const ROUNDING: f64 = 1e-15;

/// How many neighbours of its scale factor a run is repeated at, to see whether rounding decides it.
///
/// Of the medians that rounding moves, each neighbour shows some: how many are still missed by so many of them is in
/// docs/method.md, section 1.5.
pub const NUDGES: usize = 8;

/// What scale factors are multiplied by to see what rounding does: 1, 2, … times [`ROUNDING`] smaller and larger.
pub fn nudges() -> [f64; NUDGES] {
    std::array::from_fn(|place| {
        let (step, sign) = (place / 2 + 1, if place % 2 == 0 { -1.0 } else { 1.0 });
        1.0 + sign * step as f64 * ROUNDING
    })
}

/// A sweep around a point, relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseSweep {
    relative: f64,
    points: usize,
}

impl NoiseSweep {
    /// No sweep: the point itself.
    pub(crate) const POINT: Self = Self { relative: 0.0, points: 1 };

    /// `points` points, an odd number so that the middle one is the point itself, from `1 − relative` to `1 + relative`
    /// times it.
    ///
    /// # Errors
    /// [`SpectraError::OutOfRange`] for a width outside 0 to 0.5, and for an even number of points.
    pub fn new(relative: f64, points: usize) -> Result<Self, SpectraError> {
        if !(0.0..=0.5).contains(&relative) {
            let requirement = "from 0 to 0.5, a part of the strength";
            return Err(SpectraError::OutOfRange { name: "width of the noise sweep", value: relative, requirement });
        }
        if points.is_multiple_of(2) {
            let (name, value) = ("points of the noise sweep", points as f64);
            return Err(SpectraError::OutOfRange { name, value, requirement: "an odd number" });
        }
        Ok(Self { relative, points })
    }

    /// The factors, ascending; exactly 1 in the middle.
    pub fn factors(&self) -> Vec<f64> {
        let half = self.points / 2;
        (0..self.points).map(|point| 1.0 + self.relative * (point as f64 - half as f64) / half.max(1) as f64).collect()
    }
}

/// A value with its range over a sweep.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Noisy {
    /// At the point itself.
    pub value: f64,
    /// Lowest of the sweep.
    pub lowest: f64,
    /// Highest of the sweep.
    pub highest: f64,
}

impl Noisy {
    /// Of the values over a sweep; the middle one counts as the point itself. NaN without any.
    pub fn from_sweep(sweep: &[f64]) -> Self {
        Self::around(sweep.get(sweep.len() / 2).copied().unwrap_or(f64::NAN), sweep.iter().copied())
    }

    /// Of a value, and others that it might as well have been.
    pub fn around(value: f64, others: impl IntoIterator<Item = f64>) -> Self {
        others.into_iter().fold(Self { value, lowest: value, highest: value }, |range, other| Self {
            // what does not exist leaves no range
            lowest: if other.is_nan() || other < range.lowest { other } else { range.lowest },
            highest: if other.is_nan() || other > range.highest { other } else { range.highest },
            ..range
        })
    }

    /// Whether an end of the range is `shown` otherwise than the value.
    pub fn shows_otherwise(&self, shown: impl Fn(f64) -> String) -> bool {
        let value = shown(self.value);
        shown(self.lowest) != value || shown(self.highest) != value
    }

    /// The value as it is `shown`, with an asterisk where an end of the range is shown otherwise.
    pub fn marked(&self, shown: impl Fn(f64) -> String) -> String {
        let mark = if self.shows_otherwise(&shown) { "*" } else { "" };
        format!("{}{mark}", shown(self.value))
    }

    /// Whether `other` lies in the range.
    pub fn holds(&self, other: f64) -> bool {
        self.lowest <= other && other <= self.highest
    }
}

/// Errors of demands against the exact ones, one by one; NaN where there is none to refer to.
pub(crate) fn errors(demands_m: &[f64], exact_m: &[f64]) -> Vec<f64> {
    demands_m.iter().zip(exact_m).map(|(demand, exact)| relative_error(*demand, *exact).unwrap_or(f64::NAN)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_a_sweep_is_the_point_itself() {
        assert_eq!(NoiseSweep::new(0.5, 5).unwrap().factors(), [0.5, 0.75, 1.0, 1.25, 1.5]);
        assert_eq!(NoiseSweep::new(0.01, 1).unwrap().factors(), [1.0]);
        assert_eq!(NoiseSweep::new(0.01, 21).unwrap().factors()[10], 1.0);
        for (relative, points) in [(-0.1, 3), (0.6, 3), (f64::NAN, 3), (0.1, 4), (0.1, 0)] {
            assert!(NoiseSweep::new(relative, points).is_err(), "{relative} {points}");
        }
    }

    #[test]
    fn nudges_are_neighbours_on_both_sides_and_each_another_double() {
        let mut bits: Vec<u64> = nudges().iter().map(|nudge| nudge.to_bits()).collect();
        bits.sort_unstable();
        bits.dedup();
        assert_eq!(bits.len(), NUDGES);
        assert_eq!(nudges().iter().filter(|nudge| **nudge < 1.0).count(), NUDGES / 2);
        assert!(nudges().iter().all(|nudge| (nudge - 1.0).abs() < 5.0 * ROUNDING && *nudge != 1.0));
    }

    #[test]
    fn a_range_that_other_digits_are_shown_of() {
        let shown = |value: f64| format!("{value:.2}");
        let of = |lowest, highest| Noisy { value: 0.04, lowest, highest };
        assert!(!of(0.0399, 0.0401).shows_otherwise(shown));
        assert!(of(0.01, 0.0401).shows_otherwise(shown) && of(0.04, f64::INFINITY).shows_otherwise(shown));
        assert_eq!((of(0.0399, 0.0401).marked(shown), of(0.01, 0.0401).marked(shown)), ("0.04".into(), "0.04*".into()));
    }

    #[test]
    fn a_range_holds_its_value_and_all_others() {
        let noisy = Noisy::from_sweep(&[3.0, 1.0, 2.0, f64::INFINITY, 4.0]);
        assert_eq!(noisy, Noisy { value: 2.0, lowest: 1.0, highest: f64::INFINITY });
        assert!(noisy.holds(1.0) && noisy.holds(1e9) && !noisy.holds(0.5));
        assert_eq!(Noisy::around(7.0, [1.0, 2.0]), Noisy { value: 7.0, lowest: 1.0, highest: 7.0 });
        assert!(Noisy::from_sweep(&[]).value.is_nan());
    }

    #[test]
    fn the_unsafe_end_of_a_range_is_kept() {
        let inf = f64::INFINITY;
        // the middle: the rule sees 1 m where time histories overturn
        let errors = errors(&[1.2, 1.0, 0.9, inf], &[1.0, inf, 1.0, inf]);
        let range = Noisy::from_sweep(&errors);
        assert_eq!((range.value, range.lowest), (0.9 - 1.0, -1.0));
        assert!((range.highest - 0.2).abs() < 1e-15);
        for undefined in [[f64::NAN, 1.0, 2.0], [2.0, 1.0, f64::NAN]] {
            let range = Noisy::from_sweep(&undefined);
            assert!(range.value == 1.0 && range.lowest.is_nan() && range.highest.is_nan());
        }
    }
}
