//! Values of a quantity tried until every place between a met and a missed target is narrow enough.

use serde::Serialize;

use crate::error::DesignError;

/// Parts into which the interval between a met and a missed value is cut at once.
const PARTS: usize = 4;

/// Rounds of cutting: a quarter each, so that the widest interval ends at neighbouring numbers.
const ROUNDS: usize = 32;

/// Crossings that are followed: more are noise, told as they were found.
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

/// Values from `from` to `to`, `count` of them, each the same factor above the one before.
pub(super) fn spread([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    let steps = count.saturating_sub(1).max(1);
    let at = |step: usize| from * (to / from).powf(step as f64 / steps as f64);
    let mut values: Vec<f64> = (0..steps).map(at).collect();
    values.push(to);
    values
}

/// Tries `values`, ascending, and then between every two neighbours of which one `meets` the target and the other does
/// not, until these differ by no more than the share `tolerance` of the smaller. Everything tried, ascending.
///
/// # Errors
/// What `attempt` ends with, which gets the values of a round together.
pub(super) fn search<T>(
    values: Vec<f64>,
    tolerance: f64,
    mut attempt: impl FnMut(&[f64]) -> Result<Vec<T>, DesignError>,
    meets: impl Fn(&T) -> bool,
) -> Result<Vec<(f64, T)>, DesignError> {
    let found = attempt(&values)?;
    let mut tried: Vec<(f64, T)> = values.into_iter().zip(found).collect();
    for _ in 0..ROUNDS {
        let wide: Vec<Crossing> = crossings(&tried, &meets)
            .into_iter()
            .filter(|crossing| crossing.to > crossing.from * (1.0 + tolerance))
            .collect();
        let within = |crossing: &Crossing| {
            let Crossing { from, to, .. } = *crossing;
            let inner = spread([from, to], PARTS + 1);
            // neighbouring numbers have none between
            inner.into_iter().filter(move |value| *value > from && *value < to).collect::<Vec<_>>()
        };
        // the highest first: there lies the value from which on all is met
        let mut next: Vec<f64> = wide.iter().rev().take(MOST_CROSSINGS).flat_map(within).collect();
        next.sort_by(f64::total_cmp);
        next.dedup();
        if next.is_empty() {
            break;
        }
        let found = attempt(&next)?;
        tried.extend(next.into_iter().zip(found));
        tried.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    }
    Ok(tried)
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

    #[test]
    fn one_crossing_is_found_to_the_tolerance() {
        let mut analysed = 0;
        let attempt = |values: &[f64]| {
            analysed += values.len();
            Ok(values.iter().map(|value| 1.0 / value).collect())
        };
        let tried = search(spread([1.0, 16.0], 5), 1e-3, attempt, |rate| *rate <= 0.15).unwrap();
        let found = crossings(&tried, |rate| *rate <= 0.15);
        let [Crossing { from, to, becomes_met: true }] = found[..] else { panic!("{found:?}") };
        assert!(from < 1.0 / 0.15 && 1.0 / 0.15 <= to && to <= from * 1.001);
        // a factor of 2 to 0.1 %: five rounds of three values
        assert_eq!((analysed, tried.len()), (5 + 5 * 3, 20));
        assert!(tried.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn every_crossing_of_a_wave_is_found() {
        let met = |value: f64| (4.0 * value).sin() < 0.0;
        let attempt = |values: &[f64]| Ok(values.iter().map(|&value| met(value)).collect());
        let tried = search(spread([0.5, 4.0], 33), 1e-6, attempt, |met| *met).unwrap();
        let found = crossings(&tried, |met| *met);
        assert_eq!(found.len(), 5);
        for (place, crossing) in found.iter().enumerate() {
            let root = (place + 1) as f64 * std::f64::consts::PI / 4.0;
            assert!(crossing.from <= root && root <= crossing.to && crossing.to < crossing.from * (1.0 + 1e-6));
            assert_eq!(crossing.becomes_met, place % 2 == 0);
        }
    }

    #[test]
    fn a_step_between_neighbouring_numbers_ends() {
        let step = 1.0 + f64::EPSILON;
        let attempt = |values: &[f64]| Ok(values.iter().map(|&value| value >= step).collect());
        let tried = search(vec![1.0, 2.0], 0.0, attempt, |met| *met).unwrap();
        let found = crossings(&tried, |met| *met);
        assert!(found.len() == 1 && found[0].from < step && step <= found[0].to);
        assert!(found[0].to - found[0].from <= 4.0 * f64::EPSILON, "{found:?}");
    }
}
