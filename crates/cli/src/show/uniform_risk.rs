//! What a run of a study of uniform risk found: the spectra at a few strengths.

use std::io::Write;

use uplift::text::{metres, nearest, risk_in_words, risk_name, table};
use uplift::uniform_risk::{BranchReport, RunReport};

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
fn spectra_table(report: &RunReport, own: &[&uplift::uniform_risk::SpectrumReport], shown: &[usize]) -> String {
    let mut header = vec!["site".to_owned()];
    for poe in &report.poes {
        header.push(risk_in_words(*poe, report.years).replace(" years", " yr"));
        header.extend(std::iter::repeat_n(String::new(), shown.len() - 1));
    }
    let displacement = |u_m: f64| if u_m.is_nan() { "-".to_owned() } else { metres(u_m) };
    // the spectra of a site follow each other, one a probability
    let row = |of_site: &[&uplift::uniform_risk::SpectrumReport]| {
        let cells = of_site.iter().flat_map(|spectrum| shown.iter().map(|&index| displacement(spectrum.u_m[index])));
        std::iter::once(of_site[0].site.clone()).chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = own.chunks(report.poes.len()).map(row).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    table(&header, &rows)
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
    let mut rows = Vec::new();
    for branches in spread {
        for &strength in shown {
            rows.push(vec![
                branches.site.clone(),
                branches.im.to_owned(),
                risk_name(report.poes[branches.poe], report.years),
                format!("{:.3}", report.strengths[strength]),
                metres(branches.low_m[strength]),
                metres(branches.mean_m[strength]),
                metres(branches.high_m[strength]),
            ]);
        }
    }
    if !rows.is_empty() {
        writeln!(out, "\nSpread over the {over}: displacement in m, 5 and 95 % fractile and mean")?;
        writeln!(out, "{}", table(&["site", "im", "probability", "strength", "5 %", "mean", "95 %"], &rows))?;
    }
    Ok(())
}
