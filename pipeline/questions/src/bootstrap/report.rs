//! What a bootstrap tells: Table 4.1, and rocking initiation.

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_job::ReferenceTable;
use uplift_motion::IntensityMeasure;
use uplift_result::declared::Quantity;
use uplift_result::{BANDS, MeasureBands, StoredSpectraBands, WidestInferred};
use uplift_uniform_risk::StoredStripes;

use super::bands::BandSettings;
use crate::error::QuestionsError;

/// The report of a bootstrap.
#[derive(Debug, Clone, Serialize)]
#[serde(transparent)]
pub struct BootstrapReport {
    /// The figures of Table 4.1, one a measure, site, probability and sample size, in this order.
    pub rows: Vec<BootstrapRow>,
    /// The result, whose file holds the bands now.
    #[serde(skip)]
    pub stored: StoredStripes,
    /// The tables beside it: bands, and figures of Table 4.1.
    #[serde(skip)]
    pub tables: [PathBuf; 2],
    /// Share of the replicates between the limits.
    #[serde(skip)]
    pub confidence: f64,
    /// Records in a sample.
    #[serde(skip)]
    pub sizes: Vec<u32>,
    /// The bands, a measure each.
    #[serde(skip)]
    pub bands: Vec<MeasureBands>,
    /// What was given to compare with.
    #[serde(skip)]
    pub reference: Vec<ReferenceRow>,
}

/// The figures of Table 4.1 of one spectrum and sample size; none where overturning or a displacement of zero leaves
/// none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BootstrapRow {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Probability of exceedance.
    pub poe: f64,
    /// Records in a sample.
    pub sample_size: u32,
    /// Error of the median (Eq. 4.9), per cent.
    pub e_median: Option<f64>,
    /// Range of the interval (Eq. 4.10), per cent.
    pub r_90ci: Option<f64>,
    /// Range of the interval over records and weighted hazard curves together (Eq. 4.10), per cent; none where the site
    /// has no such curves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_r_90ci: Option<f64>,
    /// The bands of the spectrum of all records there could be and of that of another set of this size; none where an
    /// ordinate is censored or all are 0.
    pub inferred: Option<WidestInferred>,
    /// The same of the repaired spectrum; none where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repaired: Option<RepairedFigures>,
}

/// The figures of Table 4.1 of a repaired spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RepairedFigures {
    /// Error of the median (Eq. 4.9), per cent.
    pub e_median: Option<f64>,
    /// Range of the interval (Eq. 4.10), per cent.
    pub r_90ci: Option<f64>,
    /// Samples whose weights miss the site's hazard, per cent.
    pub failed: f64,
    /// Range of the interval over records and weighted hazard curves together (Eq. 4.10), per cent; none where the site
    /// has no such curves, or one of them has no repair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_r_90ci: Option<f64>,
    /// Pairs of a sample and a curve whose weights miss the hazard of the curve, per cent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_failed: Option<f64>,
}

/// Where rocking begins (Section 4.5.2, Fig. 4.10): the strengths at which the band falls to the uplift displacement;
/// none where it is above it at every strength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Initiation {
    /// Of the lower limit.
    pub lower: Option<f64>,
    /// Of the median.
    pub median: Option<f64>,
    /// Of the upper limit.
    pub upper: Option<f64>,
    /// Width of the band over the median, at the strength of the median; none where it is not finite.
    pub width: Option<f64>,
}

impl BootstrapReport {
    pub(super) fn new(
        stored: StoredStripes,
        tables: [PathBuf; 2],
        sizes: Vec<u32>,
        settings: BandSettings,
        bands: Vec<MeasureBands>,
        reference: Vec<ReferenceRow>,
    ) -> Self {
        let mut rows = Vec::new();
        for (bands, measure) in bands.iter().zip(&stored.measures) {
            let known = |figure: f64| Some(figure).filter(|figure| !figure.is_nan());
            for (at @ [site, poe, size], error) in bands.plain.error_of_median.blocks() {
                let spectrum = (&stored.strengths[..], measure.exact_m.block([site, poe]));
                let repaired = bands.repaired.as_ref().filter(|own| !own.failed[[site, size]].is_nan());
                rows.push(BootstrapRow {
                    site: stored.sites[site].clone(),
                    im: bands.measure.label(),
                    poe: stored.poes[poe],
                    sample_size: sizes[size],
                    e_median: known(error[0]),
                    r_90ci: known(bands.plain.range_of_interval[at]),
                    joint_r_90ci: bands.plain.joint.as_ref().and_then(|joint| known(joint.range_of_interval[at])),
                    inferred: bands.inferred.as_ref().and_then(|inferred| inferred.widest(spectrum, at)),
                    repaired: repaired.map(|own| {
                        let joint = own.bands.joint.as_ref();
                        let failed = joint.and_then(|joint| known(100.0 * joint.failed.as_ref()?[[site, size]]));
                        RepairedFigures {
                            e_median: known(own.bands.error_of_median[at]),
                            r_90ci: known(own.bands.range_of_interval[at]),
                            failed: 100.0 * own.failed[[site, size]],
                            joint_r_90ci: joint.and_then(|joint| known(joint.range_of_interval[at])),
                            joint_failed: failed,
                        }
                    }),
                });
            }
        }
        Self { rows, stored, tables, confidence: settings.confidence, sizes, bands, reference }
    }

    /// Where rocking begins, by `bands` at the positions `[site, poe, size]`.
    ///
    /// # Panics
    /// If a position is out of range, which is a bug of the caller.
    pub fn initiation(&self, bands: &StoredSpectraBands, at: [usize; 3]) -> Initiation {
        let at_uplift = |values: &[f64]| values.iter().position(|&u_m| u_m <= self.stored.uplift_displacement_m);
        let strength = |values: &[f64]| at_uplift(values).map(|index| self.stored.strengths[index]);
        let [lower, median, upper] = bands.limits_m.each_ref().map(|limits| limits.block(at));
        Initiation {
            lower: strength(lower),
            median: strength(median),
            upper: strength(upper),
            width: at_uplift(median)
                .map(|index| (upper[index] - lower[index]) / median[index])
                .filter(|width| width.is_finite()),
        }
    }
}

/// A row: one site and sample size.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceRow {
    /// The site, its case of no account.
    pub site: String,
    /// Records in a sample.
    pub sample_size: u32,
    /// Measure (`pgv`, `pga`), with error of the median (Eq. 4.9) and range of the interval (Eq. 4.10) in per cent.
    pub figures: Vec<(String, Vec<f64>)>,
}

/// Reads a table with the columns of Table 4.1 (`site`, `sample_size`, `pgv_e_median_pct`, `pgv_r_90ci_pct`, …).
///
/// # Errors
/// A file that cannot be read, lacks these columns, or has a cell that is not a number.
pub fn read_reference(path: &Path) -> Result<Vec<ReferenceRow>, QuestionsError> {
    let table = ReferenceTable::read(path)?;
    let names: Vec<&str> = BANDS.exported().map(Quantity::exported_name).collect();
    let columns = |key: &str| names.iter().map(|name| format!("{key}_{name}")).collect::<Vec<_>>();
    let measures: Vec<&str> = IntensityMeasure::OF_CHAPTER_4
        .into_iter()
        .map(IntensityMeasure::key)
        .filter(|key| columns(key).iter().all(|name| table.has(name)))
        .collect();
    if !table.has("site") || !table.has("sample_size") || measures.is_empty() {
        let needed = columns(IntensityMeasure::Pgv.key()).join(" with ");
        return Err(table.fail(format!("needs the columns site, sample_size, and {needed} or the same of pga")).into());
    }
    (0..table.rows())
        .map(|row| {
            let figures = measures.iter().map(|key| {
                let numbers = columns(key).iter().map(|name| table.number(name, row)).collect::<Result<_, _>>()?;
                Ok(((*key).to_owned(), numbers))
            });
            Ok(ReferenceRow {
                site: table.text("site", row),
                sample_size: table.number("sample_size", row)?,
                figures: figures.collect::<Result<_, QuestionsError>>()?,
            })
        })
        .collect()
}
