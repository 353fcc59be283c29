//! Spectra and coefficients for other programs: a tidy table, JSON, a MATLAB file.

mod matlab;

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use serde::Serialize;
use serde_json::json;
use uplift_regression::Exponential;

use crate::error::UpliftError;
use crate::events::Events;
use crate::outputs::refuse_foreign;
use crate::result::{Spectrum, StoredResult, open_result, write_aside, write_table};
use matlab::{MatFile, Shape};

/// A coefficient of a spectrum.
type Value = fn(&Spectrum) -> f64;

/// Formats of other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportFormat {
    /// A tidy table: `site`, `im`, `poe`, `years`, `strength`, `u_m`, `fit_m`; one comment line first.
    Csv,
    /// One object with the spectra and their coefficients.
    Json,
    /// A file that MATLAB and `scipy.io` load; `u_pgv_m` is strength × probability × site.
    Matlab,
}

impl ExportFormat {
    /// How the files end that are named after the result.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Csv => "spectra.csv",
            Self::Json => "json",
            Self::Matlab => "mat",
        }
    }
}

/// What is exported, and where it goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportOptions {
    /// The result file.
    pub result: PathBuf,
    /// The formats, one or more.
    pub formats: Vec<ExportFormat>,
    /// The file, beside one format; the result with the ending of each format if none is given.
    pub output: Option<PathBuf>,
}

/// What was exported.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ExportReport {
    /// The files, in the order of the formats.
    pub files: Vec<PathBuf>,
}

/// Writes the spectra and coefficients of a result for other programs.
///
/// # Errors
/// No format, or several for one file; a file that is no result, is damaged or has no spectra; a file that would overwrite the
/// result or what is not this program's, or cannot be written.
pub fn export(options: &ExportOptions, events: &dyn Events) -> Result<ExportReport, UpliftError> {
    if options.formats.is_empty() || (options.output.is_some() && options.formats.len() > 1) {
        return Err(UpliftError::Usage("say --csv, --json or --mat; -o goes with one of them".to_owned()));
    }
    let export = Export::read(&options.result)?;
    let mut files = Vec::new();
    for format in &options.formats {
        if events.cancelled() {
            return Err(UpliftError::Interrupted);
        }
        let file = options.output.clone().unwrap_or_else(|| options.result.with_extension(format.extension()));
        if file == options.result {
            return Err(UpliftError::Usage(format!("{}: this is the result itself", file.display())));
        }
        if options.output.is_some() && *format != ExportFormat::Matlab {
            refuse_foreign(&file)?;
        }
        match format {
            ExportFormat::Csv => write_table(&file, export.provenance(), export.columns())?,
            ExportFormat::Json => write_aside(&file, format!("{:#}\n", export.json()).as_bytes())?,
            ExportFormat::Matlab => write_aside(&file, &export.matlab()?)?,
        }
        files.push(file);
    }
    Ok(ExportReport { files })
}

/// The spectra and coefficients of a result, and where they come from.
pub struct Export {
    result: StoredResult,
    /// One line: program, time, file, records.
    provenance: String,
}

impl Export {
    /// Read the result at `path`.
    pub fn read(path: &Path) -> Result<Self, UpliftError> {
        let result = StoredResult::read(path)?;
        if result.spectra.is_empty() {
            return Err(UpliftError::input(format!("{}: has no spectra: the study has no sites", path.display())));
        }
        let reader = open_result(path)?;
        let text = |name: &str| reader.attribute_text("/", name);
        let provenance = format!(
            "uplift {} ({}), {}; {}; records: {}",
            text("version")?,
            text("commit")?,
            text("created")?,
            path.file_name().unwrap_or_default().to_string_lossy(),
            result.record_set
        )
        .replace(['\n', '\r'], " ");
        Ok(Self { result, provenance })
    }

    /// One line of provenance.
    pub fn provenance(&self) -> &str {
        &self.provenance
    }

    /// A row for each ordinate, its fit beside it.
    pub fn columns(&self) -> Vec<Column> {
        let result = &self.result;
        let (mut site, mut im, mut poe, mut strength, mut u_m, mut fit_m) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for spectrum in &result.spectra {
            let curve = curve(spectrum);
            for (&eta, &ordinate_m) in result.strengths.iter().zip(&spectrum.u_m) {
                site.push(spectrum.site.as_str());
                im.push(spectrum.im.as_str());
                poe.push(spectrum.poe);
                strength.push(eta);
                u_m.push(ordinate_m);
                fit_m.push(curve.map(|curve| curve.at(eta)));
            }
        }
        let years = vec![result.years; site.len()];
        vec![
            Column::new("site".into(), site),
            Column::new("im".into(), im),
            Column::new("poe".into(), poe),
            Column::new("years".into(), years),
            Column::new("strength".into(), strength),
            Column::new("u_m".into(), u_m),
            Column::new("fit_m".into(), fit_m),
        ]
    }

    /// Everything as one JSON object; what is not finite is null.
    pub fn json(&self) -> serde_json::Value {
        let finite = |value: f64| value.is_finite().then_some(value);
        let spectra: Vec<serde_json::Value> = self
            .result
            .spectra
            .iter()
            .map(|spectrum| {
                let fit = &spectrum.fit;
                json!({
                    "site": spectrum.site,
                    "im": spectrum.im,
                    "poe": spectrum.poe,
                    "u_m": spectrum.u_m.iter().map(|&u_m| finite(u_m)).collect::<Vec<_>>(),
                    "fit": {
                        "c0_m": finite(fit.c0_m),
                        "c1": finite(fit.c1),
                        "c2_m": finite(fit.c2_m),
                        "rmse_m": finite(fit.rmse_m),
                        "bound_active": fit.bound_active,
                    },
                })
            })
            .collect();
        json!({
            "provenance": self.provenance,
            "record_set": self.result.record_set,
            "years": self.result.years,
            "strength": self.result.strengths,
            "spectra": spectra,
        })
    }

    /// A MATLAB file: `u_pgv_m` is strength × probability × site, the coefficients are probability × site.
    pub fn matlab(&self) -> Result<Vec<u8>, UpliftError> {
        let result = &self.result;
        let mut file = MatFile::new(&self.provenance);
        file.text("provenance", &self.provenance);
        file.numbers("strength", &Shape::column(result.strengths.len()), &result.strengths);
        let mut sites: Vec<&str> = Vec::new();
        let mut poes: Vec<f64> = Vec::new();
        for spectrum in &result.spectra {
            if !sites.contains(&spectrum.site.as_str()) {
                sites.push(&spectrum.site);
            }
            if !poes.contains(&spectrum.poe) {
                poes.push(spectrum.poe);
            }
        }
        file.numbers("poe", &Shape::column(poes.len()), &poes);
        file.numbers("years", &Shape::column(1), &[result.years]);
        file.texts("site", &sites);
        for im in ["PGV", "PGA"] {
            let own: Vec<&Spectrum> = result.spectra.iter().filter(|spectrum| spectrum.im == im).collect();
            if own.is_empty() {
                continue;
            }
            let key = im.to_lowercase();
            let u_m: Vec<f64> = own.iter().flat_map(|spectrum| spectrum.u_m.iter().copied()).collect();
            // spectra come site by site, in each probability by probability: the order of MATLAB's columns
            let shape = Shape(vec![result.strengths.len(), poes.len(), sites.len()]);
            file.numbers(&format!("u_{key}_m"), &shape, &u_m);
            let columns: [(&str, Value); 4] = [
                ("c0_{}_m", |spectrum| spectrum.fit.c0_m),
                ("c1_{}", |spectrum| spectrum.fit.c1),
                ("c2_{}_m", |spectrum| spectrum.fit.c2_m),
                ("rmse_{}_m", |spectrum| spectrum.fit.rmse_m),
            ];
            for (name, value) in columns {
                let values: Vec<f64> = own.iter().map(|spectrum| value(spectrum)).collect();
                file.numbers(&name.replace("{}", &key), &Shape(vec![poes.len(), sites.len()]), &values);
            }
        }
        file.finish().map_err(UpliftError::input)
    }
}

fn curve(spectrum: &Spectrum) -> Option<Exponential> {
    let fit = &spectrum.fit;
    fit.c0_m.is_finite().then_some(Exponential { c0: fit.c0_m, c1: fit.c1, c2: fit.c2_m })
}
