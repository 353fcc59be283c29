//! What a study of a shaking table costs.

use std::path::Path;
use std::time::Instant;

use serde::Serialize;
use uplift_alarms::{ranked, study_alarms};
use uplift_job::events::Events;
use uplift_job::machine::{Needs, PROGRAM_BYTES};
use uplift_job::study_run::PlanHead;
use uplift_study::{Kind, ShakeTableStudy};

use super::{Inputs, carry_out};
use crate::error::StudiesError;

/// Bytes of an ordinate of the spectrum of an excitation: two components.
const ORDINATE_BYTES: u64 = 16;
/// Bytes of a test in the result and in the table beside it.
const TEST_BYTES: u64 = 400;

/// What a study of a shaking table costs.
#[derive(Debug, Clone, Serialize)]
pub struct Plan {
    /// What every kind reports.
    #[serde(flatten)]
    pub head: PlanHead,
    /// `shake table`.
    pub kind: &'static str,
    /// Excitations.
    pub excitations: usize,
    /// Levels.
    pub levels: usize,
}

/// Reads and checks all inputs of `study`. Its tests are so few that they are carried out to be timed, and to find
/// those that cannot be computed.
///
/// # Errors
/// Inputs that cannot be used.
pub fn plan(study: &ShakeTableStudy, study_file: &Path, events: &dyn Events) -> Result<Plan, StudiesError> {
    let inputs = Inputs::read(study, events)?;
    let begin = Instant::now();
    let table = carry_out(study, &inputs, events)?;
    let seconds = begin.elapsed().as_secs_f64();
    let needs = needs(study, &inputs);
    let head = PlanHead {
        study: study_file.to_owned(),
        record_set: table.records.clone(),
        synthetic: table.synthetic,
        analyses: table.tests.len() as u64,
        threads: rayon::current_num_threads(),
        seconds,
        memory_bytes: needs.memory_bytes,
        disk_bytes: needs.disk_bytes,
        room: needs.room(&study.output.file),
        output: study.output.file.clone(),
        alarms: ranked(study_alarms(&study.warnings, table.synthetic).collect()),
        notes: inputs.notes,
        would_replace: None,
    };
    let (excitations, levels) = (table.excitations.len(), table.levels.len());
    Ok(Plan { head, kind: Kind::ShakeTable.key(), excitations, levels })
}

/// What a run takes: records with their integrals, 64 bytes a sample, and some hundred bytes a test.
pub(super) fn needs(study: &ShakeTableStudy, inputs: &Inputs) -> Needs {
    let tests = (study.levels.len() * inputs.records.records.len()) as u64;
    let ordinates = (study.spectra.periods_s.len() * inputs.records.records.len()) as u64;
    let result_bytes = TEST_BYTES * tests + ORDINATE_BYTES * ordinates;
    Needs {
        memory_bytes: PROGRAM_BYTES + 64 * inputs.samples() + result_bytes,
        disk_bytes: result_bytes + 1_000_000,
        disk_least_bytes: 0,
    }
}
