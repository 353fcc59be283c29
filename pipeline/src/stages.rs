//! The stages of a study. Each takes what the one before returned and returns a value; none knows a file.

mod bands;
mod coefficients;
mod design;
mod displacement;
mod epistemic;
mod influence;
mod predictors;
mod site_table;
mod spectra;
mod stripes;

pub use bands::{BandSettings, Bands, JointBands, StrengthBands, bands_of_strength, gather_bands};
pub use coefficients::{Coefficients, fit_spectra};
pub use design::{Designs, design_analyses, design_examples};
pub(crate) use design::{RULES, strength};
pub use displacement::{SetSpectra, analyses, set_spectra, shake, structures};
pub use epistemic::{BranchSpectra, FRACTILES};
pub use influence::{Influence, influence, level_of_share};
pub use predictors::{Covariate, Predictor, predictor};
pub use site_table::{SiteRisk, SiteSpectra};
pub use spectra::{Spectra, uniform_risk_spectra};
pub use stripes::{Stripes, analyse_stripes, oscillators, plan_stripes};
