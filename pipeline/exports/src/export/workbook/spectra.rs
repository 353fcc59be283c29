//! The sheets of spectra and of bands: strengths down, spectra across.

use rust_xlsxwriter::XlsxError;
use uplift_job::text::per_cent;
use uplift_result::declared::Field;
use uplift_result::{BandKind, EPISTEMIC, urs};
use uplift_uniform_risk::CONFIDENCE;

use super::sheet::{Sheet, Shown};
use crate::export::Export;
use crate::export::source::Row;

/// In place of an ordinate that does not exist.
const CENSORED: &str = "censored";
/// Label of the first column.
const STRENGTH: &str = "strength f_up/(m g), -";
/// Widths of the column of strengths, in characters.
const WIDTHS: [f64; 1] = [26.0];

impl Export {
    /// The spectra, the quoted band of each beside it.
    pub(super) fn spectra_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        self.banded_sheet(sheet, |row| Some((row.spectrum.u_m, row.quoted_m(BandKind::PLAIN))))
    }

    /// Ordinates and limits of the quoted band of every spectrum that `of_row` has some of, m, side by side.
    pub(super) fn banded_sheet<'a>(
        &'a self,
        sheet: &mut Sheet<'_>,
        of_row: impl Fn(&Row<'a>) -> Option<(&'a [f64], [Vec<f64>; 2])>,
    ) -> Result<(), XlsxError> {
        let below = self.heads(sheet, &["value"])?;
        let band = per_cent(CONFIDENCE);
        let names = ["best estimate".to_owned(), format!("{band} band, lower"), format!("{band} band, upper")];
        let mut column = 1;
        for row in self.rows() {
            let Some((u_m, [lower_m, upper_m])) = of_row(&row) else { continue };
            for (name, values_m) in names.iter().zip([u_m, &lower_m, &upper_m]) {
                head_of(sheet, column, &row)?;
                sheet.heading((below - 2, column), name, false)?;
                sheet.heading((below - 1, column), "u, m", true)?;
                over_strengths(sheet, (below, column), values_m)?;
                column += 1;
            }
        }
        sheet.finish((below, 1), &WIDTHS)
    }

    /// What each ordinate is, and what of its risk comes from outside the analysed levels.
    pub(super) fn tails_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let below = self.heads(sheet, &[])?;
        let mut column = 1;
        for row in self.rows() {
            for quantity in urs::GROUP.exported().filter(|quantity| quantity.name != urs::U_M.name) {
                head_of(sheet, column, &row)?;
                sheet.heading((below - 1, column), quantity.heading(), true)?;
                for (line, place) in self.places(&row).enumerate() {
                    let cell = (below + line, column);
                    if let Field::Flag(flag) = &quantity.field {
                        sheet.text(cell, (flag.get)(row.of_measure, place).word())?;
                    } else if let Some(value) = quantity.number(row.of_measure, place) {
                        sheet.number(cell, value, Shown::Percent, "")?;
                    }
                }
                column += 1;
            }
        }
        sheet.finish((below, 1), &WIDTHS)
    }

    /// The bands of all sizes.
    pub(super) fn bands_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        // plain bands alone need no line that says so
        let has_others = BandKind::ALL[1..].iter().any(|&kind| self.has_bands(kind));
        let weights = has_others.then_some("weights");
        let headings: Vec<&str> = weights.into_iter().chain(["records in a sample", "limit"]).collect();
        let below = self.heads(sheet, &headings)?;
        let [lower, upper] = self.bands.as_ref().map(uplift_result::StoredBands::level_names).unwrap_or_default();
        let resamples = [&lower, "median", &upper].map(|name| format!("resamples, {name}"));
        let confidence = self.bands.as_ref().map(|bands| per_cent(bands.confidence)).unwrap_or_default();
        let beyond = [("band", "lower"), ("band", "upper"), ("of another set", "lower"), ("of another set", "upper")]
            .map(|(of, limit)| format!("{confidence} {of}, {limit}"));
        let mut column = 1;
        for row in self.rows() {
            for (kind, band) in self.all_bands_of(&row) {
                let inferred = beyond.iter().zip(band.inferred_m.into_iter().flatten());
                for (name, values) in inferred.chain(resamples.iter().zip(band.limits_m)) {
                    head_of(sheet, column, &row)?;
                    if has_others {
                        sheet.heading((below - 4, column), kind.weights, false)?;
                    }
                    sheet.number((below - 3, column), f64::from(band.records), Shown::WholeHeading, "")?;
                    sheet.heading((below - 2, column), name, false)?;
                    sheet.heading((below - 1, column), "u, m", true)?;
                    over_strengths(sheet, (below, column), values)?;
                    column += 1;
                }
            }
        }
        sheet.finish((below, 1), &WIDTHS)
    }

    /// Mean and fractiles over what is not known.
    pub(super) fn spread_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let below = self.heads(sheet, &["over", "of them"])?;
        let mut column = 1;
        for row in self.rows() {
            for over in self.spread_over() {
                // in the order of the declaration
                let Some(limits_m) = self.spread_of(&row, over) else { continue };
                for (quantity, values) in EPISTEMIC.quantities.iter().zip(limits_m) {
                    head_of(sheet, column, &row)?;
                    sheet.heading((below - 3, column), over.words(), false)?;
                    sheet.heading((below - 2, column), quantity.heading(), false)?;
                    sheet.heading((below - 1, column), "u, m", true)?;
                    over_strengths(sheet, (below, column), values)?;
                    column += 1;
                }
            }
        }
        sheet.finish((below, 1), &WIDTHS)
    }

    /// What the lines of headings are, with `more` of them, and the strengths below; the first line of numbers.
    pub(super) fn heads(&self, sheet: &mut Sheet<'_>, more: &[&str]) -> Result<usize, XlsxError> {
        let probability = format!("probability in {} years", self.spectra.years);
        let names = ["site", "intensity measure", &probability, "return period, years"];
        for (line, name) in names.iter().chain(more).enumerate() {
            sheet.heading((line, 0), name, false)?;
        }
        let below = names.len() + more.len() + 1;
        sheet.heading((below - 1, 0), STRENGTH, true)?;
        over_strengths(sheet, (below, 0), &self.spectra.strengths)?;
        Ok(below)
    }
}

/// What stands at the head of the column of a spectrum.
pub(super) fn head_of(sheet: &mut Sheet<'_>, column: usize, row: &Row<'_>) -> Result<(), XlsxError> {
    sheet.heading((0, column), row.spectrum.site, false)?;
    sheet.heading((1, column), row.spectrum.measure.label(), false)?;
    sheet.number((2, column), row.spectrum.poe, Shown::Percent, "")?;
    sheet.number((3, column), row.return_period, Shown::Whole, "")
}

/// Numbers below each other, from a place on.
pub(super) fn over_strengths(
    sheet: &mut Sheet<'_>,
    (row, column): (usize, usize),
    values: &[f64],
) -> Result<(), XlsxError> {
    for (index, &value) in values.iter().enumerate() {
        sheet.number((row + index, column), value, Shown::FourDecimals, CENSORED)?;
    }
    Ok(())
}
