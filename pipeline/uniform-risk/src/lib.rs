//! Spectra of uniform risk in memory: stripes to demands, demands and hazard to spectra, spectra to coefficients; and
//! the same asked of a result at other risks.
//!
//! | module | what is in it |
//! |---|---|
//! | `stripes` | the peaks of one measure, `[record, strength, level]` |
//! | `spectra`, `coefficients`, `site_risk` | spectra of all sites and their fits; the same site by site |
//! | `epistemic` | spectra of weighted hazard curves and of structures that are not known exactly |
//! | `precision`, `quoted` | how well the records know the spectra; whose scatter a quoted band is of |
//! | `displacement` | displacements with their confidence bands, at any strength and risk |
//! | [`consistency`] | whether the records have the hazard of the other measure, and weights by which they do |
//! | `target_risks`, `study_of_result` | a result at other risks; its study and records read again |

mod coefficients;
pub mod consistency;
mod displacement;
mod epistemic;
mod error;
mod precision;
mod quoted;
mod site_risk;
mod spectra;
mod stored_stripes;
mod stripes;
mod study_of_result;
mod target_risks;
mod units;

pub use coefficients::{Coefficients, fit_ordinates, fit_spectra, stored_spectra};
pub use displacement::{
    CONFIDENCE, Displacement, DisplacementOptions, DisplacementReport, QUOTED_LIMITS, displacements, measure_index,
    site_index, strength_index,
};
pub use error::UniformRiskError;
pub use precision::{Precision, precision};
pub use quoted::{BandOf, QuotedUnits};
pub use site_risk::{SiteRisk, SiteSpectra};
pub use spectra::{Reading, Spectra, pooled_demand, uniform_risk_spectra};
pub use stored_stripes::{StoredMeasure, StoredStripes, branch_weights};
pub use stripes::{
    Stripes, plan_levels, plan_motions, plan_own_stripes, plan_stripes, systems, systems_under, with_components,
    with_verticals,
};
pub use study_of_result::{SpectraOfResult, StudyOfResult};
pub use target_risks::{OneRisk, TargetRisks, at_target_risks};
pub use units::RecordUnits;
pub use uplift_risk::{BOUND_CONFIDENCE, EventRisk, StrengthPlace, at_most_per_year, share_at_most};

/// Of all replicates of repaired spectra, this share may fail before it is a matter to be reported.
pub const MANY_FAILED: f64 = 0.05;
