//! Displacements of uniform risk with their confidence bands.

use std::io::Write;
use std::path::Path;

use uplift::spectrum::SpectrumReport;
use uplift::text::{
    HAZARD_OF_REPAIR, Table, cell_with_band, counted, kind_of_risks, metres_with_named_band, per_cent, risk_in_words,
    risk_name, rounded, two_digits,
};
use uplift::uniform_risk::{CONFIDENCE, Displacement, DisplacementReport};

use super::alarms::print_result_warnings;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Displacements that were asked for: a line each for one strength, else a table.
pub(crate) fn print_spectrum(report: &SpectrumReport, result: &Path, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    match &report.found.displacements[..] {
        [first, rest @ ..] if rest.iter().all(|own| own.strength == first.strength) => {
            print_answers(out, &report.found)?;
        }
        _ => print_displacements(out, &report.found)?,
    }
    if terminal.shows_details() {
        print_oscillator(out, &report.found)?;
    }
    print_result_warnings(out, &report.alarms, result, terminal)
}

/// What the displacements are of.
pub(super) fn print_oscillator(out: &mut impl Write, report: &DisplacementReport) -> Result<(), CommandError> {
    let drawn = if report.structures > 1 { "; uncertain, drawn as [uncertainty] says" } else { "" };
    Ok(writeln!(out, "Oscillator: {}{drawn}", report.oscillator.in_words())?)
}

/// The number first, then what it is of.
fn print_answers(out: &mut impl Write, report: &DisplacementReport) -> Result<(), CommandError> {
    let repaired = if report.repaired { ", repaired" } else { "" };
    let of = Some(report.band_of.words()).filter(|words| !words.is_empty());
    let of = of.map_or_else(String::new, |words| format!(", band{words}"));
    for own in &report.displacements {
        let Displacement { site, im, strength, u_m, band_m, .. } = own;
        let displacement = if u_m.is_nan() {
            "No repaired spectrum".to_owned()
        } else {
            metres_with_named_band(*u_m, *band_m, CONFIDENCE)
        };
        let capacity = report.capacity_m.map_or_else(String::new, |capacity_m| format!(", capacity {capacity_m} m"));
        writeln!(out, "{displacement}  {site}, strength {strength}, {}, by {im}{repaired}{capacity}{of}", risk(own))?;
        if let Some([lower, upper]) = own.band_with_hazard_m.map(|limits_m| limits_m.map(two_digits)) {
            writeln!(out, "  with its weighted hazard curves: {} band {lower} to {upper} m", per_cent(CONFIDENCE))?;
        }
    }
    print_below(out, report)
}

/// Which hazard repaired displacements are of where a site has several curves; what displacements mean at which the
/// structure does not rock yet. Nothing where there is neither.
fn print_below(out: &mut impl Write, report: &DisplacementReport) -> Result<(), CommandError> {
    if report.without_curves {
        writeln!(out, "Hazard: {HAZARD_OF_REPAIR}")?;
    }
    let uplift_m = report.oscillator.uplift_displacement_m;
    if report.displacements.iter().any(|own| 0.0 < own.u_m && own.u_m < uplift_m) {
        writeln!(out, "Below {uplift_m} m the structure does not uplift: no design values")?;
    }
    Ok(())
}

/// A return period where one was asked for, else the probability.
fn risk(own: &Displacement) -> String {
    risk_in_words(own.poe, own.years).split(" (").next().unwrap_or_default().to_owned()
}

/// What they are, then a row a site and risk, a column a strength.
pub(super) fn print_displacements(out: &mut impl Write, report: &DisplacementReport) -> Result<(), CommandError> {
    let [first, ..] = &report.displacements[..] else { return Ok(()) };
    let of_row = |own: &Displacement| (own.site.clone(), own.poe);
    let rows: Vec<&[Displacement]> = report.displacements.chunk_by(|a, b| of_row(a) == of_row(b)).collect();
    let sites = rows.chunk_by(|a, b| a[0].site == b[0].site).count();
    let risks = rows.len() / sites.max(1);
    let record = if report.synthetic { "synthetic record" } else { "record" };
    let kind = if report.repaired { "Repaired uniform risk spectra" } else { "Uniform risk spectra" };
    let poes: Vec<f64> = rows.iter().map(|row| row[0].poe).collect();
    let risk = if risks == 1 { Some(risk(first)) } else { kind_of_risks(&poes, first.years) };
    let risk = risk.map_or_else(String::new, |risk| format!("{risk}, "));
    let records = counted(report.records / report.structures.max(1), record);
    let structures =
        if report.structures > 1 { format!(" × {} structures", report.structures) } else { String::new() };
    writeln!(out, "\n{kind}, {records}{structures}, {risk}by {}", first.im)?;
    let capacity = report.capacity_m.map_or_else(String::new, |capacity_m| format!(", capacity {capacity_m} m"));
    let is_banded = report.displacements.iter().any(|own| own.band_m.is_some());
    // wider than the number of records suggests
    let of = report.band_of.words();
    let band = if is_banded { format!(" ({} band{of})", per_cent(CONFIDENCE)) } else { String::new() };
    writeln!(out, "Displacement, m{band}, at strength{capacity}")?;
    // again below with the band over the weighted hazard curves of a site that has them
    let with_hazard = |row: &[Displacement]| row.iter().any(|own| own.band_with_hazard_m.is_some());
    let lines = rows.iter().flat_map(|&row| [Some((row, false)), with_hazard(row).then_some((row, true))]).flatten();
    let table = Table::from_rows(lines)
        .left("site", |(row, again)| if again { "  with its hazard curves".to_owned() } else { row[0].site.clone() })
        .when(risks > 1, |table| table.right("risk", |(row, _)| risk_name(row[0].poe, row[0].years)))
        .each(0..rows[0].len(), |table, column| {
            let heading = rounded(rows[0][column].strength, 6).to_string();
            table.right(heading, move |(row, again)| {
                let own = &row[column];
                cell_with_band(own.u_m, if again { own.band_with_hazard_m } else { own.band_m })
            })
        });
    writeln!(out, "{table}")?;
    if report.repaired && report.displacements.iter().any(|own| own.u_m.is_nan()) {
        writeln!(out, "none: no weights match both hazard curves of the site")?;
    }
    print_below(out, report)
}

/// The displacements as CSV, with all their digits; the warnings where they are in nobody's way.
pub(crate) fn print_spectrum_csv(
    report: &SpectrumReport,
    result: &Path,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    output().write_all(&report.found.csv()?)?;
    print_result_warnings(&mut std::io::stderr(), &report.alarms, result, terminal)
}
