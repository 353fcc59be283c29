//! How a structure is modelled where it may overturn: as its equivalent oscillator, and as the block that rotates as it does.

use uplift_block::RockingBlock;
use uplift_ida::{System, Watch, analyse};
use uplift_oscillator::Oscillator;
use uplift_structure::PostUplift;
use uplift_study::{MeasurePlan, Structure, UniformRiskStudy};

use crate::error::UpliftError;
use crate::inputs::RecordSet;
use crate::result::StudyOfResult;
use crate::uniform_risk::plan_stripes;

/// How a structure is modelled.
#[derive(Debug, Clone)]
pub(super) enum Model {
    /// The equivalent oscillator of Table 3.1, linearised.
    Oscillator(Oscillator),
    /// The solitary block that rotates as the structure does: full nonlinear motion.
    Block(RockingBlock),
}

impl Model {
    /// Name in tables and files.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Oscillator(_) => "oscillator",
            Self::Block(_) => "block",
        }
    }

    /// Velocity after over before an impact.
    pub(super) fn restitution(&self) -> f64 {
        match self {
            Self::Oscillator(oscillator) => oscillator.restitution(),
            Self::Block(block) => block.restitution(),
        }
    }

    /// Peak displacements over `[record, level]`, m; infinite where it overturned.
    ///
    /// # Errors
    /// [`UpliftError::Interrupted`] if `watch` says so; a record that cannot be scaled.
    pub(super) fn demands_m(
        &self,
        study: &UniformRiskStudy,
        plan: &MeasurePlan,
        set: &RecordSet,
        watch: &dyn Watch,
    ) -> Result<Vec<f64>, UpliftError> {
        let systems = [match self {
            Self::Oscillator(oscillator) => System::Oscillator(oscillator.clone()),
            Self::Block(block) => System::Block(*block),
        }];
        let plan = plan_stripes(study, plan, set, &systems)?;
        Ok(analyse(&plan, watch)?.of_system_m(0))
    }
}

/// The models of a structure, each with the origin of its restitution.
pub(super) fn models(
    structure: &Structure,
    source: &StudyOfResult,
    for_both: Option<f64>,
    notes: &mut Vec<String>,
) -> Result<Vec<(Model, &'static str)>, UpliftError> {
    let (study, own) = (&source.study, structure.description.restitution);
    let chosen = for_both.map(|value| (value, "--restitution")).or(own.map(|value| (value, "the structure file")));
    let (restitution, origin) = chosen.unwrap_or((study.oscillator.restitution, "the study"));
    let fail = |error: UpliftError| match for_both {
        Some(_) => UpliftError::Usage(format!("--restitution: {error}")),
        None => error.in_file(&structure.file),
    };
    let oscillator = structure.system.spectral_oscillator(restitution).map_err(|error| fail(error.into()))?;
    let mut models = vec![(Model::Oscillator(oscillator), origin)];
    match structure.system.post_uplift() {
        PostUplift::Negative { .. } => {}
        PostUplift::Zero | PostUplift::Positive { .. } => notes.push(
            "the force does not fall after uplift: the equivalent oscillator never overturns, however far it goes"
                .to_owned(),
        ),
    }
    let Some(block) = structure.block else {
        let kind = structure.description.kind.name();
        notes.push(format!("a {kind} rotates as no solitary block does: only the equivalent oscillator is analysed"));
        return Ok(models);
    };
    let (restitution, origin) = chosen.unwrap_or((block.restitution, "angular momentum"));
    let rocking = match RockingBlock::new(block.size_m, block.slenderness_rad) {
        Ok(rocking) => rocking,
        Err(error) => {
            notes.push(format!("only the equivalent oscillator is analysed, for no block rocks so: {error}"));
            return Ok(models);
        }
    };
    let block = rocking
        .with_gravity(structure.system.conditions().gravity_m_s2())
        .and_then(|block| block.with_restitution(restitution))
        .map_err(|error| fail(error.into()))?;
    models.push((Model::Block(block), origin));
    Ok(models)
}
