//! Between which displacements many sites lie, read from the file beside a result a column at a time.

use std::path::Path;

use serde::Serialize;
use uplift_job::text::nearest;
use uplift_motion::IntensityMeasure;

use super::layout::attribute::sites as attribute;
use super::layout::axis::{MEASURE, POE, SITE, STRENGTH};
use super::site_arrays::{SITE_NAMES, SITE_SPECTRA, SiteArrays};
use crate::error::ResultError;

/// Between which displacements the plain spectra of many sites lie at the smallest probability.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SiteRanges {
    /// Probability of exceedance.
    pub poe: f64,
    /// Years that it refers to.
    pub years: f64,
    /// Sites of the table.
    pub sites: usize,
    /// Uplift strengths.
    pub strengths: Vec<f64>,
    /// By each measure.
    pub measures: Vec<MeasureRanges>,
}

/// The ranges by one measure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureRanges {
    /// `PGV` or `PGA`.
    pub im: String,
    /// Sites with a spectrum.
    pub sites: usize,
    /// Smallest and largest displacement of these at each strength, m; infinite where censored. None without a site.
    pub range_m: Vec<Option<[f64; 2]>>,
}

impl SiteRanges {
    /// Of the sites beside the result at `result` of this study digest, at the strengths nearest to those `wanted`.
    /// None where there is no such file, or one of another result.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn read(result: &Path, digest: &str, wanted: &[f64]) -> Result<Option<Self>, ResultError> {
        let Some(reader) = SiteArrays::open(result, digest)? else { return Ok(None) };
        let (strengths, poes) = (reader.axis::<f64>(STRENGTH.name)?, reader.axis::<f64>(POE.name)?);
        let shown = nearest(&strengths, wanted);
        let Some(rarest) = (0..poes.len()).min_by(|&a, &b| poes[a].total_cmp(&poes[b])) else { return Ok(None) };
        let mut measures = Vec::new();
        for (measure, key) in reader.axis::<String>(MEASURE.name)?.into_iter().enumerate() {
            let im = key.parse::<IntensityMeasure>().map_or(key, |measure| measure.label().to_owned());
            let mut ranges = MeasureRanges { im, sites: 0, range_m: Vec::new() };
            for &strength in &shown {
                let path = SITE_SPECTRA.first_path(&SITE_NAMES);
                let mut u_m = reader.along_first_axis(&path, &[measure, rarest, strength])?;
                u_m.retain(|own| !own.is_nan());
                ranges.sites = u_m.len();
                let widen = |of: Option<[f64; 2]>, own: &f64| {
                    Some(of.map_or([*own; 2], |[least, most]| [least.min(*own), most.max(*own)]))
                };
                ranges.range_m.push(u_m.iter().fold(None, widen));
            }
            measures.push(ranges);
        }
        Ok(Some(Self {
            poe: poes[rarest],
            years: attribute::YEARS.read(&reader, &SITE_NAMES)?,
            sites: reader.axis::<String>(SITE.name)?.len(),
            strengths: shown.iter().map(|&strength| strengths[strength]).collect(),
            measures,
        }))
    }
}
