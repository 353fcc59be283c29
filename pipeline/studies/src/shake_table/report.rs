//! The report of a run of a study of a shaking table.

use serde::Serialize;
use uplift_job::study_run::RunHead;
use uplift_result::{ResultFile, ShakeTable};
use uplift_study::Kind;

use crate::error::StudiesError;

/// The report of a run.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// What every kind reports.
    #[serde(flatten)]
    pub head: RunHead,
    /// `shake table`.
    pub kind: &'static str,
    /// The tests.
    #[serde(flatten)]
    pub table: ShakeTable,
}

impl RunReport {
    /// The report on the result in `file`, with a `head`.
    ///
    /// # Errors
    /// A file that is damaged or of another kind.
    pub fn read(file: &ResultFile, head: RunHead) -> Result<Self, StudiesError> {
        Ok(Self { head, kind: Kind::ShakeTable.key(), table: file.shake_table()? })
    }
}
