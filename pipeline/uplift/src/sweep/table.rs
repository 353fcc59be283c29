//! All spectra of all variants in one table, a row an ordinate.

use polars::prelude::Column;
use uplift_job::table::write_table;

use super::{SweepReport, VariantReport, VariantSpectrum};
use crate::error::UpliftError;

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "variant";

pub(super) fn write(report: &SweepReport, digest: &str) -> Result<(), UpliftError> {
    let line = format!(
        "uplift {} ({}); {} variants of the study {}; study digest {digest}",
        uplift_job::VERSION,
        uplift_job::COMMIT,
        report.variants.len(),
        report.study.display()
    )
    .replace(['\n', '\r'], " ");
    let rows: Vec<(&VariantReport, &VariantSpectrum, usize)> = (report.variants.iter())
        .flat_map(|variant| {
            let of_spectrum = move |spectrum| (0..variant.strengths.len()).map(move |at| (variant, spectrum, at));
            variant.spectra.iter().flat_map(of_spectrum)
        })
        .collect();
    let texts = |value: &dyn Fn(&VariantReport, &VariantSpectrum) -> String| -> Vec<String> {
        rows.iter().map(|(variant, spectrum, _)| value(variant, spectrum)).collect()
    };
    let mut columns = vec![Column::new(FIRST_COLUMN.into(), texts(&|variant, _| variant.name.clone()))];
    for (place, key) in report.keys.iter().enumerate() {
        let values: Vec<Option<&str>> = rows.iter().map(|(variant, ..)| variant.values[place].as_deref()).collect();
        columns.push(Column::new(key.as_str().into(), values));
    }
    let numbers = |value: &dyn Fn(&VariantReport, &VariantSpectrum, usize) -> f64| -> Vec<f64> {
        rows.iter().map(|(variant, spectrum, at)| value(variant, spectrum, *at)).collect()
    };
    columns.extend([
        Column::new("site".into(), texts(&|_, spectrum| spectrum.site.clone())),
        Column::new("im".into(), texts(&|_, spectrum| spectrum.im.to_owned())),
        Column::new("poe".into(), numbers(&|_, spectrum, _| spectrum.poe)),
        Column::new("years".into(), numbers(&|variant, _, _| variant.years)),
        Column::new("strength".into(), numbers(&|variant, _, at| variant.strengths[at])),
        // a censored ordinate is inf, as in the tables beside a result
        Column::new("u_m".into(), numbers(&|_, spectrum, at| spectrum.u_m[at])),
    ]);
    let over: Vec<Option<f64>> =
        rows.iter().map(|(variant, spectrum, at)| over_first(&report.variants[0], variant, spectrum, *at)).collect();
    columns.push(Column::new("over_first".into(), over));
    let repaired = |(_, spectrum, at): &(&VariantReport, &VariantSpectrum, usize)| {
        Some(spectrum.repaired_m.as_ref()?[*at]).filter(|u_m| !u_m.is_nan())
    };
    if rows.iter().any(|row| row.1.repaired_m.is_some()) {
        columns.push(Column::new("u_consistent_m".into(), rows.iter().map(repaired).collect::<Vec<Option<f64>>>()));
    }
    let flags: Vec<&str> = rows.iter().map(|(_, spectrum, at)| spectrum.flags[*at]).collect();
    columns.extend([
        Column::new("flag".into(), flags),
        // zero has no sign in a table
        Column::new("lower_tail_share".into(), numbers(&|_, spectrum, at| spectrum.lower_tail_share[at] + 0.0)),
        Column::new("upper_tail_share".into(), numbers(&|_, spectrum, at| spectrum.upper_tail_share[at] + 0.0)),
        Column::new("cautions".into(), texts(&|variant, _| kinds(variant).join("; "))),
    ]);
    Ok(write_table(&report.table, &line, columns)?)
}

/// Kinds of what is to be seen to before the numbers of a variant are used.
fn kinds(variant: &VariantReport) -> Vec<&'static str> {
    variant.alarms.iter().map(|alarm| alarm.kind).collect()
}

/// An ordinate over that of the `first` variant at the same site, measure, risk and strength; none where that variant
/// has no such ordinate, and of two that are 0 or censored.
fn over_first(first: &VariantReport, variant: &VariantReport, spectrum: &VariantSpectrum, at: usize) -> Option<f64> {
    let is_same = |own: &&VariantSpectrum| {
        own.site == spectrum.site && own.im == spectrum.im && own.poe.to_bits() == spectrum.poe.to_bits()
    };
    if first.years.to_bits() != variant.years.to_bits() {
        return None;
    }
    let own = first.spectra.iter().find(is_same)?;
    let strength = variant.strengths[at].to_bits();
    let place = first.strengths.iter().position(|value| value.to_bits() == strength)?;
    Some(spectrum.u_m[at] / own.u_m[place]).filter(|ratio| !ratio.is_nan())
}
