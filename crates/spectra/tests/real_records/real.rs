//! The record sets of FEMA P695 as the dissertation used them, where they are at hand: they may not be distributed.

use std::path::{Path, PathBuf};

use uplift_motion::{Accelerogram, ReadOptions, STANDARD_GRAVITY_M_S2, read_path};
use uplift_spectra::{MotionSet, RecordOfSet};

/// A set with the record that the dissertation could not get left out.
pub(crate) struct RealSet {
    name: &'static str,
    records: Vec<(String, [Accelerogram; 2])>,
}

impl RealSet {
    /// Its components as independent motions.
    pub(crate) fn motions(&self) -> MotionSet<'_> {
        let records = self.records.iter().map(|(id, [h1, h2])| RecordOfSet { id, components: [h1, h2] });
        MotionSet::new(self.name, records, STANDARD_GRAVITY_M_S2).unwrap()
    }
}

/// Near-field pulse-like, near-field no pulse-like, far-field: 14, 14 and 21 records.
pub(crate) fn real_sets() -> Option<[RealSet; 3]> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/records");
    let folder = std::env::var_os("UPLIFT_RECORDS").map_or(beside, PathBuf::from);
    let manifest = std::fs::read_to_string(folder.join("manifest.csv")).ok()?;
    let set = |name, tag: &str| {
        let of_tag = |line: &&str| line.split([',', ' ']).any(|cell| cell == tag) && !line.starts_with("RSN829");
        let record = |line: &str| {
            let mut files = line.split(',').filter(|cell| Path::new(cell).extension().is_some_and(|end| end == "AT2"));
            let component = |file: &str| read_path(&folder.join(file), &ReadOptions::default()).unwrap();
            let components = [files.next().unwrap(), files.next().unwrap()].map(component);
            (line.split('_').next().unwrap().to_owned(), components)
        };
        RealSet { name, records: manifest.lines().filter(of_tag).map(record).collect() }
    };
    Some([set("near-field pulse-like", "nfp"), set("near-field no pulse-like", "nf"), set("far-field", "ff")])
}
