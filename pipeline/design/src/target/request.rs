//! What is asked of a search for a target risk.

use std::path::PathBuf;

use uplift_alarms::number_alarms;
use uplift_hazard::rate_from_probability;
use uplift_job::alarm::Alarm;
use uplift_motion::IntensityMeasure;
use uplift_plausible::{
    Implausible, PROBABILITY, RETURN_PERIOD, Range, SAFETY_FACTOR, THRESHOLD, USUAL_SAFETY_FACTOR, USUAL_TARGET,
    USUAL_THRESHOLD, YEARS,
};
use uplift_structure::Quantity;

use crate::error::DesignError;

/// A range narrower than the noise of the stripes is no range; a wider tolerance no search.
const TOLERANCE: Range = Range { least: 1e-9, most: 0.5, unit: "", hint: "a share of the value, 0.005 or so" };
/// What a value may be before the structure says what it makes of it.
const VALUE: Range = Range { least: 1e-9, most: 1e13, unit: "", hint: "in the unit of what is varied" };
/// From hourly to once in ten thousand million years.
const PER_YEAR: Range =
    Range { least: 1e-10, most: 1e4, unit: "1/yr", hint: "a rate per year: 5e-5 is once in 20,000 years" };
/// Of a fragility.
const DISPERSION: Range = Range { least: 1e-3, most: 5.0, unit: "", hint: "of ln im, 0.6 or so" };

/// What must not happen too often.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TargetEvent {
    /// The structure overturns.
    Overturning,
    /// It goes beyond its own displacement capacity, whatever that is at the value tried, divided by this
    /// safety factor.
    BeyondCapacity(f64),
    /// It goes beyond so many metres.
    Beyond(f64),
}

impl TargetEvent {
    /// In words.
    pub fn words(self) -> String {
        match self {
            Self::Overturning => "overturning".to_owned(),
            Self::BeyondCapacity(1.0) => "exceeding the capacity".to_owned(),
            Self::BeyondCapacity(safety_factor) => format!("exceeding the capacity divided by {safety_factor}"),
            Self::Beyond(displacement_m) => format!("exceeding {displacement_m} m"),
        }
    }
}

/// How often it may happen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TargetFrequency {
    /// So often a year.
    PerYear(f64),
    /// With this probability within the years, those of the study where none are given (Eq. 4.8).
    Probability(f64, Option<f64>),
    /// Once in so many years on average.
    ReturnPeriod(f64),
}

impl TargetFrequency {
    /// The years that were given.
    pub(super) fn years(self) -> Option<f64> {
        match self {
            Self::Probability(_, years) => years,
            Self::PerYear(_) | Self::ReturnPeriod(_) => None,
        }
    }

    /// As a mean annual frequency, 1/yr.
    pub(super) fn per_year(self, years: f64) -> Result<f64, DesignError> {
        Ok(match self {
            Self::PerYear(per_year) => per_year,
            Self::Probability(probability, _) => rate_from_probability(probability, years)?,
            Self::ReturnPeriod(years) => 1.0 / years,
        })
    }
}

/// What is asked of a search for a target risk.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetOptions {
    /// Manifest of the records, where it is no longer where the study says.
    pub manifest: Option<PathBuf>,
    /// Site of the result; its only one where none is given.
    pub site: Option<String>,
    /// Intensity measure; PGV where none is given and the result has it.
    pub measure: Option<IntensityMeasure>,
    /// What is varied.
    pub quantity: Quantity,
    /// Least value of the search; a quarter of the structure's own where none is given.
    pub from: Option<f64>,
    /// Largest value of the search; four times the structure's own where none is given.
    pub to: Option<f64>,
    /// What must not happen too often.
    pub event: TargetEvent,
    /// How often it may.
    pub frequency: TargetFrequency,
    /// How near the values on both sides of a crossing must lie, as a share of the value.
    pub tolerance: f64,
    /// Return periods of the levels at which the found structure is looked at, years.
    pub return_periods: Vec<f64>,
    /// Dispersion β of a generic lognormal fragility, and its probability at the level to design for; none for none.
    pub generic: Option<(f64, f64)>,
    /// Leave the frame itself out: the verdict is that of its proxy.
    pub proxy: bool,
    /// CSV file of all values tried.
    pub table: Option<PathBuf>,
    /// Whether existing files are overwritten.
    pub force: bool,
}

impl TargetOptions {
    /// A search with nothing chosen that has a default.
    pub fn new(quantity: Quantity, event: TargetEvent, frequency: TargetFrequency) -> Self {
        Self {
            manifest: None,
            site: None,
            measure: None,
            quantity,
            from: None,
            to: None,
            event,
            frequency,
            tolerance: 0.005,
            return_periods: vec![475.0, 2475.0],
            generic: None,
            proxy: false,
            table: None,
            force: false,
        }
    }

    /// Numbers that can be, but are probably in another unit, or no annual frequency.
    pub(super) fn doubtful(&self) -> Vec<Alarm> {
        let (displacement_m, safety_factor) = match self.event {
            TargetEvent::Beyond(displacement_m) => (Some(displacement_m), None),
            TargetEvent::BeyondCapacity(factor) => (None, Some(factor)),
            TargetEvent::Overturning => (None, None),
        };
        let per_year = match self.frequency {
            TargetFrequency::PerYear(per_year) => Some(per_year),
            TargetFrequency::Probability(..) | TargetFrequency::ReturnPeriod(_) => None,
        };
        number_alarms(
            "target",
            &[
                (USUAL_THRESHOLD, "--exceed", displacement_m),
                (USUAL_SAFETY_FACTOR, "--safety-factor", safety_factor),
                (USUAL_TARGET, "the allowed frequency", per_year),
            ],
        )
    }

    /// Every number that is none, as the command line calls it.
    pub(super) fn mistakes(&self) -> Vec<Implausible> {
        let mut asked: Vec<(Range, &'static str, f64)> = vec![(TOLERANCE, "--tolerance", self.tolerance)];
        asked.extend(self.from.map(|from| (VALUE, "--from", from)));
        asked.extend(self.to.map(|to| (VALUE, "--to", to)));
        match self.event {
            TargetEvent::Beyond(displacement_m) => asked.push((THRESHOLD, "--exceed", displacement_m)),
            TargetEvent::BeyondCapacity(factor) => asked.push((SAFETY_FACTOR, "--safety-factor", factor)),
            TargetEvent::Overturning => {}
        }
        match self.frequency {
            TargetFrequency::PerYear(per_year) => asked.push((PER_YEAR, "the target", per_year)),
            TargetFrequency::Probability(probability, years) => {
                asked.push((PROBABILITY, "--poe", probability));
                asked.extend(years.map(|years| (YEARS, "--years", years)));
            }
            TargetFrequency::ReturnPeriod(years) => asked.push((RETURN_PERIOD, "--return-period", years)),
        }
        asked.extend(self.return_periods.iter().map(|&years| (RETURN_PERIOD, "--at", years)));
        if let Some((dispersion, probability)) = self.generic {
            asked.push((DISPERSION, "--generic-dispersion", dispersion));
            asked.push((PROBABILITY, "--generic-probability", probability));
        }
        asked.into_iter().filter_map(|(range, name, value)| range.check(name, value).err()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_another_unit_are_asked_about() {
        let asked = |event, per_year| {
            let options = TargetOptions::new(Quantity::Width, event, TargetFrequency::PerYear(per_year));
            options.doubtful().into_iter().map(|alarm| alarm.what).collect::<Vec<_>>()
        };
        let beyond = asked(TargetEvent::Beyond(300.0), 2e-4);
        assert!(beyond.len() == 1 && beyond[0].starts_with("--exceed is 300 m; usual is"), "{beyond:?}");
        let percentage = asked(TargetEvent::BeyondCapacity(150.0), 2e-4);
        assert!(percentage.len() == 1 && percentage[0].starts_with("--safety-factor is 150"), "{percentage:?}");
        let often = asked(TargetEvent::Overturning, 5.0);
        assert!(often.len() == 1 && often[0].contains("frequency is 5 1/yr"), "{often:?}");
        assert!(
            asked(TargetEvent::Beyond(0.3), 2e-4).is_empty() && asked(TargetEvent::BeyondCapacity(2.5), 0.1).is_empty()
        );
    }

    #[test]
    fn all_mistakes_are_reported_at_once() {
        let frequency = TargetFrequency::Probability(2.0, Some(-1.0));
        let asked = TargetOptions {
            from: Some(-1.0),
            tolerance: f64::NAN,
            return_periods: vec![0.0, 475.0],
            generic: Some((0.0, 1.0)),
            ..TargetOptions::new(Quantity::Width, TargetEvent::Beyond(-0.1), frequency)
        };
        let names: Vec<&str> = asked.mistakes().iter().map(|mistake| mistake.name).collect();
        let expected = [
            "--tolerance",
            "--from",
            "--exceed",
            "--poe",
            "--years",
            "--at",
            "--generic-dispersion",
            "--generic-probability",
        ];
        assert_eq!(names, expected);
        let sound = TargetOptions::new(Quantity::Width, TargetEvent::Overturning, TargetFrequency::PerYear(2e-4));
        assert_eq!(sound.mistakes(), []);
    }
}
