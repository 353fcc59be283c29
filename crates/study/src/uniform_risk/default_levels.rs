//! The default levels, whole or cut to a hazard curve.

use uplift_motion::IntensityMeasure;

use super::measures::{MeasureKeys, MeasurePlan};

/// Digits of the end of a curve that becomes a level: unit conversions leave more, which nobody wants to read.
const DIGITS: i32 = 6;

impl MeasurePlan {
    /// Whether the levels are those of a study that gives none.
    pub fn is_default(&self) -> bool {
        let default = MeasureKeys::from_measure(self.measure).levels.default_value();
        default.is_some_and(|default| default[..] == self.levels[..])
    }

    /// The default levels of `measure` within a curve from `least` to `most`, and the ends of that curve if it cuts
    /// them. None where all of them are within, or hardly any.
    pub fn default_within(measure: IntensityMeasure, least: f64, most: f64) -> Option<Self> {
        let least = rounded_inside(least, 1.0, |level| level >= least);
        let most = rounded_inside(most, -1.0, |level| level <= most);
        let mut parts = Vec::new();
        let [mut lowest, mut highest] = [f64::INFINITY, 0.0_f64];
        let (mut first, mut last) = (f64::INFINITY, 0.0_f64);
        for text in MeasureKeys::from_measure(measure).levels.default().unwrap_or_default() {
            let numbers: Vec<f64> = text.split(':').filter_map(|number| number.parse().ok()).collect();
            let (start, step, stop) = match numbers[..] {
                [value] => (value, 1.0, value),
                [start, step, stop] => (start, step, stop),
                _ => continue,
            };
            (first, last) = (first.min(start), last.max(stop));
            // ends move by whole steps, so that the levels stay those of the default
            let from = ((least - start) / step - 1e-9).ceil().max(0.0);
            let to = ((most.min(stop) - start) / step + 1e-9).floor();
            let [begin, end] = [from, to].map(|steps| ((start + steps * step) * 1e6).round() / 1e6);
            if from > to {
                continue;
            }
            parts.push(if from < to { format!("{begin}:{step}:{end}") } else { begin.to_string() });
            (lowest, highest) = (lowest.min(begin), highest.max(end));
        }
        let is_cut = first < least || most < last;
        if !is_cut || !parts.iter().any(|part| part.contains(':')) {
            return None;
        }
        // from end to end of the curve, so that `uplift check` proposes no others within it
        if first < least && least < lowest {
            parts.insert(0, least.to_string());
        }
        if most < last && highest < most {
            parts.push(most.to_string());
        }
        Some(Self { measure, levels: parts.join(",").parse().ok()?, is_cut: true })
    }
}

/// A positive `value` to six digits; where that is not inside, one more or less of the last digit, as `step` says.
#[expect(clippy::cast_possible_truncation, reason = "the decade of a finite number")]
fn rounded_inside(value: f64, step: f64, is_inside: impl Fn(f64) -> bool) -> f64 {
    let scale = 10_f64.powi((DIGITS - 1).saturating_sub(value.log10().floor() as i32));
    let nearest = (value * scale).round();
    [nearest, nearest + step].map(|digits| digits / scale).into_iter().find(|level| is_inside(*level)).unwrap_or(value)
}
