//! The confidence bands of a result, and the draws that they were made of.

use serde::Serialize;
use uplift_bootstrap::{Interval, Unit};
use uplift_job::Array;
use uplift_motion::IntensityMeasure;

use super::declared::{Names, group, measure_names};
use super::layout::attribute::bootstrap as attribute;
use super::layout::axis::{POE, RECORD, REPLICATE, SAMPLE_SIZE, SITE, STRENGTH};
use super::layout::limit_names;
use super::stored_result::StoredResult;
use crate::error::ResultError;

/// The confidence bands of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredBands {
    /// Records in a sample.
    pub sizes: Vec<u32>,
    /// What was drawn.
    pub unit: Unit,
    /// Share of the replicates between the limits.
    pub confidence: f64,
    /// The bands of each measure, PGV first.
    pub measures: Vec<MeasureBands>,
}

/// The bands of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureBands {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Those of the spectra of records that count alike.
    pub plain: StoredSpectraBands,
    /// Those of the spectra of all records there could be, and of another set; none in older results.
    pub inferred: Option<InferredBands>,
    /// Those of the repaired spectra; none where the result had none at the time.
    pub repaired: Option<StoredRepairedBands>,
}

/// Bands of the spectra of all sites, with the figures of Table 4.1.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredSpectraBands {
    /// Lower limits, medians and upper limits, each `[site, poe, size, strength]`, m.
    pub limits_m: [Array<4>; 3],
    /// Lower and upper limits of the band of whole spectra `[site, poe, size, strength]`, m, where they are made; not
    /// read from a file.
    pub simultaneous_m: Option<[Array<4>; 2]>,
    /// Errors of the median `[site, poe, size]`, % (Eq. 4.9); NaN where an ordinate is censored or 0.
    pub error_of_median: Array<3>,
    /// Widths of the interval `[site, poe, size]`, % (Eq. 4.10); NaN where an ordinate is censored or 0.
    pub range_of_interval: Array<3>,
    /// The bands over records and weighted hazard curves together; none where no site has such curves.
    pub joint: Option<StoredJointBands>,
}

/// Bands over records and weighted hazard curves together; NaN at sites without such curves, and of repaired spectra
/// also where one of them has no repair.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredJointBands {
    /// Positions of the sites that have such curves.
    pub sites: Vec<usize>,
    /// Lower limits, medians and upper limits, each `[site, poe, size, strength]`, m.
    pub limits_m: [Array<4>; 3],
    /// Widths of the interval `[site, poe, size]`, % (Eq. 4.10); NaN where an ordinate is censored or 0.
    pub range_of_interval: Array<3>,
    /// Share of the pairs of a sample and a curve whose weights miss the hazard of the curve `[site, size]`; of
    /// repaired spectra alone.
    pub failed: Option<Array<2>>,
}

/// What the records of a set say beyond it; limits are `[site, poe, size, strength]`, m, lower before upper.
#[derive(Debug, Clone, PartialEq)]
pub struct InferredBands {
    /// Limits of the spectra of all records there could be.
    pub truth_m: [Array<4>; 2],
    /// Limits of the spectra of another set of as many records.
    pub prediction_m: [Array<4>; 2],
}

/// The bands beyond the set where the one of the truth is widest in metres, over the ordinate there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct WidestInferred {
    /// The strength.
    pub strength: f64,
    /// Limits of the ordinate of all records there could be, less the ordinate, over it, per cent.
    pub truth: [f64; 2],
    /// The same of the ordinate of another set.
    pub prediction: [f64; 2],
}

impl InferredBands {
    /// Those of all records, then those of another set, each the lower one before the upper one.
    pub fn limits_m(&self) -> [&Array<4>; 4] {
        let [[a, b], [c, d]] = [&self.truth_m, &self.prediction_m].map(<[Array<4>; 2]>::each_ref);
        [a, b, c, d]
    }

    /// Where the band of the truth is widest, at the positions `[site, poe, size]`; none where an ordinate is censored
    /// or all are 0. `strengths` and `spectrum_m` are over the strengths; those of 0, where nothing rocks, are left
    /// out.
    pub fn widest(&self, (strengths, spectrum_m): (&[f64], &[f64]), at: [usize; 3]) -> Option<WidestInferred> {
        let [truth, prediction] = [&self.truth_m, &self.prediction_m].map(|of| of.each_ref().map(|own| own.block(at)));
        let rocking = (0..strengths.len()).filter(|&place| strengths[place] > 0.0 && spectrum_m[place] > 0.0);
        let width = |place: usize| truth[1][place] - truth[0][place];
        let widest = rocking.max_by(|&a, &b| width(a).total_cmp(&width(b)))?;
        let per_cent =
            |limits: [&[f64]; 2]| limits.map(|limit| 100.0 * (limit[widest] - spectrum_m[widest]) / spectrum_m[widest]);
        let found =
            WidestInferred { strength: strengths[widest], truth: per_cent(truth), prediction: per_cent(prediction) };
        found.truth.iter().chain(&found.prediction).all(|limit| limit.is_finite()).then_some(found)
    }
}

/// The bands of repaired spectra; NaN at sites without repair.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredRepairedBands {
    /// The bands.
    pub bands: StoredSpectraBands,
    /// Share of the samples whose weights miss the site's hazard `[site, size]`.
    pub failed: Array<2>,
    /// Those of the repaired spectra of all records there could be, and of another set; none in older results.
    pub inferred: Option<InferredBands>,
}

/// The joint bands of one site, as those of all have them, without the axis of sites.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteJointBands {
    limits_m: [Vec<f64>; 3],
    range_of_interval: Vec<f64>,
    failed: Vec<f64>,
}

impl SiteJointBands {
    /// Those of the site at a position.
    pub fn new(bands: &StoredJointBands, site: usize) -> Self {
        Self {
            limits_m: bands.limits_m.each_ref().map(|limits| limits.block([site]).to_vec()),
            range_of_interval: bands.range_of_interval.block([site]).to_vec(),
            failed: bands.failed.iter().flat_map(|failed| failed.block([site])).copied().collect(),
        }
    }
}

/// How bands were made of their draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandMethod {
    /// Share of the replicates between the limits.
    pub confidence: f64,
    /// How a limit is read.
    pub interval: Interval,
    /// Only strengths above this count in Eq. 4.9 and 4.10.
    pub strength_above: f64,
}

/// How often each record was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredDraws {
    /// Records of the set.
    pub records: usize,
    /// Records in a sample.
    pub sizes: Vec<u32>,
    /// Samples of each size.
    pub replicates: usize,
    /// How often each record was drawn `[size, replicate, record]`.
    pub multiplicities: Vec<u32>,
    /// What was drawn.
    pub unit: Unit,
}

group! {
    /// Bands of spectra, and the figures of Table 4.1. The limits `<lower>`, `<median>` and `<upper>` are named after
    /// their levels ([`limit_names`]); those of repaired spectra lie in a group of their own, `<of_repaired>`.
    pub const BANDS: StoredSpectraBands = "/bootstrap/<im><of_repaired>";
    "<lower>" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m" "lower limit"
        ("lower limit, as the next ones named after its level (`u02_5_m` for a confidence of 0.95)")
        = |of, at| of.limits_m[0][at];
    "<median>" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m" "median of the replicates" = |of, at| of.limits_m[1][at];
    "<upper>" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m" "upper limit" = |of, at| of.limits_m[2][at];
    "e_median" [SITE, POE, SAMPLE_SIZE] F64 "%" "error of the median (Eq. 4.9)"
        ("error of the median (Eq. 4.9); NaN where an ordinate is censored or 0, as the next one")
        as "e_median_pct" "error of the median, %" = |of, at| of.error_of_median[at];
    "r_90ci" [SITE, POE, SAMPLE_SIZE] F64 "%" "range of the interval (Eq. 4.10)"
        as "r_90ci_pct" "range of the interval, %" = |of, at| of.range_of_interval[at];
}

group! {
    /// Lower and upper limits of the band of whole spectra.
    pub const SIMULTANEOUS_BANDS: [Array<4>; 2] = BANDS.path;
    "simultaneous_lower_m" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m" "limit of the band that holds whole spectra"
        ("limit of the band that holds whole spectra, if asked for, as the next one") = |of, at| of[0][at];
    "simultaneous_upper_m" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m" "limit of the band that holds whole spectra"
        = |of, at| of[1][at];
}

group! {
    /// What the records of a set say beyond it.
    pub const INFERRED_BANDS: InferredBands = BANDS.path;
    "truth_lower_m" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m"
        "limit of the spectrum of all records there could be"
        ("limit of the spectrum of all records there could be; absent in older results, as the next ones")
        = |of, at| of.truth_m[0][at];
    "truth_upper_m" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m"
        "limit of the spectrum of all records there could be" = |of, at| of.truth_m[1][at];
    "prediction_lower_m" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m" "limit of the spectrum of another set of records"
        ("limit of the spectrum of another set of the same number of records") = |of, at| of.prediction_m[0][at];
    "prediction_upper_m" [SITE, POE, SAMPLE_SIZE, STRENGTH] F64 "m" "limit of the spectrum of another set of records"
        = |of, at| of.prediction_m[1][at];
}

group! {
    /// Share of the samples whose weights miss the site's hazard.
    pub const FAILED_SAMPLES: Array<2> = "/bootstrap/<im>/consistent";
    "failed" [SITE, SAMPLE_SIZE] F64 "1" "share of the replicates whose weights miss the site's hazard"
        = |of, at| of[at];
}

group! {
    /// The band of a site over records and weighted hazard curves together.
    pub const JOINT_BANDS: SiteJointBands = "/bootstrap/<im><of_repaired>/joint/<site>";
    "<lower>" [POE, SAMPLE_SIZE, STRENGTH] F64 "m" "limit over resampled records and weighted hazard curves together"
        = |of, at| of.limits_m[0][at];
    "<median>" [POE, SAMPLE_SIZE, STRENGTH] F64 "m" "limit over resampled records and weighted hazard curves together"
        ("median of them") = |of, at| of.limits_m[1][at];
    "<upper>" [POE, SAMPLE_SIZE, STRENGTH] F64 "m" "limit over resampled records and weighted hazard curves together"
        = |of, at| of.limits_m[2][at];
    "r_90ci" [POE, SAMPLE_SIZE] F64 "%" "range of the joint interval (Eq. 4.10)" = |of, at| of.range_of_interval[at];
}

group! {
    /// Share of the pairs of a sample and a curve whose weights fail, of repaired spectra.
    pub const FAILED_PAIRS: SiteJointBands = JOINT_BANDS.path;
    "failed" [SAMPLE_SIZE] F64 "1"
        "share of the pairs of a replicate and a curve whose weights miss the hazard"
        ("repaired spectra only: share of the pairs whose weights miss the hazard of the branch, weighted by branch")
        = |of, at| of.failed[at];
}

group! {
    /// The draws.
    pub const DRAWS: StoredDraws = "/bootstrap";
    "multiplicity" [SAMPLE_SIZE, REPLICATE, RECORD] U32 "1" "how often each record was drawn"
        = |of, at| of.multiplicities[at];
}

impl StoredDraws {
    /// Lengths of the axes of its array.
    pub fn lengths(&self) -> [(&'static str, usize); 3] {
        [(SAMPLE_SIZE.name, self.sizes.len()), (REPLICATE.name, self.replicates), (RECORD.name, self.records)]
    }
}

impl StoredBands {
    /// Position of the samples with as many records as a set of `records`; the largest where there are none.
    pub fn place_of_set(&self, records: usize) -> usize {
        self.sizes.iter().position(|&size| size as usize == records).unwrap_or_else(|| self.largest())
    }

    /// Names of lower limit, median and upper limit: `u05_m`, `u50_m`, `u95_m`.
    pub fn limit_names(&self) -> [String; 3] {
        limit_names(self.confidence)
    }

    /// What was drawn, in words: "resampled records".
    pub fn drawn_words(&self) -> &'static str {
        match self.unit {
            Unit::Record => "resampled records",
            Unit::Pair => "resampled pairs with all their records",
            Unit::Event => "resampled earthquakes with all their records",
        }
    }

    /// The bands of `measure`.
    pub fn by_measure(&self, measure: IntensityMeasure) -> Option<&MeasureBands> {
        self.measures.iter().find(|bands| bands.measure == measure)
    }

    /// Position of the largest sample, whose bands say most.
    pub fn largest(&self) -> usize {
        (0..self.sizes.len()).max_by_key(|&size| self.sizes[size]).unwrap_or_default()
    }

    /// The levels of both limits in words: `5 %`, `95 %`.
    pub fn level_names(&self) -> [String; 2] {
        let [lower, _, upper] = limit_names(self.confidence);
        [lower, upper].map(|name| {
            let digits = name.trim_start_matches('u').trim_end_matches("_m").replace('_', ".");
            format!("{} %", digits.trim_start_matches('0'))
        })
    }
}

/// Where the bands of repaired spectra lie in the group of their measure.
pub const REPAIRED_BANDS: &str = "/consistent";

/// What stands for the names of the bands of a measure, with the names of the limits; `of_repaired` is empty or
/// [`REPAIRED_BANDS`].
pub fn band_names<'a>(
    measure: IntensityMeasure,
    [lower, median, upper]: &'a [String; 3],
    of_repaired: &'a str,
) -> [(&'static str, &'a str); 5] {
    let limits = [("<lower>", lower.as_str()), ("<median>", median), ("<upper>", upper)];
    [("<im>", measure.key()), limits[0], limits[1], limits[2], ("<of_repaired>", of_repaired)]
}

/// Lengths of the axes of bands `[site, poe, size, strength]`.
pub fn band_lengths([sites, poes, sizes, strengths]: [usize; 4]) -> [(&'static str, usize); 4] {
    [(SITE.name, sites), (POE.name, poes), (SAMPLE_SIZE.name, sizes), (STRENGTH.name, strengths)]
}

impl StoredResult {
    /// The confidence bands at the probabilities of the study; none before `uplift bootstrap`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn stored_bands(&self) -> Result<Option<StoredBands>, ResultError> {
        let axes = self.stored_axes()?;
        if !self.reader.exists(BANDS.root()) {
            return Ok(None);
        }
        let sizes = self.reader.axis::<u32>(SAMPLE_SIZE.name)?;
        let confidence = attribute::CONFIDENCE.read(&self.reader, &[])?;
        let limits = limit_names(confidence);
        let shape = [axes.sites.len(), axes.poes.len(), sizes.len(), axes.strengths.len()];
        let lengths = band_lengths(shape);
        let [sites, poes, size, _] = shape;
        let nan = || Array::from_fn(shape, |_| f64::NAN);
        let nan_figures = || Array::from_fn([sites, poes, size], |_| f64::NAN);
        let mut measures = Vec::new();
        for measure in self.measures() {
            if !self.reader.exists(&format!("{}/{}", BANDS.root(), measure.key())) {
                continue;
            }
            let bands = |of_repaired| {
                let names = band_names(measure, &limits, of_repaired);
                let mut bands = StoredSpectraBands {
                    limits_m: [nan(), nan(), nan()],
                    simultaneous_m: None,
                    error_of_median: nan_figures(),
                    range_of_interval: nan_figures(),
                    joint: self.joint_bands(&names, &axes.sites, shape)?,
                };
                BANDS.read(self, &names, &lengths, &mut bands)?;
                Ok::<_, ResultError>(bands)
            };
            let inferred = |of_repaired| {
                let names = band_names(measure, &limits, of_repaired);
                let mut found = InferredBands { truth_m: [nan(), nan()], prediction_m: [nan(), nan()] };
                let is_there = INFERRED_BANDS.is_in(self, &names);
                if is_there {
                    INFERRED_BANDS.read(self, &names, &lengths, &mut found)?;
                }
                Ok::<_, ResultError>(is_there.then_some(found))
            };
            let (plain, names) = (bands("")?, band_names(measure, &limits, ""));
            let mut repaired = None;
            if FAILED_SAMPLES.is_in(self, &names) {
                let failed = FAILED_SAMPLES.read_array("failed", self, &names, [lengths[0], lengths[2]])?;
                let (bands, inferred) = (bands(REPAIRED_BANDS)?, inferred(REPAIRED_BANDS)?);
                repaired = Some(StoredRepairedBands { bands, failed, inferred });
            }
            let inferred = inferred("")?;
            measures.push(MeasureBands { measure, plain, inferred, repaired });
        }
        Ok(Some(StoredBands { sizes, unit: self.drawn_unit()?, confidence, measures }))
    }

    /// The joint bands of the bands with these `names`, over the `shape` of those; none where no site has any.
    fn joint_bands(
        &self,
        names: Names<'_>,
        sites: &[String],
        shape: [usize; 4],
    ) -> Result<Option<StoredJointBands>, ResultError> {
        let [count, poes, sizes, strengths] = shape;
        let nan = |length| vec![f64::NAN; length];
        let (mut places, mut has_failed) = (Vec::new(), false);
        let of_site = |(place, site): (usize, &String)| {
            let names = [names, &[("<site>", site)]].concat();
            let limits_m = [(); 3].map(|()| nan(poes * sizes * strengths));
            let mut own = SiteJointBands { limits_m, range_of_interval: nan(poes * sizes), failed: nan(sizes) };
            if JOINT_BANDS.is_in(self, &names) {
                places.push(place);
                JOINT_BANDS.read(self, &names, &band_lengths(shape), &mut own)?;
            }
            if FAILED_PAIRS.is_in(self, &names) {
                has_failed = true;
                FAILED_PAIRS.read(self, &names, &band_lengths(shape), &mut own)?;
            }
            Ok(own)
        };
        let sites = sites.iter().enumerate().map(of_site).collect::<Result<Vec<_>, ResultError>>()?;
        let limit = |limit: usize| {
            Array::from_fn(shape, |[site, poe, size, strength]| {
                sites[site].limits_m[limit][(poe * sizes + size) * strengths + strength]
            })
        };
        Ok((!places.is_empty()).then(|| StoredJointBands {
            sites: places,
            limits_m: [0, 1, 2].map(limit),
            range_of_interval: Array::from_fn([count, poes, sizes], |[site, poe, size]| {
                sites[site].range_of_interval[poe * sizes + size]
            }),
            failed: has_failed.then(|| Array::from_fn([count, sizes], |[site, size]| sites[site].failed[size])),
        }))
    }

    /// Whether there are bands of repaired spectra.
    pub fn has_repaired_bands(&self) -> bool {
        self.measures().into_iter().any(|own| FAILED_SAMPLES.is_in(self, &measure_names(own)))
    }

    /// The draws of the bands; none before `uplift bootstrap`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn draws(&self) -> Result<Option<StoredDraws>, ResultError> {
        let records = self.stored_axes()?.records.len();
        if !DRAWS.is_in(self, &[]) {
            return Ok(None);
        }
        let sizes = self.reader.axis::<u32>(SAMPLE_SIZE.name)?;
        let replicates = self.reader.axis::<u32>(REPLICATE.name)?.len();
        let multiplicities = vec![0; sizes.len() * replicates * records];
        let mut draws = StoredDraws { records, sizes, replicates, multiplicities, unit: self.drawn_unit()? };
        DRAWS.read(self, &[], &draws.lengths(), &mut draws)?;
        Ok(Some(draws))
    }

    /// What the draws are of; records in older results.
    fn drawn_unit(&self) -> Result<Unit, ResultError> {
        let Ok(word) = attribute::UNIT.read(&self.reader, &[]) else { return Ok(Unit::Record) };
        let unit = Unit::ALL.into_iter().find(|unit| unit.key() == word);
        unit.ok_or_else(|| self.damaged(format!("{}: unit {word:?}", BANDS.root())))
    }

    /// How the bands of the file were made of their draws.
    ///
    /// # Errors
    /// A file without bands, or one that is damaged.
    pub fn band_method(&self) -> Result<BandMethod, ResultError> {
        let word = attribute::INTERVAL.read(&self.reader, &[])?;
        let interval = Interval::ALL.into_iter().find(|interval| interval.key() == word);
        Ok(BandMethod {
            confidence: attribute::CONFIDENCE.read(&self.reader, &[])?,
            interval: interval.ok_or_else(|| self.damaged(format!("{}: interval {word:?}", BANDS.root())))?,
            strength_above: attribute::STRENGTH_ABOVE.read(&self.reader, &[])?,
        })
    }
}
