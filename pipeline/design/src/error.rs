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
#[error("{0}")]
pub enum DesignError {
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
    /// A question that has no answer.
    Questions(#[from] QuestionsError),
    /// A hazard curve cannot be read or used.
    Hazard(#[from] HazardError),
    /// Demands and hazard that do not fit together.
    Risk(#[from] RiskError),
    /// Demands of which no fragility can be made.
    Fragility(#[from] FragilityError),
    /// Resamples that cannot be drawn.
    Bootstrap(#[from] BootstrapError),
    /// A structure that cannot be, or to which a rule does not apply.
    Structure(#[from] StructureError),
    /// A frame that cannot be shaken so.
    Frame(#[from] FrameError),
    /// An oscillator or its excitation that cannot be.
    Oscillator(#[from] OscillatorError),
    /// Blocks or pulses that cannot be; all that was found.
    #[error("{}", uplift_job::list("", .0))]
    Blocks(Vec<BlockError>),
    /// Structures that cannot be drawn.
    Uncertainty(#[from] UncertaintyError),
    /// A displacement spectrum that cannot be computed.
    Spectra(#[source] Box<SpectraError>),
}

uplift_job::through_job_error!(DesignError: IdaError);

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
