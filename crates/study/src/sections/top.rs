//! What stands at the top of a study file, before its sections.

use uplift_motion::STANDARD_GRAVITY_M_S2;

use crate::keys::{Choice, Integer, Key, Number, Text, choice, integer, number, text};
use crate::kind::Kind;
use crate::reading::{LARGEST_INTEGER, Rule};

pub(crate) const KIND: Key<Choice<Kind>> =
    choice("kind", &Kind::ALL, Kind::key).with_default(Kind::UniformRisk).meaning("what the study is of");
pub(crate) const TITLE: Key<Text> = text("title").with_default("").meaning("free text, carried into the results");
pub(crate) const GRAVITY: Key<Number> = number("gravity_m_s2", "m/s2", Rule::Within(uplift_plausible::GRAVITY))
    .with_default(STANDARD_GRAVITY_M_S2)
    .meaning("acceleration of gravity, m/s²")
    .note("a warning unless 9.7 to 9.9");

/// A key `seed`.
pub(crate) const fn seed(default: u64) -> Key<Integer> {
    integer("seed", 0, LARGEST_INTEGER).with_default(default)
}
