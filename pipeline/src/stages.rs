//! The stages of a study. Each takes what the one before returned and returns a value; none knows a file.

mod bands;
mod coefficients;
mod design;
mod design_example;
mod displacement;
mod epistemic;
mod influence;
mod overturning;
mod predictors;
mod site_table;
mod spectra;
mod stripes;
mod structure;

pub use bands::{BandSettings, Bands, JointBands, StrengthBands, bands_of_strength, gather_bands};
pub use coefficients::{Coefficients, fit_spectra};
pub use design::{
    DemandNoise, ExactDemand, OSCILLATORS, RuleOutcome, SpectrumReading, check_rules, exact_demand, read_spectrum,
};
pub use design_example::{Designs, design_analyses, design_examples};
pub(crate) use design_example::{RULES, strength};
pub use displacement::{SetSpectra, analyses, set_spectra, shake, structures};
pub use epistemic::{BranchSpectra, FRACTILES};
pub use influence::{Influence, influence, level_of_share};
pub use overturning::{Collapse, Model, collapse};
pub use predictors::{Covariate, Predictor, predictor};
pub use site_table::{SiteRisk, SiteSpectra};
pub use spectra::{Spectra, uniform_risk_spectra};
pub use stripes::{Stripes, analyse_stripes, oscillators, plan_stripes};
pub use structure::{EventRisk, OVERTURNING_M, demand_of, risk_of_exceeding, stripes_of};
