//! The sentences at the head of a design sheet: the structure itself, where it is analysed, then the equivalent
//! oscillator.

use serde::Serialize;
use uplift::structure::{
    DemandBands, DesignReport, EventRisk, ExactDemand, OSCILLATOR, OwnReport, RuleOutcome, verdict_word,
};
use uplift::text::{risk_in_words, two_digits};
use uplift_spectra::Noisy;
use uplift_structure::{NO_CAPACITY, NO_CAPACITY_REASON};

use super::numbers::{chance, marked, power, rounding};

/// A sentence at the head of the sheet; `yes` or `no` where it is a verdict.
#[derive(Debug, Serialize)]
pub(super) struct Sentence {
    text: String,
    class: Option<&'static str>,
}

impl Sentence {
    fn plain(text: String) -> Self {
        Self { text, class: None }
    }

    fn verdict(text: String, satisfied: bool) -> Self {
        Self { text, class: Some(if satisfied { "yes" } else { "no" }) }
    }
}

/// Verdict, demand and risk, a sentence each.
pub(super) fn lead(report: &DesignReport) -> Vec<Sentence> {
    let mut sentences = Vec::new();
    if let Some(own) = &report.own {
        sentences.extend(own_sentences(report, own));
    }
    if let Some(reason) = &report.without_own {
        sentences.push(Sentence::plain(format!("The structure itself is not analysed: {reason}.")));
    }
    sentences.push(demand(report));
    sentences.extend(oscillator_verdicts(report));
    sentences.extend(report.verdicts_by_other_measures().into_iter().map(|(_, verdict)| {
        let (first, rest) = verdict.split_at(1);
        Sentence::verdict(format!("{}{rest}.", first.to_uppercase()), !verdict.contains("NOT"))
    }));
    if let Some(exact) = &report.exact {
        let rounding = rounding(report).map(|of| &of.overturning_per_year);
        let rate = rate("The equivalent oscillator overturns", &exact.overturning, rounding, report.years);
        sentences.push(Sentence::plain(rate + &band_of_overturning(exact.bands.as_ref())));
    }
    let uncertain = report.uncertainty.iter().flat_map(|uncertainty| &uncertainty.results);
    sentences.extend(uncertain.map(|result| Sentence::plain(format!("Uncertain oscillator, {}.", result.in_words()))));
    sentences
}

/// `At Athens, for 2 % in 50 years,`.
fn at(report: &DesignReport) -> String {
    format!("At {}, for {},", report.site, risk_in_words(report.poe, report.years))
}

/// The verdict on the structure itself, its demand, and how often it overturns.
fn own_sentences(report: &DesignReport, itself: &OwnReport) -> Vec<Sentence> {
    let (own, at) = (itself.decisive(), at(report));
    let model = own.model;
    let mut sentences = Vec::new();
    sentences.push(match own.check {
        None => Sentence::plain(format!("{at} the {model} has {NO_CAPACITY}: {NO_CAPACITY_REASON}.")),
        Some(check) if check.required_capacity_m.is_finite() => {
            let capacity = capacity(report).map_or_else(String::new, |capacity| format!("; it has {capacity}"));
            let (required, verdict) = (two_digits(check.required_capacity_m), report.verdict_of(check));
            let safety = report.required_safety_factor;
            let text = format!(
                "{at} the {model} requires a capacity of {required} m with a safety factor of \
                 {safety}{capacity}: {verdict}."
            );
            Sentence::verdict(text, check.satisfied)
        }
        Some(check) => {
            let verdict = verdict_word(check.satisfied);
            Sentence::verdict(
                format!("{at} the {model} overturns more often than the target: {verdict}."),
                check.satisfied,
            )
        }
    });
    if own.demand_m.is_finite() {
        let times = report
            .own_over_proxy()
            .map_or_else(String::new, |ratio| format!(", {ratio:.1} times that of its equivalent oscillator"));
        let differ = if report.verdicts_differ() == Some(true) { "; the verdicts differ" } else { "" };
        let (demand, band) = (two_digits(own.demand_m), band_of_demand(own.bands.as_ref()));
        sentences.push(Sentence::plain(format!("Its demand is {demand} m{band}{times}{differ}.")));
    }
    sentences.extend(unsafe_upper_limits(report, |whose| whose != OSCILLATOR));
    sentences.extend(beyond_tendon(report));
    if let Some((limit, beyond)) = itself.governing_limit().zip(own.beyond_limit) {
        let what = format!("The {model} passes its {}", limit.in_words());
        sentences.push(Sentence::plain(rate(&what, &beyond.risk, None, report.years)));
    }
    let rate = rate(&format!("The {model} overturns"), &own.overturning, None, report.years);
    sentences.push(Sentence::plain(rate + &band_of_overturning(own.bands.as_ref())));
    sentences
}

/// The demand on the equivalent oscillator.
fn demand(report: &DesignReport) -> Sentence {
    let is_second = report.own.is_some();
    let before = if is_second { "The".to_owned() } else { at(report) + " the" };
    // that of the structure itself is in its verdict
    let capacity = capacity(report).filter(|_| !is_second);
    let capacity = capacity.map_or_else(String::new, |capacity| format!("; the capacity is {capacity}"));
    match (&report.exact, &report.spectrum) {
        (Some(ExactDemand { overturns: true, .. }), _) => {
            Sentence::verdict(format!("{before} equivalent oscillator overturns more often than the target."), false)
        }
        (Some(exact), _) => {
            let demand = marked(exact.demand_m, rounding(report).map(|of| &of.demand_m), two_digits);
            let band = band_of_demand(exact.bands.as_ref());
            Sentence::plain(format!("{before} demand on the equivalent oscillator is {demand} m{band}{capacity}."))
        }
        (None, Some(spectrum)) => {
            let demand = two_digits(spectrum.zero_stiffness_demand_m);
            Sentence::plain(format!("{before} demand without stiffness after uplift is {demand} m{capacity}."))
        }
        (None, None) => Sentence::plain(format!("{} no demand.", at(report))),
    }
}

/// What the rules say of the equivalent oscillator, and its own demand where there is nothing else.
fn oscillator_verdicts(report: &DesignReport) -> Vec<Sentence> {
    let mut sentences = Vec::new();
    let safety = report.required_safety_factor;
    // the rule that asks for more is the one that counts
    let asked = report.rules.iter().filter_map(|outcome: &RuleOutcome| Some((outcome.rule, outcome.check()?)));
    if let Some((rule, check)) = asked.max_by(|a, b| a.1.required_capacity_m.total_cmp(&b.1.required_capacity_m)) {
        let rule = rule.words();
        if check.required_capacity_m.is_finite() && check.capacity_m.is_finite() {
            let required = two_digits(check.required_capacity_m);
            let verdict = verdict_word(check.satisfied);
            let sign = if check.margin_m < 0.0 { "−" } else { "+" };
            let margin = two_digits(check.margin_m.abs());
            let text = format!(
                "With a safety factor of {safety}, {rule} requires a capacity of {required} m of the oscillator: \
                 {verdict}, margin {sign}{margin} m."
            );
            sentences.push(Sentence::verdict(text, check.satisfied));
        } else if check.overturns {
            sentences.push(Sentence::verdict(format!("By {rule} the oscillator overturns."), false));
        }
    }
    if report.own.is_some() {
        sentences.extend(unsafe_upper_limits(report, |whose| whose == OSCILLATOR));
        return sentences;
    }
    if let Some(own) = report.own_check {
        let text = format!("By {}: {}.", own.in_words(safety), verdict_word(own.satisfied));
        sentences.push(Sentence::verdict(text, own.satisfied));
    }
    sentences.extend(unsafe_upper_limits(report, |_| true));
    sentences.extend(beyond_tendon(report));
    sentences
}

/// Whose demand is not satisfied at the upper limit of its band, of those whose name is `wanted`.
fn unsafe_upper_limits(report: &DesignReport, wanted: impl Fn(&str) -> bool) -> Vec<Sentence> {
    let article = if report.own.is_some() { "The" } else { "Its" };
    let limits = report.unsafe_upper_limits().into_iter().filter(|(whose, _)| wanted(whose));
    limits.map(|(whose, words)| Sentence::verdict(format!("{article} {whose} is {words}."), false)).collect()
}

fn beyond_tendon(report: &DesignReport) -> Option<Sentence> {
    Some(Sentence::verdict(format!("Its tendons: {}.", report.beyond_tendon()?), false))
}

/// `1.2 m`; none where the force does not fall.
fn capacity(report: &DesignReport) -> Option<String> {
    report.structure.capacity_m.map(|capacity_m| format!("{} m", two_digits(capacity_m)))
}

/// ` (90 % band 0.24 to 0.30 m)`; empty without one.
fn band_of_demand(bands: Option<&DemandBands>) -> String {
    bands.map_or_else(String::new, |bands| {
        let [lower_m, upper_m] = bands.demand_m.quoted().map(two_digits);
        format!(" (90 % band{} {lower_m} to {upper_m} m)", bands.demand_m.by_whom())
    })
}

/// ` 90 % band: 5.3·10⁻⁵ to 7.5·10⁻⁵ a year.`; empty without one.
fn band_of_overturning(bands: Option<&DemandBands>) -> String {
    bands.and_then(|bands| bands.overturning_per_year).map_or_else(String::new, |bands| {
        let shown = |per_year: f64| if per_year > 0.0 { power(per_year, 1) } else { "0".to_owned() };
        let [lower, upper] = bands.quoted().map(shown);
        format!(" 90 % band{}: {lower} to {upper} a year.", bands.by_whom())
    })
}

/// How often `what` happens, in a sentence.
fn rate(what: &str, risk: &EventRisk, rounding: Option<&Noisy>, years: f64) -> String {
    if risk.per_year == 0.0 {
        // a neighbour that overturns is in the note
        return risk.at_most_per_year.map_or_else(
            || format!("{what} in none of the analyses."),
            |most| format!("{what} in none of the analyses: at most {} a year.", power(most, 1)),
        );
    }
    let between = 1.0 / risk.per_year;
    format!(
        "{what} once in {} years on average ({} a year): {} in {years} years.",
        if between < 1e7 { two_digits(between) } else { power(between, 1) },
        marked(risk.per_year, rounding, |per_year| power(per_year, 1)),
        chance(risk.probability)
    )
}
