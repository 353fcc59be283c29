//! What a design says first of a frame that can wobble.

use std::io::Write;

use uplift::structure::{Bands, DemandBands, DesignReport, EventRisk, FrameReport, verdict_word};
use uplift::text::{self, Table, cell_with_band, metres_or_overturns};
use uplift_structure::Rule;

use crate::error::CommandError;
use crate::show::structure::{band_in_cell, measure_option, risk_cells};

/// The verdicts of a wobbling frame and of its proxy, with demand and risk of each.
pub(super) fn print_verdicts(
    out: &mut impl Write,
    report: &DesignReport,
    frame: &FrameReport,
) -> Result<(), CommandError> {
    let name = &report.structure.name;
    let wobbling = frame.wobbling();
    let how_far = match report.frame_over_proxy() {
        Some(ratio) => format!("the frame moves {ratio:.1} times as far as its proxy"),
        None if wobbling.demand_m.is_infinite() => "the wobbling frame overturns more often than the target".to_owned(),
        None => "its proxy has no demand to compare with".to_owned(),
    };
    match (report.verdicts_differ(), wobbling.check) {
        (Some(true), _) => writeln!(out, "Verdict   {name}: verdicts differ; {how_far}")?,
        (Some(false), Some(check)) => {
            writeln!(out, "Verdict   {name}: {} by frame and proxy; {how_far}", verdict_word(check.satisfied))?;
        }
        _ => writeln!(out, "Verdict   {name}: no capacity, the force does not fall; {how_far}")?,
    }
    for (im, verdict) in report.verdicts_by_other_measures() {
        writeln!(out, "          {verdict}; frame: {}", measure_option(im))?;
    }
    if let Some(settings) = &report.own_oscillator {
        writeln!(out, "          spectrum of another oscillator; its own: run {settings}")?;
    }
    if let Some(capacity_m) = report.structure.capacity_m {
        let factor = report.required_safety_factor;
        writeln!(out, "Capacity  {capacity_m:.2} m; safety factor {factor}")?;
    }
    let dash = || "-".to_owned();
    let unsafe_upper_limits = report.unsafe_upper_limits();
    let verdict = |whose: &str, is_satisfied: bool| {
        let word = verdict_word(is_satisfied);
        let is_unsafe = unsafe_upper_limits.iter().any(|(of, _)| *of == whose);
        if is_unsafe { format!("{word}, not at the upper limit") } else { word.to_owned() }
    };
    let risk = |risk: &EventRisk, band: Option<Bands>| {
        if risk.per_year > 0.0 { text::rate(risk.per_year) + &band_in_cell(band) } else { risk_cells(risk)[0].clone() }
    };
    let demand = |demand_m: f64, bands: Option<&DemandBands>| {
        if demand_m.is_infinite() {
            metres_or_overturns(demand_m)
        } else {
            cell_with_band(demand_m, bands.map(|of| of.demand_m.quoted()))
        }
    };
    let mut rows: Vec<[String; 5]> = Vec::new();
    for of in &frame.models {
        let bands = of.bands.as_ref();
        rows.push([
            of.model.to_owned(),
            demand(of.demand_m, bands),
            of.check.map_or_else(dash, |check| required(check.required_capacity_m)),
            of.check.map_or_else(dash, |check| verdict(of.model, check.satisfied)),
            risk(&of.overturning, bands.and_then(|bands| bands.overturning_per_year)),
        ]);
    }
    if let Some(exact) = &report.exact {
        let bands = exact.bands.as_ref();
        let overturning = bands.and_then(|bands| bands.overturning_per_year);
        rows.push([
            "proxy oscillator".to_owned(),
            demand(exact.demand_m, bands),
            report.own_check.map_or_else(dash, |check| required(check.required_capacity_m)),
            report.own_check.map_or_else(dash, |check| verdict("proxy", check.satisfied)),
            risk(&exact.overturning, overturning),
        ]);
    }
    for (rule, check) in report.rules.iter().filter_map(|outcome| Some((outcome.rule, outcome.check()?))) {
        rows.push([
            rule_cell(rule),
            demand(check.demand_m, None),
            required(check.required_capacity_m),
            verdict_word(check.satisfied).to_owned(),
            dash(),
        ]);
    }
    let table = Table::of(&rows)
        .left("model", |row| &row[0])
        .right("demand, m", |row| &row[1])
        .right("requires, m", |row| &row[2])
        .left("verdict", |row| &row[3])
        .right("overturns, 1/yr", |row| &row[4]);
    writeln!(out, "{table}")?;
    print_mark(out, report)
}

/// A capacity that is required, m.
fn required(capacity_m: f64) -> String {
    if capacity_m.is_finite() { format!("{capacity_m:.2}") } else { "∞".to_owned() }
}

/// A rule in a table that has its demand and the capacity that it requires: by equal energy that is not the demand
/// times the safety factor.
pub(super) fn rule_cell(rule: Rule) -> String {
    if rule == Rule::EqualEnergy { format!("{}†", rule.words()) } else { rule.words().to_owned() }
}

/// What the mark of [`rule_cell`] means, where it is.
pub(super) fn print_mark(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    if report.rules.iter().any(|outcome| outcome.rule == Rule::EqualEnergy && outcome.check().is_some()) {
        writeln!(out, "† not demand × safety factor: demand rises with capacity")?;
    }
    Ok(())
}
