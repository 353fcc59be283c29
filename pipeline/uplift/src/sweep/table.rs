//! All spectra of all variants in one table, a row an ordinate.

use uplift_job::outputs;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_result::{BandKind, urs};

use super::{SweepReport, VariantReport, VariantSpectrum};
use crate::error::UpliftError;

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "variant";

pub(super) fn write(report: &SweepReport, digest: &str) -> Result<(), UpliftError> {
    let line = outputs::marked(format_args!(
        "{} variants of the study {}; study digest {digest}",
        report.variants.len(),
        report.study.display()
    ));
    let rows = report.variants.iter().flat_map(|variant| {
        let of_spectrum = move |spectrum| (0..variant.strengths.len()).map(move |at| (variant, spectrum, at));
        variant.spectra.iter().flat_map(of_spectrum)
    });
    let has_repaired = report.variants.iter().flat_map(|of| &of.spectra).any(|of| of.repaired_m.is_some());
    let columns = ColumnsOf::new(rows)
        .with(FIRST_COLUMN, |(variant, ..)| variant.name.as_str())
        .each(report.keys.iter().enumerate(), |columns, (place, key)| {
            columns.with(key.as_str(), |(variant, ..)| variant.values[place].as_deref())
        })
        .with("site", |(_, spectrum, _)| spectrum.site.as_str())
        .with("im", |(_, spectrum, _)| spectrum.im)
        .with("poe", |(_, spectrum, _)| spectrum.poe)
        .with("years", |(variant, ..)| variant.years)
        .with("strength", |(variant, _, at)| variant.strengths[at])
        // a censored ordinate is inf, as in the tables beside a result
        .with(urs::U_M.name, |(_, spectrum, at)| spectrum.u_m[at])
        .with("over_first", |(variant, spectrum, at)| over_first(&report.variants[0], variant, spectrum, at))
        .each(has_repaired.then(|| BandKind::REPAIRED.column(urs::U_M.name)), |columns, name| {
            let repaired_m = |spectrum: &VariantSpectrum, at: usize| Some(spectrum.repaired_m.as_ref()?[at]);
            columns.with(name, |(_, spectrum, at)| repaired_m(spectrum, at).filter(|u_m| !u_m.is_nan()))
        })
        .with(urs::FLAG.name, |(_, spectrum, at)| spectrum.flags[at])
        // zero has no sign in a table
        .with(urs::LOWER_TAIL_SHARE.name, |(_, spectrum, at)| spectrum.lower_tail_share[at] + 0.0)
        .with(urs::UPPER_TAIL_SHARE.name, |(_, spectrum, at)| spectrum.upper_tail_share[at] + 0.0)
        .with("cautions", |(variant, ..)| kinds(variant).join("; "));
    Ok(write_table(&report.table, &line, columns.build())?)
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
