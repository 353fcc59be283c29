//! Hazard curves by which the extreme shaking is frequent, or the faintest is rare or happens every week: what a wrong
//! unit looks like.

use std::fmt;

use uplift_hazard::HazardCurve;
use uplift_job::text;
use uplift_motion::IntensityMeasure;

/// A level that hardly any site exceeds, and one that nearly every site does, in field units.
fn extreme_levels(measure: IntensityMeasure) -> Option<[f64; 2]> {
    match measure {
        IntensityMeasure::Pgv => Some([1000.0, 0.3]),
        IntensityMeasure::Pga => Some([10.0, 0.003]),
        // at long periods even the faintest may be rare
        IntensityMeasure::Sa(period) if period.s() <= 0.5 => Some([20.0, 0.003]),
        _ => None,
    }
}

/// What is hardly possible by a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct HardlyPossible {
    /// `10 g is exceeded 6.1e-1 times a year`.
    pub what: String,
    /// How many times too often, or too rarely, at least.
    pub times: f64,
    /// Whether the faintest is too frequent, as rates in per cent are.
    pub is_faint_and_frequent: bool,
}

/// By `curve` the extreme shaking is frequent, or the faintest is rare.
pub fn hardly_possible(curve: &HazardCurve, measure: IntensityMeasure) -> Option<HardlyPossible> {
    hardly_possible_if(curve, measure, 1.0)
}

/// The same if the levels of `curve` were so many times too large as they are read.
pub(super) fn hardly_possible_if(
    curve: &HazardCurve,
    measure: IntensityMeasure,
    too_large: f64,
) -> Option<HardlyPossible> {
    /// Once in ten thousand years.
    const RARE_PER_YEAR: f64 = 1e-4;
    /// Once a week: earthquakes that shake a site so are fewer anywhere.
    const WEEKLY_PER_YEAR: f64 = 52.0;
    let [strong, faint] = extreme_levels(measure)?;
    let unit = measure.unit();
    let at = |level: f64| curve.rate_at(level * too_large).ok();
    // beyond its ends the curve still says that it is more, or less
    let at_least = |level| at(level).or((curve.first().im > level * too_large).then_some(curve.first().maf));
    let at_most = |level| at(level).or((curve.last().im < level * too_large).then_some(curve.last().maf));
    if let Some(rate) = at_least(strong).filter(|&rate| rate > RARE_PER_YEAR) {
        let often = if rate < 0.01 { text::rate(rate) } else { format!("{rate:.2}") };
        let what = format!("{strong} {unit} is exceeded {often} times a year");
        return Some(HardlyPossible { what, times: rate / RARE_PER_YEAR, is_faint_and_frequent: false });
    }
    if let Some(rate) = at_least(faint).filter(|&rate| rate > WEEKLY_PER_YEAR) {
        let what = format!("{faint} {unit} is exceeded {rate:.0} times a year");
        return Some(HardlyPossible { what, times: rate / WEEKLY_PER_YEAR, is_faint_and_frequent: true });
    }
    let rate = at_most(faint).filter(|&rate| rate < RARE_PER_YEAR)?;
    let what = format!("{faint} {unit} is exceeded only {} times a year", text::rate(rate));
    Some(HardlyPossible { what, times: RARE_PER_YEAR / rate, is_faint_and_frequent: false })
}

impl fmt::Display for HardlyPossible {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}, which is hardly possible: check the unit of the curve", self.what)
    }
}

#[cfg(test)]
mod tests {
    use uplift_motion::Period;

    use super::*;

    /// A curve of slope -2.5 whose level of 1e-4 a year is `level`, from a hundredth of it to ten times it.
    fn told(measure: IntensityMeasure, level: f64) -> Option<String> {
        let im: Vec<f64> = [0.01, 0.1, 1.0, 10.0].iter().map(|part| part * level).collect();
        let maf = im.iter().map(|im| 1e-4 * (level / im).powf(2.5)).collect();
        let curve = HazardCurve::new(measure.label(), measure.unit(), "", im, maf).unwrap();
        hardly_possible(&curve, measure).map(|found| found.what)
    }

    #[test]
    fn impossible_hazard_raises_a_warning_and_strong_hazard_does_not() {
        let short = IntensityMeasure::Sa(Period::from_s(0.3).unwrap());
        let long = IntensityMeasure::Sa(Period::from_s(2.0).unwrap());
        // beside the San Andreas fault, and in the Baltic
        for (measure, level) in [
            (IntensityMeasure::Pgv, 400.0),
            (IntensityMeasure::Pgv, 0.8),
            (IntensityMeasure::Pga, 2.5),
            (IntensityMeasure::Pga, 0.008),
            (short, 6.0),
            (long, 0.001),
        ] {
            assert_eq!(told(measure, level), None, "{measure:?} {level}");
        }
        for (measure, level, words) in [
            (IntensityMeasure::Pgv, 4000.0, "1000 cm/s is exceeded 3.2e-3 times a year"),
            (IntensityMeasure::Pgv, 0.1, "0.3 cm/s is exceeded only 6.4e-6 times a year"),
            (IntensityMeasure::Pga, 24.5, "10 g is exceeded 9.4e-4 times a year"),
            (IntensityMeasure::Pga, 0.0008, "0.003 g is exceeded only 3.7e-6 times a year"),
            (short, 60.0, "20 g is exceeded 1.6e-3 times a year"),
            // beyond its ends a curve still says that it is more, or less
            (IntensityMeasure::Pgv, 200_000.0, "1000 cm/s is exceeded 10.00 times a year"),
            (IntensityMeasure::Pga, 1e-5, "0.003 g is exceeded only 3.2e-7 times a year"),
        ] {
            assert_eq!(told(measure, level).as_deref(), Some(words), "{measure:?} {level}");
        }
    }

    #[test]
    fn rates_in_per_cent_are_recognised_where_no_site_is_shaken_so_often() {
        let found = |measure: IntensityMeasure, faint: f64, times: f64| {
            let im = [1.0, 10.0, 1000.0].map(|part| part * faint).to_vec();
            let maf = im.iter().map(|im| times * 2.0 * (im / faint).powf(-1.5)).collect();
            let curve = HazardCurve::new(measure.label(), measure.unit(), "", im, maf).unwrap();
            hardly_possible(&curve, measure).map(|found| (found.what, found.is_faint_and_frequent))
        };
        // twice a year in the strongest seismicity; two per cent a year more looks like it
        assert_eq!(found(IntensityMeasure::Pgv, 0.3, 1.0), None);
        assert_eq!(found(IntensityMeasure::Pga, 0.003, 25.0), None);
        let weekly = |what: &str| Some((what.to_owned(), true));
        assert_eq!(found(IntensityMeasure::Pgv, 0.3, 100.0), weekly("0.3 cm/s is exceeded 200 times a year"));
        assert_eq!(found(IntensityMeasure::Pga, 0.003, 100.0), weekly("0.003 g is exceeded 200 times a year"));
    }
}
