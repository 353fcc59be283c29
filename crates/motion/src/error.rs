//! The errors of this crate.

use std::path::PathBuf;

use crate::recording::RecordFormat;
use crate::unit::AccelerationUnit;

/// Why a file cannot be read, without the number that the operating system has for it.
fn unreadable_because(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        std::io::ErrorKind::NotADirectory => "a part of the path is a file, not a folder".to_owned(),
        _ => format!("cannot be read: {}", error.to_string().split(" (os error").next().unwrap_or_default()),
    }
}

/// A number with six digits, as messages show it.
pub fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// What can be wrong with ground motions given from outside.
///
/// In every variant `name` is the file (or record) as the caller called it, and `line` counts
/// from one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The time step is not a finite number above zero.
    #[error("time step is {dt_s} s; it must be finite and above zero")]
    TimeStep {
        /// The step given \[s\].
        dt_s: f64,
    },
    /// There are fewer than two samples.
    #[error("too few samples: {count}; an accelerogram needs at least 2")]
    TooFewSamples {
        /// Number of samples given.
        count: usize,
    },
    /// A sample is not finite.
    #[error("acceleration sample {index} (counted from 0) is {value} m/s2; all must be finite")]
    Sample {
        /// Index of the sample, from zero.
        index: usize,
        /// Its value \[m/s²\].
        value: f64,
    },
    /// The two components of a pair have different time steps where they must have the same.
    #[error("time steps of the two components are {h1_s} s and {h2_s} s; they must be equal: resample one of them")]
    UnequalTimeSteps {
        /// The step of the first component \[s\].
        h1_s: f64,
        /// The step of the second component \[s\].
        h2_s: f64,
    },
    /// A number of a record is beyond what any record has.
    #[error(transparent)]
    Implausible(#[from] uplift_plausible::Implausible),
    /// The acceleration of gravity is not a finite number above zero.
    #[error("gravity is {gravity_m_s2} m/s2; it must be finite and above zero")]
    Gravity {
        /// The value given \[m/s²\].
        gravity_m_s2: f64,
    },
    /// A pair cannot be scaled to a level of its intensity measure.
    #[error(
        "cannot scale a record whose intensity measure is {measure} to {level}: \
         the measure must be finite and above zero, the level finite and not negative"
    )]
    Scale {
        /// The level to reach, in the unit of the measure.
        level: f64,
        /// The measure of the unscaled pair, in the same unit.
        measure: f64,
    },
    /// A word is not among those accepted.
    #[error("unknown {what} \"{given}\"; use one of: {accepted}")]
    UnknownWord {
        /// What the word should have named.
        what: &'static str,
        /// The word given.
        given: String,
        /// The accepted words.
        accepted: &'static str,
    },
    /// A file cannot be opened or read.
    #[error("{}: {}", path.display(), unreadable_because(reason))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        #[source]
        reason: std::io::Error,
    },
    /// A file is far larger than any accelerogram.
    #[error("{name}: more than {limit_bytes} bytes; this cannot be one accelerogram")]
    TooLarge {
        /// The file.
        name: String,
        /// The largest size accepted \[bytes\].
        limit_bytes: u64,
    },
    /// A file is an archive of others.
    #[error(
        "{name}: is a zip archive: `uplift records import {name} -o manifest.csv` unpacks it and finds its records"
    )]
    Archive {
        /// The file.
        name: String,
    },
    /// A file is of another kind.
    #[error("{name}: is {found}, not a record")]
    OtherKind {
        /// The file.
        name: String,
        /// What it is, and what takes it.
        found: &'static str,
    },
    /// No line of the head gives number of points and time step.
    #[error(
        "{name}: no line with NPTS and DT among the first {searched}; \
         line 4 of an AT2 file reads like \"NPTS= 4000, DT= .0050 SEC\""
    )]
    NoPointCount {
        /// The file.
        name: String,
        /// Number of lines searched.
        searched: usize,
    },
    /// The number of points or the time step in the head cannot be read.
    #[error(
        "{name}, line {line}: cannot read {key} in \"{text}\"; \
         expected e.g. \"{expected}\", with a decimal point"
    )]
    HeaderValue {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// What is read, e.g. `NPTS`.
        key: &'static str,
        /// The line's text.
        text: String,
        /// How such a line reads.
        expected: &'static str,
    },
    /// The head lacks something that the motion cannot be had without.
    #[error(
        "{name}: the head of this {format} file has no {key}: the file is damaged or cut, or it has another format; \
         name the format, or get the file again"
    )]
    HeaderLacks {
        /// The file.
        name: String,
        /// The format it was read as.
        format: RecordFormat,
        /// What is missing.
        key: &'static str,
    },
    /// A file holds no acceleration at all.
    #[error("{name}: no acceleration in this {format} file, only {found}; give the acceleration file")]
    NoAcceleration {
        /// The file.
        name: String,
        /// The format it was read as.
        format: RecordFormat,
        /// What it holds.
        found: String,
    },
    /// A file holds several components and none is chosen, or one that is not there.
    #[error(
        "{name}: the components of this file are {components}; give the number of one as its channel, 1 to {found}"
    )]
    Channel {
        /// The file.
        name: String,
        /// Number of components.
        found: usize,
        /// What they are called.
        components: String,
    },
    /// A compressed file that cannot be unpacked.
    #[error("{name}: cannot be unpacked ({reason}): the file is damaged or cut; get it again")]
    Compressed {
        /// The file.
        name: String,
        /// What is wrong with it.
        #[source]
        reason: std::io::Error,
    },
    /// The file holds something else than acceleration.
    #[error("{name}, line {line}: \"{text}\": not an acceleration; give the acceleration file")]
    NotAcceleration {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// The line's text.
        text: String,
    },
    /// The head names a unit that is not known.
    #[error(
        "{name}, line {line}: unknown acceleration unit in \"{text}\"; known units: {}. Convert the values and \
         correct the line, or remove the unit from the line and give that of the values (--unit; unit in a manifest \
         and in Python)",
        AccelerationUnit::ACCEPTED
    )]
    HeaderUnit {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// The line's text.
        text: String,
    },
    /// The values are counts of a recorder, and the head does not say what one count is.
    #[error(
        "{name}, line {line}: \"{text}\": counts, and the head gives no scale (least significant bit in microvolts, \
         sensitivity in volts per g); give the processed record (Volume 1 or 2)"
    )]
    CountsWithoutScale {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// The line's text.
        text: String,
    },
    /// Neither the file nor the caller says the unit.
    #[error(
        "{name}: the file does not say its unit of acceleration; give the unit (--unit; unit in a manifest and in \
         Python), one of: {}",
        AccelerationUnit::ACCEPTED
    )]
    MissingUnit {
        /// The file.
        name: String,
    },
    /// Neither the file nor the caller says the time step.
    #[error(
        "{name}: one column of accelerations and no time step; give the time step in seconds (--dt-s; dt_s in \
         a manifest and in Python), or a file with two columns (time, acceleration)"
    )]
    MissingTimeStep {
        /// The file.
        name: String,
    },
    /// Neither the file nor the caller says unit and time step.
    #[error(
        "{name}: one column of accelerations without unit and time step; give both: the unit (--unit; unit in a \
         manifest and in Python), one of: {}; and the time step in seconds (--dt-s; dt_s)",
        AccelerationUnit::ACCEPTED
    )]
    MissingUnitAndTimeStep {
        /// The file.
        name: String,
    },
    /// The number of values differs from the head.
    #[error("{name}: header says {declared} points, file has {found}: the file is damaged or cut; get it again")]
    PointCount {
        /// The file.
        name: String,
        /// NPTS of the head.
        declared: u64,
        /// Values found.
        found: usize,
    },
    /// A piece of text is not a finite number.
    #[error("{name}, line {line}: \"{token}\" {reason}")]
    Number {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// The text, shortened where it is long.
        token: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The text ends within a number.
    #[error(
        "{name}, line {line}: \"{token}\" is not a number after {found} of {declared} points: the file is cut; get it \
         again"
    )]
    CutNumber {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// What is there of the number.
        token: String,
        /// Values in the lines above.
        found: usize,
        /// Number of points that the head says.
        declared: u64,
    },
    /// A line has a wrong number of columns.
    #[error("{name}, line {line}: number of columns {found}, expected {expected}{hint}")]
    ColumnCount {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// Columns found.
        found: usize,
        /// What was expected.
        expected: &'static str,
        /// A further hint, or nothing.
        hint: &'static str,
    },
    /// The times of a two-column file are not equally spaced.
    #[error(
        "{name}, line {line}: time {time_s} s, expected {} s at a uniform step of {} s (within a quarter of it); \
         resample the record to a uniform step{hint}",
        six_digits(*expected_s),
        six_digits(*dt_s)
    )]
    UnevenTime {
        /// The file.
        name: String,
        /// The line.
        line: usize,
        /// Time found \[s\].
        time_s: f64,
        /// Time expected \[s\].
        expected_s: f64,
        /// Mean time step of the file \[s\].
        dt_s: f64,
        /// A further hint, or nothing.
        hint: &'static str,
    },
    /// What a file holds is not an accelerogram.
    #[error("{name}: {reason}")]
    InFile {
        /// The file.
        name: String,
        /// What is wrong.
        #[source]
        reason: Box<MotionError>,
    },
    /// A file of selected records cannot be used.
    #[error("{name}{}: {reason}", line.map_or_else(String::new, |line| format!(", line {line}")))]
    Selection {
        /// The file.
        name: String,
        /// The line; none where it is the file as a whole.
        line: Option<usize>,
        /// What is wrong with it, and what to do.
        reason: String,
    },
    /// An option of the synthetic record set is out of its range.
    #[error("synthetic record set: {option} is {value}; it must be {allowed}")]
    SyntheticOption {
        /// Name of the option, with its unit.
        option: &'static str,
        /// The value given.
        value: f64,
        /// The values allowed, in words.
        allowed: &'static str,
    },
    /// Too few of the candidate pairs reach the least peak ground acceleration.
    #[error(
        "synthetic record set: {kept} of {tried} candidate pairs reach the geometric-mean PGA of \
         {minimum_pga_g} g, {wanted} were asked for: lower minimum_pga_g or ask for fewer pairs"
    )]
    SyntheticCandidates {
        /// Pairs kept.
        kept: usize,
        /// Candidates tried.
        tried: u64,
        /// Pairs asked for.
        wanted: usize,
        /// Least geometric-mean peak ground acceleration \[g\].
        minimum_pga_g: f64,
    },
}
