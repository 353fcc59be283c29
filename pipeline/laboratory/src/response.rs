//! One record through one oscillator or one rigid block, or a pair through a frame: peaks, impacts and, where asked
//! for, the time history.

mod block;
mod frame;
mod frame_history;
mod history;
mod options;
mod shaking;

use std::path::PathBuf;

use serde::Serialize;
use uplift_ida::{IdaError, System};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, PostUplift, respond, respond_with_history};
use uplift_plausible::{
    CAPACITY, POST_UPLIFT_STIFFNESS, RESTITUTION, STRENGTH, UPLIFT_DISPLACEMENT, USUAL_CAPACITY, USUAL_RESTITUTION,
    USUAL_STRENGTH, USUAL_UPLIFT_DISPLACEMENT,
};

use block::block_response;
pub use block::{BlockHistory, BlockResponseReport};
use frame::frame_response;
pub use frame::{FrameResponseReport, FrameRun, ShakenComponent};
pub use frame_history::{FrameHistory, FrameHistoryRow};
pub use history::{HistoryRow, ResponseHistory};
pub use options::{BlockOptions, FrameOptions, ResponseOptions};
pub use shaking::ShakingRecord;

use crate::error::LaboratoryError;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;

/// Default restitution of an oscillator, as in studies.
const OSCILLATOR_RESTITUTION: f64 = 0.95;

/// What became of the system that was shaken.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Response {
    /// An oscillator.
    Oscillator(ResponseReport),
    /// A rigid block.
    Block(BlockResponseReport),
    /// A rocking frame.
    Frame(FrameResponseReport),
}

/// Shakes one system: the frame where a structure is given, the oscillator where a strength is, else the block.
///
/// # Errors
/// Numbers that no system, record or person means; a system that cannot be; a structure without columns, or with
/// columns of rectangular section that are to wobble; a frame without a horizontal component; records that cannot be
/// read; a history that would replace something else or cannot be written; motions beyond the model, as
/// `uplift_frame::FrameError` has them.
pub fn response(options: &ResponseOptions) -> Result<Response, LaboratoryError> {
    if let Some(structure) = &options.frame.structure {
        return Ok(Response::Frame(frame_response(structure, options)?));
    }
    if options.channel.len() > 1 {
        let reason = "--channel has several numbers: one record has one component";
        return Err(JobError::Usage(reason.to_owned()).into());
    }
    Ok(match options.strength {
        Some(strength) => Response::Oscillator(oscillator_response(strength, options)?),
        None => Response::Block(block_response(options)?),
    })
}

impl ResponseOptions {
    /// The oscillator of a `strength`, its numbers plausible, and what is unlikely of them: mistakes of unit mostly.
    fn oscillator(&self, strength: f64) -> Result<(Oscillator, Vec<Alarm>), LaboratoryError> {
        let restitution = self.restitution.unwrap_or(OSCILLATOR_RESTITUTION);
        self.check(&[
            (STRENGTH, "strength", Some(strength)),
            (UPLIFT_DISPLACEMENT, "uplift_displacement_m", Some(self.uplift_displacement_m)),
            (CAPACITY, "capacity_m", self.capacity_m),
            (POST_UPLIFT_STIFFNESS, "post_uplift_stiffness_per_s2", self.post_uplift_stiffness_per_s2),
            (RESTITUTION, "restitution", Some(restitution)),
        ])?;
        let alarms = self.alarms(&[
            (USUAL_STRENGTH, "--strength", Some(strength)),
            (USUAL_UPLIFT_DISPLACEMENT, "--uplift-displacement-m", Some(self.uplift_displacement_m)),
            (USUAL_CAPACITY, "--capacity-m", self.capacity_m),
            (USUAL_RESTITUTION, "--restitution", Some(restitution)),
        ]);
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
        let oscillator =
            Oscillator::new(strength, self.gravity_m_s2, self.uplift_displacement_m, restitution, post_uplift)?;
        Ok((oscillator, alarms))
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
fn oscillator_response(strength: f64, options: &ResponseOptions) -> Result<ResponseReport, LaboratoryError> {
    let (oscillator, alarms) = options.oscillator(strength)?;
    let free_s = options.free_vibration_s;
    let after = if free_s > 0.0 { FreeVibration::Seconds(free_s) } else { FreeVibration::None };
    let (motion, record) = options.read()?;
    let excitation = Excitation::new(motion.dt_s(), motion.acceleration_m_s2())?.scaled(options.scale)?;
    oscillator
        .check_run_length(motion.duration_s() + free_s, motion.dt_s())
        .map_err(|error| JobError::Usage(error.to_string()))?;
    let (result, history) = if options.wants_history() {
        let (result, history) = respond_with_history(&oscillator, &excitation, after);
        (result, Some(ResponseHistory::from_history(&history, &excitation)))
    } else {
        (respond(&oscillator, &excitation, after), None)
    };
    if !(result.overturned || result.peak_displacement_m.is_finite()) {
        return Err(LaboratoryError::from(IdaError::NotFinite {
            motion: record.display().to_string(),
            scale: options.scale,
            system: System::Oscillator(oscillator).to_string(),
            displacement_m: result.peak_displacement_m,
        }));
    }
    let shaken_by = options.told(record, &motion);
    let report = ResponseReport {
        alarms: [alarms, shaken_by.alarms()].concat(),
        shaken_by,
        strength,
        uplift_displacement_m: options.uplift_displacement_m,
        capacity_m: options.capacity_m,
        post_uplift_stiffness_per_s2: options.post_uplift_stiffness_per_s2,
        restitution: oscillator.restitution(),
        peak_displacement_m: result.peak_displacement_m,
        time_of_peak_s: (!result.overturned).then_some(result.time_of_peak_s),
        impacts: result.impacts,
        uplifts: result.uplifts,
        overturned: result.overturned,
        end_displacement_m: result.end_displacement_m,
        end_velocity_m_s: result.end_velocity_m_s,
        time_of_overturning_s: result.overturned.then_some(result.time_of_peak_s),
        history,
        history_file: options.history_file.clone(),
    };
    if let (Some(file), Some(history)) = (&options.history_file, &report.history) {
        let what = format!("strength {strength}, uplift displacement {} m", report.uplift_displacement_m);
        history.write(file, &report.shaken_by.line(&what))?;
    }
    Ok(report)
}
