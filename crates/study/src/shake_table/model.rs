//! The section `[model]`: what the wobbling frame leaves to choose.

use serde::Serialize;

use crate::keys::{Key, SectionKeys};
use crate::reading::{Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys {
    section: "model",
    keys: &[
        Key {
            names: &["rest_amplitude_rad"],
            meaning: "tilt whose energy is that of a frame at rest, rad: nothing else ends the motion of a model \
                      without dissipation",
            default: "1e-5",
            range: "1e-9 to 0.01",
        },
        Key {
            names: &["start_rotation_rad"],
            meaning: "tilt with which the frame leaves the ground, rad: the motion converges as it goes to zero",
            default: "1e-12",
            range: "1e-15 to 1e-6",
        },
    ],
};

const REST: Rule = Rule::Is { holds: |value| (1e-9..=1e-2).contains(&value), words: "from 1e-9 to 0.01 rad" };
const START: Rule = Rule::Is { holds: |value| (1e-15..=1e-6).contains(&value), words: "from 1e-15 to 1e-6 rad" };

/// What the wobbling frame leaves to choose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FrameModel {
    /// Tilt whose energy is that of a frame at rest \[rad\].
    pub rest_amplitude_rad: f64,
    /// Tilt with which the frame leaves the ground \[rad\].
    pub start_rotation_rad: f64,
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<FrameModel> {
    let rest_amplitude_rad = section.number_or("rest_amplitude_rad", "rad", REST, 1e-5);
    let start_rotation_rad = section.number_or("start_rotation_rad", "rad", START, 1e-12);
    section.finish();
    Some(FrameModel { rest_amplitude_rad: rest_amplitude_rad?, start_rotation_rad: start_rotation_rad? })
}
