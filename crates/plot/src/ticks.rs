//! Round numbers along an axis.

use super::figure::Scale;
use super::typeset::plain;

/// Positions (logarithms on a logarithmic axis) of the labelled ticks between two positions, about `wanted` of them.
pub fn ticks(scale: Scale, from: f64, to: f64, wanted: usize) -> Vec<f64> {
    match scale {
        Scale::Linear => linear(from, to, wanted),
        Scale::Log => {
            let within = |tick: &f64| *tick >= from - 1e-9 && *tick <= to + 1e-9;
            let mantissas = [1.0_f64, 2.0, 5.0].map(f64::log10);
            let fine: Vec<f64> = decades(from, to)
                .flat_map(|decade| mantissas.map(|mantissa| decade + mantissa))
                .filter(within)
                .collect();
            if fine.len() < 2 {
                // less than a decade, with no round number in it
                let [from, to] = [from, to].map(|position| 10.0_f64.powf(position));
                return linear(from, to, wanted).into_iter().map(f64::log10).collect();
            }
            if fine.len() <= wanted.max(5) {
                return fine;
            }
            let step = ((to - from) / wanted as f64).ceil().max(1.0);
            decades(from, to).filter(|decade| within(decade) && decade.rem_euclid(step) == 0.0).collect()
        }
    }
}

fn decades(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let (mut next, last) = (from.floor(), to.ceil());
    std::iter::from_fn(move || {
        let current = next;
        next += 1.0;
        (current <= last).then_some(current)
    })
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn linear(from: f64, to: f64, wanted: usize) -> Vec<f64> {
    let raw = (to - from) / wanted as f64;
    if !(raw > 0.0 && raw.is_finite()) {
        return vec![from];
    }
    let power = 10.0_f64.powf(raw.log10().floor());
    let step =
        [1.0, 2.0, 5.0, 10.0].into_iter().map(|factor| factor * power).find(|step| *step >= raw * 0.999).unwrap_or(raw);
    let first = (from / step - 1e-9).ceil();
    let mut ticks = Vec::new();
    let mut index = first;
    while index * step <= to + 1e-9 * step {
        ticks.push(index * step + 0.0); // no negative zero
        index += 1.0;
    }
    ticks
}

/// How the numbers along an axis are written: all of them as powers of ten, or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Labels {
    scale: Scale,
    powers: bool,
}

impl Labels {
    /// Of the ticks at these positions: powers of ten where one of them would be long.
    pub(super) fn from_positions(scale: Scale, positions: &[f64]) -> Self {
        let long = |value: f64| value != 0.0 && (value.abs() < 0.999e-3 || value.abs() > 0.999e5);
        Self { scale, powers: positions.iter().any(|&position| long(scale.value(position))) }
    }

    /// How many letters the longest of the ticks has, about.
    pub(super) fn longest(self, positions: &[f64]) -> usize {
        positions.iter().map(|&position| plain(&self.text(position)).chars().count()).max().unwrap_or(0)
    }

    /// A tick as text, its exponent marked (`10^{−5}`).
    pub(super) fn text(self, position: f64) -> String {
        let value = self.scale.value(position);
        let text = if self.powers && value != 0.0 { power(value) } else { decimal(value) };
        text.replace('-', "−")
    }
}

/// As few digits as tell the value.
fn decimal(value: f64) -> String {
    let rounded = format!("{value:.4}");
    rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A factor, where it is not 1, times a power of ten.
fn power(value: f64) -> String {
    // two digits: ticks are 1, 2 or 5 times a power of ten, or a multiple of these
    let written = format!("{value:.1e}");
    let (factor, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    match factor.trim_end_matches(".0") {
        "1" => format!("10^{{{exponent}}}"),
        factor => format!("{factor}·10^{{{exponent}}}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_numbers() {
        let close = |found: Vec<f64>, expected: &[f64]| {
            assert_eq!(found.len(), expected.len(), "{found:?}");
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
        };
        close(ticks(Scale::Linear, 0.0, 1.0, 5), &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        close(ticks(Scale::Linear, 0.13, 0.42, 4), &[0.2, 0.3, 0.4]);
        close(ticks(Scale::Log, -4.0, 1.0, 6), &[-4.0, -3.0, -2.0, -1.0, 0.0, 1.0]);
        close(ticks(Scale::Log, -8.0, 0.0, 4), &[-8.0, -6.0, -4.0, -2.0, 0.0]);
        assert_eq!(ticks(Scale::Linear, 1.0, 1.0, 5), [1.0]);
        assert_eq!(ticks(Scale::Log, 0.0, 1.0, 5).len(), 4);
        let between = |from: f64, to: f64| ticks(Scale::Log, from.log10(), to.log10(), 4);
        close(between(1.2e-4, 1.9e-4), &[1.2e-4_f64, 1.4e-4, 1.6e-4, 1.8e-4].map(f64::log10));
        assert_eq!((ticks(Scale::Log, 0.0, 2.0, 7).len(), ticks(Scale::Log, 0.0, 2.0, 6).len()), (7, 3));
    }

    #[test]
    fn words() {
        let written = |scale: Scale, positions: &[f64]| {
            let labels = Labels::from_positions(scale, positions);
            positions.iter().map(|&position| labels.text(position)).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(written(Scale::Linear, &[0.0, 0.2, 100.0]), "0 0.2 100");
        assert_eq!(written(Scale::Linear, &[-0.5, 0.0]), "−0.5 0");
        assert_eq!(written(Scale::Log, &[-3.0, -2.0, 0.0, 1.0]), "0.001 0.01 1 10");
        // one axis, one way of writing
        assert_eq!(written(Scale::Log, &[-5.0, 0.0]), "10^{−5} 10^{0}");
        assert_eq!(written(Scale::Linear, &[0.0, 2e-4, 12e-4]), "0 2·10^{−4} 1.2·10^{−3}");
    }
}
