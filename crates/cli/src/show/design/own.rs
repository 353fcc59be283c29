//! What a design says first of a structure that is analysed itself: a frame or a block.

use std::io::Write;
use std::path::Path;

use uplift::structure::{
    DemandBands, DesignReport, EventRisk, LimitRisk, OSCILLATOR, OwnReport, ReportSource, verdict_word,
};
use uplift::text::{Table, cell_with_band, metres_or_overturns, typed, typed_path};
use uplift_structure::{NO_CAPACITY, NO_CAPACITY_REASON, Rule};

use crate::error::CommandError;
use crate::show::structure::{doubt, mark_of, marked_band_in_cell, measure_option, print_by_earthquake, risk_cells};

/// The verdicts on a structure itself and on its proxy, with demand and risk of each.
pub(super) fn print_verdicts(
    out: &mut impl Write,
    report: &DesignReport,
    itself: &OwnReport,
) -> Result<(), CommandError> {
    let (name, by) = (&report.structure.name, report.spectrum_words());
    let (own, noun) = (itself.decisive(), itself.noun());
    // what the oscillator needs, so that the first line says by how much the two differ
    let of_oscillator = |verb: &str| match report.own_check.map(|check| check.required_capacity_m) {
        Some(required_m) if required_m.is_finite() => format!(", its {OSCILLATOR} {verb}{required_m:.2} m"),
        _ => String::new(),
    };
    let answer = match (own.check, report.capacity_words()) {
        (Some(check), Some(capacity)) if check.required_capacity_m.is_finite() => {
            let (verdict, required_m) = (report.verdict_of(check), check.required_capacity_m);
            format!("{verdict}: {} requires {required_m:.2} m{}; {capacity}", own.model, of_oscillator(""))
        }
        (Some(check), Some(capacity)) => {
            let verdict = verdict_word(check.satisfied);
            let oscillator = of_oscillator("requires ");
            format!("{verdict}: {} overturns more often than the target{oscillator}; {capacity}", own.model)
        }
        _ => format!("{NO_CAPACITY}: {NO_CAPACITY_REASON}: no rule applies"),
    };
    writeln!(out, "Verdict   {name} by {by}: {}{answer}", doubt(&report.alarms))?;
    print_proxy(out, report, itself)?;
    print_unread(out, report)?;
    if let Some(beyond) = report.beyond_tendon() {
        writeln!(out, "          {beyond}")?;
    }
    for (im, verdict) in report.verdicts_by_other_measures() {
        writeln!(out, "          {verdict}; {noun}: {}", measure_option(im))?;
    }
    if report.other_oscillator {
        writeln!(out, "          spectrum of another oscillator: --details")?;
    }
    print_assumed(out, report)?;
    let dash = || "-".to_owned();
    let limit = itself.governing_limit();
    // where passing the limit tells how often the structure fails, that and not overturning
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
    // in a plane it loses energy as its oscillator does, and not as much
    let model = |model: &str, restitution: Option<f64>| match restitution.filter(|_| !itself.wobbles()) {
        Some(restitution) => format!("{model}, restitution {restitution:.3}"),
        None => model.to_owned(),
    };
    let mut rows: Vec<[String; 5]> = Vec::new();
    for of in &itself.models {
        let bands = of.bands.as_ref();
        rows.push([
            model(of.model, Some(of.restitution)),
            demand(of.demand_m, bands),
            of.check.map_or_else(dash, |check| required(check.required_capacity_m)),
            of.check.map_or_else(dash, |check| check.verdict()),
            risk(of.beyond_limit, &of.overturning, bands),
        ]);
    }
    if let Some(exact) = &report.exact {
        let bands = exact.bands.as_ref();
        rows.push([
            model(OSCILLATOR, report.structure.restitution),
            demand(exact.demand_m, bands),
            report.own_check.map_or_else(dash, |check| required(check.required_capacity_m)),
            report.own_check.map_or_else(dash, |check| check.verdict()),
            risk(itself.proxy_beyond_limit, &exact.overturning, bands),
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
    if itself.models.iter().any(|of| of.demand_m == 0.0) {
        writeln!(out, "A demand of 0: the {noun} does not uplift at this risk")?;
    }
    print_by_earthquake(out, &table)?;
    print_mark(out, report)
}

/// What the structure file does not have, and was assumed.
pub(super) fn print_assumed(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    if !report.assumed.is_empty() {
        writeln!(out, "Assumed   {}: not in the structure file", report.assumed.join(", "))?;
    }
    Ok(())
}

/// Why the spectrum has no value for the structure, where it has none.
pub(super) fn print_unread(out: &mut impl Write, report: &DesignReport) -> Result<(), CommandError> {
    Ok(report.unread.iter().try_for_each(|why| writeln!(out, "          {why}"))?)
}

/// The verdict on the proxy; where the first line does not tell what both need, how far the structure itself moves
/// beside it.
fn print_proxy(out: &mut impl Write, report: &DesignReport, itself: &OwnReport) -> Result<(), CommandError> {
    let (by, demand_m, noun) = (report.spectrum_words(), itself.decisive().demand_m, itself.noun());
    let of_proxy = report.verdict_on_proxy().map(|verdict| format!("{OSCILLATOR} by {by}: {verdict}"));
    let how_far = match report.own_over_proxy() {
        Some(_) if report.own_check.is_some() => None,
        Some(ratio) => Some(format!("{noun} moves {ratio:.1} times as far")),
        None if demand_m.is_infinite() => None,
        None if demand_m == 0.0 => Some(format!("the {noun} does not uplift")),
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
