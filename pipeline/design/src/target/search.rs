//! Values of a quantity that are tried, until the largest that misses a target lies near enough to the next.

use serde::Serialize;

use uplift_job::text::rounded;

use crate::error::DesignError;

/// Rounds of halving, so that the widest interval ends at neighbouring numbers.
const ROUNDS: usize = 64;

/// Most steps of a lattice.
const MOST_STEPS: f64 = 20.0;

/// Most values at which a structure is shaken itself, and most that are tried more for an upper limit.
pub(super) const MOST_VALUES: usize = 8;
/// How near the last value that is not safe lies to the first that is, as a share of it.
pub(super) const NEAR: f64 = 0.02;
/// Least and largest factor from one value to the next while none is safe.
const STEPS: [f64; 2] = [1.05, 1.5];

/// Where the frequency crosses the target, between two values that were analysed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Crossing {
    /// The lower value.
    pub from: f64,
    /// The upper value.
    pub to: f64,
    /// Whether the target is met from here on; missed otherwise.
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
    (4..17_usize).find(|digits| tolerance >= 10.0_f64.powf(1.0 - *digits as f64)).unwrap_or(17)
}

/// `value` with so many significant `digits`, and not below it, but `most` at the end of a range; infinite stays so.
pub(super) fn rounded_up(value: f64, digits: usize, most: f64) -> f64 {
    if !value.is_finite() {
        return value;
    }
    let near = rounded(value, digits);
    let last_digit = 10.0_f64.powf(value.log10().floor() + 1.0 - digits as f64);
    let up = if near >= value { near } else { rounded(near + last_digit, digits) };
    up.min(most)
}

/// Values about `step` apart, as a share of the value, from `from` to `to` and one beyond either, within what was
/// `tried`. They lie on a lattice that does not depend on these ends, so that others later add none between.
pub(super) fn lattice<T>(tried: &[(f64, T)], [from, to]: [f64; 2], step: f64, digits: usize) -> Vec<f64> {
    let (Some((first, _)), Some((last, _))) = (tried.first(), tried.last()) else { return Vec::new() };
    let to = to.min(*last);
    // twice as wide until they are few
    let mut width = step.ln_1p();
    while (to / from).ln() > MOST_STEPS * width {
        width *= 2.0;
    }
    let [begin, end] = [((from / first).ln() / width).floor(), ((to / first).ln() / width).ceil()];
    let steps = (0..).map(|place| begin + f64::from(place)).take_while(|place| *place <= end);
    let values = steps.map(|place| rounded(first * (place * width).exp(), digits));
    values.filter(|value| first < value && value < last).collect()
}

/// Tries values between the largest that does not `meet` the target and the next, until these differ by no more than
/// the share `tolerance` of the smaller.
///
/// # Errors
/// What `attempt` ends with.
pub(super) fn narrow<T>(
    tried: &mut Vec<(f64, T)>,
    (tolerance, digits): (f64, usize),
    mut attempt: impl FnMut(&[f64]) -> Result<Vec<T>, DesignError>,
    meets: impl Fn(&T) -> bool,
) -> Result<(), DesignError> {
    for _ in 0..ROUNDS {
        let Some(at) = least(tried, &meets).filter(|at| *at > 0) else { break };
        let [missed, met] = [tried[at - 1].0, tried[at].0];
        let middle = rounded((missed * met).sqrt(), digits);
        // neighbouring numbers have none between
        let is_between = missed < middle && middle < met;
        if met <= missed * (1.0 + tolerance) || !is_between || !extend(tried, vec![middle], &mut attempt)? {
            break;
        }
    }
    Ok(())
}

/// Tries those of `values` that were not yet; whether there were any.
///
/// # Errors
/// What `attempt` ends with, which gets them together.
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
    let between = |pair: &[(f64, T)]| {
        let becomes_met = meets(&pair[1].1);
        (meets(&pair[0].1) != becomes_met).then(|| Crossing { from: pair[0].0, to: pair[1].0, becomes_met })
    };
    tried.windows(2).filter_map(between).collect()
}

/// The value to try after those of these upper limits, `(value, 1/yr)`, ascending; none where enough are tried. Below
/// the first where all are safe.
pub(super) fn next_value(rates: &[(f64, f64)], target_per_year: f64, near: f64) -> Option<f64> {
    let line = |[(a, rate_a), (b, rate_b)]: [(f64, f64); 2]| {
        let slope = (rate_b / rate_a).ln() / (b / a).ln();
        let value = a * ((target_per_year / rate_a).ln() / slope).exp();
        (slope < 0.0 && value.is_finite()).then_some(value)
    };
    match least(rates, |rate| *rate <= target_per_year) {
        Some(0) => {
            let first = *rates.first()?;
            let guess = rates.get(1).and_then(|second| line([first, *second]));
            // a little further than the line goes, so that the target lies between
            let guess = guess.map_or(0.0, |value| value / (1.0 + 0.5 * near));
            let [most, least] = STEPS.map(|step| first.0 / step);
            Some(if rates.len() == 1 { (least * most).sqrt() } else { guess.clamp(least, most) })
        }
        Some(at) => {
            let [missed, safe] = [rates[at - 1], rates[at]];
            let [from, to] = [missed.0 * (1.0 + near), safe.0 / (1.0 + near)];
            if from > to {
                let is_near = safe.0 <= missed.0 * (1.0 + near);
                return (!is_near).then(|| (missed.0 * safe.0).sqrt());
            }
            Some(line([missed, safe]).unwrap_or_else(|| (from * to).sqrt()).clamp(from, to))
        }
        None => {
            let last = *rates.last()?;
            let before = rates.len().checked_sub(2).map(|at| rates[at]);
            let guess = before.and_then(|before| line([before, last]));
            // a little further than the line goes, so that the target lies between
            let guess = guess.map_or(f64::INFINITY, |value| value * (1.0 + 0.5 * near));
            let [least, most] = STEPS.map(|step| step * last.0);
            Some(if before.is_none() { (least * most).sqrt() } else { guess.clamp(least, most) })
        }
    }
}

#[cfg(test)]
mod tests {
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
        narrow(&mut tried, (tolerance, digits(tolerance)), attempt, meets).unwrap();
        tried
    }

    #[test]
    fn the_crossing_is_found_to_the_tolerance() {
        let mut analysed = 0;
        let attempt = |values: &[f64]| {
            analysed += values.len();
            Ok(values.iter().map(|value| 1.0 / value).collect())
        };
        let tried = searched(spread([1.0, 16.0], 5, 4), 1e-3, attempt, |rate| *rate <= 0.15);
        let found = crossings(&tried, |rate| *rate <= 0.15);
        let [Crossing { from, to, becomes_met: true }] = found[..] else { panic!("{found:?}") };
        assert!(from < 1.0 / 0.15 && 1.0 / 0.15 <= to && to <= from * 1.001);
        // a factor of 2 to 0.1 %: ten halvings
        assert_eq!((analysed, tried.len()), (15, 15));
        assert!(tried.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(least(&tried, |rate| *rate <= 0.15).map(|at| tried[at].0), Some(to));
        // the digits that are printed are all there are
        assert!(tried.iter().all(|(value, _)| rounded(*value, 4).to_bits() == value.to_bits()), "{tried:?}");
    }

    #[test]
    fn of_a_wave_the_last_crossing_is_followed() {
        let met = |value: f64| (4.0 * value).sin() < 0.0;
        let attempt = |values: &[f64]| Ok(values.iter().map(|&value| met(value)).collect());
        let tried = searched(spread([0.5, 4.0], 33, 4), 1e-6, attempt, |met| *met);
        let found = crossings(&tried, |met| *met);
        assert_eq!(found.len(), 5);
        for (place, crossing) in found.iter().enumerate() {
            let root = (place + 1) as f64 * std::f64::consts::FRAC_PI_4;
            assert!(crossing.from <= root && root <= crossing.to, "{crossing:?} {root}");
            assert_eq!(crossing.becomes_met, place % 2 == 0);
        }
        assert!(found[4].to <= found[4].from * (1.0 + 1e-6), "{:?}", found[4]);
    }

    #[test]
    fn values_have_the_digits_that_the_tolerance_needs() {
        assert_eq!([0.5, 0.005, 1e-3, 1e-4, 0.0].map(digits), [4, 4, 4, 5, 17]);
        assert_eq!(spread([1.0, 1.0003], 5, 4), [1.0, 1.0003]);
        assert_eq!((rounded(0.634_249, 4), rounded(1_234_567.0, 4)), (0.6342, 1_235_000.0));
        assert_eq!(
            [0.634_21, 0.6342, 9.999_9, 1_234_100.0].map(|of| rounded_up(of, 4, f64::INFINITY)),
            [0.6343, 0.6342, 10.0, 1_235_000.0]
        );
        // up to the end of a range, and no further; beyond it there is no end
        assert_eq!([1.3, 1.2347].map(|most| rounded_up(1.234_56, 4, most)), [1.235, 1.2347]);
        assert_eq!([f64::INFINITY, 1.3].map(|most| rounded_up(f64::INFINITY, 4, most)), [f64::INFINITY; 2]);
    }

    #[test]
    fn a_lattice_covers_its_ends_and_is_the_same_from_others() {
        let tried = [(1.0, ()), (16.0, ())];
        let wide = lattice(&tried, [2.0, 3.0], 0.04, 4);
        assert!(wide[0] <= 2.0 && wide[wide.len() - 1] >= 3.0 && wide.len() == 13, "{wide:?}");
        assert!(wide.windows(2).all(|pair| (pair[1] / pair[0] - 1.04).abs() < 1e-3), "{wide:?}");
        let part = lattice(&tried, [2.2, 2.9], 0.04, 4);
        assert!(part.iter().all(|value| wide.contains(value)) && part.len() < wide.len(), "{part:?}");
        // never beyond what was tried, and not too many
        let all = lattice(&tried, [1.0, f64::INFINITY], 0.01, 4);
        assert!(all.len() <= 21 && all[0] > 1.0 && all[all.len() - 1] < 16.0, "{}", all.len());
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

    /// The smallest value.
    const LEAST: f64 = 0.4;

    /// The values of a search from 1 on, and how many there are.
    fn searched_from_one(rate: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let mut rates = vec![(1.0, rate(1.0))];
        while let Some(next) = next_value(&rates, 1e-4, 0.02).filter(|_| rates.len() < MOST_VALUES) {
            if rates.iter().any(|(value, _)| *value == next.max(LEAST)) {
                break;
            }
            let next = next.max(LEAST);
            rates.push((next, rate(next)));
            rates.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        rates
    }

    #[test]
    fn few_values_find_the_safe_one() {
        // a power, one that bends, and steps
        let power = |value: f64| 3e-4 * value.powi(-3);
        let bends = |value: f64| 2e-3 * (-1.5 * value).exp();
        let steps = |value: f64| (1e5 * power(value)).ceil() / 1e5;
        // what is safe at first needs less
        let less = |value: f64| 3e-5 * value.powi(-3);
        for rate in [&power as &dyn Fn(f64) -> f64, &bends, &steps, &less] {
            let rates = searched_from_one(rate);
            let at = least(&rates, |rate| *rate <= 1e-4).unwrap();
            let [missed, safe] = [rates[at - 1].0, rates[at].0];
            assert!(safe <= 1.0201 * missed && rates.len() <= MOST_VALUES, "{rates:?}");
        }
        let all_safe = searched_from_one(|_| 9e-5);
        assert!(all_safe[0].0 == LEAST && all_safe.len() < MOST_VALUES, "{all_safe:?}");
    }

    #[test]
    fn a_rate_that_does_not_fall_is_followed_by_steps() {
        let rates = searched_from_one(|_| 2e-4);
        assert_eq!(rates.len(), MOST_VALUES);
        assert!(rates.windows(2).all(|pair| pair[1].0 > pair[0].0));
        // none seen is a rate, too
        let rates = searched_from_one(|value| if value < 1.3 { 2e-4 } else { 0.0 });
        assert!(least(&rates, |rate| *rate <= 1e-4).is_some_and(|at| rates[at].0 < 1.35), "{rates:?}");
    }
}
