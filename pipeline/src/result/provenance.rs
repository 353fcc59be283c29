//! Where the numbers of a result come from.

use std::collections::BTreeMap;

use super::extend::now;
use crate::inputs::{RecordSet, SiteHazard};

/// What someone needs to repeat a run.
#[derive(Debug, Clone)]
pub struct Provenance {
    /// Study file as given.
    pub study_file: String,
    /// The command line.
    pub command: String,
    /// Coordinated universal time of the run, `2026-01-31T12:00:00Z`.
    pub created: String,
    /// Threads used; the numbers do not depend on it.
    pub threads: usize,
    /// Wall time up to the writing of the file, s.
    pub wall_time_s: f64,
    /// Name to SHA-256 of each record and hazard curve.
    pub input_checksums: BTreeMap<String, String>,
}

impl Provenance {
    /// Provenance of a run that is about to write its result.
    pub fn new(study_file: &str, wall_time_s: f64, records: &RecordSet, hazard: &[Vec<SiteHazard>]) -> Self {
        let mut input_checksums: BTreeMap<String, String> =
            records.records.iter().map(|record| (format!("record {}", record.id), record.checksum.clone())).collect();
        for curve in hazard.iter().flatten() {
            let name = format!("hazard {} {}", curve.site, curve.measure.label());
            for branch in &curve.branches {
                input_checksums.insert(format!("{name} {}", branch.name), branch.input.checksum.clone());
            }
            if curve.curve.file.is_some() {
                input_checksums.insert(name, curve.curve.checksum.clone());
            }
        }
        Self::of_inputs(study_file, wall_time_s, input_checksums)
    }

    /// Provenance of a run on these inputs, name to SHA-256.
    pub fn of_inputs(study_file: &str, wall_time_s: f64, input_checksums: BTreeMap<String, String>) -> Self {
        Self {
            study_file: study_file.to_owned(),
            command: std::env::args().collect::<Vec<_>>().join(" "),
            created: now(),
            threads: rayon::current_num_threads(),
            wall_time_s,
            input_checksums,
        }
    }

    /// One line for the head of a table; `records` says where the records come from.
    pub fn line(&self, title: &str, records: &str) -> String {
        let title = if title.is_empty() { String::new() } else { format!("{title}; ") };
        format!(
            "uplift {} ({}), {}; study {}; {title}records: {records}",
            crate::VERSION,
            crate::COMMIT,
            self.created,
            self.study_file
        )
        .replace(['\n', '\r'], " ")
    }
}
