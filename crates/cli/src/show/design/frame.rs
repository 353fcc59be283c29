//! What a design says first of a frame that can wobble.

use std::io::Write;
use std::path::Path;

use uplift::structure::{
    DemandBands, DesignReport, EventRisk, FrameReport, LimitRisk, OSCILLATOR, ReportSource, verdict_word,
};
use uplift::text::{Table, cell_with_band, metres_or_overturns, typed, typed_path};
use uplift_structure::{NO_CAPACITY, NO_CAPACITY_REASON, Rule};

use crate::error::CommandError;
use crate::show::structure::{mark_of, marked_band_in_cell, measure_option, print_by_earthquake, risk_cells};

/// The verdicts of a wobbling frame and of its proxy, with demand and risk of each.
pub(super) fn print_verdicts(
    out: &mut impl Write,
    report: &DesignReport,
    frame: &FrameReport,
) -> Result<(), CommandError> {
    let (name, by) = (&report.structure.name, report.spectrum_words());
    let wobbling = frame.wobbling();
    let unsafe_upper_limits = report.unsafe_upper_limits();
    let verdict = |whose: &str, is_satisfied: bool| {
        let word = verdict_word(is_satisfied);
        let is_unsafe = unsafe_upper_limits.iter().any(|(of, _)| *of == whose);
        if is_unsafe { format!("{word}, not at the upper limit") } else { word.to_owned() }
    };
    let answer = match (wobbling.check, report.capacity_words()) {
        (Some(check), Some(capacity)) if check.required_capacity_m.is_finite() => {
            let (verdict, required_m) = (verdict(wobbling.model, check.satisfied), check.required_capacity_m);
            format!("{verdict}: {} requires {required_m:.2} m, {capacity}", wobbling.model)
        }
        (Some(check), Some(capacity)) => {
            let verdict = verdict_word(check.satisfied);
            let model = wobbling.model;
            format!("{verdict}: {model} overturns more often than the target, {capacity}")
        }
        _ => format!("{NO_CAPACITY}: {NO_CAPACITY_REASON}"),
    };
    writeln!(out, "Verdict   {name} by {by}: {answer}")?;
    print_proxy(out, report, wobbling.demand_m)?;
    if let Some(beyond) = report.beyond_tendon() {
        writeln!(out, "          {beyond}")?;
    }
    for (im, verdict) in report.verdicts_by_other_measures() {
        writeln!(out, "          {verdict}; frame: {}", measure_option(im))?;
    }
    print_own_spectrum(out, report)?;
    let dash = || "-".to_owned();
    let limit = frame.governing_limit();
    // where passing the limit tells how often the frame fails, that and not overturning
    let risk = |beyond: Option<LimitRisk>, overturning: &EventRisk, bands: Option<&DemandBands>| {
        let (risk, bands) = match beyond.filter(|_| limit.is_some()) {
            Some(beyond) => (beyond.risk, beyond.bands),
            None => (*overturning, bands.and_then(|of| of.overturning_per_year)),
        };
        risk_cells(&risk)[0].clone() + &marked_band_in_cell(bands.filter(|_| risk.per_year > 0.0))
    };
    let demand = |demand_m: f64, bands: Option<&DemandBands>| {
        if demand_m.is_infinite() {
            metres_or_overturns(demand_m)
        } else {
            let bands = bands.map(|of| of.demand_m);
            cell_with_band(demand_m, bands.map(|of| of.quoted())) + mark_of(bands)
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
            risk(of.beyond_limit, &of.overturning, bands),
        ]);
    }
    if let Some(exact) = &report.exact {
        let bands = exact.bands.as_ref();
        rows.push([
            OSCILLATOR.to_owned(),
            demand(exact.demand_m, bands),
            report.own_check.map_or_else(dash, |check| required(check.required_capacity_m)),
            report.own_check.map_or_else(dash, |check| verdict(OSCILLATOR, check.satisfied)),
            risk(frame.proxy_beyond_limit, &exact.overturning, bands),
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
    let table = Table::from_rows(&rows)
        .left("model", |row| &row[0])
        .right("demand, m", |row| &row[1])
        .right(format!("requires (×{}), m", report.required_safety_factor), |row| &row[2])
        .left("verdict", |row| &row[3])
        .right(format!("{}, 1/yr", limit.map_or_else(|| "overturns".to_owned(), |limit| limit.in_heading())), |row| {
            &row[4]
        })
        .to_string();
    writeln!(out, "{table}")?;
    if frame.models.iter().any(|of| of.demand_m == 0.0) {
        writeln!(out, "A demand of 0: the frame does not uplift at this risk")?;
    }
    print_by_earthquake(out, &table)?;
    print_mark(out, report)
}

/// The verdict on the proxy, and how far the frame, whose demand is `demand_m`, moves beside it.
fn print_proxy(out: &mut impl Write, report: &DesignReport, demand_m: f64) -> Result<(), CommandError> {
    let by = report.spectrum_words();
    let of_proxy = report.verdict_on_proxy().map(|verdict| format!("{OSCILLATOR} by {by}: {verdict}"));
    let how_far = match report.frame_over_proxy() {
        Some(ratio) => Some(format!("frame moves {ratio:.1} times as far")),
        None if demand_m.is_infinite() => None,
        None if demand_m == 0.0 => Some("the frame does not uplift".to_owned()),
        None => Some("the oscillator has no demand to compare with".to_owned()),
    };
    let second: Vec<String> = of_proxy.into_iter().chain(how_far).collect();
    if !second.is_empty() {
        writeln!(out, "          {}", second.join("; "))?;
    }
    Ok(())
}

/// The command that makes the spectrum of the structure's own oscillator, where the result has another: the run of the
/// result with other settings, beside it.
pub(super) fn print_own_spectrum(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    // a study that came by standard input cannot be named
    let Some(settings) = report.own_oscillator.as_ref().filter(|_| report.source.study_file != "-") else {
        return Ok(());
    };
    let ReportSource { result, study_file, overrides, .. } = &report.source;
    // a key that the oscillator sets anew is not said twice
    let is_kept = |setting: &&String| {
        setting.split_once('=').is_none_or(|(key, _)| !settings.contains(&format!("--set {}=", key.trim())))
    };
    let kept = overrides.iter().filter(is_kept).flat_map(|setting| [" --set ".to_owned(), typed(setting)]);
    let kept: String = kept.collect();
    let name = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let own = result.with_file_name(format!("{}-{}.h5", name(result), name(&report.structure.file)));
    let (study, own) = (typed(study_file), typed_path(&own));
    Ok(writeln!(out, "          own oscillator's spectrum: uplift run {study}{kept} {settings} -o {own}")?)
}

/// A capacity that is required, m.
fn required(capacity_m: f64) -> String {
    if capacity_m.is_finite() { format!("{capacity_m:.2}") } else { "∞".to_owned() }
}

/// A rule in a table that has its demand and the capacity that it requires: by equal energy that is not the demand
/// times the safety factor.
pub(super) fn rule_cell(rule: Rule) -> String {
    if rule == Rule::EqualEnergy { format!("{}‡", rule.words()) } else { rule.words().to_owned() }
}

/// What the mark of [`rule_cell`] means, where it is.
pub(super) fn print_mark(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    if report.rules.iter().any(|outcome| outcome.rule == Rule::EqualEnergy && outcome.check().is_some()) {
        writeln!(out, "‡ rises with capacity")?;
    }
    Ok(())
}
