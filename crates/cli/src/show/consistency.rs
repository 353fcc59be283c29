//! Whether the records bring the hazard of the other measure.

use std::io::Write;

use uplift::alarms::synthetic_records;
use uplift::consistency::{ConsistencyReport, ConsistencyRow, RepairRow, Verdict};
use uplift::text::{Table, per_cent, risk_name, risks_in_words};

use super::alarms::{DETAILS, print_shown, warning};
use super::{print_more, shown_path, typed_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The verdicts; in detail levels, scale factors, earthquakes and agreement. A quiet terminal gets the tables alone.
pub(crate) fn print_consistency(report: &ConsistencyReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    if report.rows.is_empty() {
        writeln!(out, "{}", report.note)?;
        return Ok(());
    }
    writeln!(out, "{}{}\n", answer(report), remedy(report).unwrap_or_default())?;
    print_table(out, report)?;
    if terminal.shows_details() {
        print_details(out, report)?;
    }
    if !terminal.is_quiet() {
        print_end(out, report, terminal)?;
    }
    // one pointer is enough
    if more_warnings(report) > 0 { Ok(()) } else { print_more(out, terminal) }
}

/// At how many sites, by how many measures records were reweighted; before a repair by which measure scaled records
/// fit the hazard of the other one, and by what factor they miss it at the worst site.
fn answer(report: &ConsistencyReport) -> String {
    if report.rows.iter().any(|row| row.repair.is_some()) {
        let repaired = report.rows.iter().filter(|row| is_repaired(row)).count();
        return format!("{repaired} of {} cases repaired", report.rows.len());
    }
    let several = report.rows.iter().any(|row| row.site != report.rows[0].site);
    let of_measure = report.rows.chunk_by(|a, b| a.scaled_to == b.scaled_to);
    let clause = |rows: &[ConsistencyRow]| {
        let (scaled_to, shows) = (rows[0].scaled_to, rows[0].shows);
        let misses = rows.iter().filter(|row| row.verdict != Some("consistent"));
        let worst = misses.filter_map(|row| Some((row, row.max?))).max_by(|(_, a), (_, b)| a.total_cmp(b));
        match worst {
            Some((row, _)) => {
                let site = if several { format!("{}, ", row.site) } else { String::new() };
                let verdict = row.verdict.unwrap_or("no verdict");
                let (off, mean) = match decisive(row) {
                    Some(most) => (format!("miss the site's {shows} by a factor of {most:.2} at the worst rate"), ""),
                    None => (format!("have {} times the site's {shows}", number(row.bias, 2)), "mean over rates, "),
                };
                format!("records scaled to {scaled_to} {off} ({mean}{site}{verdict})")
            }
            None if rows.iter().any(|row| row.verdict.is_none()) => format!("no verdict by {scaled_to}"),
            None => format!("records scaled to {scaled_to} fit the site's {shows}"),
        }
    };
    let clauses: Vec<String> = of_measure.map(clause).collect();
    let text = clauses.join("; ");
    text[..1].to_uppercase() + &text[1..]
}

/// How many times the level is off at the worst rate, where the mean alone would have another verdict.
fn decisive(row: &ConsistencyRow) -> Option<f64> {
    let decides = row.bias.is_some_and(|bias| row.verdict != Some(Verdict::from_bias(bias, 0.0).key()));
    most_off(row).filter(|_| decides)
}

/// How far each set of scaled records is from the site's hazard of the other measure.
fn print_table(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    let is_repaired = report.rows.iter().any(|row| row.repair.is_some());
    let before = |row: &ConsistencyRow| {
        let at_one_rate = decisive(row).filter(|_| !is_repaired);
        let at_one_rate = at_one_rate.map_or_else(String::new, |most| format!(" (factor {most:.2} at the worst rate)"));
        format!("{} {}{at_one_rate}", row.shows, number(row.bias, 2))
    };
    let repair = |row: &ConsistencyRow| -> Option<(String, &str, String)> {
        let RepairRow { failed: None, bias, max, least_effective: Some(effective), least_effective_of, .. } =
            row.repair.as_ref()?
        else {
            return None;
        };
        let verdict = Verdict::from_bias((*bias)?, (*max)?).key();
        let of = least_effective_of.unwrap_or(report.records);
        Some((number(*bias, 2), verdict, format!("{effective:.0}/{of}")))
    };
    let table = Table::from_rows(&report.rows)
        .left("site", |row| &row.site)
        .left("scaled to", |row| row.scaled_to)
        .right(if is_repaired { "mean ratio" } else { "times site's level, mean" }, before)
        .right("verdict", |row| row.verdict.unwrap_or("-"))
        .when(is_repaired, |table| {
            table
                .right("repaired", |row| repair(row).map_or_else(String::new, |(mean, ..)| mean))
                .right("verdict", |row| repair(row).map_or("", |(_, verdict, _)| verdict))
                .right("effective records", |row| repair(row).map_or_else(String::new, |(.., records)| records))
        });
    writeln!(out, "{table}")?;
    if is_repaired {
        return Ok(());
    }
    let limits = Verdict::ALL.iter().filter_map(|verdict| Some((verdict, verdict.limits()?)));
    let limits: Vec<String> = limits
        .map(|(verdict, ([least, most], largest))| {
            format!("{verdict}: {least} to {most}, factor {:.2} at worst", largest.exp())
        })
        .collect();
    Ok(writeln!(out, "{}", limits.join("; "))?)
}

fn print_details(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    print_levels(out, report)?;
    if !report.unasked.is_empty() {
        writeln!(out, "\nnot compared, since they lack curves of two measures: {}", report.unasked.join(", "))?;
    }
    print_scale_factors(out, report)?;
    print_earthquakes(out, report)?;
    print_two_sided(out, report)?;
    print_agreement(out, report)?;
    for line in report.synthetic.then(|| warning(&synthetic_records(), None)).iter().chain(&report.warnings) {
        writeln!(out, "\nWarning: {line}")?;
    }
    Ok(())
}

/// Whether weights repair the records of a row.
fn is_repaired(row: &ConsistencyRow) -> bool {
    row.repair.as_ref().is_some_and(|repair| repair.failed.is_none())
}

/// What to type behind or below the answer.
fn remedy(report: &ConsistencyReport) -> Option<String> {
    let result = typed_path(report.result.as_ref()?);
    if let Some(repaired) = report.rows.iter().find(|row| is_repaired(row)) {
        // without a word spectra are by the first measure
        let is_first = report.rows.first().is_some_and(|first| first.scaled_to == repaired.scaled_to);
        let measure = if is_first { String::new() } else { format!(" --measure {}", repaired.scaled_to) };
        return Some(format!(": uplift spectrum {result} --repaired{measure}"));
    }
    let is_missed = |row: &ConsistencyRow| row.verdict == Some("inconsistent") && row.repair.is_none();
    report.rows.iter().any(is_missed).then(|| format!("\nRepair: uplift consistency {result} --repair"))
}

/// Warnings, and where everything is.
fn print_end(out: &mut impl Write, report: &ConsistencyReport, terminal: &Terminal) -> Result<(), CommandError> {
    let Some(result) = report.result.as_ref().map(|result| shown_path(result).display()) else { return Ok(()) };
    if !terminal.shows_details() {
        print_warnings(out, report)?;
    }
    writeln!(out)?;
    writeln!(out, "Result   /consistency in {result}")?;
    if let Some(path) = &report.table {
        writeln!(out, "Table    {}", shown_path(path).display())?;
    }
    Ok(())
}

/// Why there is no repair, of the first row that has none: asked for and not there it is the answer.
fn nearest(report: &ConsistencyReport) -> Option<String> {
    report.rows.iter().find_map(|row| {
        let nearest = row.repair.as_ref()?.nearest.as_ref()?;
        Some(format!("{} by {}: no weights give the site's {}: {}", row.site, row.scaled_to, row.shows, nearest.worst))
    })
}

/// Warnings that details alone show: all but the first.
fn more_warnings(report: &ConsistencyReport) -> usize {
    report.warnings.len().saturating_sub(1)
}

/// What speaks against the records, and how many other warnings there are.
fn print_warnings(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    let synthetic = report.synthetic.then(|| warning(&synthetic_records(), None));
    let first = nearest(report).or_else(|| report.warnings.first().cloned());
    let shown: Vec<String> = first.into_iter().chain(synthetic).collect();
    print_shown(out, &shown, more_warnings(report), DETAILS)
}

/// A line a row that is not consistent, and one for all that are.
pub(super) fn consistency_lines(report: &ConsistencyReport) -> Vec<String> {
    let is_consistent = |row: &&ConsistencyRow| row.verdict == Some("consistent");
    let mut lines: Vec<String> = Vec::new();
    for row in report.rows.iter().filter(|row| !is_consistent(row)) {
        let (site, scaled_to, shows) = (&row.site, row.scaled_to, row.shows);
        lines.push(match (row.bias, row.verdict) {
            (Some(bias), Some(verdict)) => {
                let at_one_rate = most_off(row).map_or_else(String::new, |most| {
                    format!(", and miss it by a factor of {most:.2} at the worst rate")
                });
                format!(
                    "{site} by {scaled_to}: the records have on average {bias:.2} times the site's \
                     {shows}{at_one_rate}: {verdict} (uplift consistency)"
                )
            }
            _ => {
                format!("{site} by {scaled_to}: no verdict on {shows} (uplift consistency)")
            }
        });
    }
    let consistent = report.rows.iter().filter(is_consistent).count();
    if consistent > 0 {
        lines.push(format!("{consistent} of {} analyses are consistent with the other measure", report.rows.len()));
    }
    lines
}

/// How many times the level is off at the worst rate, where a mean that is nearly right hides it.
fn most_off(row: &ConsistencyRow) -> Option<f64> {
    let bias = row.bias?;
    row.max.map(f64::exp).filter(|most| *most > 1.1 * bias.max(1.0 / bias))
}

/// A number with a sensible number of digits, or a dash.
fn number(value: Option<f64>, decimals: usize) -> String {
    value.filter(|value| value.is_finite()).map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
}

/// The values of the probabilities, parted by strokes.
fn joined(row: &ConsistencyRow, value: impl Fn(&uplift::consistency::TargetRow) -> String) -> String {
    row.targets.iter().map(value).collect::<Vec<_>>().join(" / ")
}

fn probabilities(report: &ConsistencyReport) -> String {
    let Some(row) = report.rows.first() else { return String::new() };
    let poes: Vec<f64> = row.targets.iter().map(|target| target.poe).collect();
    risks_in_words(&poes, report.years, " / ")
}

fn print_levels(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    writeln!(
        out,
        "\nLevel of the other measure: scaled records over the site, at {};\nrate of reaching the site's level over \
         its target; mean and largest deviation over the rates compared",
        probabilities(report)
    )?;
    let repaired = report.rows.iter().any(|row| row.repair.is_some());
    let least = |row: &ConsistencyRow| {
        let of = |repair: &RepairRow| Some((repair.least_effective?, repair.least_effective_of?));
        let words = |(least, records)| format!("{} of {records}", number(Some(least), 0));
        row.repair.as_ref().and_then(of).map_or_else(|| format!("- of {}", report.records), words)
    };
    let table = Table::from_rows(&report.rows)
        .left("site", |row| &row.site)
        .right("scaled to", |row| row.scaled_to)
        .right("shows", |row| row.shows)
        .right("records over site", |row| joined(row, |target| number(target.ratio, 2)))
        .right("times as often", |row| joined(row, |target| number(target.times_as_often, 1)))
        .right("bias", |row| number(row.bias, 2))
        .right("max", |row| number(row.max, 2))
        .when(repaired, |table| table.right("effective, least", least))
        .right("verdict", |row| row.verdict.unwrap_or("-"));
    writeln!(out, "{table}")?;
    Ok(())
}

/// Magnitude and distance of the hazard beside those of the records, where disaggregations were given.
fn print_earthquakes(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    if report.earthquakes.is_empty() {
        return Ok(());
    }
    let is_repaired = report.rows.iter().any(|row| row.repair.is_some());
    let table = Table::from_rows(&report.earthquakes)
        .left("site", |row| &row.site)
        .right("scaled to", |row| row.scaled_to)
        .right("risk", |row| risk_name(row.poe, report.years))
        .right("M of hazard", |row| number(Some(row.mean_magnitude), 2))
        .right("records", |row| number(row.magnitude, 2))
        .when(is_repaired, |table| table.right("weighed", |row| number(row.repaired_magnitude, 2)))
        .bar("km of hazard", |row| number(Some(row.mean_distance_km), 0))
        .right("records", |row| number(row.distance_km, 0))
        .when(is_repaired, |table| table.right("weighed", |row| number(row.repaired_distance_km, 0)));
    writeln!(
        out,
        "\nEarthquakes: mean magnitude and distance of the site's hazard (disaggregation), and medians of the records"
    )?;
    writeln!(out, "{table}")?;
    Ok(())
}

fn print_scale_factors(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    let [least, largest] = report.scale_factors;
    writeln!(
        out,
        "\nScale factors, 5 / 50 / 95 %, at each probability; share outside {least} to {largest}; \
         effective\nearthquakes of {}",
        report.events.map_or_else(|| "unknown number".to_owned(), |events| events.to_string())
    )?;
    let targets = report.rows.iter().flat_map(|row| row.targets.iter().enumerate().map(move |of| (row, of)));
    let table = Table::from_rows(targets)
        .left("site", |(row, (index, _))| if index == 0 { row.site.as_str() } else { "" })
        .right("scaled to", |(row, (index, _))| if index == 0 { row.scaled_to } else { "" })
        .right("probability", |(_, (_, target))| per_cent(target.poe))
        .right("factors", |(_, (_, target))| target.scale_factors.map(|factor| format!("{factor:.2}")).join(" / "))
        .right("outside", |(_, (_, target))| format!("{:.0} %", (100.0 * target.outside_limits).max(0.0) + 0.0))
        .right("earthquakes", |(_, (_, target))| number(target.effective_events, 1));
    writeln!(out, "{table}")?;
    Ok(())
}

fn print_two_sided(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    if report.two_sided.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\nBoth analyses together, factors of the level: location, which other records can correct, and spread, which\n\
         no single set avoids"
    )?;
    let table = Table::from_rows(&report.two_sided)
        .left("site", |row| &row.site)
        .right("location", |row| format!("{:.2}", row.location.exp()))
        .right("spread", |row| format!("{:.2}", row.spread.exp()));
    writeln!(out, "{table}")?;
    Ok(())
}

fn print_agreement(out: &mut impl Write, report: &ConsistencyReport) -> Result<(), CommandError> {
    if report.agreement.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\nSpectra by PGA over spectra by PGV, displacements of 10 mm and more: geometric mean and range\n\
         (that they agree after the repair is a check of its numbers, not evidence)"
    )?;
    let shown = |found: &Option<(usize, f64, f64, f64)>| match found {
        Some((count, mean, least, most)) => format!("{mean:.2} ({least:.2} to {most:.2}, {count} ordinates)"),
        None => "-".to_owned(),
    };
    let table = Table::from_rows(&report.agreement)
        .left("site", |row| row.site.as_deref().unwrap_or("all sites"))
        .right("as they are", |row| shown(&row.plain))
        .right("repaired", |row| shown(&row.repaired));
    writeln!(out, "{table}")?;
    Ok(())
}
