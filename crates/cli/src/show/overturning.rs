//! Overturning as an engineer reads it.

use std::io::Write;

use uplift::structure::{Bands, CollapseReport, EventRisk, FrameLimit, OSCILLATOR, OverturningReport, SiteRisk};
use uplift::text::{Table, share, two_digits};
use uplift_spectra::Noisy;
use uplift_structure::NO_CAPACITY;

use super::alarms::print_in_parts;
use super::shown_path;
use super::structure::{
    band_in_cell, fewer_levels, limits, marked_band_in_cell, print_by_earthquake, print_moved, print_notes,
    print_structure, rate, record_set, risk_cells,
};
use super::uncertainty::{print_uncertain_answers, print_uncertainty};
use crate::error::CommandError;
use crate::terminal::Terminal;

/// How often a structure overturns; in detail its models, fragility and tails.
pub(crate) fn print_overturning(report: &OverturningReport, terminal: &Terminal) -> Result<(), CommandError> {
    print_in_parts(report, (print_answer, print_details), (&report.alarms, &report.source.result), terminal)
}

/// The rate of every site by measure and model, with its band.
fn print_answer(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    let has_frame = report.frame().is_some();
    let limit = report.governing_limit();
    let sites = report.overturning.first().map_or(&[][..], |found| &found.sites[..]);
    // a frame has twice as many rows: at many sites only the event that governs has its band, the others in the details
    let shows_bands = !has_frame || sites.len() < 3;
    print_headline(out, report, limit, shows_bands || limit.is_some())?;
    let marked = |bands: Option<Bands>| marked_band_in_cell(bands.filter(|_| shows_bands));
    let banded = |risk: &EventRisk, bands: Option<Bands>| risk_cells(risk)[0].clone() + &marked(bands);
    let cell = |of: &SiteRisk, event: Event| {
        let shown = match event {
            Event::PassesLimit(_) => of.beyond_limit.as_ref().map(|of| banded(&of.risk, of.bands)),
            Event::Overturns => Some(banded(&of.risk, of.bands)),
            Event::OverturnsRepaired => of.repaired.map(|risk| banded(&risk, of.repaired_bands)),
        };
        shown.unwrap_or_else(|| "-".to_owned())
    };
    let is_repaired = report.overturning.iter().flat_map(|found| &found.sites).any(|of| of.repaired.is_some());
    let events: Vec<Event> = limit.map(Event::PassesLimit).into_iter().chain(Event::overturning(is_repaired)).collect();
    let table = if has_frame {
        // a row a site, model and event, a column a measure
        let of_measures: Vec<&[CollapseReport]> = report.overturning.chunks(report.models.len()).collect();
        let models = report.models.len();
        let of_model = |site, model| events.iter().enumerate().map(move |(at, event)| (site, model, at, *event));
        let rows = (0..sites.len()).flat_map(|site| (0..models).flat_map(move |model| of_model(site, model)));
        Table::from_rows(rows)
            .left("site", |(site, model, at, _)| if model + at == 0 { &sites[site].site } else { "" })
            .left("model", |(_, model, at, _)| if at == 0 { report.models[model].model } else { "" })
            .when(events.len() > 1, |table| table.left("event", |(.., event)| event.words()))
            .each(of_measures, |table, found| {
                table.right(found[0].im, |(site, model, _, event)| cell(&found[model].sites[site], event))
            })
            .to_string()
    } else {
        let has_repair = |at: usize| report.overturning.iter().any(|found| found.sites[at].repaired.is_some());
        let of_site = |(at, of): (usize, _)| {
            let shown = events.iter().filter(move |event| **event != Event::OverturnsRepaired || has_repair(at));
            shown.map(move |event| (at, of, *event))
        };
        Table::from_rows(sites.iter().enumerate().flat_map(of_site))
            .left("site", |(_, of, event)| match event {
                Event::OverturnsRepaired => "  repaired",
                Event::Overturns | Event::PassesLimit(_) => &of.site,
            })
            .each(&report.overturning, |table, found| {
                let head = format!("{}, {}", found.model, found.im);
                table.right(head, |(site, _, event)| cell(&found.sites[site], event))
            })
            .to_string()
    };
    writeln!(out, "{table}")?;
    if let Some(reason) = &report.without_own {
        writeln!(out, "Itself    not analysed: {reason}")?;
    }
    print_by_earthquake(out, &table)?;
    if is_repaired {
        let mut sites = report.by_site();
        let hazard =
            sites.find_map(|(of, found, _)| report.source.hazard_of_repair(of.repaired.is_some(), &of.site, found.im));
        let hazard = hazard.map_or_else(String::new, |hazard| format!(", {hazard}"));
        writeln!(out, "repaired: the records weighted for the site's hazard{hazard}")?;
    }
    if let Some(uncertainty) = &report.uncertainty {
        print_uncertain_answers(out, uncertainty)?;
    }
    // those of the oscillator are those of the study
    let levels_of = |model: &'static str| report.overturning.iter().filter(move |found| found.model == model);
    let levels = levels_of(report.frame().unwrap_or_default()).zip(levels_of(OSCILLATOR));
    let levels = fewer_levels(levels.map(|(own, all)| (own.levels.len(), all.levels.len(), own.im)));
    Ok(writeln!(out, "{}{levels}", record_set(&report.source.record_set, report.wobbles()))?)
}

/// What a row of rates is of.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Event {
    PassesLimit(FrameLimit),
    Overturns,
    /// With the weights of a repair.
    OverturnsRepaired,
}

impl Event {
    fn overturning(is_repaired: bool) -> impl Iterator<Item = Self> {
        [Self::Overturns].into_iter().chain(is_repaired.then_some(Self::OverturnsRepaired))
    }

    fn words(self) -> &'static str {
        match self {
            Self::PassesLimit(limit) => limit.event.words(),
            Self::Overturns => "overturns",
            Self::OverturnsRepaired => "overturns, repaired",
        }
    }
}

/// Which event the rates are of: where a frame passes its `limit` more often than it overturns, that comes first.
fn print_headline(
    out: &mut impl Write,
    report: &OverturningReport,
    limit: Option<FrameLimit>,
    has_bands: bool,
) -> Result<(), CommandError> {
    let Some(limit) = limit else { return print_rate(out, report, has_bands) };
    let name = &report.structure.name;
    let frame = report.frame().unwrap_or_default();
    let own = report.overturning.iter().filter(|found| found.model == frame);
    let ratio = |of: &SiteRisk| of.beyond_limit.map_or(f64::NAN, |beyond| beyond.risk.per_year) / of.risk.per_year;
    let how_often = range_of(own.flat_map(|found| &found.sites).map(ratio))
        .map_or_else(|| "more often than".to_owned(), |times| format!("{times} times as often as"));
    let (limit, rates) = (limit.in_words(), annual_rates(has_bands));
    writeln!(out, "{name}: the {frame} passes its limit, {limit}, {how_often} it overturns{rates}")?;
    Ok(())
}

/// What the numbers of the table are.
fn annual_rates(has_bands: bool) -> &'static str {
    if has_bands { "; annual rates (90 % band)" } else { "; annual rates" }
}

/// How often the structure itself overturns by the first measure, at the site where it does most often, beside its
/// oscillator there; and by the other measures.
fn print_rate(out: &mut impl Write, report: &OverturningReport, has_bands: bool) -> Result<(), CommandError> {
    // a frame, or what comes after its oscillator
    let of_measures = report.overturning.chunks(report.models.len().max(1));
    let is_frame = |found: &&CollapseReport| Some(found.model) == report.frame();
    let mut by_measure = of_measures.filter_map(|of| Some((of.first()?, of.iter().find(is_frame).or(of.last())?)));
    let Some((oscillator, found)) = by_measure.next() else { return Ok(()) };
    let rates = found.sites.iter().enumerate();
    let Some((at, worst)) = rates.max_by(|(_, a), (_, b)| a.risk.per_year.total_cmp(&b.risk.per_year)) else {
        return Ok(());
    };
    let overturns = match worst.risk {
        EventRisk { per_year: 0.0, at_most_per_year: None, .. } => format!("does not overturn ({NO_CAPACITY})"),
        risk => format!("overturns {} per year", risk_cells(&risk)[0]),
    };
    let times = worst.risk.per_year / oscillator.sites[at].risk.per_year;
    let beside = if found.model != OSCILLATOR && times > 0.0 && times.is_finite() {
        format!(", {} times as often as its oscillator", two_digits(times))
    } else {
        String::new()
    };
    let others = by_measure.map(|(_, of)| format!("; {} by {}", risk_cells(&of.sites[at].risk)[0], of.im));
    let others: String = others.collect();
    let (name, model) = (&report.structure.name, found.model);
    let whose = if report.by_proxy { "its oscillator alone".to_owned() } else { format!("the {model}") };
    let most =
        if found.sites.len() > 1 { format!(", the most of {} sites,", found.sites.len()) } else { String::new() };
    let (site, im, rates) = (&worst.site, found.im, annual_rates(has_bands));
    writeln!(out, "{name}: {whose} {overturns} at {site}{most} by {im}{beside}{others}{rates}")?;
    Ok(())
}

/// `4.5 to 5.1`, over sites and measures; none without ratios, and where one of two events is never seen.
fn range_of(mut ratios: impl Iterator<Item = f64>) -> Option<String> {
    let [least, most] = ratios.try_fold([f64::INFINITY, 0.0_f64], |[least, most], ratio| {
        (ratio > 0.0 && ratio.is_finite()).then(|| [least.min(ratio), most.max(ratio)])
    })?;
    (least <= most).then(|| {
        let [least, most] = [least, most].map(two_digits);
        if least == most { most } else { format!("{least} to {most}") }
    })
}

fn print_details(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    print_structure(out, &report.structure)?;
    for model in &report.models {
        let (restitution, origin) = (model.restitution, model.restitution_from);
        match (model.size_m, model.slenderness_rad) {
            (Some(size_m), Some(slenderness_rad)) => writeln!(
                out,
                "{:<10} rotates as a block of R = {size_m:.4} m and slenderness {slenderness_rad:.4} rad; \
                 restitution {restitution:.4} ({origin})",
                model.model
            )?,
            _ => writeln!(out, "{:<10} restitution {restitution:.4} ({origin})", model.model)?,
        }
    }
    writeln!(out, "records    {}, {}", shown_path(&report.source.result).display(), report.source.record_set)?;
    print_notes(out, &report.notes)?;
    print_fragility(out, report)?;
    print_risk(out, report)?;
    print_beyond_limit(out, report)?;
    print_rounding(out, report)?;
    if let Some(uncertainty) = &report.uncertainty {
        print_uncertainty(out, uncertainty)?;
    }
    Ok(())
}

/// A count, with an asterisk where rounding decides it.
fn counted(count: u32, [fewest, most]: [u32; 2]) -> String {
    let mark = if fewest < most { "*" } else { "" };
    format!("{count}{mark}")
}

fn digits(value: f64) -> String {
    format!("{value:.4}")
}

/// A value, with an asterisk where rounding shows another.
fn or_dash(value: Option<f64>, rounding: Option<Noisy>, shown: fn(f64) -> String) -> String {
    match (value, rounding) {
        (_, Some(rounding)) => rounding.marked(shown),
        (Some(value), None) => shown(value),
        (None, None) => "-".to_owned(),
    }
}

/// The first level at which enough records overturn, with an asterisk where rounding decides which it is.
fn first_level(found: &CollapseReport, enough: &dyn Fn(u32) -> bool) -> String {
    let first = |count: &dyn Fn(usize) -> u32| (0..found.levels.len()).find(|&level| enough(count(level)));
    let own = first(&|level| found.overturned[level]);
    let counts = |end: usize| {
        move |level: usize| found.overturned_rounding.as_ref().map_or(found.overturned[level], |of| of[level][end])
    };
    let [fewest, most] = [0, 1].map(|end| first(&counts(end)));
    let mark = if fewest == most { "" } else { "*" };
    own.map_or_else(|| format!("-{mark}"), |level| format!("{}{mark}", found.levels[level]))
}

fn print_fragility(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    let at_last = |found: &CollapseReport| {
        let own = found.overturned.last().copied().unwrap_or_default();
        let range = found.overturned_rounding.as_ref().and_then(|of| of.last().copied());
        let count = counted(own, range.unwrap_or([own; 2]));
        format!("{count} of {}", found.records)
    };
    let table = Table::from_rows(&report.overturning)
        .left("measure", |found| format!("{}, {}", found.im, found.unit))
        .right("model", |found| found.model)
        .right("first overturns", |found| first_level(found, &|overturned| overturned > 0))
        .right("half overturn", |found| first_level(found, &|overturned| 2 * overturned >= found.records))
        .right("at the last level", at_last)
        .right("theta", |found| or_dash(found.theta, found.theta_rounding, digits))
        .right("beta", |found| or_dash(found.beta, found.beta_rounding, digits));
    writeln!(
        out,
        "\nCollapse fragility: levels at which the first and half of the records overturn the structure, and the \
         lognormal curve of maximum\nlikelihood beside them\n{table}"
    )?;
    Ok(())
}

fn print_risk(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    let percent = |of_all: f64| match share(of_all) {
        text if text.starts_with("below") || text.starts_with("above") => text,
        _ => format!("{:.1} %", 100.0 * of_all),
    };
    let sites = report.overturning.first().map_or(0, |found| found.sites.len());
    let is_repaired = report.overturning.iter().flat_map(|found| &found.sites).any(|site| site.repaired.is_some());
    let mut rows = Vec::new();
    for index in 0..sites {
        for (place, found) in report.overturning.iter().enumerate() {
            let of_site = &found.sites[index];
            let shown = if place == 0 { of_site.site.clone() } else { String::new() };
            let mut row = vec![shown, found.im.to_owned(), found.model.to_owned()];
            row.extend(risk_cells(&of_site.risk));
            if of_site.per_year_rounding.is_some_and(|of| of.shows_otherwise(rate)) {
                row[3].push('*');
            }
            row.push(of_site.bands.map_or_else(|| "-".to_owned(), |bands| limits(bands.quoted())));
            if is_repaired {
                let repaired = of_site.repaired.map(|risk| risk_cells(&risk)[0].clone());
                row.push(repaired.map_or_else(|| "-".to_owned(), |rate| rate + &band_in_cell(of_site.repaired_bands)));
            }
            row.extend([
                or_dash(of_site.lognormal_per_year, of_site.lognormal_per_year_rounding, rate)
                    + &band_in_cell(of_site.lognormal_bands),
                percent(of_site.risk.lower_tail_share),
                percent(of_site.risk.upper_tail_share),
            ]);
            rows.push(row);
        }
    }
    let in_years = format!("in {} years", report.years);
    let mut header = vec!["site", "im", "model", "per year", &in_years, "return period", "90 % band"];
    let weighted = if is_repaired {
        header.push("repaired (90 % band)");
        "; with the records weighted for hazard consistency"
    } else {
        ""
    };
    header.extend(["lognormal", "below", "above"]);
    writeln!(
        out,
        "\nRisk of overturning: from the counted shares{weighted}, with a 90 % band (docs/method.md, section 9); with \
         the lognormal curve;\nand the shares from below and above the analysed levels\n{}",
        Table::new(header, rows)
    )?;
    let others = [
        (1, "90 % band with each earthquake as one observation:"),
        (2, "The band with the site's weighted hazard curves:"),
    ];
    for (place, title) in others {
        let of_model = |found: &CollapseReport| -> Vec<String> {
            let of_site = |site: &SiteRisk| {
                let band = site.bands?.each()[place]?;
                Some(format!("   {}, {}, {}: {} per year", site.site, found.im, found.model, limits(band)))
            };
            found.sites.iter().filter_map(of_site).collect()
        };
        let lines: Vec<String> = report.overturning.iter().flat_map(of_model).collect();
        if !lines.is_empty() {
            writeln!(out, "{title}\n{}", lines.join("\n"))?;
        }
    }
    Ok(())
}

/// How often each model of a frame passes its limit.
fn print_beyond_limit(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    let Some(limit) = report.limit else { return Ok(()) };
    let rows = report.by_site().filter_map(|(site, found, _)| Some((found, site, site.beyond_limit.as_ref()?)));
    let table = Table::from_rows(rows)
        .left("site", |(_, site, _)| &site.site)
        .left("im", |(found, ..)| found.im)
        .left("model", |(found, ..)| found.model)
        .right("per year", |(.., beyond)| risk_cells(&beyond.risk)[0].clone())
        .right("90 % band", |(.., beyond)| beyond.bands.map_or_else(|| "-".to_owned(), |of| limits(of.quoted())));
    Ok(writeln!(out, "\nRisk beyond the limit, {}\n{table}", limit.in_words())?)
}

/// What asterisks mean, and from where to where rounding moves counts and frequencies; nothing where there are none.
fn print_rounding(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    let mut moved = Vec::new();
    for found in &report.overturning {
        let counts: Vec<String> = (found.levels.iter().zip(found.overturned_rounding.iter().flatten()))
            .filter(|(_, [fewest, most])| fewest < most)
            .map(|(level, [fewest, most])| format!("{fewest} to {most} at {level}"))
            .collect();
        if !counts.is_empty() {
            moved.push(format!("   {}, {}, {}: {}", found.im, found.unit, found.model, counts.join(", ")));
        }
        for of_site in &found.sites {
            if let Some(of) = of_site.per_year_rounding.filter(|of| of.shows_otherwise(rate)) {
                let (lowest, highest) = (rate(of.lowest), rate(of.highest));
                moved.push(format!(
                    "   {}, {}, {}: {lowest} to {highest} per year",
                    of_site.site, found.im, found.model
                ));
            }
        }
    }
    print_moved(out, &moved, "scale factors")
}
