//! Curve files of a site from what an engine exports, and the lines for a study.

mod check;
mod text;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use uplift_atomic_file::read_file;
use uplift_hazard::{
    ComponentDefinition, CsvOptions, Declared, ExportedCurve, RealizationWeight, SiteSelection, Statistic, read_csv,
    read_export, read_realization_weights,
};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::write_atomically;
use uplift_job::text::{counted, distinct};
use uplift_job::typed::number;

use crate::error::InputsError;
use check::{check_weights, one_site, weight_of};
use text::{Chosen, curve_text, file_stem, study_lines};

/// Distance of a site from the place asked for that needs no word, km.
pub(super) const NEAR_KM: f64 = 10.0;

/// Which curves are taken, and where they go.
#[expect(clippy::doc_markdown, reason = "what --help prints has no backticks")]
#[derive(Debug, Clone, PartialEq, Args)]
pub struct HazardImportOptions {
    /// Exports (OpenQuake CSV or NRML, USGS JSON): one a measure or realization
    #[arg(required = true, value_name = "EXPORT")]
    pub exports: Vec<PathBuf>,
    /// Folder for the curve files
    #[arg(short = 'o', long = "output", value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Which site of an export with several.
    #[arg(skip)]
    pub site: SiteSelection,
    /// Definition of the horizontal component: geometric mean, GMRotI50, RotD50, RotD100, larger, arbitrary
    #[arg(long, value_name = "WORD")]
    pub component: Option<ComponentDefinition>,
    /// Weights of the realizations (realizations_*.csv of OpenQuake)
    #[arg(long, value_name = "FILE")]
    pub weights: Option<PathBuf>,
    /// Largest distance from --near, km
    #[arg(long, value_name = "KM", default_value_t = 100.0, value_parser = number)]
    pub within_km: f64,
    /// Whether other curves at the places of the files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

/// The curves that were taken.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HazardImportReport {
    /// The site, by its name or place.
    pub site: String,
    /// The folder of the curve files.
    pub folder: PathBuf,
    /// The curves.
    pub curves: Vec<WrittenCurve>,
    /// The section of a study that uses them, TOML; empty where a study takes none of them.
    pub study_lines: String,
}

/// A curve that was written.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WrittenCurve {
    /// Name of the file in the folder.
    pub file: String,
    /// Its intensity measure.
    pub measure: String,
    /// Which statistic of the hazard it is, in words.
    pub kind: String,
    /// Weight of a realization; none of others.
    pub weight: Option<f64>,
}

/// Takes the curves of one site from the exports of an engine.
///
/// # Errors
/// Exports that cannot be read, hold several sites or none that is near; weights of only some realizations; a curve
/// file that is there already with another curve.
pub fn import(options: &HazardImportOptions, events: &dyn Events) -> Result<HazardImportReport, InputsError> {
    let weights = options.weights.as_ref().map(|path| read_realization_weights(path)).transpose()?;
    let mut curves: Vec<ExportedCurve> = Vec::new();
    for export in distinct(&options.exports) {
        curves.extend(read_export(export, &options.site)?);
    }
    let site = one_site(&curves, &options.site)?;
    if let Some(weights) = &weights {
        check_weights(&curves, weights)?;
    }
    check_distance(&curves, &site, options, events)?;
    let chosen = choose(curves, &site, weights.as_ref())?;
    let texts: Vec<(PathBuf, String)> = chosen.iter().map(|curve| text_of(curve, options)).collect();
    let is_new = |(path, text): &&(PathBuf, String)| {
        !read_file(path, text.len() as u64).is_ok_and(|there| there == text.as_bytes())
    };
    let curves: Vec<Output> =
        texts.iter().filter(is_new).map(|(path, _)| Output::new(path, OutputKind::Curve)).collect();
    let inputs: Vec<&PathBuf> = options.exports.iter().chain(&options.weights).collect();
    outputs::check(&curves, &inputs, options.force)?;
    for ((path, text), curve) in texts.iter().zip(&chosen) {
        check_text(path, text, curve)?;
    }
    for (path, text) in &texts {
        write_atomically(path, text.as_bytes())?;
    }
    for curve in &chosen {
        note_dropped(curve, events);
    }
    if options.component.is_none() && chosen.iter().any(|curve| curve.exported.curve.component().is_none()) {
        events.note(
            "the exports do not say how horizontal components are combined: --component says it, and a study checks it",
        );
    }
    let is_single = |curve: &Chosen| matches!(curve.exported.kind, Statistic::Mean | Statistic::Unspecified);
    if !chosen.iter().any(|curve| curve.weight.is_some() || is_single(curve)) {
        events.note("no mean among the exports: for a study give the mean too, or all realizations with --weights");
    }
    Ok(HazardImportReport {
        study_lines: study_lines(&chosen, &options.folder, &site),
        site,
        folder: options.folder.clone(),
        curves: chosen.into_iter().map(WrittenCurve::from_chosen).collect(),
    })
}

impl WrittenCurve {
    fn from_chosen(Chosen { exported, file, weight }: Chosen) -> Self {
        Self { file, measure: exported.curve.measure().to_owned(), kind: exported.kind.to_string(), weight }
    }
}

fn check_distance(
    curves: &[ExportedCurve],
    site: &str,
    options: &HazardImportOptions,
    events: &dyn Events,
) -> Result<(), InputsError> {
    let Some(distance_km) = curves.iter().filter_map(|curve| curve.distance_km).reduce(f64::max) else {
        return Ok(());
    };
    // a NaN is no distance to be within
    if !(distance_km <= options.within_km) {
        return Err(JobError::input(format!(
            "the nearest site, {site}, is {distance_km:.1} km away: is the longitude first, then the latitude? Give a \
             nearer place, or --within-km {:.0}",
            distance_km.ceil()
        ))
        .into());
    }
    let far = if distance_km > NEAR_KM { ": is that close enough?" } else { "" };
    events.note(&format!("nearest site: {site}, {distance_km:.1} km away{far}"));
    Ok(())
}

fn choose(
    curves: Vec<ExportedCurve>,
    site: &str,
    weights: Option<&BTreeMap<u32, RealizationWeight>>,
) -> Result<Vec<Chosen>, InputsError> {
    let mut chosen: Vec<Chosen> = Vec::new();
    for exported in curves {
        let file = format!("{}.csv", file_stem(&exported));
        if chosen.iter().any(|other| other.file == file) {
            return Err(JobError::input(format!(
                "two curves of {} {} for {site}: give the export of one calculation",
                exported.curve.measure(),
                exported.kind
            ))
            .into());
        }
        let weight = weights.and_then(|weights| weight_of(&exported.kind, weights));
        chosen.push(Chosen { exported, file, weight });
    }
    Ok(chosen)
}

fn note_dropped(Chosen { exported, file, .. }: &Chosen, events: &dyn Events) {
    for (count, what) in [
        (exported.dropped_zeros, "of zero at the end left out: no rate belongs to them"),
        (exported.dropped_certain, "of probability 1 at the start left out: no rate belongs to them"),
        (
            exported.dropped_alike,
            "at the start left out: they have the rate of the next one, since every earthquake exceeds them",
        ),
    ] {
        if count > 0 {
            events.note(&format!("{file}: {} {what}", counted(count, "level")));
        }
    }
}

/// Reads back what is to be written: a file that a study would refuse is not written.
fn check_text(path: &Path, text: &str, Chosen { exported, .. }: &Chosen) -> Result<(), InputsError> {
    let name = path.display().to_string();
    if let (Some(measure), Some(unit)) = Declared::in_table(text) {
        let declared = Declared { measure, unit };
        let read = read_csv(text, &name, &CsvOptions { declared, second_column: None, years: None })?.curve;
        if (read.im(), read.maf()) == (exported.curve.im(), exported.curve.maf()) {
            return Ok(());
        }
    }
    Err(JobError::input(format!("{name}: would not be read as the curve of the export, and is not written")).into())
}

/// The file of a curve, and what it says.
fn text_of(Chosen { exported, file, .. }: &Chosen, options: &HazardImportOptions) -> (PathBuf, String) {
    let curve = exported.curve.clone();
    let component = curve.component().or(options.component);
    (options.folder.join(file), curve_text(&curve.with_component(component), exported))
}
