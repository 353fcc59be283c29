//! How a structure is modelled where it may overturn: as its equivalent oscillator, and as the block that rotates as it
//! does.

use uplift_block::RockingBlock;
use uplift_ida::System;
use uplift_job::JobError;
use uplift_structure::PostUpliftForce;
use uplift_study::{Structure, UniformRiskStudy};

use crate::error::DesignError;

/// The models of a structure, each with the origin of its restitution.
pub(super) fn models(
    structure: &Structure,
    study: &UniformRiskStudy,
    for_both: Option<f64>,
    notes: &mut Vec<String>,
) -> Result<Vec<(System, &'static str)>, DesignError> {
    let own = structure.description.restitution;
    let chosen = for_both.map(|value| (value, "--restitution")).or(own.map(|value| (value, "the structure file")));
    let (restitution, origin) = chosen.unwrap_or((study.oscillator.restitution, "the study"));
    let fail = |error: DesignError| match for_both {
        Some(_) => JobError::Usage(format!("--restitution: {error}")).into(),
        None => uplift_job::in_file(error, &structure.file),
    };
    let oscillator = structure.system.spectral_oscillator(restitution).map_err(|error| fail(error.into()))?;
    let mut models = vec![(System::Oscillator(oscillator), origin)];
    match structure.system.post_uplift() {
        PostUpliftForce::Negative { .. } => {}
        PostUpliftForce::Zero | PostUpliftForce::Positive { .. } => notes.push(
            "the force does not fall after uplift: the equivalent oscillator never overturns, however far it goes"
                .to_owned(),
        ),
    }
    let Some(block) = structure.block else {
        let kind = structure.description.kind.name();
        notes.push(format!("a {kind} is not a solitary block: no block is analysed"));
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
    models.push((System::Block(block), origin));
    Ok(models)
}
