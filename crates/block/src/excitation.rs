//! What shakes the block: a record, or a pulse.

use uplift_motion::Accelerogram;
use uplift_taylor::Forcing;

use crate::error::{BlockError, within};
use crate::ricker::RickerPulse;

/// Ground acceleration, smooth on segments of equal length, zero before the first and after the last.
#[derive(Debug, Clone, Copy)]
pub enum Excitation<'a> {
    /// A record, linear between its samples: a segment is a sample interval.
    Record(&'a Accelerogram),
    /// A Ricker wavelet, analytic: a segment is a sixteenth of its period.
    Pulse(RickerPulse),
}

impl<'a> From<&'a Accelerogram> for Excitation<'a> {
    fn from(record: &'a Accelerogram) -> Self {
        Self::Record(record)
    }
}

impl From<RickerPulse> for Excitation<'_> {
    fn from(pulse: RickerPulse) -> Self {
        Self::Pulse(pulse)
    }
}

impl Excitation<'_> {
    /// Time at which the shaking begins \[s\]: zero for a record, three periods before its centre for a pulse.
    pub fn start_s(&self) -> f64 {
        match self {
            Self::Record(_) => 0.0,
            Self::Pulse(pulse) => pulse.start_s(),
        }
    }

    /// How long the shaking lasts \[s\].
    pub fn duration_s(&self) -> f64 {
        self.segments() as f64 * self.segment_s()
    }

    /// Number of segments.
    pub(crate) fn segments(&self) -> usize {
        match self {
            Self::Record(record) => record.len() - 1,
            Self::Pulse(_) => RickerPulse::segments(),
        }
    }

    /// Length of a segment \[s\].
    pub(crate) fn segment_s(&self) -> f64 {
        match self {
            Self::Record(record) => record.dt_s(),
            Self::Pulse(pulse) => pulse.segment_s(),
        }
    }

    /// Makes `forcing` the ground acceleration \[m/s²\] in the segment `segment`, in powers of
    /// (time − `offset_s`)/`step_s`, with times from its start.
    pub(crate) fn shake(&self, segment: usize, offset_s: f64, step_s: f64, forcing: &mut Forcing) {
        match self {
            Self::Record(record) => {
                let samples = [segment, segment + 1].map(|i| record.acceleration_m_s2()[i]);
                set_line(forcing, samples, record.dt_s(), offset_s, step_s);
            }
            Self::Pulse(pulse) => {
                let t_s = pulse.start_s() + (segment as f64 * pulse.segment_s() + offset_s);
                *forcing = pulse.taylor(t_s, step_s);
            }
        }
    }

    /// Refuses accelerations that no ground has.
    pub(crate) fn check(&self) -> Result<(), BlockError> {
        if let Self::Record(record) = self {
            record.acceleration_m_s2().iter().try_for_each(|a| check_acceleration(*a))?;
        }
        Ok(())
    }
}

/// Refuses what no ground has.
pub(crate) fn check_acceleration(acceleration_m_s2: f64) -> Result<(), BlockError> {
    let range = -1e6..=1e6;
    within("ground acceleration", acceleration_m_s2, "m/s2", range, "between -1e6 and 1e6 m/s2").map(|_| ())
}

/// Makes `forcing` the part of a straight line between two samples that begins at `offset_s` and lasts `step_s`, in
/// powers of (time − `offset_s`)/`step_s`.
pub(crate) fn set_line(forcing: &mut Forcing, [begin, end]: [f64; 2], dt_s: f64, offset_s: f64, step_s: f64) {
    let change = end - begin;
    forcing.set_line(begin + change * (offset_s / dt_s), change * (step_s / dt_s));
}
