//! The numbers of many sites as arrays: one file of labelled arrays over sites, measures, probabilities and strengths.

use std::path::{Path, PathBuf};

use uplift_inputs::SiteList;
use uplift_job::outputs::{SITE_ARRAYS, SITES_KIND, beside, mark};
use uplift_job::{Array, JobError};
use uplift_labelled::{AttributeValue, GrowingArray, LabelledReader, LabelledWriter};
use uplift_regression::ExponentialFit;
use uplift_result::NO_ORDINATE;
use uplift_study::{Repair, UniformRiskStudy};
use uplift_uniform_risk::SiteSpectra;

use super::layout::{FIT, problem};
use super::repair::SiteConsistency;
use crate::error::StudiesError;

const MEASURE: &str = "measure";
const PER_ORDINATE: [&str; 4] = ["site", MEASURE, "poe", "strength"];
const PER_SPECTRUM: [&str; 3] = ["site", MEASURE, "poe"];
const PER_MEASURE: [&str; 2] = ["site", MEASURE];

/// Groups of the spectra, plain and repaired.
const GROUPS: [&str; 2] = ["/urs", "/consistent"];
const FLAG: &str = "/urs/flag";
const PROBLEM: &str = "/urs/problem";
const LONGITUDE: &str = "/longitude_deg";
const LATITUDE: &str = "/latitude_deg";
const YEARS: &str = "years";

/// An array of each of [`GROUPS`].
struct Quantity {
    name: &'static str,
    unit: &'static str,
    long_name: &'static str,
    values: Values,
}

/// What an array of spectra holds.
enum Values {
    Displacement,
    /// The lower limit of the band, 0, or the upper one, 1.
    Limit(usize),
    /// The mean over weighted hazard curves, 0, or a fractile.
    Spread(usize),
    Fit(fn(&ExponentialFit) -> f64),
}

/// A displacement of each of [`GROUPS`].
const fn metres(name: &'static str, long_name: &'static str, values: Values) -> Quantity {
    Quantity { name, unit: "m", long_name, values }
}

const QUANTITIES: [Quantity; 13] = [
    metres("u_m", "displacement", Values::Displacement),
    metres("lower_m", "lower limit of its 90 % band", Values::Limit(0)),
    metres("upper_m", "upper limit of its 90 % band", Values::Limit(1)),
    metres(SPREAD[0], "weighted mean over the hazard curves", Values::Spread(0)),
    metres(SPREAD[1], "5 % of the weighted hazard curves", Values::Spread(1)),
    metres(SPREAD[2], "16 % of the weighted hazard curves", Values::Spread(2)),
    metres(SPREAD[3], "50 % of the weighted hazard curves", Values::Spread(3)),
    metres(SPREAD[4], "84 % of the weighted hazard curves", Values::Spread(4)),
    metres(SPREAD[5], "95 % of the weighted hazard curves", Values::Spread(5)),
    metres(FIT[0].0, "coefficient c0 of Eq. 4.11", Values::Fit(FIT[0].1)),
    Quantity { name: FIT[1].0, unit: "1", long_name: "coefficient c1 of Eq. 4.11", values: Values::Fit(FIT[1].1) },
    metres(FIT[2].0, "coefficient c2 of Eq. 4.11", Values::Fit(FIT[2].1)),
    metres(FIT[3].0, "error of the fit", Values::Fit(FIT[3].1)),
];

/// What the mean and the fractiles over weighted hazard curves are called.
pub(super) const SPREAD: [&str; 6] =
    ["mean_hazard_m", "u05_hazard_m", "u16_hazard_m", "u50_hazard_m", "u84_hazard_m", "u95_hazard_m"];

/// Name, long name and value of an array of what consistency says of a site.
type OfConsistency = (&'static str, &'static str, fn(&SiteConsistency) -> f64);

const OF_CONSISTENCY: [OfConsistency; 3] = [
    ("bias", "implied over the site's rates of the other measure, mean", |own| own.bias),
    ("max", "largest |ln(implied/site)|", |own| own.max),
    ("least_effective", "fewest effective records at a stripe", |own| own.least_effective),
];

/// Attribute of the root: where the numbers come from.
const PROVENANCE: &str = "provenance";
/// Attribute of the root: how many sites deserve which warning, as JSON.
pub(super) const FINDINGS: &str = "findings";
/// Attribute of the root of a slice: SHA-256 of each of its tables and of its map.
pub(super) const TABLES: &str = "tables";

/// The file beside the result file `result`.
pub fn cube_path(result: &Path) -> PathBuf {
    beside(result, SITE_ARRAYS)
}

/// Whether the file in `reader` says that it is of the result of this study digest.
pub(super) fn is_of_digest(reader: &LabelledReader, digest: &str) -> Result<bool, StudiesError> {
    Ok(reader.attribute::<String>("/", PROVENANCE)?.contains(&format!("study digest {digest};")))
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
    /// The arrays beside the result at `result` of this study digest; none where there is no such file, or one of
    /// another result.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn read(result: &Path, digest: &str) -> Result<Option<Self>, StudiesError> {
        let path = cube_path(result);
        if !path.is_file() {
            return Ok(None);
        }
        let reader = LabelledReader::open(&path)?;
        if !is_of_digest(&reader, digest)? {
            return Ok(None);
        }
        let u_m = reader.array::<f64>(&format!("{}/u_m", GROUPS[0]))?;
        let shape: [usize; 4] = u_m.shape.try_into().unwrap_or_default();
        Ok(Some(Self {
            longitude_deg: reader.array::<f64>(LONGITUDE)?.values,
            latitude_deg: reader.array::<f64>(LATITUDE)?.values,
            measures: reader.axis::<String>(MEASURE)?,
            poes: reader.axis::<f64>("poe")?,
            years: reader.attribute::<f64>("/", YEARS)?,
            strengths: reader.axis::<f64>("strength")?,
            u_m: Array::new(shape, u_m.values).map_err(|error| JobError::input(error.to_string()))?,
        }))
    }
}

/// The file while it is being written.
pub(super) struct Cube {
    path: PathBuf,
    writer: LabelledWriter,
    /// In the order of [`numbers`](Shape::numbers).
    arrays: Vec<GrowingArray<f64>>,
    flags: GrowingArray<u8>,
    problems: Vec<String>,
}

/// What there is of each site.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    measures: usize,
    poes: usize,
    /// Positions of the strengths that are written among those of the study.
    pub(super) strengths: Vec<usize>,
    pub(super) has_bands: bool,
    /// Whether there are means and fractiles over weighted hazard curves.
    pub(super) has_spread: bool,
    /// Whether there are repaired spectra beside the plain ones.
    pub(super) is_repaired: bool,
}

/// Some sites as they stand in the file.
#[derive(Debug, Default)]
pub(super) struct CubeRows {
    /// Of each array of numbers.
    numbers: Vec<Vec<f64>>,
    flags: Vec<u8>,
    /// Why there is no spectrum or no fit, by measure and probability; empty where there is one.
    problems: Vec<String>,
}

impl Shape {
    pub(super) fn new(study: &UniformRiskStudy, list: &SiteList, strengths: Vec<usize>) -> Self {
        Self {
            measures: list.exports.len(),
            poes: study.risk.poe.len(),
            strengths,
            has_bands: study.site_table.as_ref().is_some_and(|table| table.bands),
            has_spread: !list.branches.is_empty(),
            is_repaired: study.consistency.repair == Repair::Weights,
        }
    }

    /// Those of a group: the spread is of the plain spectra alone.
    fn quantities(&self, group: &str) -> impl Iterator<Item = &'static Quantity> {
        let (has_bands, has_spread) = (self.has_bands, self.has_spread && group == GROUPS[0]);
        QUANTITIES.iter().filter(move |quantity| match quantity.values {
            Values::Limit(_) => has_bands,
            Values::Spread(_) => has_spread,
            Values::Displacement | Values::Fit(_) => true,
        })
    }

    fn groups(&self) -> &'static [&'static str] {
        if self.is_repaired { &GROUPS } else { &GROUPS[..1] }
    }

    /// Path, axes, unit and long name of every array of numbers.
    fn numbers(&self) -> Vec<(String, &'static [&'static str], &'static str, &'static str)> {
        let of_group = |group: &&'static str| {
            let group = *group;
            self.quantities(group).map(move |quantity| {
                let axes: &[&str] =
                    if matches!(quantity.values, Values::Fit(_)) { &PER_SPECTRUM } else { &PER_ORDINATE };
                (format!("{group}/{}", quantity.name), axes, quantity.unit, quantity.long_name)
            })
        };
        let of_consistency = OF_CONSISTENCY
            .iter()
            .filter(|_| self.is_repaired)
            .map(|(name, long_name, _)| (format!("{}/{name}", GROUPS[1]), &PER_MEASURE[..], "1", *long_name));
        self.groups().iter().flat_map(of_group).chain(of_consistency).collect()
    }

    /// A site with its spectra in each export, or why it has none, and with what consistency says of each.
    pub(super) fn rows(
        &self,
        spectra: &[Result<SiteSpectra, String>],
        consistency: Option<&[SiteConsistency]>,
    ) -> CubeRows {
        let plain: Vec<Option<&SiteSpectra>> = spectra.iter().map(|own| own.as_ref().ok()).collect();
        let repaired: Vec<Option<&SiteSpectra>> =
            consistency.into_iter().flatten().map(|own| own.spectra.as_ref().ok()).collect();
        let mut numbers = Vec::new();
        for (of_group, group) in [plain, repaired].iter().zip(self.groups()) {
            for quantity in self.quantities(group) {
                numbers.push(self.of_quantity(&quantity.values, of_group));
            }
        }
        for (_, _, value) in OF_CONSISTENCY.iter().filter(|_| self.is_repaired) {
            numbers.push(consistency.into_iter().flatten().map(value).collect());
        }
        let (mut flags, mut problems) = (Vec::new(), Vec::new());
        for spectra in spectra {
            for poe in 0..self.poes {
                let ordinates = spectra.as_ref().ok().map(|own| own.at_poe(poe).0);
                let flag =
                    |&strength: &usize| ordinates.map_or(NO_ORDINATE, |ordinates| ordinates[strength].flag.number());
                flags.extend(self.strengths.iter().map(flag));
                problems.push(problem(spectra, poe));
            }
        }
        CubeRows { numbers, flags, problems }
    }

    fn of_quantity(&self, values: &Values, spectra: &[Option<&SiteSpectra>]) -> Vec<f64> {
        let mut row = Vec::with_capacity(self.measures * self.poes * self.strengths.len());
        for spectra in spectra {
            for poe in 0..self.poes {
                let at_poe = spectra.map(|spectra| spectra.at_poe(poe));
                let displacement_m = |strength: usize| at_poe.map_or(f64::NAN, |(all, _)| all[strength].displacement_m);
                let limit_m = |place: usize, end: usize| {
                    at_poe.and_then(|(_, bands_m)| bands_m.get(place)).map_or(f64::NAN, |band_m| band_m[end])
                };
                let all_m = spectra.map_or(&[][..], |spectra| spectra.spread_at_poe(poe));
                let spread_m = |place: usize, of: usize| all_m.get(place).map_or(f64::NAN, |all_m| all_m[of]);
                match *values {
                    Values::Displacement => row.extend(self.strengths.iter().map(|&own| displacement_m(own))),
                    Values::Limit(end) => row.extend((0..self.strengths.len()).map(|place| limit_m(place, end))),
                    Values::Spread(of) => row.extend((0..self.strengths.len()).map(|place| spread_m(place, of))),
                    Values::Fit(value) => {
                        let fit = spectra.and_then(|spectra| spectra.fits[poe].as_ref().ok());
                        row.push(fit.map_or(f64::NAN, value));
                    }
                }
            }
        }
        row
    }
}

impl CubeRows {
    /// The sites of the file in `reader`, one of these arrays.
    pub(super) fn read(reader: &LabelledReader, shape: &Shape) -> Result<Self, StudiesError> {
        let numbers = shape.numbers();
        let numbers = numbers.iter().map(|(path, ..)| Ok(reader.array::<f64>(path)?.values));
        Ok(Self {
            numbers: numbers.collect::<Result<_, StudiesError>>()?,
            flags: reader.array::<u8>(FLAG)?.values,
            problems: reader.array::<String>(PROBLEM)?.values,
        })
    }
}

impl Cube {
    /// Begins the file of the sites that `list` is asked for; `line` says where the numbers come from.
    pub(super) fn create(
        path: &Path,
        study: &UniformRiskStudy,
        list: &SiteList,
        shape: &Shape,
        line: &str,
    ) -> Result<Self, StudiesError> {
        let mut writer = LabelledWriter::create(path)?;
        writer.attribute("/", "program", mark())?;
        writer.attribute("/", "kind", SITES_KIND)?;
        writer.attribute("/", PROVENANCE, line)?;
        writer.attribute("/", YEARS, study.risk.years)?;
        let sites = &list.sites[list.range.clone()];
        let names: Vec<String> = sites.iter().map(|site| site.name.to_string()).collect();
        writer.axis_text("site", &names, "site")?;
        let measures: Vec<String> = list.exports.iter().map(|export| export.measure.key().to_owned()).collect();
        writer.axis_text(MEASURE, &measures, "intensity measure that the records are scaled by")?;
        writer.axis("poe", &study.risk.poe, "1", "probability of exceedance in `years`")?;
        let strengths: Vec<f64> = shape.strengths.iter().map(|&index| study.strengths[index]).collect();
        writer.axis("strength", &strengths, "1", "uplift strength over weight")?;
        let longitudes: Vec<f64> = sites.iter().map(|site| site.longitude_deg).collect();
        let latitudes: Vec<f64> = sites.iter().map(|site| site.latitude_deg).collect();
        writer.array(LONGITUDE, &["site"], &longitudes, "degrees_east", "longitude")?;
        writer.array(LATITUDE, &["site"], &latitudes, "degrees_north", "latitude")?;
        let mut arrays = Vec::new();
        for (path, axes, unit, long_name) in shape.numbers() {
            arrays.push(writer.grow(&path, axes, unit, long_name)?);
        }
        let words = "0 regular, 1 no exceedance, 2 censored, 3 no spectrum";
        let flags = writer.grow(FLAG, &PER_ORDINATE, "1", words)?;
        Ok(Self { path: path.to_owned(), writer, arrays, flags, problems: Vec::new() })
    }

    /// Appends some sites.
    pub(super) fn write(&mut self, rows: CubeRows) -> Result<(), StudiesError> {
        for (array, values) in self.arrays.iter_mut().zip(&rows.numbers) {
            self.writer.append(array, values)?;
        }
        self.writer.append(&mut self.flags, &rows.flags)?;
        self.problems.extend(rows.problems);
        Ok(())
    }

    /// Sets an attribute of the root.
    pub(super) fn attribute(&mut self, name: &str, value: impl Into<AttributeValue>) -> Result<(), StudiesError> {
        Ok(self.writer.attribute("/", name, value)?)
    }

    /// Puts the file in its place, and says where that is.
    pub(super) fn finish(self) -> Result<PathBuf, StudiesError> {
        let Self { path, mut writer, arrays, flags, problems } = self;
        for array in arrays {
            writer.complete(array)?;
        }
        writer.complete(flags)?;
        writer.array_text(PROBLEM, &PER_SPECTRUM, &problems, "why there is no spectrum, or no fit")?;
        writer.finish()?;
        Ok(path)
    }
}
