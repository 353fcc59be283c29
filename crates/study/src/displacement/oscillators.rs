//! The section `[oscillator]`: families of oscillators.

use serde::Serialize;
use serde_json::json;
use uplift_oscillator::PostUplift;
use uplift_plausible::{CAPACITY, UPLIFT_DISPLACEMENT};

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys, Special, grid, one_or_several, special};
use crate::reading::{Field, Node, Rule, Section, Value, quantity};
use crate::sections::stiffness;
use crate::uniform_risk::{FREE_VIBRATION, RESTITUTION};

pub(crate) const KEYS: SectionKeys =
    SectionKeys::new("oscillator", &[&UPLIFT_DISPLACEMENT_M, &CAPACITY_M, &RESTITUTION, &FREE_VIBRATION]);
const UPLIFT_DISPLACEMENT_M: Key<GridRule> =
    grid("uplift_displacement_m", GridRule { unit: "m", each: Rule::Within(UPLIFT_DISPLACEMENT), least_count: 1 })
        .with_default(&["0.0005"])
        .meaning("displacements at uplift u_up, a grid, m");
const CAPACITY_M: Key<Special> = special("capacity_m", finite_or_infinite)
    .without_default("`inf`")
    .meaning(
        "displacements u_cap at which the force is zero, an increasing list, m; `inf` for a force that stays constant",
    )
    .note("1e-6 to 1e6 or `inf`; above every uplift displacement");

/// Capacities as a JSON Schema. JSON has no infinity: readers of TOML make it a number or null.
fn finite_or_infinite() -> serde_json::Value {
    let each = json!({ "type": ["number", "null"], "minimum": CAPACITY.least });
    one_or_several(&each)
}

/// Oscillators of every strength, uplift displacement and capacity of these.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OscillatorFamily {
    /// Displacements at uplift `u_up` \[m\].
    pub uplift_displacement_m: Grid,
    /// Displacements at which the force is zero `u_cap` \[m\]; infinite for zero post-uplift stiffness.
    pub capacity_m: Vec<f64>,
    /// Coefficient of restitution of the velocity at each impact \[-\].
    pub restitution: f64,
    /// Whether the free motion after the end of a record counts.
    pub free_vibration: bool,
    /// Uplift strengths η = `f_up`/(m g) \[-\]; the section `[strengths]`.
    #[serde(skip)]
    pub strengths: Grid,
}

/// Reads the section of oscillators that have these strengths.
pub(crate) fn read(mut section: Section<'_>, strengths: Option<Grid>) -> Option<OscillatorFamily> {
    let uplift = section.read(&UPLIFT_DISPLACEMENT_M);
    let largest = uplift.as_ref().and_then(|grid| grid.last().copied());
    let capacity = section.given(&CAPACITY_M).map_or(Some(vec![f64::INFINITY]), |field| capacities(&field, largest));
    let restitution = section.read(&RESTITUTION);
    let free_vibration = section.read(&FREE_VIBRATION);
    section.finish();
    Some(OscillatorFamily {
        uplift_displacement_m: uplift?,
        capacity_m: capacity?,
        restitution: restitution?,
        free_vibration: free_vibration?,
        strengths: strengths?,
    })
}

/// Finds the oscillators of `family` that are too stiff to be followed among the mistakes.
pub(crate) fn check_stiffness(root: &Section<'_>, family: &OscillatorFamily, gravity_m_s2: f64) {
    let (Some(&strength), Some(&stiffest_m), Some(&next_m)) =
        (family.strengths.last(), family.uplift_displacement_m.first(), family.uplift_displacement_m.last())
    else {
        return;
    };
    stiffness::check(root, (strength, gravity_m_s2, stiffest_m, family.restitution), PostUplift::Zero);
    if let Some(&capacity_m) = family.capacity_m.first().filter(|capacity_m| capacity_m.is_finite()) {
        let steepest = PostUplift::Negative { capacity_m };
        stiffness::check(root, (strength, gravity_m_s2, next_m, family.restitution), steepest);
    }
}

/// Increasing capacities \[m\], each above `above_m`; the last may be infinite.
fn capacities(field: &Field<'_>, above_m: Option<f64>) -> Option<Vec<f64>> {
    let mut capacities: Vec<f64> = Vec::new();
    let mut complete = true;
    for item in field.few_items()? {
        let endless = matches!(item.node, Node { value: Value::Float(value), .. } if *value == f64::INFINITY);
        let Some(capacity) = (if endless { Some(f64::INFINITY) } else { item.number("m", Rule::Within(CAPACITY)) })
        else {
            complete = false;
            continue;
        };
        let shown = quantity(capacity, "m");
        if let Some(above) = above_m.filter(|&above| capacity <= above) {
            item.mistake(
                format!("the capacity {shown} is not above the largest uplift displacement {}", quantity(above, "m")),
                "raise it, or leave the larger uplift displacements out",
            );
            complete = false;
        } else if let Some(&last) = capacities.last().filter(|&&last| capacity <= last) {
            item.mistake(
                format!("{shown} follows {}, but the list must increase", quantity(last, "m")),
                "sort the capacities and give each once; inf, which never overturns, comes last",
            );
            complete = false;
        }
        capacities.push(capacity);
    }
    complete.then_some(capacities)
}
