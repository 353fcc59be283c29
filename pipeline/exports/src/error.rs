//! Why an export was not made.

use thiserror::Error;
use uplift_alarms::AlarmsError;
use uplift_design::DesignError;
use uplift_fragility::FragilityError;
use uplift_hazard::HazardError;
use uplift_job::JobError;
use uplift_laboratory::LaboratoryError;
use uplift_questions::QuestionsError;
use uplift_result::ResultError;
use uplift_statics::StaticsError;
use uplift_studies::StudiesError;
use uplift_study::StudyError;
use uplift_uniform_risk::UniformRiskError;

/// Why an export was not made.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum ExportsError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// A result that cannot be read or written.
    Result(#[from] ResultError),
    /// Spectra that cannot be computed.
    UniformRisk(#[from] UniformRiskError),
    /// What a run computes beside its spectra.
    Studies(#[from] StudiesError),
    /// A result that cannot be looked at.
    Alarms(#[from] AlarmsError),
    /// A question that has no answer.
    Questions(#[from] QuestionsError),
    /// A structure that cannot be analysed.
    Design(#[from] DesignError),
    /// Demands of which no fragility can be made.
    Fragility(#[from] FragilityError),
    /// A single test that cannot be carried out.
    Laboratory(#[from] LaboratoryError),
    /// A hazard curve cannot be read or used.
    Hazard(#[from] HazardError),
    /// The study file has mistakes.
    Study(#[from] StudyError),
    /// Columns, a restrainer or a protocol that cannot be, or a displacement beyond their reach.
    Statics(#[from] StaticsError),
}
