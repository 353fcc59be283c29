//! One record of a manifest, or what a record file holds.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use uplift_job::JobError;
use uplift_motion::{Accelerogram, Combination, Orientation, ReadOptions, RecordPair, Recording, read_record_file};
use uplift_study::did_you_mean;

use crate::FileOptions;
use crate::error::InputsError;
use crate::import::{PairMeasures, pair_warnings, unusual_peaks};
use crate::manifest::{self, ComponentFile};
use crate::pairs::read_component;

/// What is looked at.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ShowOptions {
    /// Manifest or record file
    #[arg(value_name = "SET|FILE")]
    pub input: PathBuf,
    /// Name of a record in the manifest
    pub record: Option<String>,
    /// What the files do not say.
    #[command(flatten)]
    pub files: FileOptions,
}

/// What was looked at.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ShowReport {
    /// A record file.
    File(FileReport),
    /// A record of a manifest.
    Record(Box<RecordReport>),
}

/// What a record file holds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FileReport {
    /// The file.
    pub file: PathBuf,
    /// Its layout.
    pub format: String,
    /// Its components.
    pub components: Vec<ComponentReport>,
    /// What deserves a look before the record is trusted.
    pub warnings: Vec<String>,
}

/// A record of a manifest.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecordReport {
    /// Its name.
    pub record: String,
    /// What the manifest says of it, by column.
    pub metadata: BTreeMap<String, String>,
    /// The files of its components.
    pub files: [PathBuf; 2],
    /// Its components.
    pub components: [ComponentReport; 2],
    /// Peaks of both components together, in every way they can be had.
    pub peaks: Vec<PairPeaks>,
    /// Whether it has a velocity pulse; none where that cannot be judged.
    pub pulse_like: Option<bool>,
    /// The pulse, or the strongest motion that could be one; none also where the motion is too weak for any.
    pub pulse: Option<VelocityPulse>,
    /// What deserves a look before the record is trusted.
    pub warnings: Vec<String>,
}

/// Peaks of two components as one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PairPeaks {
    /// How they are combined.
    pub combination: &'static str,
    /// PGA, g.
    pub pga_g: f64,
    /// PGV, cm/s.
    pub pgv_cm_s: f64,
}

/// A motion that is, or could be, a velocity pulse (Shahi and Baker 2014).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VelocityPulse {
    /// Whether it is one.
    pub is_pulse_like: bool,
    /// Its period, s.
    pub period_s: f64,
    /// The indicator by which it is judged.
    pub indicator: f64,
}

/// One component: what its file says, and what is measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComponentReport {
    /// What the head of the file says, in words, each with what it is.
    pub said: Vec<(&'static str, String)>,
    /// Samples.
    pub samples: usize,
    /// Time step, s.
    pub dt_s: f64,
    /// Duration, s.
    pub duration_s: f64,
    /// PGA, g.
    pub pga_g: f64,
    /// PGV, cm/s.
    pub pgv_cm_s: f64,
    /// PGD, cm.
    pub pgd_cm: f64,
    /// Arias intensity, m/s.
    pub arias_m_s: f64,
    /// Cumulative absolute velocity, m/s.
    pub cav_m_s: f64,
    /// Significant duration D5-75, s.
    pub d5_75_s: f64,
    /// Significant duration D5-95, s.
    pub d5_95_s: f64,
    /// Velocity at the end, cm/s.
    pub residual_velocity_cm_s: f64,
}

/// Looks at a record of a manifest, or at a record file.
///
/// # Errors
/// A manifest without a name of a record, or with an unknown one; files that cannot be read.
pub fn show(options: &ShowOptions) -> Result<ShowReport, InputsError> {
    match &options.record {
        Some(id) => Ok(ShowReport::Record(Box::new(record(&options.input, id, options.files.gravity_m_s2)?))),
        None => Ok(ShowReport::File(file(&options.input, options.files)?)),
    }
}

fn file(path: &Path, files: FileOptions) -> Result<FileReport, InputsError> {
    if path.extension().is_some_and(|extension| extension == "csv") && manifest::read(path, None).is_ok() {
        return Err(JobError::Usage(format!(
            "{} is a manifest: name one of its records too; uplift records list shows them",
            path.display()
        ))
        .into());
    }
    let file = read_record_file(path, &files.read_options(None))?;
    let components: Vec<ComponentReport> = file
        .recordings
        .iter()
        .map(|recording| ComponentReport::from_recording(recording, files.gravity_m_s2))
        .collect();
    let warnings =
        components.iter().filter_map(|component| unusual_peaks(&[component.pga_g], &[component.pgv_cm_s])).collect();
    Ok(FileReport { file: path.to_owned(), format: file.format.to_string(), components, warnings })
}

fn record(set: &Path, id: &str, gravity_m_s2: f64) -> Result<RecordReport, InputsError> {
    let rows = manifest::read(set, None).map_err(JobError::Inputs)?;
    let known: Vec<&str> = rows.iter().map(|row| &*row.id).collect();
    let meant = did_you_mean(id, &known);
    let Some(row) = rows.into_iter().find(|row| row.id == *id) else {
        let meant = meant.map_or_else(String::new, |meant| format!("{meant} "));
        return Err(JobError::input(format!(
            "{} has no record {id:?}; {meant}uplift records list shows its records",
            set.display()
        ))
        .into());
    };
    let component = |file: &ComponentFile| -> Result<Recording, InputsError> {
        let (format, channel) = (row.format, file.channel);
        let options = ReadOptions { format, channel, dt_s: row.dt_s, unit: row.unit, gravity_m_s2 };
        Ok(read_component(file, &options)
            .map(|(recording, _)| recording)
            .map_err(|reason| JobError::input(format!("record {id}: {reason}")))?)
    };
    let [one, other] = [component(&row.components[0])?, component(&row.components[1])?];
    let components = [&one, &other].map(|recording| ComponentReport::from_recording(recording, gravity_m_s2));
    let descriptions = [&one.description, &other.description];
    let pair =
        RecordPair { id: id.to_owned(), h1: one.accelerogram, h2: other.accelerogram, metadata: BTreeMap::new() };
    let measures = PairMeasures::from_pair(&pair, gravity_m_s2, true);
    let peaks = Combination::ALL.iter().zip(&measures.peaks).filter_map(|(combination, peaks)| {
        let [pga_g, pgv_cm_s] = (*peaks)?;
        Some(PairPeaks { combination: combination.key(), pga_g, pgv_cm_s })
    });
    Ok(RecordReport {
        record: id.to_owned(),
        metadata: row.metadata,
        files: row.components.map(|file| file.path),
        components,
        peaks: peaks.collect(),
        pulse_like: measures.pulse_like,
        pulse: measures.pulse.as_ref().map(|pulse| VelocityPulse {
            is_pulse_like: pulse.is_pulse_like,
            period_s: pulse.period_s,
            indicator: pulse.indicator,
        }),
        warnings: pair_warnings(&pair, descriptions, &measures, gravity_m_s2)
            .into_iter()
            .map(|warning| warning.text)
            .collect(),
    })
}

impl ComponentReport {
    fn from_recording(recording: &Recording, gravity_m_s2: f64) -> Self {
        let motion = &recording.accelerogram;
        Self {
            said: said(recording),
            samples: motion.len(),
            dt_s: motion.dt_s(),
            duration_s: motion.duration_s(),
            pga_g: motion.pga_m_s2() / gravity_m_s2,
            pgv_cm_s: 100.0 * motion.pgv_m_s(),
            pgd_cm: 100.0 * motion.pgd_m(),
            arias_m_s: motion.arias_intensity_m_s(gravity_m_s2),
            cav_m_s: Accelerogram::cumulative_absolute_velocity_m_s(motion),
            d5_75_s: motion.d5_75_s(),
            d5_95_s: motion.d5_95_s(),
            residual_velocity_cm_s: 100.0 * motion.residual_velocity_m_s(),
        }
    }
}

/// What the head of a file says.
fn said(recording: &Recording) -> Vec<(&'static str, String)> {
    let description = &recording.description;
    let number = |value: Option<f64>, unit: &str| value.map(|value| format!("{value} {unit}").trim().to_owned());
    let direction = description.orientation.map(|orientation| match orientation {
        Orientation::Azimuth(degrees) => format!("{degrees}° from north"),
        Orientation::Horizontal(number) => format!("horizontal {number}"),
        Orientation::Vertical => "vertical".to_owned(),
    });
    let all = [
        ("event", description.event.clone()),
        ("event time", description.event_time.clone()),
        ("magnitude", number(description.magnitude, "")),
        ("epicentral distance", number(description.epicentral_distance_km, "km")),
        ("rupture distance", number(description.rupture_distance_km, "km")),
        ("station", description.station.clone()),
        ("place", description.station_name.clone()),
        ("Vs30", number(description.vs30_m_s, "m/s")),
        ("sensor", description.sensor.clone()),
        ("channel", description.channel.clone()),
        ("direction", direction),
        ("high-pass corner", number(description.low_cut_hz, "Hz")),
        ("processing", description.unprocessed.then(|| "none: raw data".to_owned())),
    ];
    all.into_iter().filter_map(|(what, value)| Some((what, value?))).collect()
}
