//! Site hazard curves: the mean annual frequency λ(im) with which an intensity measure exceeds a level.
//!
//! - [`HazardCurve`]: a value that is valid by construction (strictly increasing levels, strictly decreasing
//!   positive rates), read between its points by log–log interpolation and beyond them only on request
//!   ([`Extrapolation`]).
//! - [`rate_from_probability`], [`probability_from_rate`], [`return_period_from_probability`]: Eq. 4.8.
//! - [`read_csv`], [`read_path`]: two-column text (level and rate, or level and probability) into a curve, checked
//!   against what the caller [`Declared`].
//! - [`read_export`], [`ExportedCurves`]: curves of one site or many as `OpenQuake` and the USGS export them;
//!   [`read_realization_weights`]: the logic tree weights that go with them.
//! - [`CurveUnit`]: the units that levels convert between.
//! - [`ComponentDefinition`]: how two horizontal components are combined in the measure of a curve.
//!
//! Rates are per year. Levels stay in the unit the curve names; [`HazardCurve::in_field_units`] turns velocities into
//! cm/s and accelerations into g.
//!
//! ```
//! use uplift_hazard::{HazardCurve, rate_from_probability};
//!
//! let curve = HazardCurve::new("PGV", "cm/s", "power law", vec![1.0, 10.0, 100.0], vec![0.1, 0.001, 0.00001])?;
//! let rate = rate_from_probability(0.02, 50.0)?;
//! let pgv_cm_s = curve.im_at_rate(rate)?;
//! assert!((curve.rate_at(pgv_cm_s)? / rate - 1.0).abs() < 1e-12);
//! # Ok::<(), uplift_hazard::HazardError>(())
//! ```
//!
//! # Source
//! N. Reggiani Manzo, dissertation, Sections 4.3.2 and 4.3.4.

mod component;
mod csv;
mod curve;
mod declaration;
mod error;
mod import;
mod input;
mod interpolation;
mod mean;
mod probability;
mod rates;
mod text;
mod unit;

pub use component::ComponentDefinition;
pub use csv::{
    CsvCurve, CsvOptions, Declared, MAX_FILE_BYTES, SecondColumn, read_csv, read_path, table_text, years_in_table,
};
pub use curve::{HazardCurve, HazardPoint};
pub use error::{HazardError, Place};
pub use import::{
    Disaggregation, ExportedCurve, ExportedCurves, ExportedSite, MAX_JSON_BYTES, MAX_NRML_BYTES, RealizationWeight,
    SitePlace, SiteSelection, Statistic, read_disaggregation, read_export, read_realization_weights,
};
pub use interpolation::Extrapolation;
pub use probability::{probability_from_rate, rate_from_probability, return_period_from_probability};
pub use unit::CurveUnit;
