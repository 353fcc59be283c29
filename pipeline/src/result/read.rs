//! What later commands need of a result file.

use std::path::Path;

use super::LAYOUT;
use crate::error::UpliftError;
use uplift_labelled::LabelledReader;
use uplift_study::Kind;

/// A uniform risk spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Site.
    pub site: String,
    /// Measure, `PGV` or `PGA`.
    pub im: String,
    /// Probability of exceedance in the years of the study.
    pub poe: f64,
    /// Displacements, m, over the strengths of the result.
    pub u_m: Vec<f64>,
    /// Its fit.
    pub fit: Fit,
}

/// Coefficients of Eq. 4.11; NaN where there is no fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// c0, m.
    pub c0_m: f64,
    /// c1.
    pub c1: f64,
    /// c2, m.
    pub c2_m: f64,
    /// Root mean square error with n − 3 degrees of freedom, m.
    pub rmse_m: f64,
    /// True where c2 is held at 0.
    pub bound_active: bool,
}

/// A result file as the tables read it.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredResult {
    /// Where the records come from, in a line; says so if they are synthetic.
    pub record_set: String,
    /// Years that the probabilities refer to.
    pub years: f64,
    /// Strengths of the spectra.
    pub strengths: Vec<f64>,
    /// All spectra, measures in the order PGV, PGA, then site, then probability.
    pub spectra: Vec<Spectrum>,
}

impl StoredResult {
    /// Read the spectra and coefficients of the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged, no result, or of another layout.
    pub fn read(path: &Path) -> Result<Self, UpliftError> {
        let reader = open_result(path)?;
        let strengths = reader.axis_f64("strength")?;
        let poes = reader.axis_f64("poe")?;
        if strengths.is_empty() || poes.is_empty() {
            return Err(UpliftError::input(format!(
                "{}: has no strengths or no probabilities: it is damaged",
                path.display()
            )));
        }
        let sites = if reader.exists("/axes/site") { reader.axis_text("site")? } else { Vec::new() };
        let mut spectra = Vec::new();
        for im in ["PGV", "PGA"] {
            let key = im.to_lowercase();
            if !reader.exists(&format!("/urs/{key}/u_m")) {
                continue;
            }
            let u_m = reader.array_f64(&format!("/urs/{key}/u_m"))?.values;
            let column = |name: &str| reader.array_f64(&format!("/regression/{key}/{name}")).map(|array| array.values);
            let (c0, c1, c2, rmse) = (column("c0_m")?, column("c1")?, column("c2_m")?, column("rmse_m")?);
            let bound = reader.array_u8(&format!("/regression/{key}/bound_active"))?.values;
            let rows = sites.len() * poes.len();
            if u_m.len() != rows * strengths.len()
                || [c0.len(), c1.len(), c2.len(), rmse.len(), bound.len()] != [rows; 5]
            {
                return Err(UpliftError::input(format!(
                    "{}: the spectra by {im} do not have the shape of their axes: the file is damaged",
                    path.display()
                )));
            }
            for (row, u_m) in u_m.chunks_exact(strengths.len()).enumerate() {
                let fit =
                    Fit { c0_m: c0[row], c1: c1[row], c2_m: c2[row], rmse_m: rmse[row], bound_active: bound[row] == 1 };
                let (site, poe) = (sites[row / poes.len()].clone(), poes[row % poes.len()]);
                spectra.push(Spectrum { site, im: im.to_owned(), poe, u_m: u_m.to_vec(), fit });
            }
        }
        Ok(Self {
            record_set: reader.attribute_text("/", "record_set")?,
            years: reader.attribute_f64("/", "poe_years")?,
            strengths,
            spectra,
        })
    }
}

/// Open a result file of uniform risk spectra.
///
/// # Errors
/// A file that is missing, damaged, no result, of another kind, or of another layout.
pub fn open_result(path: &Path) -> Result<LabelledReader, UpliftError> {
    let reader = open_any_result(path)?;
    if holds_displacement_spectra(&reader) {
        return Err(UpliftError::input(format!(
            "{}: holds displacement spectra of record sets, and this command wants uniform risk spectra: `uplift table`, `plot`, `report`, `status` and `verify` take it, tables lie beside it as CSV, and docs/displacement-spectra.md says how other programs read it",
            path.display()
        )));
    }
    Ok(reader)
}

/// Whether a result is of displacement spectra.
pub fn holds_displacement_spectra(reader: &LabelledReader) -> bool {
    reader.attribute_text("/", "kind").is_ok_and(|kind| kind == Kind::Displacement.key())
}

/// Open a result file of either kind.
///
/// # Errors
/// A file that is missing, damaged, no result, or of another layout.
pub fn open_any_result(path: &Path) -> Result<LabelledReader, UpliftError> {
    let reader = LabelledReader::open(path)?;
    let program = reader.attribute_text("/", "program").unwrap_or_default();
    if program != "uplift" {
        return Err(UpliftError::input(format!(
            "{}: is an HDF5 file, but not a result of uplift: give the file that `uplift run` wrote",
            path.display()
        )));
    }
    let layout = reader.attribute_i64("/", "layout")?;
    if layout != LAYOUT {
        return Err(UpliftError::input(format!(
            "{}: has layout {layout}, this version of uplift ({}) reads layout {LAYOUT}: run the study again",
            path.display(),
            crate::VERSION
        )));
    }
    Ok(reader)
}
