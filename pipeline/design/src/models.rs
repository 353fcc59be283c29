//! How a structure is modelled where it may overturn: as its equivalent oscillator, and as the block that rotates as it
//! does.

use uplift_block::RockingBlock;
use uplift_ida::System;
use uplift_job::JobError;
use uplift_structure::{Kind, PostUpliftForce};
use uplift_study::{Structure, UniformRiskStudy};

use crate::error::DesignError;

/// The kind of the block that rotates as another structure does.
const EQUIVALENT_BLOCK: &str = "equivalent block";

/// What a `model` of a structure is, a word for tables.
pub(super) fn kind(model: &System, structure: &Structure) -> &'static str {
    match model {
        System::Block(_) if structure.description.kind != Kind::Block => EQUIVALENT_BLOCK,
        _ => model.kind(),
    }
}

/// How far the structure goes where a block that rotates as it does goes 1 m: half as far where its centre is followed.
pub(super) fn travel_over_block(structure: &Structure, block: &RockingBlock) -> f64 {
    // both are about to fall there
    structure.system.capacity_m().map_or(1.0, |own_m| own_m / (2.0 * block.half_width_m()))
}

/// The equivalent oscillator of a structure, with the origin of its restitution.
pub(super) fn oscillator(
    structure: &Structure,
    study: &UniformRiskStudy,
    for_all: Option<f64>,
    notes: &mut Vec<String>,
) -> Result<(System, &'static str), DesignError> {
    let (restitution, origin) = chosen(structure, for_all).unwrap_or((study.oscillator.restitution, "the study"));
    let oscillator = structure.system.spectral_oscillator(restitution);
    let oscillator = oscillator.map_err(|error| refused(error.into(), structure, for_all))?;
    match structure.system.post_uplift() {
        PostUpliftForce::Negative { .. } => {}
        PostUpliftForce::Zero | PostUpliftForce::Positive { .. } => notes.push(
            "the force does not fall after uplift: the equivalent oscillator never overturns, however far it goes"
                .to_owned(),
        ),
    }
    Ok((System::Oscillator(oscillator), origin))
}

/// The block that rotates as a structure does, with the origin of its restitution; or why there is none.
pub(super) fn block(
    structure: &Structure,
    for_all: Option<f64>,
) -> Result<Result<(RockingBlock, &'static str), String>, DesignError> {
    let Some(block) = structure.block else {
        let kind = structure.description.kind.name();
        return Ok(Err(format!("a {kind} is not a solitary block")));
    };
    let (restitution, origin) = chosen(structure, for_all).unwrap_or((block.restitution, "angular momentum"));
    let rocking = match RockingBlock::new(block.size_m, block.slenderness_rad) {
        Ok(rocking) => rocking,
        Err(error) => {
            return Ok(Err(format!("no block of these dimensions rocks: {error}")));
        }
    };
    let rocking = rocking
        .with_gravity(structure.system.conditions().gravity_m_s2())
        .and_then(|block| block.with_restitution(restitution))
        .map_err(|error| refused(error.into(), structure, for_all))?;
    Ok(Ok((rocking, origin)))
}

/// The restitution that was asked for, else that of the structure's file.
pub(super) fn chosen(structure: &Structure, for_all: Option<f64>) -> Option<(f64, &'static str)> {
    let own = structure.description.restitution;
    for_all.map(|value| (value, "--restitution")).or(own.map(|value| (value, "the structure file")))
}

/// Whose restitution no model has.
pub(super) fn refused(error: DesignError, structure: &Structure, for_all: Option<f64>) -> DesignError {
    match for_all {
        Some(_) => JobError::Usage(format!("--restitution: {error}")).into(),
        None => uplift_job::in_file(error, &structure.file),
    }
}
