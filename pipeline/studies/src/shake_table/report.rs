//! What a run of a study of a shaking table tells.

use serde::Serialize;
use uplift_job::study_run::RunHead;
use uplift_result::{ResultFile, ShakeTable};
use uplift_study::Kind;

use crate::error::StudiesError;

/// What a run tells.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// What every kind tells.
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
