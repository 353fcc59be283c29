//! A model of a frame as it is typed.

use uplift_frame::Model;

/// A model of a frame by its name.
pub(crate) fn model(word: &str) -> Result<Model, String> {
    match word {
        "planar" => Ok(Model::Planar),
        "wobbling" => Ok(Model::Wobbling),
        _ => Err("it is planar or wobbling".to_owned()),
    }
}
