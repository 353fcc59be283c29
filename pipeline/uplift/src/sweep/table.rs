//! All spectra of all variants in one table, a row an ordinate.

use polars::prelude::Column;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_job::{JobError, outputs};
use uplift_result::{BandKind, Spectrum, urs};
use uplift_studies::uniform_risk::spectra_table;

use super::report::{SweepReport, VariantReport};
use crate::error::UpliftError;

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "variant";

pub(super) fn write(report: &SweepReport, digest: &str) -> Result<(), UpliftError> {
    let line = outputs::marked(format_args!(
        "{} variants of the study {}; study digest {digest}",
        report.variants.len(),
        report.study.display()
    ));
    let has_repaired = report.variants.iter().any(|of| of.spectra.repaired_m.iter().any(Option::is_some));
    let mut columns: Vec<Column> = Vec::new();
    for variant in &report.variants {
        let own = variant_columns(report, variant, has_repaired);
        if columns.is_empty() {
            columns = own;
        } else {
            let mut both = columns.iter_mut().zip(&own);
            both.try_for_each(|(all, own)| all.append(own).map(drop)).map_err(|e| JobError::input(e.to_string()))?;
        }
    }
    Ok(write_table(&report.table, &line, columns)?)
}

/// A row an ordinate of a variant: its spectra as the table beside its result has them, and what is compared.
fn variant_columns(report: &SweepReport, variant: &VariantReport, has_repaired: bool) -> Vec<Column> {
    let strengths = variant.spectra.plain.strengths.len();
    let rows = variant.spectra.rows().flat_map(|row| (0..strengths).map(move |at| (row, at)));
    let mut columns = ColumnsOf::new(rows)
        .with(FIRST_COLUMN, |_| variant.name.as_str())
        .each(report.keys.iter().zip(&variant.values), |columns, (key, value)| {
            columns.with(key.as_str(), |_| value.as_deref())
        })
        .with("over_first", |((spectrum, _), at)| over_first(report, variant, &spectrum, at))
        .each(has_repaired.then(|| BandKind::REPAIRED.column(urs::U_M.name)), |columns, name| {
            columns.with(name, |((_, repaired_m), at)| Some(repaired_m?[at]).filter(|u_m| !u_m.is_nan()))
        })
        .with("cautions", |_| kinds(variant).join("; "))
        .build();
    let mut spectra = spectra_table(&variant.spectra.plain);
    let beside = spectra.iter().position(|column| column.name() == urs::U_M.name).map_or(0, |place| place + 1);
    let (flags, keys) = (spectra.split_off(beside), 1 + report.keys.len());
    columns.splice(keys..keys, spectra);
    let last = columns.len() - 1;
    columns.splice(last..last, flags);
    columns
}

/// Kinds of what is to be seen to before the numbers of a variant are used.
fn kinds(variant: &VariantReport) -> Vec<&'static str> {
    variant.alarms.iter().map(|alarm| alarm.kind).collect()
}

/// An ordinate over that of the first variant at the same site, measure, risk and strength; none where that variant has
/// no such ordinate, and of two that are 0 or censored.
fn over_first(report: &SweepReport, variant: &VariantReport, spectrum: &Spectrum<'_>, at: usize) -> Option<f64> {
    let (first, own) = (&report.variants.first()?.spectra.plain, &variant.spectra.plain);
    let is_same = |of: &Spectrum<'_>| {
        of.site == spectrum.site && of.measure == spectrum.measure && of.poe.to_bits() == spectrum.poe.to_bits()
    };
    if first.years.to_bits() != own.years.to_bits() {
        return None;
    }
    let strength = own.strengths[at].to_bits();
    let place = first.strengths.iter().position(|value| value.to_bits() == strength)?;
    Some(spectrum.u_m[at] / first.rows().find(is_same)?.u_m[place]).filter(|ratio| !ratio.is_nan())
}
