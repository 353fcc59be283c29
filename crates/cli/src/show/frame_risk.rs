//! The risk of a frame as an engineer reads it.

use std::io::Write;

use uplift::structure::{Banded, Bands, EventRisk, FrameRiskReport, ModelDemand, PLANAR_FRAME, StateAtDemand};
use uplift::text::{
    self, Table, metres_or_overturns, metres_with_band, relative_error_in_words, risk_in_words, short, two_digits,
};

use super::alarms::print_in_parts;
use super::shown_path;
use super::structure::{
    BLOCK, WOBBLING, band_after, demand_in_words, measure_option, print_notes, print_structure, record_set,
    restitution_line, rests, risk_cells,
};
use crate::error::CommandError;
use crate::terminal::Terminal;

/// The proxy whose restitution is its own.
const OSCILLATOR: &str = "equivalent oscillator";

/// What readings of a spectrum begin with.
const SPECTRUM: &str = "spectrum, ";

fn is_block(report: &FrameRiskReport) -> bool {
    report.structure.kind == BLOCK
}

/// Words of a frame, as they are said of this structure: a block is shaken as a frame of one column without a deck.
fn own_word(report: &FrameRiskReport, of_frame: &str) -> String {
    if is_block(report) { of_frame.replace("frame", "block") } else { of_frame.to_owned() }
}

/// The error of a proxy; none of the frame, and where the frame overturns at the target: it has no demand to compare.
fn error_of<'a>(report: &FrameRiskReport, of: &'a ModelDemand) -> Option<&'a Banded> {
    of.error.as_ref().filter(|_| report.demands[0].demand_m.value.is_finite())
}

fn band(of: &Banded, shown: fn(f64) -> String) -> String {
    format!("{} to {}", shown(of.lower), shown(of.upper))
}

/// Demand and overturning of the frame; in detail restrainers, events and directions.
pub(crate) fn print_frame_risk(report: &FrameRiskReport, terminal: &Terminal) -> Result<(), CommandError> {
    print_in_parts(report, (print_answer, print_details), (&report.alarms, &report.source.result), terminal)
}

/// The demand on the frame with its band, what its proxies say, and how often it overturns.
fn print_answer(out: &mut impl Write, report: &FrameRiskReport) -> Result<(), CommandError> {
    let [frame, proxies @ ..] = &report.demands[..] else { return Ok(()) };
    let Banded { value, lower, upper } = frame.demand_m;
    let by_whom = if frame.band_of == Some("earthquakes") { " by earthquake" } else { "" };
    let demand = demand_in_words(value, Some([lower, upper]), by_whom);
    let of_repair = |demand_m| format!("; repaired {}", metres_with_band(demand_m, None));
    let repaired = frame.repaired_m.map_or_else(String::new, of_repair);
    let (name, rests) = (&report.structure.name, rests(value));
    if is_block(report) && frame.model != WOBBLING {
        let restitution = report.planar_restitution;
        writeln!(out, "Demand       {demand} on {name} itself, restitution {restitution:.4}{rests}{repaired}")?;
    } else {
        writeln!(out, "Demand       {demand} on {name}, {}{rests}{repaired}", own_word(report, frame.model))?;
    }
    if let Some(exceeded) = exceeded(report, value) {
        writeln!(out, "  {exceeded}")?;
    }
    let told = proxies.iter().map(|proxy| {
        let error = error_of(report, proxy).filter(|_| value > report.structure.uplift_displacement_m);
        let error = error.map_or_else(String::new, |of| match relative_error_in_words(of.value) {
            words if of.value.is_infinite() => format!(" ({words})"),
            words => format!(" (error {words})"),
        });
        let restitution = report.structure.restitution.filter(|_| is_block(report) && proxy.model == OSCILLATOR);
        let keeps = restitution.map_or_else(String::new, |restitution| format!(", restitution {restitution}"));
        let demand = metres_with_band(proxy.demand_m.value, None);
        (own_word(report, proxy.model) + &keeps, demand + &error)
    });
    let told: Vec<(String, String)> = told.collect();
    // by zero stiffness and by equal displacement a spectrum has one demand where neither overturns
    let are_alike = |(one, demand): &(String, String), (other, same): &(String, String)| {
        demand == same && [one, other].iter().all(|name| name.starts_with(SPECTRUM))
    };
    for alike in told.chunk_by(are_alike) {
        let (first, demand) = &alike[0];
        let others: String = alike[1..].iter().map(|(name, _)| name.replace(SPECTRUM, " and ")).collect();
        writeln!(out, "  {first}{others}: {demand}")?;
    }
    let how_often = |risk: &EventRisk, bands: Option<Bands>| {
        let [per_year, _, return_period] = risk_cells(risk);
        format!("{per_year} per year{}, once in {return_period} years", band_after(bands))
    };
    if let Some((limit, beyond)) = report.governing_limit() {
        writeln!(out, "Limit        {}, passed {}", limit.in_words(), how_often(&beyond.risk, beyond.bands))?;
    }
    let overturning = &report.overturning;
    let of_repair = |risk: EventRisk| format!("; repaired {}", risk_cells(&risk)[0]);
    let repaired = overturning.repaired.map_or_else(String::new, of_repair);
    writeln!(out, "Overturning  {}{repaired}", how_often(&overturning.risk, overturning.bands))?;
    let risk = risk_in_words(report.poe, report.years);
    write!(out, "At           {} by {}", report.site, report.im)?;
    for im in &report.other_measures {
        write!(out, " ({im}: {})", measure_option(im))?;
    }
    writeln!(out, ", {risk}; {}", record_set(&report.source.record_set, report.direction.is_some()))?;
    let is_repaired = overturning.repaired.is_some() || frame.repaired_m.is_some();
    if let Some(hazard) = report.source.hazard_of_repair(is_repaired, &report.site, report.im) {
        writeln!(out, "Repaired     {hazard}")?;
    }
    Ok(())
}

fn print_details(out: &mut impl Write, report: &FrameRiskReport) -> Result<(), CommandError> {
    print_structure(out, &report.structure)?;
    writeln!(
        out,
        "{} ({})",
        restitution_line(PLANAR_FRAME, report.planar_restitution),
        report.planar_restitution_from
    )?;
    writeln!(
        out,
        "demand     {} by {}, {}: {} per year",
        report.site,
        report.im,
        risk_in_words(report.poe, report.years),
        text::rate(report.target_per_year)
    )?;
    writeln!(out, "           {}, {}", shown_path(&report.source.result).display(), report.source.record_set)?;
    print_notes(out, &report.notes)?;
    print_demands(out, report)?;
    print_state(out, report)?;
    print_events(out, report)?;
    print_direction(out, report)
}

fn print_demands(out: &mut impl Write, report: &FrameRiskReport) -> Result<(), CommandError> {
    let is_repaired = report.demands.iter().any(|demand| demand.repaired_m.is_some());
    let error =
        |demand: &ModelDemand, shown: fn(&Banded) -> String| error_of(report, demand).map_or("-".to_owned(), shown);
    let table = Table::from_rows(&report.demands)
        .left("model", |demand| own_word(report, demand.model))
        .right("demand, m", |demand| metres_or_overturns(demand.demand_m.value))
        .right(format!("{:.0} % band", 100.0 * report.confidence), |demand| band(&demand.demand_m, metres_or_overturns))
        .right("error", |demand| error(demand, |error| relative_error_in_words(error.value)))
        .right("its band", |demand| error(demand, |error| band(error, relative_error_in_words)))
        .when(is_repaired, |table| {
            table.right("repaired, m", |demand| demand.repaired_m.map_or_else(|| "-".to_owned(), metres_or_overturns))
        });
    writeln!(
        out,
        "\nDisplacement demand of the {}: the {}, then its proxies and their errors; bands of errors from {} \
         resamples of the records\n{table}",
        if is_block(report) { "top" } else { "deck" },
        own_word(report, "frame"),
        report.replicates
    )?;
    Ok(())
}

/// What restrainers cannot give at the demand; none where they can.
fn exceeded(report: &FrameRiskReport, demand_m: f64) -> Option<String> {
    let Some(at) = &report.at_demand else {
        return demand_m.is_finite().then(|| "its restrainers do not reach that far".to_owned());
    };
    let tendons = at.tendon_over_yield.filter(|of| *of >= 1.0);
    let tendons = tendons.map(|of| format!("tendons yield (elastic, {} times their yield)", two_digits(of)));
    let springs = at.spring_over_flat.filter(|of| *of >= 1.0).map(|_| "springs are flat".to_owned());
    let words: Vec<String> = tendons.into_iter().chain(springs).collect();
    (!words.is_empty()).then(|| format!("there {}", words.join(", ")))
}

/// What tendons and springs have at the demand.
fn restrainers(at: &StateAtDemand) -> Vec<String> {
    let share = |of: Option<f64>, limit| of.map_or_else(String::new, |of| format!(", {:.0} % of {limit}", 100.0 * of));
    let tendon = at
        .tendon_n
        .map(|tendon_n| format!("tendon {} kN{}", short(1e-3 * tendon_n), share(at.tendon_over_yield, "its yield")));
    let springs = at
        .spring_m
        .map(|spring_m| format!("springs {} mm{}", short(1e3 * spring_m), share(at.spring_over_flat, "flat")));
    tendon.into_iter().chain(springs).collect()
}

fn print_state(out: &mut impl Write, report: &FrameRiskReport) -> Result<(), CommandError> {
    let Some(at) = &report.at_demand else {
        return Ok(writeln!(
            out,
            "\nAt that demand the {} has overturned, or is beyond the law of its restrainers.",
            own_word(report, "frame")
        )?);
    };
    let mut words = vec![format!("drift {:.2} %", 100.0 * at.drift), format!("rotation {:.4} rad", at.rotation_rad)];
    words.extend(restrainers(at));
    if !is_block(report) {
        words.push(format!("moment at the top of a column {} kN m", short(1e-3 * at.top_moment_n_m)));
    }
    Ok(writeln!(out, "\nAt the demand on the {}: {}", own_word(report, "frame"), words.join("; "))?)
}

fn print_events(out: &mut impl Write, report: &FrameRiskReport) -> Result<(), CommandError> {
    let is_repaired = report.overturning.repaired.is_some();
    let mut rows = Vec::new();
    let of_events = report.events.iter().map(|event| {
        (event.event.words().to_owned(), format!("{:.4}", event.displacement_m), event.risk, event.repaired)
    });
    let found = &report.overturning;
    let overturned = ("overturning".to_owned(), "-".to_owned(), found.risk, found.repaired);
    for (what, displacement, risk, repaired) in of_events.chain([overturned]) {
        let mut row = vec![what, displacement];
        row.extend(risk_cells(&risk));
        if is_repaired {
            row.push(repaired.map_or_else(|| "-".to_owned(), |risk| risk_cells(&risk)[0].clone()));
        }
        rows.push(row);
    }
    let in_years = format!("in {} years", report.years);
    let mut header = vec!["event", "beyond, m", "per year", &in_years, "return period"];
    if is_repaired {
        header.push("repaired");
    }
    writeln!(out, "\nAnnual rates of events of the {}\n{}", own_word(report, "frame"), Table::new(header, rows))?;
    if let (Some(theta), Some(beta), Some(per_year)) = (found.theta, found.beta, found.lognormal_per_year) {
        writeln!(
            out,
            "Collapse fragility: lognormal, median {theta:.4} {}, dispersion {beta:.4}; with it {} per year{}",
            report.unit,
            text::rate(per_year),
            band_after(found.lognormal_bands)
        )?;
    }
    Ok(())
}

fn print_direction(out: &mut impl Write, report: &FrameRiskReport) -> Result<(), CommandError> {
    let Some(of) = &report.direction else { return Ok(()) };
    let [low, median, high] = of.ratio;
    let shown = |ratio: f64| if ratio.is_infinite() { "∞".to_owned() } else { format!("{ratio:.3}") };
    writeln!(
        out,
        "\nWobbling over the larger planar peak of the two components, {} runs: median {}, 16 to 84 % {} to {}; \
         overturned: {} both,\n{} wobbling alone, {} in a plane alone",
        of.runs,
        shown(median),
        shown(low),
        shown(high),
        of.both_overturn,
        of.wobbling_overturns,
        of.planar_overturns
    )?;
    Ok(())
}
