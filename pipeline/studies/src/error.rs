//! Why a study was not carried out.

use thiserror::Error;
use uplift_alarms::AlarmsError;
use uplift_atomic_file::FileError;
use uplift_block::BlockError;
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
pub enum StudiesError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// Records or hazard curves that cannot be used.
    #[error("{0}")]
    Inputs(#[from] InputsError),
    /// Analyses that cannot be carried out.
    #[error("{0}")]
    Engine(#[from] EngineError),
    /// A result that cannot be read or written.
    #[error("{0}")]
    Result(#[from] ResultError),
    /// Spectra that cannot be computed.
    #[error("{0}")]
    UniformRisk(#[from] UniformRiskError),
    /// A result that cannot be looked at.
    #[error("{0}")]
    Alarms(#[from] AlarmsError),
    /// A hazard curve cannot be read or used.
    #[error("{0}")]
    Hazard(#[from] HazardError),
    /// Demands and hazard that do not fit together.
    #[error("{0}")]
    Risk(#[from] RiskError),
    /// Demands of which no fragility can be made.
    #[error("{0}")]
    Fragility(#[from] FragilityError),
    /// A displacement spectrum that cannot be computed.
    #[error("{0}")]
    Spectra(#[source] Box<SpectraError>),
    /// A study that TOML cannot hold; one that was loaded is none.
    #[error("{0}")]
    StudyToml(#[from] toml::ser::Error),
    /// The study file has mistakes.
    #[error("{0}")]
    Study(#[from] StudyError),
    /// Blocks or pulses that cannot be; all that was found.
    #[error("{}", uplift_job::list("", .0))]
    Blocks(Vec<BlockError>),
    /// A file of finished analysis rows cannot be used.
    #[error("{0}")]
    Checkpoint(#[from] CheckpointError),
}

impl From<IdaError> for StudiesError {
    fn from(error: IdaError) -> Self {
        JobError::from(error).into()
    }
}

impl From<LabelledError> for StudiesError {
    fn from(error: LabelledError) -> Self {
        JobError::from(error).into()
    }
}

impl From<FileError> for StudiesError {
    fn from(error: FileError) -> Self {
        JobError::from(error).into()
    }
}

impl From<SpectraError> for StudiesError {
    fn from(error: SpectraError) -> Self {
        match error {
            SpectraError::Analysis(error) => JobError::from(error).into(),
            other => Self::Spectra(Box::new(other)),
        }
    }
}

impl From<BlockError> for StudiesError {
    fn from(error: BlockError) -> Self {
        Self::Blocks(vec![error])
    }
}
