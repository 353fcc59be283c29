//! Variants of a study, run one after the other into results of their own, and compared.
//!
//! Every variant is an ordinary result. What one has computed another does not compute again: stripes of the same
//! motion, oscillator, strength and level are taken from the results that are finished, so that variants which differ
//! in hazard, sites, probabilities or some strengths cost next to nothing.

#![allow(rustdoc::invalid_html_tags)] // --help prints <study>

mod report;
mod table;
mod variants;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use sha2::{Digest, Sha256};
use uplift_engine::checkpoint::oscillator_key;
use uplift_inputs::load_uniform_risk;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::study_run::RunOptions;
use uplift_labelled::hexadecimal;
use uplift_studies::uniform_risk::Inputs;
use uplift_study::{AnyStudy, Study, StudyError, UniformRiskStudy};

pub use report::{SweepReport, VariantReport, VariantSpectra};

use crate::error::{UpliftError, in_variants};
use crate::result_of::result_of;
use crate::shard::check_inputs;
use variants::{MOST_VARIANTS, Variant, cases, product};

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
