//! Why a study was not carried out.

use thiserror::Error;
use uplift_alarms::AlarmsError;
use uplift_atomic_file::FileError;
use uplift_engine::EngineError;
use uplift_engine::checkpoint::CheckpointError;
use uplift_fragility::FragilityError;
use uplift_hazard::HazardError;
use uplift_ida::IdaError;
use uplift_inputs::InputsError;
use uplift_job::JobError;
use uplift_labelled::LabelledError;
use uplift_result::ResultError;
use uplift_risk::RiskError;
use uplift_spectra::SpectraError;
use uplift_study::StudyError;
use uplift_uniform_risk::UniformRiskError;

/// Why a study was not carried out.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum StudiesError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// Records or hazard curves that cannot be used.
    Inputs(#[from] InputsError),
    /// Analyses that cannot be carried out.
    Engine(#[from] EngineError),
    /// A result that cannot be read or written.
    Result(#[from] ResultError),
    /// Spectra that cannot be computed.
    UniformRisk(#[from] UniformRiskError),
    /// A result that cannot be looked at.
    Alarms(#[from] AlarmsError),
    /// A hazard curve cannot be read or used.
    Hazard(#[from] HazardError),
    /// Demands and hazard that do not fit together.
    Risk(#[from] RiskError),
    /// Demands of which no fragility can be made.
    Fragility(#[from] FragilityError),
    /// A displacement spectrum that cannot be computed.
    Spectra(#[source] Box<SpectraError>),
    /// A study that TOML cannot hold; one that was loaded is none.
    StudyToml(#[from] toml::ser::Error),
    /// The study file has mistakes.
    Study(#[from] StudyError),
    /// A file of finished analysis rows cannot be used.
    Checkpoint(#[from] CheckpointError),
}

uplift_job::through_job_error!(StudiesError: IdaError, LabelledError, FileError);

impl From<SpectraError> for StudiesError {
    fn from(error: SpectraError) -> Self {
        match error {
            SpectraError::Analysis(error) => JobError::from(error).into(),
            other => Self::Spectra(Box::new(other)),
        }
    }
}
