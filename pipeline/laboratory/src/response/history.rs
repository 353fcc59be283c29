//! The time history of a response, row by row, and the table of it.

use std::path::Path;

use uplift_job::table::{ColumnsOf, write_table};
use uplift_oscillator::{Event, EventKind, Excitation, History};

use crate::error::LaboratoryError;

/// The motion of the ground and what it did to the oscillator.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResponseHistory {
    /// Sampling interval of the record, s.
    pub dt_s: f64,
    /// Ground acceleration at every sample of the record, scaled, m/s².
    pub ground_acceleration_m_s2: Vec<f64>,
    /// Samples and events in the order of time; an impact has two rows, before and after.
    pub rows: Vec<HistoryRow>,
}

/// An instant of a time history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryRow {
    /// Time from the start of the record, s.
    pub time_s: f64,
    /// Displacement relative to the ground, m.
    pub displacement_m: f64,
    /// Velocity relative to the ground, m/s.
    pub velocity_m_s: f64,
    /// Acceleration of the ground, m/s².
    pub ground_acceleration_m_s2: f64,
    /// `uplift`, `before impact` or `after impact`; none of a sample.
    pub event: Option<&'static str>,
}

impl HistoryRow {
    /// What the table calls an uplift.
    pub const UPLIFT: &'static str = "uplift";
    /// What the table calls the instant before an impact.
    pub const BEFORE_IMPACT: &'static str = "before impact";
    /// What the table calls the instant after an impact.
    pub const AFTER_IMPACT: &'static str = "after impact";
}

impl ResponseHistory {
    pub(super) fn from_history(history: &History, excitation: &Excitation<'_>) -> Self {
        let mut rows = Vec::with_capacity(history.samples.len() + 2 * history.events.len());
        let mut events = history.events.iter().peekable();
        for sample in &history.samples {
            while let Some(event) = events.next_if(|event| event.time_s <= sample.time_s) {
                rows.extend(rows_of(event, excitation));
            }
            rows.push(HistoryRow {
                time_s: sample.time_s,
                displacement_m: sample.displacement_m,
                velocity_m_s: sample.velocity_m_s,
                ground_acceleration_m_s2: excitation_at(excitation, sample.time_s),
                event: None,
            });
        }
        let scale = excitation.scale();
        Self {
            dt_s: excitation.dt_s(),
            ground_acceleration_m_s2: excitation.acceleration_m_s2().iter().map(|a| scale * a).collect(),
            rows,
        }
    }

    /// Writes it as a table; `line` says what was shaken by what.
    pub(super) fn write(&self, file: &Path, line: &str) -> Result<(), LaboratoryError> {
        let columns = ColumnsOf::new(&self.rows)
            .with("time_s", |row| row.time_s)
            .with("displacement_m", |row| row.displacement_m)
            .with("velocity_m_s", |row| row.velocity_m_s)
            .with("ground_acceleration_m_s2", |row| row.ground_acceleration_m_s2)
            .with("event", |row| row.event);
        Ok(write_table(file, line, columns.build())?)
    }
}

fn rows_of(event: &Event, excitation: &Excitation<'_>) -> Vec<HistoryRow> {
    let row = |velocity_m_s: f64, word: &'static str| HistoryRow {
        time_s: event.time_s,
        displacement_m: event.displacement_m,
        velocity_m_s,
        ground_acceleration_m_s2: excitation_at(excitation, event.time_s),
        event: Some(word),
    };
    match event.kind {
        EventKind::Uplift => vec![row(event.velocity_after_m_s, HistoryRow::UPLIFT)],
        EventKind::Impact => vec![
            row(event.velocity_before_m_s, HistoryRow::BEFORE_IMPACT),
            row(event.velocity_after_m_s, HistoryRow::AFTER_IMPACT),
        ],
    }
}

/// The scaled acceleration of the ground, linear between samples, zero after the record.
fn excitation_at(excitation: &Excitation<'_>, time_s: f64) -> f64 {
    acceleration_at(excitation.acceleration_m_s2(), excitation.scale(), excitation.dt_s(), time_s)
}

/// `scale` times the value of `samples`, `dt_s` apart, at `time_s`: linear between them, zero after the last.
pub(super) fn acceleration_at(samples: &[f64], scale: f64, dt_s: f64, time_s: f64) -> f64 {
    let duration_s = (samples.len() - 1) as f64 * dt_s;
    let position = time_s / dt_s;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the record")]
    let index = (position.round() as usize).min(samples.len() - 1);
    if time_s > duration_s * (1.0 + 1e-12) {
        0.0
    } else if (position - index as f64).abs() < 1e-6 {
        scale * samples[index]
    } else {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the record")]
        let before = (position as usize).min(samples.len() - 2);
        let part = position - before as f64;
        scale * (samples[before] + part * (samples[before + 1] - samples[before]))
    }
}
