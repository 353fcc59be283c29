//! What the name of a file says: the record it belongs to, and the direction of its component.

use std::path::Path;

use uplift_motion::Orientation;

/// A file name taken apart.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecordName {
    /// The name without what tells the component.
    pub(super) record: String,
    /// Record sequence number of the PEER databases.
    pub(super) rsn: Option<u64>,
    /// Direction of the component.
    pub(super) orientation: Option<Orientation>,
}

/// Endings that tell a component, by its direction.
const WORDS: [(Orientation, &[&str]); 5] = [
    (Orientation::Azimuth(0.0), &["north", "hnn", "hgn", "ns", "n"]),
    (Orientation::Azimuth(90.0), &["east", "hne", "hge", "ew", "e"]),
    (Orientation::Vertical, &["vert", "down", "ver", "dwn", "hnz", "hgz", "ud", "up", "dn", "z", "v"]),
    (Orientation::Horizontal(1), &["h1", "x", "1"]),
    (Orientation::Horizontal(2), &["h2", "y", "2"]),
];

impl RecordName {
    /// Takes the name of the file at `path` apart.
    pub(super) fn from_path(path: &Path) -> Self {
        let file = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let file = file.strip_suffix(".gz").unwrap_or(&file);
        let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let (record, orientation) = without_component(stem);
        Self { record: record.to_owned(), rsn: sequence_number(stem), orientation }
    }
}

/// The record sequence number of a file `RSN1041_…` or `NGA_no_829_…`.
pub(crate) fn sequence_number(stem: &str) -> Option<u64> {
    let lower = stem.to_lowercase();
    let after = lower.strip_prefix("rsn").or_else(|| lower.strip_prefix("nga_no_"))?;
    let digits: String = after.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok()
}

fn without_component(stem: &str) -> (&str, Option<Orientation>) {
    const SEPARATORS: [char; 4] = ['-', '_', '.', ' '];
    let digits = stem.bytes().rev().take_while(u8::is_ascii_digit).count();
    let (before, number) = stem.split_at(stem.len() - digits);
    let separated = before.ends_with(SEPARATORS);
    // degrees: three digits directly on a station's letters, or any number set apart
    let on_letters = digits == 3 && before.ends_with(char::is_alphabetic);
    if (on_letters || (separated && (2..=3).contains(&digits)))
        && let Ok(degrees) = number.parse::<f64>()
        && degrees <= 360.0
    {
        return (before.trim_end_matches(SEPARATORS), Some(Orientation::Azimuth(degrees)));
    }
    let Some((record, word)) = stem.rsplit_once(SEPARATORS) else { return (stem, None) };
    let known = WORDS.iter().find(|(_, words)| words.iter().any(|known| word.eq_ignore_ascii_case(known)));
    match known {
        Some((orientation, _)) => (record.trim_end_matches(SEPARATORS), Some(*orientation)),
        None => (stem, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names() {
        use Orientation::{Azimuth, Horizontal, Vertical};
        for (file, record, rsn, orientation) in [
            ("RSN1041_NORTHR_MTW-000.AT2", "RSN1041_NORTHR_MTW", Some(1041), Some(Azimuth(0.0))),
            ("RSN1787_HECTOR_HEC090.AT2", "RSN1787_HECTOR_HEC", Some(1787), Some(Azimuth(90.0))),
            ("RSN495_NearNoPulse_Site1_10.AT2", "RSN495_NearNoPulse_Site1", Some(495), Some(Azimuth(10.0))),
            ("RSN1529_CHICHI_TCU102-E.AT2", "RSN1529_CHICHI_TCU102", Some(1529), Some(Azimuth(90.0))),
            ("NGA_no_829_RIO270.txt", "NGA_no_829_RIO", Some(829), Some(Azimuth(270.0))),
            ("RSN1_HELENA.A_A-HMC-UP.AT2", "RSN1_HELENA.A_A-HMC", Some(1), Some(Vertical)),
            ("site_a_x.txt.gz", "site_a", None, Some(Horizontal(1))),
            ("AOM0011801241951.NS", "AOM0011801241951", None, None),
            ("motion", "motion", None, None),
            ("RSN", "RSN", None, None),
            ("999.txt", "999", None, None),
        ] {
            let name = RecordName::from_path(Path::new(file));
            assert_eq!((name.record.as_str(), name.rsn, name.orientation), (record, rsn, orientation), "{file}");
        }
    }
}
