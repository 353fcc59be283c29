//! How large a difference the test would have seen: that a difference is not found does not mean that there is none.

use statrs::distribution::{ContinuousCDF, Normal};

use crate::error::ValidationError;
use crate::kolmogorov_smirnov::KolmogorovSmirnov;
use crate::resampling::{Resampling, Stream};
use crate::sample::Sample;

/// Fills the seed behind the 8 bytes of the user's number.
const POWER: &[u8; 24] = b"uplift validate    power";
/// Probability with which the difference is found.
const POWER_WANTED: f64 = 0.8;
/// Values of a sample that are drawn at most; of more, the logarithm of the factor falls as 1/√(n m/(n + m)).
pub const MOST_DRAWN: usize = 2000;
/// Largest factor looked for.
const LARGEST_FACTOR: f64 = 100.0;

/// The smallest factor between the medians of two lognormal samples of `n` and `m` values with the standard deviation
/// `dispersion` of their logarithms, that the Kolmogorov–Smirnov test (exact p) finds at `level` with a probability of
/// 80 %, by simulation; none up to 100.
///
/// # Errors
/// Dispersion and level must be above 0, the level below 1, the sizes at least 1.
pub fn detectable_factor(
    (n, m): (usize, usize),
    dispersion: f64,
    level: f64,
    resampling: Resampling,
) -> Result<Option<f64>, ValidationError> {
    let out_of_range = |name, value, requirement| Err(ValidationError::OutOfRange { name, value, requirement });
    if n == 0 || m == 0 {
        return Err(ValidationError::Empty);
    }
    if !(dispersion > 0.0 && dispersion.is_finite()) {
        return out_of_range("dispersion", dispersion, "finite and above 0");
    }
    if !(level > 0.0 && level < 1.0) {
        return out_of_range("level", level, "above 0 and below 1");
    }
    let size = |n: usize, m: usize| (n as f64 * m as f64 / (n + m) as f64).sqrt();
    let of_all = size(n, m);
    let (n, m) = (n.min(MOST_DRAWN), m.min(MOST_DRAWN));
    let shrink = size(n, m) / of_all;
    let draws = (0..resampling.replicates)
        .map(|replicate| {
            resampling.go_on()?;
            let mut stream = Stream::new(POWER, resampling.seed, replicate);
            let mut draw = |size: usize| {
                let mut drawn: Vec<f64> = (0..size).map(|_| standard_normal(&mut stream)).collect();
                // once, and not at every shift
                drawn.sort_by(f64::total_cmp);
                drawn
            };
            Ok((draw(n), draw(m)))
        })
        .collect::<Result<Vec<_>, ValidationError>>()?;
    let critical = KolmogorovSmirnov::critical_distance(n, m, level);
    let power = |shift: f64| -> Result<f64, ValidationError> {
        let mut found = 0_u32;
        for (one, other) in &draws {
            resampling.go_on()?;
            let shifted = other.iter().map(|value| value + shift / dispersion).collect();
            let distance = KolmogorovSmirnov::distance_of(&Sample::new(one.clone())?, &Sample::new(shifted)?);
            found += u32::from(distance >= critical);
        }
        Ok(f64::from(found) / f64::from(resampling.replicates))
    };
    let (mut low, mut high) = (0.0, LARGEST_FACTOR.ln());
    if power(high)? < POWER_WANTED {
        return Ok(None);
    }
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if power(middle)? < POWER_WANTED { low = middle } else { high = middle }
    }
    Ok(Some((high * shrink).exp()))
}

/// By the inverse of the distribution function.
fn standard_normal(stream: &mut Stream) -> f64 {
    Normal::standard().inverse_cdf(stream.uniform())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of 2000 are drawn, those of 8000 follow from them: half the logarithm. What is drawn agrees with the
    /// law as far as 500 beside 2000 tell.
    #[test]
    fn of_many_values_the_factor_follows_from_fewer() {
        let few = Resampling { replicates: 200, ..Resampling::default() };
        let factor = |n: usize| detectable_factor((n, n), 0.7, 0.1, few).unwrap().unwrap().ln();
        let drawn = factor(2000);
        assert!((factor(8000) / drawn - 0.5).abs() < 1e-12);
        assert!((factor(500) / drawn - 2.0).abs() < 0.2, "{} {drawn}", factor(500));
        let stopped = Resampling { stop: &|| true, ..few };
        assert_eq!(detectable_factor((3, 3), 0.7, 0.1, stopped), Err(ValidationError::Stopped));
    }
}
