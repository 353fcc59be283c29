//! Checksums of everything that a study of uniform risk is given, by name; keys of motions, which say whether a peak
//! is that of the same shaking.

use std::collections::BTreeMap;

use uplift_job::checksum::{checksum, motion_key};
use uplift_motion::Direction;

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

/// SHA-256 of what the peaks of each record are of, hexadecimal: of its motion; of the motion and what its structure
/// has where that is not known exactly.
pub fn motion_keys(records: &[Record]) -> Vec<String> {
    // structures of a motion follow each other: it is hashed once
    let of_motions = records.chunk_by(share_motion).flat_map(|same| {
        let key = motion_checksum(&same[0]);
        same.iter().map(move |record| match &record.structure {
            Some(structure) => structure.key_with(&key),
            None => key.clone(),
        })
    });
    of_motions.collect()
}

/// SHA-256 of the motion of a record, hexadecimal; of all motions and the percentile where it is one.
fn motion_checksum(record: &Record) -> String {
    let first = motion_key(&record.accelerogram);
    match record.direction {
        Direction::Percentile { percentile, .. } if !record.other_azimuths.is_empty() => {
            let others = record.other_azimuths.iter().map(motion_key);
            let keys: Vec<String> = std::iter::once(first).chain(others).collect();
            checksum(format!("percentile {percentile} of {}", keys.join(" ")).as_bytes())
        }
        _ => first,
    }
}

/// Whether two records are of the very same motion, whose samples they share.
fn share_motion(one: &Record, other: &Record) -> bool {
    let [samples, others] = [one, other].map(|record| record.accelerogram.acceleration_m_s2());
    std::ptr::eq(samples, others) && one.direction == other.direction
}
