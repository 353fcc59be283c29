//! Variants of a study, run one after the other into results of their own, and compared.
//!
//! Every variant is an ordinary result. What one has computed another does not compute again: stripes of the same
//! motion, oscillator, strength and level are taken from the results that are finished, so that variants which differ
//! in hazard, sites, probabilities or some strengths cost next to nothing.

#![allow(rustdoc::invalid_html_tags)] // --help prints <study>

mod table;
mod variants;

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use sha2::{Digest, Sha256};
use uplift_alarms::alarms;
use uplift_engine::checkpoint::oscillator_key;
use uplift_inputs::load_uniform_risk;
use uplift_job::alarm::{Alarm, Severity};
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::study_run::RunOptions;
use uplift_job::{Array, JobError};
use uplift_labelled::hexadecimal;
use uplift_result::{MeasureSpectra, ResultFile, Spectrum, StoredConsistency, StoredSpectra};
use uplift_studies::uniform_risk::Inputs;
use uplift_study::{AnyStudy, Study, StudyError, UniformRiskStudy};
use uplift_uniform_risk::{BandOf, Displacement, DisplacementOptions, DisplacementReport, displacements};

use crate::error::{UpliftError, in_variants};
use crate::result_of::result_of;
use crate::shard::check_inputs;
use variants::{Variant, cases, product};

/// Variants of one sweep: more are a study of their own.
const MOST_VARIANTS: usize = 1000;

/// What is asked of a sweep.
#[derive(Debug, Clone, Default, Args)]
#[command(group = ArgGroup::new("variants").required(true).args(["over", "cases"]))]
pub struct SweepOptions {
    /// Study file, e.g. configs/quick.toml
    #[arg(id = "study", value_name = "STUDY")]
    pub study_file: PathBuf,
    /// Key and its values; every combination is run
    #[arg(long, value_name = "KEY=VALUE,VALUE…")]
    pub over: Vec<String>,
    /// Table of variants: a column a key, a row a variant, with a column `name` if wanted
    #[arg(long, value_name = "CASES.csv", conflicts_with = "over")]
    pub cases: Option<PathBuf>,
    /// Set a key for all variants, e.g. records.first=20
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Folder for the results [default: results/<study>.sweep]
    #[arg(short = 'o', long = "output", value_name = "FOLDER")]
    pub folder: Option<PathBuf>,
    /// What the caller typed; kept in the results.
    #[arg(skip)]
    pub command: String,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

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

/// A variant that is ready to be run.
struct Ready {
    name: String,
    study: UniformRiskStudy,
    options: RunOptions,
}

/// Where the results go: `folder`, or beside the result of the `study`.
///
/// # Errors
/// A study file with mistakes.
pub fn sweep_folder(options: &SweepOptions) -> Result<PathBuf, UpliftError> {
    if let Some(folder) = &options.folder {
        return Ok(folder.clone());
    }
    let study = Study::load(&options.study_file, &options.overrides)?;
    Ok(sweep_beside(&study.output.file))
}

/// The folder of a sweep of the study whose result is at `result`.
pub(crate) fn sweep_beside(result: &Path) -> PathBuf {
    outputs::beside(result, "sweep")
}

/// What a sweep writes into its folder at last.
pub(crate) fn comparison(folder: &Path) -> PathBuf {
    folder.join("comparison.csv")
}

/// Runs every variant of a study that has no result yet, and compares their spectra.
///
/// # Errors
/// Mistakes of the study, and then those of all variants at once, before anything is computed; a result or table that
/// would replace something else; as [`run`](crate::run()) of any of them: what is finished stays, and the same sweep
/// goes on from there.
pub fn sweep(options: &SweepOptions, events: &dyn Events) -> Result<SweepReport, UpliftError> {
    let variants = match &options.cases {
        Some(table) if options.over.is_empty() => cases(table)?,
        None if !options.over.is_empty() => product(&options.over)?,
        _ => return Err(JobError::Usage("give what varies: --over KEY=VALUE,VALUE or --cases FILE.csv".into()).into()),
    };
    let study = Study::load(&options.study_file, &options.overrides)?;
    let folder = sweep_folder(options)?;
    let table = comparison(&folder);
    let ready = ready(options, &variants, &folder)?;
    let inputs: Vec<&Path> = std::iter::once(options.study_file.as_path())
        .chain(ready.iter().filter_map(|variant| variant.options.output.as_deref()))
        .collect();
    outputs::check(&[Output::new(&table, OutputKind::Table(table::FIRST_COLUMN))], &inputs, options.force)?;
    let digest = digest(&ready)?;
    check_comparison(&table, &digest, options.force)?;
    check(&ready, events)?;
    outputs::provide_folder(&folder)?;
    let keys = variants::keys(&variants);
    // finished results by their oscillator: of another one nothing can be taken
    let mut finished: HashMap<String, Vec<PathBuf>> = HashMap::new();
    let mut reports = Vec::new();
    let count = ready.len();
    for (place, (variant, asked)) in ready.into_iter().zip(&variants).enumerate() {
        let Ready { name, study, options } = variant;
        events.remark("variant", &format!("{} of {count}: {name}", place + 1));
        let of_oscillator = finished.entry(oscillator_key(&study)).or_default();
        let result = result_of(&study, &RunOptions { earlier: of_oscillator.clone(), ..options }, events)?;
        of_oscillator.push(result.clone());
        reports.push(VariantReport::new(name, result, &keys, asked)?);
    }
    let report =
        SweepReport { study: options.study_file.clone(), title: study.title, folder, keys, variants: reports, table };
    table::write(&report, &digest)?;
    Ok(report)
}

/// By what a comparison is known again: a hash of the names and studies of its variants.
fn digest(ready: &[Ready]) -> Result<String, UpliftError> {
    let mut all = Sha256::new();
    for variant in ready {
        all.update(format!("{}\n{}\n", variant.name, variant.study.to_toml()?));
    }
    Ok(hexadecimal(&all.finalize()))
}

/// Refuses to replace the comparison of other variants, which may be all that is left of them.
fn check_comparison(table: &Path, digest: &str, force: bool) -> Result<(), UpliftError> {
    if force || !table.exists() || outputs::is_of_digest(table, digest) {
        return Ok(());
    }
    Err(JobError::Usage(format!(
        "{} compares other variants, or those of another study: give another folder (-o), or --force to replace it",
        table.display()
    ))
    .into())
}

/// Every variant as a study with the place of its result, or all mistakes of all of them.
fn ready(options: &SweepOptions, variants: &[Variant], folder: &Path) -> Result<Vec<Ready>, UpliftError> {
    if variants.is_empty() || variants.len() > MOST_VARIANTS {
        let count = variants.len();
        return Err(JobError::Usage(format!(
            "{count} variants: give 1 to {MOST_VARIANTS}, by --over KEY=VALUE,VALUE or --cases FILE.csv"
        ))
        .into());
    }
    let names = variants::names(variants);
    let (mut ready, mut mistakes): (Vec<Ready>, Vec<String>) = (Vec::new(), Vec::new());
    let keys = variants::keys(variants);
    let is_set = |key: &&String| options.overrides.iter().any(|set| set.split('=').next().map(str::trim) == Some(*key));
    // an empty cell of a table leaves what is set
    let is_replaced =
        |key: &&String| variants.iter().all(|variant| variant.changes.iter().any(|(changed, _)| changed == *key));
    if let Some(key) = keys.iter().filter(is_set).find(is_replaced) {
        let place = if options.cases.is_some() { "column" } else { "--over" };
        mistakes.push(format!("{place} {key}: --set gives it one value for all variants: leave one of them out"));
    }
    if keys.iter().any(|key| key == "output.file") {
        mistakes.push(
            "output.file: the results of a sweep lie in its folder (-o) and are named after their variants: leave the \
             key out"
                .to_owned(),
        );
    }
    let mut are_of_study = false;
    for (variant, name) in variants.iter().zip(names) {
        let overrides: Vec<String> = options.overrides.iter().cloned().chain(variant.overrides()).collect();
        match load_uniform_risk(&options.study_file, &overrides) {
            Ok(study) => {
                let options = RunOptions {
                    study_file: options.study_file.clone(),
                    output: Some(folder.join(format!("{name}.h5"))),
                    command: options.command.clone(),
                    overrides,
                    force: options.force,
                    ..RunOptions::default()
                };
                ready.push(Ready { name, study, options });
            }
            Err(error @ StudyError::Unreadable { .. }) => return Err(error.into()),
            Err(error) => {
                are_of_study = true;
                for mistake in error.mistakes() {
                    let help = mistake.help.as_ref().map_or_else(String::new, |help| format!(": {help}"));
                    let said = variant.mistake(format!("{mistake}{help}"));
                    // the same value stands in many variants
                    if !mistakes.contains(&said) {
                        mistakes.push(said);
                    }
                }
            }
        }
    }
    mistakes.extend(senseless(&ready, &keys));
    if mistakes.is_empty() {
        return Ok(ready);
    }
    Err(if are_of_study { UpliftError::Variants(mistakes) } else { JobError::Usage(in_variants(&mistakes)).into() })
}

/// What would compare nothing: studies without spectra, and spectra that cannot differ.
fn senseless(ready: &[Ready], keys: &[String]) -> Vec<String> {
    let mut mistakes = Vec::new();
    if let Some(empty) = ready.iter().find(|variant| variant.study.sites.is_empty()) {
        mistakes.push(format!(
            "{}: spectra are compared at the sites of [[sites]], and the study names none: name those of its site \
             table that are to be compared",
            empty.name
        ));
    }
    if keys.iter().any(|key| key == "seed") && !ready.iter().any(|of| of.study.records.component.is_drawn()) {
        mistakes.push(
            "seed: this study has the same spectra for all its values; for other records vary records.synthetic.seed"
                .to_owned(),
        );
        return mistakes;
    }
    let mut known: HashMap<String, &str> = HashMap::new();
    for Ready { name, study, .. } in ready {
        // a study that was loaded can be written
        let Ok(text) = study.to_toml() else { continue };
        if let Some(other) = known.insert(text, name) {
            mistakes.push(format!("{other} and {name} are the same study: leave one of them out"));
        }
    }
    mistakes
}

/// Records, hazard and places of all variants looked at before the first is computed; all that is wrong at once.
fn check(ready: &[Ready], events: &dyn Events) -> Result<(), UpliftError> {
    let mut mistakes: Vec<String> = Vec::new();
    for Ready { name, study, options } in ready {
        let any = AnyStudy::UniformRisk(Box::new(study.clone()));
        let checked = check_inputs(&any, options, events)
            .and_then(|()| Ok(Inputs::read(study, &uplift_job::events::Silent).map(drop)?));
        match checked {
            Ok(()) => {}
            Err(stopped) if uplift_job::is_stopped(&stopped) => return Err(stopped),
            Err(error) => mistakes.push(format!("{name}: {error}")),
        }
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
    }
    if mistakes.is_empty() { Ok(()) } else { Err(JobError::Inputs(mistakes).into()) }
}

impl VariantReport {
    /// What the file at `result` has.
    fn new(name: String, result: PathBuf, keys: &[String], asked: &Variant) -> Result<Self, UpliftError> {
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
        let mut alarms = alarms(&file)?;
        alarms.retain(|alarm| alarm.severity != Severity::Note);
        Ok(Self {
            alarms,
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
