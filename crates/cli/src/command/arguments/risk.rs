//! Risks that a result is asked for: by probability or by return period.

use clap::Args;
use uplift::result::{AskedRisk, RiskTargets};

use super::{number, number_or_per_cent};

/// The risks of the spectra, any: computed from the stripes of the result, without a new run.
#[derive(Debug, Args)]
pub(crate) struct RiskArguments {
    /// Probabilities of exceedance, 0.1 or 10% [default: the study's]
    #[arg(
        long,
        value_name = "P[,P…]",
        value_delimiter = ',',
        allow_negative_numbers = true,
        value_parser = number_or_per_cent,
        conflicts_with = "return_period"
    )]
    poe: Vec<f64>,
    /// Return periods in years instead
    #[arg(long, value_name = "YEARS[,…]", value_delimiter = ',', allow_negative_numbers = true, value_parser = number)]
    return_period: Vec<f64>,
    /// Years of the probabilities [default: the study's]
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    years: Option<f64>,
}

impl RiskArguments {
    /// What is asked for.
    pub(crate) fn asked(&self) -> AskedRisk {
        let targets = match (self.poe.is_empty(), self.return_period.is_empty()) {
            (false, _) => RiskTargets::Probabilities(self.poe.clone()),
            (true, false) => RiskTargets::ReturnPeriods(self.return_period.clone()),
            (true, true) => RiskTargets::OfStudy,
        };
        AskedRisk { targets, years: self.years }
    }
}

/// One risk of the spectra, any: computed from the stripes of the result, without a new run.
#[derive(Debug, Args)]
pub(crate) struct OneRiskArguments {
    /// Probability of exceedance, 0.1 or 10% [default: the smallest]
    #[arg(
        long, value_name = "P", allow_negative_numbers = true, value_parser = number_or_per_cent,
        conflicts_with = "return_period"
    )]
    poe: Option<f64>,
    /// Return period in years instead
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    return_period: Option<f64>,
    /// Years of the probability [default: the study's]
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    years: Option<f64>,
}

impl OneRiskArguments {
    /// What is asked for.
    pub(crate) fn asked(&self) -> AskedRisk {
        let several = RiskArguments {
            poe: self.poe.into_iter().collect(),
            return_period: self.return_period.into_iter().collect(),
            years: self.years,
        };
        several.asked()
    }
}
