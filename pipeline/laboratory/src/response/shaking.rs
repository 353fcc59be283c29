//! What shakes a system, whichever it is: a record, its scale, and what is kept of the motion.

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_alarms::number_alarms;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_motion::{Accelerogram, ReadOptions, RecordFormat, read_record_file};
use uplift_plausible::{
    FREE_VIBRATION, GRAVITY, Range, SCALE, TIME_STEP, USUAL_GRAVITY, USUAL_RECORD_PGA, USUAL_RECORD_PGV,
};

use super::ResponseOptions;
use crate::error::LaboratoryError;

/// A number from outside: what it may be, its name, and the number where it is given.
pub(super) type Given = (Range, &'static str, Option<f64>);

impl ResponseOptions {
    /// Refuses numbers that no system, record or person means, the `system`'s among them; all of them at once.
    pub(super) fn check(&self, system: &[Given]) -> Result<(), LaboratoryError> {
        let shaking = [
            (SCALE, "scale", Some(self.scale)),
            (GRAVITY, "gravity_m_s2", Some(self.gravity_m_s2)),
            (TIME_STEP, "dt_s", self.dt_s),
            (FREE_VIBRATION, "free_vibration_s", Some(self.free_vibration_s)),
        ];
        let given = system.iter().chain(&shaking);
        let mistakes: Vec<_> = given.filter_map(|(range, name, value)| range.check(name, (*value)?).err()).collect();
        if mistakes.is_empty() { Ok(()) } else { Err(JobError::Implausible(mistakes).into()) }
    }

    /// What is unlikely of the numbers that are given, the `system`'s among them.
    pub(super) fn alarms(&self, system: &[Given]) -> Vec<Alarm> {
        let gravity = (USUAL_GRAVITY, "--gravity-m-s2", Some(self.gravity_m_s2));
        number_alarms("response", &[system, &[gravity]].concat())
    }

    /// Whether the motion is to be kept.
    pub(super) fn wants_history(&self) -> bool {
        self.history || self.history_file.is_some()
    }

    /// Refuses a place for the history where something else is; its table has this `column`.
    pub(super) fn check_history(&self, column: &'static str) -> Result<(), LaboratoryError> {
        let Some(file) = &self.history_file else { return Ok(()) };
        Ok(outputs::check(&[Output::new(file, OutputKind::Table(column))], &self.inputs(), self.force)?)
    }

    /// The one record that shakes an oscillator or a block, with its file; refused are a place for the history where
    /// something else is, and a time step or unit for a file that says its own.
    pub(super) fn read(&self) -> Result<(Accelerogram, &Path), LaboratoryError> {
        let missing = || JobError::Usage("give a record file".to_owned());
        let record = self.record.as_deref().ok_or_else(missing)?;
        self.check_history("ground_acceleration_m_s2")?;
        let (motion, format) = self.read_told(record, self.channel.first().copied())?;
        self.refuse_unused(&[(record, format)])?;
        Ok((motion, record))
    }

    /// Refuses a time step or unit that none of the files takes, since all say their own.
    pub(super) fn refuse_unused(&self, files: &[(&Path, RecordFormat)]) -> Result<(), LaboratoryError> {
        let given: Vec<&str> = [("--dt-s", self.dt_s.is_some()), ("--unit", self.unit.is_some())]
            .into_iter()
            .filter_map(|(option, is_given)| is_given.then_some(option))
            .collect();
        if given.is_empty() || files.iter().any(|(_, format)| *format == RecordFormat::Columns) {
            return Ok(());
        }
        let told = |(file, format): &(&Path, RecordFormat)| format!("{} ({format})", file.display());
        let files: Vec<String> = files.iter().map(told).collect();
        Err(JobError::Usage(format!(
            "{} of a record that states its own, {}: leave it out, or write the values into a text file if the header \
             is wrong",
            given.join(" and "),
            files.join(", ")
        ))
        .into())
    }

    /// A record with the layout of its file.
    pub(super) fn read_told(
        &self,
        record: &Path,
        channel: Option<usize>,
    ) -> Result<(Accelerogram, RecordFormat), LaboratoryError> {
        let options =
            ReadOptions { dt_s: self.dt_s, unit: self.unit, gravity_m_s2: self.gravity_m_s2, channel, format: None };
        let file = read_record_file(record, &options)?;
        let format = file.format;
        Ok((file.component(&record.display().to_string(), channel)?.accelerogram, format))
    }

    /// What is reported about `motion`, the `record` that was read.
    pub(super) fn told(&self, record: &Path, motion: &Accelerogram) -> ShakingRecord {
        let scale = self.scale.abs();
        ShakingRecord {
            record: record.to_owned(),
            samples: motion.len(),
            dt_s: motion.dt_s(),
            scale: self.scale,
            pga_g: scale * motion.pga_m_s2() / self.gravity_m_s2,
            pgv_cm_s: scale * motion.pgv_m_s() * 100.0,
            pgd_m: scale * motion.pgd_m(),
            gravity_m_s2: self.gravity_m_s2,
            free_vibration_s: self.free_vibration_s,
        }
    }
}

/// The record that shook a system.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShakingRecord {
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
    /// Acceleration of gravity, m/s².
    pub gravity_m_s2: f64,
    /// How long the free vibration was followed, s.
    pub free_vibration_s: f64,
}

impl ShakingRecord {
    /// What is unlikely of it: a mistake of unit or scale mostly.
    pub(super) fn alarms(&self) -> Vec<Alarm> {
        let rounded = |value: f64| format!("{value:.3e}").parse().ok();
        let peaks = [
            (USUAL_RECORD_PGA, "PGA of the record", rounded(self.pga_g)),
            (USUAL_RECORD_PGV, "PGV of the record", rounded(self.pgv_cm_s)),
        ];
        number_alarms("response", &peaks)
    }

    /// What stands beside the table of a history of `system`.
    pub(super) fn line(&self, system: &str) -> String {
        format!("{}; record {}, scale {}, {system}", outputs::mark(), self.record.display(), self.scale)
    }
}
