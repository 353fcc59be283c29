//! Variants of a study side by side.

use std::collections::BTreeSet;
use std::io::Write;

use uplift::alarms::Severity;
use uplift::sweep::{SweepReport, VariantReport};
use uplift::text::{Table, cell_with_band, per_cent, risk_in_words, rounded};
use uplift::uniform_risk::{BandOf, CONFIDENCE, Displacement};

use super::alarms::{print_lines, warning};
use super::{print_more, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Rows of a table that has every strength.
const MOST_ROWS: usize = 8;

/// The displacements of every variant at a few strengths for its smallest probability, by the first measure; in detail
/// by each.
pub(crate) fn print_sweep(report: &SweepReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    let all = || report.variants.iter().flat_map(|variant| &variant.displacements);
    let measures: BTreeSet<&str> = all().map(|own| own.im).collect();
    let shown = if terminal.shows_details() { usize::MAX } else { 1 };
    for im in measures.into_iter().rev().take(shown) {
        print_displacements(out, report, (im, Weights::Plain), terminal)?;
        if report.variants.iter().any(|variant| variant.repaired.iter().any(|own| own.im == im)) {
            print_displacements(out, report, (im, Weights::Repaired), terminal)?;
        }
    }
    if terminal.is_quiet() {
        return Ok(());
    }
    let is_cut = print_cautions(out, report, terminal)?;
    writeln!(out, "\nTable    {}", shown_path(&report.table).display())?;
    if is_cut { Ok(()) } else { print_more(out, terminal) }
}

/// Which spectra of a variant are shown.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Weights {
    Plain,
    Repaired,
}

impl Weights {
    fn displacements(self, variant: &VariantReport) -> &[Displacement] {
        match self {
            Self::Plain => &variant.displacements,
            Self::Repaired => &variant.repaired,
        }
    }
}

/// A row a site and variant, a column a strength.
fn print_displacements(
    out: &mut impl Write,
    report: &SweepReport,
    (im, weights): (&str, Weights),
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let Some(first) = report.variants.first() else { return Ok(()) };
    let of = |variant: &'_ VariantReport, site: Option<&str>| -> Vec<Displacement> {
        let own = weights
            .displacements(variant)
            .iter()
            .filter(|own| own.im == im && site.is_none_or(|site| own.site == site));
        own.cloned().collect()
    };
    let mut sites: Vec<&str> = Vec::new();
    for own in report.variants.iter().flat_map(|variant| weights.displacements(variant)).filter(|own| own.im == im) {
        if !sites.contains(&own.site.as_str()) {
            sites.push(&own.site);
        }
    }
    let kind = if weights == Weights::Plain { "Uniform risk spectra" } else { "Repaired uniform risk spectra" };
    let risk = |variant: &VariantReport| {
        of(variant, None).first().map_or_else(|| "-".to_owned(), |own| risk_in_words(own.poe, own.years))
    };
    let risks: BTreeSet<String> = report.variants.iter().map(risk).collect();
    let risk_of_all = if risks.len() == 1 { format!(", {}", risk(first)) } else { String::new() };
    let is_banded =
        report.variants.iter().flat_map(|variant| weights.displacements(variant)).any(|own| own.band_m.is_some());
    // wider than the number of records suggests; of some variants where these have other records
    let wider = |variant: &&VariantReport| variant.band_of.get(im) == Some(&BandOf::Earthquakes);
    let by_earthquake: Vec<&str> = report.variants.iter().filter(wider).map(|variant| variant.name.as_str()).collect();
    let whose = match by_earthquake.len() {
        0 => String::new(),
        all if all == report.variants.len() => " by earthquake".to_owned(),
        _ => format!(", by earthquake: {}", by_earthquake.join(", ")),
    };
    let band = if is_banded { format!(" ({} band{whose})", per_cent(CONFIDENCE)) } else { String::new() };
    writeln!(out, "\n{kind} by {im}{risk_of_all}: displacement, m{band}, at strength")?;

    let strengths = |variant: &VariantReport| -> Vec<String> {
        let of_site = of(variant, sites.first().copied());
        of_site.iter().map(|own| rounded(own.strength, 6).to_string()).collect()
    };
    // where variants have other strengths, each row names its own
    let is_common = report.variants.iter().all(|variant| strengths(variant) == strengths(first));
    let columns = report.variants.iter().map(|variant| strengths(variant).len()).max().unwrap_or_default();
    let rows: Vec<(&str, &VariantReport)> =
        sites.iter().flat_map(|site| report.variants.iter().map(move |variant| (*site, variant))).collect();
    // a long table has the smallest and the largest of the strengths alone
    let is_long = rows.len() > MOST_ROWS && !terminal.shows_details();
    let shown = (0..columns).filter(|&place| !is_long || place == 0 || place + 1 == columns);
    let or_dash = |cell: Option<String>| cell.unwrap_or_else(|| "-".to_owned());
    let table = Table::from_rows(rows)
        .left("site", |(site, variant)| if std::ptr::eq(variant, first) { site } else { "" })
        .each(report.keys.iter().enumerate(), |table, (at, key)| {
            table.right(key, move |(_, variant)| variant.values[at].as_deref().unwrap_or("study's"))
        })
        .when(risks.len() > 1, |table| table.right("risk", |(_, variant)| risk(variant)))
        .each(shown, |table, place| {
            let own = move |variant: &VariantReport| strengths(variant).get(place).cloned();
            let heading = if is_common { own(first).unwrap_or_default() } else { "m".to_owned() };
            let table =
                table.when(!is_common, |table| table.right("strength", move |(_, variant)| or_dash(own(variant))));
            table.right(heading, move |(site, variant)| {
                or_dash(of(variant, Some(site)).get(place).map(|own| cell_with_band(own.u_m, own.band_m)))
            })
        });
    Ok(writeln!(out, "{table}")?)
}

/// The warnings of all variants, each once. Whether some are left out.
fn print_cautions(out: &mut impl Write, report: &SweepReport, terminal: &Terminal) -> Result<bool, CommandError> {
    let mut said: Vec<(Severity, String, Vec<&str>)> = Vec::new();
    for variant in &report.variants {
        for alarm in &variant.alarms {
            let line = warning(alarm, None);
            match said.iter_mut().find(|(_, known, _)| *known == line) {
                Some((.., variants)) => variants.push(&variant.name),
                None => said.push((alarm.severity, line, vec![&variant.name])),
            }
        }
    }
    said.sort_by_key(|(severity, ..)| *severity);
    let line = |(_, line, variants): (Severity, String, Vec<&str>)| {
        if variants.len() == report.variants.len() { line } else { format!("{line} ({})", variants.join(", ")) }
    };
    print_lines(out, &said.into_iter().map(line).collect::<Vec<_>>(), terminal.shows_details())
}
