//! The answers of design, overturning, target and risk as a result keeps them: numbers with a name and a unit, in one
//! form for all.

mod keep;

use serde::Serialize;
use uplift_ida::OSCILLATOR;
use uplift_job::JobError;
use uplift_job::text::spectrum_words;
use uplift_result::{Finding, FindingRow, Inquiry};
use uplift_study::Structure;
use uplift_uniform_risk::EventRisk;

use super::certainty::Bands;
use super::demand::ExactDemand;
use super::design::DesignReport;
use super::frame_risk::{FrameRiskReport, ModelDemand};
use super::limit::{FrameLimit, LimitEvent, LimitRisk};
use super::overturning::{CollapseReport, OverturningOptions, OverturningReport};
use super::own_structure::OwnModel;
use super::report::ReportSource;
use super::target::{TargetBand, TargetOptions, TargetReport};
use super::uncertain::{AleatoryResult, EpistemicResult, UncertainFinding, UncertaintyReport};
use crate::error::DesignError;
pub use keep::keep;

/// The answer to a question about `structure` under the result of `source`; `report` is what `--json` prints.
fn answered(
    (inquiry, structure, source): (Inquiry, &Structure, &ReportSource),
    request: Vec<(&str, String)>,
    rows: Vec<FindingRow>,
    report: &impl Serialize,
) -> Result<Finding, DesignError> {
    let document = serde_json::to_string(report)
        .map_err(|error| JobError::input(format!("the answer cannot be written as JSON: {error}")))?;
    Ok(Finding {
        structure: structure.name(),
        structure_file: structure.file.display().to_string(),
        structure_toml: structure.text.clone(),
        inquiry,
        request: request.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        study_digest: source.study_digest.clone(),
        rows,
        document,
    })
}

/// What an answer is by that leaves the structure itself out.
const OSCILLATOR_ALONE: &str = "its oscillator alone";
/// What a structure with a capacity does.
const EXCEEDING: &str = "exceeding the capacity";

/// A number with its band as the records tell it, and again with those of their earthquakes and of the hazard's curves
/// where these are known.
fn banded(row: &FindingRow, bands: Option<Bands>) -> Vec<FindingRow> {
    let Some(bands) = bands else { return vec![row.clone()] };
    let told = bands.each().into_iter().zip(bands.words());
    told.filter_map(|(limits, of)| Some(row.clone().within(limits?, of))).collect()
}

/// How often something happens, 1/yr, with its bands; where no run shows it, what it is at most.
fn rate(what: &str, risk: &EventRisk, bands: Option<Bands>, [site, im]: [&str; 2]) -> Vec<FindingRow> {
    let row = FindingRow::new(what, risk.per_year, "1/yr").at(site, im);
    if let Some(bound) = risk.at_most_per_year {
        return vec![row.within([f64::NAN, bound], "at most")];
    }
    banded(&row, bands)
}

/// What follows for a structure that is not known exactly.
fn uncertain(report: Option<&UncertaintyReport>) -> Vec<FindingRow> {
    let mut rows = Vec::new();
    for result in report.into_iter().flat_map(|report| &report.results) {
        let row = |value: f64| {
            let what = format!("{}, structure not known exactly", result.of);
            FindingRow::new(what, value, result.unit).at(&result.site, result.im)
        };
        if let Some(bound) = result.found.at_most_per_year() {
            rows.push(row(result.found.mean()).within([f64::NAN, bound], "at most"));
            continue;
        }
        match &result.found {
            UncertainFinding::Epistemic(EpistemicResult { by_structure, by_all, .. }) => {
                for (spread, band) in [(by_structure, "structure"), (by_all, "structure, records and hazard")] {
                    let [lower, .., upper] = spread.percentiles;
                    rows.push(row(spread.mean).within([lower, upper], band));
                }
            }
            &UncertainFinding::Aleatory(AleatoryResult { value, by_record, by_earthquake, with_hazard, .. }) => {
                let bands = by_record.map(|by_record| Bands { by_record, by_earthquake, with_hazard });
                rows.extend(banded(&row(value), bands));
            }
        }
    }
    rows
}

impl DesignReport {
    /// The demand on `structure`, its rules and risks, as a result keeps them.
    ///
    /// # Errors
    /// None for the reports of this program.
    pub fn finding(&self, structure: &Structure) -> Result<Finding, DesignError> {
        let analysed = match (&self.own, &self.exact) {
            (Some(_), _) => "its own analysis",
            (None, Some(_)) => "its oscillator",
            (None, None) => "the spectrum alone",
        };
        let request = vec![
            ("site", self.site.clone()),
            ("measure", self.spectrum_words()),
            ("poe", self.poe.to_string()),
            ("years", self.years.to_string()),
            ("safety factor", self.required_safety_factor.to_string()),
            ("by", analysed.to_owned()),
        ];
        answered((Inquiry::Design, structure, &self.source), request, self.finding_rows(), self)
    }

    fn finding_rows(&self) -> Vec<FindingRow> {
        let at = [self.site.as_str(), self.im];
        let row = |what: String, value: f64, unit: &str| FindingRow::new(what, value, unit).at(at[0], at[1]);
        let mut rows = vec![row("strength of the spectrum".to_owned(), self.structure.spectral_strength, "1")];
        rows.extend(self.structure.capacity_m.map(|m| row("displacement capacity".to_owned(), m, "m")));
        if let Some(spectrum) = &self.spectrum {
            rows.push(row("zero stiffness, spectrum".to_owned(), spectrum.zero_stiffness_demand_m, "m"));
        }
        // beside the structure itself its oscillator has demand and overturning; all else is in the document
        let is_alone = self.own.is_none();
        rows.extend(self.exact.iter().flat_map(|exact| exact_demands(exact, at, is_alone)));
        for (rule, check) in self.rules.iter().filter_map(|outcome| Some((outcome.rule.words(), outcome.check()?))) {
            rows.push(row(format!("demand by {rule}"), check.demand_m, "m"));
            rows.push(row(format!("required capacity by {rule}"), check.required_capacity_m, "m"));
            if check.capacity_m.is_finite() && check.demand_m.is_finite() {
                rows.push(row(format!("margin by {rule}"), check.margin_m, "m"));
                rows.push(row(format!("safety factor by {rule}"), check.safety_factor, "1"));
            }
        }
        let times = format!("{} times the demand", self.required_safety_factor);
        rows.extend(self.own_check.filter(|_| is_alone).map(|own| row(times, own.required_capacity_m, "m")));
        if let Some(exact) = self.exact.as_ref().filter(|_| self.structure.capacity_m.is_some()) {
            let [beyond, overturning] = [
                exact.bands.and_then(|bands| bands.beyond_capacity_per_year),
                exact.bands.and_then(|bands| bands.overturning_per_year),
            ];
            let exceeding = exact.beyond_capacity.iter().filter(|_| is_alone);
            rows.extend(exceeding.flat_map(|risk| rate(EXCEEDING, risk, beyond, at)));
            let what = if is_alone { "overturning".to_owned() } else { format!("overturning, {OSCILLATOR}") };
            rows.extend(rate(&what, &exact.overturning, overturning, at));
        }
        if let Some(own) = &self.own {
            // the capacity has its row in any case
            let limit = own.limit_of_tendons();
            rows.extend(own.models.iter().flat_map(|model| own_rows(model, limit, at)));
        }
        rows.extend(uncertain(self.uncertainty.as_ref()));
        rows
    }
}

/// Demand, required capacity and risks of a structure itself by one of its models.
fn own_rows(of: &OwnModel, limit: Option<FrameLimit>, at: [&str; 2]) -> Vec<FindingRow> {
    let row = |what: &str, value: f64| FindingRow::new(format!("{what}, {}", of.model), value, "m").at(at[0], at[1]);
    let mut rows = banded(&row("demand", of.demand_m), of.bands.map(|bands| bands.demand_m));
    rows.extend(of.check.map(|check| row("required capacity", check.required_capacity_m)));
    let what = |event: &str| format!("{event}, {}", of.model);
    let beyond = of.bands.and_then(|bands| bands.beyond_capacity_per_year);
    rows.extend(of.beyond_capacity.iter().flat_map(|risk| rate(&what(EXCEEDING), risk, beyond, at)));
    rows.extend(beyond_limit(limit, of.beyond_limit.as_ref(), of.model, at));
    let overturning = of.bands.and_then(|bands| bands.overturning_per_year);
    rows.extend(rate(&what("overturning"), &of.overturning, overturning, at));
    rows
}

/// The demand on the structure's own oscillator, and what is left of its capacity where that stands alone.
fn exact_demands(exact: &ExactDemand, [site, im]: [&str; 2], is_alone: bool) -> Vec<FindingRow> {
    let row = |what: &str, demand_m: f64| FindingRow::new(what, demand_m, "m").at(site, im);
    let own_m = exact.zero_stiffness_demand_m;
    let mut rows = vec![row("zero stiffness, exact", exact.zero_stiffness_demand_of_spectrum_m)];
    if own_m.to_bits() != exact.zero_stiffness_demand_of_spectrum_m.to_bits() {
        rows.push(row("zero stiffness, exact, of the structure", own_m));
    }
    let demand_m = row("demand, oscillator", exact.demand_m);
    rows.extend(banded(&demand_m, exact.bands.map(|bands| bands.demand_m)));
    if let Some(left_m) = exact.capacity_less_demand_m.filter(|_| is_alone) {
        let left_m = row("capacity less demand, oscillator", left_m);
        rows.extend(banded(&left_m, exact.bands.and_then(|bands| bands.capacity_less_demand_m)));
    }
    rows
}

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
        request.extend(options.proxy.then(|| ("by", OSCILLATOR_ALONE.to_owned())));
        let mut rows: Vec<FindingRow> =
            self.overturning.iter().flat_map(|found| overturning_risks(found, self.limit)).collect();
        rows.extend(self.overturning.iter().flat_map(fragility));
        rows.extend(uncertain(self.uncertainty.as_ref()));
        answered((Inquiry::Overturning, structure, &self.source), request, rows, self)
    }
}

/// How often a structure passes its limit by the `model`.
fn beyond_limit(limit: Option<FrameLimit>, beyond: Option<&LimitRisk>, model: &str, at: [&str; 2]) -> Vec<FindingRow> {
    let (Some(limit), Some(beyond)) = (limit, beyond) else { return Vec::new() };
    let event = if limit.event == LimitEvent::Capacity { EXCEEDING } else { limit.event.words() };
    rate(&format!("{event}, {model}"), &beyond.risk, beyond.bands, at)
}

/// The risk at each site.
fn overturning_risks(found: &CollapseReport, limit: Option<FrameLimit>) -> Vec<FindingRow> {
    let mut rows = Vec::new();
    for of in &found.sites {
        let (what, at) = (format!("overturning, {}", found.model), [of.site.as_str(), found.im]);
        rows.extend(rate(&what, &of.risk, of.bands, at));
        rows.extend(beyond_limit(limit, of.beyond_limit.as_ref(), found.model, at));
        rows.extend(
            of.repaired.iter().flat_map(|risk| rate(&format!("{what}, repaired"), risk, of.repaired_bands, at)),
        );
        let row = |rate| FindingRow::new(format!("{what}, lognormal"), rate, "1/yr").at(at[0], at[1]);
        rows.extend(of.lognormal_per_year.iter().flat_map(|rate| banded(&row(*rate), of.lognormal_bands)));
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

impl TargetReport {
    /// The value that was found for `structure`, its band and every crossing, as a result keeps them.
    ///
    /// # Errors
    /// None for the reports of this program.
    pub fn finding(&self, structure: &Structure, options: &TargetOptions) -> Result<Finding, DesignError> {
        let mut request = vec![
            ("site", self.site.clone()),
            ("measure", spectrum_words(self.im, self.repaired)),
            ("vary", self.quantity.to_owned()),
            ("event", self.event.clone()),
            ("per year", self.target_per_year.to_string()),
            ("years", self.years.to_string()),
        ];
        request.extend(options.proxy.then(|| ("by", OSCILLATOR_ALONE.to_owned())));
        request.extend(options.from.map(|from| ("from", from.to_string())));
        request.extend(options.to.map(|to| ("to", to.to_string())));
        request.push(("tolerance", options.tolerance.to_string()));
        let periods: Vec<String> = options.return_periods.iter().map(ToString::to_string).collect();
        request.push(("at", periods.join(", ")));
        request.extend(
            options.generic().map(|(dispersion, probability)| ("generic", format!("{dispersion}, {probability}"))),
        );
        answered((Inquiry::Target, structure, &self.source), request, self.finding_rows(), self)
    }

    fn finding_rows(&self) -> Vec<FindingRow> {
        let row = |what: String, value: f64, unit: &str| FindingRow::new(what, value, unit).at(&self.site, self.im);
        let of_quantity = |what: String, value: f64| row(what, value, self.quantity_unit);
        let quantity = self.quantity;
        let least = of_quantity(format!("least {quantity} that meets the target"), self.value);
        let of_bands = |row: &FindingRow, limits: fn(&TargetBand) -> [f64; 2]| -> Vec<FindingRow> {
            let banded = |band: &TargetBand| row.clone().within(limits(band), &band.of);
            if self.bands.is_empty() { vec![row.clone()] } else { self.bands.iter().map(banded).collect() }
        };
        let mut rows = vec![of_quantity(format!("safe {quantity}"), self.safe_value)];
        rows.extend(of_bands(&least, |band| band.value));
        rows.push(of_quantity(format!("{quantity} that misses it"), self.missed_at));
        rows.extend(self.own_value.map(|own| of_quantity(format!("{quantity} of the structure"), own)));
        rows.extend(self.crossings.iter().map(|crossing| {
            let becomes = if crossing.becomes_met { "met" } else { "missed" };
            of_quantity(format!("target {becomes} from here on, {quantity}"), crossing.to)
        }));
        let there = row(format!("{} at the value found", self.event), self.risk.per_year, "1/yr");
        match self.risk.at_most_per_year {
            // of what no run shows there is a bound, and no band
            Some(bound) => rows.push(there.within([f64::NAN, bound], "at most")),
            None => rows.extend(of_bands(&there, |band| band.per_year)),
        }
        let at = if self.safe_value.is_finite() { "safe value" } else { "value found" };
        for other in &self.by_other_measures {
            rows.extend(rate(&format!("{} at the {at}", self.event), &other.risk, None, [&self.site, other.im]));
        }
        if let Some(own) = &self.own {
            rows.push(of_quantity(format!("safe {quantity}, {}", own.decisive().model), own.safe_value));
            let what = |model: &str| format!("{} at {quantity} {}, {model}", self.event, own.value);
            let at = [self.site.as_str(), self.im];
            rows.extend(own.models.iter().flat_map(|own| rate(&what(own.model), &own.risk, own.bands, at)));
        }
        let by_structure = self.uncertainty.as_ref().and_then(|of| of.by_structure);
        rows.extend(by_structure.map(|[lower, _, upper]| least.within([lower, upper], "structure")));
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

/// What the bands of errors are of.
const RESAMPLED: &str = "resampled records";

impl FrameRiskReport {
    /// The demand on the frame of `structure` and its proxies, and how often what happens to it, as a result keeps
    /// them.
    ///
    /// # Errors
    /// None for the reports of this program.
    pub fn finding(&self, structure: &Structure) -> Result<Finding, DesignError> {
        let request = vec![
            ("site", self.site.clone()),
            ("measure", self.im.to_owned()),
            ("poe", self.poe.to_string()),
            ("years", self.years.to_string()),
            ("model", self.demands.first().map_or("", |frame| frame.model).to_owned()),
        ];
        let at = [self.site.as_str(), self.im];
        let mut rows: Vec<FindingRow> = self.demands.iter().flat_map(|demand| model_demands(demand, at)).collect();
        for event in &self.events {
            rows.extend(rate(event.event.words(), &event.risk, None, at));
        }
        let found = &self.overturning;
        rows.extend(rate("overturning", &found.risk, None, at));
        rows.extend(found.repaired.iter().flat_map(|risk| rate("overturning, repaired", risk, None, at)));
        let row = |rate| FindingRow::new("overturning, lognormal", rate, "1/yr").at(at[0], at[1]);
        rows.extend(found.lognormal_per_year.iter().flat_map(|rate| banded(&row(*rate), found.lognormal_bands)));
        answered((Inquiry::Risk, structure, &self.source), request, rows, self)
    }
}

fn model_demands(of: &ModelDemand, [site, im]: [&str; 2]) -> Vec<FindingRow> {
    let row = |what: &str, value: f64, unit: &str| FindingRow::new(format!("{what}, {}", of.model), value, unit);
    let demand = row("demand", of.demand_m.value, "m");
    let limits_m = [of.demand_m.lower, of.demand_m.upper];
    let demand = match of.band_of {
        Some(source) => demand.within(limits_m, source),
        None => demand,
    };
    let repaired = of.repaired_m.map(|demand_m| row("demand, repaired", demand_m, "m"));
    let error = of.error.map(|of| row("error", of.value, "1").within([of.lower, of.upper], RESAMPLED));
    [Some(demand), repaired, error].into_iter().flatten().map(|row| row.at(site, im)).collect()
}
