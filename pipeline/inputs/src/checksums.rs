//! Checksums of everything that a study of uniform risk is given, by name.

use std::collections::BTreeMap;

use crate::{OtherHazard, Record, RecordSet, SiteHazard};

/// Name to SHA-256 of each record and hazard curve.
pub fn input_checksums(
    records: &RecordSet,
    hazard: &[Vec<SiteHazard>],
    other_hazard: &[OtherHazard],
) -> BTreeMap<String, String> {
    let mut input_checksums: BTreeMap<String, String> =
        records.records.iter().map(|record| (format!("record {}", record.id), record.checksum.clone())).collect();
    let vertical =
        |record: &Record| Some((format!("record {} vertical", record.id), record.vertical.as_ref()?.checksum.clone()));
    input_checksums.extend(records.records.iter().filter_map(vertical));
    input_checksums.extend(records.at_level.iter().map(|of| ("records of levels".to_owned(), of.checksum.clone())));
    for curve in hazard.iter().flatten() {
        let name = format!("hazard {} {}", curve.site, curve.measure.label());
        for branch in &curve.branches {
            input_checksums.insert(format!("{name} {}", branch.name), branch.input.checksum.clone());
        }
        if curve.curve.file.is_some() {
            input_checksums.insert(name, curve.curve.checksum.clone());
        }
    }
    for curve in other_hazard {
        let name = format!("hazard {} {}", curve.site, curve.measure.label());
        for (branch, checksum) in &curve.branches {
            input_checksums.insert(format!("{name} {branch}"), checksum.clone());
        }
        if curve.file.is_some() {
            input_checksums.insert(name, curve.checksum.clone());
        }
    }
    input_checksums
}
