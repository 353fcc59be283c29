//! Fragilities for other programs: how often a displacement or a limit state of a structure is exceeded at each level.

mod curves;
pub(crate) mod measures;
mod table;

use std::path::PathBuf;

use uplift_design::{independent_records, limit_stripes};
use uplift_fragility::{FragilityFunction, PELICUN_COLUMN, Stripes as Stripe, nrml_model, pelicun_table};
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind, beside};
use uplift_job::table::{text_columns, write_atomically, write_table};
use uplift_job::typed::all_numbers;
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_uniform_risk::{StoredStripes, measure_index, strength_index};

use crate::error::ExportsError;
use crate::options::ExportOptions;
use crate::report::ExportReport;
use curves::{Fragility, displacement_limits};
use measures::FragilityFormat;

impl FragilityFormat {
    /// How the files end that are named after a result.
    fn extension(self) -> &'static str {
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

/// Writes the fragilities of a result, or of a structure under its records, for other programs.
pub(crate) fn fragility(
    format: FragilityFormat,
    options: &ExportOptions,
    events: &dyn Events,
) -> Result<ExportReport, ExportsError> {
    let asked = &options.assessment;
    let structure = asked.structure()?;
    let path = options.output.clone().unwrap_or_else(|| beside(&options.result, format.extension()));
    let fits = (format == FragilityFormat::Csv).then(|| path.with_extension(FITS));
    let output = |path: &PathBuf, kind| Output::new(path, kind).with_result(&options.result);
    let mut outputs = vec![output(&path, format.kind())];
    outputs.extend(fits.as_ref().map(|fits| output(fits, OutputKind::Table(table::COLUMN_OF_FITS))));
    outputs::check(&outputs, &options.inputs(), options.overwriting.force)?;

    let file = ResultFile::open(&options.result)?;
    let known = file.measures();
    let measures = match asked.measure {
        Some(measure) => vec![known[measure_index(&known, Some(measure))?]],
        None => known,
    };
    for &measure in &measures {
        measures::check(measure, format)?;
    }
    let units = independent_records(&file)?;
    let stored = StoredStripes::read(&file)?;
    let fragilities = match &structure {
        None => {
            let [displacements_m, strengths] = [&asked.displacement_m, &asked.strength].map(|of| all_numbers(of));
            displacement_fragilities(&stored, (&displacements_m, &strengths), &measures, &units)
        }
        Some(structure) => {
            let found = limit_stripes(structure, &options.result, &asked.limits(asked.measure), events)?;
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
    let mut report = ExportReport { files: vec![path.clone()], notes: Vec::new() };
    let functions: Vec<FragilityFunction> = fragilities.iter().filter_map(Fragility::function).collect();
    match format {
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
fn displacement_fragilities(
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
