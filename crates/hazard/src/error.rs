//! Everything that can be wrong with a hazard curve.

use std::fmt;

use uplift_plausible::counted;

use crate::text::shown_end;

/// Where a value stands: a point of arrays handed over, a line of a file, or a level in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// Index into the arrays, counted from 0.
    Point(usize),
    /// Line of a text, counted from 1.
    Line {
        /// Name of the file as the caller gave it.
        file: String,
        /// Line number.
        line: usize,
    },
    /// One level of a curve among others in a file, in words: file, line where there are lines, and level.
    Level(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(index) => write!(f, "point {index} (counted from 0)"),
            Self::Line { file, line } => write!(f, "{file}, line {line}"),
            Self::Level(level) => f.write_str(level),
        }
    }
}

/// Refuses an argument that is not finite and above 0.
pub(crate) fn check_positive(what: &'static str, value: f64) -> Result<(), HazardError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(HazardError::Argument { what, value, must_be: "a finite number above 0" })
}

fn list(mistakes: &[HazardError], more: usize) -> String {
    let mut lines: Vec<String> = mistakes.iter().map(ToString::to_string).collect();
    if more > 0 {
        lines.push(format!("and {}", counted(more, "more line")));
    }
    lines.join("; ")
}

/// What to do about rates that do not fall.
const OF_RATES: &str = ": correct the rates, export them with more digits, or remove the row";
/// The same of rates of exactly 1.
const OF_ONES: &str = ". These look like probabilities. Name the column `PoE in 50 years`, in a study kind = \"poe\" \
                       and years = 50";

/// Why a hazard curve could not be built, read or evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HazardError {
    // The curve
    /// Fewer than two points.
    #[error("{name}: a hazard curve needs at least 2 points with a positive rate, found {found}")]
    TooFewPoints {
        /// The curve's measure, or the file.
        name: String,
        /// Points left.
        found: usize,
    },
    /// `im` and `maf` differ in length.
    #[error("hazard curve: {im} intensity levels but {maf} rates; give one rate per level")]
    LengthMismatch {
        /// Number of levels.
        im: usize,
        /// Number of rates.
        maf: usize,
    },
    /// The measure or the unit is an empty text.
    #[error("hazard curve: the {what} is empty; name it, e.g. measure \"PGV\" in unit \"cm/s\"")]
    EmptyLabel {
        /// "measure" or "unit".
        what: &'static str,
    },
    /// A level or rate that is not a finite number above zero.
    #[error("{place}: {what} is {value}, it must be a finite number above 0")]
    NotPositive {
        /// Where.
        place: Place,
        /// The quantity with its unit.
        what: String,
        /// The value found.
        value: f64,
    },
    /// Levels that do not increase.
    #[error(
        "{place}: intensity {value} {unit} does not exceed {previous} {unit} at {previous_place}; sort the rows by \
         intensity and remove repeated ones"
    )]
    LevelsNotIncreasing {
        /// Where the offending level stands.
        place: Place,
        /// Where the level before it stands.
        previous_place: Place,
        /// The offending level.
        value: f64,
        /// The level before it.
        previous: f64,
        /// Unit of both.
        unit: String,
    },
    /// Rates that do not decrease.
    #[error(
        "{place}: annual rate {value} 1/yr {} at {previous_place}; rates must fall{}",
        if value == previous { "equals that".to_owned() } else { format!("is not below {previous} 1/yr") },
        if *value == 1.0 && *previous == 1.0 { OF_ONES } else { OF_RATES }
    )]
    RatesNotDecreasing {
        /// Where the offending rate stands.
        place: Place,
        /// Where the rate before it stands.
        previous_place: Place,
        /// The offending rate, 1/yr.
        value: f64,
        /// The rate before it, 1/yr.
        previous: f64,
    },
    /// The unit is not one of the measure's dimension.
    #[error("measure {measure} cannot be in \"{unit}\": use {expected}")]
    UnitOfMeasure {
        /// The measure.
        measure: String,
        /// The unit given.
        unit: String,
        /// Units that fit.
        expected: &'static str,
    },
    /// No conversion is known between two units.
    #[error("hazard curve of {measure}: cannot convert \"{from}\" to \"{to}\"; use cm/s or m/s, or g, m/s2 or cm/s2")]
    Conversion {
        /// The measure.
        measure: String,
        /// Unit of the curve.
        from: String,
        /// Unit asked for.
        to: String,
    },

    // Evaluation
    /// An intensity outside the curve, extrapolation refused.
    #[error(
        "{measure} = {value} {unit} lies outside the hazard curve, which spans {} to {} {unit}; check the unit of the \
         curve, give a curve that covers it, or choose log-log extrapolation (risk.extrapolate = \"loglog\")",
        shown_end(*first, *value),
        shown_end(*last, *value)
    )]
    LevelOutside {
        /// The measure.
        measure: String,
        /// Level asked for.
        value: f64,
        /// Unit of the levels.
        unit: String,
        /// First level of the curve.
        first: f64,
        /// Last level of the curve.
        last: f64,
    },
    /// A rate outside the curve, extrapolation refused.
    #[error(
        "annual rate {value} 1/yr lies outside the hazard curve of {measure}, which spans {first} down to {last} \
         1/yr; give a curve that covers it, or choose log-log extrapolation (risk.extrapolate = \"loglog\")"
    )]
    RateOutside {
        /// The measure.
        measure: String,
        /// Rate asked for, 1/yr.
        value: f64,
        /// Rate of the first point, 1/yr.
        first: f64,
        /// Rate of the last point, 1/yr.
        last: f64,
    },
    /// An argument that is not a finite number in its range.
    #[error("{what} is {value}, it must be {must_be}")]
    Argument {
        /// The argument with its unit.
        what: &'static str,
        /// The value given.
        value: f64,
        /// The range allowed.
        must_be: &'static str,
    },
    /// An extrapolated value too large or too small for a number.
    #[error(
        "extrapolating the hazard curve of {measure} to {value} {unit} leaves the range of numbers; stay nearer to \
         the curve"
    )]
    ExtrapolationRange {
        /// The measure.
        measure: String,
        /// Value asked for.
        value: f64,
        /// Its unit.
        unit: String,
    },

    // Text
    /// The file cannot be read.
    #[error("{file}: {reason}")]
    File {
        /// The path as given.
        file: String,
        /// What went wrong and what to do.
        reason: String,
    },
    /// A line that cannot be understood.
    #[error("{place}: {reason}")]
    Row {
        /// File and line.
        place: Place,
        /// What is wrong and what to do.
        reason: String,
    },
    /// Several lines that cannot be understood.
    #[error("{}", list(mistakes, *more))]
    Rows {
        /// The first of them.
        mistakes: Vec<HazardError>,
        /// How many there are beside these.
        more: usize,
    },
    /// The file says something else than the caller.
    #[error("{place}: the file says {what} {found}, but {declared} is declared; correct the one that is wrong")]
    Contradiction {
        /// File and line.
        place: Place,
        /// "measure", "unit", "component" or "second column".
        what: &'static str,
        /// What the file says.
        found: String,
        /// What the caller declared.
        declared: String,
    },
    /// A table of probabilities without the period they belong to.
    #[error(
        "{place}: probabilities of exceedance need the years that they refer to: \"PoE in 50 years\" as the column's \
         name, or years = 50 beside the curve in the study"
    )]
    YearsMissing {
        /// File and line.
        place: Place,
    },
    /// A probability that no rate belongs to.
    #[error("{place}: probability of exceedance {value} has no annual rate, -ln(1 - p) needs 0 < p < 1; {hint}")]
    Probability {
        /// File and line.
        place: Place,
        /// The value found.
        value: f64,
        /// What to do.
        hint: &'static str,
    },
    /// A rate or probability of zero before the end of the table.
    #[error(
        "{place}: zero here, but {later_place} has {later} again; only zeros at the end can be dropped, so correct or \
         remove this row"
    )]
    ZeroInside {
        /// Where the zero stands.
        place: Place,
        /// Where the next positive value stands.
        later_place: Place,
        /// That value.
        later: f64,
    },

    // Names and exports
    /// A way to combine horizontal components that is not known.
    #[error(
        "unknown component definition {found}; use one of {accepted}",
        accepted = crate::ComponentDefinition::ACCEPTED
    )]
    Component {
        /// What was given, quoted.
        found: String,
    },
    /// No site of the file is the one asked for.
    #[error("{file}: no site named {wanted}; {known}")]
    SiteNotFound {
        /// The file.
        file: String,
        /// The name asked for, quoted.
        wanted: String,
        /// What the file has instead.
        known: String,
    },
    /// Two curves for one site, measure and statistic.
    #[error("{place}: the {curve} is there twice{earlier}; remove one of them")]
    DuplicateSite {
        /// Where the second one stands.
        place: Place,
        /// Statistic, measure and site of both.
        curve: String,
        /// Where the first one stands, as a half-sentence; may be empty.
        earlier: String,
    },
}
