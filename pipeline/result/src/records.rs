//! What a result knows of its records.

use std::collections::BTreeMap;

use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_structure::UncertainQuantity;
use uplift_study::Kind;

use super::declared::{group, measure_names};
use super::file::ResultFile;
use super::layout::attribute::stripes::OSCILLATOR_KEY;
use super::layout::axis::RECORD;
use crate::error::ResultError;

/// What a result knows of its records; arrays run over `[record]`.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredRecords {
    /// Their names.
    pub ids: Vec<String>,
    /// Names of their earthquakes; empty where they are not known.
    pub event: Vec<String>,
    /// Names of the stations; empty where they are not known.
    pub station: Vec<String>,
    /// Moment magnitude; NaN where it is not known.
    pub magnitude: Vec<f64>,
    /// Closest distance to the rupture, km; NaN where it is not known.
    pub rrup_km: Vec<f64>,
    /// Mean shear-wave velocity of the upper 30 m, m/s; NaN where it is not known.
    pub vs30: Vec<f64>,
    /// What of the pair is analysed.
    pub component: Vec<String>,
    /// SHA-256 of time step and samples in m/s².
    pub motion_sha256: Vec<String>,
    /// SHA-256 of the component.
    pub checksum: Vec<String>,
    /// PGA of the unscaled pair, g.
    pub pga_g: Vec<f64>,
    /// PGV of the unscaled pair, cm/s.
    pub pgv_cm_s: Vec<f64>,
    /// The other measures of the unscaled pairs that the study asked for, in their units.
    pub further: BTreeMap<IntensityMeasure, Vec<f64>>,
    /// Significant duration D5-75 of the component, s.
    pub duration_5_75_s: Vec<f64>,
    /// Significant duration D5-95 of the component, s.
    pub duration_5_95_s: Vec<f64>,
    /// Sampling interval, s.
    pub dt_s: Vec<f64>,
    /// Number of samples.
    pub samples: Vec<u32>,
}

group! {
    /// The ground motions.
    pub const RECORDS: StoredRecords = "/records";
    "event" [RECORD] Text "" "earthquake" ("earthquake; empty if not known") = |of, at| of.event[at];
    "station" [RECORD] Text "" "recording station" ("recording station; empty if not known") = |of, at| of.station[at];
    "magnitude" [RECORD] F64 "1" "moment magnitude" ("moment magnitude; NaN if not known, as the next ones")
        = |of, at| of.magnitude[at];
    "rrup_km" [RECORD] F64 "km" "closest distance to the rupture" = |of, at| of.rrup_km[at];
    "vs30" [RECORD] F64 "m/s" "mean shear-wave velocity of the upper 30 m" = |of, at| of.vs30[at];
    "component" [RECORD] Text "" "horizontal component analysed"
        ("analysed component of the pair: `h1`, `h2`, an azimuth `30deg`, or `percentile 50 of 12 azimuths`")
        = |of, at| of.component[at];
    "checksum" [RECORD] Text "" "SHA-256 of the component" ("SHA-256 of its file; of the samples if synthetic")
        = |of, at| of.checksum[at];
    "duration_5_75_s" [RECORD] F64 "s" "significant duration of the component, 5 to 75 % of the Arias intensity"
        ("significant duration of the component, 5 to 75 % of the Arias intensity; of a percentile over azimuths of \
          the first, h1, as the next ones are") = |of, at| of.duration_5_75_s[at];
    "duration_5_95_s" [RECORD] F64 "s" "significant duration of the component, 5 to 95 % of the Arias intensity"
        = |of, at| of.duration_5_95_s[at];
    "dt_s" [RECORD] F64 "s" "sampling interval" = |of, at| of.dt_s[at];
    "samples" [RECORD] U32 "1" "number of samples" = |of, at| of.samples[at];
}

group! {
    /// By which a later run knows the motions again.
    pub const MOTION_KEYS: StoredRecords = RECORDS.path;
    "motion_sha256" [RECORD] Text "" "SHA-256 of time step and samples in m/s2"
        ("SHA-256 that identifies the motion in a later run: of the time step and the samples in m/s² (of a \
          percentile, of all azimuths), and of the uncertain structure")
        = |of, at| of.motion_sha256[at];
}

group! {
    /// Intensities of the unscaled pairs: `pga_g`, `sa_1s_g`; combined as `<combination>` says.
    pub const INTENSITY: Array<1> = RECORDS.path;
    "<im>_<unit_key>" [RECORD] F64 "<unit>" "<measure> of the unscaled pair, <combination>"
        ("of the unscaled pair, combined as the study's `records.intensity` says (by default the geometric mean); so \
          `pga_g`, and `sa_1s_g` and whatever other measure the study is analysed by or has a curve of")
        = |of, at| of[at];
}

group! {
    /// Which structure each record shakes, where structures are not known exactly.
    pub const DRAWN_STRUCTURE: Array<1, u32> = RECORDS.path;
    "structure" [RECORD] U32 "1" "number of the structure that the record shakes"
        ("number of the structure that the record shakes; only of uncertain structures, as the next ones")
        = |of, at| of[at];
}

group! {
    /// A quantity of these structures that is not known exactly.
    pub const DRAWN_QUANTITY: Array<1> = RECORDS.path;
    "<quantity>" [RECORD] F64 "<quantity_unit>" "<words> of the structure"
        ("its uncertain quantities: the factor on each strength, and the values") = |of, at| of[at];
}

/// Names of the array of a quantity that is not known exactly.
pub fn drawn_names(quantity: UncertainQuantity) -> [(&'static str, &'static str); 3] {
    let (name, unit, words) = match quantity {
        UncertainQuantity::Strength => ("strength_factor", "1", "factor on the strength"),
        UncertainQuantity::Restitution => ("restitution", "1", "restitution"),
        UncertainQuantity::UpliftDisplacement => ("uplift_displacement_m", "m", "displacement at uplift"),
        UncertainQuantity::Capacity => ("capacity_m", "m", "displacement capacity"),
    };
    [("<quantity>", name), ("<quantity_unit>", unit), ("<words>", words)]
}

/// Names of the array of the intensities by a measure.
pub fn intensity_names(measure: IntensityMeasure) -> [(&'static str, &'static str); 3] {
    [("<im>", measure.key()), ("<unit_key>", measure.unit_key()), ("<unit>", measure.unit())]
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
        Ok(OSCILLATOR_KEY.read(&self.reader, &measure_names(measure))?)
    }

    /// What a result of uniform risk knows of its records.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn records(&self) -> Result<StoredRecords, ResultError> {
        self.require(Kind::UniformRisk)?;
        let ids = self.reader.axis::<String>(RECORD.name)?;
        let lengths = [(RECORD.name, ids.len())];
        let intensity = |measure| {
            INTENSITY.read_array("<im>_<unit_key>", self, &intensity_names(measure), lengths).map(Array::into_values)
        };
        let further = self.stored_study()?.further_measures().into_iter();
        let nan = vec![f64::NAN; ids.len()];
        let empty = vec![String::new(); ids.len()];
        let mut records = StoredRecords {
            further: further.map(|own| Ok((own, intensity(own)?))).collect::<Result<_, ResultError>>()?,
            pga_g: intensity(IntensityMeasure::Pga)?,
            pgv_cm_s: intensity(IntensityMeasure::Pgv)?,
            event: empty.clone(),
            station: empty.clone(),
            component: empty.clone(),
            motion_sha256: empty.clone(),
            checksum: empty,
            magnitude: nan.clone(),
            rrup_km: nan.clone(),
            vs30: nan.clone(),
            duration_5_75_s: nan.clone(),
            duration_5_95_s: nan.clone(),
            dt_s: nan,
            samples: vec![0; ids.len()],
            ids,
        };
        RECORDS.read(self, &[], &lengths, &mut records)?;
        MOTION_KEYS.read(self, &[], &lengths, &mut records)?;
        Ok(records)
    }
}
