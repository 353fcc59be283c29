//! The arrays of a table of sites, in a file of their own beside the result. What a result has too is declared there
//! alone; here it is over the measures as well, under the name that it has in tables.

use std::path::{Path, PathBuf};

use uplift_job::outputs::{SITE_ARRAYS, beside};
use uplift_job::{Array, JobError};
use uplift_labelled::{LabelledError, LabelledReader};
use uplift_risk::OrdinateFlag;

use super::consistency::CONSISTENCY;
use super::declared::{Group, Quantity, group, quantity};
use super::layout::attribute::sites as attribute;
use super::layout::axis::{MEASURE, POE, SITE, STRENGTH};
use super::spectra::{Fit, regression, urs};
use super::spread::{EPISTEMIC, FRACTILES, SpreadOver};
use crate::error::ResultError;

/// Mean and [`FRACTILES`] of an ordinate over weighted hazard curves, m.
pub type SiteSpread = [f64; 1 + FRACTILES.len()];

/// The spectrum of one of many sites by one measure at one probability, over the strengths of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteSpectrum {
    /// Displacements, m; infinite where censored.
    pub u_m: Vec<f64>,
    /// What kind of ordinate each is.
    pub flags: Vec<OrdinateFlag>,
    /// Limits of the 90 % band of each, m; empty in a table without bands.
    pub bands_m: Vec<[f64; 2]>,
    /// Mean and fractiles of each; empty in a table without weighted hazard curves.
    pub spread_m: Vec<SiteSpread>,
    /// Its coefficients.
    pub fit: Fit,
}

/// How far the records of one measure miss the hazard of another one at one of many sites; NaN where unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteConsistency {
    /// How many times the site's level they have, mean over the rates compared.
    pub bias: f64,
    /// Largest |ln(implied/site)|.
    pub max: f64,
    /// `consistent`, `off`, `inconsistent`; empty where unknown.
    pub verdict: &'static str,
    /// Fewest effective records at a stripe; NaN without a repair.
    pub least_effective: f64,
}

/// Of the file: where its attributes are, whose spectra the plain ones are, and what spreads are over.
pub const SITE_NAMES: [(&str, &str); 4] = names("/urs");
/// The same of the repaired spectra.
pub const REPAIRED_SITE_NAMES: [(&str, &str); 4] = names(SITE_CONSISTENCY.path);

const fn names(spectra: &'static str) -> [(&'static str, &'static str); 4] {
    let [_, many, over] = SpreadOver::HazardCurves.names();
    [("<sites>", "/"), ("<spectra>", spectra), many, over]
}

const PER_MEASURE: &[&str] = &[SITE.name, MEASURE.name];
const PER_SPECTRUM: &[&str] = &[SITE.name, MEASURE.name, POE.name];
const PER_ORDINATE: &[&str] = &[SITE.name, MEASURE.name, POE.name, STRENGTH.name];

/// The spectra, plain and repaired.
pub const SITE_SPECTRA: Group<SiteSpectrum> =
    Group { path: "<spectra>", quantities: &[urs::U_M.over(PER_ORDINATE, quantity!(@field F64 |of, at| of.u_m[at]))] };

/// What kind of ordinate each of the plain spectra is.
pub const SITE_FLAGS: Group<SiteSpectrum> = Group {
    path: SITE_SPECTRA.path,
    quantities: &[Quantity {
        long_name: "0 regular, 1 no exceedance, 2 censored, 3 no spectrum",
        note: "",
        ..urs::FLAG.over(PER_ORDINATE, quantity!(@field Flag |of, at| of.flags[at]))
    }],
};

group! {
    /// Limits of the bands that are quoted beside ordinates.
    pub const SITE_BANDS: SiteSpectrum = SITE_SPECTRA.path;
    "lower_m" [SITE, MEASURE, POE, STRENGTH] F64 "m" "lower limit of its 90 % band" = |of, at| of.bands_m[at][0];
    "upper_m" [SITE, MEASURE, POE, STRENGTH] F64 "m" "upper limit of its 90 % band" = |of, at| of.bands_m[at][1];
}

/// Their spread over weighted hazard curves, of the plain spectra.
pub const SITE_SPREADS: Group<SiteSpectrum> = Group {
    path: SITE_SPECTRA.path,
    quantities: &[
        EPISTEMIC.quantities[0].over(PER_ORDINATE, quantity!(@field F64 |of, at| of.spread_m[at][0])),
        EPISTEMIC.quantities[1].over(PER_ORDINATE, quantity!(@field F64 |of, at| of.spread_m[at][1])),
        EPISTEMIC.quantities[2].over(PER_ORDINATE, quantity!(@field F64 |of, at| of.spread_m[at][2])),
        EPISTEMIC.quantities[3].over(PER_ORDINATE, quantity!(@field F64 |of, at| of.spread_m[at][3])),
        EPISTEMIC.quantities[4].over(PER_ORDINATE, quantity!(@field F64 |of, at| of.spread_m[at][4])),
        EPISTEMIC.quantities[5].over(PER_ORDINATE, quantity!(@field F64 |of, at| of.spread_m[at][5])),
    ],
};

/// Their coefficients.
pub const SITE_FITS: Group<SiteSpectrum> = Group {
    path: SITE_SPECTRA.path,
    quantities: &[
        regression::C0_M.over(PER_SPECTRUM, quantity!(@field F64 |of, _at| of.fit.c0_m)),
        regression::C1.over(PER_SPECTRUM, quantity!(@field F64 |of, _at| of.fit.c1)),
        regression::C2_M.over(PER_SPECTRUM, quantity!(@field F64 |of, _at| of.fit.c2_m)),
        regression::RMSE_M.over(PER_SPECTRUM, quantity!(@field F64 |of, _at| of.fit.rmse_m)),
    ],
};

/// Consistency with the hazard of the other measure.
pub const SITE_CONSISTENCY: Group<SiteConsistency> = Group {
    path: "/consistent",
    quantities: &[
        CONSISTENCY.quantities[3].over(PER_MEASURE, quantity!(@field F64 |of, _at| of.bias)),
        CONSISTENCY.quantities[4].over(PER_MEASURE, quantity!(@field F64 |of, _at| of.max)),
        quantity!("least_effective" [SITE, MEASURE] F64 "1" "fewest effective records at a stripe"
            = |of, _at| of.least_effective),
    ],
};

group! {
    /// Why there is no spectrum or no fit; empty where there are both.
    pub const SITE_PROBLEMS: String = SITE_SPECTRA.path;
    "problem" [SITE, MEASURE, POE] Text "" "why there is no spectrum, or no fit" = |of, _at| *of;
}

group! {
    /// Longitude and latitude of a site, degrees.
    pub const SITE_PLACES: [f64; 2] = "/";
    "longitude_deg" [SITE] F64 "degrees_east" "longitude" = |of, _at| of[0];
    "latitude_deg" [SITE] F64 "degrees_north" "latitude" = |of, _at| of[1];
}

/// The plain spectra of many sites, read from the file beside a result.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteArrays {
    /// Longitude of each site, degrees.
    pub longitude_deg: Vec<f64>,
    /// Latitude of each site, degrees.
    pub latitude_deg: Vec<f64>,
    /// Keys of the measures.
    pub measures: Vec<String>,
    /// Probabilities of exceedance.
    pub poes: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// Uplift strengths.
    pub strengths: Vec<f64>,
    /// Displacement, m, `[site, measure, poe, strength]`; NaN where there is no spectrum.
    pub u_m: Array<4>,
}

impl SiteArrays {
    /// The file beside the result file `result`.
    pub fn path(result: &Path) -> PathBuf {
        beside(result, SITE_ARRAYS)
    }

    /// Whether the file in `reader` says that it is of the result of this study digest.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn is_of_digest(reader: &LabelledReader, digest: &str) -> Result<bool, LabelledError> {
        Ok(attribute::PROVENANCE.read(reader, &SITE_NAMES)?.contains(&format!("study digest {digest};")))
    }

    /// The file beside the result at `result` of this study digest; none where there is no such file, or one of another
    /// result.
    pub(super) fn open(result: &Path, digest: &str) -> Result<Option<LabelledReader>, ResultError> {
        let path = Self::path(result);
        if !path.is_file() {
            return Ok(None);
        }
        let reader = LabelledReader::open(&path)?;
        Ok(Self::is_of_digest(&reader, digest)?.then_some(reader))
    }

    /// The arrays beside the result at `result` of this study digest; none where there is no such file, or one of
    /// another result.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn read(result: &Path, digest: &str) -> Result<Option<Self>, ResultError> {
        let Some(reader) = Self::open(result, digest)? else { return Ok(None) };
        let u_m = reader.array::<f64>(&SITE_SPECTRA.first_path(&SITE_NAMES))?;
        let shape: [usize; 4] = u_m.shape.try_into().unwrap_or_default();
        let place = |at: usize| reader.array::<f64>(&SITE_PLACES.path(&SITE_PLACES.quantities[at], &SITE_NAMES));
        Ok(Some(Self {
            longitude_deg: place(0)?.values,
            latitude_deg: place(1)?.values,
            measures: reader.axis::<String>(MEASURE.name)?,
            poes: reader.axis::<f64>(POE.name)?,
            years: attribute::YEARS.read(&reader, &SITE_NAMES)?,
            strengths: reader.axis::<f64>(STRENGTH.name)?,
            u_m: Array::new(shape, u_m.values).map_err(|error| JobError::input(error.to_string()))?,
        }))
    }
}
