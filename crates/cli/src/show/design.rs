//! A design as an engineer reads it.

mod own;

use std::io::Write;

use uplift::structure::{
    Bands, DemandBands, DemandRounding, DesignReport, EventRisk, ExactDemand, LimitRisk, OwnReport, RuleCheck,
    RuleOutcome, Sensitivity, verdict_word,
};
use uplift::text::{
    self, Table, metres_or_overturns, metres_with_band, relative_error_in_words, risk_in_words, short, two_digits,
};
use uplift_spectra::Noisy;
use uplift_structure::{NO_CAPACITY, NO_CAPACITY_REASON, Rule};

use self::own::{print_assumed, print_mark, print_own_spectrum, print_unread, print_verdicts, rule_cell};
use super::alarms::{is_doubted, print_in_parts};
use super::shown_path;
use super::structure::{
    BLOCK, band_after, demand_in_words, doubt, fewer_levels, print_moved, print_notes, print_structure, rate,
    record_set, restitution_line, risk_cells,
};
use super::uncertainty::{print_uncertain_answers, print_uncertainty};
use crate::error::CommandError;
use crate::terminal::Terminal;

/// The verdict, demand and risk; in detail structure, rules, and what of the numbers is noise.
pub(crate) fn print_design(report: &DesignReport, terminal: &Terminal) -> Result<(), CommandError> {
    print_in_parts(report, (print_answer, print_details), (&report.alarms, &report.source.result), terminal)
}

/// What an engineer asks first.
fn print_answer(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    match &report.own {
        Some(own) => print_verdicts(out, report, own)?,
        None => print_verdict(out, report)?,
    }
    if let Some(reason) = &report.without_own {
        writeln!(out, "Itself    not analysed: {reason}")?;
    }
    if let Some(uncertainty) = &report.uncertainty {
        print_uncertain_answers(out, uncertainty)?;
    }
    let risk = risk_in_words(report.poe, report.years);
    let in_space = report.own.as_ref().is_some_and(OwnReport::wobbles);
    let records = record_set(&report.source.record_set, in_space);
    let at = match &report.own {
        // by which measure stands in the first line, which is of the structure itself
        Some(own) => {
            let levels = fewer_levels([(own.levels.len(), own.levels_of_study, report.im)]);
            format!("{}, {risk}{levels}", report.site)
        }
        None => format!("{} by {}, {risk}", report.site, report.spectrum_words()),
    };
    writeln!(out, "At        {at}; {records}")?;
    if let Some(hazard) = report.source.hazard_of_repair(report.repaired, &report.site, report.im) {
        writeln!(out, "Hazard    {hazard}")?;
    }
    Ok(())
}

/// The verdict of the rules, with the demand on the structure's oscillator and its risks.
fn print_verdict(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    let name = &report.structure.name;
    let has = report.capacity_words().unwrap_or_else(|| format!("{NO_CAPACITY}: {NO_CAPACITY_REASON}"));
    let whose = if report.by_proxy { ", by its oscillator alone" } else { "" };
    let doubt = doubt(&report.alarms);
    writeln!(out, "Verdict   {name}{whose}, {has}: {doubt}{}", report.verdict())?;
    if let Some(verdicts) = report.verdicts() {
        writeln!(out, "          {verdicts}")?;
    }
    print_unread(out, report)?;
    let unsafe_upper_limits = report.unsafe_upper_limits().into_iter().map(|(_, verdict)| verdict);
    let by_others = report.verdicts_by_other_measures().into_iter().map(|(_, verdict)| verdict);
    for verdict in unsafe_upper_limits.chain(report.beyond_tendon()).chain(by_others) {
        writeln!(out, "          {verdict}")?;
    }
    // the notes begin with what the structure and the spectrum do not have in common
    if let Some(difference) = report.notes.first().filter(|_| report.other_oscillator) {
        writeln!(out, "          {difference}")?;
    }
    print_own_spectrum(out, report)?;
    print_assumed(out, report)?;
    if let Some(exact) = &report.exact {
        let bands = exact.bands.as_ref();
        let by_whom = bands.map_or("", |bands| bands.demand_m.by_whom());
        let demand = demand_in_words(exact.demand_m, bands.map(|bands| bands.demand_m.quoted()), by_whom);
        let whose = match report.structure.restitution {
            Some(restitution) if report.structure.kind == BLOCK => {
                format!("the equivalent oscillator, restitution {restitution}")
            }
            _ => "the equivalent oscillator".to_owned(),
        };
        let uplift_m = report.structure.uplift_displacement_m;
        let rests = if exact.demand_m < uplift_m {
            format!(", below its uplift at {} m: at this risk it does not rock", two_digits(uplift_m))
        } else {
            String::new()
        };
        writeln!(out, "Demand    {demand} on {whose}{rests}")?;
        if let Some(risk) = &exact.beyond_capacity {
            let [beyond, ..] = risk_cells(risk);
            let [overturning, ..] = risk_cells(&exact.overturning);
            writeln!(
                out,
                "Rate      capacity exceeded {beyond} per year{}",
                band_after(bands.and_then(|of| of.beyond_capacity_per_year))
            )?;
            writeln!(
                out,
                "          overturning {overturning} per year{}",
                band_after(bands.and_then(|of| of.overturning_per_year))
            )?;
        }
    } else if let Some(spectrum) = &report.spectrum {
        let demand = metres_with_band(spectrum.zero_stiffness_demand_m, None);
        writeln!(out, "Demand    {demand} by the spectrum at strength {:.4}", spectrum.strength)?;
    }
    Ok(())
}

fn print_details(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    print_structure(out, &report.structure)?;
    for of in report.own_models() {
        writeln!(out, "{}", restitution_line(of.model, of.restitution))?;
    }
    writeln!(
        out,
        "demand     {} by {}, {}: {} per year",
        report.site,
        report.spectrum_words(),
        risk_in_words(report.poe, report.years),
        text::rate(report.target_per_year)
    )?;
    writeln!(out, "           {}, {}", shown_path(&report.source.result).display(), report.source.record_set)?;
    if report.own.is_some() {
        print_own_spectrum(out, report)?;
    }
    print_notes(out, &report.notes)?;
    print_demands(out, report)?;
    print_rules(out, report)?;
    if let Some(exact) = &report.exact {
        print_risk(out, report, exact)?;
        if let Some(sensitivity) = &exact.sensitivity {
            print_noise(out, &report.rules, sensitivity)?;
            print_rounding(out, &report.rules, &sensitivity.rounding)?;
        }
    }
    if let Some(uncertainty) = &report.uncertainty {
        print_uncertainty(out, uncertainty)?;
    }
    Ok(())
}

/// Displacements of the structure, from the spectrum and exact.
fn print_demands(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    let factor = report.structure.participation;
    let mut rows = Vec::new();
    let mut row = |what: String, demand_m: f64, rounding: Option<&Noisy>| {
        let shown =
            rounding.map_or_else(|| metres_or_overturns(demand_m), |rounding| rounding.marked(metres_or_overturns));
        rows.push(vec![what, metres_or_overturns(demand_m / factor), shown]);
    };
    if let Some(spectrum) = &report.spectrum {
        let (a, b) = spectrum.between_strengths;
        let between = if a < b { format!(", between {a:.4} and {b:.4}") } else { String::new() };
        let what = format!("zero stiffness, spectrum at strength {:.4}{between}", spectrum.strength);
        row(what, spectrum.zero_stiffness_demand_m, None);
    }
    if let Some(exact) = &report.exact {
        let (of_spectrum_m, own_m) = (exact.zero_stiffness_demand_of_spectrum_m, exact.zero_stiffness_demand_m);
        let rounding = exact.sensitivity.as_ref().map(|of| &of.rounding);
        let of_spectrum = rounding.map(|of| &of.zero_stiffness_demand_of_spectrum_m);
        row("zero stiffness, exact".to_owned(), of_spectrum_m, of_spectrum);
        if own_m.to_bits() != of_spectrum_m.to_bits() {
            let what = "zero stiffness, exact, uplift and impacts of the structure".to_owned();
            row(what, own_m, rounding.map(|of| &of.zero_stiffness_demand_m));
        }
        row("the structure's oscillator, exact".to_owned(), exact.demand_m, rounding.map(|of| &of.demand_m));
    }
    for model in report.own_models() {
        rows.push(vec![format!("{} itself", model.model), "-".to_owned(), metres_or_overturns(model.demand_m)]);
    }
    if rows.is_empty() {
        writeln!(out, "\nThere is no demand to show.")?;
        return Ok(());
    }
    let header = ["demand".to_owned(), "oscillator, m".to_owned(), format!("times {factor:.4}, m")];
    writeln!(out, "\n{}", Table::new(header, rows))?;
    Ok(())
}

fn print_rules(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    if report.rules.is_empty() {
        writeln!(
            out,
            "\nThe rules of equal displacement and equal energy do not apply: {NO_CAPACITY}. The demand on the \
             oscillator\nis the one above."
        )?;
        return Ok(());
    }
    if let Some(Sensitivity { rounding, .. }) = report.exact.as_ref().and_then(|exact| exact.sensitivity.as_ref()) {
        let dash = || "-".to_owned();
        let exact_demand = |of: &RuleOutcome, check: &RuleCheck| match rounding.rule_demands_m {
            Some(demands) => demands.by_rule(of.rule).marked(metres_or_overturns),
            None => metres_or_overturns(check.demand_m),
        };
        let error = |of: &RuleOutcome| {
            rounding.rule_errors.map(|errors| errors.by_rule(of.rule).marked(relative_error_in_words))
        };
        let spectral = |of: &RuleOutcome, shown: &dyn Fn(f64) -> String| {
            of.from_spectrum.as_ref().map_or_else(dash, |check| shown(check.demand_m))
        };
        let table = Table::from_rows(&report.rules)
            .left("rule", |of| of.rule.words())
            .right("from the spectrum, m", |of| spectral(of, &metres_or_overturns))
            .right("error", |of| spectral(of, &|demand_m| rounding.error_of(demand_m).marked(relative_error_in_words)))
            .right("from the exact demand, m", |of| {
                of.from_exact.as_ref().map_or_else(dash, |check| exact_demand(of, check))
            })
            .right("error of the rule", |of| of.from_exact.as_ref().and_then(|_| error(of)).unwrap_or_else(dash));
        writeln!(out, "\n{table}")?;
    }
    print_checks(out, report)
}

/// Required capacity and verdict.
fn print_checks(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    let mut rows = Vec::new();
    for (rule, check) in report.rules.iter().filter_map(|outcome| Some((outcome.rule, outcome.check()?))) {
        if let Some(largest_m) = check.largest_zero_stiffness_demand_m {
            writeln!(
                out,
                "\nThe rule of {} says that the structure overturns: the demand at zero stiffness, {:.4} m, is beyond \
                 the {largest_m:.4} m{} that its capacity allows.",
                rule.words(),
                check.zero_stiffness_demand_m,
                if rule == Rule::EqualEnergy { " (Eq. 3.14)" } else { "" }
            )?;
        }
        let held = [check.required_capacity_m, check.capacity_m, check.margin_m, check.safety_factor];
        rows.push(check_row(rule_cell(rule), (check.demand_m, held), verdict_word(check.satisfied).to_owned()));
    }
    if rows.is_empty() {
        return Ok(());
    }
    if let Some(capacity_m) = report.structure.capacity_m {
        let of_oscillator = report.own_check.zip(report.exact.as_ref()).map(|(own, exact)| {
            let what = if report.own.is_some() { "the oscillator's own demand" } else { "its own demand" };
            (what.to_owned(), own, exact.demand_m)
        });
        let models = report.own_models();
        let of_models = models.filter_map(|of| Some((format!("{} itself", of.model), of.check?, of.demand_m)));
        for (what, own, demand_m) in of_oscillator.into_iter().chain(of_models) {
            let margin_m = capacity_m - own.required_capacity_m;
            let held = [own.required_capacity_m, capacity_m, margin_m, own.safety_factor];
            rows.push(check_row(what, (demand_m, held), report.verdict_of(own)));
        }
    }
    let header = ["by", "demand, m", "required capacity, m", "capacity, m", "margin, m", "safety factor", "verdict"];
    writeln!(
        out,
        "\nRequired capacity with a safety factor of {} (Eq. 3.15)\n{}",
        report.required_safety_factor,
        Table::new(header, rows)
    )?;
    print_mark(out, report)?;
    if is_doubted(&report.alarms) {
        writeln!(out, "These verdicts hold only if the inputs marked mistake? below are correct.")?;
    }
    let tendons = report.rules.iter().filter_map(|outcome| {
        let stiffness_n_m = outcome.check()?.required_tendon_stiffness_n_m?;
        let told = if stiffness_n_m > 0.0 { format!("{} N/m", short(stiffness_n_m)) } else { "none".to_owned() };
        Some(format!("{told} ({})", outcome.rule.words()))
    });
    let tendons: Vec<String> = tendons.collect();
    if !tendons.is_empty() {
        writeln!(out, "Tendons that give the required capacity, each: {}", tendons.join(", "))?;
    }
    Ok(())
}

/// A capacity held against a demand, m: the required one, the structure's, the margin between them and the safety
/// factor. No capacity is enough for what overturns, and an infinite one leaves no margin to tell.
fn check_row(
    by: String,
    (demand_m, [required_m, capacity_m, margin_m, factor]): (f64, [f64; 4]),
    verdict: String,
) -> Vec<String> {
    let dash = |hidden: bool, shown: String| if hidden { "-".to_owned() } else { shown };
    let (overturns, infinite) = (demand_m.is_infinite(), capacity_m.is_infinite());
    vec![
        by,
        metres_or_overturns(demand_m),
        dash(overturns, format!("{required_m:.4}")),
        if infinite { "∞".to_owned() } else { format!("{capacity_m:.4}") },
        dash(overturns || infinite, format!("{margin_m:+.4}")),
        dash(overturns || infinite, format!("{factor:.2}")),
        verdict,
    ]
}

fn print_risk(out: &mut impl Write, report: &DesignReport, exact: &ExactDemand) -> Result<(), CommandError> {
    let Some(capacity_m) = report.structure.capacity_m else { return Ok(()) };
    let rounding = exact.sensitivity.as_ref().map(|of| &of.rounding);
    let beyond = |whose: &str| format!("{whose}, u > {capacity_m:.4} m, the capacity");
    let mut rows = Vec::new();
    let mut row = |what: String, risk: &EventRisk, rounding: Option<&Noisy>| {
        let mut cells = vec![what];
        cells.extend(risk_cells(risk));
        if rounding.is_some_and(|rounding| rounding.shows_otherwise(rate)) {
            cells[1].push('*');
        }
        rows.push(cells);
    };
    if let Some(risk) = &exact.beyond_capacity {
        let rounding = rounding.and_then(|of| of.beyond_capacity_per_year.as_ref());
        row(beyond("oscillator"), risk, rounding);
    }
    row("oscillator, overturning".to_owned(), &exact.overturning, rounding.map(|of| &of.overturning_per_year));
    // the capacity has its row in any case
    let limit = report.own.as_ref().and_then(OwnReport::limit_of_tendons);
    let beyond_limit = |whose: &str, of: Option<LimitRisk>| Some((format!("{whose}, {}", limit?.in_words()), of?.risk));
    if let Some((what, risk)) = report.own.as_ref().and_then(|own| beyond_limit("oscillator", own.proxy_beyond_limit)) {
        row(what, &risk, None);
    }
    for model in report.own_models() {
        if let Some((what, risk)) = beyond_limit(&format!("{} itself", model.model), model.beyond_limit) {
            row(what, &risk, None);
        }
        if let Some(risk) = &model.beyond_capacity {
            row(beyond(&format!("{} itself", model.model)), risk, None);
        }
        row(format!("{} itself, overturning", model.model), &model.overturning, None);
    }
    let in_years = format!("in {} years", report.years);
    let header = ["risk", "per year", &in_years, "return period, years"];
    writeln!(out, "\n{}", Table::new(header, rows))?;
    if let Some(bands) = &exact.bands {
        print_bands(out, exact, bands)?;
    }
    if exact.overturns {
        writeln!(
            out,
            "\nThe structure overturns more often than the target of {} per year: there is no displacement that \
             meets it.",
            text::rate(report.target_per_year)
        )?;
    }
    Ok(())
}

/// How sure demand and risks are, a sentence each.
fn print_bands(out: &mut impl Write, exact: &ExactDemand, bands: &DemandBands) -> Result<(), CommandError> {
    writeln!(
        out,
        "\nBands of the oscillator, with 90 % confidence by all records like these {} (docs/method.md, section 9):",
        bands.records
    )?;
    let limits = |[lower, upper]: [f64; 2], shown: fn(f64) -> String| format!("{} to {}", shown(lower), shown(upper));
    let of = |what: &str, of: Option<Bands>, shown: fn(f64) -> String, unit: &str| {
        let [own, by_event, with_hazard] = of?.each();
        let by_event = by_event.zip(bands.earthquakes).map_or_else(String::new, |(by_event, count)| {
            format!("; by earthquake ({count}), {}", limits(by_event, shown))
        });
        let with_hazard = with_hazard.zip(bands.hazard_curves).map_or_else(String::new, |(limits_of, count)| {
            format!("; with the site's {count} hazard curves, {}", limits(limits_of, shown))
        });
        Some(format!("  {what} {}{unit}{by_event}{with_hazard}", limits(own?, shown)))
    };
    let left = |left_m: f64| if left_m.is_infinite() { "none".to_owned() } else { format!("{left_m:.4}") };
    let own_left = exact.capacity_less_demand_m.map_or_else(String::new, |left_m| format!(" ({} m)", left(left_m)));
    let told = [
        of("demand", Some(bands.demand_m), metres_or_overturns, " m"),
        of(&format!("capacity less demand{own_left}"), bands.capacity_less_demand_m, left, " m"),
        of("u > capacity", bands.beyond_capacity_per_year, text::rate, " per year"),
        of("overturning", bands.overturning_per_year, text::rate, " per year"),
    ];
    for line in told.into_iter().flatten() {
        writeln!(out, "{line}")?;
    }
    if exact.capacity_less_demand_m.is_some() {
        writeln!(out, "A force that falls after uplift can make these bands twice as wide as the spectrum's.")?;
    }
    Ok(())
}

/// What of these numbers is noise.
fn print_noise(out: &mut impl Write, rules: &[RuleOutcome], sensitivity: &Sensitivity) -> Result<(), CommandError> {
    let Sensitivity { noise, rounding } = sensitivity;
    let mut rows = Vec::new();
    let mut row = |what: String, [noisy, rounding]: [Noisy; 2], shown: &dyn Fn(f64) -> String| {
        rows.push(vec![what, rounding.marked(shown), shown(noisy.lowest), shown(noisy.highest)]);
    };
    row("demand on the oscillator, m".to_owned(), [noise.demand_m, rounding.demand_m], &metres_or_overturns);
    if let (Some(noisy), Some(rounding)) = (noise.rule_errors, rounding.rule_errors) {
        for &RuleOutcome { rule, .. } in rules {
            row(
                format!("error of {}", rule.words()),
                [noisy.by_rule(rule), rounding.by_rule(rule)],
                &relative_error_in_words,
            );
        }
    }
    if let (Some(noisy), Some(rounded)) = (noise.beyond_capacity_per_year, rounding.beyond_capacity_per_year) {
        row("u > capacity, per year".to_owned(), [noisy, rounded], &rate);
        row("overturning, per year".to_owned(), [noise.overturning_per_year, rounding.overturning_per_year], &rate);
    }
    let header = ["within 1 % of the strength", "here", "lowest", "highest"];
    writeln!(out, "\n{}", Table::new(header, rows))?;
    Ok(())
}

/// What asterisks mean, and from where to where rounding moves these numbers; nothing where there are none.
fn print_rounding(out: &mut impl Write, rules: &[RuleOutcome], rounding: &DemandRounding) -> Result<(), CommandError> {
    let mut moved = Vec::new();
    let mut tell = |what: &str, noisy: Option<Noisy>, shown: fn(f64) -> String| {
        if let Some(noisy) = noisy.filter(|noisy| noisy.shows_otherwise(shown)) {
            moved.push(format!("   {what}: {} to {}", shown(noisy.lowest), shown(noisy.highest)));
        }
    };
    tell("zero stiffness, exact, m", Some(rounding.zero_stiffness_demand_of_spectrum_m), metres_or_overturns);
    tell(
        "zero stiffness, uplift and impacts of the structure, m",
        Some(rounding.zero_stiffness_demand_m),
        metres_or_overturns,
    );
    tell("the structure's oscillator, m", Some(rounding.demand_m), metres_or_overturns);
    for outcome in rules {
        let rule = outcome.rule.words();
        let of_spectrum = outcome.from_spectrum.as_ref().map(|check| rounding.error_of(check.demand_m));
        let [demand, error] = [rounding.rule_demands_m, rounding.rule_errors]
            .map(|ranges| ranges.map(|ranges| ranges.by_rule(outcome.rule)));
        tell(&format!("error of {rule} from the spectrum"), of_spectrum, relative_error_in_words);
        tell(&format!("{rule} from the exact demand, m"), demand, metres_or_overturns);
        tell(&format!("error of {rule} from the exact demand"), error, relative_error_in_words);
    }
    tell("u > capacity, per year", rounding.beyond_capacity_per_year, rate);
    tell("overturning, per year", Some(rounding.overturning_per_year), rate);
    print_moved(out, &moved, "strengths")
}
