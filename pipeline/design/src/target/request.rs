//! What is asked of a search for a target risk.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use uplift_alarms::number_alarms;
use uplift_hazard::rate_from_probability;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::text::typed_path;
use uplift_job::typed::{Overwriting, RARE, number, number_or_per_cent, one_of};
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

/// Where the values on both sides of a crossing are near enough to each other, relative to the value.
const TOLERATED: f64 = 0.005;
/// At whose levels the structure that is found is looked at, years.
const RETURN_PERIODS: [f64; 2] = [475.0, 2475.0];
/// Of a generic fragility at the level to design for.
const GENERIC_PROBABILITY: f64 = 0.1;

/// What must not happen too often.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TargetEvent {
    /// The structure overturns.
    Overturning,
    /// It goes beyond its own displacement capacity, whatever that is at the value tried, divided by this
    /// safety factor.
    BeyondCapacity(f64),
    /// It passes the first of its displacement capacity and the yield and failure of its tendons, wherever they are at
    /// the value tried.
    BeyondLimit,
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
            Self::BeyondLimit => "passing its limit".to_owned(),
            Self::Beyond(displacement_m) => format!("exceeding {displacement_m} m"),
        }
    }
}

/// A displacement that must not be exceeded too often.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exceeded {
    /// The structure's own capacity, whatever that is at the value tried.
    Capacity,
    /// The first of its capacity and the yield and failure of its tendons, wherever they are at the value tried.
    Limit,
    /// So many metres.
    Displacement(f64),
}

/// Reads `0.3`, `capacity` or `limit`.
fn exceeded(text: &str) -> Result<Exceeded, String> {
    match text {
        "capacity" => Ok(Exceeded::Capacity),
        "limit" => Ok(Exceeded::Limit),
        _ => number(text).map(Exceeded::Displacement).map_err(|error| format!("{error}, or `capacity` or `limit`")),
    }
}

/// What is asked of a search for a target risk.
#[derive(Debug, Clone, PartialEq, Args)]
#[command(group = ArgGroup::new("frequency").required(true).args(["overturning", "per_year", "poe", "return_period"]))]
pub struct TargetOptions {
    /// Manifest of the records, if it was moved
    #[arg(long, help_heading = RARE, value_name = "CSV")]
    pub manifest: Option<PathBuf>,
    /// Site [default: the only one]
    #[arg(long)]
    pub site: Option<String>,
    /// Intensity measure [default: pgv]
    #[arg(long)]
    pub measure: Option<IntensityMeasure>,
    /// Use records weighted for hazard consistency (uplift consistency --repair)
    #[arg(long)]
    pub repaired: bool,
    /// Quantity to vary
    #[arg(
        long = "vary",
        value_name = "strength|size|width|capacity|tendon-stiffness",
        hide_possible_values = true,
        value_parser = one_of(&Quantity::ALL, Quantity::key)
    )]
    pub quantity: Quantity,
    /// Target annual rate of overturning, e.g. 2e-4
    #[arg(
        long, value_name = "PER_YEAR", allow_negative_numbers = true, value_parser = number, conflicts_with = "exceed"
    )]
    pub overturning: Option<f64>,
    /// Displacement, m, `capacity`, or `limit`: the first of capacity, tendon yield and failure
    #[arg(long, value_name = "M|capacity|limit", allow_negative_numbers = true, value_parser = exceeded)]
    pub exceed: Option<Exceeded>,
    /// Divide the capacity of `--exceed capacity` by this safety factor
    #[arg(long, value_name = "FS", allow_negative_numbers = true, value_parser = number, default_value_t = 1.0)]
    pub safety_factor: f64,
    /// Target annual rate
    #[arg(long, value_name = "PER_YEAR", allow_negative_numbers = true, value_parser = number)]
    pub per_year: Option<f64>,
    /// Target probability, 0.01 or 1%, in --years
    #[arg(long, value_name = "P", allow_negative_numbers = true, value_parser = number_or_per_cent)]
    pub poe: Option<f64>,
    /// Target return period, years
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    pub return_period: Option<f64>,
    /// Years of the probability [default: the study's]
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number, requires = "poe")]
    pub years: Option<f64>,
    /// Smallest value to try, SI units [default: a quarter of the structure's]
    #[arg(long, help_heading = RARE, value_name = "VALUE", allow_negative_numbers = true, value_parser = number)]
    pub from: Option<f64>,
    /// Largest value to try [default: four times the structure's]
    #[arg(long, help_heading = RARE, value_name = "VALUE", allow_negative_numbers = true, value_parser = number)]
    pub to: Option<f64>,
    /// Relative tolerance of the value
    #[arg(
        long, help_heading = RARE, value_name = "SHARE", allow_negative_numbers = true, value_parser = number,
        default_value_t = TOLERATED
    )]
    pub tolerance: f64,
    /// Return periods, years, at whose levels the fragility is reported
    #[arg(
        long = "at", help_heading = RARE, value_name = "YEARS[,…]", value_delimiter = ',', conflicts_with = "repaired",
        allow_negative_numbers = true, value_parser = number, default_values_t = RETURN_PERIODS
    )]
    pub return_periods: Vec<f64>,
    /// Dispersion of a generic lognormal fragility to compare with
    #[arg(long, help_heading = RARE, value_name = "BETA", allow_negative_numbers = true, value_parser = number)]
    pub generic_dispersion: Option<f64>,
    /// Probability of that fragility at the design level
    #[arg(
        long, help_heading = RARE, value_name = "P", allow_negative_numbers = true, value_parser = number_or_per_cent,
        default_value_t = GENERIC_PROBABILITY, requires = "generic_dispersion"
    )]
    pub generic_probability: f64,
    /// Judge the equivalent oscillator alone, not the frame or block itself
    #[arg(long)]
    pub proxy: bool,
    /// Write all values tried with their risks
    #[arg(long = "output", short = 'o', value_name = "FILE.csv")]
    pub table: Option<PathBuf>,
    /// Whether existing files are overwritten.
    #[command(flatten)]
    pub overwriting: Overwriting,
}

impl TargetOptions {
    /// A search with all defaults; the event and its frequency are still to be set.
    pub fn new(quantity: Quantity) -> Self {
        Self {
            manifest: None,
            site: None,
            measure: None,
            repaired: false,
            quantity,
            overturning: None,
            exceed: None,
            safety_factor: 1.0,
            per_year: None,
            poe: None,
            return_period: None,
            years: None,
            from: None,
            to: None,
            tolerance: TOLERATED,
            return_periods: RETURN_PERIODS.to_vec(),
            generic_dispersion: None,
            generic_probability: GENERIC_PROBABILITY,
            proxy: false,
            table: None,
            overwriting: Overwriting::default(),
        }
    }

    /// What a command has to repeat of this one, with a space before each, to ask the same of another event.
    pub(super) fn repeated(&self) -> String {
        let manifest = self.manifest.as_deref().map(|path| format!(" --manifest {}", typed_path(path)));
        let repaired = self.repaired.then(|| " --repaired".to_owned());
        let numbers = [("from", self.from), ("to", self.to), ("tolerance", Some(self.tolerance))];
        let given = numbers.into_iter().filter_map(|(name, number)| Some((name, number?)));
        let given = given.filter(|given| *given != ("tolerance", TOLERATED));
        let numbers = given.map(|(name, number)| format!(" --{name} {number}"));
        manifest.into_iter().chain(repaired).chain(numbers).collect()
    }

    /// What must not happen too often.
    pub fn event(&self) -> TargetEvent {
        match self.exceed {
            None => TargetEvent::Overturning,
            Some(Exceeded::Capacity) => TargetEvent::BeyondCapacity(self.safety_factor),
            Some(Exceeded::Limit) => TargetEvent::BeyondLimit,
            Some(Exceeded::Displacement(displacement_m)) => TargetEvent::Beyond(displacement_m),
        }
    }

    /// How often it may, 1/yr; a probability is one in `years` (Eq. 4.8).
    pub(super) fn target_per_year(&self, years: f64) -> Result<f64, DesignError> {
        Ok(match (self.overturning.or(self.per_year), self.poe) {
            (Some(per_year), _) => per_year,
            (None, Some(poe)) => rate_from_probability(poe, years)?,
            (None, None) => 1.0 / self.return_period.unwrap_or_default(),
        })
    }

    /// Dispersion β of a generic lognormal fragility, and its probability at the level to design for.
    pub(crate) fn generic(&self) -> Option<(f64, f64)> {
        Some((self.generic_dispersion?, self.generic_probability))
    }

    /// Numbers that can be, but are probably in another unit, or no annual frequency.
    pub(super) fn doubtful(&self) -> Vec<Alarm> {
        let (displacement_m, safety_factor) = match self.event() {
            TargetEvent::Beyond(displacement_m) => (Some(displacement_m), None),
            TargetEvent::BeyondCapacity(factor) => (None, Some(factor)),
            TargetEvent::Overturning | TargetEvent::BeyondLimit => (None, None),
        };
        number_alarms(
            "target",
            &[
                (USUAL_THRESHOLD, "--exceed", displacement_m),
                (USUAL_SAFETY_FACTOR, "--safety-factor", safety_factor),
                (USUAL_TARGET, "the allowed frequency", self.overturning.or(self.per_year)),
            ],
        )
    }

    /// Refuses what cannot be asked, all of it at once.
    pub(super) fn check(&self) -> Result<(), DesignError> {
        if self.safety_factor != 1.0 && self.exceed != Some(Exceeded::Capacity) {
            let reason = "--safety-factor divides a capacity: give --exceed capacity";
            return Err(JobError::Usage(reason.to_owned()).into());
        }
        let mistakes = self.mistakes();
        if mistakes.is_empty() { Ok(()) } else { Err(JobError::Implausible(mistakes).into()) }
    }

    /// Every number that is none, as the command line calls it.
    fn mistakes(&self) -> Vec<Implausible> {
        let mut asked: Vec<(Range, &'static str, f64)> = vec![(TOLERANCE, "--tolerance", self.tolerance)];
        asked.extend(self.from.map(|from| (VALUE, "--from", from)));
        asked.extend(self.to.map(|to| (VALUE, "--to", to)));
        match self.event() {
            TargetEvent::Beyond(displacement_m) => asked.push((THRESHOLD, "--exceed", displacement_m)),
            TargetEvent::BeyondCapacity(factor) => asked.push((SAFETY_FACTOR, "--safety-factor", factor)),
            TargetEvent::Overturning | TargetEvent::BeyondLimit => {}
        }
        match (self.overturning.or(self.per_year), self.poe) {
            (Some(per_year), _) => asked.push((PER_YEAR, "the target", per_year)),
            (None, Some(probability)) => {
                asked.push((PROBABILITY, "--poe", probability));
                asked.extend(self.years.map(|years| (YEARS, "--years", years)));
            }
            (None, None) => asked.push((RETURN_PERIOD, "--return-period", self.return_period.unwrap_or_default())),
        }
        asked.extend(self.return_periods.iter().map(|&years| (RETURN_PERIOD, "--at", years)));
        if let Some((dispersion, probability)) = self.generic() {
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
        let asked = |exceed, safety_factor, per_year| {
            let (exceed, per_year) = (Some(exceed), Some(per_year));
            let options = TargetOptions { exceed, safety_factor, per_year, ..TargetOptions::new(Quantity::Width) };
            options.doubtful().into_iter().map(|alarm| alarm.what).collect::<Vec<_>>()
        };
        let beyond = asked(Exceeded::Displacement(300.0), 1.0, 2e-4);
        assert!(beyond.len() == 1 && beyond[0].starts_with("--exceed is 300 m; usual is"), "{beyond:?}");
        let percentage = asked(Exceeded::Capacity, 150.0, 2e-4);
        assert!(percentage.len() == 1 && percentage[0].starts_with("--safety-factor is 150"), "{percentage:?}");
        let often = asked(Exceeded::Capacity, 1.0, 5.0);
        assert!(often.len() == 1 && often[0].contains("frequency is 5 1/yr"), "{often:?}");
        assert!(asked(Exceeded::Displacement(0.3), 1.0, 2e-4).is_empty());
        assert!(asked(Exceeded::Capacity, 2.5, 0.1).is_empty());
    }

    #[test]
    fn all_mistakes_are_reported_at_once() {
        let asked = TargetOptions {
            exceed: Some(Exceeded::Displacement(-0.1)),
            poe: Some(2.0),
            years: Some(-1.0),
            from: Some(-1.0),
            tolerance: f64::NAN,
            return_periods: vec![0.0, 475.0],
            generic_dispersion: Some(0.0),
            generic_probability: 1.0,
            ..TargetOptions::new(Quantity::Width)
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
        let sound = TargetOptions { overturning: Some(2e-4), ..TargetOptions::new(Quantity::Width) };
        assert_eq!(sound.mistakes(), []);
    }
}
