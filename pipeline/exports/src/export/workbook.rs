//! A result as a workbook of Excel: numbers laid out as an engineer reads them, and where they come from.

mod about;
mod added;
mod consistency;
mod shake_table;
pub(super) mod sheet;
mod spectra;
mod tables;

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Workbook, XlsxError};
use uplift_job::JobError;
use uplift_result::Head;

use super::Export;
use crate::error::ExportsError;
use sheet::{Formats, Sheet, clipped};

/// Most characters of a property that Excel shows.
const LONGEST_PROPERTY: usize = 255;

impl Export {
    /// A workbook; the same bytes for the same result.
    ///
    /// # Errors
    /// More spectra or bands than Excel has columns.
    pub fn workbook(&self) -> Result<Vec<u8>, ExportsError> {
        self.sheets().map_err(|error| match error {
            XlsxError::RowColumnLimitError => JobError::input(format!(
                "{}: has more spectra or bands than Excel has columns (16384): choose fewer with --poe, or use --csv",
                self.file
            ))
            .into(),
            error => no_workbook(&self.file, &error),
        })
    }

    fn sheets(&self) -> Result<Vec<u8>, XlsxError> {
        let mut workbook = Workbook::new();
        workbook.set_properties(&properties_of(&self.head, self.provenance())?);
        let formats = Formats::new();
        let mut add = |name: &str, fill: &dyn Fn(&Self, &mut Sheet<'_>) -> Result<(), XlsxError>| {
            let worksheet = workbook.add_worksheet();
            worksheet.set_name(name)?;
            fill(self, &mut Sheet::new(worksheet, &formats))
        };
        add("About", &Self::about)?;
        add("Spectra", &Self::spectra_sheet)?;
        if self.bands.is_some() {
            add("Bands", &Self::bands_sheet)?;
            add("Table 4.1", &Self::band_figures)?;
        }
        if !self.spreads.is_empty() {
            add("Spread", &Self::spread_sheet)?;
        }
        add("Flags and tails", &Self::tails_sheet)?;
        add("Coefficients", &Self::coefficients)?;
        if !self.consistency.is_empty() {
            add("Consistency", &Self::consistency_sheet)?;
        }
        if self.has_repaired() {
            add("Consistent spectra", &Self::consistent_spectra)?;
            add("Consistent coefficients", &Self::consistent_coefficients)?;
        }
        if !self.added.influence.is_empty() {
            add("Influence", &Self::influence_sheet)?;
            add("Disaggregation", &Self::disaggregation_sheet)?;
        }
        if !self.added.efficiency.is_empty() {
            add("Efficiency", &Self::efficiency_sheet)?;
        }
        if !self.findings.is_empty() {
            add("Structures", &Self::findings_sheet)?;
        }
        add("Hazard", &Self::hazard_sheet)?;
        add("Study", &Self::study_sheet)?;
        workbook.save_to_buffer()
    }
}

fn no_workbook(file: &str, error: &XlsxError) -> ExportsError {
    JobError::input(format!("{file}: no workbook can be made: {error}")).into()
}

/// What the file says of itself.
fn properties_of(head: &Head, provenance: &str) -> Result<DocProperties, XlsxError> {
    Ok(DocProperties::new()
        .set_title(clipped(&head.title, LONGEST_PROPERTY))
        .set_author("uplift")
        .set_comment(provenance)
        // the time of the result, since the workbook says nothing else
        .set_creation_datetime(&ExcelDateTime::parse_from_str(&head.created)?))
}

/// A study with every default filled in, a line each.
fn study_lines(study_toml: &str, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
    sheet.heading((0, 0), "the study, every default filled in (TOML)", true)?;
    for (index, line) in study_toml.lines().enumerate() {
        sheet.text((1 + index, 0), line)?;
    }
    sheet.finish((1, 0), &[110.0])
}
