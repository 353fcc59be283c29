//! Variants of a study side by side.

use std::collections::BTreeSet;
use std::io::Write;

use uplift::sweep::{SweepReport, VariantReport};
use uplift::text::{Table, metres, nearest, risk_in_words};

use super::alarms::{SHOWN, warning};
use super::{print_more, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

/// The displacements of every variant at a few strengths, by each measure and site, for the rarest risk.
pub(crate) fn print_sweep(report: &SweepReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    let Some(first) = report.variants.first() else { return Ok(()) };
    let spectra = || report.variants.iter().flat_map(|variant| &variant.spectra);
    let measures: BTreeSet<&str> = spectra().map(|spectrum| spectrum.im).collect();
    let mut sites: Vec<&str> = Vec::new();
    for spectrum in spectra() {
        if !sites.contains(&spectrum.site.as_str()) {
            sites.push(&spectrum.site);
        }
    }
    let synthetic = if first.synthetic { " (synthetic records)" } else { "" };
    let mut header: Vec<&str> = report.keys.iter().map(String::as_str).collect();
    let is_repaired = spectra().any(|spectrum| spectrum.repaired_m.is_some());
    let u_m = if is_repaired { "m (repaired)" } else { "m" };
    header.extend(["risk", "strength", u_m, "strength", u_m, "strength", u_m]);
    let shown = if terminal.shows_details() { usize::MAX } else { 1 };
    for im in measures.into_iter().rev().take(shown) {
        for site in &sites {
            let rows = report.variants.iter().map(|variant| row(variant, im, site));
            let table = Table::new(header.iter().copied(), rows);
            writeln!(out, "\nUniform risk spectra by {im} at {site}: displacement in m{synthetic}\n{table}")?;
        }
    }
    if !terminal.is_quiet() {
        print_cautions(out, report, shown)?;
        writeln!(out, "\nTable    {}", shown_path(&report.table).display())?;
    }
    print_more(out, terminal)
}

/// What is to be seen to before the numbers are used, once for all variants of which it is to be said.
fn print_cautions(out: &mut impl Write, report: &SweepReport, shown: usize) -> Result<(), CommandError> {
    let mut said: Vec<(String, Vec<&str>)> = Vec::new();
    for variant in &report.variants {
        for alarm in &variant.alarms {
            let line = warning(alarm);
            match said.iter_mut().find(|(known, _)| *known == line) {
                Some((_, variants)) => variants.push(&variant.name),
                None => said.push((line, vec![&variant.name])),
            }
        }
    }
    if !said.is_empty() {
        writeln!(out, "\nWarnings")?;
    }
    let (count, shown) = (said.len(), shown.max(SHOWN));
    for (line, variants) in said.into_iter().take(shown) {
        let all = variants.len() == report.variants.len();
        let of = if all { "all variants".to_owned() } else { variants.join(", ") };
        writeln!(out, "  {line} ({of})")?;
    }
    if count > shown { Ok(writeln!(out, "  {} more: --details", count - shown)?) } else { Ok(()) }
}

/// One variant: its values, and its displacements at the strengths nearest to those shown.
fn row(variant: &VariantReport, im: &str, site: &str) -> Vec<String> {
    let mut cells: Vec<String> =
        variant.values.iter().map(|value| value.clone().unwrap_or_else(|| "as it stands".to_owned())).collect();
    let own = variant.spectra.iter().filter(|spectrum| spectrum.im == im && spectrum.site == site);
    let rarest = own.min_by(|a, b| a.poe.total_cmp(&b.poe));
    cells.push(rarest.map_or_else(|| "-".to_owned(), |spectrum| risk_in_words(spectrum.poe, variant.years)));
    let shown = nearest(&variant.strengths, &SHOWN_STRENGTHS);
    for place in 0..SHOWN_STRENGTHS.len() {
        match (rarest, shown.get(place)) {
            (Some(spectrum), Some(&at)) => {
                let repaired = spectrum.repaired_m.as_ref().map(|repaired_m| match repaired_m[at] {
                    u_m if u_m.is_nan() => " (none)".to_owned(),
                    u_m => format!(" ({})", metres(u_m)),
                });
                let u_m = metres(spectrum.u_m[at]) + &repaired.unwrap_or_default();
                cells.extend([format!("{:.3}", variant.strengths[at]), u_m]);
            }
            _ => cells.extend(["-".to_owned(), "-".to_owned()]),
        }
    }
    cells
}
