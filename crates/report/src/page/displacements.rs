//! Displacements with their confidence bands, for the tables of the page.

use uplift::UpliftError;
use uplift::result::ResultFile;
use uplift::text::cell_with_band;
use uplift::uniform_risk::{DisplacementOptions, displacements};
use uplift_motion::IntensityMeasure;

use crate::figures::FigureSource;

/// A row of a table of displacements, by positions.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) measure: IntensityMeasure,
    pub(super) site: usize,
    pub(super) poe: usize,
    /// Whether it is of weighted records, which have no band.
    pub(super) repaired: bool,
    /// A cell for each strength.
    pub(super) cells: Vec<String>,
}

/// The displacements by every measure at the strengths `shown`, by position; the repaired ones below the plain ones.
///
/// # Errors
/// A file that is damaged.
pub(super) fn rows(file: &ResultFile, source: &FigureSource, shown: &[usize]) -> Result<Vec<Row>, UpliftError> {
    let mut rows = Vec::new();
    for of in &source.spectra.measures {
        let asked = DisplacementOptions {
            strengths: shown.iter().map(|&strength| source.spectra.strengths[strength]).collect(),
            every_probability: true,
            measure: Some(of.measure),
            ..DisplacementOptions::default()
        };
        let found = displacements(file, &asked)?.displacements;
        let cells = found.chunks(shown.len().max(1));
        let places = of.u_m.blocks::<2>().map(|(at, _)| at);
        for ([site, poe], cells) in places.zip(cells) {
            let cells = cells.iter().map(|own| cell_with_band(own.u_m, own.band_m)).collect();
            let row = Row { measure: of.measure, site, poe, repaired: false, cells };
            rows.push(row.clone());
            if let Some(u_m) = source.repaired(of.measure, site) {
                let without_band = |&strength: &usize| cell_with_band(u_m[[site, poe, strength]], None);
                rows.push(Row { repaired: true, cells: shown.iter().map(without_band).collect(), ..row });
            }
        }
    }
    Ok(rows)
}
