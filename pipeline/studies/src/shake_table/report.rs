//! What a run of a study of a shaking table tells.

use serde::Serialize;
use uplift_job::study_run::RunHead;
use uplift_result::ShakeTable;

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
