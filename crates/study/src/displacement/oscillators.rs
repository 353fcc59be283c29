//! The section `[oscillator]`: families of oscillators.

use serde::Serialize;
use uplift_plausible::{CAPACITY, UPLIFT_DISPLACEMENT};

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys};
use crate::reading::{Field, Node, Rule, Section, Value, ZERO_TO_ONE, quantity};
use crate::sections::strengths;

pub(super) const KEYS: SectionKeys = SectionKeys {
    section: "oscillator",
    keys: &[
        Key {
            names: &["uplift_displacement_m"],
            meaning: "displacements at uplift u_up, a grid, m",
            default: "0.0005",
            range: "1e-6 to 10",
        },
        Key {
            names: &["capacity_m"],
            meaning: "displacements u_cap at which the force is zero, an increasing list, m; `inf` for a force that \
                      stays constant",
            default: "`inf`",
            range: "1e-6 to 1e6 or `inf`; above every uplift displacement",
        },
        Key {
            names: &["restitution"],
            meaning: "velocity after an impact divided by the one before",
            default: "0.95",
            range: "0 to 1",
        },
        Key {
            names: &["free_vibration"],
            meaning: "whether the motion after the end of a record counts",
            default: "`true`",
            range: "",
        },
    ],
};

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

/// Reads the section with `[strengths]`.
pub(super) fn read(mut section: Section<'_>, strengths: Section<'_>) -> Option<OscillatorFamily> {
    let rule = GridRule { unit: "m", each: Rule::Within(UPLIFT_DISPLACEMENT), least_count: 1 };
    let uplift = Grid::of_key(&mut section, "uplift_displacement_m", rule, &["0.0005"]);
    let largest = uplift.as_ref().and_then(|grid| grid.last().copied());
    let capacity = section.field("capacity_m").map_or(Some(vec![f64::INFINITY]), |field| capacities(&field, largest));
    let restitution = section.number_or("restitution", "", ZERO_TO_ONE, 0.95);
    let free_vibration = section.boolean_or("free_vibration", true);
    section.finish();
    let values = strengths::read(strengths);
    Some(OscillatorFamily {
        uplift_displacement_m: uplift?,
        capacity_m: capacity?,
        restitution: restitution?,
        free_vibration: free_vibration?,
        strengths: values?,
    })
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
