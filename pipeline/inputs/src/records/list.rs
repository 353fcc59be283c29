//! The records of a manifest, and which of them.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_motion::{Combination, RecordPair, STANDARD_GRAVITY_M_S2, geometric_mean};

use super::Criteria;
use crate::error::InputsError;
use crate::pairs::CheckedPair;
use crate::{manifest, pairs, selection};

/// The records of a set that were asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ListReport {
    /// The records, in the order of the manifest.
    pub records: Vec<ListedRecord>,
    /// How many the set has in all.
    pub count: usize,
    /// How the peaks of two components made one.
    #[serde(skip)]
    pub intensity: Combination,
}

/// A record of a set; none where the manifest says nothing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ListedRecord {
    /// Its name.
    pub record: String,
    /// The event, as the manifest says it.
    pub event: Option<String>,
    /// Magnitude, as the manifest says it.
    pub magnitude: Option<String>,
    /// Closest distance to the rupture, km, or to the epicentre where that is all that is known.
    pub distance_km: Option<String>,
    /// Mean shear-wave velocity of the upper 30 m, m/s, as the manifest says it.
    pub vs30: Option<String>,
    /// PGA of the pair, g.
    pub pga_g: f64,
    /// PGV of the pair, cm/s.
    pub pgv_cm_s: f64,
    /// Significant duration D5-75, geometric mean of the components, s.
    pub d5_75_s: f64,
    /// Whether it has a velocity pulse, as the manifest says it.
    pub pulse_like: Option<String>,
}

/// Lists the records of a set, measured.
///
/// # Errors
/// A manifest or record files that cannot be read; no record that is asked for; a measure that cannot be had.
pub fn list(options: &SetOptions, events: &dyn Events) -> Result<ListReport, InputsError> {
    let (pairs, count) = options.read(events)?;
    let records: Result<Vec<ListedRecord>, InputsError> =
        pairs.iter().map(|(pair, _)| listed(pair, options.intensity)).collect();
    Ok(ListReport { records: records?, count, intensity: options.intensity })
}

fn listed(pair: &RecordPair, intensity: Combination) -> Result<ListedRecord, InputsError> {
    let peaks = intensity.peaks_of(pair)?;
    let said = |key: &str| pair.metadata.get(key).cloned();
    Ok(ListedRecord {
        record: pair.id.clone(),
        event: said("event"),
        magnitude: said("magnitude"),
        distance_km: said("rrup_km").or_else(|| said("repi_km")),
        vs30: said("vs30"),
        pga_g: peaks.pga_g(STANDARD_GRAVITY_M_S2),
        pgv_cm_s: peaks.pgv_cm_s(),
        d5_75_s: geometric_mean(pair.h1.d5_75_s(), pair.h2.d5_75_s()),
        pulse_like: said("pulse_like"),
    })
}

/// A manifest, and which of its records.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct SetOptions {
    /// Manifest, from uplift records import
    #[arg(value_name = "SET")]
    pub manifest: PathBuf,
    /// Only records with this tag
    #[arg(long, value_name = "WORD", help = "Only records with this tag (a word of set_tags)")]
    pub tag: Option<String>,
    /// Combination of two components: geometric-mean, rotd50 or rotd100
    #[arg(long, value_name = "WORD", default_value_t = Combination::GeometricMean)]
    pub intensity: Combination,
    /// Which records.
    #[command(flatten)]
    pub criteria: Criteria,
}

impl SetOptions {
    /// The records that are asked for, and how many there are in all.
    pub(super) fn read(&self, events: &dyn Events) -> Result<(Vec<CheckedPair>, usize), InputsError> {
        let rows = manifest::read(&self.manifest, self.tag.as_deref()).map_err(JobError::Inputs)?;
        let count = rows.len();
        let pairs = pairs::read(rows, STANDARD_GRAVITY_M_S2, events)?;
        let (chosen, notes) = selection::select(pairs, &self.criteria.0, self.intensity, STANDARD_GRAVITY_M_S2)?;
        for note in notes {
            events.note(&note);
        }
        Ok((chosen, count))
    }
}
