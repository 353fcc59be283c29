//! Where things are in a result file (docs/hdf5-layout.md).

use uplift_motion::IntensityMeasure;

/// Version of the layout of the result file.
pub const LAYOUT: i64 = 1;

/// Name of the axis of a measure's levels.
pub fn level_axis(measure: IntensityMeasure) -> String {
    format!("{}_level", measure.key())
}
