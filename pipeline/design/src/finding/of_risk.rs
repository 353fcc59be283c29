//! The answer of the risk of a frame.

use uplift_result::{Finding, FindingRow, Inquiry};
use uplift_study::Structure;

use super::super::{FrameRiskReport, ModelDemand};
use super::{Question, rate};
use crate::error::DesignError;

/// What its bands are of.
const RESAMPLED: &str = "resampled records";

impl FrameRiskReport {
    /// The demand on the frame of `structure` and its proxies, and how often what happens to it, as a result keeps
    /// them.
    ///
    /// # Errors
    /// None for the reports of this program.
    pub fn finding(&self, structure: &Structure) -> Result<Finding, DesignError> {
        let question = Question {
            inquiry: Inquiry::Risk,
            structure,
            study_digest: &self.study_digest,
            request: vec![
                ("site", self.site.clone()),
                ("measure", self.im.to_owned()),
                ("poe", self.poe.to_string()),
                ("years", self.years.to_string()),
                ("model", self.demands.first().map_or("", |frame| frame.model).to_owned()),
            ],
        };
        let at = [self.site.as_str(), self.im];
        let mut rows: Vec<FindingRow> = self.demands.iter().flat_map(|demand| demands(demand, at)).collect();
        for event in &self.events {
            rows.extend(rate(event.event.words(), &event.risk, None, at));
        }
        let found = &self.overturning;
        rows.extend(rate("overturning", &found.risk, None, at));
        rows.extend(found.repaired.iter().flat_map(|risk| rate("overturning, repaired", risk, None, at)));
        let fitted = found.lognormal_per_year;
        rows.extend(fitted.map(|rate| FindingRow::new("overturning, lognormal", rate, "1/yr").at(at[0], at[1])));
        question.answered(rows, self)
    }
}

/// The demand on one model, and its error.
fn demands(of: &ModelDemand, [site, im]: [&str; 2]) -> Vec<FindingRow> {
    let row = |what: &str, value: f64, unit: &str| FindingRow::new(format!("{what}, {}", of.model), value, unit);
    let demand = row("demand", of.demand_m.value, "m").within([of.demand_m.lower, of.demand_m.upper], RESAMPLED);
    let repaired = of.repaired_m.map(|demand_m| row("demand, repaired", demand_m, "m"));
    let error = of.error.map(|of| row("error", of.value, "1").within([of.lower, of.upper], RESAMPLED));
    [Some(demand), repaired, error].into_iter().flatten().map(|row| row.at(site, im)).collect()
}
