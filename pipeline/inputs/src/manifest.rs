//! The manifest of a record set: a CSV table with one row a pair of components.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component as PathPart, Path, PathBuf};

use polars::prelude::{Column, DataFrame};
use uplift_atomic_file::{folder_of, read_file};
use uplift_job::table::plain;
use uplift_job::text_table;
use uplift_motion::{AccelerationUnit, RecordFormat};

/// A row of a manifest.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Identifier of the record.
    pub id: String,
    /// Both horizontal components.
    pub components: [ComponentFile; 2],
    /// The vertical component, where it is named; it need not be there unless a study asks for it.
    pub vertical: Option<ComponentFile>,
    /// Time step of text files that do not say it, s.
    pub dt_s: Option<f64>,
    /// Unit of files that do not say it.
    pub unit: Option<AccelerationUnit>,
    /// Layout of both files; none to tell it by their content.
    pub format: Option<RecordFormat>,
    /// The other columns, blank cells left out.
    pub metadata: BTreeMap<String, String>,
}

/// Where one component is.
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentFile {
    /// The file.
    pub path: PathBuf,
    /// Which component of a file with several, counted from one.
    pub channel: Option<usize>,
    /// SHA-256 that the file had when the manifest was made.
    pub sha256: Option<String>,
}

/// Columns that hold numbers, with the most that each can be.
const NUMBERS: [(&str, f64); 5] = [
    ("magnitude", 10.0),
    ("rrup_km", 20_000.0),
    ("repi_km", 20_100.0),
    ("vs30", 10_000.0),
    ("lowest_usable_hz", 1000.0),
];

/// The most that a manifest has; one of 100 000 records has some 50 MB.
const LARGEST_BYTES: u64 = 256 << 20;

const REQUIRED: [&str; 3] = ["record_id", "file_h1", "file_h2"];

/// Rows of the manifest at `path` whose `set_tags` hold `tag`, or all.
///
/// # Errors
/// Everything that is wrong with it, a line each.
pub fn read(path: &Path, tag: Option<&str>) -> Result<Vec<Row>, Vec<String>> {
    read_bytes(&file_bytes(path)?, path, tag)
}

/// What the file at `path` contains; of a folder of records, which is what people have, how to make a manifest.
fn file_bytes(path: &Path) -> Result<Vec<u8>, Vec<String>> {
    read_file(path, LARGEST_BYTES).map_err(|error| {
        let name = path.display();
        vec![if path.is_dir() {
            format!(
                "{name} is a folder, not a manifest: make one of its records: \
                 uplift records import {name} -o records.csv"
            )
        } else {
            format!("manifest {error}")
        }]
    })
}

/// The files of the records that the manifest at `path` lists; none where it cannot be read, or is no manifest.
pub fn record_files(path: &Path) -> Vec<PathBuf> {
    let rows = read(path, None).unwrap_or_default();
    rows.into_iter().flat_map(|row| row.components.into_iter().chain(row.vertical)).map(|file| file.path).collect()
}

/// The same of a manifest with these `bytes` that is to lie at `path`.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_bytes(bytes: &[u8], path: &Path, tag: Option<&str>) -> Result<Vec<Row>, Vec<String>> {
    let name = path.display();
    let table = parse(bytes)
        .map_err(|reason| vec![format!("manifest {name} cannot be read as a CSV table with a header row: {reason}")])?;
    let missing: Vec<&str> = REQUIRED.into_iter().filter(|column| table.get_column_index(column).is_none()).collect();
    if !missing.is_empty() {
        let found: Vec<String> = table.get_column_names().iter().map(ToString::to_string).collect();
        return Err(vec![format!(
            "manifest {name} has no column {}: it needs {}; found {}",
            missing.join(", "),
            REQUIRED.join(", "),
            found.join(", ")
        )]);
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut mistakes = Vec::new();
    let mut ids = BTreeSet::new();
    let mut tags = BTreeSet::new();
    let mut rows = Vec::new();
    for index in 0..table.height() {
        let mut cells = cells(&table, index);
        let row_tags: Vec<String> = cells.get("set_tags").map_or_else(Vec::new, |text| {
            text.split([';', ',', ' ', '\t']).filter(|word| !word.is_empty()).map(str::to_owned).collect()
        });
        let wanted = tag.is_none_or(|tag| row_tags.iter().any(|word| word == tag));
        tags.extend(row_tags);
        if wanted {
            match row(&mut cells, folder) {
                Ok(row) if !ids.insert(row.id.clone()) => {
                    mistakes.push(format!("manifest {name}, row {}: record {} is listed twice", index + 1, row.id));
                }
                Ok(row) => rows.push(row),
                Err(reasons) => {
                    mistakes
                        .extend(reasons.iter().map(|reason| format!("manifest {name}, row {}: {reason}", index + 1)));
                }
            }
        }
    }
    if let (true, Some(tag)) = (rows.is_empty() && mistakes.is_empty(), tag) {
        let known = if tags.is_empty() {
            "it has no set_tags".to_owned()
        } else {
            format!("its tags are {}", tags.into_iter().collect::<Vec<_>>().join(", "))
        };
        mistakes.push(format!("manifest {name} has no record with the tag {tag:?}: {known}"));
    } else if rows.is_empty() && mistakes.is_empty() {
        mistakes.push(format!("manifest {name} lists no records"));
    }
    if mistakes.is_empty() { Ok(rows) } else { Err(mistakes) }
}

/// The columns of the manifest at `path` with the rows named `ids`, their paths seen from `folder`.
///
/// # Errors
/// Everything that is wrong with it, a line each.
pub fn rows_of(path: &Path, ids: &BTreeSet<&str>, folder: &Path) -> Result<Vec<Column>, Vec<String>> {
    let fail = |reason: String| vec![format!("manifest {} cannot be read: {reason}", path.display())];
    let table = parse(&file_bytes(path)?).map_err(fail)?;
    let origin = path.parent().unwrap_or(Path::new(""));
    let text = |column: &Column, row: usize| -> String {
        let cell = plain(column.str().ok().and_then(|cells| cells.get(row)).unwrap_or_default().trim()).to_owned();
        if ["file_h1", "file_h2", "file_v"].contains(&column.name().as_str()) && !cell.is_empty() {
            relative(&origin.join(cell), folder)
        } else {
            cell
        }
    };
    let named = |row: &usize| table.column("record_id").is_ok_and(|column| ids.contains(text(column, *row).as_str()));
    let rows: Vec<usize> = (0..table.height()).filter(named).collect();
    let chosen = |column: &Column| {
        Column::new(column.name().clone(), rows.iter().map(|&row| text(column, row)).collect::<Vec<String>>())
    };
    Ok(table.columns().iter().map(chosen).collect())
}

/// `path` seen from `folder`, as the manifest in that folder names it: both can be moved together.
pub fn relative(path: &Path, folder: &Path) -> String {
    let absolute = |path: &Path| std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    // the last part may be a link to elsewhere, and keeps its name
    let file = path.file_name().unwrap_or_default();
    let path = absolute(folder_of(path)).join(file);
    let folder = absolute(if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    let (mut from, mut to) = (folder.components().peekable(), path.components().peekable());
    while from.peek().is_some() && from.peek() == to.peek() {
        from.next();
        to.next();
    }
    let up = from.filter(|part| matches!(part, PathPart::Normal(_))).map(|_| PathPart::ParentDir);
    up.chain(to).collect::<PathBuf>().to_string_lossy().into_owned()
}

/// Columns whose cells stay as they stand.
const TEXTS: [&str; 3] = ["record_id", "station_code", "set_tags"];

fn parse(bytes: &[u8]) -> Result<DataFrame, String> {
    text_table::parse(bytes, &TEXTS)
}

fn cells(table: &DataFrame, index: usize) -> BTreeMap<String, String> {
    table
        .columns()
        .iter()
        .filter_map(|column| {
            let text = plain(column.str().ok()?.get(index)?.trim());
            (!text.is_empty()).then(|| (column.name().trim().to_owned(), text.to_owned()))
        })
        .collect()
}

fn row(cells: &mut BTreeMap<String, String>, folder: &Path) -> Result<Row, Vec<String>> {
    let Some(id) = cells.remove("record_id") else {
        return Err(vec!["record_id is blank: every record needs a name".to_owned()]);
    };
    let mut mistakes = Vec::new();
    for (column, text) in cells.iter().map(|(column, text)| (column.as_str(), text)).chain([("record_id", &id)]) {
        if text.contains('\0') {
            mistakes.push(format!("record {id}: {column} holds a null character: leave it out"));
        }
    }
    let components = [1, 2].map(|number| {
        let column = &format!("file_h{number}");
        let path = match cells.remove(column).map(|text| folder.join(text)) {
            Some(path) if path.is_file() => path,
            Some(path) => {
                let what = if path.exists() { "is not a file" } else { "is missing" };
                mistakes.push(format!("record {id}: {column} {} {what}", path.display()));
                path
            }
            None => {
                mistakes.push(format!(
                "record {id}: {column} is blank: both horizontal components are needed, since the intensity is their \
                 geometric mean"
            ));
                PathBuf::new()
            }
        };
        named(path, &format!("h{number}"), &id, cells, &mut mistakes)
    });
    let vertical = cells.remove("file_v").map(|text| named(folder.join(text), "v", &id, cells, &mut mistakes));
    let dt_s = cells.get("dt_s").and_then(|text| match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Some(value),
        _ => {
            mistakes.push(format!("record {id}: dt_s is {text:?}: give the sampling interval in seconds"));
            None
        }
    });
    let unit = cells.get("unit").and_then(|text| {
        text.parse::<AccelerationUnit>().map_err(|error| mistakes.push(format!("record {id}: {error}"))).ok()
    });
    for (key, most) in NUMBERS {
        let Some(text) = cells.get(key) else { continue };
        match text.parse::<f64>() {
            // -999 and the like stand for what is not known
            Ok(value) if value <= -99.0 => drop(cells.remove(key)),
            Ok(value) if (0.0..=most).contains(&value) => {}
            Err(_) if text.replace(',', ".").parse::<f64>().is_ok() => {
                mistakes.push(format!(
                    "record {id}: {key} is {text:?}: a decimal comma; write a point, or semicolons between the columns"
                ));
            }
            _ => mistakes
                .push(format!("record {id}: {key} is {text:?}: give a number from 0 to {most}, or leave it blank")),
        }
    }
    let format = cells.remove("format").and_then(|text| {
        text.parse::<RecordFormat>().map_err(|error| mistakes.push(format!("record {id}: {error}"))).ok()
    });
    if mistakes.is_empty() {
        Ok(Row { id, components, vertical, dt_s, unit, format, metadata: std::mem::take(cells) })
    } else {
        Err(mistakes)
    }
}

/// The component in the file at `path` with what the other cells of `component`, `h1`, `h2` or `v`, say of it.
fn named(
    path: PathBuf,
    component: &str,
    id: &str,
    cells: &mut BTreeMap<String, String>,
    mistakes: &mut Vec<String>,
) -> ComponentFile {
    let key = format!("channel_{component}");
    let channel = cells.remove(&key).and_then(|text| match text.parse::<usize>() {
        Ok(channel) if channel > 0 => Some(channel),
        _ => {
            mistakes.push(format!(
                "record {id}: {key} is {text:?}: give the number of the component in its file, 1 or above"
            ));
            None
        }
    });
    ComponentFile { path, channel, sha256: cells.remove(&format!("sha256_{component}")) }
}
