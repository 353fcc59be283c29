//! The frame of a structure file, ready to be shaken.

use uplift_frame::{Model, RockingFrame};
use uplift_job::JobError;
use uplift_study::Structure;

use crate::error::InputsError;

/// Said with every result of the wobbling model.
pub const TORSION: &str = "torsion is outside the model: the deck does not turn about the vertical, which the \
                                  specimen of Chapter 6 did by up to 0.115 rad (Section 6.6)";

/// The columns of `structure` under their deck, with what holds them.
///
/// # Errors
/// A structure that has no columns with flat ends; masses or a slenderness that no frame has.
pub fn rocking_frame(structure: &Structure) -> Result<RockingFrame, InputsError> {
    let Some(frame) = structure.rocking_frame() else {
        return Err(JobError::Usage(format!(
            "{}: the model needs columns with flat ends, and kind \"{}\" has none: use block, frame or \
             restrained-frame",
            structure.file.display(),
            structure.description.kind.name()
        ))
        .into());
    };
    frame.map_err(|error| uplift_job::in_file(InputsError::from(error), &structure.file))
}

/// The model `wanted`; where none is, columns of circular section wobble and others rock in a plane.
pub fn model_of(frame: &RockingFrame, wanted: Option<Model>) -> Model {
    wanted.unwrap_or(match frame.shape() {
        uplift_frame::ColumnShape::Rectangle => Model::Planar,
        uplift_frame::ColumnShape::Cylinder => Model::Wobbling,
    })
}
