//! One record through one rigid rocking block: its peak rotation, its impacts and, where asked for, its time history.

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_block::{
    FreeRocking, History, HistoryRow, Moment, Overturning, RockingBlock, respond, respond_with_history,
};
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_motion::Accelerogram;
use uplift_plausible::{LENGTH, RESTITUTION, SIZE, USUAL_LENGTH, USUAL_RESTITUTION, USUAL_WIDTH};

use super::{BlockOptions, ResponseOptions, ShakingRecord};
use crate::error::LaboratoryError;

impl ResponseOptions {
    /// The block, its numbers plausible.
    fn block(&self) -> Result<RockingBlock, LaboratoryError> {
        let &BlockOptions { width_m, height_m, size_m, slenderness_rad, .. } = &self.block;
        self.check(&[
            (LENGTH, "width_m", width_m),
            (LENGTH, "height_m", height_m),
            (SIZE, "size_m", size_m),
            (RESTITUTION, "restitution", self.restitution),
        ])?;
        let block = match (slenderness_rad, width_m, height_m, size_m) {
            (None, Some(width_m), Some(height_m), None) => {
                RockingBlock::from_half_sides(0.5 * width_m, 0.5 * height_m)?
            }
            (Some(slenderness_rad), None, Some(height_m), None) => {
                RockingBlock::from_height(height_m, slenderness_rad)?
            }
            (Some(slenderness_rad), Some(width_m), None, None) => {
                RockingBlock::new(0.5 * width_m / slenderness_rad.sin(), slenderness_rad)?
            }
            (Some(slenderness_rad), None, None, Some(size_m)) => RockingBlock::new(size_m, slenderness_rad)?,
            _ => {
                return Err(JobError::Usage(
                    "a block needs two numbers: its width and height, or its slenderness and one of width, height and \
                     size (half the diagonal)"
                        .to_owned(),
                )
                .into());
            }
        };
        let block = block.with_gravity(self.gravity_m_s2)?;
        Ok(self.restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution))?)
    }

    /// The numbers that can be but are unlikely, mistakes of unit mostly.
    fn block_alarms(&self) -> Vec<Alarm> {
        self.alarms(&[
            (USUAL_WIDTH, "--width-m", self.block.width_m),
            (USUAL_LENGTH, "--height-m", self.block.height_m),
            (USUAL_LENGTH, "--size-m", self.block.size_m),
            (USUAL_RESTITUTION, "--restitution", self.restitution),
        ])
    }

    fn free_rocking(&self) -> FreeRocking {
        let duration_s = self.free_vibration_s;
        if duration_s > 0.0 { FreeRocking::Lasting { duration_s } } else { FreeRocking::FirstPeak }
    }
}

/// What became of the block.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BlockResponseReport {
    /// The record.
    #[serde(flatten)]
    pub shaken_by: ShakingRecord,
    /// Width 2b, m.
    pub width_m: f64,
    /// Height 2h, m.
    pub height_m: f64,
    /// Size R, half the diagonal, m.
    pub size_m: f64,
    /// Slenderness α, rad.
    pub slenderness_rad: f64,
    /// Angular velocity after an impact over the one before.
    pub restitution: f64,
    /// Whether that is Housner's (Eq. 2.3).
    pub restitution_is_housners: bool,
    /// Frequency parameter p = √(3g/(4R)), rad/s.
    pub frequency_parameter_rad_s: f64,
    /// Ground acceleration beyond which the block uplifts, tan α, g.
    pub uplift_acceleration_g: f64,
    /// Largest rotation, rad; infinite, as JSON null, where the block overturned.
    pub peak_rotation_rad: f64,
    /// Largest displacement of the top, m (Eq. 2.10); infinite, as JSON null, where the block overturned.
    pub peak_displacement_m: f64,
    /// When, s from the start of the record; none where it overturned or never uplifted.
    pub time_of_peak_s: Option<f64>,
    /// When the block first uplifted, s; none if it never did.
    pub time_of_uplift_s: Option<f64>,
    /// Impacts; of the infinitely many before a rest, those until it was certain.
    pub impacts: u64,
    /// Whether the block overturned.
    pub overturned: bool,
    /// When it overturned, s.
    pub time_of_overturning_s: Option<f64>,
    /// Whether a nearly elastic block that rebounded 100,000 times in a sample interval was put to rest.
    pub chatter_was_cut: bool,
    /// What to know before using the numbers.
    pub alarms: Vec<Alarm>,
    /// The time history, where it was asked for.
    #[serde(skip)]
    pub history: Option<BlockHistory>,
    /// The file that it was written to.
    #[serde(skip)]
    pub history_file: Option<PathBuf>,
}

/// The motion of the ground and what it did to the block.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockHistory {
    /// Sampling interval of the record, s.
    pub dt_s: f64,
    /// Ground acceleration at every sample of the record, scaled, m/s².
    pub ground_acceleration_m_s2: Vec<f64>,
    /// Samples and events in the order of time; an impact has two rows, before and after.
    pub rows: Vec<HistoryRow>,
    /// Displacement of the top at every row, m (Eq. 2.10).
    pub top_displacement_m: Vec<f64>,
}

/// Shakes one rigid rocking block with one record: Eq. 2.1 between impacts, Eq. 2.3 at them.
pub(super) fn block_response(options: &ResponseOptions) -> Result<BlockResponseReport, LaboratoryError> {
    let block = options.block()?;
    let (motion, record) = options.read()?;
    let ground = motion.scaled(options.scale)?;
    let free = options.free_rocking();
    let (result, history) = if options.wants_history() {
        let (result, history) = respond_with_history(&block, &ground, free)?;
        (result, Some(BlockHistory::from_history(history, &block, &ground)))
    } else {
        (respond(&block, &ground, free)?, None)
    };
    let overturned = result.overturning != Overturning::None;
    let shaken_by = options.told(record, &motion);
    let report = BlockResponseReport {
        alarms: [options.block_alarms(), shaken_by.alarms()].concat(),
        shaken_by,
        width_m: 2.0 * block.half_width_m(),
        height_m: 2.0 * block.half_height_m(),
        size_m: block.size_m(),
        slenderness_rad: block.slenderness_rad(),
        restitution: block.restitution(),
        restitution_is_housners: options.restitution.is_none(),
        frequency_parameter_rad_s: block.frequency_parameter_rad_s(),
        uplift_acceleration_g: block.slenderness_rad().tan(),
        peak_rotation_rad: result.rotation_rad,
        peak_displacement_m: result.displacement_m,
        time_of_peak_s: (!overturned && result.uplift_s.is_some()).then_some(result.time_s),
        time_of_uplift_s: result.uplift_s,
        impacts: result.impacts,
        overturned,
        time_of_overturning_s: overturned.then_some(result.time_s),
        chatter_was_cut: result.chatter_was_cut,
        history,
        history_file: options.history_file.clone(),
    };
    if let (Some(file), Some(history)) = (&options.history_file, &report.history) {
        history.write(file, &report)?;
    }
    Ok(report)
}

impl BlockHistory {
    fn from_history(history: History, block: &RockingBlock, ground: &Accelerogram) -> Self {
        Self {
            dt_s: ground.dt_s(),
            ground_acceleration_m_s2: ground.acceleration_m_s2().to_vec(),
            top_displacement_m: history.rows.iter().map(|row| block.top_displacement_m(row.rotation_rad)).collect(),
            rows: history.rows,
        }
    }

    fn write(&self, file: &Path, report: &BlockResponseReport) -> Result<(), LaboratoryError> {
        let line = report.shaken_by.line(&format!(
            "block of size {} m, slenderness {} rad, restitution {}",
            report.size_m, report.slenderness_rad, report.restitution
        ));
        let columns = ColumnsOf::new(self.rows.iter().zip(&self.top_displacement_m))
            .with("time_s", |(row, _)| row.time_s)
            .with("rotation_rad", |(row, _)| row.rotation_rad)
            .with("angular_velocity_rad_s", |(row, _)| row.velocity_rad_s)
            .with("top_displacement_m", |(_, &top_displacement_m)| top_displacement_m)
            .with("ground_acceleration_m_s2", |(row, _)| self.acceleration_at(row.time_s))
            .with("event", |(row, _)| word(row.moment));
        Ok(write_table(file, &line, columns.build())?)
    }

    /// The scaled acceleration of the ground, linear between samples, zero after the record.
    fn acceleration_at(&self, time_s: f64) -> f64 {
        super::history::acceleration_at(&self.ground_acceleration_m_s2, 1.0, self.dt_s, time_s)
    }
}

/// What the table calls a moment; nothing of a sample.
fn word(moment: Moment) -> Option<&'static str> {
    match moment {
        Moment::Sample => None,
        Moment::Uplift => Some(super::HistoryRow::UPLIFT),
        Moment::BeforeImpact => Some(super::HistoryRow::BEFORE_IMPACT),
        Moment::AfterImpact => Some(super::HistoryRow::AFTER_IMPACT),
        Moment::Rest => Some("rest"),
        Moment::Overturned => Some("overturned"),
    }
}
