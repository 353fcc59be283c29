//! The coefficients of Eq. 4.11, ours beside a reference (Table 4.2).

use std::path::Path;

use serde::Serialize;
use uplift_alarms::{COMPARED_FROM_M, FitReach, reach_of_fit};
use uplift_job::events::Events;
use uplift_job::{JobError, ReferenceTable};
use uplift_motion::IntensityMeasure;
use uplift_regression::Exponential;
use uplift_result::{Fit, ResultFile, Spectrum, StoredConsistency};
use uplift_study::UniformRiskStudy;

use super::options::TableOptions;
use crate::error::ExportsError;

/// Strengths above this are compared, up to 1 (the range of Table 4.2's fits).
pub const COMPARED_ABOVE: f64 = 0.05;
/// The coefficients of a result; serialized, the rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct CoefficientTable {
    /// A row for each measure, site and probability.
    pub rows: Vec<CoefficientRow>,
    /// Where the records come from, in a line.
    #[serde(skip)]
    pub record_set: String,
    /// Years that the probabilities refer to.
    #[serde(skip)]
    pub years: f64,
    /// Whether a reference was given.
    #[serde(skip)]
    pub compared: bool,
}

/// The fit u = c0 exp(c1 η) + c2 of a spectrum (Eq. 4.11); NaN, as JSON null, where there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoefficientRow {
    /// Site.
    pub site: String,
    /// Intensity measure, `PGV` or `PGA`.
    pub im: String,
    /// Whether the spectrum is that of weighted records, which match the site's hazard of both measures; said only
    /// where it is.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub repaired: bool,
    /// Probability of exceedance in the years of the study.
    pub poe: f64,
    /// Its coefficients.
    #[serde(flatten)]
    pub fit: Fit,
    /// How far the curve goes with its spectrum; none without a fit, or where no ordinate is above uplift.
    pub reach: Option<FitReach>,
    /// Median of our spectrum over the curve of the reference, for strengths in ([`COMPARED_ABOVE`], 1] where that
    /// curve exceeds [`COMPARED_FROM_M`]; none where the reference has no such row.
    pub median_ratio: Option<f64>,
    /// What the reference says; nothing of repaired spectra.
    #[serde(skip)]
    pub reference: Option<ReferenceFit>,
}

/// Coefficients of a reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceFit {
    /// c0, m.
    pub c0_m: f64,
    /// c1.
    pub c1: f64,
    /// c2, m.
    pub c2_m: f64,
    /// Root mean square error, m, where it is stated.
    pub rmse_m: Option<f64>,
}

struct Reference {
    site: String,
    poe: f64,
    fit: ReferenceFit,
}

pub(super) fn read(
    options: &TableOptions,
    file: &ResultFile,
    events: &dyn Events,
) -> Result<CoefficientTable, ExportsError> {
    let result = file.spectra()?;
    let study = file.stored_study()?;
    if result.sites.is_empty() {
        return Err(file.without_spectra().into());
    }
    let known: Vec<IntensityMeasure> = result.measures.iter().map(|of| of.measure).collect();
    let wanted = options.measure_of_rows(&known);
    let references = options.reference.as_deref().map_or_else(|| Ok(Vec::new()), read_reference)?;
    let consistency = file.consistency()?;
    let places = result.measures.iter().flat_map(|of| of.fits.blocks::<2>().map(|(at, _)| at));
    let rows: Vec<CoefficientRow> = places
        .zip(result.rows())
        .filter(|(_, spectrum)| wanted.is_none_or(|wanted| spectrum.measure == wanted))
        .flat_map(|(at, spectrum)| {
            let reference = references.iter().find(|reference| same(&spectrum, reference));
            let row = |spectrum: &Spectrum<'_>, reference| {
                CoefficientRow::new(&study, &result.strengths, spectrum, reference)
            };
            let plain = row(&spectrum, reference.map(|reference| reference.fit));
            let repaired = repaired(&consistency, at, &spectrum);
            let repaired = repaired.map(|spectrum| CoefficientRow { repaired: true, ..row(&spectrum, None) });
            std::iter::once(plain).chain(repaired)
        })
        .collect();
    if rows.is_empty() {
        let keys: Vec<&str> = known.iter().map(|measure| measure.key()).collect();
        return Err(JobError::input(format!(
            "{}: has no spectra by {}: use --measure {}",
            options.result.display(),
            wanted.map_or("ALL", IntensityMeasure::label),
            keys.join(" or ")
        ))
        .into());
    }
    let compared = options.reference.is_some();
    if compared && rows.iter().all(|row| row.reference.is_none()) {
        // the coefficients are of use all the same; the note is for who mistyped a name
        events.note(&format!(
            "no row of the reference has a site and probability of the result: it has {}, the result {}",
            names(references.iter().map(|reference| reference.site.as_str())),
            names(rows.iter().map(|row| row.site.as_str()))
        ));
    }
    Ok(CoefficientTable { rows, record_set: file.head()?.record_set, years: result.years, compared })
}

/// The spectrum of weighted records beside `plain`, the one at `[site, poe]`; none without a repair there.
fn repaired<'a>(
    consistency: &'a [StoredConsistency],
    [site, poe]: [usize; 2],
    plain: &Spectrum<'a>,
) -> Option<Spectrum<'a>> {
    let is_of = |of: &&StoredConsistency| of.scaled_to == plain.measure && of.is_repaired(site);
    let of = consistency.iter().find(is_of)?;
    Some(Spectrum { u_m: of.u_m.as_ref()?.block([site, poe]), fit: of.fits.as_ref()?[[site, poe]], ..*plain })
}

impl CoefficientRow {
    fn new(
        study: &UniformRiskStudy,
        strengths: &[f64],
        spectrum: &Spectrum<'_>,
        reference: Option<ReferenceFit>,
    ) -> Self {
        let (above, uplift_m) = (study.regression.strength_above, study.oscillator.uplift_displacement_m);
        let reach = |curve| reach_of_fit(&curve, (strengths, spectrum.u_m), above, uplift_m);
        Self {
            site: spectrum.site.to_owned(),
            im: spectrum.measure.label().to_owned(),
            repaired: false,
            poe: spectrum.poe,
            reach: spectrum.fit.curve().and_then(reach),
            fit: spectrum.fit,
            median_ratio: reference.and_then(|reference| median_ratio(strengths, spectrum.u_m, &reference)),
            reference,
        }
    }
}

/// The names, each once, in alphabetical order.
fn names<'a>(of: impl Iterator<Item = &'a str>) -> String {
    let mut names: Vec<&str> = of.collect();
    names.sort_unstable();
    names.dedup();
    names.join(", ")
}

fn same(spectrum: &Spectrum<'_>, reference: &Reference) -> bool {
    spectrum.site.to_lowercase() == reference.site.to_lowercase() && (spectrum.poe - reference.poe).abs() < 1e-9
}

/// Median of our ordinates over the reference curve, where it can be compared.
fn median_ratio(strengths: &[f64], u_m: &[f64], reference: &ReferenceFit) -> Option<f64> {
    let curve = Exponential { c0: reference.c0_m, c1: reference.c1, c2: reference.c2_m };
    let mut ratios: Vec<f64> = strengths
        .iter()
        .zip(u_m)
        .filter(|(strength, _)| **strength > COMPARED_ABOVE && **strength <= 1.0)
        .map(|(&strength, u_m)| (u_m, curve.at(strength)))
        .filter(|(_, reference_m)| *reference_m > COMPARED_FROM_M)
        .map(|(u_m, reference_m)| u_m / reference_m)
        .collect();
    ratios.sort_by(f64::total_cmp);
    let middle = ratios.len() / 2;
    match ratios.len() {
        0 => None,
        odd if odd % 2 == 1 => Some(ratios[middle]),
        _ => Some(0.5 * (ratios[middle - 1] + ratios[middle])),
    }
    .filter(|ratio| ratio.is_finite())
}

fn read_reference(path: &Path) -> Result<Vec<Reference>, ExportsError> {
    let table = ReferenceTable::read(path)?;
    let poe_column = if table.has("poe_50y") { "poe_50y" } else { "poe" };
    let missing: Vec<&str> =
        ["site", poe_column, "c0_m", "c1", "c2_m"].into_iter().filter(|name| !table.has(name)).collect();
    if !missing.is_empty() {
        return Err(table.fail(format!("has no column {}", missing.join(", "))).into());
    }
    (0..table.rows())
        .map(|row| {
            Ok(Reference {
                site: table.text("site", row),
                poe: table.number(poe_column, row)?,
                fit: ReferenceFit {
                    c0_m: table.number("c0_m", row)?,
                    c1: table.number("c1", row)?,
                    c2_m: table.number("c2_m", row)?,
                    rmse_m: table.number("rmse_m", row).ok(),
                },
            })
        })
        .collect()
}
