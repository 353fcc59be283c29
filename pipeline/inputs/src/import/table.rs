//! The manifest of imported records.

use std::path::Path;

use polars::prelude::Column;
use uplift_motion::{AccelerationUnit, Orientation, RecordingDescription};

use super::collect::ImportedPair;
use super::component::Component;
use crate::FileOptions;
use crate::manifest::relative;

/// A cell with the name of its column.
type Cell = (&'static str, String);

/// The columns of a manifest in `folder` that lists `pairs`, as records/README.md describes them.
pub(super) fn manifest_columns(pairs: &[ImportedPair], folder: &Path, options: FileOptions) -> Vec<Column> {
    let rows: Vec<Vec<Cell>> = pairs
        .iter()
        .map(|pair| {
            let parts = [files(pair, folder, options), said(pair), measured(pair), checked(pair), third(pair, folder)];
            parts.into_iter().flatten().collect()
        })
        .collect();
    let has_third = pairs.iter().any(|pair| pair.vertical.is_some());
    let names = rows.first().into_iter().flatten().map(|(name, _)| *name);
    names
        .enumerate()
        .filter(|(_, name)| has_third || !THIRD.contains(name))
        .map(|(index, name)| {
            let cells: Vec<&str> = rows.iter().map(|row| row[index].1.as_str()).collect();
            Column::new(name.into(), cells)
        })
        .collect()
}

/// What a run needs to read the pair.
fn files(pair: &ImportedPair, folder: &Path, options: FileOptions) -> Vec<Cell> {
    let [one, other] = &pair.components;
    let given_unit = pair.components.iter().chain(&pair.vertical).find_map(|component| component.given_unit);
    vec![
        ("record_id", pair.id.clone()),
        ("file_h1", relative(&one.path, folder)),
        ("file_h2", relative(&other.path, folder)),
        ("channel_h1", text(one.channel)),
        ("channel_h2", text(other.channel)),
        ("format", one.format.to_string()),
        ("unit", text(given_unit.map(AccelerationUnit::symbol))),
        ("dt_s", text(options.dt_s)),
    ]
}

/// What the search results say, else the head of the first component that knows it.
fn said(pair: &ImportedPair) -> Vec<Cell> {
    let search = pair.search.clone().unwrap_or_default();
    let head = |of: &dyn Fn(&RecordingDescription) -> Option<String>| {
        pair.components.iter().find_map(|component| of(&component.description))
    };
    let number =
        |of: &dyn Fn(&RecordingDescription) -> Option<f64>| head(&|said| of(said).map(|value| value.to_string()));
    vec![
        ("event", text(search.event.or_else(|| head(&|said| said.event.clone())))),
        ("event_time", text(search.year.or_else(|| head(&|said| said.event_time.clone())))),
        ("magnitude", text(search.magnitude.or_else(|| number(&|said| said.magnitude)))),
        ("mechanism", text(search.mechanism)),
        ("rrup_km", text(search.rrup_km.or_else(|| number(&|said| said.rupture_distance_km)))),
        ("rjb_km", text(search.rjb_km)),
        ("repi_km", text(number(&|said| said.epicentral_distance_km))),
        ("vs30", text(search.vs30.or_else(|| number(&|said| said.vs30_m_s)))),
        (
            "station",
            text(search.station.or_else(|| head(&|said| said.station_name.clone().or_else(|| said.station.clone())))),
        ),
        ("station_code", text(head(&|said| said.station.clone()))),
        ("direction_h1", direction(&pair.components[0].description)),
        ("direction_h2", direction(&pair.components[1].description)),
        ("low_cut_hz", text(number(&|said| said.low_cut_hz))),
        ("lowest_usable_hz", text(search.lowest_usable_hz)),
    ]
}

fn measured(pair: &ImportedPair) -> Vec<Cell> {
    let measures = &pair.measures;
    let peak = |combination: usize, which: usize| rounded(measures.peaks[combination].map(|peaks| peaks[which]));
    let pulse = measures.pulse.as_ref();
    let pulse_like = measures.pulse_like.map(|yes| if yes { "yes" } else { "no" });
    vec![
        ("pga_g", peak(0, 0)),
        ("pgv_cm_s", peak(0, 1)),
        ("pga_rotd50_g", peak(1, 0)),
        ("pgv_rotd50_cm_s", peak(1, 1)),
        ("pga_rotd100_g", peak(2, 0)),
        ("pgv_rotd100_cm_s", peak(2, 1)),
        ("pgd_cm", rounded(Some(measures.pgd_cm))),
        ("arias_m_s", rounded(Some(measures.arias_m_s))),
        ("cav_m_s", rounded(Some(measures.cav_m_s))),
        ("d5_75_s", rounded(Some(measures.durations_s[0]))),
        ("d5_95_s", rounded(Some(measures.durations_s[1]))),
        ("residual_velocity_share", rounded(Some(measures.residual_velocity_share))),
        ("pulse_like", text(pulse_like)),
        ("pulse_period_s", rounded(pulse.filter(|pulse| pulse.is_pulse_like).map(|pulse| pulse.period_s))),
    ]
}

fn checked(pair: &ImportedPair) -> Vec<Cell> {
    let [one, other] = &pair.components;
    let warnings: Vec<&str> = pair.warnings.iter().map(|warning| warning.kind).collect();
    vec![
        ("dt_h1_s", one.dt_s.to_string()),
        ("dt_h2_s", other.dt_s.to_string()),
        ("points_h1", one.points.to_string()),
        ("points_h2", other.points.to_string()),
        ("set_tags", String::new()),
        ("sha256_h1", one.file_sha256.clone()),
        ("sha256_h2", other.file_sha256.clone()),
        ("warnings", warnings.join("; ")),
    ]
}

/// Columns of the third component: only where a pair has one.
const THIRD: [&str; 3] = ["file_v", "channel_v", "sha256_v"];

fn third(pair: &ImportedPair, folder: &Path) -> Vec<Cell> {
    let own = |of: &dyn Fn(&Component) -> String| pair.vertical.as_ref().map_or_else(String::new, of);
    let cells = [
        own(&|vertical| relative(&vertical.path, folder)),
        own(&|vertical| text(vertical.channel)),
        own(&|vertical| vertical.file_sha256.clone()),
    ];
    THIRD.into_iter().zip(cells).collect()
}

/// What is known; a blank cell for what is not.
fn text(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// Degrees from north, or what the file calls the channel.
fn direction(description: &RecordingDescription) -> String {
    match description.orientation {
        Some(Orientation::Azimuth(degrees)) => degrees.to_string(),
        _ => text(description.channel.as_deref()),
    }
}

/// Six significant digits: a table to look at; what is computed is computed from the files.
fn rounded(value: Option<f64>) -> String {
    let finite = value.filter(|value| value.is_finite());
    finite.map_or_else(String::new, |value| uplift_job::text::rounded(value, 6).to_string())
}
