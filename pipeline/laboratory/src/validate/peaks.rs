//! A table of peaks: a row a motion, its value perhaps a collapse, or known to be above a limit only.

use std::path::Path;

use uplift_job::{JobError, ReferenceTable};
use uplift_result::{ResultFile, is_hdf5};
use uplift_studies::shake_table::columns;

use crate::error::LaboratoryError;

/// Units that a column's name may end in, by quantity, with what makes SI units of them.
const UNITS: [&[(&str, f64)]; 5] = [
    &[("m", 1.0), ("cm", 1e-2), ("mm", 1e-3)],
    &[("n", 1.0), ("kn", 1e3)],
    &[("m_s2", 1.0), ("cm_s2", 1e-2), ("g", 9.806_65)],
    &[("rad", 1.0), ("deg", std::f64::consts::PI / 180.0)],
    &[("", 1.0), ("percent", 1e-2)],
];
/// Which of them are lengths.
const LENGTHS: usize = 0;

/// A peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PeakValue {
    /// As it was measured or computed.
    Finite(f64),
    /// None: the structure overturned.
    Overturned,
    /// Above this limit, where the reading ended.
    Above(f64),
}

impl PeakValue {
    /// Its place among all: whatever has no value is above all that have one.
    pub(super) fn ranked(self) -> f64 {
        match self {
            Self::Finite(value) => value,
            Self::Overturned | Self::Above(_) => f64::INFINITY,
        }
    }

    /// The same, but what is above a limit at it.
    pub(super) fn at_limit(self) -> f64 {
        match self {
            Self::Finite(value) | Self::Above(value) => value,
            Self::Overturned => f64::INFINITY,
        }
    }
}

/// A row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Its line below the header, from 1.
    pub(super) number: usize,
    /// Cells of the key columns.
    pub(super) key: Vec<String>,
    /// Cells of the columns that the rows are grouped by; none where the table has no such column.
    pub(super) groups: Vec<Option<String>>,
    /// The peak; none where the cell says that there is none.
    pub(super) value: Option<PeakValue>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Peaks {
    /// What it is, in messages: `measured tests.csv`.
    pub(super) name: String,
    /// The column of the values.
    pub(super) column: String,
    /// Key columns that it lacks.
    pub(super) missing_keys: Vec<String>,
    /// Grouping columns that it lacks.
    pub(super) missing_groups: Vec<String>,
    pub(super) rows: Vec<Row>,
}

impl Peaks {
    /// Reads the table `what` (measured, computed): its column `value`, or the same quantity in another unit.
    ///
    /// # Errors
    /// A file that is no table, or has no such column, or two of them; cells that are no peaks: all of them.
    pub(super) fn read(
        what: &str,
        file: &Path,
        value: &str,
        keys: &[String],
        groups: &[String],
    ) -> Result<Self, LaboratoryError> {
        let table = table(what, file)?;
        let (column, factor) = column_of(&table, value)?;
        let missing = |names: &[String]| names.iter().filter(|name| !table.has(name)).cloned().collect::<Vec<_>>();
        let (mut rows, mut mistakes) = (Vec::new(), Vec::new());
        for row in 0..table.rows() {
            match peak(&table.text(&column, row), factor) {
                Ok(value) => rows.push(Row {
                    number: row + 1,
                    key: keys.iter().map(|name| table.text(name, row)).collect(),
                    groups: groups.iter().map(|name| table.has(name).then(|| table.text(name, row))).collect(),
                    value,
                }),
                Err(reason) => {
                    mistakes.push(format!("{what} {}, row {}, {column}: {reason}", file.display(), row + 1));
                }
            }
            for name in groups.iter().filter(|name| table.has(name) && table.text(name, row).is_empty()) {
                mistakes.push(format!(
                    "{what} {}, row {}, {name}: blank, and rows are grouped by it",
                    file.display(),
                    row + 1
                ));
            }
        }
        if mistakes.is_empty() && rows.is_empty() {
            return Err(table.fail("it has no rows below its header").into());
        }
        if !mistakes.is_empty() {
            return Err(JobError::Inputs(mistakes).into());
        }
        let name = format!("{what} {}", file.display());
        Ok(Self { name, column, missing_keys: missing(keys), missing_groups: missing(groups), rows })
    }
}

/// A table of a user, or the tests of a result.
fn table(what: &str, file: &Path) -> Result<ReferenceTable, LaboratoryError> {
    if !is_hdf5(file) {
        return Ok(ReferenceTable::read_as(what, file)?);
    }
    let tests = ResultFile::open(file)?.shake_table()?;
    Ok(ReferenceTable::from_columns(format!("{what} {}", file.display()), columns(&tests))?)
}

/// The unit in the name of a quantity, in words: `u_m` is in m; a name without one is a pure number.
pub(super) fn unit_of(value: &str) -> &'static str {
    split(value).map_or("", |(_, unit, _)| unit)
}

/// How many metres the unit of a length is, by the name of its column; none of other quantities.
pub(super) fn metres_of(value: &str) -> Option<f64> {
    let (_, unit, _) = split(value)?;
    UNITS[LENGTHS].iter().find_map(|(name, metres)| (*name == unit).then_some(*metres))
}

/// Stem, unit and quantity of a name; the longest unit that it may end in.
fn split(value: &str) -> Option<(&str, &'static str, usize)> {
    let with_unit = UNITS.iter().enumerate().flat_map(|(quantity, units)| {
        units.iter().filter_map(move |(unit, _)| {
            let stem = value.strip_suffix(unit)?.strip_suffix('_').filter(|_| !unit.is_empty())?;
            Some((stem, *unit, quantity))
        })
    });
    with_unit.max_by_key(|(_, unit, _)| unit.len()).or(Some((value, "", UNITS.len() - 1)))
}

/// The column of a quantity in whatever unit, with what makes the unit of `value` of its numbers.
fn column_of(table: &ReferenceTable, value: &str) -> Result<(String, f64), LaboratoryError> {
    let (stem, unit, quantity) = split(value).unwrap_or((value, "", UNITS.len() - 1));
    let named = |unit: &str| if unit.is_empty() { stem.to_owned() } else { format!("{stem}_{unit}") };
    let si = |wanted: &str| UNITS[quantity].iter().find(|(unit, _)| *unit == wanted).map_or(1.0, |(_, si)| *si);
    let found: Vec<&str> =
        UNITS[quantity].iter().map(|(unit, _)| *unit).filter(|unit| table.has(&named(unit))).collect();
    let all = |units: &mut dyn Iterator<Item = &str>| units.map(named).collect::<Vec<_>>().join(", ");
    match found[..] {
        [of_table] => Ok((named(of_table), if of_table == unit { 1.0 } else { si(of_table) / si(unit) })),
        [] => Err(table
            .fail(format!(
                "it has none of the columns {}: name the column of the peaks by --value, with its unit at the end. It \
                 has {}",
                all(&mut UNITS[quantity].iter().map(|(unit, _)| *unit)),
                table.columns().join(", ")
            ))
            .into()),
        _ => Err(table.fail(format!("it has the columns {}: leave one", all(&mut found.iter().copied()))).into()),
    }
}

/// A cell; none where it says that there is no value.
fn peak(cell: &str, factor: f64) -> Result<Option<PeakValue>, String> {
    let number = |text: &str| {
        let value: f64 = text.trim().parse().map_err(|_| {
            format!(
                "{cell:?} is not a peak: write a number with a decimal point, inf or overturned for a collapse, >0.35 \
                 above a limit, or leave it blank"
            )
        })?;
        if value < 0.0 {
            Err(format!("{cell} is below 0: peaks are largest absolute values"))
        } else {
            Ok(factor * value)
        }
    };
    match cell.to_ascii_lowercase().as_str() {
        // a NaN of C's printf has a sign
        "" | "nan" | "-nan" | "+nan" | "na" | "-" => Ok(None),
        "overturned" => Ok(Some(PeakValue::Overturned)),
        _ => match cell.strip_prefix('>').map(number).transpose()? {
            Some(limit) if limit.is_finite() => Ok(Some(PeakValue::Above(limit))),
            Some(_) => Err(format!("{cell:?}: nothing is above that; a collapse is inf or overturned")),
            None => number(cell)
                .map(|value| Some(if value.is_infinite() { PeakValue::Overturned } else { PeakValue::Finite(value) })),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells() {
        for (cell, expected) in [
            ("12.5", Some(PeakValue::Finite(0.0125))),
            ("0", Some(PeakValue::Finite(0.0))),
            ("inf", Some(PeakValue::Overturned)),
            ("Overturned", Some(PeakValue::Overturned)),
            ("> 350", Some(PeakValue::Above(1e-3 * 350.0))),
            ("", None),
            ("NaN", None),
            ("-nan", None),
        ] {
            assert_eq!(peak(cell, 1e-3), Ok(expected), "{cell}");
        }
        for cell in ["0,35", "-0.1", "-inf", ">", ">inf", ">-1", "0.35 m"] {
            assert!(peak(cell, 1.0).is_err(), "{cell}");
        }
    }

    #[test]
    fn units_of_names() {
        for (name, unit) in
            [("u_m", "m"), ("u_cm", "cm"), ("a_m_s2", "m_s2"), ("drift", ""), ("drift_percent", "percent")]
        {
            assert_eq!(unit_of(name), unit, "{name}");
        }
        assert_eq!(split("base_shear_n"), Some(("base_shear", "n", 1)));
        assert_eq!(["u_mm", "u_m", "base_shear_n"].map(metres_of), [Some(1e-3), Some(1.0), None]);
    }
}
