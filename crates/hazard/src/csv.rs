//! Two-column text into a hazard curve.

use std::borrow::Cow;
use std::path::Path;

use uplift_plausible::{DecimalMarks, counted, with_point};

use crate::component::ComponentDefinition;
use crate::curve::HazardCurve;
pub use crate::declaration::SecondColumn;
use crate::declaration::{self, Column, Declaration};
use crate::error::{HazardError, Place};
use crate::input;
use crate::rates::{AnnualRates, Row, annual_rates};
use crate::text::{excerpt, number};
use crate::unit::{CurveUnit, Dimension, same_unit};

/// Largest file that [`read_path`] takes, unpacked, bytes: a hazard curve has some kilobytes.
pub const MAX_FILE_BYTES: u64 = 4 << 20;

/// What the caller (the study file) says the table holds; a file that says otherwise is refused.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Declared {
    /// Intensity measure, e.g. "PGV".
    pub measure: String,
    /// Unit of the levels, e.g. "cm/s".
    pub unit: String,
}

impl Declared {
    /// The measure and the unit of a table: those given, else those that it says itself. A unit that neither says is
    /// that of the field: cm/s, g or cm.
    ///
    /// # Errors
    /// [`HazardError::File`] without a measure, or without a unit of a measure that is not known.
    pub fn completed(text: &str, name: &str, measure: Option<&str>, unit: Option<&str>) -> Result<Self, HazardError> {
        let fail = |reason: String| HazardError::File { file: name.to_owned(), reason };
        let (said_measure, said_unit) = Self::in_table(text);
        let measure = measure.map(str::to_owned).or(said_measure).ok_or_else(|| {
            if let Some((line, field)) = unknown_name(text) {
                return unknown_column(field, "PGV [cm/s]", Place::Line { file: name.to_owned(), line });
            }
            let reason = "the table does not say its measure: name its columns, for example pgv_cm_s,maf or \
                          pga_g,return_period, add a first line such as \"# IM: PGV [cm/s]\", or give the measure \
                          (--measure; in Python measure=)";
            fail(reason.to_owned())
        })?;
        let of_field = || Some(Dimension::from_measure(&measure)?.field_unit().symbol().to_owned());
        let unit = unit.map(str::to_owned).or(said_unit).or_else(of_field);
        let unit = unit.ok_or_else(|| {
            fail(format!(
                "unknown intensity measure {}: use PGV, PGA, SA(1.0) of any period, AvgSA, PGD, CAV, IA or SI, or give \
                 the unit of its levels (--unit; in Python unit=)",
                excerpt(&measure)
            ))
        })?;
        Ok(Self { measure, unit })
    }

    /// The measure and the unit of the first column of a table, as far as its comment lines and column names say them.
    pub fn in_table(text: &str) -> (Option<String>, Option<String>) {
        let (mut measure, mut unit) = (None, None);
        for column in head(text) {
            if let Column::Intensity(found) = column {
                measure = measure.or(found.measure);
                unit = unit.or(found.unit);
            }
        }
        let unit = unit.map(|unit| CurveUnit::parse(&unit).map_or(unit, |known| known.symbol().to_owned()));
        (measure.map(|measure| measure.to_uppercase()), unit)
    }
}

/// The years that the probabilities of a table refer to, where the name of their column says them: `PoE in 50 years`.
pub fn years_in_table(text: &str) -> Option<f64> {
    head(text).find_map(|column| match column {
        Column::ProbabilityWithin(years) => Some(years),
        _ => None,
    })
}

/// What comment lines and column names among the first lines of a table say, in their order.
fn head(text: &str) -> impl Iterator<Item = Column> {
    let lines = text.trim_start_matches('\u{feff}').lines().take(LONGEST_HEAD);
    lines.flat_map(|line| {
        let line = line.trim().trim_start_matches('"');
        let Some(comment) = line.strip_prefix('#') else {
            return names(line).filter_map(|name| declaration::column(name, None)).collect();
        };
        vec![Column::Intensity(declaration::comment(comment))]
    })
}

/// The first column name that is not known, with its line; none of a table that begins with numbers.
fn unknown_name(text: &str) -> Option<(usize, &str)> {
    let mut rows = text.trim_start_matches('\u{feff}').lines().enumerate();
    let (index, head) = rows.find(|(_, line)| {
        let line = line.trim().trim_start_matches('"');
        !line.is_empty() && !line.starts_with('#')
    })?;
    // blanks may separate numbers
    let is_numbers = |name: &str| name.split_whitespace().all(|word| word.parse::<f64>().is_ok());
    let unknown = |name: &&str| !is_numbers(name) && declaration::column(name, None).is_none();
    Some((index + 1, names(head).find(unknown)?))
}

/// The column names in a line.
fn names(line: &str) -> impl Iterator<Item = &str> {
    line.split([',', ';', '\t']).map(|field| field.trim().trim_matches('"'))
}

/// The message for a column name that is not known: the line that works, with the intensity column `level`.
fn unknown_column(field: &str, level: &str, place: Place) -> HazardError {
    let reason = format!(
        "column name {} is not known: write e.g. \"{level},PoE in 50 years\"; for the second column also \
         {OTHER_NAMES}",
        excerpt(field)
    );
    HazardError::Row { place, reason }
}

/// What the second column may be called.
const HAZARD_NAMES: &str = "maf (rate per year), poe (probability) or return_period (years)";
/// The same beside an example of probabilities.
const OTHER_NAMES: &str = "maf (rate per year) or return_period (years)";

/// Lines among which a table says what it holds.
const LONGEST_HEAD: usize = 50;

/// How to read a table.
#[derive(Debug, Clone, PartialEq)]
pub struct CsvOptions {
    /// Measure and unit of the first column.
    pub declared: Declared,
    /// What the second column holds; needed only for a table without column names.
    pub second_column: Option<SecondColumn>,
    /// Period that probabilities refer to, years; needed only for probabilities.
    pub years: Option<f64>,
}

impl CsvOptions {
    /// Options for a table with column names that holds annual rates.
    pub fn new(measure: impl Into<String>, unit: impl Into<String>) -> Self {
        let declared = Declared { measure: measure.into(), unit: unit.into() };
        Self { declared, second_column: None, years: None }
    }
}

/// A curve read from text, and what was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct CsvCurve {
    /// The curve, in the declared unit.
    pub curve: HazardCurve,
    /// What the second column was taken for: `annual rates`, `probabilities in 50 years`.
    pub read_as: String,
    /// Rows at the end with a rate or probability of zero, which exporters write where the curve has run out.
    pub dropped_zeros: usize,
    /// Rows at the beginning with a probability of 1, to which no rate belongs.
    pub dropped_certain: usize,
}

impl CsvCurve {
    /// What to say of the rows that were left out, each kind by itself.
    pub fn dropped(&self) -> impl Iterator<Item = String> {
        let kinds =
            [(self.dropped_zeros, "zeros at the end"), (self.dropped_certain, "probabilities of 1 at the start")];
        kinds
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{what} of the hazard curve are left out ({count}): they give no annual rate"))
    }
}

/// Reads a hazard curve from a file, which gzip may have packed; see [`read_csv`].
///
/// # Errors
/// [`HazardError::File`] for a file that is missing, larger than [`MAX_FILE_BYTES`] or not UTF-8; else as [`read_csv`].
pub fn read_path(path: &Path, options: &CsvOptions) -> Result<CsvCurve, HazardError> {
    read_csv(&table_text(path)?, &path.display().to_string(), options)
}

/// The text of a file with two columns, unpacked, for [`read_csv`] and [`Declared::in_table`].
///
/// # Errors
/// As [`read_path`] for a file that cannot be read.
pub fn table_text(path: &Path) -> Result<String, HazardError> {
    let advice = "not one hazard curve; keep two columns of one site";
    input::text(input::open(path)?, &path.display().to_string(), MAX_FILE_BYTES, advice)
}

/// Reads a hazard curve from `text`; `name` is the file's name for messages.
///
/// Two columns, separated by comma, semicolon, tab or blanks, with decimal commas too between semicolons or tabs: the
/// level, in the declared unit, and the annual rate of exceedance (1/yr) or the probability of exceedance in
/// [`CsvOptions::years`]. A first row of column names, in any order and case, says which is which (`iml`, `im_g`,
/// `pgv_cm_s`, `PGV [cm/s]`; `maf`, `afe`, `rate`; `poe`, `PoE in 50 years`; `return_period`); without it
/// [`CsvOptions::second_column`] decides. Lines
/// that begin with `#` are kept as the curve's source; where they say `IM: PGV [cm/s]` or `unit: cm/s` they must agree
/// with the declaration; where they say how the horizontal components are combined (`IM: PGV [cm/s], geometric mean
/// (GMRotI50)` or `component: RotD50`), the curve keeps it ([`HazardCurve::component`]).
///
/// Two kinds of rows carry no information and are dropped and counted: zeros at the end, and probabilities of 1 at the
/// beginning (the rate is only known to be large; no value is put in its place, and the curve starts at the next row).
///
/// # Errors
/// [`HazardError`] naming file and line for everything else.
pub fn read_csv(text: &str, name: &str, options: &CsvOptions) -> Result<CsvCurve, HazardError> {
    if text.contains('\0') {
        let reason = format!("holds a null character, and no text does: {}", input::SAVE_AS_UTF8);
        return Err(HazardError::File { file: name.to_owned(), reason });
    }
    let Table { rows, content, years, source, component } = Table::parse(text, name, options)?;
    let place = |line: usize| Place::Line { file: name.to_owned(), line };
    let AnnualRates { rows, dropped_zeros, dropped_certain } = annual_rates(rows, content, years, name, place)?;
    let read_as = match (content, years) {
        (SecondColumn::Probability, Some(years)) => format!("{} in {years} years", content.name()),
        _ => content.name().to_owned(),
    };
    let Declared { measure, unit } = options.declared.clone();
    let (im, maf) = rows.iter().map(|row| (row.im, row.value)).unzip();
    let curve = HazardCurve::new_at(measure, unit, source, im, maf, |index| place(rows[index].at))?;
    Ok(CsvCurve { curve: curve.with_component(component), read_as, dropped_zeros, dropped_certain })
}

/// Lines that a message names; a file of another kind has many.
const MISTAKES_NAMED: usize = 5;

/// The text taken apart: numbers in file order, nothing about hazard checked yet.
struct Table {
    rows: Vec<Row>,
    content: SecondColumn,
    /// That probabilities refer to, as the head or the options have it.
    years: Option<f64>,
    source: String,
    component: Option<ComponentDefinition>,
}

impl Table {
    fn parse(text: &str, name: &str, options: &CsvOptions) -> Result<Self, HazardError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut comments = Vec::new();
        let mut component = None;
        let mut rows: Vec<Row> = Vec::new();
        let mut mistakes = Vec::new();
        let mut more = 0;
        let mut note = |mistake| {
            // what all lines have wrong is said of the first
            let is_said = mistakes.iter().any(|said| same_reason(said, &mistake));
            if !is_said && mistakes.len() < MISTAKES_NAMED { mistakes.push(mistake) } else { more += 1 }
        };
        // Which column is the level, and what the other holds; known from the first row on.
        let mut columns: Option<(usize, SecondColumn)> = None;
        let mut years = options.years;
        // `split` and not `lines`: old spreadsheets end lines with a carriage return alone.
        let unified = text.replace("\r\n", "\n").replace('\r', "\n");
        if has_one_column(&unified) {
            let reason = "one column: two are needed, the intensity and its rate or probability, with a first line \
                          such as \"PGV [cm/s],PoE in 50 years\"";
            return Err(HazardError::File { file: name.to_owned(), reason: reason.to_owned() });
        }
        let commas = has_decimal_commas(&unified, name)?;
        for (index, line) in unified.split('\n').enumerate() {
            let place = Place::Line { file: name.to_owned(), line: index + 1 };
            let line = line.trim();
            // Spreadsheets put a line with commas into quotes.
            let unquoted = line.trim_start_matches('"');
            if let Some(comment) = unquoted.strip_prefix('#') {
                let declaration = declaration::comment(comment);
                check_declaration(&declaration, &options.declared, place.clone())?;
                note_component(&mut component, &declaration, &place)?;
                comments.push(comment.trim().trim_end_matches([',', ';', '"']).to_owned());
                continue;
            }
            let fields = match two_fields(line, &place) {
                Ok(Some(fields)) => fields.map(|field| match with_point(field) {
                    Some(number) if commas => Cow::Owned(number),
                    _ => Cow::Borrowed(field),
                }),
                Ok(None) => continue,
                Err(mistake) => {
                    note(mistake);
                    continue;
                }
            };
            let fields = [&*fields[0], &*fields[1]];
            let header = columns.is_none() && fields.iter().all(|field| field.parse::<f64>().is_err());
            if header {
                columns = Some(read_header(fields, options, &mut years, &place)?);
                continue;
            }
            let (level, _) = match columns {
                Some(columns) => columns,
                None => *columns.insert((0, content_without_header(options, &place)?)),
            };
            match (number(fields[level], || place.clone()), number(fields[1 - level], || place.clone())) {
                (Ok(im), Ok(value)) => rows.push(Row { at: index + 1, im, value }),
                (Err(mistake), _) | (_, Err(mistake)) => note(mistake),
            }
        }
        match mistakes.len() {
            0 => {}
            1 if more == 0 => return Err(mistakes.remove(0)),
            _ => return Err(HazardError::Rows { mistakes, more }),
        }
        let Some((_, content)) = columns else {
            return Err(HazardError::TooFewPoints { name: name.to_owned(), found: 0 });
        };
        let source = if comments.is_empty() { name.to_owned() } else { comments.join("\n") };
        Ok(Self { rows, content, years, source, component })
    }
}

fn same_reason(one: &HazardError, other: &HazardError) -> bool {
    matches!((one, other), (HazardError::Row { reason, .. }, HazardError::Row { reason: other, .. }) if reason == other)
}

/// Whether every row below the first, which may hold names with blanks, has a single field.
fn has_one_column(text: &str) -> bool {
    let is_row = |line: &&str| !line.is_empty() && !line.trim_start_matches('"').starts_with('#');
    let mut below = text.split('\n').map(str::trim).filter(is_row).skip(1).peekable();
    let single = |line: &str| !line.trim_end_matches([',', ';', '\t']).contains([',', ';', '\t', ' ']);
    below.peek().is_some() && below.all(single)
}

/// Whether the numbers of a table have decimal commas, which they can where semicolons or tabs separate the columns.
fn has_decimal_commas(text: &str, name: &str) -> Result<bool, HazardError> {
    let mut marks = DecimalMarks::default();
    for (index, line) in text.split('\n').enumerate() {
        let is_comment = line.trim_start().trim_start_matches('"').starts_with('#');
        if let Some(separator) = [';', '\t'].into_iter().find(|&separator| !is_comment && line.contains(separator)) {
            for field in line.split(separator) {
                marks.see(|| format!("line {}", index + 1), field.trim().trim_matches('"').trim());
            }
        }
    }
    marks.are_commas().map_err(|error| HazardError::File { file: name.to_owned(), reason: error.to_string() })
}

/// The two fields of a row, without quotes; none for an empty line.
fn two_fields<'a>(line: &'a str, place: &Place) -> Result<Option<[&'a str; 2]>, HazardError> {
    let separator = [';', '\t', ','].into_iter().find(|&separator| line.contains(separator));
    let mut fields: Vec<&str> = match separator {
        Some(separator) => line.split(separator).take(9).map(|field| field.trim().trim_matches('"').trim()).collect(),
        None => line.split_whitespace().take(9).collect(),
    };
    // Spreadsheets pad short rows with separators.
    while fields.pop_if(|field| field.is_empty()).is_some() {}
    match fields[..] {
        [] => Ok(None),
        [a, b] => Ok(Some([a, b])),
        _ => {
            let numeric = fields.iter().all(|field| field.parse::<f64>().is_ok());
            let hint = if separator == Some(',') && matches!(fields.len(), 3 | 4) && numeric {
                "; if these are decimal commas, write decimal points, or semicolons between the columns"
            } else {
                "; keep one column of intensity levels and one of annual rates or probabilities"
            };
            let count = match fields.len() {
                count @ ..=8 => counted(count, "column"),
                _ => "more than 8 columns".to_owned(),
            };
            Err(HazardError::Row { place: place.clone(), reason: format!("{count} where 2 are expected{hint}") })
        }
    }
}

/// Which of the two columns is the level, and what the other holds; the years that its name says go to `years`.
fn read_header(
    fields: [&str; 2],
    options: &CsvOptions,
    years: &mut Option<f64>,
    place: &Place,
) -> Result<(usize, SecondColumn), HazardError> {
    let mut level = None;
    let mut content = None;
    for (index, field) in fields.into_iter().enumerate() {
        match declaration::column(field, Some(&options.declared.measure)) {
            Some(Column::Intensity(found)) => {
                check_declaration(&found, &options.declared, place.clone())?;
                level = Some(index);
            }
            Some(Column::Hazard(found)) => content = Some(found),
            Some(Column::ProbabilityWithin(found)) => {
                if let Some(declared) = years.replace(found).filter(|declared| declared.total_cmp(&found).is_ne()) {
                    return Err(HazardError::Contradiction {
                        place: place.clone(),
                        what: "period of the probabilities",
                        found: format!("{found} years"),
                        declared: format!("{declared} years"),
                    });
                }
                content = Some(SecondColumn::Probability);
            }
            None => {
                let Declared { measure, unit } = &options.declared;
                return Err(unknown_column(field, &format!("{measure} [{unit}]"), place.clone()));
            }
        }
    }
    let (Some(level), Some(content)) = (level, content) else {
        let [a, b] = fields.map(excerpt);
        let reason = format!("columns {a} and {b}: one must hold levels (iml), the other {HAZARD_NAMES}");
        return Err(HazardError::Row { place: place.clone(), reason });
    };
    // a return period is an annual rate, written otherwise
    let holds = if content == SecondColumn::ReturnPeriod { SecondColumn::AnnualRate } else { content };
    match options.second_column {
        Some(declared) if declared != holds => Err(HazardError::Contradiction {
            place: place.clone(),
            what: "second column",
            found: content.name().to_owned(),
            declared: declared.name().to_owned(),
        }),
        _ => Ok((level, content)),
    }
}

fn content_without_header(options: &CsvOptions, place: &Place) -> Result<SecondColumn, HazardError> {
    options.second_column.ok_or_else(|| {
        let reason = "no column names before the first numbers: add the line \"iml,maf\" (rates per year), \"iml,poe\" \
                      (probabilities) or \"iml,return_period\" (years)";
        HazardError::Row { place: place.clone(), reason: reason.to_owned() }
    })
}

fn check_declaration(found: &Declaration, declared: &Declared, place: Place) -> Result<(), HazardError> {
    let contradiction = |what, found: &str, declared: &str| {
        Err(HazardError::Contradiction { place, what, found: excerpt(found), declared: excerpt(declared) })
    };
    match (&found.measure, &found.unit) {
        (Some(measure), _) if !declaration::same_measure(measure, &declared.measure) => {
            contradiction("measure", measure, &declared.measure)
        }
        (_, Some(unit)) if !same_unit(unit, &declared.unit) => contradiction("unit", unit, &declared.unit),
        _ => Ok(()),
    }
}

/// Keeps the definition that a comment names; two lines must not name two.
fn note_component(
    known: &mut Option<ComponentDefinition>,
    declaration: &Declaration,
    place: &Place,
) -> Result<(), HazardError> {
    if let Some(doubtful) = &declaration.doubtful {
        let reason = format!(
            "{} seems to say how horizontal components are combined, and is not one of {}: write one of these, or \
             other words",
            excerpt(doubtful),
            ComponentDefinition::ACCEPTED
        );
        return Err(HazardError::Row { place: place.clone(), reason });
    }
    for &found in &declaration.components {
        let before = *known.get_or_insert(found);
        if before != found {
            let (found, declared) = (found.to_string(), before.to_string());
            return Err(HazardError::Contradiction { place: place.clone(), what: "component", found, declared });
        }
    }
    Ok(())
}
