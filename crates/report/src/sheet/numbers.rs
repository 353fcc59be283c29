//! The numbers of a design sheet: as facts of the structure, and in tables.

use uplift::structure::{
    DemandRounding, DesignReport, EventRisk, OwnModel, RuleCheck, RuleOutcome, Sensitivity, StructureReport,
    WOBBLING_FRAME, verdict_word,
};
use uplift::study::Structure;
use uplift::text::{
    Table, metres_or_overturns, per_cent, relative_error_in_words, risk_in_words, rounded, share, two_digits,
};
use uplift_spectra::Noisy;
use uplift_structure::NO_CAPACITY_REASON;

use crate::page::TitledTable;

/// What rounding makes of the numbers; none where it was not asked.
pub(super) fn rounding(report: &DesignReport) -> Option<&DemandRounding> {
    Some(&report.exact.as_ref()?.sensitivity.as_ref()?.rounding)
}

/// The value as `shown`, with an asterisk where rounding shows it otherwise.
pub(super) fn marked(value: f64, rounding: Option<&Noisy>, shown: impl Fn(f64) -> String) -> String {
    rounding.map_or_else(|| shown(value), |rounding| rounding.marked(&shown))
}

/// Which numbers hang on rounding, and from where to where; none where none does.
pub(super) fn rounding_words(report: &DesignReport) -> Option<String> {
    let rounding = rounding(report)?;
    let mut moved = Vec::new();
    let mut tell = |what: &str, of: &Noisy, shown: fn(f64) -> String, unit: &str| {
        if of.shows_otherwise(shown) {
            moved.push(format!("{what}: {} to {}{unit}", shown(of.lowest), shown(of.highest)));
        }
    };
    tell("zero stiffness, exact", &rounding.zero_stiffness_demand_of_spectrum_m, metres_or_overturns, " m");
    tell(
        "zero stiffness with uplift and impacts of the structure",
        &rounding.zero_stiffness_demand_m,
        metres_or_overturns,
        " m",
    );
    tell("the equivalent oscillator", &rounding.demand_m, metres_or_overturns, " m");
    for outcome in &report.rules {
        if let Some(check) = &outcome.from_spectrum {
            tell(&format!("error of {}", outcome.rule.words()), &rounding.error_of(check.demand_m), relative, "");
        }
        if let Some(errors) = &rounding.rule_errors {
            let of = format!("error of {} from the exact demand", outcome.rule.words());
            tell(&of, &errors.by_rule(outcome.rule), relative, "");
        }
    }
    if let Some(of) = &rounding.beyond_capacity_per_year {
        tell("beyond its capacity", of, scientific, " a year");
    }
    tell("overturning", &rounding.overturning_per_year, scientific, " a year");
    let words = "*: the last digits are not significant (rounding); lowest to highest";
    (!moved.is_empty()).then(|| format!("{words}: {}", moved.join("; ")))
}

/// What kind of structure it is, in words.
pub(super) fn kind_name(structure: &StructureReport) -> String {
    structure.kind.replace('-', " ")
}

/// What the structure is, and what is equivalent to it: names and values.
pub(crate) fn facts(structure: &Structure, of: &StructureReport) -> Vec<(&'static str, String)> {
    let given = &structure.description;
    let mut facts = vec![("Kind", format!("{}, Table 3.1 row {}", kind_name(of), of.table_3_1_row))];
    let mut given_as = |name: &'static str, value: Option<f64>, unit: &str| {
        facts.extend(value.map(|value| (name, format!("{} {unit}", number(value)))));
    };
    if let Ok(geometry) = given.geometry() {
        given_as("Width 2b", Some(geometry.width_m()), "m");
        match given.centre_height_m {
            Some(centre_m) => given_as("Height of the mass h", Some(centre_m), "m"),
            None => given_as("Height 2h", Some(geometry.height_m()), "m"),
        }
        given_as("Slenderness α", Some(geometry.slenderness_rad()), "rad");
    }
    given_as("Columns", given.columns.map(f64::from), "");
    given_as("Mass", given.mass_kg, "kg");
    given_as("Moment of inertia", given.moment_of_inertia_kg_m2, "kg m²");
    given_as("Mass of a column", given.column_mass_kg, "kg");
    given_as("Mass of the deck", given.deck_mass_kg, "kg");
    given_as("Tendon stiffness, each", given.tendon_stiffness_n_m, "N/m");
    given_as("Radius of the ends", given.curvature_radius_m, "m");
    given_as("Width with extensions", given.extended_width_m, "m");
    given_as("Equivalent mass", Some(of.mass_kg), "kg");
    given_as("Force at uplift f_{up}", Some(of.uplift_force_n), "N");
    given_as("Uplift strength f_{up}/(m g)", Some(of.strength), "");
    given_as("Factor on the motion Γ", Some(of.participation), "");
    given_as("Strength of the spectrum", Some(of.spectral_strength), "");
    given_as("Uplift displacement u_{up}", Some(of.uplift_displacement_m), "m");
    given_as("Restitution", of.restitution, "");
    match of.capacity_m {
        Some(capacity_m) => given_as("Displacement capacity u_{cap}", Some(capacity_m), "m"),
        None => facts.push(("Displacement capacity u_{cap}", format!("none: {NO_CAPACITY_REASON}"))),
    }
    facts
}

/// The structure itself, then its equivalent oscillator: demands, rules, risk, and what of them is noise.
pub(super) fn tables(report: &DesignReport) -> Vec<TitledTable> {
    [itself(report), demands(report), rules(report), risk(report), noise(report)].into_iter().flatten().collect()
}

fn demands(report: &DesignReport) -> Option<TitledTable> {
    let mut rows = Vec::new();
    let mut row = |what: &str, demand: String| rows.push(vec![what.to_owned(), demand]);
    if let Some(spectrum) = &report.spectrum {
        row("without stiffness after uplift, from the spectrum", metres_or_overturns(spectrum.zero_stiffness_demand_m));
    }
    if let Some(exact) = &report.exact {
        let rounding = rounding(report);
        let (of_spectrum_m, zero_stiffness_m) =
            (exact.zero_stiffness_demand_of_spectrum_m, exact.zero_stiffness_demand_m);
        let of_spectrum = rounding.map(|of| &of.zero_stiffness_demand_of_spectrum_m);
        row("without stiffness after uplift, exact", marked(of_spectrum_m, of_spectrum, metres_or_overturns));
        let zero_stiffness = rounding.map(|of| &of.zero_stiffness_demand_m);
        let what = "the same with the uplift and impacts of the structure";
        row(what, marked(zero_stiffness_m, zero_stiffness, metres_or_overturns));
        row(
            "the equivalent oscillator, exact",
            marked(exact.demand_m, rounding.map(|of| &of.demand_m), metres_or_overturns),
        );
    }
    let note = format!(
        "{} by {}, {}: {} a year. Exact: from these records and levels.",
        report.site,
        report.spectrum_words(),
        risk_in_words(report.poe, report.years),
        power(report.target_per_year, 2)
    );
    let table = Table::new(["demand on", "displacement, m"], rows);
    TitledTable::new("demand", "Demand on the equivalent oscillator", note, table).unless_empty()
}

/// The structure itself, by each of its models.
fn itself(report: &DesignReport) -> Option<TitledTable> {
    let own = report.own.as_ref()?;
    let per_year = |risk: &EventRisk| match risk.at_most_per_year {
        Some(most) => format!("< {}", scientific(most)),
        None => scientific(risk.per_year),
    };
    let dash = || "–".to_owned();
    let table = Table::from_rows(&own.models)
        .left("model", |of| of.model)
        .right("demand, m", |of| metres_or_overturns(of.demand_m))
        .right("required capacity, m", |of| {
            of.check.map_or_else(dash, |check| metres_or_overturns(check.required_capacity_m))
        })
        .left("verdict", |of| of.check.map_or_else(dash, |check| report.verdict_of(check)))
        .right("beyond its capacity a year", |of| of.beyond_capacity.as_ref().map_or_else(dash, per_year))
        .right("overturning a year", |of| per_year(&of.overturning));
    let OwnModel { model, restitution, .. } = *own.decisive();
    let loses = match restitution {
        _ if model != WOBBLING_FRAME => format!("The restitution of the {model} is {}.", rounded(restitution, 4)),
        1.0 => format!("The wobbling model loses no energy; {PLANAR}."),
        kept => format!("The wobbling model keeps {kept} of its velocity past the upright; {PLANAR}."),
    };
    let note = format!("At {} levels. {loses}", own.levels.len());
    TitledTable::new(own.noun(), format!("The {}", own.noun()), note, table).unless_empty()
}

/// What the other model of a frame leaves out.
const PLANAR: &str = "the planar one is shaken by one component alone, which is unconservative (Section 6.2.3)";

fn rules(report: &DesignReport) -> Option<TitledTable> {
    let rounding = rounding(report);
    let marked = |outcome: &RuleOutcome, error: f64| {
        let range = rounding.and_then(|rounding| match &outcome.from_spectrum {
            Some(check) => Some(rounding.error_of(check.demand_m)),
            None => rounding.rule_errors.map(|errors| errors.by_rule(outcome.rule)),
        });
        range.map_or_else(|| relative(error), |range| range.marked(relative))
    };
    let error =
        |(of, check): (&RuleOutcome, &RuleCheck)| check.error.map_or_else(|| "–".to_owned(), |error| marked(of, error));
    let table = Table::from_rows(report.rules.iter().filter_map(|outcome| Some((outcome, outcome.check()?))))
        .left("rule", |(of, _)| of.rule.words())
        .right("demand, m", |(_, check)| metres_or_overturns(check.demand_m))
        .right("required capacity, m", |(_, check)| metres_or_overturns(check.required_capacity_m))
        .right("capacity, m", |(_, check)| if_finite(check.capacity_m, "∞", metres_or_overturns))
        .right("margin, m", |(_, check)| if_finite(check.margin_m, "–", |margin_m| format!("{margin_m:+.4}")))
        .right("safety factor", |(_, check)| if_finite(check.safety_factor, "–", |factor| format!("{factor:.2}")))
        .right("tendons for it, N/m", |(_, check)| {
            check.required_tendon_stiffness_n_m.map_or_else(|| "–".to_owned(), tendons)
        })
        .right("error of spectrum and rule", error)
        .right("verdict", |(_, check)| verdict_word(check.satisfied));
    let note = format!(
        "Required capacity: {} times the demand of a structure with just that capacity (Eq. 3.15). Error: the rule's \
         demand against the exact one; negative is unsafe.",
        report.required_safety_factor
    );
    TitledTable::new("rules", "Margin by the design rules", note, table).unless_empty()
}

fn risk(report: &DesignReport) -> Option<TitledTable> {
    let exact = report.exact.as_ref()?;
    let row = |what: String, risk: &EventRisk, rounding: Option<&Noisy>| {
        let mark = if rounding.is_some_and(|rounding| rounding.shows_otherwise(scientific)) { "*" } else { "" };
        let outside = share(risk.lower_tail_share + risk.upper_tail_share);
        if risk.per_year == 0.0 {
            // none of the runs does it: a bound, never never
            let most =
                risk.at_most_per_year.map_or_else(|| "none seen".to_owned(), |most| format!("< {}", scientific(most)));
            let most = format!("{most}{mark}");
            return vec![what, most, "–".to_owned(), "–".to_owned(), "–".to_owned()];
        }
        let probability = chance(risk.probability);
        let per_year = marked(risk.per_year, rounding, scientific);
        vec![what, per_year, probability, return_period(risk), outside]
    };
    let capacity_m = report.structure.capacity_m.unwrap_or(f64::NAN);
    let rounding = rounding(report);
    let of_beyond = rounding.and_then(|of| of.beyond_capacity_per_year.as_ref());
    let what = format!("beyond its capacity, {} m", metres_or_overturns(capacity_m));
    let beyond = exact.beyond_capacity.iter().map(|risk| row(what.clone(), risk, of_beyond));
    let overturning = row("overturning".to_owned(), &exact.overturning, rounding.map(|of| &of.overturning_per_year));
    let years = format!("in {} years", report.years);
    let header = ["equivalent oscillator", "per year", &years, "return period, years", "from outside the levels"];
    let note = "Counted over all records and levels, weighted by the hazard of the site (Eq. 4.4).";
    Some(TitledTable::new("risk", "Risk", note, Table::new(header, beyond.chain([overturning]))))
}

fn noise(report: &DesignReport) -> Option<TitledTable> {
    let Sensitivity { noise, rounding } = report.exact.as_ref()?.sensitivity.as_ref()?;
    let mut rows = Vec::new();
    let mut range = |what: &str, [of, rounding]: [&Noisy; 2], shown: fn(f64) -> String| {
        rows.push(vec![what.to_owned(), rounding.marked(shown), shown(of.lowest), shown(of.highest)]);
    };
    range("demand on the equivalent oscillator, m", [&noise.demand_m, &rounding.demand_m], metres_or_overturns);
    if let (Some(of), Some(rounding)) = (&noise.rule_errors, &rounding.rule_errors) {
        range("own error of equal displacement", [&of.equal_displacement, &rounding.equal_displacement], relative);
        range("own error of equal energy", [&of.equal_energy, &rounding.equal_energy], relative);
    }
    if let (Some(of), Some(rounding)) = (&noise.beyond_capacity_per_year, &rounding.beyond_capacity_per_year) {
        range("beyond its capacity, per year", [of, rounding], counted);
    }
    range("overturning, per year", [&noise.overturning_per_year, &rounding.overturning_per_year], counted);
    let note = "Range over ten structures whose strength is up to 1 % lower or higher: smaller differences are not \
                significant. The own error of a rule starts from the exact demand without stiffness after uplift.";
    let table = Table::new(["within 1 % of the strength", "here", "lowest", "highest"], rows);
    TitledTable::new("noise", "Sensitivity to the strength", note, table).unless_empty()
}

fn if_finite(value: f64, otherwise: &str, shown: fn(f64) -> String) -> String {
    if value.is_finite() { shown(value) } else { otherwise.to_owned() }
}

fn relative(error: f64) -> String {
    if error.is_nan() { "–".to_owned() } else { relative_error_in_words(error) }
}

/// A probability in per cent, two digits of it unless they say that it is certain.
pub(super) fn chance(probability: f64) -> String {
    let short = two_digits(100.0 * probability);
    if short == "100" { per_cent(probability) } else { format!("{short} %") }
}

/// Years between two events on average, two digits of them.
fn return_period(risk: &EventRisk) -> String {
    let years = 1.0 / risk.per_year;
    if years < 1e7 { two_digits(years) } else { format!("{years:.1e}") }
}

/// A rate as programs and spreadsheets read it.
fn scientific(value: f64) -> String {
    format!("{value:.3e}")
}

/// Stiffness of a tendon, N/m; none is needed where the capacity is there without.
fn tendons(stiffness_n_m: f64) -> String {
    if stiffness_n_m > 0.0 { scientific(stiffness_n_m) } else { "none".to_owned() }
}

/// A rate that was counted: none of the runs is not never.
fn counted(per_year: f64) -> String {
    if per_year == 0.0 { "none seen".to_owned() } else { scientific(per_year) }
}

/// A factor of so many decimals times a power of ten, which is raised.
pub(super) fn power(value: f64, decimals: usize) -> String {
    let written = format!("{value:.decimals$e}");
    let (factor, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    format!("{factor}·10^{{{}}}", exponent.replace('-', "−"))
}

/// Five digits, and a power of ten where the number is very large or small.
fn number(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e7).contains(&value.abs()) {
        return power(value, 3);
    }
    let digits_before = format!("{:.0}", value.abs().trunc()).len();
    let text = format!("{value:.0$}", 5_usize.saturating_sub(digits_before));
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
