//! What shakes the frame: up to three components, each a record or a pulse.

use uplift_motion::Accelerogram;
use uplift_taylor::Forcing;

use crate::error::{FrameError, within};
use crate::pulse::Pulse;

/// A component of the ground's acceleration.
#[derive(Debug, Clone, Copy)]
pub enum Shaking<'a> {
    /// A record from time zero on, linear between samples, zero after the last.
    Record(&'a Accelerogram),
    /// A pulse.
    Pulse(Pulse),
}

/// Ground acceleration in two horizontal directions and upwards.
#[derive(Debug, Clone, Copy, Default)]
pub struct GroundMotion<'a> {
    /// First horizontal component; the one that the planar model receives.
    pub x: Option<Shaking<'a>>,
    /// Second horizontal component.
    pub y: Option<Shaking<'a>>,
    /// Vertical component, upwards positive.
    pub z: Option<Shaking<'a>>,
}

/// Samples within this part of a step are the same moment.
const SAME_MOMENT: f64 = 1e-9;

impl<'a> GroundMotion<'a> {
    /// One record.
    pub fn along_x(record: &'a Accelerogram) -> Self {
        Self { x: Some(Shaking::Record(record)), ..Self::default() }
    }

    /// Two horizontal records.
    pub fn pair(x: &'a Accelerogram, y: &'a Accelerogram) -> Self {
        Self { y: Some(Shaking::Record(y)), ..Self::along_x(x) }
    }

    /// When the last component ends, s.
    pub fn duration_s(&self) -> f64 {
        let end = |component: &Option<Shaking<'_>>| component.map_or(0.0, |shaking| shaking.end_s());
        end(&self.x).max(end(&self.y)).max(end(&self.z))
    }

    /// The direction of the horizontal acceleration, where it has one and keeps it: a unit vector. Motion that begins
    /// along it stays in its plane.
    pub(crate) fn line(&self) -> Option<[f64; 2]> {
        match (self.x, self.y) {
            (Some(_), None) => Some([1.0, 0.0]),
            (None, Some(_)) => Some([0.0, 1.0]),
            (Some(Shaking::Record(x)), Some(Shaking::Record(y))) if x.dt_s() == y.dt_s() => record_line(x, y),
            (Some(Shaking::Pulse(x)), Some(Shaking::Pulse(y))) if x.is_parallel_to(&y) => {
                unit([x.amplitude_m_s2(), y.amplitude_m_s2()])
            }
            _ => None,
        }
    }

    /// Moments at which a component changes its law, ascending from 0 to the end of all, s.
    pub(crate) fn knots_s(&self) -> Vec<f64> {
        let mut knots = vec![0.0];
        let mut shortest = f64::INFINITY;
        for shaking in [self.x, self.y, self.z].into_iter().flatten() {
            let first = knots.len();
            match shaking {
                Shaking::Record(record) => {
                    knots.extend((0..record.len()).map(|sample| sample as f64 * record.dt_s()));
                    shortest = shortest.min(record.dt_s());
                }
                Shaking::Pulse(pulse) => {
                    knots.extend(pulse.knots_s());
                    shortest = shortest.min(knots[knots.len() - 1] - knots[knots.len() - 2]);
                }
            }
            debug_assert!(knots.len() > first);
        }
        knots.sort_by(f64::total_cmp);
        knots.dedup_by(|next, last| *next - *last <= SAME_MOMENT * shortest);
        knots
    }

    /// Makes `pieces` the components between two neighbouring knots (s), in units of `gravity_m_s2`. In place: copies
    /// would cost as much as all else.
    pub(crate) fn between(&self, begin_s: f64, end_s: f64, gravity_m_s2: f64, pieces: &mut [Piece; 3]) {
        for (piece, component) in pieces.iter_mut().zip([&self.x, &self.y, &self.z]) {
            match component {
                Some(shaking) => *piece = shaking.piece(begin_s, end_s, gravity_m_s2),
                None => *piece = Piece::Zero,
            }
        }
    }

    /// Refuses accelerations that no ground has.
    pub(crate) fn check(&self) -> Result<(), FrameError> {
        for shaking in [self.x, self.y, self.z].into_iter().flatten() {
            if let Shaking::Record(record) = shaking {
                for a in record.acceleration_m_s2() {
                    within("ground acceleration", *a, "m/s2", -1e6..=1e6, "between -1e6 and 1e6 m/s2")?;
                }
            }
        }
        Ok(())
    }
}

/// A component on a segment, in units of gravity.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Piece {
    Zero,
    /// Value at the begin, and slope, 1/s.
    Linear(f64, f64),
    /// A pulse whose segment begins at a time, s, and one over gravity.
    Pulse(Pulse, f64, f64),
}

impl Piece {
    /// Values at the begin and the end of a segment of `length_s`, between which all others lie; of a pulse none.
    pub(crate) fn ends(&self, length_s: f64) -> Option<[f64; 2]> {
        match self {
            Self::Zero => Some([0.0; 2]),
            Self::Linear(begin, slope) => Some([*begin, begin + slope * length_s]),
            Self::Pulse(..) => None,
        }
    }

    /// At an offset (s) in the segment.
    pub(crate) fn value(&self, offset_s: f64) -> f64 {
        match self {
            Self::Zero => 0.0,
            Self::Linear(begin, slope) => begin + slope * offset_s,
            Self::Pulse(pulse, begin_s, factor) => factor * pulse.taylor(begin_s + offset_s, 0.0).value(0.0),
        }
    }

    /// In powers of `(time − offset)/step` from an offset (s) in the segment on.
    pub(crate) fn write(&self, offset_s: f64, step_s: f64, forcing: &mut Forcing) {
        match self {
            Self::Zero => forcing.set_none(),
            Self::Linear(begin, slope) => forcing.set_line(begin + slope * offset_s, slope * step_s),
            Self::Pulse(pulse, begin_s, factor) => {
                *forcing = pulse.taylor(begin_s + offset_s, step_s).times(*factor);
            }
        }
    }
}

impl Shaking<'_> {
    fn end_s(&self) -> f64 {
        match self {
            Self::Record(record) => record.duration_s(),
            Self::Pulse(pulse) => pulse.end_s(),
        }
    }

    #[inline]
    fn piece(&self, begin_s: f64, end_s: f64, gravity_m_s2: f64) -> Piece {
        let middle_s = 0.5 * (begin_s + end_s);
        match self {
            Self::Record(record) => {
                let samples = record.acceleration_m_s2();
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // time runs from 0 to the end
                let index = (middle_s / record.dt_s()) as usize;
                let (Some(begin), Some(end)) = (samples.get(index), samples.get(index + 1)) else { return Piece::Zero };
                let slope = (end - begin) / (record.dt_s() * gravity_m_s2);
                let since_s = begin_s - index as f64 * record.dt_s();
                Piece::Linear(begin / gravity_m_s2 + slope * since_s, slope)
            }
            Self::Pulse(pulse) if middle_s > pulse.start_s() && middle_s < pulse.end_s() => {
                Piece::Pulse(*pulse, begin_s, 1.0 / gravity_m_s2)
            }
            Self::Pulse(_) => Piece::Zero,
        }
    }
}

/// The direction of a pair of records that are multiples of one another, to rounding.
fn record_line(x: &Accelerogram, y: &Accelerogram) -> Option<[f64; 2]> {
    let at = |record: &Accelerogram, index: usize| record.acceleration_m_s2().get(index).copied().unwrap_or(0.0);
    // squares of the smallest samples would be zero
    let size = |[x, y]: [f64; 2]| x.hypot(y);
    let pairs = || (0..x.len().max(y.len())).map(|index| [at(x, index), at(y, index)]);
    let largest = pairs().max_by(|one, other| size(*one).total_cmp(&size(*other)))?;
    let line = unit(largest)?;
    let across = |a: [f64; 2]| (a[0] * line[1] - a[1] * line[0]).abs() > 4.0 * f64::EPSILON * size(a);
    (!pairs().any(across)).then_some(line)
}

/// Length of a vector. `hypot`, which also holds where squares are beyond all numbers, takes several times as long.
pub(crate) fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

fn unit(vector: [f64; 2]) -> Option<[f64; 2]> {
    let size = vector[0].hypot(vector[1]);
    (size > 0.0).then(|| vector.map(|component| component / size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pulse::PulseShape;

    #[test]
    fn records_of_different_steps_share_their_knots() {
        let x = Accelerogram::new(0.01, vec![0.0, 1.0, -1.0, 2.0]).unwrap();
        let y = Accelerogram::new(0.02, vec![1.0, 3.0, 0.0]).unwrap();
        let ground = GroundMotion::pair(&x, &y);
        assert_eq!(ground.knots_s(), [0.0, 0.01, 0.02, 0.03, 0.04]);
        assert!(ground.line().is_none());
        let at = |begin: f64, end: f64, offset: f64| {
            let mut pieces = [Piece::Zero; 3];
            ground.between(begin, end, 1.0, &mut pieces);
            pieces.map(|piece| piece.value(offset))
        };
        let close = |found: [f64; 3], expected: [f64; 3]| {
            found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12)
        };
        assert!(close(at(0.01, 0.02, 0.005), [0.0, 2.5, 0.0]), "{:?}", at(0.01, 0.02, 0.005));
        assert!(close(at(0.03, 0.04, 0.005), [0.0, 0.75, 0.0])); // the first has ended
    }

    #[test]
    fn multiples_of_one_record_have_a_direction() {
        let x = Accelerogram::new(0.01, vec![0.1, -0.7, 0.3]).unwrap();
        let y = x.scaled(-0.75).unwrap();
        let line = GroundMotion::pair(&x, &y).line().unwrap();
        assert!((line[0] + 0.8).abs() < 1e-15 && (line[1] - 0.6).abs() < 1e-15);
        let pulse =
            |amplitude, period| Some(Shaking::Pulse(Pulse::new(PulseShape::Sine, amplitude, period, 0.1).unwrap()));
        let ground = |other| GroundMotion { x: pulse(3.0, 0.5), y: other, z: None };
        assert_eq!(ground(pulse(4.0, 0.5)).line(), Some([0.6, 0.8]));
        assert_eq!(ground(pulse(4.0, 0.6)).line(), None);
        assert_eq!(ground(None).line(), Some([1.0, 0.0]));
        assert_eq!(GroundMotion::default().line(), None);
    }
}
