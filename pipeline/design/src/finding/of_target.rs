//! The answer of a search for a target risk.

use uplift_result::{Finding, FindingRow, Inquiry};
use uplift_study::Structure;

use super::super::{TargetOptions, TargetReport};
use super::Question;
use crate::error::DesignError;

impl TargetReport {
    /// The value that was found for `structure`, its band and every crossing, as a result keeps them.
    ///
    /// # Errors
    /// None for the reports of this program.
    pub fn finding(&self, structure: &Structure, options: &TargetOptions) -> Result<Finding, DesignError> {
        let mut request = vec![
            ("site", self.site.clone()),
            ("measure", self.im.to_owned()),
            ("vary", self.quantity.to_owned()),
            ("event", self.event.clone()),
            ("per year", self.target_per_year.to_string()),
            ("years", self.years.to_string()),
        ];
        request.extend(options.from.map(|from| ("from", from.to_string())));
        request.extend(options.to.map(|to| ("to", to.to_string())));
        request.push(("tolerance", options.tolerance.to_string()));
        let periods: Vec<String> = options.return_periods.iter().map(ToString::to_string).collect();
        request.push(("at", periods.join(", ")));
        request.extend(
            options.generic.map(|(dispersion, probability)| ("generic", format!("{dispersion}, {probability}"))),
        );
        let question = Question { inquiry: Inquiry::Target, structure, study_digest: &self.study_digest, request };
        question.answered(self.finding_rows(), self)
    }

    fn finding_rows(&self) -> Vec<FindingRow> {
        let row = |what: String, value: f64, unit: &str| FindingRow::new(what, value, unit).at(&self.site, self.im);
        let of_quantity = |what: String, value: f64| row(what, value, self.quantity_unit);
        let resampled = self.band.drawn.words();
        let [lower, _, upper] = self.band.value;
        let quantity = self.quantity;
        let mut rows = vec![
            of_quantity(format!("least {quantity} that meets the target"), self.value)
                .within([lower, upper], &resampled),
            of_quantity(format!("{quantity} that misses it"), self.missed_at),
        ];
        rows.extend(self.own_value.map(|own| of_quantity(format!("{quantity} of the structure"), own)));
        rows.extend(self.crossings.iter().map(|crossing| {
            let becomes = if crossing.becomes_met { "met" } else { "missed" };
            of_quantity(format!("target {becomes} from here on, {quantity}"), crossing.to)
        }));
        let [lower, _, upper] = self.band.per_year;
        let there = row(format!("{} at the value found", self.event), self.risk.per_year, "1/yr");
        rows.push(match self.risk.at_most_per_year {
            Some(bound) => there.clone().within([f64::NAN, bound], "at most"),
            None => there.clone().within([lower, upper], &resampled),
        });
        // hazard curves or structures drawn too: other bands of the same numbers
        let uncertain = self.uncertainty.iter().flat_map(|of| [&of.by_structure, &of.by_all]).flatten();
        for band in self.band_with_hazard.iter().chain(uncertain) {
            let [lower, _, upper] = band.value;
            let least = of_quantity(format!("least {quantity} that meets the target"), self.value);
            rows.push(least.within([lower, upper], &band.drawn.words()));
            // of what no run shows there is a bound, and no band
            if self.risk.at_most_per_year.is_none() {
                let [lower, _, upper] = band.per_year;
                rows.push(there.clone().within([lower, upper], &band.drawn.words()));
            }
        }
        rows.push(row("strength of the spectrum at the value found".to_owned(), self.found.spectral_strength, "1"));
        rows.extend(self.found.capacity_m.map(|m| row("displacement capacity at the value found".to_owned(), m, "m")));
        rows.extend(self.at_return_periods.iter().map(|of| {
            row(format!("{} at the level of {} years", self.event, of.return_period_years), of.probability, "1")
        }));
        if let Some(generic) = &self.generic {
            rows.push(row("level of the generic fragility".to_owned(), generic.level, self.im_unit));
            rows.extend(generic.risk_coefficient.map(|of| row("risk coefficient".to_owned(), of, "1")));
        }
        rows
    }
}
