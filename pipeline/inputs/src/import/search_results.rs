//! The table of metadata that comes with a download from the PEER ground motion database.

use std::collections::BTreeMap;
use std::path::PathBuf;

use uplift_atomic_file::read_file;
use uplift_job::text_table;

use super::warnings::Warning;

/// What a search result says about a record.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Entry {
    pub(super) event: Option<String>,
    pub(super) year: Option<String>,
    pub(super) station: Option<String>,
    pub(super) magnitude: Option<String>,
    pub(super) mechanism: Option<String>,
    pub(super) rjb_km: Option<String>,
    pub(super) rrup_km: Option<String>,
    pub(super) vs30: Option<String>,
    pub(super) lowest_usable_hz: Option<String>,
    /// Significant duration D5-95, s.
    pub(super) d5_95_s: Option<f64>,
    /// File names of the two horizontal components.
    pub(super) files: [Option<String>; 2],
}

/// The most that a table of search results has, and then some.
const LARGEST_BYTES: u64 = 64 << 20;

/// Search results by record sequence number.
#[derive(Debug, Clone, Default)]
pub(super) struct SearchResults {
    entries: BTreeMap<u64, Entry>,
}

impl SearchResults {
    /// Reads `files`; one that cannot be read is a warning.
    pub(super) fn read(files: &[PathBuf], warnings: &mut Vec<Warning>) -> Self {
        let mut results = Self::default();
        for path in files {
            let parsed =
                read_file(path, LARGEST_BYTES).map_err(|error| error.to_string()).and_then(|bytes| parse(&bytes));
            match parsed {
                Ok(entries) => results.entries.extend(entries),
                Err(reason) => warnings
                    .push(Warning { kind: "search results", text: format!("{}: of no use: {reason}", path.display()) }),
            }
        }
        results
    }

    /// What is said about the record of this sequence number.
    pub(super) fn find(&self, rsn: Option<u64>) -> Option<&Entry> {
        self.entries.get(&rsn?)
    }

    /// A warning where records of the search are not among those `found`.
    pub(super) fn missing(&self, found: impl Iterator<Item = u64>) -> Option<Warning> {
        let found: std::collections::BTreeSet<u64> = found.collect();
        let missing: Vec<String> =
            self.entries.keys().filter(|rsn| !found.contains(rsn)).map(|rsn| format!("RSN{rsn}")).collect();
        let shown = missing.iter().take(10).cloned().collect::<Vec<_>>().join(", ");
        let more = if missing.len() > 10 { ", …" } else { "" };
        (!missing.is_empty()).then(|| {
            let (lacking, all) = (missing.len(), self.entries.len());
            let text = format!("{lacking} of {all} records of the search have no pair of files here: {shown}{more}");
            Warning { kind: "search results", text }
        })
    }
}

/// A column name in small letters without blanks and signs: "rrupkm".
fn plain(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_lowercase()
}

/// The entries of a file: a title and remarks, the table, then tables of spectra, parted by empty lines.
fn parse(bytes: &[u8]) -> Result<BTreeMap<u64, Entry>, String> {
    text_table::refuse_what_is_no_text(bytes)?;
    let unified = String::from_utf8_lossy(bytes);
    let unified = unified.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n");
    let table: Vec<&str> = unified
        .lines()
        .skip_while(|line| !plain(line).contains("recordsequencenumber"))
        .take_while(|line| !line.trim_matches([',', ';', ' ', '\t']).is_empty())
        .collect();
    if table.is_empty() {
        return Err("no column \"Record Sequence Number\"".to_owned());
    }
    let table = text_table::parse(table.join("\n").as_bytes(), &[])?;
    let column = |names: &[&str]| {
        table.columns().iter().find(|column| {
            let found = plain(column.name());
            names.iter().any(|name| found.starts_with(name))
        })
    };
    let rsn = column(&["recordsequencenumber"]);
    let columns = [
        &["earthquakename"][..],
        &["year"],
        &["stationname"],
        &["magnitude", "earthquakemagnitude"],
        &["mechanism"],
        &["rjb", "joynerboore"],
        &["rrup", "clstd"],
        &["vs30"],
        &["lowestuse", "lowestusable"],
        &["horizontal1acc"],
        &["horizontal2acc"],
        &["595"],
    ]
    .map(column);
    let mut entries = BTreeMap::new();
    for row in 0..table.height() {
        let cell = |column: Option<&polars::prelude::Column>| {
            let text = column?.str().ok()?.get(row)?.trim();
            // -999 in any notation stands for what is not known, and nothing in this table is below zero
            let unknown =
                text.is_empty() || text.starts_with("---") || text.parse::<f64>().is_ok_and(|number| number < 0.0);
            (!unknown).then(|| text.to_owned())
        };
        let Some(rsn) = cell(rsn).and_then(|text| text.parse::<u64>().ok()) else { continue };
        let [event, year, station, magnitude, mechanism, rjb_km, rrup_km, vs30, lowest_usable_hz, h1, h2, d5_95] =
            columns.map(cell);
        let (files, d5_95_s) = ([h1, h2], d5_95.and_then(|text| text.parse().ok()));
        let entry = Entry {
            event,
            year,
            station,
            magnitude,
            mechanism,
            rjb_km,
            rrup_km,
            vs30,
            lowest_usable_hz,
            d5_95_s,
            files,
        };
        entries.insert(rsn, entry);
    }
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_among_others() {
        let text = "A title\r\n\r\n -- Summary --\r\nResult ID, Spectral Ordinate, Record Sequence Number, Earthquake \
                    Name, Year, \
             Station Name, Magnitude, Mechanism, Rjb (km), Rrup (km), Vs30 (m/sec), Lowest Useable Frequency (Hz), \
             5-95% Duration (sec), Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename\r\n\
             1,SRSS,12,\"Some, Where\",1990,Station A,6.5,strike slip,10.1,11.2,450.0,0.25,9.6, RSN12_A_000.AT2, \
                         RSN12_A_090.AT2,---\r\n\
             2,SRSS,13,Else,1991,Station B,7.0,reverse,-999.0,21.2,,0.1,,x,y,z\r\n\r\n\
             \x20-- Spectra --\r\nPeriod, RSN-12\r\n0.01,0.2\r\n";
        let entries = parse(text.as_bytes()).unwrap();
        assert_eq!(entries.len(), 2);
        let first = &entries[&12];
        assert_eq!(first.event.as_deref(), Some("Some, Where"));
        assert_eq!(first.rrup_km.as_deref(), Some("11.2"));
        assert_eq!(first.vs30.as_deref(), Some("450.0"));
        assert_eq!(first.d5_95_s, Some(9.6));
        assert_eq!(first.lowest_usable_hz.as_deref(), Some("0.25"));
        assert_eq!(first.files, [Some("RSN12_A_000.AT2".to_owned()), Some("RSN12_A_090.AT2".to_owned())]);
        assert_eq!((entries[&13].vs30.clone(), entries[&13].rjb_km.clone()), (None, None));
        // as Excel writes it where the comma is the decimal mark
        let european = text.replace(',', ";").replace("Some; Where", "Some, Where").replace('.', ",");
        let again = parse(european.replace("RSN12_A_000,AT2", "RSN12_A_000.AT2").as_bytes()).unwrap();
        assert_eq!((&again[&12].rrup_km, &again[&12].vs30), (&first.rrup_km, &first.vs30));
        assert_eq!((&again[&12].magnitude, &again[&12].event), (&first.magnitude, &first.event));
        assert_eq!(again[&13].rjb_km, None);
        assert!(parse(b"\xff\xfeR\0").unwrap_err().contains("UTF-16"));
        assert!(parse(b"no table").is_err());
    }
}
