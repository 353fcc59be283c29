//! The records of a manifest, found by what tools of record selection call them.

use std::path::Path;

use uplift_job::outputs::is_same_file;
use uplift_motion::{SelectedComponent, SelectedName};

use crate::import::sequence_number;
use crate::manifest::Row;

/// Endings of record files, and words before them: what programs that write a record anew leave out or change.
const ENDINGS: [&str; 11] = [".gz", ".at2", ".txt", ".asc", ".csv", ".dat", ".acc", ".mp", ".cv", ".ap", ".th"];
/// What `EzGM` puts at the end of the name of a series that it writes.
const SERIES: [&str; 3] = ["_acc", "_vel", "_disp"];
/// What `EzGM` puts before it: the database.
const DATABASES: [&str; 3] = ["nga_w2_", "nga_w1_", "esm_2018_"];
/// Endings of KiK-net's borehole: tools select the surface.
const BOREHOLE: [&str; 2] = ["ew1", "ns1"];

pub(super) struct KnownRecords {
    rows: Vec<Row>,
    names: Vec<[FileName; 2]>,
}

/// The name of a file, in small letters, without folders, endings and record sequence number.
#[derive(Debug, Clone, PartialEq, Eq)]
struct FileName {
    rsn: Option<u64>,
    rest: String,
}

impl FileName {
    fn from_name(name: &str) -> Self {
        let whole = name.to_lowercase();
        let mut name = whole.as_str();
        while let Some(shorter) = ENDINGS.iter().find_map(|ending| name.strip_suffix(ending)) {
            name = shorter;
        }
        let rsn = sequence_number(name);
        let rest = match rsn {
            Some(_) => {
                let number = name.trim_start_matches("nga_no_").trim_start_matches("rsn");
                number.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start_matches('_').to_owned()
            }
            None => name.to_owned(),
        };
        Self { rsn, rest }
    }

    /// What a tool may mean by the name of a file: with its folders as PEER's names have them, or without.
    fn from_tool(name: &str) -> Vec<Self> {
        let mut name = name.replace('\\', "/").to_lowercase();
        for ending in ENDINGS {
            name.truncate(name.strip_suffix(ending).map_or(name.len(), str::len));
        }
        let series = SERIES.iter().find_map(|series| name.strip_suffix(series)).unwrap_or(&name);
        let bare = DATABASES.iter().find_map(|database| series.strip_prefix(database)).unwrap_or(series);
        let last = bare.rsplit('/').next().unwrap_or(bare);
        let mut names = vec![Self::from_name(last), Self::from_name(&bare.replace('/', "_"))];
        names.dedup();
        names
    }

    /// Whether both are names of one file; a number that only one of them says does not keep them apart.
    fn is(&self, other: &Self) -> bool {
        self.rest == other.rest && !self.rest.is_empty() && (self.rsn == other.rsn || self.rsn.xor(other.rsn).is_some())
    }
}

impl KnownRecords {
    pub(super) fn new(rows: Vec<Row>) -> Self {
        let name = |path: &Path| FileName::from_name(&path.file_name().unwrap_or_default().to_string_lossy());
        let names = rows.iter().map(|row| row.components.each_ref().map(|file| name(&file.path))).collect();
        Self { rows, names }
    }

    /// The records that `selected` names, one where all is well; components as `RSN753:h1`.
    pub(super) fn find(&self, selected: &SelectedName, component: SelectedComponent) -> Vec<String> {
        match selected {
            SelectedName::Files(files) => {
                let files: Vec<Vec<FileName>> = files.iter().map(|file| FileName::from_tool(file)).collect();
                self.names_of_files(&files, component)
            }
            SelectedName::SequenceNumber(rsn) => self.names_of_rows(component, |row, names| {
                names.iter().any(|name| name.rsn == Some(*rsn)) || sequence_number(&row.id) == Some(*rsn)
            }),
            SelectedName::EventStation { event, station } => self.names_of_rows(component, |row, _| {
                let said = |key: &str, word: &str| row.metadata.get(key).is_some_and(|said| said == word);
                (said("event", event) && said("station_code", station))
                    || row.components.iter().all(|file| is_of(&file.path, event, station))
            }),
            SelectedName::Name(name) => self.names_of_rows(component, |row, _| {
                let of_surface = |path: &Path| {
                    let is_stem = path.file_stem().is_some_and(|stem| stem.eq_ignore_ascii_case(name));
                    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
                    is_stem && !BOREHOLE.iter().any(|borehole| ending == *borehole)
                };
                row.id.eq_ignore_ascii_case(name) || row.components.iter().all(|file| of_surface(&file.path))
            }),
        }
    }

    fn names_of_rows(&self, component: SelectedComponent, is: impl Fn(&Row, &[FileName; 2]) -> bool) -> Vec<String> {
        let found = self.rows.iter().zip(&self.names).filter(|(row, names)| is(row, names));
        let id = |(row, _): (&Row, _)| match component {
            SelectedComponent::Numbered(horizontal) => format!("{}:{horizontal}", row.id),
            SelectedComponent::Pair | SelectedComponent::OfFile => row.id.clone(),
        };
        found.map(id).collect()
    }

    /// Records with these files, each by any of its names; a pair also where its files have other names and one number.
    fn names_of_files(&self, files: &[Vec<FileName>], component: SelectedComponent) -> Vec<String> {
        let is_file = |names: &[FileName], own: &FileName| names.iter().any(|name| name.is(own));
        let mut found = Vec::new();
        for (row, names) in self.rows.iter().zip(&self.names) {
            if component == SelectedComponent::Pair {
                if files.iter().all(|file| names.iter().any(|own| is_file(file, own))) {
                    found.push(row.id.clone());
                }
            } else if let [file] = files {
                let components = ["h1", "h2"].into_iter().zip(names).filter(|(_, own)| is_file(file, own));
                found.extend(components.map(|(which, _)| format!("{}:{which}", row.id)));
            }
        }
        let rsn = files.first().and_then(|names| names.iter().find_map(|name| name.rsn));
        match rsn {
            Some(rsn) if found.is_empty() && component == SelectedComponent::Pair => {
                self.find(&SelectedName::SequenceNumber(rsn), component)
            }
            _ => found,
        }
    }

    /// The record whose file is the one that `selected` names in the folder of `file`.
    pub(super) fn beside(&self, file: &Path, selected: &SelectedName) -> Option<String> {
        let SelectedName::Files(names) = selected else { return None };
        let place = file.with_file_name(names.first()?);
        self.rows.iter().find_map(|row| {
            let which = row.components.iter().position(|component| is_same_file(&component.path, &place))?;
            let is_list_of_pairs = file.file_name().is_some_and(|name| name == "GMR_H1_names.txt");
            Some(if is_list_of_pairs { row.id.clone() } else { format!("{}:h{}", row.id, which + 1) })
        })
    }
}

/// Whether ESM calls the file of this event and station so: `IT.NOR.00.HGE.D.EVENT.ACC.MP.ASC`.
fn is_of(path: &Path, event: &str, station: &str) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let parts: Vec<&str> = name.split('.').collect();
    parts.get(1) == Some(&station) && parts.get(5) == Some(&event)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::manifest::ComponentFile;
    use uplift_motion::Horizontal;

    fn known(pairs: &[(&str, &str, &str)]) -> KnownRecords {
        let file = |path: &str| ComponentFile { path: path.into(), channel: None, sha256: None };
        let row = |&(id, one, other): &(&str, &str, &str)| Row {
            id: id.to_owned(),
            components: [file(one), file(other)],
            vertical: None,
            dt_s: None,
            unit: None,
            format: None,
            metadata: BTreeMap::new(),
        };
        KnownRecords::new(pairs.iter().map(row).collect())
    }

    #[test]
    fn records_are_found_by_what_the_tools_call_them() {
        let known = known(&[
            ("RSN1_X.A_A-STA", "in/RSN1_X.A_A-STA090.AT2", "in/RSN1_X.A_A-STA180.AT2"),
            ("second", "in/RSN22_Y_B000.AT2", "in/RSN22_Y_B090.AT2"),
            ("IT.NOR", "IT.NOR.00.HGE.D.E-1.ACC.MP.ASC", "IT.NOR.00.HGN.D.E-1.ACC.MP.ASC"),
            ("hole", "AB01.EW1", "AB01.NS1"),
            ("surface", "AB01.EW2", "AB01.NS2"),
            ("other", "B/RSN9_Z_C000.AT2", "B/RSN9_Z_C090.AT2"),
        ]);
        let files = |names: &[&str]| SelectedName::Files(names.iter().map(|&name| name.to_owned()).collect());
        let (pair, of_file) = (SelectedComponent::Pair, SelectedComponent::OfFile);
        for (name, component, expected) in [
            (files(&["RSN1_X.A_A-STA090.AT2", "RSN1_X.A_A-STA180.AT2"]), pair, "RSN1_X.A_A-STA"),
            // folders of the database
            (files(&["X.A\\A-STA090.AT2", "X.A\\A-STA180.AT2"]), pair, "RSN1_X.A_A-STA"),
            // EzGM writes them anew
            (files(&["NGA_W2_RSN22_Y_B000_ACC.txt"]), pair, "second"),
            (files(&["IT.NOR.00.HGE.D.E-1_ACC.txt"]), pair, "IT.NOR"),
            // another file of the record, and its number
            (files(&["RSN22_Y_OTHER.AT2", "RSN22_Y_B090.AT2"]), pair, "second"),
            (files(&["rsn22_y_b090.at2"]), of_file, "second:h2"),
            (files(&["IT.NOR.00.HGN.D.E-1.ACC.MP.AT2"]), of_file, "IT.NOR:h2"),
            (SelectedName::SequenceNumber(22), pair, "second"),
            (SelectedName::SequenceNumber(22), SelectedComponent::Numbered(Horizontal::H1), "second:h1"),
            (SelectedName::EventStation { event: "E-1".into(), station: "NOR".into() }, pair, "IT.NOR"),
            (SelectedName::Name("ab01".into()), pair, "surface"),
            (SelectedName::Name("Other".into()), pair, "other"),
        ] {
            assert_eq!(known.find(&name, component), [expected], "{name}");
        }
        for name in [
            files(&["RSN2_X.A_A-STA090.AT2"]),
            files(&["RSN220_Y_B000.AT2"]),
            files(&[""]),
            files(&["RSN22_Y_OTHER.AT2"]),
            SelectedName::SequenceNumber(2),
            SelectedName::EventStation { event: "E".into(), station: "NOR".into() },
            SelectedName::Name(String::new()),
        ] {
            assert!(known.find(&name, of_file).is_empty(), "{name}");
        }
    }

    #[test]
    fn a_repeated_record_is_found_twice() {
        let known = known(&[("a", "a/RSN5_A1.AT2", "a/RSN5_A2.AT2"), ("b", "b/RSN5_A1.AT2", "b/RSN5_A2.AT2")]);
        assert_eq!(known.find(&SelectedName::SequenceNumber(5), SelectedComponent::Pair), ["a", "b"]);
    }
}
