//! Peaks of a frame and its proxies as CSV, and what they come to at each level.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_fragility::quantile;
use uplift_ida::{PLANAR_FRAME, WOBBLING_FRAME};
use uplift_inputs::RecordSet;
use uplift_job::outputs;
use uplift_job::table::{ColumnsOf, write_table};

use super::analysis::Demands;
use super::report::FrameRiskReport;
use crate::error::DesignError;

/// A column that only the table of peaks has.
pub(super) const PEAKS_COLUMN: &str = "planar_frame_m";
/// A column that only the table of levels has.
pub(super) const LEVELS_COLUMN: &str = "u84_m";

/// The table of levels beside that of the peaks.
pub(super) fn levels_path(peaks: &Path) -> PathBuf {
    peaks.with_extension("levels.csv")
}

/// Writes the peak of every record, level and model to `path`, and what they come to at each level beside it.
pub(super) fn write_tables(
    path: &Path,
    report: &FrameRiskReport,
    (set, levels, demands): (&RecordSet, &[f64], &Demands),
) -> Result<(), DesignError> {
    let line = outputs::marked(format_args!(
        "frame {} ({}); {}; result {}; records: {}",
        report.structure.name,
        report.structure.kind,
        report.notes.first().map_or("", String::as_str),
        report.source.result.display(),
        report.source.record_set
    ));
    write_table(path, &line, peaks(report, set, levels, demands))?;
    Ok(write_table(&levels_path(path), &line, by_level(report, set.records.len(), levels, demands))?)
}

/// A row a record and level; oscillators in the displacement of the deck.
fn peaks(report: &FrameRiskReport, set: &RecordSet, levels: &[f64], demands: &Demands) -> Vec<Column> {
    let cells = set.records.iter().flat_map(|record| levels.iter().map(move |&level| (record, level)));
    let factor = report.structure.participation;
    let of_deck = |peaks_m: &[f64]| peaks_m.iter().map(|peak_m| factor * peak_m).collect::<Vec<f64>>();
    let mut columns = ColumnsOf::new(cells)
        .with("record", |(record, _)| record.id.as_str())
        .with("im", |_| report.im)
        .with("unit", |_| report.unit)
        .with("level", |(_, level)| level)
        .build();
    columns.extend(demands.wobbling_m.as_ref().map(|peaks_m| Column::new("wobbling_frame_m".into(), peaks_m)));
    columns.extend([
        Column::new(PEAKS_COLUMN.into(), &demands.planar_m),
        Column::new("oscillator_m".into(), of_deck(&demands.oscillator_m)),
        Column::new("zero_stiffness_m".into(), of_deck(&demands.zero_stiffness_m)),
    ]);
    columns
}

/// A row a model and level: 16, 50 and 84 % of the peaks, and how many overturn.
fn by_level(report: &FrameRiskReport, records: usize, levels: &[f64], demands: &Demands) -> Vec<Column> {
    let factor = report.structure.participation;
    let wobbling = demands.wobbling_m.as_ref().map(|peaks_m| (WOBBLING_FRAME, peaks_m, 1.0));
    let planar = (PLANAR_FRAME, &demands.planar_m, 1.0);
    let oscillator = ("equivalent oscillator", &demands.oscillator_m, factor);
    let rows = wobbling.into_iter().chain([planar, oscillator]).flat_map(|(name, peaks_m, factor)| {
        levels.iter().enumerate().map(move |(place, &level)| {
            let of_level = peaks_m.iter().skip(place).step_by(levels.len());
            let mut stripe: Vec<f64> = of_level.map(|peak_m| factor * peak_m).collect();
            stripe.sort_by(f64::total_cmp);
            let overturned = stripe.iter().filter(|peak_m| peak_m.is_infinite()).count() as u64;
            (name, level, [0.16, 0.5, 0.84].map(|probability| quantile(&stripe, probability)), overturned)
        })
    });
    ColumnsOf::new(rows)
        .with("im", |_| report.im)
        .with("unit", |_| report.unit)
        .with("model", |(name, ..)| name)
        .with("level", |(_, level, ..)| level)
        .with("u16_m", |(.., [u16_m, ..], _)| u16_m)
        .with("u50_m", |(.., [_, u50_m, _], _)| u50_m)
        .with(LEVELS_COLUMN, |(.., [.., u84_m], _)| u84_m)
        .with("overturned", |(.., overturned)| overturned)
        .with("records", |_| records as u64)
        .build()
}
