//! A target risk as an engineer reads it.

use std::io::Write;

use uplift::structure::{Bands, TargetBand, TargetOwn, TargetReport};
use uplift::text::{self, Table, per_cent, rounded, short, thousands};

use super::alarms::print_warnings;
use super::structure::{
    doubt, fewer_levels, mark_of, measure_option, print_by_earthquake, print_notes, print_structure, rate, record_set,
    risk_cells,
};
use super::uncertainty::{kind_in_words, print_quantities};
use super::{print_more, shown_path, typed_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The value that was found; in detail its bands and what it is compared with.
pub(crate) fn print_target(report: &TargetReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    print_answer(out, report)?;
    if terminal.shows_details() {
        print_details(out, report)?;
    }
    print_warnings(out, &report.alarms, Some(&report.source.result), terminal)?;
    print_more(out, terminal)
}

/// The safe value, then the best estimate with its band, and what they are for.
fn print_answer(out: &mut impl Write, report: &TargetReport) -> Result<(), CommandError> {
    let TargetReport { event, site, target_per_year, value, .. } = report;
    let im = text::spectrum_words(report.im, report.repaired);
    let quantity = report.quantity.replace('-', " ");
    let safe = limit(report.safe_value, report);
    let band = report.bands.last().map_or_else(String::new, |band| {
        let upper = if band.value[1].is_finite() { whole(band.value[1]) } else { "beyond".to_owned() };
        // where the range begins it is no limit
        let is_open = report.tried.first().is_some_and(|least| band.value[0] <= least.value);
        let below = if is_open { "from below " } else { "" };
        format!(" (90 % band {below}{} to {upper}, by {})", short(band.value[0]), band.of)
    });
    let best = format!("best estimate {}{band}", with_unit(*value, report));
    let is_alone = report.own.as_ref().is_some_and(|own| own.passes_limit_above(*target_per_year));
    let against = if is_alone { " against overturning alone" } else { "" };
    let what = format!("{}safe {quantity}{against}", doubt(&report.alarms));
    let what = what[..1].to_uppercase() + &what[1..];
    match &report.own {
        Some(own) if own.decisive().is_safe && own.safe_value < own.value => {
            writeln!(
                out,
                "{what}: the {} needs {} (at most {} per year), its oscillator {safe}; {best} of the oscillator",
                own.decisive().model,
                limit(own.safe_value, report),
                rate(own.upper_per_year_where_safe())
            )?;
        }
        Some(own) if own.decisive().is_safe => {
            writeln!(out, "{what} {safe} by {} and oscillator; {best} of the oscillator", own.decisive().model)?;
        }
        Some(own) => {
            let needs = if own.safe_value.is_finite() {
                format!("needs {}", limit(own.safe_value, report))
            } else {
                format!("misses the target up to {}", with_unit(own.missed_at.unwrap_or(own.value), report))
            };
            writeln!(
                out,
                "{what}: the {} {needs}, its oscillator {safe}; at {} {}",
                own.decisive().model,
                with_unit(own.value, report),
                how_often(report, own)
            )?;
        }
        None => {
            let whose = if report.by_proxy { ", by its oscillator alone" } else { "" };
            writeln!(out, "{what} {safe}; {best}{whose}")?;
        }
    }
    if let Some(own) = &report.own {
        print_limit(out, report, own)?;
    }
    if let Some(limit) = &report.tendon_limit {
        let limit = limit.in_words();
        writeln!(out, "Limit     {limit}, before the capacity: --exceed limit takes what comes first")?;
    }
    let years = rounded(1.0 / target_per_year, 3);
    writeln!(out, "Target    {event} at most {} per year (once in {years} years)", rate(*target_per_year))?;
    let risk = risk_line(report);
    writeln!(out, "{risk}")?;
    print_later_band(out, report)?;
    print_other_measures(out, report)?;
    if let Some(misses) = &report.unrepaired {
        writeln!(out, "Weights   equal, and the records have {misses}: --repaired searches by the repair's weights")?;
    }
    if !report.kept.is_empty() {
        writeln!(
            out,
            "Assumed   {} at every {quantity}: recompute them at the {quantity} you choose, and run uplift design",
            report.kept
        )?;
    }
    let table = report.own.as_ref().map_or_else(String::new, |own| own_table(report, own));
    write!(out, "{table}")?;
    print_by_earthquake(out, &(risk + &table))?;
    if let Some(reason) = &report.without_own {
        writeln!(out, "Itself    not analysed: {reason}")?;
    }
    if report.least_met < report.missed_at {
        let [met, missed] = [report.least_met, report.missed_at].map(|value| with_unit(value, report));
        writeln!(
            out,
            "Scatter   the rate does not fall steadily: {met} meets the target, {missed} misses it; from the best \
             estimate on every trial meets it"
        )?;
    }
    let own = own_value(report);
    let own_levels = report.own.iter().map(|own| (own.levels.len(), own.levels_of_study, report.im));
    let wobbles = report.own.as_ref().is_some_and(TargetOwn::wobbles);
    let records = record_set(&report.source.record_set, wobbles);
    writeln!(out, "At        {site} by {im}; {records}{}{own}", fewer_levels(own_levels))?;
    if let Some(hazard) = report.source.hazard_of_repair(report.repaired, site, report.im) {
        writeln!(out, "Hazard    {hazard}")?;
    }
    Ok(())
}

/// From where on the band of all trials meets the target, where those of single values do so later.
fn print_later_band(out: &mut impl Write, report: &TargetReport) -> Result<(), CommandError> {
    if let Some(band) = report.bands.last().filter(|band| band.value[1] < report.safe_value) {
        writeln!(out, "          all trials together: {}", with_unit(band.value[1], report))?;
    }
    Ok(())
}

/// What the other measures of the result say of the safe value.
fn print_other_measures(out: &mut impl Write, report: &TargetReport) -> Result<(), CommandError> {
    let value = if report.safe_value.is_finite() { report.safe_value } else { report.value };
    let at = with_unit(value, report);
    let whose = if report.own.is_some() || report.by_proxy { "its oscillator by" } else { "by" };
    for other in &report.by_other_measures {
        let [per_year, ..] = risk_cells(&other.risk);
        let verdict = match (other.is_met, &other.unrepaired) {
            (Some(true), _) => "meets the target".to_owned(),
            (Some(false), None) => "MISSES the target (--measure to size by it)".to_owned(),
            (Some(false), Some(misses)) => format!("MISSES the target, with {misses} (--repaired)"),
            (None, _) => "the levels are too low to tell".to_owned(),
        };
        writeln!(out, "          {whose} {} {per_year} per year at {at}: {verdict}", other.im)?;
    }
    for im in &report.unchecked {
        writeln!(out, "          {whose} {im} not checked: the result has no repair by it")?;
    }
    Ok(())
}

/// How it misses a target at the value of its oscillator, in words.
fn how_often(report: &TargetReport, own: &TargetOwn) -> String {
    let own = own.decisive();
    let model = own.model;
    if own.is_met {
        format!("the {model}'s rate meets the target, its upper limit does not")
    } else {
        format!("the {model}'s rate is {:.2} times the target", own.risk.per_year / report.target_per_year)
    }
}

/// The rates of the structure itself at the value of its oscillator, with a verdict by each model.
fn own_table(report: &TargetReport, own: &TargetOwn) -> String {
    let value = with_unit(own.value, report);
    // in a plane it loses energy as its oscillator does, and not as much
    let in_plane = !own.wobbles();
    let table = Table::from_rows(&own.models)
        .left("model", |own| {
            if in_plane { format!("{}, restitution {:.3}", own.model, own.restitution) } else { own.model.to_owned() }
        })
        .right(format!("per year at {value}"), |own| {
            risk_cells(&own.risk)[0].clone() + &own.bands.map_or_else(String::new, in_brackets)
        })
        .right("travel at the target rate, m", |own| {
            if own.demand_m.is_finite() { text::two_digits(own.demand_m) } else { "overturns".to_owned() }
        })
        .left("verdict", |own| match (own.is_met, own.is_safe) {
            (_, true) => "safe",
            (true, false) => "met, not safe",
            (false, false) => "MISSED",
        });
    format!("{table}\n")
}

/// The value in the structure file, and by how much its lengths change where these are varied.
fn own_value(report: &TargetReport) -> String {
    let Some(own) = report.own_value else { return String::new() };
    // where both models have a value, the larger
    let larger = |of: f64| if report.safe_value.is_finite() { of.max(report.safe_value) } else { of };
    let needed = report.own.as_ref().map_or(report.safe_value, |own| larger(own.safe_value));
    let is_told = report.quantity == "size" && needed.is_finite();
    let lengths = if is_told { format!("; multiply all lengths by {}", short(needed / own)) } else { String::new() };
    let value = format!("{} {}", short(own), report.quantity_unit);
    format!("; the structure's {} is {}{lengths}", report.quantity.replace('-', " "), value.trim_end())
}

/// The rates at the best estimate and at the safe value, that with the band of the runs at it alone.
fn risk_line(report: &TargetReport) -> String {
    let [per_year, ..] = risk_cells(&report.risk);
    // the first line has the best estimate but where the structure itself needs more
    let [whose, best] = match &report.own {
        Some(own) if !own.decisive().is_safe => {
            ["oscillator: ".to_owned(), format!(" {}", with_unit(report.value, report))]
        }
        _ => [String::new(), String::new()],
    };
    let at_safe = report.safe_risk.map_or_else(String::new, |risk| {
        let band = report.safe_bands.map_or_else(String::new, in_brackets);
        format!(", {}{band} at {}", risk_cells(&risk)[0], with_unit(report.safe_value, report))
    });
    format!("Risk      {whose}{per_year} per year at the best estimate{best}{at_safe}")
}

/// The fullest band of a rate, marked where it is by earthquake alone.
fn in_brackets(bands: Bands) -> String {
    let mark = mark_of(Some(bands).filter(|bands| bands.with_hazard.is_none()));
    format!(" ({}){mark}", bands.fullest().map(text::rate).join("–"))
}

/// How often the frame passes its limit, where that says more than how often it overturns.
fn print_limit(out: &mut impl Write, report: &TargetReport, own: &TargetOwn) -> Result<(), CommandError> {
    let (Some(limit), Some(beyond)) = (&own.limit, &own.beyond_limit) else { return Ok(()) };
    let [per_year, ..] = risk_cells(&beyond.risk);
    let at = with_unit(own.limit_at, report);
    let is_more = own.passes_limit_above(report.target_per_year);
    let more = if is_more { ", more often than the target. Search for the limit:" } else { "" };
    let (model, limit_in_words) = (own.decisive().model, limit.in_words());
    writeln!(out, "Limit     the {model} passes its limit, {limit_in_words}, {per_year} per year at {at}{more}")?;
    if is_more {
        let [structure, result] = [&report.structure.file, &report.source.result].map(|path| typed_path(path));
        let site = uplift::text::typed(&report.site);
        writeln!(
            out,
            "          uplift target {structure} --urs {result} --site {site} {} --vary {} --exceed limit \
             --per-year {}{}",
            measure_option(report.im),
            report.quantity,
            report.target_per_year,
            report.repeated
        )?;
    }
    Ok(())
}

fn print_details(out: &mut impl Write, report: &TargetReport) -> Result<(), CommandError> {
    print_structure(out, &report.structure)?;
    writeln!(out, "records    {}, {}", shown_path(&report.source.result).display(), report.source.record_set)?;
    let TargetReport { event, site, quantity, target_per_year, value, .. } = report;
    let im = text::spectrum_words(report.im, report.repaired);
    writeln!(
        out,
        "target     {event} at most {} per year at {site} by {im}: once in {} years",
        rate(*target_per_year),
        rounded(1.0 / target_per_year, 3)
    )?;
    print_notes(out, &report.notes)?;
    let missed = with_unit(report.missed_at, report);
    writeln!(out, "\nSmallest {quantity} that meets the target: {}; {missed} misses it", with_unit(*value, report))?;
    let [per_year, probability, return_period] = risk_cells(&report.risk);
    writeln!(
        out,
        "  frequency there      {per_year} per year ({probability} in {} years, once in {return_period})",
        report.years
    )?;
    let noise = &report.per_year_within_one_percent;
    writeln!(out, "  within 1 % of it     {} to {} per year", rate(noise.lowest), rate(noise.highest))?;
    for band in &report.bands {
        print_band(out, report, band)?;
    }
    if let Some(percentiles) = report.uncertainty.as_ref().and_then(|of| of.by_structure) {
        let [lower, median, upper] = percentiles.map(|value| limit(value, report));
        writeln!(out, "  by structure         {lower} to {upper}, median {median} (90 % of the structures)")?;
    }
    let found = &report.found;
    let capacity = found.capacity_m.map_or_else(|| "none".to_owned(), |capacity_m| format!("{capacity_m:.4} m"));
    writeln!(
        out,
        "  the structure there  strength {:.4}, strength of the spectrum {:.4}, displacement capacity {capacity}",
        found.strength, found.spectral_strength
    )?;
    if let Some(uncertain) = &report.uncertainty {
        writeln!(
            out,
            "\nUncertain structure ({}): {} structures at every value, {}, seed {}; as described",
            kind_in_words(uncertain.kind),
            thousands(uncertain.structures as u64),
            uncertain.sampling,
            uncertain.seed
        )?;
        print_quantities(out, &uncertain.quantities)?;
    }
    if let Some(own) = report.own.as_ref().filter(|own| own.tried.len() > 1) {
        let table = Table::from_rows(&own.tried)
            .right(report.quantity, |tried| tried.value)
            .right("per year", |tried| rate(tried.risk.per_year))
            .right("upper limit", |tried| rate(tried.upper_per_year))
            .left("", |tried| if tried.is_safe { "safe" } else { "not safe" });
        writeln!(out, "\nThe {} at other values\n{table}", own.decisive().model)?;
    }
    print_crossings(out, report)?;
    print_beside(out, report)
}

fn print_band(out: &mut impl Write, report: &TargetReport, band: &TargetBand) -> Result<(), CommandError> {
    let unit = |text: String| format!("{text} {}", report.quantity_unit).trim_end().to_owned();
    let [lower, upper] =
        band.value.map(|value| if value.is_finite() { unit(short(value)) } else { limit(value, report) });
    writeln!(out, "  {:<19}  {lower} to {upper} (90 % confidence)", band.of)?;
    let [lower, upper] = band.per_year;
    writeln!(out, "                       {} to {} per year at the best estimate", rate(lower), rate(upper))?;
    Ok(())
}

/// A limit of the value with its unit.
fn limit(value: f64, report: &TargetReport) -> String {
    if value.is_finite() { with_unit(value, report) } else { "beyond the range".to_owned() }
}

/// A value that was tried, with its unit.
fn with_unit(value: f64, report: &TargetReport) -> String {
    format!("{} {}", whole(value), report.quantity_unit).trim_end().to_owned()
}

/// A value that was tried, which has few digits: with all of them it can be tried again.
fn whole(value: f64) -> String {
    if value.abs() < 1e5 { value.to_string() } else { format!("{value:e}") }
}

fn print_crossings(out: &mut impl Write, report: &TargetReport) -> Result<(), CommandError> {
    if report.crossings.len() < 2 {
        return Ok(());
    }
    let table = Table::from_rows(&report.crossings)
        .left("becomes", |crossing| if crossing.becomes_met { "met" } else { "missed" })
        .right(format!("{} from", report.quantity), |crossing| short(crossing.from))
        .right("to", |crossing| short(crossing.to));
    writeln!(out, "\nCrossings of the target, upwards\n{table}")?;
    Ok(())
}

fn print_beside(out: &mut impl Write, report: &TargetReport) -> Result<(), CommandError> {
    if !report.at_return_periods.is_empty() {
        let whose = if report.uncertainty.is_some() { "runs" } else { "records" };
        let table = Table::from_rows(&report.at_return_periods)
            .left("return period", |at| format!("{:.0} years", at.return_period_years))
            .right(format!("{}, {}", report.im, report.im_unit), |at| short(at.level))
            .right(whose, |at| format!("{} of {}", at.count, at.runs))
            .right("probability", |at| per_cent(at.probability));
        writeln!(
            out,
            "\nProbability of {} given the level of a return period, for the structure that was found\n{table}",
            report.event
        )?;
    }
    let Some(generic) = &report.generic else { return Ok(()) };
    writeln!(
        out,
        "\nA generic lognormal fragility of dispersion {} and {} at the level to design for has the target risk where \
         that level is\n{} {} (median {}; {} of the risk from above the hazard curve)",
        generic.dispersion,
        per_cent(generic.probability),
        short(generic.level),
        report.im_unit,
        short(generic.median),
        per_cent(generic.upper_tail_share)
    )?;
    if let (Some(level), Some(coefficient)) = (generic.uniform_hazard_level, generic.risk_coefficient) {
        writeln!(
            out,
            "risk coefficient {coefficient:.4}: over {} {} of the {:.0}-year return period",
            short(level),
            report.im_unit,
            generic.return_period_years
        )?;
    }
    Ok(())
}
