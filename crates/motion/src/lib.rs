//! Ground motions: accelerograms, their readers and their measures.
//!
//! - [`Accelerogram`]: uniformly sampled ground acceleration, with its peaks (PGA, PGV, PGD),
//!   Arias intensity and significant durations;
//! - [`RecordPair`]: the two horizontal components of a ground motion, and [`Component`], the
//!   choice of those, or of azimuths, that a planar model receives;
//! - [`IntensityMeasure`]: PGV and PGA of a pair as geometric means (Eq. 4.5, 4.6) or in another
//!   [`Combination`], spectral accelerations and others, and the [`scale_factor`] to a level;
//! - [`read_record_file`], [`read_record`]: every component of a record file of any [`RecordFormat`],
//!   with what the file says about it ([`RecordingDescription`]);
//! - [`read_path`], [`read_auto`], [`read_at2`], [`read_columns`]: one accelerogram;
//! - [`ElasticSpectrum`]: the elastic response spectrum of Eurocode 8;
//! - [`classify_pulse`]: whether a pair is pulse-like, with the period and orientation of its pulse;
//! - [`read_selection`]: the records that a tool of record selection chose for a level;
//! - [`synthetic`]: record pairs from a stochastic model, for studies without real records.
//!
//! Inside, everything is in m and s. Measures of a pair are in the units of the field: cm/s for
//! PGV, g for PGA and SA. Equation numbers are those of N. Reggiani Manzo's dissertation.

mod accelerogram;
mod arias;
mod combination;
mod component;
mod elastic_spectrum;
mod error;
mod measure;
mod pair;
mod peaks;
mod pulse;
mod read;
mod recording;
mod response_spectrum;
mod rotation;
mod selection;
pub mod synthetic;
mod unit;
mod write;

pub use accelerogram::Accelerogram;
pub use combination::{Combination, Peaks};
pub use component::{Component, Direction, Drawn, Rotation};
pub use elastic_spectrum::{ElasticSpectrum, GroundType, SpectrumShape};
pub use error::{MotionError, six_digits};
pub use measure::{IntensityMeasure, Period, geometric_mean, scale_factor};
pub use pair::{Horizontal, RecordPair};
pub use pulse::{PulseClassification, classify_pulse, may_be_pulse_like};
pub use read::at2::{At2Header, At2Record, read_at2};
pub use read::columns::read_columns;
pub use read::{ReadOptions, read_auto, read_path, read_record, read_record_file, record_bytes};
pub use recording::{Orientation, RecordFile, RecordFormat, Recording, RecordingDescription};
pub use response_spectrum::AVERAGED_PERIODS;
pub use selection::{
    SelectedComponent, SelectedName, SelectedRecord, SelectedSet, SelectionTool, ezgm_selection_from, read_selection,
    selection_from,
};
pub use unit::{AccelerationUnit, STANDARD_GRAVITY_M_S2};
pub use write::at2_text;
