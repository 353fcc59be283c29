//! The sheets of whether the records bring the site's hazard, and of the spectra of weighted records.

use rust_xlsxwriter::XlsxError;
use uplift_job::text::risk_in_words;
use uplift_result::{BandKind, CONSISTENCY};

use super::sheet::{Sheet, Shown};
use crate::export::Export;

impl Export {
    /// What the records bring of the other measure: a line each measure that they are scaled to, and site.
    pub(super) fn consistency_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let mut headings = ["site", "scaled to", "shows", "verdict"].map(str::to_owned).to_vec();
        if let Some(of) = self.consistency.first() {
            let over = |&poe: &f64| format!("over the site's level, {}", risk_in_words(poe, of.years));
            headings.extend(of.poes.iter().map(over));
        }
        headings.extend(CONSISTENCY.exported().map(|figure| figure.heading().to_owned()));
        if self.least_effective.iter().any(Option::is_some) {
            headings.push("effective records, least".to_owned());
        }
        for (column, heading) in headings.iter().enumerate() {
            sheet.heading((0, column), heading, true)?;
        }
        for (index, row) in self.consistencies().enumerate() {
            let line = index + 1;
            let texts = [row.site, row.of.scaled_to.label(), row.of.other.label(), row.verdict.unwrap_or("no verdict")];
            for (column, text) in texts.into_iter().enumerate() {
                sheet.text((line, column), text)?;
            }
            let numbers = row.ratio.iter().copied().chain(row.figures().map(|(_, value)| value));
            for (column, number) in numbers.enumerate() {
                sheet.number((line, texts.len() + column), number, Shown::FourDecimals, "")?;
            }
            if let Some(least) = row.least_effective {
                sheet.number((line, headings.len() - 1), least, Shown::OneDecimal, "")?;
            }
        }
        sheet.finish((1, 1), &[18.0, 10.0, 9.0, 14.0])
    }

    /// The spectra of weighted records, the quoted band of each beside it.
    pub(super) fn consistent_spectra(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        self.banded_sheet(sheet, |row| Some((self.repaired(row)?.0, row.quoted_m(BandKind::REPAIRED))))
    }

    /// Their coefficients.
    pub(super) fn consistent_coefficients(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        self.coefficients_of(sheet, |row| self.repaired(row).map(|(_, fit)| *fit))
    }
}
