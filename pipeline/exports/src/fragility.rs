//! Fragilities for other programs: how often a displacement or a limit state of a structure is exceeded at each level.

mod curves;
pub(crate) mod measures;
mod table;

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde::Serialize;
use uplift_design::{LimitOptions, independent_records, limit_stripes};
use uplift_fragility::{FragilityFunction, PELICUN_COLUMN, Stripes as Stripe, nrml_model, pelicun_table};
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind, beside};
use uplift_job::table::{text_columns, write_atomically, write_table};
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_study::Structure;
use uplift_uniform_risk::{StoredStripes, measure_index, strength_index};

use crate::error::ExportsError;
use curves::{Fragility, displacement_limits};

/// Formats of fragilities.
#[expect(clippy::doc_markdown, reason = "what completions show has no backticks")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FragilityFormat {
    /// A fragility model of OpenQuake (NRML 0.5): counted shares, and lognormal functions of them.
    #[value(name = "openquake")]
    OpenQuake,
    /// A fragility table of pelicun 3: counted shares, and lognormal functions of them.
    Pelicun,
    /// A tidy table, a row each level, and another of the fits.
    Csv,
}

impl FragilityFormat {
    /// How the files end that are named after a result.
    pub fn extension(self) -> &'static str {
        match self {
            Self::OpenQuake => "fragility.xml",
            Self::Pelicun => "pelicun.csv",
            Self::Csv => "fragility.csv",
        }
    }

    fn kind(self) -> OutputKind {
        match self {
            Self::OpenQuake => OutputKind::Nrml,
            Self::Pelicun => OutputKind::Table(PELICUN_COLUMN),
            Self::Csv => OutputKind::Table(table::COLUMN),
        }
    }
}

/// How the table of fits ends, beside that of the curves.
const FITS: &str = "fits.csv";

/// What is exceeded.
#[derive(Debug, Clone, PartialEq)]
pub enum FragilityOf {
    /// Displacements of the oscillators of a result.
    Displacements {
        /// Displacements, m.
        displacements_m: Vec<f64>,
        /// Uplift strengths of the result.
        strengths: Vec<f64>,
    },
    /// The limit states of a structure under the records of a result.
    Structure {
        /// The structure.
        structure: Box<Structure>,
        /// Manifest of the records, where it is no longer where the study says.
        manifest: Option<PathBuf>,
        /// The part of its displacement capacity at which a limit state of its own begins.
        capacity_share: f64,
    },
}

/// Which fragilities are exported, and where they go.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityOptions {
    /// The result file.
    pub result: PathBuf,
    /// The format.
    pub format: FragilityFormat,
    /// What is exceeded.
    pub of: FragilityOf,
    /// Intensity measure; all that the records are scaled by where none is given.
    pub measure: Option<IntensityMeasure>,
    /// The file; the result with the ending of the format if none is given.
    pub output: Option<PathBuf>,
    /// Whether existing files are overwritten.
    pub force: bool,
}

/// What was exported.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FragilityReport {
    /// The files.
    pub files: Vec<PathBuf>,
    /// What the format leaves out.
    pub notes: Vec<String>,
}

/// Writes the fragilities of a result, or of a structure under its records, for other programs.
///
/// # Errors
/// A file that is no result, is damaged or has no sites; a strength, a displacement or a measure that it does not have;
/// a measure that the other program does not have; records or a structure that cannot be used; files that would
/// overwrite something else, or cannot be written.
pub fn export_fragility(options: &FragilityOptions, events: &dyn Events) -> Result<FragilityReport, ExportsError> {
    let path = options.output.clone().unwrap_or_else(|| beside(&options.result, options.format.extension()));
    let fits = (options.format == FragilityFormat::Csv).then(|| path.with_extension(FITS));
    let mut inputs: Vec<&Path> = vec![&options.result];
    if let FragilityOf::Structure { structure, manifest, .. } = &options.of {
        inputs.push(&structure.file);
        inputs.extend(manifest.as_deref());
    }
    let output = |path: &PathBuf, kind| Output::new(path, kind).with_result(&options.result);
    let mut outputs = vec![output(&path, options.format.kind())];
    outputs.extend(fits.as_ref().map(|fits| output(fits, OutputKind::Table(table::COLUMN_OF_FITS))));
    outputs::check(&outputs, &inputs, options.force)?;

    let file = ResultFile::open(&options.result)?;
    let known = file.measures();
    let measures = match options.measure {
        Some(measure) => vec![known[measure_index(&known, Some(measure))?]],
        None => known,
    };
    for &measure in &measures {
        measures::check(measure, options.format)?;
    }
    let units = independent_records(&file)?;
    let stored = StoredStripes::read(&file)?;
    let fragilities = match &options.of {
        FragilityOf::Displacements { displacements_m, strengths } => {
            of_displacements(&stored, (displacements_m, strengths), &measures, &units)
        }
        FragilityOf::Structure { structure, manifest, capacity_share } => {
            let asked =
                LimitOptions { manifest: manifest.clone(), measure: options.measure, capacity_share: *capacity_share };
            let found = limit_stripes(structure, &options.result, &asked, events)?;
            let name = structure.file.file_stem().unwrap_or_default().to_string_lossy();
            found
                .iter()
                .map(|of| {
                    let stripes = Stripe::new(&of.levels, &of.demands_m)?;
                    let subject = (format!("{name} {}", of.model), of.measure);
                    Fragility::new(subject, &stripes, (of.limits[0].threshold_m, &of.limits), &units)
                })
                .collect()
        }
    }?;
    let line = stored.line("fragility");
    let mut report = FragilityReport { files: vec![path.clone()], notes: Vec::new() };
    let functions: Vec<FragilityFunction> = fragilities.iter().filter_map(Fragility::function).collect();
    match options.format {
        FragilityFormat::OpenQuake => {
            let (text, notes) = nrml_model(&functions, &line);
            report.notes = notes;
            write_atomically(&path, text.as_bytes())?;
        }
        FragilityFormat::Pelicun => {
            let (columns, notes) = pelicun_table(&functions);
            report.notes = notes;
            write_table(&path, &line, text_columns(columns))?;
        }
        FragilityFormat::Csv => write_table(&path, &line, table::columns(&fragilities))?,
    }
    if let Some(fits) = fits {
        write_table(&fits, &line, table::columns_of_fits(&fragilities))?;
        report.files.push(fits);
    }
    Ok(report)
}

/// Of each of the `strengths` by each of the `measures`.
fn of_displacements(
    stored: &StoredStripes,
    (displacements_m, strengths): (&[f64], &[f64]),
    measures: &[IntensityMeasure],
    units: &[Vec<usize>],
) -> Result<Vec<Fragility>, ExportsError> {
    let limits = displacement_limits(displacements_m)?;
    let places =
        strengths.iter().map(|&strength| strength_index(&stored.strengths, strength)).collect::<Result<Vec<_>, _>>()?;
    let mut fragilities = Vec::new();
    for of in stored.measures.iter().filter(|of| measures.contains(&of.measure)) {
        for &place in &places {
            let subject = (format!("strength {}", stored.strengths[place]), of.measure);
            fragilities.push(Fragility::new(
                subject,
                &of.stripes(place)?,
                (stored.uplift_displacement_m, &limits),
                units,
            )?);
        }
    }
    Ok(fragilities)
}
