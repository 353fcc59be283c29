//! Peaks of a frame and its proxies as CSV, and what they come to at each level.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_fragility::quantile;
use uplift_inputs::RecordSet;
use uplift_job::outputs;
use uplift_job::table::write_table;

use super::FrameRiskReport;
use super::analysis::Demands;
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
    let line = format!(
        "{}; frame {} ({}); {}; result {}; records: {}",
        outputs::mark(),
        report.structure.name,
        report.structure.kind,
        report.notes.first().map_or("", String::as_str),
        report.source.result.display(),
        report.source.record_set
    )
    .replace(['\n', '\r'], " ");
    write_table(path, &line, peaks(report, set, levels, demands))?;
    Ok(write_table(&levels_path(path), &line, by_level(report, set.records.len(), levels, demands))?)
}

/// A row a record and level; oscillators in the displacement of the deck.
fn peaks(report: &FrameRiskReport, set: &RecordSet, levels: &[f64], demands: &Demands) -> Vec<Column> {
    let cells = || set.records.iter().flat_map(|record| levels.iter().map(move |&level| (record, level)));
    let factor = report.structure.participation;
    let of_deck = |peaks_m: &[f64]| peaks_m.iter().map(|peak_m| factor * peak_m).collect::<Vec<f64>>();
    let mut columns = vec![
        Column::new("record".into(), cells().map(|(record, _)| record.id.as_str()).collect::<Vec<&str>>()),
        Column::new("im".into(), vec![report.im; set.records.len() * levels.len()]),
        Column::new("unit".into(), vec![report.unit; set.records.len() * levels.len()]),
        Column::new("level".into(), cells().map(|(_, level)| level).collect::<Vec<f64>>()),
    ];
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
    let wobbling = demands.wobbling_m.as_ref().map(|peaks_m| ("wobbling frame", peaks_m, 1.0));
    let planar = ("planar frame", &demands.planar_m, 1.0);
    let oscillator = ("equivalent oscillator", &demands.oscillator_m, factor);
    let (mut model, mut level, mut overturned) = (vec![], vec![], vec![]);
    let mut quantiles = [vec![], vec![], vec![]];
    for (name, peaks_m, factor) in wobbling.into_iter().chain([planar, oscillator]) {
        for (place, &at) in levels.iter().enumerate() {
            let mut stripe: Vec<f64> =
                peaks_m.iter().skip(place).step_by(levels.len()).map(|peak_m| factor * peak_m).collect();
            stripe.sort_by(f64::total_cmp);
            model.push(name);
            level.push(at);
            overturned.push(stripe.iter().filter(|peak_m| peak_m.is_infinite()).count() as u64);
            for (column, probability) in quantiles.iter_mut().zip([0.16, 0.5, 0.84]) {
                column.push(quantile(&stripe, probability));
            }
        }
    }
    let [u16, u50, u84] = quantiles;
    let rows = model.len();
    vec![
        Column::new("im".into(), vec![report.im; rows]),
        Column::new("unit".into(), vec![report.unit; rows]),
        Column::new("model".into(), model),
        Column::new("level".into(), level),
        Column::new("u16_m".into(), u16),
        Column::new("u50_m".into(), u50),
        Column::new(LEVELS_COLUMN.into(), u84),
        Column::new("overturned".into(), overturned),
        Column::new("records".into(), vec![records as u64; rows]),
    ]
}
