//! What a sweep found: its variants with their results, spectra and warnings.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use uplift_alarms::alarms;
use uplift_job::Array;
use uplift_job::alarm::{Alarm, Severity};
use uplift_job::text::typed_path;
use uplift_result::{MeasureSpectra, ResultFile, Spectrum, StoredConsistency, StoredSpectra};
use uplift_uniform_risk::{BandOf, Displacement, DisplacementOptions, DisplacementReport, displacements};

use super::variants::Variant;
use crate::error::UpliftError;

/// The report of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepReport {
    /// The study file.
    pub study: PathBuf,
    /// Title of the study.
    pub title: String,
    /// Folder of the results.
    pub folder: PathBuf,
    /// Keys that vary.
    pub keys: Vec<String>,
    /// The variants, in the order asked for.
    pub variants: Vec<VariantReport>,
    /// The table of the comparison.
    pub table: PathBuf,
}

/// One variant with its result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariantReport {
    /// Its name, that of its result file.
    pub name: String,
    /// The result.
    pub result: PathBuf,
    /// Values of the keys that vary, as they were given; none where this variant has that of the study.
    pub values: Vec<Option<String>>,
    /// Whether the records are synthetic.
    pub synthetic: bool,
    /// Its spectra.
    #[serde(flatten)]
    pub spectra: VariantSpectra,
    /// Displacements with their confidence bands, of its smallest probability by each measure.
    pub displacements: Vec<Displacement>,
    /// What the bands by each measure take for independent, with the measure: `records` or `earthquakes`.
    pub band_of: BTreeMap<&'static str, BandOf>,
    /// The same of its repaired spectra; empty without a repair.
    #[serde(skip)]
    pub repaired: Vec<Displacement>,
    /// What is to be seen to before its numbers are used, the worst first.
    pub alarms: Vec<Alarm>,
}

/// The uniform risk spectra of a variant, with the repaired ones.
#[derive(Debug, Clone, PartialEq)]
pub struct VariantSpectra {
    /// Those of records that count alike.
    pub plain: StoredSpectra,
    /// The repaired displacements of each measure `[site, poe, strength]`, m; none without a repair.
    pub repaired_m: Vec<Option<Array<3>>>,
}

impl VariantSpectra {
    fn read(file: &ResultFile, consistency: &[StoredConsistency]) -> Result<Self, UpliftError> {
        let plain = file.spectra()?;
        let repaired_m = |own: &MeasureSpectra| consistency.iter().find(|of| of.scaled_to == own.measure)?.u_m.clone();
        Ok(Self { repaired_m: plain.measures.iter().map(repaired_m).collect(), plain })
    }

    /// Every spectrum with its repaired displacements, by measure, then site, then probability.
    pub fn rows(&self) -> impl Iterator<Item = (Spectrum<'_>, Option<&[f64]>)> {
        let repaired_m = self.plain.measures.iter().zip(&self.repaired_m).flat_map(|(own, repaired_m)| {
            own.fits.blocks::<2>().map(move |(at, _)| repaired_m.as_ref().map(|u_m| u_m.block(at)))
        });
        self.plain.rows().zip(repaired_m)
    }
}

impl Serialize for VariantSpectra {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Row<'a> {
            #[serde(flatten)]
            spectrum: Spectrum<'a>,
            repaired_m: Option<&'a [f64]>,
        }
        let rows: Vec<Row<'_>> = self.rows().map(|(spectrum, repaired_m)| Row { spectrum, repaired_m }).collect();
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("years", &self.plain.years)?;
        map.serialize_entry("strengths", &self.plain.strengths)?;
        map.serialize_entry("spectra", &rows)?;
        map.end()
    }
}

impl VariantReport {
    /// What the file at `result` has.
    pub(super) fn new(name: String, result: PathBuf, keys: &[String], asked: &Variant) -> Result<Self, UpliftError> {
        let file = ResultFile::open(&result)?;
        let consistency = file.consistency()?;
        let with_bands = |repaired: bool| {
            let is_there = |measure| consistency.iter().any(|of| of.scaled_to == measure && of.u_m.is_some());
            let measures = file.measures().into_iter().filter(|&measure| !repaired || is_there(measure));
            let of = |measure| {
                let asked = DisplacementOptions { measure: Some(measure), repaired, ..DisplacementOptions::default() };
                Ok(displacements(&file, &asked)?)
            };
            measures.map(of).collect::<Result<Vec<_>, UpliftError>>()
        };
        let all = |found: &[DisplacementReport]| found.iter().flat_map(|of| of.displacements.clone()).collect();
        let (plain, repaired) = (with_bands(false)?, with_bands(true)?);
        let typed = typed_path(&result);
        let alarms = alarms(&file)?.into_iter().filter(|alarm| alarm.severity != Severity::Note);
        Ok(Self {
            alarms: alarms.map(|alarm| alarm.naming(&typed)).collect(),
            name,
            values: keys.iter().map(|key| asked.value(key).map(str::to_owned)).collect(),
            synthetic: file.is_synthetic()?,
            spectra: VariantSpectra::read(&file, &consistency)?,
            displacements: all(&plain),
            band_of: plain.iter().map(|of| (of.measure.label(), of.band_of)).collect(),
            repaired: all(&repaired),
            result,
        })
    }
}
