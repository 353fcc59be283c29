//! What a run of a study of displacement spectra found: the medians at a few strengths or slendernesses.

use std::io::Write;

use uplift::displacement::RunReport;
use uplift::text::{metres, nearest, table};
use uplift_study::Structures;

use crate::error::CommandError;

/// Strengths or slendernesses shown.
const SHOWN: [f64; 3] = [0.1, 0.2, 0.4];

pub(super) fn print_spectra(out: &mut impl Write, report: &RunReport) -> Result<(), CommandError> {
    let abscissa = report.structures.abscissa();
    let shown = nearest(abscissa, &SHOWN);
    // of the lines, the one that overturns last
    let (line, [name, which]) = match &report.structures {
        Structures::Oscillators(family) => (family.capacity_m.len() - 1, ["strength", "smallest u_up, largest u_cap"]),
        Structures::Blocks(family) => (family.height_m.len() - 1, ["tan(alpha)", "largest block"]),
    };
    let middle = nearest(&report.percentiles, &[50.0])[0];
    writeln!(
        out,
        "\nDisplacement spectra, {} % of each set, {which}: displacement in m{}",
        report.percentiles[middle],
        if report.head.synthetic { " (synthetic records)" } else { "" }
    )?;
    let header: Vec<String> = ["record set", "scaling", "by"]
        .map(str::to_owned)
        .into_iter()
        .chain(shown.iter().map(|&at| format!("{name} {:.3}", abscissa[at])))
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let row = |spectra: &uplift::displacement::SpectraReport| {
        let ordinates = &spectra.percentile_m[(line * report.percentiles.len() + middle) * abscissa.len()..];
        let ordinate = |&at: &usize| match ordinates[at] {
            f64::INFINITY => "overturns".to_owned(),
            ordinate => metres(ordinate),
        };
        let names = [spectra.record_set.clone(), spectra.scaling.clone(), spectra.scaled_by.to_owned()];
        names.into_iter().chain(shown.iter().map(ordinate)).collect()
    };
    let rows: Vec<Vec<String>> = report.spectra.iter().map(row).collect();
    writeln!(out, "{}", table(&header, &rows))?;
    Ok(())
}
