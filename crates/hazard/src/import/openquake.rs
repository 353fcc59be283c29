//! Hazard curves as the `OpenQuake` engine writes them into CSV.
//!
//! # Source
//! `OpenQuake` engine manual, "Outputs from Classical PSHA"; exports of versions 2 to 3.

use std::io::{BufRead, Read};
use std::sync::Arc;

use super::entry::{Entry, Head};
use super::measure::openquake_unit;
use super::{SitePlace, Statistic, coordinates, unreadable};
use crate::declaration::SecondColumn;
use crate::error::{HazardError, Place};
use crate::input::{Input, NOT_UTF8};
use crate::text::{excerpt, fields, number, origin};

/// Longest line, bytes: thousands of levels fit.
const MAX_LINE_BYTES: u64 = 1 << 20;

/// The sites of a file, read one at a time.
pub(super) struct Rows {
    lines: Lines,
    head: Arc<Head>,
    columns: Columns,
    /// Whether any site was met, or an error that ended the file.
    any: bool,
}

/// What the columns hold.
struct Columns {
    separator: char,
    meaning: Vec<Column>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    Longitude,
    Latitude,
    Name,
    Vs30,
    Probability(f64),
    Other,
}

impl Rows {
    /// Reads the comment line and the column names.
    pub(super) fn new(input: Input, name: &str) -> Result<Self, HazardError> {
        let mut lines = Lines { input, file: name.to_owned(), buffer: Vec::new(), line: 0, ended: false };
        let mut comment = None;
        while let Some((number, line)) = lines.next()? {
            let unquoted = line.trim_start_matches('"');
            if let Some(text) = unquoted.strip_prefix('#') {
                // Cells before the text pad the line to the width of the table.
                comment.get_or_insert_with(|| (number, text.trim_matches([',', ';', '"', ' ', '\t']).to_owned()));
            } else if !line.is_empty() {
                let columns = Columns::parse(line, || Place::Line { file: name.to_owned(), line: number })?;
                let head = head(name, comment, &columns)?;
                return Ok(Self { lines, head: Arc::new(head), columns, any: false });
            }
        }
        Err(HazardError::File { file: name.to_owned(), reason: NO_CURVES.to_owned() })
    }
}

const NO_CURVES: &str = "no hazard curve in it; export the hazard curves (hcurves) again";

impl Iterator for Rows {
    type Item = Result<Entry, HazardError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let (number, line) = match self.lines.next() {
                Ok(Some(numbered)) => numbered,
                Ok(None) if self.any => return None,
                Ok(None) => {
                    self.any = true;
                    let (file, reason) = (self.lines.file.clone(), NO_CURVES.to_owned());
                    return Some(Err(HazardError::File { file, reason }));
                }
                Err(error) => {
                    self.any = true;
                    return Some(Err(error));
                }
            };
            if !line.is_empty() && !line.starts_with('#') {
                self.any = true;
                return Some(entry(line, number, &self.columns, &self.head));
            }
        }
    }
}

fn entry(text: &str, line: usize, columns: &Columns, head: &Arc<Head>) -> Result<Entry, HazardError> {
    let place = || Place::Line { file: head.file.clone(), line };
    let (mut longitude, mut latitude, mut name, mut vs30_m_s) = (f64::NAN, f64::NAN, None, None);
    let mut values = Ok(Vec::with_capacity(head.levels.len()));
    let mut found = 0;
    for (field, meaning) in fields(text, columns.separator).zip(&columns.meaning) {
        found += 1;
        match meaning {
            Column::Longitude => longitude = number(field, place)?,
            Column::Latitude => latitude = number(field, place)?,
            Column::Name => name = Some(field.to_owned()).filter(|name| !name.is_empty()),
            Column::Vs30 => vs30_m_s = Some(number(field, place)?),
            Column::Probability(_) => {
                if let Ok(read) = &mut values {
                    match number(field, || head.place(Some(line), read.len())) {
                        Ok(value) => read.push(value),
                        Err(error) => values = Err(error),
                    }
                }
            }
            Column::Other => {}
        }
    }
    let all = fields(text, columns.separator).count();
    let expected = columns.meaning.len();
    if found < expected || all > expected {
        let reason = format!("{all} columns where the column names are {expected}; export the file again");
        return Err(HazardError::Row { place: place(), reason });
    }
    let (longitude_deg, latitude_deg) = coordinates(longitude, latitude, place)?;
    let site = SitePlace { name, longitude_deg, latitude_deg };
    Ok(Entry { head: Arc::clone(head), line: Some(line), site, vs30_m_s, values })
}

impl Columns {
    fn parse(line: &str, place: impl Fn() -> Place) -> Result<Self, HazardError> {
        let fail = |reason: String| Err(HazardError::Row { place: place(), reason });
        let separator = ['\t', ';'].into_iter().find(|&separator| line.contains(separator)).unwrap_or(',');
        let mut meaning = Vec::new();
        let mut has_name = false;
        for name in fields(line, separator) {
            let column = match name {
                "lon" | "longitude" => Column::Longitude,
                "lat" | "latitude" => Column::Latitude,
                "custom_site_id" => Column::Name,
                "site_id" | "name" if !has_name => Column::Name,
                "vs30" => Column::Vs30,
                _ => match name.strip_prefix("poe-") {
                    Some(level) => match level.parse::<f64>() {
                        Ok(level) if level.is_finite() => Column::Probability(level),
                        _ => return fail(format!("column {}: no level after \"poe-\"", excerpt(name))),
                    },
                    None => Column::Other,
                },
            };
            has_name |= column == Column::Name;
            meaning.push(column);
        }
        let count = |wanted: Column| meaning.iter().filter(|&&column| column == wanted).count();
        if !meaning.iter().any(|column| matches!(column, Column::Probability(_))) {
            // It lies among the curves, and `*.csv` takes it along.
            if fields(line, separator).any(|name| matches!(name, "rlz_id" | "branch_path")) {
                return fail(
                    "the realizations of a logic tree with their weights, no hazard curves: leave the file out here, \
                     and give it as the weights (--weights)"
                        .to_owned(),
                );
            }
            return fail(
                "no columns \"poe-...\": not an OpenQuake export of hazard curves, NRML or JSON of the USGS; a file \
                 of two columns needs no import: name it in a study"
                    .to_owned(),
            );
        }
        if count(Column::Longitude) != 1 || count(Column::Latitude) != 1 || count(Column::Name) > 1 {
            return fail("columns lon and lat must be there once each, and a site name at most once".to_owned());
        }
        Ok(Self { separator, meaning })
    }
}

/// What the comment line says of all rows.
fn head(name: &str, comment: Option<(usize, String)>, columns: &Columns) -> Result<Head, HazardError> {
    let missing = |what: &str| HazardError::File {
        file: name.to_owned(),
        reason: format!(
            "the comment line before the column names does not say {what}; keep the line that the engine writes first"
        ),
    };
    let (line, comment) = comment.ok_or_else(|| missing("measure and period"))?;
    let place = || Place::Line { file: name.to_owned(), line };
    let measure = value(&comment, "imt").ok_or_else(|| missing("the measure (imt='PGA')"))?;
    let years = value(&comment, "investigation_time").ok_or_else(|| missing("investigation_time"))?;
    let levels = columns.meaning.iter().filter_map(|column| match column {
        Column::Probability(level) => Some(*level),
        _ => None,
    });
    Ok(Head {
        file: name.to_owned(),
        unit: openquake_unit(measure, place)?,
        measure: measure.to_owned(),
        kind: value(&comment, "kind").map_or(Ok(Statistic::Unspecified), |kind| statistic(kind, place))?,
        content: SecondColumn::Probability,
        years: Some(number(years, place)?),
        levels: levels.collect(),
        source: origin(&comment),
        component: None,
    })
}

/// The value of `key=value` in the comment: in quotes of either kind, doubled where a spreadsheet did so, or bare.
pub(super) fn value<'a>(comment: &'a str, key: &str) -> Option<&'a str> {
    let after = comment.match_indices(key).find_map(|(at, _)| {
        let before = comment[..at].chars().next_back();
        let whole_word = before.is_none_or(|c| !(c.is_alphanumeric() || c == '_'));
        comment[at + key.len()..].trim_start().strip_prefix('=').filter(|_| whole_word)
    })?;
    let after = after.trim_start();
    let value = match after.chars().next()? {
        quote @ ('\'' | '"') => after.trim_start_matches(quote).split(quote).next(),
        _ => after.split([',', ';', '"', '\'', ' ']).next(),
    };
    value.map(str::trim).filter(|value| !value.is_empty())
}

/// `mean`, `quantile-0.15` or `rlz-003`.
fn statistic(kind: &str, place: impl FnOnce() -> Place) -> Result<Statistic, HazardError> {
    let quantile = || kind.strip_prefix("quantile-")?.parse().ok().filter(|q| (0.0..=1.0).contains(q));
    let realization = || kind.strip_prefix("rlz-")?.parse().ok();
    if kind == "mean" {
        Ok(Statistic::Mean)
    } else if let Some(quantile) = quantile() {
        Ok(Statistic::Quantile(quantile))
    } else if let Some(number) = realization() {
        Ok(Statistic::Realization(number))
    } else {
        let kind = excerpt(kind);
        let reason =
            format!("kind {kind} in the comment is not a hazard curve to use; export mean, quantile-... or rlz-...");
        Err(HazardError::Row { place: place(), reason })
    }
}

/// Lines with their numbers, none of them longer than [`MAX_LINE_BYTES`].
struct Lines {
    input: Input,
    file: String,
    buffer: Vec<u8>,
    /// Number of the line read last.
    line: usize,
    ended: bool,
}

impl Lines {
    fn place(&self) -> Place {
        Place::Line { file: self.file.clone(), line: self.line }
    }

    /// The next line with its number, trimmed; after an error there are no more.
    fn next(&mut self) -> Result<Option<(usize, &str)>, HazardError> {
        if self.ended {
            return Ok(None);
        }
        self.buffer.clear();
        self.line += 1;
        let read = self.input.as_mut().take(MAX_LINE_BYTES + 1).read_until(b'\n', &mut self.buffer);
        // Until the line has proved to be good.
        self.ended = true;
        match read {
            Err(error) => return Err(unreadable(&self.file, &error)),
            Ok(0) => return Ok(None),
            Ok(_) => {}
        }
        if self.buffer.len() as u64 > MAX_LINE_BYTES {
            let reason = format!("a line longer than {MAX_LINE_BYTES} bytes: not an export of hazard curves");
            return Err(HazardError::Row { place: self.place(), reason });
        }
        let Ok(text) = std::str::from_utf8(&self.buffer) else {
            return Err(HazardError::Row { place: self.place(), reason: NOT_UTF8.to_owned() });
        };
        self.ended = false;
        Ok(Some((self.line, text.trim_start_matches('\u{feff}').trim())))
    }
}
