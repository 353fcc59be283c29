//! What a run of a study of uniform risk found: the spectra at a few strengths.

use std::io::Write;

use uplift::text::{Table, TableOf, metres, nearest, risk_in_words, risk_name};
use uplift::uniform_risk::{BranchReport, RunReport, SpectrumReport};

use crate::error::CommandError;

/// Strengths shown.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

pub(super) fn print_spectra(out: &mut impl Write, report: &RunReport) -> Result<(), CommandError> {
    let shown = nearest(&report.strengths, &SHOWN_STRENGTHS);
    let at: Vec<String> = shown.iter().map(|&index| format!("{:.3}", report.strengths[index])).collect();
    for measure in &report.measures {
        let own: Vec<_> = report.spectra.iter().filter(|spectrum| spectrum.im == measure.im).collect();
        if own.is_empty() {
            continue;
        }
        writeln!(
            out,
            "\nUniform risk spectra by {}: displacement in m at strength {}{}",
            measure.im,
            at.join(", "),
            if report.head.synthetic { " (synthetic records)" } else { "" }
        )?;
        writeln!(out, "{}", spectra_table(report, &own, &shown))?;
    }
    print_branches(out, report, &shown)?;
    print_repaired(out, report, &shown)?;
    for (place, precision) in report.precision.iter().enumerate() {
        if place == 0 {
            writeln!(out, "\nHow sure:")?;
        }
        writeln!(out, "  {}", precision.words())?;
    }
    Ok(())
}

/// The spectra of weighted records, where the study asks for them.
fn print_repaired(out: &mut impl Write, report: &RunReport, shown: &[usize]) -> Result<(), CommandError> {
    for measure in &report.measures {
        let own: Vec<_> = report.repaired.iter().filter(|spectrum| spectrum.im == measure.im).collect();
        if own.is_empty() {
            continue;
        }
        writeln!(
            out,
            "\nBy {}, with the records weighted so that they bring the site's hazard of both measures",
            measure.im
        )?;
        writeln!(out, "{}", spectra_table(report, &own, shown))?;
    }
    if !report.repaired.is_empty() {
        for warning in &report.consistency.warnings {
            writeln!(out, "caution: {warning}")?;
        }
    }
    Ok(())
}

/// Displacements of the spectra of one measure: a row a site.
fn spectra_table<'a>(
    report: &RunReport,
    own: &'a [&'a SpectrumReport],
    shown: &[usize],
) -> TableOf<&'a [&'a SpectrumReport]> {
    let displacement = |u_m: f64| if u_m.is_nan() { "-".to_owned() } else { metres(u_m) };
    // the spectra of a site follow each other, one a probability
    let table = Table::of(own.chunks(report.poes.len())).left("site", |of_site| &of_site[0].site);
    table.each(report.poes.iter().enumerate(), |table, (poe, &probability)| {
        let risk = risk_in_words(probability, report.years).replace(" years", " yr");
        table.each(shown.iter().enumerate(), |table, (place, &strength)| {
            let heading = if place == 0 { risk.as_str() } else { "" };
            table.right(heading, |of_site| displacement(of_site[poe].u_m[strength]))
        })
    })
}

/// The spread of the spectra over weighted hazard curves and over the structures that may be, where there are such.
fn print_branches(out: &mut impl Write, report: &RunReport, shown: &[usize]) -> Result<(), CommandError> {
    for (over, spread) in [("weighted hazard curves", &report.branches), ("structures that may be", &report.structures)]
    {
        print_spread(out, over, (report, spread), shown)?;
    }
    Ok(())
}

fn print_spread(
    out: &mut impl Write,
    over: &str,
    (report, spread): (&RunReport, &[BranchReport]),
    shown: &[usize],
) -> Result<(), CommandError> {
    let table = Table::of(spread.iter().flat_map(|of| shown.iter().map(move |&strength| (of, strength))))
        .left("site", |(of, _)| &of.site)
        .right("im", |(of, _)| of.im)
        .right("probability", |(of, _)| risk_name(report.poes[of.poe], report.years))
        .right("strength", |(_, strength)| format!("{:.3}", report.strengths[strength]))
        .right("5 %", |(of, strength)| metres(of.low_m[strength]))
        .right("mean", |(of, strength)| metres(of.mean_m[strength]))
        .right("95 %", |(of, strength)| metres(of.high_m[strength]));
    if !table.is_empty() {
        writeln!(out, "\nSpread over the {over}: displacement in m, 5 and 95 % fractile and mean\n{table}")?;
    }
    Ok(())
}
