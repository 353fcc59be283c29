//! What strength, gravity and the displacements of `[oscillator]` make together.

use uplift_oscillator::{Oscillator, OscillatorError, PostUplift};

use crate::reading::Section;

/// Finds an oscillator that is too stiff to be followed among the mistakes; what else is wrong with it is found key by
/// key.
///
/// * `root` — of the study
/// * `strength`, `gravity_m_s2`, `uplift_displacement_m`, `restitution` — of its stiffest oscillator
pub(crate) fn check(
    root: &Section<'_>,
    (strength, gravity_m_s2, uplift_displacement_m, restitution): (f64, f64, f64, f64),
    post_uplift: PostUplift,
) {
    let made = Oscillator::new(strength, gravity_m_s2, uplift_displacement_m, restitution, post_uplift);
    if let Err(error @ OscillatorError::TooStiff { .. }) = made {
        root.mistake("oscillator", error.to_string(), "check the units of these keys: s, m and m/s2");
    }
}
