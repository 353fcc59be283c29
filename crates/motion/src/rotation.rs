//! A plane motion in every horizontal direction.

use crate::accelerogram::Accelerogram;
use crate::combination::Peaks;
use crate::error::MotionError;
use crate::pair::RecordPair;

/// Directions, one a degree; the motion in the opposite direction has the same peak.
const DIRECTIONS: usize = 180;

/// What one value for each direction comes to.
pub(crate) type OfDirections = fn(Vec<f64>) -> f64;

/// The median of the values in [`DIRECTIONS`] directions: halfway between the 90th and the 91st.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    0.5 * (values[DIRECTIONS / 2 - 1] + values[DIRECTIONS / 2])
}

/// The largest of the values.
pub(crate) fn largest(values: Vec<f64>) -> f64 {
    values.into_iter().fold(0.0, f64::max)
}

/// Cosine and sine of every direction.
pub(crate) fn directions() -> impl Iterator<Item = [f64; 2]> {
    (0..DIRECTIONS).map(|degrees| {
        let (sin, cos) = (degrees as f64).to_radians().sin_cos();
        [cos, sin]
    })
}

/// The common time step of the components \[s\].
///
/// # Errors
///
/// [`MotionError::UnequalTimeSteps`].
pub(crate) fn common_time_step_s(pair: &RecordPair) -> Result<f64, MotionError> {
    let (h1_s, h2_s) = (pair.h1.dt_s(), pair.h2.dt_s());
    if h1_s == h2_s { Ok(h1_s) } else { Err(MotionError::UnequalTimeSteps { h1_s, h2_s }) }
}

/// The motion as it is seen from an azimuth θ (degrees from h1 towards h2), h1 cos θ + h2 sin θ; at 0° and 90° the
/// very components.
///
/// # Errors
///
/// [`MotionError::UnequalTimeSteps`]; no motion where a sum of both components is not finite.
pub(crate) fn turned(pair: &RecordPair, azimuth_deg: f64) -> Result<Accelerogram, MotionError> {
    let dt_s = common_time_step_s(pair)?;
    if azimuth_deg == 0.0 {
        return Ok(pair.h1.clone());
    }
    if azimuth_deg == 90.0 {
        return Ok(pair.h2.clone());
    }
    let (sin, cos) = azimuth_deg.to_radians().sin_cos();
    let points = together([&pair.h1, &pair.h2].map(Accelerogram::acceleration_m_s2), [0.0; 2]);
    Accelerogram::new(dt_s, points.iter().map(|[x, y]| x * cos + y * sin).collect())
}

/// What `value` is of the motion in every direction.
///
/// # Errors
///
/// [`MotionError::UnequalTimeSteps`]; no motion where a sum of both components is not finite.
pub(crate) fn in_directions(pair: &RecordPair, value: impl Fn(&Accelerogram) -> f64) -> Result<Vec<f64>, MotionError> {
    let dt_s = common_time_step_s(pair)?;
    let points = together([&pair.h1, &pair.h2].map(Accelerogram::acceleration_m_s2), [0.0; 2]);
    let motion = |[cos, sin]: [f64; 2]| {
        let samples = points.iter().map(|[x, y]| x * cos + y * sin).collect();
        Accelerogram::new(dt_s, samples).map(|motion| value(&motion))
    };
    directions().map(motion).collect()
}

/// Peaks in every direction.
pub(crate) struct Rotated {
    acceleration_m_s2: Vec<f64>,
    velocity_m_s: Vec<f64>,
}

impl Rotated {
    pub(crate) fn from_pair(pair: &RecordPair) -> Result<Self, MotionError> {
        common_time_step_s(pair)?;
        let [a1, a2] = [&pair.h1, &pair.h2].map(Accelerogram::acceleration_m_s2);
        let [v1, v2] = [&pair.h1, &pair.h2].map(Accelerogram::velocity_m_s);
        let last = |velocity: &[f64]| velocity.last().copied().unwrap_or(0.0);
        Ok(Self {
            acceleration_m_s2: rotated_peaks(&together([a1, a2], [0.0; 2])),
            velocity_m_s: rotated_peaks(&together([&v1, &v2], [last(&v1), last(&v2)])),
        })
    }

    /// The peaks that all directions come to.
    pub(crate) fn peaks(&self, chosen: OfDirections) -> Peaks {
        Peaks { pga_m_s2: chosen(self.acceleration_m_s2.clone()), pgv_m_s: chosen(self.velocity_m_s.clone()) }
    }
}

/// The points of a plane motion; the shorter component goes on with the value `after` its end.
fn together([x, y]: [&[f64]; 2], after: [f64; 2]) -> Vec<[f64; 2]> {
    let at = |component: &[f64], index: usize, after: f64| component.get(index).copied().unwrap_or(after);
    (0..x.len().max(y.len())).map(|index| [at(x, index, after[0]), at(y, index, after[1])]).collect()
}

/// Farthest of `points` in the `direction`, and how far it reaches.
fn farthest(points: &[[f64; 2]], [cos, sin]: [f64; 2]) -> ([f64; 2], f64) {
    let mut farthest = ([0.0; 2], 0.0);
    for &[x, y] in points {
        let reach = (x * cos + y * sin).abs();
        if reach > farthest.1 {
            farthest = ([x, y], reach);
        }
    }
    farthest
}

/// Peak of x cos θ + y sin θ for every direction.
pub(crate) fn rotated_peaks(points: &[[f64; 2]]) -> Vec<f64> {
    let directions: Vec<[f64; 2]> = directions().collect();
    // What a few points reach in every direction, no point nearer to the origin can exceed anywhere.
    let few: Vec<[f64; 2]> = directions.iter().step_by(30).map(|&direction| farthest(points, direction).0).collect();
    let radius = directions.iter().map(|&direction| farthest(&few, direction).1).fold(f64::INFINITY, f64::min);
    // Rounding must not cut a point that matters.
    let squared = radius * radius * (1.0 - 1e-12);
    let far: Vec<[f64; 2]> = points.iter().copied().filter(|[x, y]| x * x + y * y >= squared).collect();
    directions.iter().map(|&direction| farthest(&far, direction).1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        // All 180 directions over all points, nothing left out.
        #[test]
        fn points_left_out_change_nothing(points in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 2..200)) {
            let plane: Vec<[f64; 2]> = points.iter().map(|&(x, y)| [x, y]).collect();
            for (degrees, found) in rotated_peaks(&plane).into_iter().enumerate() {
                let (sin, cos) = (degrees as f64).to_radians().sin_cos();
                let expected = points.iter().fold(0.0_f64, |m, (x, y)| m.max((x * cos + y * sin).abs()));
                prop_assert_eq!(found, expected);
            }
        }
    }
}
