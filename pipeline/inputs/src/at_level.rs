//! Records of their own at each level: the table that `records.at_level` names, one row a record at a level.

mod factors;
mod sets;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use uplift_atomic_file::read_file;
use uplift_motion::IntensityMeasure;
use uplift_study::{MeasurePlan, did_you_mean};

use super::record::Record;
pub use factors::{far_factors, relative_factors};
pub use sets::AtLevel;
use uplift_job::checksum::checksum;
use uplift_job::table::plain;
use uplift_job::text::{counted, first_names};
use uplift_job::text_table;

/// The column of record names, as a manifest has it.
pub(crate) const RECORD: &str = "record_id";
/// That of scale factors.
const FACTOR: &str = "factor";
/// That of weights.
const WEIGHT: &str = "weight";
/// The most that a table has.
const LARGEST_BYTES: u64 = 64 << 20;
/// How far a level of the table may be from that of the study, relative: both may have been rounded to so many digits.
const SAME_LEVEL: f64 = 1e-6;
/// By how much a factor may miss level over intensity beside the rounding of its own decimals before it is reported.
const FACTOR_TOLERANCE: f64 = 1e-3;

/// A record at a level, as the table has it.
#[derive(Debug, Clone, PartialEq)]
struct Row {
    /// Counted from 1, below the header.
    number: usize,
    record: String,
    level: f64,
    /// The factor with half a unit of its last decimal; none where the table has no factors.
    factor: Option<(f64, f64)>,
    weight: f64,
}

/// The table, read and not yet held against records and levels.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Table {
    name: String,
    rows: Vec<Row>,
    /// What deserves a look.
    notes: Vec<String>,
    checksum: String,
}

/// Reads the table at `path` of levels of `measure`.
///
/// # Errors
/// Everything that is wrong with it by itself, a line each.
pub(super) fn read(path: &Path, measure: IntensityMeasure) -> Result<Table, Vec<String>> {
    let bytes = read_file(path, LARGEST_BYTES).map_err(|error| vec![format!("records.at_level {error}")])?;
    read_bytes(&bytes, path, measure)
}

/// Refuses what a study would refuse by itself in a table with these `bytes` that is to lie at `path`.
pub(crate) fn check_bytes(bytes: &[u8], path: &Path, measure: IntensityMeasure) -> Result<(), Vec<String>> {
    read_bytes(bytes, path, measure).map(drop)
}

fn read_bytes(bytes: &[u8], path: &Path, measure: IntensityMeasure) -> Result<Table, Vec<String>> {
    let name = path.display().to_string();
    let table = text_table::parse(bytes, &[RECORD])
        .map_err(|reason| vec![format!("{name} cannot be read as a CSV table with a header row: {reason}")])?;
    let columns: Vec<&str> = table.get_column_names().iter().map(|column| column.trim()).collect();
    let level_column = level_column(measure);
    let missing: Vec<&str> = [RECORD, &level_column].into_iter().filter(|column| !columns.contains(column)).collect();
    if !missing.is_empty() {
        return Err(vec![format!(
            "{name} has no column {}: it needs {RECORD} and {level_column}, the level of {} in {}, beside these factor \
             and weight if wanted; found {}",
            missing.join(", "),
            measure.label(),
            measure.unit(),
            columns.join(", ")
        )]);
    }
    let notes = other_columns(&name, &columns, &[RECORD, &level_column, FACTOR, WEIGHT])?;
    let position = |wanted: &str| columns.iter().position(|column| *column == wanted);
    let cell = |column: Option<usize>, row: usize| -> Option<&str> {
        Some(plain(table.columns().get(column?)?.str().ok()?.get(row)?.trim()))
    };
    let (record, level) = (position(RECORD), position(&level_column));
    let (factor, weight) = (position(FACTOR), position(WEIGHT));
    let (mut rows, mut mistakes) = (Vec::new(), Vec::new());
    let mut seen: BTreeMap<(String, u64), usize> = BTreeMap::new();
    for index in 0..table.height() {
        let number = index + 1;
        let mut positive = |column: Option<usize>, what: &str| -> Option<(f64, f64)> {
            let text = cell(column, index).unwrap_or_default();
            let found = text.parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0);
            if found.is_none() {
                mistakes.push(format!("{name}, row {number}: {what} is {text:?}: a number above 0 is needed"));
            }
            Some((found?, half_a_unit(text)))
        };
        let level = positive(level, &level_column);
        let factor = factor.map(|column| positive(Some(column), FACTOR));
        let weight = weight.map_or(Some((1.0, 0.0)), |column| positive(Some(column), WEIGHT));
        let record = cell(record, index).unwrap_or_default();
        if record.is_empty() {
            mistakes.push(format!("{name}, row {number}: {RECORD} is empty: a record of the manifest is needed"));
            continue;
        }
        let (Some((level, _)), Some((weight, _))) = (level, weight) else { continue };
        if let Some(before) = seen.insert((record.to_owned(), level.to_bits()), number) {
            mistakes.push(format!(
                "{name}, row {number}: {record} is at {level} {} in row {before} already: give it one row, and the \
                 weight that it is to have",
                measure.unit()
            ));
        }
        let factor = match factor {
            Some(None) => continue,
            Some(factor) => factor,
            None => None,
        };
        rows.push(Row { number, record: record.to_owned(), level, factor, weight });
    }
    if rows.is_empty() && mistakes.is_empty() {
        mistakes.push(format!("{name} names no record"));
    }
    if mistakes.is_empty() { Ok(Table { name, rows, notes, checksum: checksum(bytes) }) } else { Err(mistakes) }
}

/// What is said of columns beside the `known` ones.
///
/// # Errors
/// One that is probably a known one, misspelt: left out it would change the numbers silently.
fn other_columns(name: &str, columns: &[&str], known: &[&str]) -> Result<Vec<String>, Vec<String>> {
    let missing: Vec<&str> = known.iter().copied().filter(|column| !columns.contains(column)).collect();
    let others: Vec<&str> = columns.iter().copied().filter(|column| !known.contains(column)).collect();
    let meant = |column: &&str| {
        // scale_factor, weight_of_record
        let holds = |known: &&&str| column.to_lowercase().split([' ', '_']).any(|word| word == **known);
        let held = missing.iter().find(holds).map(|known| format!("did you mean `{known}`?"));
        let meant = held.or_else(|| did_you_mean(column, &missing))?;
        Some(format!("{name}: unknown column `{column}`: {meant} Name it so, or leave it out"))
    };
    let mistakes: Vec<String> = others.iter().filter_map(meant).collect();
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let told = (!others.is_empty())
        .then(|| format!("{name}: {} not used: {}", counted(others.len(), "column"), first_names(&others)));
    Ok(told.into_iter().collect())
}

/// The column of the levels of `measure`: `pgv_cm_s`, `sa_1s_g`.
pub(crate) fn level_column(measure: IntensityMeasure) -> String {
    format!("{}_{}", measure.key(), measure.unit_key())
}

/// Half a unit of the last decimal of a number: how far it may have been rounded.
fn half_a_unit(number: &str) -> f64 {
    let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let exponent: f64 = exponent.parse().unwrap_or(0.0);
    0.5 * 10.0_f64.powf(exponent - decimals as f64)
}

impl Table {
    /// Whether it names the pair `id`, or a component of it.
    pub(super) fn names(&self) -> BTreeSet<&str> {
        let pair = |name: &'_ str| name.strip_suffix(":h1").or_else(|| name.strip_suffix(":h2")).map(str::len);
        self.rows.iter().map(|row| &row.record[..pair(&row.record).unwrap_or(row.record.len())]).collect()
    }

    /// Which of the `records` are run at which level of `plan`: these records, in their order, and what deserves a
    /// look.
    ///
    /// # Errors
    /// Records that are not there, levels that the study has not, and levels of the study without a record.
    pub(super) fn select(
        &self,
        records: Vec<Record>,
        plan: &MeasurePlan,
    ) -> Result<(Vec<Record>, AtLevel, Vec<String>), Vec<String>> {
        let levels = &plan.levels;
        let named: BTreeSet<&str> = self.rows.iter().map(|row| row.record.as_str()).collect();
        let records: Vec<Record> = records.into_iter().filter(|record| named.contains(record.id.as_str())).collect();
        let place: BTreeMap<&str, usize> =
            records.iter().enumerate().map(|(index, record)| (record.id.as_str(), index)).collect();
        let missing: Vec<&str> = named.iter().copied().filter(|name| !place.contains_key(name)).collect();
        let level_of = |level: f64| levels.iter().position(|own| (level / own - 1.0).abs() <= SAME_LEVEL);
        let mut mistakes = Vec::new();
        if !missing.is_empty() {
            mistakes.push(format!(
                "{}: {} are not among the records of the study: {} (names are those of the manifest; with component = \
                 \"both\", RSN753:h1 and RSN753:h2)",
                self.name,
                counted(missing.len(), "record"),
                first_names(&missing)
            ));
        }
        mistakes.extend(self.other_levels(plan, level_of));
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let mut factors = vec![f64::NAN; records.len() * levels.len()];
        let mut weights = vec![0.0; records.len() * levels.len()];
        let mut apart: Vec<(f64, String)> = Vec::new();
        for row in &self.rows {
            let (Some(level), Some(&record)) = (level_of(row.level), place.get(row.record.as_str())) else { continue };
            let amplitude = |value: f64| plan.measure.amplitude(value);
            let intensity = records[record].intensity(plan.measure);
            let expected = amplitude(levels[level]) / amplitude(intensity);
            let cell = &mut factors[record * levels.len() + level];
            if !cell.is_nan() {
                mistakes.push(format!("{}, row {}: {} is at this level twice", self.name, row.number, row.record));
            }
            *cell = row.factor.map_or(expected, |(factor, _)| factor);
            weights[level * records.len() + record] = row.weight;
            if let Some((factor, rounding)) = row.factor
                && (factor - expected).abs() > rounding + FACTOR_TOLERANCE * expected
            {
                let (unit, label) = (plan.measure.unit(), plan.measure.label());
                apart.push((
                    (factor / expected).ln().abs(),
                    format!(
                        "row {}: {} by {factor}, where {} {unit} over its {label} of {intensity:.6} {unit} make \
                     {expected:.4}",
                        row.number, row.record, levels[level]
                    ),
                ));
            }
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let shares = shares(&mut weights, records.len());
        let notes = self.notes.iter().cloned().chain(self.told(apart, plan)).collect();
        Ok((records, AtLevel { factors, shares, checksum: self.checksum.clone() }, notes))
    }

    /// Levels of the table that the study has not, and of the study that the table has not.
    fn other_levels(&self, plan: &MeasurePlan, level_of: impl Fn(f64) -> Option<usize>) -> Option<String> {
        let mut own: Vec<f64> = self.rows.iter().map(|row| row.level).collect();
        own.sort_by(f64::total_cmp);
        own.dedup();
        let unknown: Vec<String> =
            own.iter().filter(|level| level_of(**level).is_none()).map(ToString::to_string).collect();
        let filled: BTreeSet<usize> = own.iter().filter_map(|level| level_of(*level)).collect();
        let empty: Vec<String> = (plan.levels.iter().enumerate())
            .filter(|(index, _)| !filled.contains(index))
            .map(|(_, level)| level.to_string())
            .collect();
        let unit = plan.measure.unit();
        let mut parts = Vec::new();
        if !unknown.is_empty() {
            parts.push(format!("the study has no level of {} {unit}", first_names(&unknown)));
        }
        if !empty.is_empty() {
            parts.push(format!("the table names no record at the study's {} {unit}", first_names(&empty)));
        }
        let all: Vec<String> = own.iter().map(ToString::to_string).collect();
        let key = uplift_study::levels_key(plan.measure);
        (!parts.is_empty()).then(|| {
            format!("{}: {}: the table's own levels are {key} = [{}]", self.name, parts.join("; "), all.join(", "))
        })
    }

    /// Factors that do not bring a record to its level.
    fn told(&self, mut apart: Vec<(f64, String)>, plan: &MeasurePlan) -> Option<String> {
        apart.sort_by(|a, b| b.0.total_cmp(&a.0));
        let shown: Vec<&str> = apart.iter().take(3).map(|(_, text)| text.as_str()).collect();
        (!apart.is_empty()).then(|| {
            format!(
                "{}: {} of {} factors miss the level of their record by more than rounding, {}{}: the record is run \
                 with the factor of the table; is {} there that of the study, of the same components?",
                self.name,
                apart.len(),
                self.rows.len(),
                shown.join("; "),
                if apart.len() > shown.len() { "; …" } else { "" },
                plan.measure.label()
            )
        })
    }
}

/// Shares of the weights `[level, record]`; none where every record is at every level and all count alike.
fn shares(weights: &mut [f64], records: usize) -> Option<Vec<f64>> {
    let alike = |row: &[f64]| row.iter().all(|weight| *weight > 0.0 && weight.to_bits() == row[0].to_bits());
    if weights.chunks_exact(records).all(alike) {
        return None;
    }
    for row in weights.chunks_exact_mut(records) {
        // weights near the largest numbers would add up to infinity
        let largest = row.iter().copied().fold(0.0, f64::max);
        let sum: f64 = row.iter().map(|weight| weight / largest).sum();
        for weight in row {
            *weight = *weight / largest / sum;
        }
    }
    Some(weights.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<Table, Vec<String>> {
        read_bytes(text.as_bytes(), Path::new("sets.csv"), IntensityMeasure::Pgv)
    }

    #[test]
    fn rows_are_read_and_mistakes_reported_at_once() {
        let read = table("record_id,pgv_cm_s,factor,weight\nRSN1,10,0.50,2\nRSN2:h1,10,1.5e0,1\n").unwrap();
        assert_eq!(read.rows[0].factor, Some((0.5, 0.005)));
        assert_eq!((read.rows[1].factor, read.rows[1].weight), (Some((1.5, 0.05)), 1.0));
        assert_eq!(read.names().into_iter().collect::<Vec<_>>(), ["RSN1", "RSN2"]);
        assert_eq!(table("record_id,pgv_cm_s\nRSN1,10\n").unwrap().rows[0].factor, None);
        let mistakes =
            table("record_id,pgv_cm_s,factor\nRSN1,-1,1\n,10,1\nRSN2,10,inf\nRSN3,5,1\nRSN3,5,1\n").unwrap_err();
        assert_eq!(mistakes.len(), 4, "{mistakes:?}");
        for (mistake, words) in mistakes.iter().zip(["row 1: pgv_cm_s is \"-1\"", "row 2", "row 3: factor", "in row 4"])
        {
            assert!(mistake.contains(words), "{mistake}");
        }
        let missing = table("record,pga_g\nRSN1,10\n").unwrap_err();
        assert!(missing[0].contains("no column record_id, pgv_cm_s") && missing[0].contains("found record, pga_g"));
        assert!(table("record_id,pgv_cm_s\n").unwrap_err()[0].contains("names no record"));
        for (column, meant) in [("wieght", "weight"), ("Weight", "weight"), ("scale_factor", "factor")] {
            let misspelt = table(&format!("record_id,pgv_cm_s,{column}\nRSN1,10,1\n")).unwrap_err();
            let expected = format!("unknown column `{column}`: did you mean `{meant}`?");
            assert!(misspelt.len() == 1 && misspelt[0].contains(&expected), "{misspelt:?}");
        }
        let other = table("record_id,pgv_cm_s,magnitude\nRSN1,10,6.5\n").unwrap();
        assert_eq!(other.notes, ["sets.csv: 1 column not used: magnitude"]);
        assert!(table("PK\u{3}\u{4}").is_err() && table("").is_err());
    }

    #[test]
    fn weights_become_shares_unless_all_count_alike() {
        assert_eq!(shares(&mut [2.0, 2.0, 0.3, 0.3], 2), None);
        assert_eq!(shares(&mut [2.0, 2.0, 1.0, 3.0], 2), Some(vec![0.5, 0.5, 0.25, 0.75]));
        assert_eq!(shares(&mut [1.0, 0.0, 1.0, 1.0], 2), Some(vec![1.0, 0.0, 0.5, 0.5]));
        assert_eq!(shares(&mut [f64::MAX, f64::MAX, 1e-300, 0.0], 2), Some(vec![0.5, 0.5, 1.0, 0.0]));
    }

    #[test]
    fn decimals_say_how_far_a_number_was_rounded() {
        for (text, half) in [("0.50", 0.005), ("2", 0.5), ("1.5e-3", 5e-5), ("1.25E2", 0.5)] {
            assert!((half_a_unit(text) / half - 1.0).abs() < 1e-12, "{text}");
        }
    }
}
