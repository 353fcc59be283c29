//! A record as it is analysed.

use std::collections::BTreeMap;

use uplift_motion::{Accelerogram, Direction, IntensityMeasure};

use super::drawn_structure::DrawnStructure;
use super::third_component::Vertical;

/// One analysis record: a component of a pair, or the pair as it is seen from azimuths, with the intensity of the pair.
#[derive(Debug, Clone)]
pub struct Record {
    /// Identifier; where a pair makes several records, followed by a colon and the direction, `:h1` or `:30deg`, and by
    /// a colon and the number of its structure, `:s1`, where these are not known exactly.
    pub id: String,
    /// What of the pair it is.
    pub direction: Direction,
    /// Its acceleration; of a percentile over azimuths that of the first.
    pub accelerogram: Accelerogram,
    /// Accelerations from the other azimuths of a percentile.
    pub other_azimuths: Vec<Accelerogram>,
    /// The vertical component, where the study asks for it.
    pub vertical: Option<Vertical>,
    /// PGA of the pair, g, as the study combines its components (Eq. 4.5).
    pub pga_g: f64,
    /// PGV of the pair, cm/s, as the study combines its components (Eq. 4.6).
    pub pgv_cm_s: f64,
    /// The other measures that the study asks of its records, in their units, combined in the same way.
    pub further: BTreeMap<IntensityMeasure, f64>,
    /// Event, magnitude and whatever else is known.
    pub metadata: BTreeMap<String, String>,
    /// SHA-256 of the record's file; of the samples of a synthetic one.
    pub checksum: String,
    /// The structure that it shakes; none where these are known exactly.
    pub structure: Option<DrawnStructure>,
}

impl Record {
    /// A number that the manifest says under `key`; NaN where it says none.
    pub fn number(&self, key: &str) -> f64 {
        self.metadata.get(key).and_then(|text| text.parse().ok()).unwrap_or(f64::NAN)
    }

    /// Intensity of the pair in the unit of `measure`; NaN for one that the study does not ask of its records.
    pub fn intensity(&self, measure: IntensityMeasure) -> f64 {
        match measure {
            IntensityMeasure::Pga => self.pga_g,
            IntensityMeasure::Pgv => self.pgv_cm_s,
            _ => self.further.get(&measure).copied().unwrap_or(f64::NAN),
        }
    }
}
