//! The sheets with a line each spectrum, and that of the hazard curves.

use rust_xlsxwriter::XlsxError;
use uplift_result::declared::Quantity;
use uplift_result::{BANDS, Fit, Fits, regression};

use super::sheet::{Sheet, Shown};
use crate::export::Export;
use crate::export::source::Row;

/// Columns of what a line is of.
pub(super) const OF: usize = 5;

impl Export {
    pub(super) fn coefficients(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        self.coefficients_of(sheet, |row| Some(row.spectrum.fit))
    }

    /// The coefficients of the spectra that `fit` has one of.
    pub(super) fn coefficients_of(
        &self,
        sheet: &mut Sheet<'_>,
        fit: impl Fn(&Row<'_>) -> Option<Fit>,
    ) -> Result<(), XlsxError> {
        subject_headings(sheet, &regression::GROUP.exported().map(Quantity::heading).collect::<Vec<_>>())?;
        let fitted = self.rows().filter_map(|row| fit(&row).map(|fit| (row, fit)));
        for (index, (row, fit)) in fitted.enumerate() {
            let line = index + 1;
            self.line_of(sheet, line, &row)?;
            let numbers =
                regression::COEFFICIENTS.iter().filter_map(|own| own.number(&Fits::from_fn([1, 1], |_| fit), 0));
            for (column, value) in numbers.enumerate() {
                sheet.number((line, OF + column), value, Shown::FourDecimals, "")?;
            }
            let bound = if fit.c0_m.is_nan() { "no fit" } else { ["no", "yes"][usize::from(fit.bound_active)] };
            sheet.text((line, OF + 4), bound)?;
        }
        sheet.finish((1, 1), &[18.0, 9.0, 12.0, 9.0, 14.0])
    }

    /// How wide the bands are (Table 4.1).
    pub(super) fn band_figures(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let figures = BANDS.exported().map(Quantity::heading);
        let headings: Vec<_> = ["records in a sample"].into_iter().chain(figures).chain(["weights"]).collect();
        subject_headings(sheet, &headings)?;
        let mut line = 1;
        for row in self.rows() {
            for (kind, band) in self.all_bands_of(&row) {
                self.line_of(sheet, line, &row)?;
                sheet.number((line, OF), f64::from(band.records), Shown::Whole, "")?;
                for (place, figure) in band.figures.into_iter().enumerate() {
                    sheet.number((line, OF + 1 + place), figure, Shown::OneDecimal, "")?;
                }
                sheet.text((line, OF + 3), kind.weights)?;
                line += 1;
            }
        }
        sheet.finish((1, 1), &[18.0, 9.0, 12.0, 9.0, 14.0, 18.0, 20.0, 20.0, 10.0])
    }

    /// The hazard curves as used, each its own two columns.
    pub(super) fn hazard_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let mut column = 0;
        for hazard in &self.hazard {
            let measure = hazard.measure;
            for (site, curves) in self.spectra.sites.iter().zip(&hazard.sites) {
                sheet.heading((0, column), site, false)?;
                sheet.heading((1, column), &format!("{}, {}", measure.label(), measure.unit()), true)?;
                sheet.heading((1, column + 1), "rate, 1/yr", true)?;
                for (index, point) in curves.curve.points().enumerate() {
                    sheet.number((2 + index, column), point.im, Shown::Plain, "")?;
                    sheet.number((2 + index, column + 1), point.maf, Shown::Power, "")?;
                }
                column += 2;
            }
        }
        sheet.finish((2, 0), &vec![12.0; column])
    }

    /// What the line of a table is of.
    pub(super) fn line_of(&self, sheet: &mut Sheet<'_>, line: usize, row: &Row<'_>) -> Result<(), XlsxError> {
        sheet.text((line, 0), row.spectrum.site)?;
        sheet.text((line, 1), row.spectrum.measure.label())?;
        sheet.number((line, 2), row.spectrum.poe, Shown::Percent, "")?;
        sheet.number((line, 3), self.spectra.years, Shown::Plain, "")?;
        sheet.number((line, 4), row.return_period, Shown::Whole, "")
    }
}

/// The headings of what a line is of, and of `more`.
pub(super) fn subject_headings(sheet: &mut Sheet<'_>, more: &[&str]) -> Result<(), XlsxError> {
    let names: [&str; OF] = ["site", "measure", "probability", "in years", "return period, years"];
    for (column, name) in names.iter().chain(more).enumerate() {
        sheet.heading((0, column), name, true)?;
    }
    Ok(())
}
