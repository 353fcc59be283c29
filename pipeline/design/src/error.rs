//! Why a structure was not judged.

use thiserror::Error;
use uplift_alarms::AlarmsError;
use uplift_block::BlockError;
use uplift_bootstrap::BootstrapError;
use uplift_engine::EngineError;
use uplift_fragility::FragilityError;
use uplift_frame::FrameError;
use uplift_hazard::HazardError;
use uplift_ida::IdaError;
use uplift_inputs::InputsError;
use uplift_job::JobError;
use uplift_oscillator::OscillatorError;
use uplift_questions::QuestionsError;
use uplift_result::ResultError;
use uplift_risk::RiskError;
use uplift_spectra::SpectraError;
use uplift_structure::StructureError;
use uplift_uncertainty::UncertaintyError;
use uplift_uniform_risk::UniformRiskError;

/// Why a structure was not judged.
#[derive(Debug, Error)]
pub enum DesignError {
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
    /// A question that has no answer.
    #[error("{0}")]
    Questions(#[from] QuestionsError),
    /// A hazard curve cannot be read or used.
    #[error("{0}")]
    Hazard(#[from] HazardError),
    /// Demands and hazard that do not fit together.
    #[error("{0}")]
    Risk(#[from] RiskError),
    /// Demands of which no fragility can be made.
    #[error("{0}")]
    Fragility(#[from] FragilityError),
    /// Resamples that cannot be drawn.
    #[error("{0}")]
    Bootstrap(#[from] BootstrapError),
    /// A structure that cannot be, or to which a rule does not apply.
    #[error("{0}")]
    Structure(#[from] StructureError),
    /// A frame that cannot be shaken so.
    #[error("{0}")]
    Frame(#[from] FrameError),
    /// An oscillator or its excitation that cannot be.
    #[error("{0}")]
    Oscillator(#[from] OscillatorError),
    /// Blocks or pulses that cannot be; all that was found.
    #[error("{}", uplift_job::list("", .0))]
    Blocks(Vec<BlockError>),
    /// Structures that cannot be drawn.
    #[error("{0}")]
    Uncertainty(#[from] UncertaintyError),
    /// A displacement spectrum that cannot be computed.
    #[error("{0}")]
    Spectra(#[source] Box<SpectraError>),
}

impl From<IdaError> for DesignError {
    fn from(error: IdaError) -> Self {
        JobError::from(error).into()
    }
}

impl From<BlockError> for DesignError {
    fn from(error: BlockError) -> Self {
        Self::Blocks(vec![error])
    }
}

impl From<SpectraError> for DesignError {
    fn from(error: SpectraError) -> Self {
        match error {
            SpectraError::Analysis(error) => JobError::from(error).into(),
            other => Self::Spectra(Box::new(other)),
        }
    }
}
