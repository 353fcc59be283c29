//! Figures of a paper to compare with: CSV with the columns of Table 4.1.

use std::path::Path;

use uplift_job::ReferenceTable;
use uplift_motion::IntensityMeasure;

use crate::error::QuestionsError;

/// A row: one site and sample size.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceRow {
    /// The site, its case of no account.
    pub site: String,
    /// Records in a sample.
    pub sample_size: u32,
    /// Measure (`pgv`, `pga`), error of the median (Eq. 4.9) and range of the interval (Eq. 4.10) in per cent.
    pub figures: Vec<(String, f64, f64)>,
}

/// Reads a table with the columns of Table 4.1 (`site`, `sample_size`, `pgv_e_median_pct`, `pgv_r_90ci_pct`, …).
///
/// # Errors
/// A file that cannot be read, lacks these columns, or has a cell that is not a number.
pub fn read_reference(path: &Path) -> Result<Vec<ReferenceRow>, QuestionsError> {
    let table = ReferenceTable::read(path)?;
    let columns = |key: &str| (format!("{key}_e_median_pct"), format!("{key}_r_90ci_pct"));
    let measures: Vec<&str> = IntensityMeasure::OF_CHAPTER_4
        .into_iter()
        .map(IntensityMeasure::key)
        .filter(|key| {
            let (error, range) = columns(key);
            table.has(&error) && table.has(&range)
        })
        .collect();
    if !table.has("site") || !table.has("sample_size") || measures.is_empty() {
        return Err(table
            .fail("needs the columns site, sample_size, and pgv_e_median_pct with pgv_r_90ci_pct or the same of pga")
            .into());
    }
    (0..table.rows())
        .map(|row| {
            let figures = measures.iter().map(|key| {
                let (error, range) = columns(key);
                Ok(((*key).to_owned(), table.number(&error, row)?, table.number(&range, row)?))
            });
            Ok(ReferenceRow {
                site: table.text("site", row),
                sample_size: table.number("sample_size", row)?,
                figures: figures.collect::<Result<_, QuestionsError>>()?,
            })
        })
        .collect()
}
