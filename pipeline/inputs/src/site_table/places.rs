//! The table of sites: where they are, and what they are called.

use std::collections::HashMap;
use std::path::Path;

use polars::prelude::{DataFrame, StringChunked};
use uplift_atomic_file::{FileError, read_file};
use uplift_job::text_table;

/// Largest table, bytes: some millions of sites.
const MAX_BYTES: u64 = 256 << 20;
const MISTAKES_TOLD: usize = 8;
/// Stands between the cells of further columns.
const BETWEEN_CELLS: char = '\u{1f}';

/// Column names that are understood, the better ones first.
const LONGITUDE: [&str; 6] = ["longitude", "longitude_deg", "lon", "lon_deg", "long", "x"];
const LATITUDE: [&str; 5] = ["latitude", "latitude_deg", "lat", "lat_deg", "y"];
const NAME: [&str; 7] = ["name", "site", "site_name", "custom_site_id", "site_id", "station", "id"];

/// A site of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct ListedSite {
    /// Its name, or its number from 1 if it has none.
    pub name: Box<str>,
    /// Longitude as given, degrees.
    pub longitude_deg: f64,
    /// Latitude, degrees.
    pub latitude_deg: f64,
    /// The cells of further columns, one after the other.
    pub(super) carried: Box<str>,
}

impl ListedSite {
    /// Its cells in the columns of [`SiteList::carried`](super::SiteList::carried).
    pub fn carried(&self) -> impl Iterator<Item = &str> {
        self.carried.split(BETWEEN_CELLS)
    }
}

/// Sites and the names of the columns that are carried along.
pub(super) struct Places {
    pub(super) sites: Vec<ListedSite>,
    pub(super) carried: Vec<String>,
}

/// Reads a table with a header row; other columns than longitude, latitude and name are carried along as they are.
///
/// # Errors
/// Everything that is wrong with it, a line each, the repetitions counted.
pub(super) fn read(path: &Path) -> Result<Places, Vec<String>> {
    let name = path.display();
    let fail = |reason: String| vec![format!("site table {name} {reason}")];
    let bytes = match read_file(path, MAX_BYTES) {
        Ok(bytes) => bytes,
        Err(FileError::TooLarge { limit_bytes, .. }) => {
            return Err(fail(format!("has more than {limit_bytes} bytes: leave out further columns, for instance")));
        }
        Err(error) => return Err(vec![format!("site table {error}")]),
    };
    let table = text_table::parse(&bytes, &[])
        .map_err(|error| fail(format!("cannot be read as a CSV table with a header row: {error}")))?;
    drop(bytes);
    let columns = Columns::from_table(&table).map_err(fail)?;
    let mut mistakes = Vec::new();
    let mut more = 0;
    let mut sites = Vec::with_capacity(table.height());
    // rows without a column of names are called by their numbers
    let (is_named, mut named) = (columns.name.is_some(), HashMap::new());
    for row in 0..table.height() {
        let site = columns.site(row);
        match site.and_then(|site| if is_named { once(row, site, &mut named) } else { Ok(site) }) {
            Ok(site) => sites.push(site),
            Err(reason) if mistakes.len() < MISTAKES_TOLD => {
                mistakes.push(format!("site table {name}, row {} below the header: {reason}", row + 1));
            }
            Err(_) => more += 1,
        }
    }
    if more > 0 {
        mistakes.push(format!("site table {name}: {more} more rows like these"));
    }
    if mistakes.is_empty() && sites.is_empty() {
        mistakes.push(format!("site table {name} has no sites"));
    }
    let carried = columns.carried.iter().map(|column| column.name().to_string()).collect();
    if mistakes.is_empty() { Ok(Places { sites, carried }) } else { Err(mistakes) }
}

/// The `site` of this row if it is no other's by name, as in `[[sites]]`; `named` holds the rows of those before.
fn once(row: usize, site: ListedSite, named: &mut HashMap<String, usize>) -> Result<ListedSite, String> {
    match named.insert(site.name.to_lowercase(), row) {
        None => Ok(site),
        Some(before) => Err(format!(
            "site {} is in row {} too: remove one of them, or give each a name of its own",
            site.name.escape_debug(),
            before + 1
        )),
    }
}

struct Columns<'a> {
    longitude: &'a StringChunked,
    latitude: &'a StringChunked,
    name: Option<&'a StringChunked>,
    carried: Vec<&'a StringChunked>,
}

impl<'a> Columns<'a> {
    fn from_table(table: &'a DataFrame) -> Result<Self, String> {
        let texts: Vec<&StringChunked> = table.columns().iter().filter_map(|column| column.str().ok()).collect();
        let keys: Vec<String> = texts.iter().map(|column| key(column.name())).collect();
        let position = |wanted: &[&str]| wanted.iter().find_map(|wanted| keys.iter().position(|key| key == wanted));
        let (Some(longitude), Some(latitude)) = (position(&LONGITUDE), position(&LATITUDE)) else {
            let found: Vec<&str> = texts.iter().take(20).map(|column| column.name().as_str()).collect();
            return Err(format!(
                "does not name columns longitude and latitude [degrees] in its first line (lon, lat, x, y will do); \
                 found {}",
                found.join(", ").escape_debug()
            ));
        };
        let name = position(&NAME);
        let used = [Some(longitude), Some(latitude), name];
        let carried = (0..texts.len()).filter(|&index| !used.contains(&Some(index))).map(|index| texts[index]);
        Ok(Self {
            longitude: texts[longitude],
            latitude: texts[latitude],
            name: name.map(|index| texts[index]),
            carried: carried.collect(),
        })
    }

    fn site(&self, row: usize) -> Result<ListedSite, String> {
        let longitude_deg = degrees("longitude", cell(self.longitude, row))?;
        let latitude_deg = degrees("latitude", cell(self.latitude, row))?;
        if !(-90.0..=90.0).contains(&latitude_deg) || !(-180.0..=360.0).contains(&longitude_deg) {
            let swapped = if longitude_deg.abs() <= 90.0 { "; are they swapped?" } else { "" };
            return Err(format!(
                "longitude {longitude_deg}, latitude {latitude_deg} is not a place on Earth: give degrees{swapped}"
            ));
        }
        let name = self.name.map(|column| cell(column, row)).filter(|name| !name.is_empty());
        let name = name.map_or_else(|| (row + 1).to_string(), str::to_owned).into();
        let cells: Vec<String> =
            self.carried.iter().map(|column| cell(column, row).replace(BETWEEN_CELLS, " ")).collect();
        Ok(ListedSite { name, longitude_deg, latitude_deg, carried: cells.join(&BETWEEN_CELLS.to_string()).into() })
    }
}

/// A column name without capitals, and without unit or remark behind it.
fn key(name: &str) -> String {
    let word = name.trim().split([' ', '[', '(']).next().unwrap_or_default();
    word.to_lowercase()
}

fn cell(column: &StringChunked, row: usize) -> &str {
    column.get(row).unwrap_or_default().trim()
}

fn degrees(what: &str, text: &str) -> Result<f64, String> {
    if let Some(value) = text.parse::<f64>().ok().filter(|value| value.is_finite()) {
        return Ok(value);
    }
    let head: String = text.chars().take(40).collect();
    let hint = if text.replace(',', ".").parse::<f64>().is_ok() {
        ", with a decimal point, or semicolons between the columns"
    } else {
        ""
    };
    Err(format!("{what} is {head:?}: give degrees{hint}"))
}
