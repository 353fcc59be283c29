//! One record through one oscillator or one rigid block, or a pair through a frame: peaks, impacts and, where asked
//! for, the time history.

mod block;
mod frame;
mod frame_history;
mod history;
mod shaking;

use std::path::PathBuf;

use serde::Serialize;
use uplift_ida::{IdaError, System};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, PostUplift, respond, respond_with_history};
use uplift_plausible::{
    CAPACITY, POST_UPLIFT_STIFFNESS, RESTITUTION, STRENGTH, UPLIFT_DISPLACEMENT, USUAL_CAPACITY, USUAL_RESTITUTION,
    USUAL_STRENGTH, USUAL_UPLIFT_DISPLACEMENT,
};

pub use block::{BlockHistory, BlockResponseOptions, BlockResponseReport, block_response};
pub use frame::{ComponentFile, FrameResponseOptions, FrameResponseReport, FrameRun, ShakenComponent, frame_response};
pub use frame_history::{FrameHistory, FrameHistoryRow};
pub use history::{HistoryRow, ResponseHistory};
pub use shaking::{Shaking, ShakingRecord};

use crate::error::LaboratoryError;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;

/// Which oscillator is shaken, and by what.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseOptions {
    /// The record, and what is kept of the motion.
    pub shaking: Shaking,
    /// Strength η: uplift force over weight.
    pub strength: f64,
    /// Displacement at uplift, m.
    pub uplift_displacement_m: f64,
    /// Displacement where the restoring force vanishes, m: a system of negative stiffness after uplift, which can
    /// overturn.
    pub capacity_m: Option<f64>,
    /// Stiffness after uplift over the mass, 1/s², of a system where it is positive; not beside `capacity_m`.
    pub post_uplift_stiffness_per_s2: Option<f64>,
    /// Coefficient of restitution at impact.
    pub restitution: f64,
}

impl ResponseOptions {
    /// `record`, unscaled, through the system of zero stiffness after uplift that has this `strength` and else the
    /// values of the studies; no history.
    pub fn new(record: impl Into<PathBuf>, strength: f64) -> Self {
        Self {
            shaking: Shaking::new(record),
            strength,
            uplift_displacement_m: 0.0005,
            capacity_m: None,
            post_uplift_stiffness_per_s2: None,
            restitution: 0.95,
        }
    }

    /// Refuses numbers that no system, record or person means; all of them at once.
    fn check(&self) -> Result<(), LaboratoryError> {
        self.shaking.check(&[
            (STRENGTH, "strength", Some(self.strength)),
            (UPLIFT_DISPLACEMENT, "uplift_displacement_m", Some(self.uplift_displacement_m)),
            (CAPACITY, "capacity_m", self.capacity_m),
            (POST_UPLIFT_STIFFNESS, "post_uplift_stiffness_per_s2", self.post_uplift_stiffness_per_s2),
            (RESTITUTION, "restitution", Some(self.restitution)),
        ])
    }

    /// The numbers that can be but are unlikely, mistakes of unit mostly.
    fn alarms(&self) -> Vec<Alarm> {
        self.shaking.alarms(&[
            (USUAL_STRENGTH, "--strength", Some(self.strength)),
            (USUAL_UPLIFT_DISPLACEMENT, "--uplift-displacement-m", Some(self.uplift_displacement_m)),
            (USUAL_CAPACITY, "--capacity-m", self.capacity_m),
            (USUAL_RESTITUTION, "--restitution", Some(self.restitution)),
        ])
    }

    fn oscillator(&self) -> Result<Oscillator, LaboratoryError> {
        let post_uplift = match (self.capacity_m, self.post_uplift_stiffness_per_s2) {
            (Some(_), Some(_)) => {
                return Err(JobError::Usage(
                    "a capacity needs a negative stiffness after uplift, but a positive one is given: give one of them"
                        .to_owned(),
                )
                .into());
            }
            (Some(capacity_m), None) => PostUplift::Negative { capacity_m },
            (None, Some(stiffness_per_s2)) => PostUplift::Positive { stiffness_per_s2 },
            (None, None) => PostUplift::Zero,
        };
        Ok(Oscillator::new(
            self.strength,
            self.shaking.gravity_m_s2,
            self.uplift_displacement_m,
            self.restitution,
            post_uplift,
        )?)
    }

    fn free_vibration(&self) -> FreeVibration {
        let seconds = self.shaking.free_vibration_s;
        if seconds > 0.0 { FreeVibration::Seconds(seconds) } else { FreeVibration::None }
    }
}

/// What became of the oscillator.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseReport {
    /// The record.
    #[serde(flatten)]
    pub shaken_by: ShakingRecord,
    /// Strength η.
    pub strength: f64,
    /// Displacement at uplift, m.
    pub uplift_displacement_m: f64,
    /// Displacement where the restoring force vanishes, m.
    pub capacity_m: Option<f64>,
    /// Positive stiffness after uplift over the mass, 1/s².
    pub post_uplift_stiffness_per_s2: Option<f64>,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Largest displacement, m; infinite, as JSON null, where the system overturned.
    pub peak_displacement_m: f64,
    /// When, s from the start of the record; none where it overturned.
    pub time_of_peak_s: Option<f64>,
    /// Impacts.
    pub impacts: u32,
    /// Uplifts.
    pub uplifts: u32,
    /// Whether the system overturned.
    pub overturned: bool,
    /// Displacement at the end, m.
    pub end_displacement_m: f64,
    /// Velocity at the end, m/s.
    pub end_velocity_m_s: f64,
    /// What to know before using the numbers.
    pub alarms: Vec<Alarm>,
    /// When the system overturned, s.
    #[serde(skip)]
    pub time_of_overturning_s: Option<f64>,
    /// The time history, where it was asked for.
    #[serde(skip)]
    pub history: Option<ResponseHistory>,
    /// The file that it was written to.
    #[serde(skip)]
    pub history_file: Option<PathBuf>,
}

/// Shakes one oscillator with one record.
///
/// # Errors
/// An oscillator that cannot be, a record that cannot be read, a history that cannot be written.
pub fn response(options: &ResponseOptions) -> Result<ResponseReport, LaboratoryError> {
    options.check()?;
    let oscillator = options.oscillator()?;
    let after = options.free_vibration();
    let shaking = &options.shaking;
    let motion = shaking.read()?;
    let excitation = Excitation::new(motion.dt_s(), motion.acceleration_m_s2())?.scaled(shaking.scale)?;
    oscillator
        .check_run_length(motion.duration_s() + shaking.free_vibration_s, motion.dt_s())
        .map_err(|error| JobError::Usage(error.to_string()))?;
    let (result, history) = if shaking.wants_history() {
        let (result, history) = respond_with_history(&oscillator, &excitation, after);
        (result, Some(ResponseHistory::from_history(&history, &excitation)))
    } else {
        (respond(&oscillator, &excitation, after), None)
    };
    if !(result.overturned || result.peak_displacement_m.is_finite()) {
        return Err(LaboratoryError::from(IdaError::NotFinite {
            motion: shaking.record.display().to_string(),
            scale: shaking.scale,
            system: System::Oscillator(oscillator).to_string(),
            displacement_m: result.peak_displacement_m,
        }));
    }
    let report = ResponseReport {
        shaken_by: shaking.told(&motion),
        strength: options.strength,
        uplift_displacement_m: options.uplift_displacement_m,
        capacity_m: options.capacity_m,
        post_uplift_stiffness_per_s2: options.post_uplift_stiffness_per_s2,
        restitution: options.restitution,
        peak_displacement_m: result.peak_displacement_m,
        time_of_peak_s: (!result.overturned).then_some(result.time_of_peak_s),
        impacts: result.impacts,
        uplifts: result.uplifts,
        overturned: result.overturned,
        end_displacement_m: result.end_displacement_m,
        end_velocity_m_s: result.end_velocity_m_s,
        alarms: options.alarms(),
        time_of_overturning_s: result.overturned.then_some(result.time_of_peak_s),
        history,
        history_file: shaking.history_file.clone(),
    };
    if let (Some(file), Some(history)) = (&shaking.history_file, &report.history) {
        history.write(file, &report)?;
    }
    Ok(report)
}
