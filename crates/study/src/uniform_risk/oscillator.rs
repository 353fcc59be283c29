//! The section `[oscillator]`: the oscillator but for its strength.

use serde::{Serialize, Serializer};
use uplift_oscillator::PostUplift;
use uplift_plausible::{CAPACITY, POST_UPLIFT_STIFFNESS, UPLIFT_DISPLACEMENT};
use uplift_structure::UncertainQuantity;

use crate::keys::{Boolean, Key, Number, SectionKeys, boolean, number};
use crate::reading::{Rule, Section, ZERO_TO_ONE, optional, quantity};

pub(super) const KEYS: SectionKeys = SectionKeys::new(
    "oscillator",
    &[&UPLIFT_DISPLACEMENT_M, &RESTITUTION, &FREE_VIBRATION, &CAPACITY_M, &POST_UPLIFT_STIFFNESS_PER_S2],
);
const UPLIFT_DISPLACEMENT_M: Key<Number> = number("uplift_displacement_m", "m", Rule::Within(UPLIFT_DISPLACEMENT))
    .with_default(0.0005)
    .meaning("displacement at uplift u_up, m");
pub(crate) const RESTITUTION: Key<Number> = number("restitution", "", ZERO_TO_ONE)
    .with_default(0.95)
    .meaning("velocity after an impact divided by the one before");
pub(crate) const FREE_VIBRATION: Key<Boolean> =
    boolean("free_vibration").with_default(true).meaning("whether the motion after the end of a record counts");
const CAPACITY_M: Key<Number> = number("capacity_m", "m", Rule::Within(CAPACITY))
    .without_default("none: the force stays constant (ZSBE)")
    .meaning("displacement u_cap at which the force has fallen to zero, m (NSBE: negative stiffness, can overturn)")
    .note("above `uplift_displacement_m`");
const POST_UPLIFT_STIFFNESS_PER_S2: Key<Number> =
    number("post_uplift_stiffness_per_s2", "1/s2", Rule::Within(POST_UPLIFT_STIFFNESS))
        .without_default("none")
        .meaning("stiffness after uplift divided by mass, 1/s² (the force rises)")
        .note("excludes `capacity_m`");

/// The oscillator but for its strength (Eq. 4.1 to 4.3).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Oscillator {
    /// Displacement at uplift `u_up` \[m\].
    pub uplift_displacement_m: f64,
    /// Coefficient of restitution of the velocity at each impact \[-\].
    pub restitution: f64,
    /// Whether the free motion after the end of a record counts.
    pub free_vibration: bool,
    /// The force after uplift; a capacity is above the displacement at uplift.
    #[serde(flatten, serialize_with = "write_post_uplift")]
    pub post_uplift: PostUplift,
}

impl Oscillator {
    /// `uplift displacement 0.5 mm, restitution 0.95`, and what the force does after uplift unless it stays.
    pub fn in_words(&self) -> String {
        let after_uplift = match self.post_uplift {
            PostUplift::Zero => String::new(),
            PostUplift::Negative { capacity_m } => format!(", capacity {capacity_m} m"),
            PostUplift::Positive { .. } => ", rising force after uplift".to_owned(),
        };
        let uplift_mm = (self.uplift_displacement_m * 1e6).round() / 1e3;
        format!("uplift displacement {uplift_mm} mm, restitution {}{after_uplift}", self.restitution)
    }

    /// Its value of a quantity that may be uncertain: of the strength the factor on each of the study's, 1. None of a
    /// capacity where the force does not fall.
    pub fn value(&self, quantity: UncertainQuantity) -> Option<f64> {
        match (quantity, self.post_uplift) {
            (UncertainQuantity::Strength, _) => Some(1.0),
            (UncertainQuantity::Restitution, _) => Some(self.restitution),
            (UncertainQuantity::UpliftDisplacement, _) => Some(self.uplift_displacement_m),
            (UncertainQuantity::Capacity, PostUplift::Negative { capacity_m }) => Some(capacity_m),
            (UncertainQuantity::Capacity, PostUplift::Zero | PostUplift::Positive { .. }) => None,
        }
    }
}

fn write_post_uplift<S: Serializer>(post_uplift: &PostUplift, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(match *post_uplift {
        PostUplift::Zero => None,
        PostUplift::Negative { capacity_m } => Some(("capacity_m", capacity_m)),
        PostUplift::Positive { stiffness_per_s2 } => Some(("post_uplift_stiffness_per_s2", stiffness_per_s2)),
    })
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Oscillator> {
    let uplift = section.read(&UPLIFT_DISPLACEMENT_M);
    let restitution = section.read(&RESTITUTION);
    let free_vibration = section.read(&FREE_VIBRATION);
    let capacity_field = section.given(&CAPACITY_M);
    let stiffness_field = section.given(&POST_UPLIFT_STIFFNESS_PER_S2);
    section.finish();
    let capacity = optional(capacity_field.as_ref(), |field| CAPACITY_M.read(field));
    let stiffness = optional(stiffness_field.as_ref(), |field| POST_UPLIFT_STIFFNESS_PER_S2.read(field));
    if let (Some(field), Some(Some(capacity)), Some(uplift)) = (&capacity_field, capacity, uplift)
        && capacity <= uplift
    {
        field.mistake(
            format!(
                "the capacity {} is not above the uplift displacement {}",
                quantity(capacity, "m"),
                quantity(uplift, "m")
            ),
            "raise it, or leave it out for an oscillator that never overturns",
        );
    }
    if let (Some(_), Some(field)) = (&capacity_field, &stiffness_field) {
        field.mistake(
            "a positive stiffness after uplift excludes a capacity",
            "keep `capacity_m` (force falls) or this key (force rises), not both",
        );
    }
    let post_uplift = match (capacity?, stiffness?) {
        (Some(capacity_m), _) => PostUplift::Negative { capacity_m },
        (None, Some(stiffness_per_s2)) => PostUplift::Positive { stiffness_per_s2 },
        (None, None) => PostUplift::Zero,
    };
    Some(Oscillator {
        uplift_displacement_m: uplift?,
        restitution: restitution?,
        free_vibration: free_vibration?,
        post_uplift,
    })
}
