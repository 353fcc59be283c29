//! Real records that cases name, below the folder of `UPLIFT_RECORDS`.

use std::path::PathBuf;

use uplift_motion::{Accelerogram, ReadOptions, STANDARD_GRAVITY_M_S2, read_path};

/// A record as it is, with its own step, values in g taken with standard gravity.
pub(crate) fn plain(path: &str) -> Result<Accelerogram, String> {
    let folder = std::env::var_os("UPLIFT_RECORDS")
        .ok_or_else(|| format!("it needs the record {path}: set UPLIFT_RECORDS to the folder that has it"))?;
    read_path(&PathBuf::from(folder).join(path), &ReadOptions::default()).map_err(|error| error.to_string())
}

/// A record of values in g: times `factor` and `gravity_m_s2`, with the step `dt_s`.
pub(crate) fn record(path: &str, factor: f64, gravity_m_s2: f64, dt_s: f64) -> Result<Accelerogram, String> {
    let record = plain(path)?;
    let values = record.acceleration_m_s2().iter().map(|a| a / STANDARD_GRAVITY_M_S2 * factor * gravity_m_s2);
    Accelerogram::new(dt_s, values.collect()).map_err(|error| error.to_string())
}
