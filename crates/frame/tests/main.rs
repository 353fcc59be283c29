//! What the crate promises.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod block_limit;
mod free_motion;
mod limits;
mod misuse;
mod reference_cases;
mod restrainers;
mod rolling;
mod sections;
mod shake_table;
mod symmetry;

use uplift_frame::{ColumnShape, GroundMotion, Pulse, PulseShape, RockingFrame, Shaking};
use uplift_statics::{DiscDimensions, DiscSpring, DiscStack, Parts, Restrainer, TendonPath};
use uplift_structure::Geometry;

/// The frame of the shaking table (Section 6.3): four columns of 197 mm × 1450 mm.
fn table_frame(shape: ColumnShape) -> RockingFrame {
    let column = Geometry::from_width_and_height(0.197, 1.45).unwrap();
    RockingFrame::new(column, 4, 124.363, 9435.0, shape, 9.81).unwrap()
}

/// The same with springs of constant stiffness (N/m).
fn held_frame(shape: ColumnShape, stiffness_n_m: f64) -> RockingFrame {
    let restrainer = Restrainer::new(Parts::linear(stiffness_n_m)).unwrap();
    table_frame(shape).with_restrainer(restrainer, TendonPath::Column).unwrap()
}

/// Discs of 125 mm, one upon the other in opposite directions.
fn stack(discs: u32) -> DiscStack {
    let disc = DiscSpring::new(DiscDimensions {
        outer_diameter_m: 0.125,
        inner_diameter_m: 0.061,
        thickness_m: 0.006,
        cone_height_m: 0.0036,
        reduced_thickness_m: None,
    });
    DiscStack::new(disc.unwrap(), discs, 1).unwrap()
}

/// A pulse as a component of the ground's motion.
#[allow(clippy::unnecessary_wraps)] // as a ground motion has it
fn pulse(shape: PulseShape, amplitude_m_s2: f64, period_s: f64, start_s: f64) -> Option<Shaking<'static>> {
    Some(Shaking::Pulse(Pulse::new(shape, amplitude_m_s2, period_s, start_s).unwrap()))
}

/// Two pulses in two directions.
fn two_pulses() -> GroundMotion<'static> {
    GroundMotion { x: pulse(PulseShape::Sine, 2.6, 0.55, 0.1), y: pulse(PulseShape::Cosine, 1.6, 0.7, 0.25), z: None }
}
