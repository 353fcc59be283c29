//! What a run found, whatever the kind of its study.

use std::io::Write;

use uplift::analysis::ShardReport;
use uplift::result::{ResultFile, SiteRanges};
use uplift::run::{RunHead, RunReport};
use uplift::text;
use uplift::text::{Table, cell_with_band, counted, metres, risk_in_words, risk_name, rounded};
use uplift::uniform_risk::{
    BranchReport, DisplacementOptions, DisplacementReport, RunReport as UniformRiskReport, TargetRisks, displacements,
};

use super::alarms::print_result_warnings;
use super::spectrum::{print_displacements, print_oscillator};
use super::{displacement, print_answer_json, print_json, shake_table, shown_path, typed_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The spectrum, warnings, and where the files are; a quiet terminal gets the spectrum and probable mistakes.
pub(crate) fn print_run(report: &RunReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    if let RunReport::UniformRisk(report) = report
        && let Some(ranges) = &report.site_table
    {
        print_site_ranges(&mut out, ranges)?;
    }
    match report {
        RunReport::UniformRisk(report) if terminal.shows_details() => print_details(&mut out, report)?,
        RunReport::UniformRisk(report) => {
            // where no site has a repaired spectrum, a warning says so
            let has_any = |found: &&DisplacementReport| found.displacements.iter().any(|own| !own.u_m.is_nan());
            for found in report.displacements.iter().chain(report.repaired.iter().filter(has_any)) {
                print_displacements(&mut out, found)?;
            }
        }
        RunReport::Displacement(report) => displacement::print_spectra(&mut out, report)?,
        RunReport::ShakeTable(report) => shake_table::print_tests(&mut out, &report.table)?,
    }
    print_end(&mut out, report.head(), terminal)?;
    if terminal.is_quiet() {
        return Ok(());
    }
    print_pages(&mut out, report)?;
    if let RunReport::UniformRisk(report) = report
        && let Some(found) = &report.displacements
    {
        return print_next(&mut out, found, &report.head);
    }
    let more = match report {
        RunReport::Displacement(report) if report.has_design => "Design",
        RunReport::ShakeTable(_) => "Tests",
        RunReport::UniformRisk(_) | RunReport::Displacement(_) => return Ok(()),
    };
    let result = report.head().files.first().map(|result| shown_path(result).display().to_string());
    Ok(writeln!(out, "{more:<8} uplift table {}", result.unwrap_or_default())?)
}

/// The report as JSON.
pub(crate) fn print_run_json(report: &RunReport) -> Result<(), CommandError> {
    match report.head().files.first() {
        Some(result) => print_answer_json(report, result),
        None => print_json(report),
    }
}

/// Between which displacements the sites of a table lie.
fn print_site_ranges(out: &mut impl Write, ranges: &SiteRanges) -> Result<(), CommandError> {
    let SiteRanges { poe, years, sites, strengths, measures } = ranges;
    let (risk, sites) = (risk_in_words(*poe, *years), counted(*sites, "site"));
    writeln!(out, "\nUniform risk spectra of a table of {sites}, {risk}")?;
    writeln!(out, "Displacement, m, smallest to largest of the sites, at strength")?;
    let range = |of: Option<[f64; 2]>| {
        of.map_or_else(|| "-".to_owned(), |of| of.map(|displacement_m| cell_with_band(displacement_m, None)).join("–"))
    };
    let table = Table::from_rows(measures)
        .left("measure", |of| &of.im)
        .right("sites", |of| of.sites.to_string())
        .each(0..strengths.len(), |table, column| {
            table.right(rounded(strengths[column], 6).to_string(), move |of| range(of.range_m[column]))
        });
    Ok(writeln!(out, "{table}")?)
}

/// The spectra by every measure and for every risk, and their spread over hazard curves and structures.
fn print_details(out: &mut impl Write, report: &UniformRiskReport) -> Result<(), CommandError> {
    let (Some(path), Some(shown)) = (report.head.files.first(), &report.displacements) else { return Ok(()) };
    let file = ResultFile::open(path)?;
    let axes = file.axes()?;
    let is_repaired = report.repaired.is_some();
    for measure in file.measures() {
        for repaired in [false, true].into_iter().filter(|repaired| is_repaired || !repaired) {
            let risk = TargetRisks { poe: axes.poes.clone(), ..TargetRisks::default() };
            let asked =
                DisplacementOptions { risk, measure: Some(measure), repaired, ..DisplacementOptions::default() };
            print_displacements(out, &displacements(&file, &asked)?)?;
        }
    }
    print_oscillator(out, shown)?;
    for (over, spread) in [("weighted hazard curves", &report.branches), ("possible structures", &report.structures)] {
        print_spread(out, over, spread, (shown, &axes.strengths))?;
    }
    Ok(())
}

/// Mean and fractiles of spectra over weighted hazard curves or structures, at the strengths `shown`.
fn print_spread(
    out: &mut impl Write,
    over: &str,
    spread: &[BranchReport],
    (shown, strengths): (&DisplacementReport, &[f64]),
) -> Result<(), CommandError> {
    let [first, ..] = &shown.displacements[..] else { return Ok(()) };
    let of_first = shown.displacements.iter().take_while(|own| own.site == first.site);
    let wanted: Vec<f64> = of_first.map(|own| own.strength).collect();
    let places = text::nearest(strengths, &wanted);
    let table = Table::from_rows(spread.iter().flat_map(|of| places.iter().map(move |&strength| (of, strength))))
        .left("site", |(of, _)| &of.site)
        .right("im", |(of, _)| of.im)
        .right("risk", |(of, _)| risk_name(of.probability, first.years))
        .right("strength", |(_, strength)| format!("{:.3}", strengths[strength]))
        .right("5 %", |(of, strength)| metres(of.low_m[strength]))
        .right("mean", |(of, strength)| metres(of.mean_m[strength]))
        .right("95 %", |(of, strength)| metres(of.high_m[strength]));
    if !table.is_empty() {
        writeln!(out, "\nSpread over the {over}: displacement in m, 5 and 95 % fractile and mean\n{table}")?;
    }
    Ok(())
}

/// What every run ends with: warnings and files.
fn print_end(out: &mut impl Write, head: &RunHead, terminal: &Terminal) -> Result<(), CommandError> {
    let Some((result, tables)) = head.files.split_first() else { return Ok(()) };
    print_result_warnings(out, &head.alarms, result, terminal)?;
    if terminal.is_quiet() {
        return Ok(());
    }
    let shown = shown_path(result).display();
    let done_already = if head.done_already { " (done already; recompute: --again)" } else { "" };
    writeln!(out, "\nResult   {shown}{done_already}")?;
    // every result with spectra has the first two beside it
    let is_usual = |name: &str| name.ends_with(".urs.csv") || name.ends_with(".regression.csv");
    let tables = tables.iter().map(|table| shown_path(table).display().to_string());
    let tables: Vec<String> = tables.filter(|table| terminal.shows_details() || !is_usual(table)).collect();
    if !tables.is_empty() {
        writeln!(out, "Tables   {}", tables.join(", "))?;
    }
    Ok(())
}

/// The command for the report, or for the map of a table of sites, which has no report.
fn print_pages(out: &mut impl Write, report: &RunReport) -> Result<(), CommandError> {
    let Some((result, tables)) = report.head().files.split_first() else { return Ok(()) };
    let typed = typed_path(result);
    let has_map = tables.iter().any(|table| table.extension().is_some_and(|extension| extension == "geojson"));
    match report {
        RunReport::UniformRisk(report) if report.displacements.is_some() => {}
        RunReport::UniformRisk(_) if has_map => return Ok(writeln!(out, "Map      uplift plot {typed} --only map")?),
        RunReport::UniformRisk(_) => return Ok(()),
        RunReport::Displacement(_) | RunReport::ShakeTable(_) => {}
    }
    Ok(writeln!(out, "Report   uplift report {typed}")?)
}

/// How other strengths and return periods are asked for.
fn print_next(out: &mut impl Write, found: &DisplacementReport, head: &RunHead) -> Result<(), CommandError> {
    /// What structures are usually designed for.
    const RETURN_PERIOD: f64 = 475.0;
    let ([first, rest @ ..], Some(result)) = (&found.displacements[..], head.files.first()) else { return Ok(()) };
    // between two strengths that are shown the result has any
    let strength = rest.iter().map(|own| own.strength).find(|strength| *strength != first.strength);
    let strength = strength.map_or(first.strength, |next| rounded(f64::midpoint(first.strength, next), 2));
    let period = if first.years < RETURN_PERIOD { format!(" --return-period {RETURN_PERIOD}") } else { String::new() };
    Ok(writeln!(out, "Next     uplift spectrum {} --strength {strength}{period}", typed_path(result))?)
}

/// Which shard was computed, and where it is.
pub(crate) fn print_shard(report: &ShardReport, terminal: &Terminal) -> Result<(), CommandError> {
    if terminal.is_quiet() {
        return Ok(());
    }
    let ShardReport { shard, shards, rows, file } = report;
    let file = shown_path(file).display();
    Ok(writeln!(output(), "shard {shard} of {shards}, {rows} analysis rows: {file}")?)
}
