//! What weights that hold a known hazard leave of the scatter of units.

use uplift_instructions::{Instructions, Vectors, Work};

use crate::skewed_mean::sums;

/// What is left of a direction that the others have, as a share of it.
const NOTHING: f64 = 1e-9;

/// The combinations of known rates that weights hold, as units move them.
///
/// A rate by weights that are solved anew for every sample deviates less than its units do: what moves the known rates
/// as well is taken back. What is left is the residual of the deviations after their regression on how the units move
/// those (Deville and Särndal), over 1 − h with the leverage h of the unit: what the residual is without it (the
/// jackknife). The variance of the residuals is at most that of the deviations. Where units do not count alike, G of
/// them that did would tell as much. Where these are no more than the combinations and one, any deviations are fitted,
/// and nothing is taken back.
///
/// # Source
/// J.-C. Deville, C.-E. Särndal, J. Am. Stat. Assoc. 87 (1992), 376–382; J. G. `MacKinnon`, H. White, J. Econometrics
/// 29 (1985), 305–325.
#[derive(Debug, Clone)]
pub(crate) struct Calibration {
    /// Orthonormal, `[direction][unit]`, filled up with zeros as all lists of units are.
    directions: Vec<Vec<f64>>,
    /// 1/(1 − h)² of each unit.
    leverage: Vec<f64>,
    /// Both multiplied, `[direction][unit]`.
    levered: Vec<Vec<f64>>,
    /// Σ of the products of two directions and the leverage, `[direction][direction]`.
    products: Vec<Vec<f64>>,
}

impl Calibration {
    /// Of the records of each unit, `[unit]`, and how they move each combination, `[combination][record]`, in lists of
    /// so many places. None where nothing is held, and where one unit moves a combination alone: of that nothing is
    /// known without it.
    pub(crate) fn new(units: &[Vec<usize>], calibration: &[Vec<f64>], places: usize) -> Option<Self> {
        let mut directions: Vec<Vec<f64>> = Vec::new();
        for combination in calibration {
            let mut own: Vec<f64> =
                units.iter().map(|records| records.iter().map(|&record| combination[record]).sum()).collect();
            own.resize(places, 0.0);
            let whole = length(&own);
            // twice is enough for rounding
            for other in directions.iter().chain(&directions) {
                let shared = dot(&own, other);
                own.iter_mut().zip(other).for_each(|(own, other)| *own -= shared * other);
            }
            let rest = length(&own);
            if rest > NOTHING * whole {
                for own in &mut own {
                    *own /= rest;
                }
                directions.push(own);
            }
        }
        let of_unit = |unit: usize| {
            let h = 1.0 / units.len() as f64 + directions.iter().map(|own| own[unit] * own[unit]).sum::<f64>();
            (h < 1.0 - NOTHING).then(|| (1.0 - h).powi(-2))
        };
        let mut leverage: Vec<f64> = (0..units.len()).map(of_unit).collect::<Option<_>>()?;
        leverage.resize(places, 0.0);
        let levered: Vec<Vec<f64>> = directions
            .iter()
            .map(|own| own.iter().zip(&leverage).map(|(own, leverage)| own * leverage).collect())
            .collect();
        let products = levered.iter().map(|own| directions.iter().map(|other| dot(own, other)).collect()).collect();
        (!directions.is_empty()).then_some(Self { directions, leverage, levered, products })
    }

    /// The share of their variance that is left of the `deviations` of units, with the sum of their squares and to how
    /// many units that count alike they amount.
    pub(crate) fn variance_left(
        &self,
        instructions: Instructions,
        (deviations, squares): (&[f64], f64),
        effective_units: f64,
    ) -> f64 {
        // so many combinations fit any deviations of so few units
        if effective_units - 1.0 <= self.directions.len() as f64 {
            return 1.0;
        }
        let left = self.squares_left(instructions, deviations) / squares;
        // of units that do not deviate all is left
        if left.is_nan() { 1.0 } else { left.min(1.0) }
    }

    /// Σ of the squares of what is left of the `deviations` of units.
    fn squares_left(&self, instructions: Instructions, deviations: &[f64]) -> f64 {
        instructions.run(SquaresLeft { calibration: self, deviations })
    }
}

/// See [`Calibration::squares_left`]: Σ g (d − Σ a q)² with a = Σ q d, multiplied out.
struct SquaresLeft<'a> {
    calibration: &'a Calibration,
    deviations: &'a [f64],
}

impl Work for SquaresLeft<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<V: Vectors>(self, _: V) -> Self::Output {
        let Calibration { directions, leverage, levered, products } = self.calibration;
        let [mut left] = sums([self.deviations, leverage], |[deviation, leverage]| [deviation * deviation * leverage]);
        let mut shared = Vec::with_capacity(directions.len());
        for (direction, levered) in directions.iter().zip(levered) {
            let terms = |[deviation, own, levered]: [f64; 3]| [deviation * own, deviation * levered];
            let [plain, by_leverage] = sums([self.deviations, direction, levered], terms);
            left -= 2.0 * plain * by_leverage;
            shared.push(plain);
        }
        for (own, products) in shared.iter().zip(products) {
            left += own * dot(&shared, products);
        }
        left.max(0.0)
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

fn length(own: &[f64]) -> f64 {
    dot(own, own).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CALIBRATION: [[f64; 6]; 2] = [[-2.0, -1.0, 0.5, 0.5, 1.5, 0.5], [1.0, -1.5, 0.5, 1.0, -0.5, -0.5]];
    const DEVIATIONS: [f64; 6] = [3.0, -1.0, 0.5, -1.5, -2.0, 1.0];

    fn alone() -> Vec<Vec<usize>> {
        (0..6).map(|record| vec![record]).collect()
    }

    fn left_of(calibration: &[Vec<f64>], units: &[Vec<usize>], deviations: &[f64]) -> Option<f64> {
        let found = Calibration::new(units, calibration, 8)?;
        let deviations: Vec<f64> = [deviations, &[0.0; 8][deviations.len()..]].concat();
        Some(found.squares_left(Instructions::chosen(), &deviations))
    }

    /// The regression of the deviations of all units but one on their mean and one combination, and what it misses of
    /// that one.
    fn missed(unit: usize, x: &[f64], y: &[f64]) -> f64 {
        let others = || (0..y.len()).filter(move |own| *own != unit);
        let n = (y.len() - 1) as f64;
        let mean = |of: &[f64]| others().map(|own| of[own]).sum::<f64>() / n;
        let (x_mean, y_mean) = (mean(x), mean(y));
        let slope = others().map(|own| (x[own] - x_mean) * (y[own] - y_mean)).sum::<f64>()
            / others().map(|own| (x[own] - x_mean).powi(2)).sum::<f64>();
        y[unit] - y_mean - slope * (x[unit] - x_mean)
    }

    #[test]
    fn each_unit_deviates_from_the_regression_of_the_others() {
        let found = left_of(&[CALIBRATION[0].to_vec()], &alone(), &DEVIATIONS).unwrap();
        let expected: f64 = (0..6).map(|unit| missed(unit, &CALIBRATION[0], &DEVIATIONS).powi(2)).sum();
        assert!((found - expected).abs() < 1e-12 * expected, "{found} {expected}");
    }

    #[test]
    fn what_the_weights_hold_does_not_scatter() {
        let calibration = CALIBRATION.map(Vec::from);
        let held: Vec<f64> = (0..6).map(|unit| 0.3 * CALIBRATION[0][unit] - 2.0 * CALIBRATION[1][unit]).collect();
        let left = left_of(&calibration, &alone(), &held).unwrap();
        assert!(left < 1e-12, "{left}");
        // a combination given twice, or in another unit, holds no more
        let more = [&calibration[..], &[CALIBRATION[0].map(|own: f64| 980.665 * own).to_vec()]].concat();
        let [one, two] = [&calibration[..], &more].map(|own| left_of(own, &alone(), &DEVIATIONS).unwrap());
        assert!((one - two).abs() < 1e-9 * one, "{one} {two}");
    }

    // one combination: 3 units tell the residuals' share, 2 nothing of what is left
    #[test]
    fn few_units_that_count_alike_tell_nothing_of_what_is_left() {
        let deviations: [f64; 6] = std::array::from_fn(|unit| 3.0 * CALIBRATION[0][unit] + 0.1 * DEVIATIONS[unit]);
        let found = Calibration::new(&alone(), &[CALIBRATION[0].to_vec()], 6).unwrap();
        let squares = dot(&deviations, &deviations);
        let of_residuals = found.squares_left(Instructions::chosen(), &deviations) / squares;
        let left = |units: f64| found.variance_left(Instructions::chosen(), (&deviations, squares), units);
        assert!([6.0, 3.0].map(left) == [of_residuals; 2] && of_residuals < 0.1, "{of_residuals}");
        assert_eq!([left(2.0), left(1.2)], [1.0; 2]);
        assert_eq!(found.variance_left(Instructions::chosen(), (&[0.0; 6], 0.0), 6.0), 1.0);
    }

    #[test]
    fn nothing_is_known_where_a_unit_moves_a_combination_alone() {
        assert_eq!(left_of(&[], &alone(), &DEVIATIONS), None);
        assert_eq!(left_of(&[vec![-1.0, 0.2, 0.2, 0.2, 0.2, 0.2]], &alone(), &DEVIATIONS), None);
        // three earthquakes are as many as two combinations and the mean
        let earthquakes = [vec![0, 1], vec![2, 3], vec![4, 5]];
        assert_eq!(left_of(&CALIBRATION.map(Vec::from), &earthquakes, &[2.0, -1.0, -1.0]), None);
        let one = left_of(&[CALIBRATION[0].to_vec()], &earthquakes, &[2.0, -1.0, -1.0]).unwrap();
        let expected: f64 = (0..3).map(|unit| missed(unit, &[-3.0, 1.0, 2.0], &[2.0, -1.0, -1.0]).powi(2)).sum();
        // multiplied out it loses some digits
        assert!((one - expected).abs() < 1e-11 * expected, "{one} {expected}");
    }
}
