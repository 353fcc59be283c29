//! Why a job did not do what it was asked.

use std::error::Error;

use thiserror::Error;
use uplift_alarms::AlarmsError;
use uplift_atomic_file::FileError;
use uplift_block::BlockError;
use uplift_design::DesignError;
use uplift_engine::EngineError;
use uplift_engine::checkpoint::CheckpointError;
use uplift_exports::ExportsError;
use uplift_inputs::InputsError;
use uplift_job::JobError;
use uplift_job::text::counted;
use uplift_labelled::LabelledError;
use uplift_laboratory::LaboratoryError;
use uplift_questions::QuestionsError;
use uplift_result::ResultError;
use uplift_statics::StaticsError;
use uplift_studies::StudiesError;
use uplift_study::StudyError;
use uplift_uniform_risk::UniformRiskError;

/// Why a job did not do what it was asked.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum UpliftError {
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
    /// A study that cannot be carried out.
    Studies(#[from] StudiesError),
    /// A question that has no answer.
    Questions(#[from] QuestionsError),
    /// A structure that cannot be judged.
    Design(#[from] DesignError),
    /// A single test that cannot be carried out.
    Laboratory(#[from] LaboratoryError),
    /// An export that cannot be made.
    Exports(#[from] ExportsError),
    /// Variants of a study have mistakes; all of them.
    #[error("{}", in_variants(.0))]
    Variants(Vec<String>),
    /// The study file has mistakes.
    Study(#[from] StudyError),
    /// A study that TOML cannot hold; one that was loaded is none.
    StudyToml(#[from] toml::ser::Error),
    /// A file of finished analysis rows cannot be used.
    Checkpoint(#[from] CheckpointError),
    /// Columns, a restrainer or a protocol that cannot be, or a displacement beyond their reach.
    Statics(#[from] StaticsError),
}

/// Mistakes of variants that are shown: a table can be wrong in every cell.
const SHOWN: usize = 10;

/// The first mistakes of variants, a line each, and how many there are.
pub(crate) fn in_variants(mistakes: &[String]) -> String {
    let more = mistakes.len().checked_sub(SHOWN).filter(|more| *more > 0);
    let shown = mistakes.iter().take(SHOWN).map(|mistake| format!("  - {mistake}"));
    let lines: Vec<String> = shown.chain(more.map(|more| format!("  … and {more} more"))).collect();
    format!("{} in the variants:\n{}", counted(mistakes.len(), "mistake"), lines.join("\n"))
}

uplift_job::through_job_error!(UpliftError: LabelledError, FileError);

impl UpliftError {
    /// What happened, without the crates of the pipeline that passed it on: an error of a job, or of the crate of the
    /// science that refused; the last error of the pipeline where it has no other behind it.
    pub fn root(&self) -> &(dyn Error + 'static) {
        root(self)
    }

    /// Blocks or pulses that cannot be, all that was found.
    pub fn blocks(&self) -> &[BlockError] {
        let root = self.root();
        match (root.downcast_ref(), root.downcast_ref()) {
            (Some(DesignError::Blocks(blocks)), _) | (_, Some(LaboratoryError::Blocks(blocks))) => blocks,
            _ => &[],
        }
    }
}

/// The first error in the chain of causes of `error` that no crate of the pipeline made of another one.
pub fn root<'e>(error: &'e (dyn Error + 'static)) -> &'e (dyn Error + 'static) {
    let passes_on = error.is::<UpliftError>()
        || error.is::<InputsError>()
        || error.is::<EngineError>()
        || error.is::<ResultError>()
        || error.is::<UniformRiskError>()
        || error.is::<AlarmsError>()
        || error.is::<StudiesError>()
        || error.is::<QuestionsError>()
        || error.is::<DesignError>()
        || error.is::<LaboratoryError>()
        || error.is::<ExportsError>();
    match error.source().filter(|_| passes_on) {
        Some(source) => root(source),
        None => error,
    }
}
