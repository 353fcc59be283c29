//! The answer of overturning.

use uplift_result::{Finding, FindingRow, Inquiry};
use uplift_study::Structure;

use super::super::{CollapseReport, OverturningOptions, OverturningReport};
use super::{Question, rate, uncertain};
use crate::error::DesignError;

impl OverturningReport {
    /// How often `structure` overturns at each site, by each measure and model, as a result keeps it.
    ///
    /// # Errors
    /// None for the reports of this program.
    pub fn finding(&self, structure: &Structure, options: &OverturningOptions) -> Result<Finding, DesignError> {
        let mut measures: Vec<&str> = self.overturning.iter().map(|found| found.im).collect();
        measures.dedup();
        let sites = self.overturning.first().map(|found| &found.sites[..]).unwrap_or_default();
        let sites: Vec<&str> = sites.iter().map(|site| site.site.as_str()).collect();
        let mut request = vec![("site", sites.join(" and ")), ("measure", measures.join(" and "))];
        request.extend(options.restitution.map(|restitution| ("restitution", restitution.to_string())));
        let question = Question { inquiry: Inquiry::Overturning, structure, study_digest: &self.study_digest, request };
        let mut rows: Vec<FindingRow> = self.overturning.iter().flat_map(risks).collect();
        rows.extend(self.overturning.iter().flat_map(fragility));
        rows.extend(uncertain(self.uncertainty.as_ref()));
        question.answered(rows, self)
    }
}

/// The risk at each site.
fn risks(found: &CollapseReport) -> Vec<FindingRow> {
    let mut rows = Vec::new();
    for of in &found.sites {
        let (what, at) = (format!("overturning, {}", found.model), [of.site.as_str(), found.im]);
        rows.extend(rate(&what, &of.risk, of.bands, at));
        rows.extend(of.repaired.iter().flat_map(|risk| rate(&format!("{what}, repaired"), risk, None, at)));
        let fitted = of.lognormal_per_year;
        rows.extend(fitted.map(|rate| FindingRow::new(format!("{what}, lognormal"), rate, "1/yr").at(at[0], at[1])));
    }
    rows
}

/// Median and dispersion of the lognormal fragility.
fn fragility(found: &CollapseReport) -> impl Iterator<Item = FindingRow> {
    let row = |what: &str, value: Option<f64>, unit: &str| {
        let what = format!("{what} of the fragility, {}", found.model);
        value.map(|value| FindingRow::new(what, value, unit).at("", found.im))
    };
    [row("median", found.theta, found.unit), row("dispersion", found.beta, "1")].into_iter().flatten()
}
