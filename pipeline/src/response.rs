//! One record through one oscillator: its peak, its impacts and, where asked for, its time history.

mod history;

use std::path::PathBuf;

use serde::Serialize;
use uplift_ida::{IdaError, System};
use uplift_motion::{AccelerationUnit, Accelerogram, ReadOptions, STANDARD_GRAVITY_M_S2, read_path};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, PostUplift, respond, respond_with_history};
use uplift_plausible::{
    CAPACITY, FREE_VIBRATION, GRAVITY, POST_UPLIFT_STIFFNESS, RESTITUTION, SCALE, STRENGTH, TIME_STEP,
    UPLIFT_DISPLACEMENT,
};

pub use history::{HistoryRow, ResponseHistory};

use crate::error::UpliftError;
use crate::outputs::{self, Output, OutputKind};

/// Which oscillator is shaken, and by what.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseOptions {
    /// The record: a file with one component, or with several of which `channel` is taken.
    pub record: PathBuf,
    /// Which component of a file with several, counted from 1.
    pub channel: Option<usize>,
    /// Sampling interval of a file that does not say it, s.
    pub dt_s: Option<f64>,
    /// Unit of a file that does not say it.
    pub unit: Option<AccelerationUnit>,
    /// Factor on the record.
    pub scale: f64,
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
    /// Acceleration of gravity, m/s².
    pub gravity_m_s2: f64,
    /// How long the free vibration after the record is followed, s.
    pub free_vibration_s: f64,
    /// Whether the report holds the time history.
    pub history: bool,
    /// A CSV file for the time history.
    pub history_file: Option<PathBuf>,
    /// Whether whatever is at the place of that file gives way.
    pub force: bool,
}

impl ResponseOptions {
    /// `record`, unscaled, through the system of zero stiffness after uplift that has this `strength` and else the
    /// values of the studies; no history.
    pub fn new(record: impl Into<PathBuf>, strength: f64) -> Self {
        Self {
            record: record.into(),
            channel: None,
            dt_s: None,
            unit: None,
            scale: 1.0,
            strength,
            uplift_displacement_m: 0.0005,
            capacity_m: None,
            post_uplift_stiffness_per_s2: None,
            restitution: 0.95,
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            free_vibration_s: 0.0,
            history: false,
            history_file: None,
            force: false,
        }
    }

    /// Refuses numbers that no system, record or person means; all of them at once.
    fn check(&self) -> Result<(), UpliftError> {
        let given = [
            (STRENGTH, "strength", Some(self.strength)),
            (SCALE, "scale", Some(self.scale.abs())),
            (UPLIFT_DISPLACEMENT, "uplift_displacement_m", Some(self.uplift_displacement_m)),
            (CAPACITY, "capacity_m", self.capacity_m),
            (POST_UPLIFT_STIFFNESS, "post_uplift_stiffness_per_s2", self.post_uplift_stiffness_per_s2),
            (RESTITUTION, "restitution", Some(self.restitution)),
            (GRAVITY, "gravity_m_s2", Some(self.gravity_m_s2)),
            (TIME_STEP, "dt_s", self.dt_s),
            (FREE_VIBRATION, "free_vibration_s", Some(self.free_vibration_s)),
        ];
        let mistakes: Vec<_> =
            given.into_iter().filter_map(|(range, name, value)| range.check(name, value?).err()).collect();
        if mistakes.is_empty() { Ok(()) } else { Err(UpliftError::Implausible(mistakes)) }
    }

    fn oscillator(&self) -> Result<Oscillator, UpliftError> {
        let post_uplift = match (self.capacity_m, self.post_uplift_stiffness_per_s2) {
            (Some(_), Some(_)) => {
                return Err(UpliftError::Usage(
                    "a capacity is of negative stiffness after uplift, and a positive one is given too: give one of \
                     them"
                        .to_owned(),
                ));
            }
            (Some(capacity_m), None) => PostUplift::Negative { capacity_m },
            (None, Some(stiffness_per_s2)) => PostUplift::Positive { stiffness_per_s2 },
            (None, None) => PostUplift::Zero,
        };
        Ok(Oscillator::new(
            self.strength,
            self.gravity_m_s2,
            self.uplift_displacement_m,
            self.restitution,
            post_uplift,
        )?)
    }

    fn free_vibration(&self) -> FreeVibration {
        if self.free_vibration_s > 0.0 { FreeVibration::Seconds(self.free_vibration_s) } else { FreeVibration::None }
    }

    fn read(&self) -> Result<Accelerogram, UpliftError> {
        let options = ReadOptions {
            dt_s: self.dt_s,
            unit: self.unit,
            gravity_m_s2: self.gravity_m_s2,
            channel: self.channel,
            format: None,
        };
        Ok(read_path(&self.record, &options)?)
    }
}

/// What became of the oscillator.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseReport {
    /// The record's file.
    pub record: PathBuf,
    /// Its samples.
    pub samples: usize,
    /// Its sampling interval, s.
    pub dt_s: f64,
    /// Factor on it.
    pub scale: f64,
    /// Peak ground acceleration of the scaled record, g.
    pub pga_g: f64,
    /// Peak ground velocity of the scaled record, cm/s.
    pub pgv_cm_s: f64,
    /// Peak ground displacement of the scaled record, m.
    pub pgd_m: f64,
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
    /// Acceleration of gravity, m/s².
    pub gravity_m_s2: f64,
    /// How long the free vibration was followed, s.
    pub free_vibration_s: f64,
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
pub fn response(options: &ResponseOptions) -> Result<ResponseReport, UpliftError> {
    options.check()?;
    let oscillator = options.oscillator()?;
    let after = options.free_vibration();
    if let Some(file) = &options.history_file {
        outputs::check(&[Output::new(file, OutputKind::Table("time_s"))], &[&options.record], options.force)?;
    }
    let motion = options.read()?;
    let excitation = Excitation::new(motion.dt_s(), motion.acceleration_m_s2())?.scaled(options.scale)?;
    refuse_endless(&oscillator, &motion, options.free_vibration_s)?;
    let (result, history) = if options.history || options.history_file.is_some() {
        let (result, history) = respond_with_history(&oscillator, &excitation, after);
        (result, Some(ResponseHistory::of(&history, &excitation)))
    } else {
        (respond(&oscillator, &excitation, after), None)
    };
    if !(result.overturned || result.peak_displacement_m.is_finite()) {
        return Err(UpliftError::from(IdaError::NotFinite {
            motion: options.record.display().to_string(),
            scale: options.scale,
            system: System::Oscillator(oscillator).to_string(),
            displacement_m: result.peak_displacement_m,
        }));
    }
    let scale = options.scale.abs();
    let report = ResponseReport {
        record: options.record.clone(),
        samples: motion.len(),
        dt_s: motion.dt_s(),
        scale: options.scale,
        pga_g: scale * motion.pga_m_s2() / options.gravity_m_s2,
        pgv_cm_s: scale * motion.pgv_m_s() * 100.0,
        pgd_m: scale * motion.pgd_m(),
        strength: options.strength,
        uplift_displacement_m: options.uplift_displacement_m,
        capacity_m: options.capacity_m,
        post_uplift_stiffness_per_s2: options.post_uplift_stiffness_per_s2,
        restitution: options.restitution,
        gravity_m_s2: options.gravity_m_s2,
        free_vibration_s: options.free_vibration_s,
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
        history.write(file, &report)?;
    }
    Ok(report)
}

/// Steps of a run, at most: some seconds, and a time history of a gigabyte.
const MOST_STEPS: f64 = 1e7;

/// Refuses a motion of more steps than that: its samples, and the half cycles of the stiffest branch.
fn refuse_endless(oscillator: &Oscillator, motion: &Accelerogram, free_s: f64) -> Result<(), UpliftError> {
    let duration_s = motion.duration_s() + free_s;
    let half_cycles = oscillator.highest_frequency_rad_s() * duration_s / std::f64::consts::PI;
    let steps = duration_s / motion.dt_s() + half_cycles;
    if steps <= MOST_STEPS {
        return Ok(());
    }
    Err(UpliftError::Usage(format!(
        "{duration_s} s of motion are {steps:.1e} steps of {} s and half cycles of the oscillator: {MOST_STEPS:e} are \
         computed at most; follow the free vibration for a shorter time, or give a softer system",
        motion.dt_s()
    )))
}
