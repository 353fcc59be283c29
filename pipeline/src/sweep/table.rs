//! All spectra of all variants in one table, a row an ordinate.

use polars::prelude::Column;

use super::{SweepReport, VariantReport, VariantSpectrum};
use crate::error::UpliftError;
use crate::result::write_table;

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "variant";

/// Writes the table of `report` to its place.
pub(super) fn write(report: &SweepReport) -> Result<(), UpliftError> {
    let line = format!(
        "uplift {} ({}); {} variants of the study {}",
        crate::VERSION,
        crate::COMMIT,
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
    write_table(&report.table, &line, columns)
}
