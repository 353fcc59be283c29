//! The section `[model]`: what the wobbling frame leaves to choose.

use serde::Serialize;

use crate::keys::{Key, Number, SectionKeys, number};
use crate::reading::{Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys::new("model", &[&REST_AMPLITUDE_RAD, &START_ROTATION_RAD]);
const REST_AMPLITUDE_RAD: Key<Number> = number("rest_amplitude_rad", "rad", REST).with_default(1e-5).meaning(
    "tilt whose energy is that of a frame at rest, rad: nothing else ends the motion of a model without dissipation",
);
const START_ROTATION_RAD: Key<Number> = number("start_rotation_rad", "rad", START)
    .with_default(1e-12)
    .meaning("tilt with which the frame leaves the ground, rad: the motion converges as it goes to zero");

/// How large the tilt of a frame at rest may be.
pub(crate) const REST: Rule = Rule::From(1e-9, 1e-2, "from 1e-9 to 0.01 rad");
const START: Rule = Rule::From(1e-15, 1e-6, "from 1e-15 to 1e-6 rad");

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
    let rest_amplitude_rad = section.read(&REST_AMPLITUDE_RAD);
    let start_rotation_rad = section.read(&START_ROTATION_RAD);
    section.finish();
    Some(FrameModel { rest_amplitude_rad: rest_amplitude_rad?, start_rotation_rad: start_rotation_rad? })
}
