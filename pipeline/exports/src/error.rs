//! Why an export was not made.

use thiserror::Error;
use uplift_alarms::AlarmsError;
use uplift_hazard::HazardError;
use uplift_job::JobError;
use uplift_laboratory::LaboratoryError;
use uplift_questions::QuestionsError;
use uplift_result::ResultError;
use uplift_statics::StaticsError;
use uplift_study::StudyError;
use uplift_uniform_risk::UniformRiskError;

/// Why an export was not made.
#[derive(Debug, Error)]
pub enum ExportsError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// A result that cannot be read or written.
    #[error("{0}")]
    Result(#[from] ResultError),
    /// Spectra that cannot be computed.
    #[error("{0}")]
    UniformRisk(#[from] UniformRiskError),
    /// A result that cannot be looked at.
    #[error("{0}")]
    Alarms(#[from] AlarmsError),
    /// A question that has no answer.
    #[error("{0}")]
    Questions(#[from] QuestionsError),
    /// A single test that cannot be carried out.
    #[error("{0}")]
    Laboratory(#[from] LaboratoryError),
    /// A hazard curve cannot be read or used.
    #[error("{0}")]
    Hazard(#[from] HazardError),
    /// The study file has mistakes.
    #[error("{0}")]
    Study(#[from] StudyError),
    /// Columns, a restrainer or a protocol that cannot be, or a displacement beyond their reach.
    #[error("{0}")]
    Statics(#[from] StaticsError),
}
