//! What record files do not say themselves.

use uplift_motion::{AccelerationUnit, ReadOptions, RecordFormat, STANDARD_GRAVITY_M_S2};

/// What record files do not say themselves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FileOptions {
    /// Layout of every file; none to tell each by its content.
    pub format: Option<RecordFormat>,
    /// Unit of files that name none.
    pub unit: Option<AccelerationUnit>,
    /// Time step of files with one column that name none, s.
    pub dt_s: Option<f64>,
    /// Acceleration of gravity, m/s².
    pub gravity_m_s2: f64,
}

impl Default for FileOptions {
    fn default() -> Self {
        Self { format: None, unit: None, dt_s: None, gravity_m_s2: STANDARD_GRAVITY_M_S2 }
    }
}

impl FileOptions {
    /// The same for one component of a file, or for all of them.
    pub(crate) fn read_options(&self, channel: Option<usize>) -> ReadOptions {
        ReadOptions { format: self.format, channel, dt_s: self.dt_s, unit: self.unit, gravity_m_s2: self.gravity_m_s2 }
    }
}
