//! One quantity that is not known exactly.

use statrs::distribution::{ContinuousCDF, Normal, Triangular, Uniform};

use crate::UncertaintyError;

/// Largest share of an unbounded distribution that may lie where the quantity cannot be.
const MOST_CUT_OFF: f64 = 0.25;

/// Form of a distribution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// The logarithm is normal.
    Lognormal,
    /// Gaussian.
    Normal,
    /// Every value between two limits alike.
    Uniform,
    /// Density that rises straight to the mode and falls straight from it.
    Triangular,
}

impl Family {
    /// Every family.
    pub const ALL: [Self; 4] = [Self::Lognormal, Self::Normal, Self::Uniform, Self::Triangular];

    /// Its word.
    pub fn key(self) -> &'static str {
        match self {
            Self::Lognormal => "lognormal",
            Self::Normal => "normal",
            Self::Uniform => "uniform",
            Self::Triangular => "triangular",
        }
    }
}

/// The distribution of one quantity, within the range that it can have.
///
/// Of an unbounded family what lies outside of that range is cut off, and the rest raised to 1; a bounded one that
/// reaches beyond it is refused.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    shape: Shape,
    range: [f64; 2],
    /// The distribution function at the ends of the range.
    kept: [f64; 2],
}

#[derive(Debug, Clone, PartialEq)]
enum Shape {
    Constant(f64),
    /// Of the logarithm.
    Lognormal(Normal),
    Normal(Normal),
    Uniform(Uniform),
    Triangular(Triangular),
}

impl Distribution {
    /// Of a `mean` and a coefficient of variation, standard deviation over mean: `(mean, variation)`. Uniform and
    /// triangular ones are symmetric; of a coefficient of 0 the quantity is known.
    ///
    /// `range`: the least and the most that it can be.
    ///
    /// # Errors
    /// A mean outside of the range, or of a lognormal one not above 0, or of 0 that has a scatter; a coefficient below
    /// 0; a distribution of which too much lies outside.
    pub fn from_mean(family: Family, (mean, variation): (f64, f64), range: [f64; 2]) -> Result<Self, UncertaintyError> {
        let within = (range[0]..=range[1]).contains(&mean) && (family != Family::Lognormal || mean > 0.0);
        check("the mean", mean, within && mean.is_finite(), "within what the quantity can be")?;
        check("the coefficient of variation", variation, (0.0..=10.0).contains(&variation), "from 0 to 10")?;
        let is_scattering = variation > 0.0;
        check("the mean", mean, mean != 0.0 || !is_scattering, "other than 0, since a share of 0 is 0")?;
        let deviation = variation * mean.abs();
        if deviation == 0.0 {
            return Self::within(Shape::Constant(mean), range);
        }
        match family {
            Family::Lognormal => {
                let variance = (variation * variation).ln_1p();
                Self::within(Shape::Lognormal(normal(mean.ln() - 0.5 * variance, variance.sqrt())?), range)
            }
            Family::Normal => Self::within(Shape::Normal(normal(mean, deviation)?), range),
            Family::Uniform => {
                let half = 3.0_f64.sqrt() * deviation;
                Self::from_limits([mean - half, mean + half], None, range)
            }
            Family::Triangular => {
                let half = 6.0_f64.sqrt() * deviation;
                Self::from_limits([mean - half, mean + half], Some(mean), range)
            }
        }
    }

    /// Of two percentiles, each a percentage between 0 and 100 and its value, the lower one first. They are those of
    /// the whole distribution, before anything is cut off; a triangular one is symmetric.
    ///
    /// # Errors
    /// Percentiles that do not rise, or of a lognormal one not above 0; a distribution of which too much lies outside
    /// of `range`.
    pub fn from_percentiles(
        family: Family,
        [(first, first_value), (second, second_value)]: [(f64, f64); 2],
        range: [f64; 2],
    ) -> Result<Self, UncertaintyError> {
        for percentage in [first, second] {
            check("the percentage", percentage, percentage > 0.0 && percentage < 100.0, "above 0 and below 100")?;
        }
        let values = [first_value, second_value];
        if !(first < second && first_value < second_value && values.iter().all(|value| value.is_finite())) {
            return Err(UncertaintyError::Percentiles { first, first_value, second, second_value });
        }
        let shares = [first / 100.0, second / 100.0];
        // location and scale of a family whose standard quantiles are `standard`, so that it has these values
        let fit = |standard: [f64; 2], [low, high]: [f64; 2]| {
            let scale = (high - low) / (standard[1] - standard[0]);
            (low - scale * standard[0], scale)
        };
        match family {
            Family::Normal | Family::Lognormal => {
                let unit = normal(0.0, 1.0)?;
                let standard = shares.map(|share| unit.inverse_cdf(share));
                if family == Family::Normal {
                    let (mean, deviation) = fit(standard, values);
                    return Self::within(Shape::Normal(normal(mean, deviation)?), range);
                }
                check("the lower percentile of a lognormal quantity", first_value, first_value > 0.0, "above 0")?;
                let (mean, deviation) = fit(standard, values.map(f64::ln));
                Self::within(Shape::Lognormal(normal(mean, deviation)?), range)
            }
            Family::Uniform => {
                let (lower, width) = fit(shares, values);
                Self::from_limits([lower, lower + width], None, range)
            }
            Family::Triangular => {
                let unit = triangular([-1.0, 1.0], 0.0)?;
                let (mode, half) = fit(shares.map(|share| unit.inverse_cdf(share)), values);
                Self::from_limits([mode - half, mode + half], Some(mode), range)
            }
        }
    }

    /// Between two limits: triangular with a `mode`, uniform without.
    ///
    /// # Errors
    /// Limits that do not rise, a mode outside of them, limits outside of `range`.
    pub fn from_limits([lower, upper]: [f64; 2], mode: Option<f64>, range: [f64; 2]) -> Result<Self, UncertaintyError> {
        let middle = mode.unwrap_or(0.5 * (lower + upper));
        if !(lower < upper && (lower..=upper).contains(&middle) && lower.is_finite() && upper.is_finite()) {
            return Err(UncertaintyError::Limits { lower, mode: middle, upper });
        }
        let [least, most] = range;
        if lower < least || upper > most {
            return Err(UncertaintyError::Beyond { lower, upper, least, most });
        }
        let shape = match mode {
            Some(mode) => Shape::Triangular(triangular([lower, upper], mode)?),
            None => Shape::Uniform(uniform([lower, upper])?),
        };
        Self::within(shape, range)
    }

    fn within(shape: Shape, range: [f64; 2]) -> Result<Self, UncertaintyError> {
        let kept = match &shape {
            Shape::Lognormal(of_logarithm) => range.map(|end| if end > 0.0 { of_logarithm.cdf(end.ln()) } else { 0.0 }),
            Shape::Normal(normal) => range.map(|end| normal.cdf(end)),
            Shape::Constant(_) | Shape::Uniform(_) | Shape::Triangular(_) => [0.0, 1.0],
        };
        let share = 1.0 - (kept[1] - kept[0]);
        if !(share <= MOST_CUT_OFF) {
            return Err(UncertaintyError::CutOff { share, least: range[0], most: range[1] });
        }
        Ok(Self { shape, range, kept })
    }

    /// The value that it has where the quantity is known; none where it is uncertain.
    pub fn constant(&self) -> Option<f64> {
        match self.shape {
            Shape::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// The family; none of a quantity that is known.
    pub fn family(&self) -> Option<Family> {
        match self.shape {
            Shape::Constant(_) => None,
            Shape::Lognormal(_) => Some(Family::Lognormal),
            Shape::Normal(_) => Some(Family::Normal),
            Shape::Uniform(_) => Some(Family::Uniform),
            Shape::Triangular(_) => Some(Family::Triangular),
        }
    }

    /// The share that was cut off where the quantity cannot be, 0 to 1.
    pub fn cut_off_share(&self) -> f64 {
        1.0 - (self.kept[1] - self.kept[0])
    }

    /// The value that a share `probability` of it does not exceed; the ends of its range at 0 and 1.
    pub fn quantile(&self, probability: f64) -> f64 {
        let [below, above] = self.kept;
        let share = (below + probability.clamp(0.0, 1.0) * (above - below)).clamp(0.0, 1.0);
        let value = match &self.shape {
            Shape::Constant(value) => return *value,
            Shape::Lognormal(of_logarithm) => of_logarithm.inverse_cdf(share).exp(),
            Shape::Normal(normal) => normal.inverse_cdf(share),
            Shape::Uniform(uniform) => uniform.inverse_cdf(share),
            Shape::Triangular(triangular) => triangular.inverse_cdf(share),
        };
        value.clamp(self.range[0], self.range[1])
    }
}

fn check(name: &'static str, value: f64, holds: bool, requirement: &'static str) -> Result<(), UncertaintyError> {
    if holds { Ok(()) } else { Err(UncertaintyError::OutOfRange { name, value, requirement }) }
}

fn normal(mean: f64, deviation: f64) -> Result<Normal, UncertaintyError> {
    let fail = |_| UncertaintyError::OutOfRange { name: "the deviation", value: deviation, requirement: "above 0" };
    Normal::new(mean, deviation).map_err(fail)
}

fn uniform([lower, upper]: [f64; 2]) -> Result<Uniform, UncertaintyError> {
    Uniform::new(lower, upper).map_err(|_| UncertaintyError::Limits { lower, mode: 0.5 * (lower + upper), upper })
}

fn triangular([lower, upper]: [f64; 2], mode: f64) -> Result<Triangular, UncertaintyError> {
    Triangular::new(lower, upper, mode).map_err(|_| UncertaintyError::Limits { lower, mode, upper })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    /// Mean and coefficient of variation by the midpoint rule over the quantiles.
    fn moments(of: &Distribution) -> (f64, f64) {
        let count = 200_000;
        let values = (0..count).map(|index| of.quantile((f64::from(index) + 0.5) / f64::from(count)));
        let (sum, squares) = values.fold((0.0, 0.0), |(sum, squares), value| (sum + value, squares + value * value));
        let mean = sum / f64::from(count);
        (mean, (squares / f64::from(count) - mean * mean).sqrt() / mean)
    }

    #[test]
    fn mean_and_coefficient_of_variation_are_those_asked_for() {
        for family in Family::ALL {
            let of = Distribution::from_mean(family, (0.12, 0.3), ANY).unwrap();
            let (mean, variation) = moments(&of);
            assert!((mean - 0.12).abs() < 1e-5 && (variation - 0.3).abs() < 1e-3, "{family:?}: {mean} {variation}");
            assert_eq!((of.cut_off_share(), of.constant(), of.family()), (0.0, None, Some(family)));
            let known = Distribution::from_mean(family, (0.12, 0.0), ANY).unwrap();
            assert_eq!((known.quantile(0.01), known.constant(), known.family()), (0.12, Some(0.12), None));
        }
    }

    #[test]
    fn percentiles_are_those_asked_for() {
        for family in Family::ALL {
            let of = Distribution::from_percentiles(family, [(16.0, 0.08), (95.0, 0.15)], ANY).unwrap();
            for (share, value) in [(0.16, 0.08), (0.95, 0.15)] {
                assert!((of.quantile(share) - value).abs() < 1e-9, "{family:?}: {}", of.quantile(share));
            }
        }
        let falling = Distribution::from_percentiles(Family::Normal, [(95.0, 0.15), (5.0, 0.1)], ANY);
        assert!(matches!(falling, Err(UncertaintyError::Percentiles { .. })));
    }

    /// Of a normal quantity of mean 0.95 and deviation 0.05 the share above 1 is that beyond one deviation.
    #[test]
    fn what_cannot_be_is_cut_off_and_said() {
        let of = Distribution::from_mean(Family::Normal, (0.95, 0.05 / 0.95), [0.0, 1.0]).unwrap();
        assert!((of.cut_off_share() - 0.158_655_253_931).abs() < 1e-9);
        assert!((of.quantile(1.0) - 1.0).abs() < 1e-9 && of.quantile(0.999) < 1.0);
        // the median of what is left: Φ⁻¹(0.5 · 0.841344746)
        assert!((of.quantile(0.5) - (0.95 - 0.05 * 0.200_174_4)).abs() < 1e-6, "{}", of.quantile(0.5));
        let wide = Distribution::from_mean(Family::Normal, (0.95, 0.2), [0.0, 1.0]);
        assert!(matches!(wide, Err(UncertaintyError::CutOff { .. })), "{wide:?}");
        let beyond = Distribution::from_limits([0.9, 1.1], None, [0.0, 1.0]);
        assert!(matches!(beyond, Err(UncertaintyError::Beyond { .. })));
    }

    #[test]
    fn limits_and_mode() {
        let of = Distribution::from_limits([0.9, 1.0], Some(0.98), [0.0, 1.0]).unwrap();
        // a fifth of the area lies above the mode, four fifths below it
        assert!((of.quantile(0.8) - 0.98).abs() < 1e-12);
        assert_eq!((of.quantile(0.0), of.quantile(1.0)), (0.9, 1.0));
        for (limits, mode) in [([1.0, 0.9], None), ([0.1, 0.2], Some(0.3)), ([f64::NAN, 1.0], None)] {
            assert!(matches!(Distribution::from_limits(limits, mode, ANY), Err(UncertaintyError::Limits { .. })));
        }
    }
}
