//! Restrainers: their force over the elongation, and stacks out of a catalogue (Sections 5.3.3 and 6.3.3).

mod catalogue;
mod curve;
mod design;
mod options;

pub use curve::{CurveRow, RestrainerCurve, RestrainerCurveOptions, StackReport, ThresholdRow, curve};
pub use design::{AtDemand, RestrainerDesign, StackTarget, StopperReport, design, stack_name};
pub use options::{LimitOptions, RestrainerDesignOptions};
