//! `uplift hazard show`: what a curve file holds.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use uplift_hazard::{HazardCurve, rate_from_probability};

use super::{CommandError, NamedCurve, SiteArguments, TableArguments, read};
use uplift::text::{per_cent, table};

/// Probabilities in 50 years at which levels are told.
const PROBABILITIES: [f64; 5] = [0.5, 0.2, 0.1, 0.05, 0.02];
const YEARS: f64 = 50.0;

/// Curves shown of a file with many.
const SHOWN: usize = 20;

#[derive(Debug, Args)]
pub(super) struct ShowArguments {
    /// Table with two columns, or an export of OpenQuake (CSV, NRML) or the USGS (JSON); .gz too
    file: PathBuf,
    #[command(flatten)]
    site: SiteArguments,
    #[command(flatten)]
    table: TableArguments,
}

pub(super) fn show(arguments: &ShowArguments) -> Result<(), CommandError> {
    let curves = read(&arguments.file, &arguments.site, &arguments.table)?;
    let mut out = std::io::stdout().lock();
    let mut rows = Vec::new();
    for NamedCurve { name, curve } in curves.iter().take(SHOWN) {
        let mut row = vec![name.clone(), format!("{} [{}]", curve.measure(), curve.unit())];
        for probability in PROBABILITIES {
            row.push(level(curve, probability));
        }
        row.push(format!("{:.3e} - {:.3e}", curve.first().im, curve.last().im));
        rows.push(row);
    }
    let probabilities: Vec<String> = PROBABILITIES.iter().map(|&probability| per_cent(probability)).collect();
    let mut header = vec!["curve", "measure"];
    header.extend(probabilities.iter().map(String::as_str));
    header.push("levels");
    writeln!(out, "{}", table(&header, &rows))?;
    writeln!(
        out,
        "\nLevels exceeded with the stated probability in {YEARS} years; a dash where the curve does not reach."
    )?;
    if curves.len() > SHOWN {
        writeln!(out, "{} curves, the first {SHOWN} shown: --name or --near LON,LAT picks a site", curves.len())?;
    }
    if let [NamedCurve { curve, .. }] = curves.as_slice() {
        let component = curve.component().map_or_else(|| "not said".to_owned(), |component| component.to_string());
        writeln!(out, "Horizontal components: {component}\n{} levels, source:", curve.len())?;
        for line in curve.source().lines() {
            writeln!(out, "  {line}")?;
        }
    }
    Ok(())
}

fn level(curve: &HazardCurve, probability: f64) -> String {
    let rate = rate_from_probability(probability, YEARS);
    rate.and_then(|rate| curve.im_at_rate(rate)).map_or_else(|_| "-".to_owned(), |level| format!("{level:.4}"))
}
