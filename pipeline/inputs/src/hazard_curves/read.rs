//! Curves of files, each with what to call it.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift_hazard::{
    CsvCurve, CsvOptions, Declared, ExportedCurve, ExportedCurves, HazardCurve, HazardError, SecondColumn,
    SiteSelection, Statistic, read_csv, read_export, table_text,
};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::text::{counted, distinct};
use uplift_job::typed::number;
use uplift_motion::{IntensityMeasure, STANDARD_GRAVITY_M_S2};

use super::import::NEAR_KM;
use crate::error::InputsError;

/// Which curves of a file are read, and what a table does not say.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct CurveOptions {
    /// Which site of an export with several.
    #[arg(skip)]
    pub site: SiteSelection,
    /// Intensity measure, if the table does not name it: PGV, PGA
    #[arg(long, value_name = "NAME")]
    pub measure: Option<String>,
    /// Unit of the levels: cm/s, m/s, g, m/s2, cm/s2
    #[arg(long, value_name = "UNIT")]
    pub unit: Option<String>,
    /// Years of the probabilities
    #[arg(long, value_name = "YEARS", value_parser = number)]
    pub years: Option<f64>,
}

/// A curve with what to call it.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCurve {
    /// Site and statistic, or folder and file.
    pub name: String,
    /// The curve.
    pub curve: HazardCurve,
    /// What the second column of a table was taken for; none of an export, which says so itself.
    pub read_as: Option<String>,
}

/// The curves of `files`, each read once: those of an export, or the one of a table with two columns.
///
/// # Errors
/// A file that is neither; a table that does not say what it holds.
pub fn read(files: &[PathBuf], options: &CurveOptions, events: &dyn Events) -> Result<Vec<NamedCurve>, InputsError> {
    let mut curves = Vec::new();
    for file in distinct(files) {
        curves.extend(read_file(file, options, events)?);
    }
    Ok(curves)
}

/// The curves of one file.
pub(super) fn read_file(
    path: &Path,
    options: &CurveOptions,
    events: &dyn Events,
) -> Result<Vec<NamedCurve>, InputsError> {
    let export = match curves_of(path, &options.site, events) {
        Ok(curves) => {
            if let Some(far) = curves.iter().filter_map(|curve| curve.distance_km).reduce(f64::max) {
                let order = if far > NEAR_KM { " (--near takes longitude, then latitude)" } else { "" };
                events.note(&format!("{}: the nearest site is {far:.1} km away{order}", path.display()));
            }
            return Ok(curves.into_iter().map(|exported| named(path, exported)).collect());
        }
        Err(error) => error,
    };
    let text = table_text(path)?;
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        let reason = "is TOML, not a hazard curve: give a curve file; `uplift check` reads those of a study";
        return Err(JobError::input(format!("{}: {reason}", path.display())).into());
    }
    // what looks like an export but cannot be read as one is reported as such
    let begins = text.trim_start_matches('\u{feff}').trim_start();
    let an_export =
        begins.starts_with(['<', '{', '[']) || begins.lines().next().is_some_and(|line| line.contains("generated_by"));
    if an_export {
        return Err(export);
    }
    let read = read_table(path, &text, options).map_err(|error| with_file(error, path))?;
    for dropped in read.dropped() {
        events.note(&format!("{}: {dropped}", path.display()));
    }
    let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    let folder = path.parent().and_then(Path::file_name).map(|folder| format!("{}/", folder.to_string_lossy()));
    let name = format!("{}{stem}", folder.unwrap_or_default());
    Ok(vec![NamedCurve { name, curve: read.curve, read_as: Some(read.read_as) }])
}

/// The curve in the `text` of a table, in field units.
fn read_table(path: &Path, text: &str, options: &CurveOptions) -> Result<CsvCurve, HazardError> {
    let name = path.display().to_string();
    let mut declared = Declared::completed(text, &name, options.measure.as_deref(), options.unit.as_deref())?;
    if let Ok(known) = declared.measure.parse::<IntensityMeasure>() {
        known.label().clone_into(&mut declared.measure);
    }
    let options =
        CsvOptions { declared, second_column: options.years.map(|_| SecondColumn::Probability), years: options.years };
    let read = read_csv(text, &name, &options)?;
    Ok(CsvCurve { curve: read.curve.in_field_units(STANDARD_GRAVITY_M_S2)?, ..read })
}

/// The same with the name of the file, which what is wrong with a curve by itself lacks.
fn with_file(error: HazardError, path: &Path) -> HazardError {
    let (file, reason) = (path.display().to_string(), error.to_string());
    if reason.contains(&file) { error } else { HazardError::File { file, reason } }
}

/// The curves of an export; of all sites those that have one, the others are reported.
fn curves_of(path: &Path, selection: &SiteSelection, events: &dyn Events) -> Result<Vec<ExportedCurve>, InputsError> {
    if *selection != SiteSelection::All {
        return Ok(read_export(path, selection)?);
    }
    let mut export = ExportedCurves::open(path)?;
    let (mut curves, mut first, mut without) = (Vec::new(), None, 0);
    while let Some(site) = export.next_site() {
        match site?.curve {
            Ok(curve) => curves.push(curve),
            Err(error) => {
                without += 1;
                first.get_or_insert(error);
            }
        }
    }
    match first {
        Some(error) if curves.is_empty() => Err(error.into()),
        Some(error) => {
            events.note(&format!("{} without a hazard curve, the first: {error}", counted(without, "site")));
            Ok(curves)
        }
        None => Ok(curves),
    }
}

fn named(path: &Path, exported: ExportedCurve) -> NamedCurve {
    let place = exported
        .site
        .name
        .clone()
        .unwrap_or_else(|| format!("{}, {}", exported.site.longitude_deg, exported.site.latitude_deg));
    let kind = match exported.kind {
        Statistic::Unspecified => path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
        kind => kind.to_string(),
    };
    NamedCurve { name: format!("{place}, {kind}"), curve: exported.curve, read_as: None }
}
