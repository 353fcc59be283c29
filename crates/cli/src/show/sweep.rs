//! Variants of a study side by side.

use std::collections::BTreeSet;
use std::io::Write;

use uplift::alarms::Severity;
use uplift::sweep::{SweepReport, VariantReport, VariantSpectrum};
use uplift::text::{Table, metres, nearest, risk_in_words, rounded};

use super::alarms::{SHOWN, print_lines, warning};
use super::{print_more, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

/// The displacements of every variant at a few strengths for the rarest risk, by the first measure; in detail by each.
pub(crate) fn print_sweep(report: &SweepReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    let Some(first) = report.variants.first() else { return Ok(()) };
    let spectra = || report.variants.iter().flat_map(|variant| &variant.spectra);
    let measures: BTreeSet<&str> = spectra().map(|spectrum| spectrum.im).collect();
    let shown = if terminal.shows_details() { usize::MAX } else { 1 };
    for im in measures.into_iter().rev().take(shown) {
        let mut sites: Vec<&str> = Vec::new();
        for spectrum in spectra().filter(|spectrum| spectrum.im == im) {
            if !sites.contains(&spectrum.site.as_str()) {
                sites.push(&spectrum.site);
            }
        }
        let synthetic = if first.synthetic { " (synthetic records)" } else { "" };
        let repaired = if spectra().any(|own| own.repaired_m.is_some()) { " (repaired)" } else { "" };
        let risks: BTreeSet<String> = report.variants.iter().filter_map(|variant| risk(variant, im)).collect();
        let risk_of_all =
            if risks.len() == 1 { format!(", {}", risks.first().unwrap_or(&String::new())) } else { String::new() };
        writeln!(out, "\nUniform risk spectra by {im}{risk_of_all}{synthetic}")?;
        writeln!(out, "Displacement, m{repaired}, at strength")?;
        // variants may be of other strengths, and each row then says its own
        let strengths: BTreeSet<String> =
            report.variants.iter().map(|variant| shown_strengths(variant).join(" ")).collect();
        let headings = shown_strengths(first);
        let rows = sites.iter().flat_map(|site| report.variants.iter().map(move |variant| (*site, variant)));
        let table = Table::of(rows)
            .left("site", |(site, _)| site)
            .each(report.keys.iter().enumerate(), |table, (at, key)| {
                table.right(key, move |(_, variant)| variant.values[at].as_deref().unwrap_or("default"))
            })
            .when(risks.len() > 1, |table| {
                table.right("risk", |(_, variant)| risk(variant, im).unwrap_or_else(|| "-".to_owned()))
            })
            .each(0..SHOWN_STRENGTHS.len(), |table, place| {
                let of_all = strengths.len() == 1;
                let heading = if of_all { headings.get(place).cloned().unwrap_or_default() } else { "m".to_owned() };
                let own = move |variant: &VariantReport| shown_strengths(variant).get(place).cloned();
                let table = table.when(!of_all, |table| {
                    table.right("strength", move |(_, variant)| own(variant).unwrap_or_else(|| "-".to_owned()))
                });
                table.right(heading, move |(site, variant)| displacement(variant, (im, site), place))
            });
        writeln!(out, "{table}")?;
    }
    if !terminal.is_quiet() {
        print_cautions(out, report, shown)?;
        writeln!(out, "\nTable    {}", shown_path(&report.table).display())?;
    }
    print_more(out, terminal)
}

/// What is to be seen to before the numbers are used, once for all variants of which it is to be said.
fn print_cautions(out: &mut impl Write, report: &SweepReport, shown: usize) -> Result<(), CommandError> {
    let mut said: Vec<(Severity, String, Vec<&str>)> = Vec::new();
    for variant in &report.variants {
        for alarm in &variant.alarms {
            let line = warning(alarm);
            match said.iter_mut().find(|(_, known, _)| *known == line) {
                Some((.., variants)) => variants.push(&variant.name),
                None => said.push((alarm.severity, line, vec![&variant.name])),
            }
        }
    }
    if said.is_empty() {
        return Ok(());
    }
    said.sort_by_key(|(severity, ..)| *severity);
    let line = |(severity, line, variants): (Severity, String, Vec<&str>)| {
        let all = variants.len() == report.variants.len();
        (severity, if all { line } else { format!("{line} ({})", variants.join(", ")) })
    };
    print_lines(out, &said.into_iter().map(line).collect::<Vec<_>>(), "--details", shown.max(SHOWN))
}

/// The rarest spectrum of a variant by a measure, at one site or any.
fn rarest<'a>(variant: &'a VariantReport, im: &str, site: Option<&str>) -> Option<&'a VariantSpectrum> {
    let own = variant.spectra.iter().filter(|own| own.im == im && site.is_none_or(|site| own.site == site));
    own.min_by(|a, b| a.poe.total_cmp(&b.poe))
}

/// The risk that a variant is shown for.
fn risk(variant: &VariantReport, im: &str) -> Option<String> {
    rarest(variant, im, None).map(|spectrum| risk_in_words(spectrum.poe, variant.years))
}

/// The strengths of a variant that are nearest to those shown.
fn shown_strengths(variant: &VariantReport) -> Vec<String> {
    let shown = nearest(&variant.strengths, &SHOWN_STRENGTHS).into_iter();
    shown.map(|at| rounded(variant.strengths[at], 6).to_string()).collect()
}

/// The displacement of a variant at one of these, and the repaired one where there is one.
fn displacement(variant: &VariantReport, (im, site): (&str, &str), place: usize) -> String {
    let at = nearest(&variant.strengths, &SHOWN_STRENGTHS).get(place).copied();
    let (Some(spectrum), Some(at)) = (rarest(variant, im, Some(site)), at) else { return "-".to_owned() };
    let repaired = spectrum.repaired_m.as_ref().map(|repaired_m| match repaired_m[at] {
        u_m if u_m.is_nan() => " (none)".to_owned(),
        u_m => format!(" ({})", metres(u_m)),
    });
    metres(spectrum.u_m[at]) + &repaired.unwrap_or_default()
}
