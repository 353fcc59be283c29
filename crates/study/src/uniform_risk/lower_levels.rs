//! Levels below the first one of a study: where it could begin, and the line that makes it begin there.

use uplift_motion::IntensityMeasure;

use super::measures::{MeasureKeys, MeasurePlan, section_of};
use crate::grid::GridError;

/// How far below a first level others are looked for.
const DECADES: i32 = 3;
/// Decimal fractions of levels are rarely exact.
const EPSILON: f64 = 1e-9;

/// Where levels that begin at `first` could begin instead, falling: 5, 2 and 1 of each decade down to `least`, and
/// `least` itself, in the unit of the levels.
pub fn lower_starts(first: f64, least: f64) -> Vec<f64> {
    let top = decade(first);
    let mut starts: Vec<f64> = (top - DECADES..=top)
        .rev()
        .flat_map(|decade| [5, 2, 1].map(|digit| round(digit, decade)))
        .filter(|&start| start < first * (1.0 - EPSILON) && start >= least)
        .collect();
    if least < starts.last().copied().unwrap_or(first) {
        starts.push(least);
    }
    starts
}

impl MeasurePlan {
    /// This plan with levels from `start` on before its own, at most nine to a decade.
    ///
    /// # Errors
    /// A start that is not below the first level.
    pub fn starting_at(&self, start: f64) -> Result<Self, GridError> {
        let first = self.levels[0];
        let mut notations = Vec::new();
        for decade in decade(start)..=decade(first) {
            let within = |digit: &i32| {
                let level = round(*digit, decade);
                level >= start * (1.0 - EPSILON) && level < first * (1.0 - EPSILON)
            };
            let digits: Vec<i32> = (1..=9).filter(within).collect();
            let [from, .., to] = digits[..] else {
                notations.extend(digits.first().map(|digit| text(*digit, decade)));
                continue;
            };
            notations.push(format!("{}:{}:{}", text(from, decade), text(1, decade), text(to, decade)));
        }
        // a start that is no round number, the foot of a curve, stands by itself
        let lowest = notations.first().and_then(|notation| notation.split(':').next()?.parse::<f64>().ok());
        if lowest.is_none_or(|lowest| start < lowest * (1.0 - EPSILON)) {
            notations.insert(0, start.to_string());
        }
        Ok(Self { measure: self.measure, levels: self.levels.preceded_by(&notations)?, is_cut: false })
    }

    /// The levels as a study file has them, `pgv.levels_cm_s = ["1:0.5:20", "25:5:200"]`.
    pub fn line(&self) -> String {
        format!("{} = {}", levels_key(self.measure), self.levels)
    }
}

/// The key of the levels of `measure`, with its section: `pgv.levels_cm_s`, `measures.sa_1s.levels_g`.
pub fn levels_key(measure: IntensityMeasure) -> String {
    let (section, key) = levels_place(measure);
    format!("{section}.{key}")
}

/// Where the levels of `measure` are written: the section, `pgv` or `measures.sa_1s`, and the key in it.
pub fn levels_place(measure: IntensityMeasure) -> (String, &'static str) {
    (section_of(measure), MeasureKeys::from_measure(measure).levels.name)
}

/// The power of ten at or below `value`.
#[expect(clippy::cast_possible_truncation, reason = "the decade of a finite number")]
fn decade(value: f64) -> i32 {
    (value * (1.0 + EPSILON)).log10().floor() as i32
}

fn round(digit: i32, decade: i32) -> f64 {
    text(digit, decade).parse().unwrap_or(f64::NAN)
}

/// `digit` times a power of ten, as a decimal.
fn text(digit: i32, decade: i32) -> String {
    let places = usize::try_from(-decade).unwrap_or(0);
    format!("{:.places$}", f64::from(digit) * 10_f64.powi(decade))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(levels: &str) -> MeasurePlan {
        MeasurePlan { measure: IntensityMeasure::Pgv, levels: levels.parse().unwrap(), is_cut: false }
    }

    #[test]
    fn starts_are_round_and_end_at_the_foot() {
        assert_eq!(lower_starts(1.0, 0.1), [0.5, 0.2, 0.1]);
        assert_eq!(lower_starts(1.0, 0.114), [0.5, 0.2, 0.114]);
        assert_eq!(lower_starts(25.0, 0.4), [20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.4]);
        assert_eq!(lower_starts(0.0025, 0.001), [0.002, 0.001]);
        assert_eq!(lower_starts(0.1, 0.1), [0.0; 0]);
        assert_eq!(lower_starts(1.0, 0.9), [0.9]);
    }

    #[test]
    fn levels_are_added_below_as_a_study_writes_them() {
        let line = |levels: &str, start: f64| plan(levels).starting_at(start).unwrap().line();
        assert_eq!(line("1:0.5:20,25:5:200", 0.1), "pgv.levels_cm_s = [\"0.1:0.1:0.9\", \"1:0.5:20\", \"25:5:200\"]");
        assert_eq!(line("1,3,10", 0.05), "pgv.levels_cm_s = [\"0.05:0.01:0.09\", \"0.1:0.1:0.9\", 1, 3, 10]");
        assert_eq!(line("1,3", 0.9), "pgv.levels_cm_s = [0.9, 1, 3]");
        assert_eq!(line("1,3", 0.114), "pgv.levels_cm_s = [0.114, \"0.2:0.1:0.9\", 1, 3]");
        assert_eq!(line("25,50", 5.0), "pgv.levels_cm_s = [\"5:1:9\", \"10:10:20\", 25, 50]");
        let lowered = plan("0.25,3").starting_at(0.1).unwrap();
        assert_eq!(lowered.levels[..], [0.1, 0.2, 0.25, 3.0]);
        assert!(plan("1,3").starting_at(1.0).is_err());
    }
}
