//! The sheets of what `uplift influence` and `uplift measures` added to a result.

use rust_xlsxwriter::XlsxError;
use uplift_questions::influence::CHANGES;
use uplift_result::{EFFICIENCY, TRENDS};

use super::sheet::{Sheet, Shown};
use super::spectra::{head_of, over_strengths};
use super::tables::{OF, subject_headings};
use crate::export::Export;
use crate::export::added::SHARES;

impl Export {
    /// The records of every spectrum, the most influential first: how it changes without them.
    pub(super) fn influence_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let headings = CHANGES.iter().map(|(_, heading, _)| *heading);
        subject_headings(sheet, &std::iter::once("record left out").chain(headings).collect::<Vec<_>>())?;
        // a record without which the structure overturns has no largest change
        let shown = [(Shown::OneDecimal, ""), (Shown::OneDecimal, "overturns"), (Shown::FourDecimals, "")];
        let mut line = 1;
        for row in self.rows() {
            let Some(influence) = self.influence_on(&row) else { continue };
            for found in &influence.ranking[row.at] {
                self.line_of(sheet, line, &row)?;
                sheet.text((line, OF), &self.added.records[found.record])?;
                for (place, ((.., value), (shown, infinite))) in CHANGES.iter().zip(shown).enumerate() {
                    sheet.number((line, OF + 1 + place), value(found), shown, infinite)?;
                }
                line += 1;
            }
        }
        sheet.finish((1, 1), &[18.0, 9.0, 12.0, 9.0, 14.0, 18.0, 16.0, 18.0, 14.0])
    }

    /// The levels below which 5 %, half and 95 % of the risk of each ordinate lie.
    pub(super) fn disaggregation_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let below = self.heads(sheet, &["share of the risk below"])?;
        let mut column = 1;
        for row in self.rows() {
            let Some(influence) = self.influence_on(&row) else { continue };
            for share in SHARES {
                head_of(sheet, column, &row)?;
                sheet.number((below - 2, column), share, Shown::Percent, "")?;
                let measure = row.spectrum.measure;
                sheet.heading((below - 1, column), &format!("{}, {}", measure.label(), measure.unit()), true)?;
                let strengths = 0..self.spectra.strengths.len();
                let levels: Vec<f64> = strengths.map(|strength| influence.level(row.at, strength, share)).collect();
                over_strengths(sheet, (below, column), &levels)?;
                column += 1;
            }
        }
        sheet.finish((below, 1), &[26.0])
    }

    /// How efficient and sufficient the measures are: strengths down, measures across.
    pub(super) fn efficiency_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        sheet.heading((1, 0), "strength f_up/(m g), -", true)?;
        over_strengths(sheet, (2, 0), &self.spectra.strengths)?;
        let mut column = 1;
        for of in &self.added.efficiency {
            let count = self.spectra.strengths.len();
            let figures = EFFICIENCY.exported().map(|own| (own.heading().to_owned(), own.numbers(of, 0..count)));
            let trends = of.trends.iter().flat_map(|trend| {
                let heading = |of: &str| format!("{of} {}", trend.covariate);
                TRENDS.exported().map(move |own| (heading(own.heading()), own.numbers(trend, 0..count)))
            });
            for (name, values) in figures.chain(trends) {
                sheet.heading((0, column), of.measure.label(), false)?;
                sheet.heading((1, column), &name, true)?;
                over_strengths(sheet, (2, column), &values)?;
                column += 1;
            }
        }
        sheet.finish((2, 1), &[26.0])
    }
}
