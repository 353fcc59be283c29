//! What record files do not say themselves.

use clap::Args;
use uplift_job::typed::number;
use uplift_motion::{AccelerationUnit, ReadOptions, RecordFormat, STANDARD_GRAVITY_M_S2};

/// What record files do not say themselves.
#[derive(Debug, Clone, Copy, PartialEq, Args)]
pub struct FileOptions {
    /// File format: at2, esm, knet, cosmos, csmip or columns [default: detected]
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<RecordFormat>,
    /// Unit, if the files name none: g, m/s2, cm/s2 or gal
    #[arg(long, value_name = "UNIT")]
    pub unit: Option<AccelerationUnit>,
    /// Time step, s, if the files name none
    #[arg(long, value_name = "SECONDS", value_parser = number)]
    pub dt_s: Option<f64>,
    /// Acceleration of gravity, m/s2
    #[arg(long, value_name = "M_S2", default_value_t = STANDARD_GRAVITY_M_S2, value_parser = number)]
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
