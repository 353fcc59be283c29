//! Values of a quantity tried until every place between a met and a missed target is narrow enough.

use serde::Serialize;

use crate::error::DesignError;

/// Parts into which the interval between a met and a missed value is cut at once.
const PARTS: usize = 4;

/// Rounds of cutting: a quarter each, so that the widest interval ends at neighbouring numbers.
const ROUNDS: usize = 32;

/// Crossings of a limit that are followed: more are noise, told as they were found.
pub(super) const MOST_CROSSINGS: usize = 12;

/// Where the frequency crosses the target, between two values that were analysed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Crossing {
    /// The smaller value.
    pub from: f64,
    /// The larger value.
    pub to: f64,
    /// Whether the target is met at the larger value, and missed at the smaller.
    pub becomes_met: bool,
}

/// Values from `from` to `to`, `count` of them, each about the same factor above the one before, with so many `digits`:
/// what is printed is what was tried.
pub(super) fn spread([from, to]: [f64; 2], count: usize, digits: usize) -> Vec<f64> {
    let steps = count.saturating_sub(1).max(1);
    let at = |step: usize| rounded(from * (to / from).powf(step as f64 / steps as f64), digits);
    let mut values: Vec<f64> = std::iter::once(from).chain((1..steps).map(at)).collect();
    values.retain(|value| *value < to);
    values.push(to);
    values.dedup();
    values
}

/// Significant digits of values that a `tolerance` tells apart.
pub(super) fn digits(tolerance: f64) -> usize {
    // a tenth of the tolerance, and no less than what is usual
    (0..17_i32).find(|digits| tolerance >= 10.0_f64.powi(-digits)).map_or(17, |digits| digits as usize + 1).clamp(4, 17)
}

/// `value` with so many significant `digits`.
pub(super) fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// Tries `values`, ascending, and then between every two neighbours of which one meets a limit and the other does not,
/// until these differ by no more than the share `tolerance` of the smaller. Everything tried, ascending.
///
/// * `meets` — whether each of the limits is met
///
/// # Errors
/// What `attempt` ends with, which gets the values of a round together.
pub(super) fn search<T, const LIMITS: usize>(
    tried: &mut Vec<(f64, T)>,
    tolerance: f64,
    mut attempt: impl FnMut(&[f64]) -> Result<Vec<T>, DesignError>,
    meets: impl Fn(&T) -> [bool; LIMITS],
) -> Result<(), DesignError> {
    let digits = digits(tolerance);
    for _ in 0..ROUNDS {
        let wide = |limit: usize| {
            let wide = |crossing: &Crossing| crossing.to > crossing.from * (1.0 + tolerance);
            let found: Vec<Crossing> = crossings(tried, |of| meets(of)[limit]).into_iter().filter(wide).collect();
            // the highest first: there lies the value from which on all is met
            found.into_iter().rev().take(MOST_CROSSINGS)
        };
        let within = |crossing: Crossing| {
            let Crossing { from, to, .. } = crossing;
            let inner = spread([from, to], PARTS + 1, digits);
            // neighbouring numbers have none between
            inner.into_iter().filter(move |value| *value > from && *value < to).collect::<Vec<_>>()
        };
        let next: Vec<f64> = (0..LIMITS).flat_map(wide).flat_map(within).collect();
        if !extend(tried, next, &mut attempt)? {
            break;
        }
    }
    Ok(())
}

/// Tries those of `values` that were not yet; whether there were any.
///
/// # Errors
/// What `attempt` ends with.
pub(super) fn extend<T>(
    tried: &mut Vec<(f64, T)>,
    mut values: Vec<f64>,
    attempt: &mut impl FnMut(&[f64]) -> Result<Vec<T>, DesignError>,
) -> Result<bool, DesignError> {
    values.sort_by(f64::total_cmp);
    values.dedup();
    values.retain(|value| tried.binary_search_by(|(of, _)| of.total_cmp(value)).is_err());
    if values.is_empty() {
        return Ok(false);
    }
    let found = attempt(&values)?;
    tried.extend(values.into_iter().zip(found));
    tried.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    Ok(true)
}

/// Position of the least value from which on all meet a limit; none where the largest does not.
pub(super) fn least<T>(tried: &[(f64, T)], meets: impl Fn(&T) -> bool) -> Option<usize> {
    let missed = tried.iter().rposition(|(_, of)| !meets(of)).map_or(0, |missed| missed + 1);
    (missed < tried.len()).then_some(missed)
}

/// Every place between neighbours of which one `meets` the target and the other does not, ascending.
pub(super) fn crossings<T>(tried: &[(f64, T)], meets: impl Fn(&T) -> bool) -> Vec<Crossing> {
    let between = |pair: &[(f64, T)]| match pair {
        [(from, a), (to, b)] if meets(a) != meets(b) => Some(Crossing { from: *from, to: *to, becomes_met: meets(b) }),
        _ => None,
    };
    tried.windows(2).filter_map(between).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// The values of a search from `values` on, with what was found.
    fn searched<T>(
        values: Vec<f64>,
        tolerance: f64,
        mut attempt: impl FnMut(&[f64]) -> Result<Vec<T>, DesignError>,
        meets: impl Fn(&T) -> bool,
    ) -> Vec<(f64, T)> {
        let mut tried = Vec::new();
        extend(&mut tried, values, &mut attempt).unwrap();
        search(&mut tried, tolerance, attempt, |of| [meets(of)]).unwrap();
        tried
    }

    #[test]
    fn one_crossing_is_found_to_the_tolerance() {
        let mut analysed = 0;
        let attempt = |values: &[f64]| {
            analysed += values.len();
            Ok(values.iter().map(|value| 1.0 / value).collect())
        };
        let tried = searched(spread([1.0, 16.0], 5, 4), 1e-3, attempt, |rate| *rate <= 0.15);
        let found = crossings(&tried, |rate| *rate <= 0.15);
        let [Crossing { from, to, becomes_met: true }] = found[..] else { panic!("{found:?}") };
        assert!(from < 1.0 / 0.15 && 1.0 / 0.15 <= to && to <= from * 1.001);
        // a factor of 2 to 0.1 %: five rounds of three values
        assert_eq!((analysed, tried.len()), (5 + 5 * 3, 20));
        assert!(tried.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(least(&tried, |rate| *rate <= 0.15).map(|at| tried[at].0), Some(to));
        // the digits that are printed are all there are
        assert!(tried.iter().all(|(value, _)| rounded(*value, 4).to_bits() == value.to_bits()), "{tried:?}");
    }

    #[test]
    fn every_crossing_of_a_wave_is_found() {
        let met = |value: f64| (4.0 * value).sin() < 0.0;
        let attempt = |values: &[f64]| Ok(values.iter().map(|&value| met(value)).collect());
        let tried = searched(spread([0.5, 4.0], 33, 4), 1e-6, attempt, |met| *met);
        let found = crossings(&tried, |met| *met);
        assert_eq!(found.len(), 5);
        for (place, crossing) in found.iter().enumerate() {
            let root = (place + 1) as f64 * std::f64::consts::PI / 4.0;
            assert!(crossing.from <= root && root <= crossing.to && crossing.to < crossing.from * (1.0 + 1e-6));
            assert_eq!(crossing.becomes_met, place % 2 == 0);
        }
    }

    #[test]
    fn every_limit_is_followed() {
        let attempt = |values: &[f64]| Ok(values.iter().map(|value| 1.0 / value).collect::<Vec<f64>>());
        let mut tried: Vec<(f64, f64)> = Vec::new();
        extend(&mut tried, spread([1.0, 16.0], 5, 4), &mut { attempt }).unwrap();
        search(&mut tried, 1e-3, attempt, |rate| [*rate <= 0.1, *rate <= 0.3, *rate <= 1e-9]).unwrap();
        for limit in [0.1, 0.3] {
            let at = tried[least(&tried, |rate| *rate <= limit).unwrap()].0;
            assert!(at >= 1.0 / limit && at <= 1.001 / limit, "{at} {limit}");
        }
        assert_eq!(least(&tried, |rate| *rate <= 1e-9), None);
    }

    #[test]
    fn values_have_the_digits_that_the_tolerance_needs() {
        assert_eq!([0.5, 0.005, 1e-3, 1e-4, 0.0].map(digits), [4, 4, 4, 5, 17]);
        assert_eq!(spread([1.0, 1.0003], 5, 4), [1.0, 1.0003]);
        assert_eq!((rounded(0.634_249, 4), rounded(1_234_567.0, 4)), (0.6342, 1_235_000.0));
    }

    #[test]
    fn a_step_between_neighbouring_numbers_ends() {
        let step = 1.0 + f64::EPSILON;
        let attempt = |values: &[f64]| Ok(values.iter().map(|&value| value >= step).collect());
        let tried = searched(vec![1.0, 2.0], 0.0, attempt, |met| *met);
        let found = crossings(&tried, |met| *met);
        assert!(found.len() == 1 && found[0].from < step && step <= found[0].to);
        assert!(found[0].to - found[0].from <= 4.0 * f64::EPSILON, "{found:?}");
    }
}
