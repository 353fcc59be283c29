//! What a result knows of its records.

use std::collections::BTreeMap;

use uplift_motion::IntensityMeasure;
use uplift_study::Kind;

use super::file::ResultFile;
use super::layout::{axis, ida, intensity, records};
use crate::error::ResultError;

/// What a result knows of its records; arrays run over `[record]`.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredRecords {
    /// Their names.
    pub ids: Vec<String>,
    /// SHA-256 of time step and samples in m/s².
    pub motion_sha256: Vec<String>,
    /// PGA of the unscaled pair, g.
    pub pga_g: Vec<f64>,
    /// PGV of the unscaled pair, cm/s.
    pub pgv_cm_s: Vec<f64>,
    /// The other measures of the unscaled pairs that the study asked for, in their units.
    pub further: BTreeMap<IntensityMeasure, Vec<f64>>,
    /// Moment magnitude; NaN where it is not known.
    pub magnitude: Vec<f64>,
    /// Names of their earthquakes; empty where they are not known.
    pub event: Vec<String>,
    /// Closest distance to the rupture, km; NaN where it is not known.
    pub rrup_km: Vec<f64>,
    /// Mean shear-wave velocity of the upper 30 m, m/s; NaN where it is not known.
    pub vs30: Vec<f64>,
    /// Significant duration D5-95 of the component, s.
    pub duration_5_95_s: Vec<f64>,
}

impl StoredRecords {
    /// Intensities of the unscaled pairs by `measure`, in its unit; none where the result does not know them.
    pub fn intensities(&self, measure: IntensityMeasure) -> Option<&[f64]> {
        match measure {
            IntensityMeasure::Pga => Some(&self.pga_g),
            IntensityMeasure::Pgv => Some(&self.pgv_cm_s),
            _ => self.further.get(&measure).map(Vec::as_slice),
        }
    }
}

impl ResultFile {
    /// What the stripes of `measure` were made with (`oscillator_key` of the crate `uplift_engine`).
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn oscillator_key(&self, measure: IntensityMeasure) -> Result<String, ResultError> {
        Ok(self.reader.attribute_text(&ida::group(measure), "oscillator_key")?)
    }

    /// What a result of uniform risk knows of its records.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn records(&self) -> Result<StoredRecords, ResultError> {
        self.require(Kind::UniformRisk)?;
        let ids = self.reader.axis_text(axis::RECORD)?;
        let axes = [(axis::RECORD, ids.len())];
        let number = |path: &str| self.array(path, axes).map(uplift_job::Array::into_values);
        let further = self.stored_study()?.further_measures();
        let of_measure = |measure: IntensityMeasure| Ok((measure, number(&intensity(measure))?));
        Ok(StoredRecords {
            further: further.into_iter().map(of_measure).collect::<Result<_, ResultError>>()?,
            motion_sha256: self.checked(
                records::MOTION_SHA256,
                self.reader.array_text(records::MOTION_SHA256)?,
                &axes,
            )?,
            pga_g: number(records::PGA_G)?,
            pgv_cm_s: number(records::PGV_CM_S)?,
            event: self.checked(records::EVENT, self.reader.array_text(records::EVENT)?, &axes)?,
            magnitude: number(records::MAGNITUDE)?,
            rrup_km: number(records::RRUP_KM)?,
            vs30: number(records::VS30)?,
            duration_5_95_s: number(records::DURATION_5_95_S)?,
            ids,
        })
    }
}
