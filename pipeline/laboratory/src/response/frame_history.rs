//! The motion of a frame in time, row by row, and the table of it.

use std::path::Path;

use uplift_frame::{History, HistoryRow, Moment, RockingFrame};
use uplift_job::table::{ColumnsOf, write_table};
use uplift_motion::Accelerogram;
use uplift_statics::Sections;

use super::history::acceleration_at;
use crate::error::LaboratoryError;

/// A motion of the ground and what it did to the frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameHistory {
    /// Samples and events in the order of time.
    pub rows: Vec<FrameHistoryRow>,
}

/// An instant of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameHistoryRow {
    /// Rotation, travel, restrainer and deck.
    pub state: HistoryRow,
    /// Ends of a column; none where it stands upright, its sections closed.
    pub sections: Option<Sections>,
    /// Base shear of the deck alone, `m_b |a|` (Eq. 6.10), N.
    pub base_shear_n: f64,
    /// Acceleration of the ground in x, y and upwards, m/s².
    pub ground_m_s2: [f64; 3],
}

impl FrameHistory {
    /// A column that the table of every frame has.
    pub(super) const COLUMN: &str = "deck_acceleration_x_m_s2";

    pub(super) fn from_history(frame: &RockingFrame, history: History, shaken: [Option<&Accelerogram>; 3]) -> Self {
        let row = |state: HistoryRow| {
            let ground_m_s2 = shaken.map(|motion| {
                motion
                    .map_or(0.0, |motion| acceleration_at(motion.acceleration_m_s2(), 1.0, motion.dt_s(), state.time_s))
            });
            let deck_m_s2 = state.deck_acceleration_x_m_s2.hypot(state.deck_acceleration_y_m_s2);
            FrameHistoryRow {
                sections: frame.sections(&state, ground_m_s2[2]),
                base_shear_n: frame.deck_mass_kg() * deck_m_s2,
                ground_m_s2,
                state,
            }
        };
        Self { rows: history.rows.into_iter().map(row).collect() }
    }
}

/// What the table calls a moment; nothing of a sample.
fn word(moment: Moment) -> Option<&'static str> {
    match moment {
        Moment::Sample => None,
        Moment::Uplift => Some(super::HistoryRow::UPLIFT),
        Moment::Impact => Some("impact"),
        Moment::Rest => Some("rest"),
        Moment::Overturned => Some("overturned"),
    }
}

/// Writes the histories of runs, each with the components that it is under, as one table; `line` says what was shaken
/// by what.
pub(super) fn write<'a>(
    file: &Path,
    line: &str,
    runs: impl Iterator<Item = (&'static str, &'a FrameHistory)>,
) -> Result<(), LaboratoryError> {
    let rows = runs.flat_map(|(under, history)| history.rows.iter().map(move |row| (under, row)));
    let section = |row: &FrameHistoryRow, value: fn(&Sections) -> f64| row.sections.as_ref().map(value);
    let columns = ColumnsOf::new(rows)
        .with("under", |(under, _)| under)
        .with("time_s", |(_, row)| row.state.time_s)
        .with("rotation_rad", |(_, row)| row.state.rotation_rad)
        .with("direction_rad", |(_, row)| row.state.direction_rad)
        .with("displacement_x_m", |(_, row)| row.state.displacement_x_m)
        .with("displacement_y_m", |(_, row)| row.state.displacement_y_m)
        .with("rise_m", |(_, row)| row.state.rise_m)
        .with("tendon_n", |(_, row)| row.state.tendon_n)
        .with("spring_m", |(_, row)| row.state.spring_m)
        .with("top_axial_n", |(_, row)| section(row, |of| of.top_axial_n))
        .with("top_shear_n", |(_, row)| section(row, |of| of.top_shear_n))
        .with("top_moment_n_m", |(_, row)| section(row, |of| of.top_moment_n_m))
        .with("base_axial_n", |(_, row)| section(row, |of| of.base_axial_n))
        .with("base_moment_n_m", |(_, row)| section(row, |of| of.base_moment_n_m))
        .with(FrameHistory::COLUMN, |(_, row)| row.state.deck_acceleration_x_m_s2)
        .with("deck_acceleration_y_m_s2", |(_, row)| row.state.deck_acceleration_y_m_s2)
        .with("deck_acceleration_z_m_s2", |(_, row)| row.state.deck_acceleration_z_m_s2)
        .with("base_shear_n", |(_, row)| row.base_shear_n)
        .with("ground_acceleration_x_m_s2", |(_, row)| row.ground_m_s2[0])
        .with("ground_acceleration_y_m_s2", |(_, row)| row.ground_m_s2[1])
        .with("ground_acceleration_z_m_s2", |(_, row)| row.ground_m_s2[2])
        .with("event", |(_, row)| word(row.state.moment));
    Ok(write_table(file, line, columns.build())?)
}
