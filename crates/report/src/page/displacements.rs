//! Displacements with their confidence bands, for the tables of the page.

use uplift::UpliftError;
use uplift::result::ResultFile;
use uplift::text::{cell_with_band, spectrum_words};
use uplift::uniform_risk::{Displacement, DisplacementOptions, displacements};
use uplift_motion::IntensityMeasure;

use crate::figures::FigureSource;

/// A row of a table of displacements, by positions.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) measure: IntensityMeasure,
    pub(super) site: usize,
    pub(super) poe: usize,
    pub(super) kind: Kind,
    /// A cell for each strength.
    pub(super) cells: Vec<String>,
}

/// Which displacements a row has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Plain,
    /// Of weighted records.
    Repaired,
    /// The plain ones, with bands over the weighted hazard curves of the site.
    WithHazard,
}

impl Kind {
    /// What the row is of, called so.
    pub(super) fn words(self, name: &str) -> String {
        match self {
            Self::Plain => name.to_owned(),
            Self::Repaired => spectrum_words(name, true),
            Self::WithHazard => format!("{name}, with its hazard curves"),
        }
    }
}

/// The displacements by every measure at the strengths `shown`, by position; below the plain ones those with bands over
/// the hazard curves of a site, and the repaired ones.
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
                let found = &found[spectrum.clone()];
                let mut add = |kind, band_m: fn(&Displacement) -> Option<[f64; 2]>| {
                    let cells = found.iter().map(|own| cell_with_band(own.u_m, band_m(own))).collect();
                    rows.push(Row { measure: of.measure, site, poe, kind, cells });
                };
                if !repaired || is_repaired(site) {
                    add(if repaired { Kind::Repaired } else { Kind::Plain }, |own| own.band_m);
                }
                if found.iter().any(|own| own.band_with_hazard_m.is_some()) {
                    add(Kind::WithHazard, |own| own.band_with_hazard_m);
                }
            }
        }
    }
    Ok(rows)
}
