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
    let (restitution, origin) = chosen(structure, for_both).unwrap_or((study.oscillator.restitution, "the study"));
    let oscillator = structure.system.spectral_oscillator(restitution);
    let oscillator = oscillator.map_err(|error| refused(error.into(), structure, for_both))?;
    let mut models = vec![(System::Oscillator(oscillator), origin)];
    match structure.system.post_uplift() {
        PostUpliftForce::Negative { .. } => {}
        PostUpliftForce::Zero | PostUpliftForce::Positive { .. } => notes.push(
            "the force does not fall after uplift: the equivalent oscillator never overturns, however far it goes"
                .to_owned(),
        ),
    }
    match block(structure, for_both)? {
        Ok((block, origin)) => models.push((System::Block(block), origin)),
        Err(reason) => notes.push(format!("no block is analysed: {reason}")),
    }
    Ok(models)
}

/// The block that rotates as a structure does, with the origin of its restitution; or why there is none.
pub(super) fn block(
    structure: &Structure,
    for_both: Option<f64>,
) -> Result<Result<(RockingBlock, &'static str), String>, DesignError> {
    let Some(block) = structure.block else {
        let kind = structure.description.kind.name();
        return Ok(Err(format!("a {kind} is not a solitary block")));
    };
    let (restitution, origin) = chosen(structure, for_both).unwrap_or((block.restitution, "angular momentum"));
    let rocking = match RockingBlock::new(block.size_m, block.slenderness_rad) {
        Ok(rocking) => rocking,
        Err(error) => {
            return Ok(Err(format!("no block of these dimensions rocks: {error}")));
        }
    };
    let rocking = rocking
        .with_gravity(structure.system.conditions().gravity_m_s2())
        .and_then(|block| block.with_restitution(restitution))
        .map_err(|error| refused(error.into(), structure, for_both))?;
    Ok(Ok((rocking, origin)))
}

/// The restitution that was asked for, else that of the structure's file.
fn chosen(structure: &Structure, for_both: Option<f64>) -> Option<(f64, &'static str)> {
    let own = structure.description.restitution;
    for_both.map(|value| (value, "--restitution")).or(own.map(|value| (value, "the structure file")))
}

/// Whose restitution no model has.
fn refused(error: DesignError, structure: &Structure, for_both: Option<f64>) -> DesignError {
    match for_both {
        Some(_) => JobError::Usage(format!("--restitution: {error}")).into(),
        None => uplift_job::in_file(error, &structure.file),
    }
}
