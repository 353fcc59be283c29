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
    /// Whether it is of weighted records.
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
        let is_repaired = |site| source.repaired(of.measure, site).is_some();
        let repaired = (0..source.spectra.sites.len()).any(is_repaired);
        let found = [false, true]
            .into_iter()
            .take(1 + usize::from(repaired))
            .map(|repaired| Ok(displacements(file, &DisplacementOptions { repaired, ..asked.clone() })?.displacements));
        let found = found.collect::<Result<Vec<_>, UpliftError>>()?;
        for (index, ([site, poe], _)) in of.u_m.blocks::<2>().enumerate() {
            let spectrum = index * shown.len()..(index + 1) * shown.len();
            for (found, repaired) in found.iter().zip([false, true]) {
                if !repaired || is_repaired(site) {
                    let cells = found[spectrum.clone()].iter().map(|own| cell_with_band(own.u_m, own.band_m)).collect();
                    rows.push(Row { measure: of.measure, site, poe, repaired, cells });
                }
            }
        }
    }
    Ok(rows)
}
