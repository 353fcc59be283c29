//! The confidence bands of a result, and the draws that they were made of.

use serde::Serialize;
use uplift_bootstrap::{Interval, Unit};
use uplift_job::Array;
use uplift_motion::IntensityMeasure;

use super::file::{ResultFile, RiskAxes};
use super::layout::{MULTIPLICITY, axis, band, bootstrap, joint, limit_names, repaired_band};
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
    /// Those of the spectra of all records there could be, and of another set; none in results of before.
    pub inferred: Option<InferredBands>,
    /// Those of the repaired spectra; none where the result had none at the time.
    pub repaired: Option<StoredRepairedBands>,
}

/// Bands of the spectra of all sites, with the figures of Table 4.1.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredSpectraBands {
    /// Lower limits, medians and upper limits, each `[site, poe, size, strength]`, m.
    pub limits_m: [Array<4>; 3],
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
    /// Lower limits, medians and upper limits, each `[site, poe, size, strength]`, m.
    pub limits_m: [Array<4>; 3],
    /// Widths of the interval `[site, poe, size]`, % (Eq. 4.10); NaN where an ordinate is censored or 0.
    pub range_of_interval: Array<3>,
    /// Share of the pairs of a sample and a curve whose weights do not bring the hazard of the curve `[site, size]`; of
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
    /// Share of the samples whose weights do not bring the site's hazard `[site, size]`.
    pub failed: Array<2>,
}

/// The joint bands of one site as the file has them, without the axis of sites.
struct SiteJointBands {
    limits_m: [Array<3>; 3],
    range_of_interval: Array<2>,
    failed: Option<Array<1>>,
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

impl StoredBands {
    /// Position of the samples with as many records as a set of `records`; the largest where there are none.
    pub fn of_set(&self, records: usize) -> usize {
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
    pub fn of(&self, measure: IntensityMeasure) -> Option<&MeasureBands> {
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

impl ResultFile {
    /// The confidence bands of a result of uniform risk; none before `uplift bootstrap`, and none of risks that it was
    /// asked for before they are resampled.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn bands(&self) -> Result<Option<StoredBands>, ResultError> {
        if let Some(asked) = &self.asked {
            return Ok(asked.bands.clone());
        }
        let axes = self.axes()?;
        if !self.reader.exists(bootstrap::ROOT) {
            return Ok(None);
        }
        let sizes = self.reader.axis_u32(axis::SAMPLE_SIZE)?;
        let confidence = self.reader.attribute_f64(bootstrap::ROOT, "confidence")?;
        let names = limit_names(confidence);
        let spectra = [(axis::SITE, axes.sites.len()), (axis::POE, axes.poes.len()), (axis::SAMPLE_SIZE, sizes.len())];
        let [site, poe, size] = spectra;
        let strength = (axis::STRENGTH, axes.strengths.len());
        let mut measures = Vec::new();
        for measure in self.measures() {
            if !self.reader.exists(&bootstrap::group(measure)) {
                continue;
            }
            let arrays = |path: &dyn Fn(&str) -> String| {
                let limit = |name: &String| self.array(&path(name), [site, poe, size, strength]);
                let [lower, median, upper] = &names;
                let figures = |name| self.array(&path(name), spectra);
                Ok::<_, ResultError>(StoredSpectraBands {
                    limits_m: [limit(lower)?, limit(median)?, limit(upper)?],
                    error_of_median: figures(bootstrap::E_MEDIAN)?,
                    range_of_interval: figures(bootstrap::R_90CI)?,
                    joint: self.joint_bands(path, &names, (&axes, sizes.len()))?,
                })
            };
            let plain = arrays(&|name| band(measure, name))?;
            let of_repair = |name: &str| repaired_band(measure, name);
            let failed = of_repair(bootstrap::FAILED);
            let repaired = if self.reader.exists(&failed) {
                Some(StoredRepairedBands { bands: arrays(&of_repair)?, failed: self.array(&failed, [site, size])? })
            } else {
                None
            };
            let limits = |names: [&str; 2]| -> Result<[Array<4>; 2], ResultError> {
                let [lower, upper] = names.map(|name| self.array(&band(measure, name), [site, poe, size, strength]));
                Ok([lower?, upper?])
            };
            let inferred = if self.reader.exists(&band(measure, bootstrap::TRUTH[0])) {
                let (truth_m, prediction_m) = (limits(bootstrap::TRUTH)?, limits(bootstrap::PREDICTION)?);
                Some(InferredBands { truth_m, prediction_m })
            } else {
                None
            };
            measures.push(MeasureBands { measure, plain, inferred, repaired });
        }
        Ok(Some(StoredBands { sizes, unit: self.drawn_unit()?, confidence, measures }))
    }

    /// The joint bands beside those of the `path` of an array by its name; none where no site has any.
    fn joint_bands(
        &self,
        path: &dyn Fn(&str) -> String,
        limit_names: &[String; 3],
        (axes, sizes): (&RiskAxes, usize),
    ) -> Result<Option<StoredJointBands>, ResultError> {
        let [poe, size] = [(axis::POE, axes.poes.len()), (axis::SAMPLE_SIZE, sizes)];
        let strength = (axis::STRENGTH, axes.strengths.len());
        let of_site = |site: &String| -> Result<Option<SiteJointBands>, ResultError> {
            let path = |name: &str| path(&joint(site, name));
            if !self.reader.exists(&path(bootstrap::R_90CI)) {
                return Ok(None);
            }
            let failed = path(bootstrap::FAILED);
            let has_failed = self.reader.exists(&failed);
            let [lower, median, upper] =
                limit_names.each_ref().map(|name| self.array(&path(name), [poe, size, strength]));
            Ok(Some(SiteJointBands {
                limits_m: [lower?, median?, upper?],
                range_of_interval: self.array(&path(bootstrap::R_90CI), [poe, size])?,
                failed: has_failed.then(|| self.array(&failed, [size])).transpose()?,
            }))
        };
        let sites = axes.sites.iter().map(of_site).collect::<Result<Vec<_>, _>>()?;
        let own = |site: usize| sites[site].as_ref();
        let ([(_, poe), (_, size)], (_, strength), count) = ([poe, size], strength, sites.len());
        let has_failed = sites.iter().flatten().any(|own| own.failed.is_some());
        Ok(sites.iter().any(Option::is_some).then(|| StoredJointBands {
            limits_m: [0, 1, 2].map(|limit| {
                Array::from_fn([count, poe, size, strength], |[site, poe, size, strength]| {
                    own(site).map_or(f64::NAN, |own| own.limits_m[limit][[poe, size, strength]])
                })
            }),
            range_of_interval: Array::from_fn([count, poe, size], |[site, poe, size]| {
                own(site).map_or(f64::NAN, |own| own.range_of_interval[[poe, size]])
            }),
            failed: has_failed.then(|| {
                let failed = |site| own(site)?.failed.as_ref();
                Array::from_fn([count, size], |[site, size]| failed(site).map_or(f64::NAN, |own| own[[size]]))
            }),
        }))
    }

    /// Whether there are bands of repaired spectra.
    pub fn has_repaired_bands(&self) -> bool {
        self.measures().iter().any(|&own| self.reader.exists(&repaired_band(own, bootstrap::FAILED)))
    }

    /// The draws of the bands; none before `uplift bootstrap`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn draws(&self) -> Result<Option<StoredDraws>, ResultError> {
        let records = self.axes()?.records.len();
        if !self.reader.exists(MULTIPLICITY) {
            return Ok(None);
        }
        let sizes = self.reader.axis_u32(axis::SAMPLE_SIZE)?;
        let replicates = self.reader.axis_u32(axis::REPLICATE)?.len();
        let lengths = [(axis::SAMPLE_SIZE, sizes.len()), (axis::REPLICATE, replicates), (axis::RECORD, records)];
        let multiplicities = self.checked(MULTIPLICITY, self.reader.array_u32(MULTIPLICITY)?, &lengths)?;
        Ok(Some(StoredDraws { records, sizes, replicates, multiplicities, unit: self.drawn_unit()? }))
    }

    /// What the draws are of; records in results of before.
    fn drawn_unit(&self) -> Result<Unit, ResultError> {
        let Ok(word) = self.reader.attribute_text(bootstrap::ROOT, "unit") else { return Ok(Unit::Record) };
        let unit = Unit::ALL.into_iter().find(|unit| unit.key() == word);
        unit.ok_or_else(|| self.damaged(format!("{}: unit {word:?}", bootstrap::ROOT)))
    }

    /// How the bands of the file were made of their draws.
    ///
    /// # Errors
    /// A file without bands, or one that is damaged.
    pub fn band_method(&self) -> Result<BandMethod, ResultError> {
        let word = self.reader.attribute_text(bootstrap::ROOT, "interval")?;
        let interval = Interval::ALL.into_iter().find(|interval| interval.key() == word);
        Ok(BandMethod {
            confidence: self.reader.attribute_f64(bootstrap::ROOT, "confidence")?,
            interval: interval.ok_or_else(|| self.damaged(format!("{}: interval {word:?}", bootstrap::ROOT)))?,
            strength_above: self.reader.attribute_f64(bootstrap::ROOT, "strength_above")?,
        })
    }
}
