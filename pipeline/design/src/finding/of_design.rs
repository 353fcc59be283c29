//! The answer of a design.

use uplift_result::{Finding, FindingRow, Inquiry};
use uplift_study::Structure;

use super::super::{DesignReport, ExactDemand};
use super::{Question, banded, rate, uncertain};
use crate::error::DesignError;

impl DesignReport {
    /// The demand on `structure`, its rules and risks, as a result keeps them.
    ///
    /// # Errors
    /// None for the reports of this program.
    pub fn finding(&self, structure: &Structure) -> Result<Finding, DesignError> {
        let analysed = if self.exact.is_some() { "its own analysis" } else { "the spectrum alone" };
        let question = Question {
            inquiry: Inquiry::Design,
            structure,
            study_digest: &self.study_digest,
            request: vec![
                ("site", self.site.clone()),
                ("measure", self.spectrum_words()),
                ("poe", self.poe.to_string()),
                ("years", self.years.to_string()),
                ("safety factor", self.required_safety_factor.to_string()),
                ("by", analysed.to_owned()),
            ],
        };
        question.answered(self.finding_rows(), self)
    }

    fn finding_rows(&self) -> Vec<FindingRow> {
        let at = [self.site.as_str(), self.im];
        let row = |what: String, value: f64, unit: &str| FindingRow::new(what, value, unit).at(at[0], at[1]);
        let mut rows = vec![row("strength of the spectrum".to_owned(), self.structure.spectral_strength, "1")];
        rows.extend(self.structure.capacity_m.map(|m| row("displacement capacity".to_owned(), m, "m")));
        if let Some(spectrum) = &self.spectrum {
            rows.push(row("zero stiffness, spectrum".to_owned(), spectrum.zero_stiffness_demand_m, "m"));
        }
        rows.extend(self.exact.iter().flat_map(|exact| demands(exact, at)));
        for (rule, check) in self.rules.iter().filter_map(|outcome| Some((outcome.rule.words(), outcome.check()?))) {
            rows.push(row(format!("demand by {rule}"), check.demand_m, "m"));
            rows.push(row(format!("required capacity by {rule}"), check.required_capacity_m, "m"));
            if check.capacity_m.is_finite() {
                rows.push(row(format!("margin by {rule}"), check.margin_m, "m"));
                rows.push(row(format!("safety factor by {rule}"), check.safety_factor, "1"));
            }
        }
        if let Some(exact) = self.exact.as_ref().filter(|_| self.structure.capacity_m.is_some()) {
            let [beyond, overturning] = [
                exact.bands.and_then(|bands| bands.beyond_capacity_per_year),
                exact.bands.and_then(|bands| bands.overturning_per_year),
            ];
            rows.extend(exact.beyond_capacity.iter().flat_map(|risk| rate("exceeding the capacity", risk, beyond, at)));
            rows.extend(rate("overturning", &exact.overturning, overturning, at));
        }
        rows.extend(uncertain(self.uncertainty.as_ref()));
        rows
    }
}

fn demands(exact: &ExactDemand, [site, im]: [&str; 2]) -> Vec<FindingRow> {
    let row = |what: &str, demand_m: f64| FindingRow::new(what, demand_m, "m").at(site, im);
    let own_m = exact.zero_stiffness_demand_m;
    let mut rows = vec![row("zero stiffness, exact", exact.zero_stiffness_demand_of_spectrum_m)];
    if own_m.to_bits() != exact.zero_stiffness_demand_of_spectrum_m.to_bits() {
        rows.push(row("zero stiffness, exact, uplift and impacts of the structure", own_m));
    }
    let demand_m = row("demand on the structure", exact.demand_m);
    rows.extend(banded(&demand_m, exact.bands.map(|bands| bands.demand_m)));
    if let Some(left_m) = exact.capacity_less_demand_m {
        let left_m = row("capacity less demand on the structure", left_m);
        rows.extend(banded(&left_m, exact.bands.and_then(|bands| bands.capacity_less_demand_m)));
    }
    rows
}
