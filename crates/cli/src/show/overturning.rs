//! Overturning as an engineer reads it.

use std::io::Write;

use uplift::structure::{CollapseReport, OverturningReport};
use uplift::text::table;

use super::alarms::print_alarms;
use super::shown_path;
use super::structure::{lines, risk_cells};
use crate::error::CommandError;
use crate::terminal::output;

/// The overturning of a structure: models, fragility, risk.
pub(crate) fn print_overturning(report: &OverturningReport) -> Result<(), CommandError> {
    let out = &mut output();
    for line in lines(&report.structure) {
        writeln!(out, "{line}")?;
    }
    for model in &report.models {
        let (restitution, origin) = (model.restitution, model.restitution_from);
        match (model.size_m, model.slenderness_rad) {
            (Some(size_m), Some(slenderness_rad)) => writeln!(
                out,
                "block      rotates as a block of R = {size_m:.4} m and slenderness {slenderness_rad:.4} rad; \
                 restitution {restitution:.4} ({origin})"
            )?,
            _ => writeln!(out, "oscillator restitution {restitution} ({origin})")?,
        }
    }
    writeln!(out, "records    {}, {}", shown_path(&report.result).display(), report.record_set)?;
    for note in &report.notes {
        writeln!(out, "note       {note}")?;
    }
    print_fragility(out, report)?;
    print_risk(out, report)?;
    print_alarms(out, &report.alarms)
}

fn print_fragility(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    let row = |found: &CollapseReport| {
        let counts = || found.levels.iter().zip(&found.overturned);
        let level = |wanted: &dyn Fn(u32) -> bool| {
            let first = counts().find(|(_, overturned)| wanted(**overturned));
            first.map_or_else(|| "-".to_owned(), |(level, _)| level.to_string())
        };
        let digits = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"));
        vec![
            format!("{}, {}", found.im, found.unit),
            found.model.to_owned(),
            level(&|overturned| overturned > 0),
            level(&|overturned| 2 * overturned >= found.records),
            format!("{} of {}", found.overturned.last().unwrap_or(&0), found.records),
            digits(found.theta),
            digits(found.beta),
        ]
    };
    let rows: Vec<Vec<String>> = report.overturning.iter().map(row).collect();
    let header = ["measure", "model", "first overturns", "half overturn", "at the last level", "theta", "beta"];
    writeln!(
        out,
        "\nCollapse fragility: levels at which the first and half of the records overturn the structure, and the \
         lognormal curve of maximum\nlikelihood beside them\n{}",
        table(&header, &rows)
    )?;
    Ok(())
}

fn print_risk(out: &mut impl Write, report: &OverturningReport) -> Result<(), CommandError> {
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let sites = report.overturning.first().map_or(0, |found| found.sites.len());
    let mut rows = Vec::new();
    for index in 0..sites {
        for (place, found) in report.overturning.iter().enumerate() {
            let of_site = &found.sites[index];
            let shown = if place == 0 { of_site.site.clone() } else { String::new() };
            let mut row = vec![shown, found.im.to_owned(), found.model.to_owned()];
            row.extend(risk_cells(&of_site.risk));
            row.extend([
                of_site.lognormal_per_year.map_or_else(|| "-".to_owned(), |per_year| format!("{per_year:.3e}")),
                percent(of_site.risk.lower_tail_share),
                percent(of_site.risk.upper_tail_share),
            ]);
            rows.push(row);
        }
    }
    let in_years = format!("in {} years", report.years);
    let header = ["site", "im", "model", "per year", &in_years, "return period", "lognormal", "below", "above"];
    writeln!(
        out,
        "\nRisk of overturning: from the counted shares; with the lognormal curve in their place; and what of the \
         first comes from below and\nabove the analysed levels\n{}",
        table(&header, &rows)
    )?;
    Ok(())
}
