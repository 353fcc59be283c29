//! Spectra and coefficients for other programs: a tidy table, JSON, a MATLAB file.

mod matlab;

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use serde::Serialize;
use serde_json::json;

use crate::alarms::{Alarm, alarms};
use crate::error::UpliftError;
use crate::events::Events;
use crate::outputs::{self, Output, OutputKind, beside};
use crate::result::{Fit, Head, ResultFile, Spectrum, StoredSpectra, flag_number, write_atomically, write_table};
use crate::text::finite;
use crate::uniform_risk::flag_word;
use matlab::{MatFile, Shape};

/// A coefficient of a spectrum.
type Value = fn(&Fit) -> f64;

/// Formats of other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportFormat {
    /// A tidy table: `site`, `im`, `poe`, `years`, `strength`, `u_m`, `fit_m`, `flag`, `lower_tail_share`,
    /// `upper_tail_share`; one comment line first.
    Csv,
    /// One object with the spectra, their coefficients and what to know before using them.
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

    fn kind(self) -> OutputKind {
        match self {
            Self::Csv => OutputKind::Table("fit_m"),
            Self::Json => OutputKind::Json,
            Self::Matlab => OutputKind::Matlab,
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
    /// Whether whatever is at the places of the files gives way.
    pub force: bool,
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
/// No format, or several for one file; a file that is no result, is damaged or has no spectra; a file that would
/// overwrite the result or what is not this program's, or cannot be written.
pub fn export(options: &ExportOptions, events: &dyn Events) -> Result<ExportReport, UpliftError> {
    if options.formats.is_empty() || (options.output.is_some() && options.formats.len() > 1) {
        return Err(UpliftError::Usage("say --csv, --json or --mat; -o goes with one of them".to_owned()));
    }
    let file =
        |format: &ExportFormat| options.output.clone().unwrap_or_else(|| beside(&options.result, format.extension()));
    let output = |format| Output::new(file(format), format.kind()).of(&options.result);
    let outputs: Vec<Output> = options.formats.iter().map(output).collect();
    let export = Export::read(&options.result)?;
    outputs::check(&outputs, &[&options.result], options.force)?;
    let mut files = Vec::new();
    for format in &options.formats {
        if events.cancelled() {
            return Err(UpliftError::Interrupted);
        }
        let file = file(format);
        match format {
            ExportFormat::Csv => write_table(&file, export.provenance(), export.columns())?,
            ExportFormat::Json => write_atomically(&file, format!("{:#}\n", export.json()).as_bytes())?,
            ExportFormat::Matlab => write_atomically(&file, &export.matlab()?)?,
        }
        files.push(file);
    }
    Ok(ExportReport { files })
}

/// The spectra and coefficients of a result, and where they come from.
pub struct Export {
    head: Head,
    spectra: StoredSpectra,
    /// What to know before using them, the worst first.
    alarms: Vec<Alarm>,
    /// One line: program, time, file, records.
    provenance: String,
}

impl Export {
    /// Read the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged or no result of uniform risk spectra.
    pub fn read(path: &Path) -> Result<Self, UpliftError> {
        let file = ResultFile::open(path)?;
        let spectra = file.spectra()?;
        if spectra.measures.is_empty() {
            return Err(UpliftError::input(format!("{}: has no spectra: the study has no sites", path.display())));
        }
        let head = file.head()?;
        let provenance = format!(
            "uplift {} ({}), {}; {}; records: {}",
            head.version,
            head.commit,
            head.created,
            path.file_name().unwrap_or_default().to_string_lossy(),
            head.record_set
        )
        .replace(['\n', '\r'], " ");
        Ok(Self { alarms: alarms(&file)?, head, spectra, provenance })
    }

    /// One line of provenance.
    pub fn provenance(&self) -> &str {
        &self.provenance
    }

    /// A row for each ordinate, its fit beside it.
    pub fn columns(&self) -> Vec<Column> {
        let (mut site, mut im, mut poe, mut strength, mut u_m, mut fit_m) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (mut flag, mut lower, mut upper) = (Vec::new(), Vec::new(), Vec::new());
        for spectrum in self.spectra.rows() {
            let curve = spectrum.fit.curve();
            for (&eta, &ordinate_m) in self.spectra.strengths.iter().zip(spectrum.u_m) {
                site.push(spectrum.site);
                im.push(spectrum.measure.label());
                poe.push(spectrum.poe);
                strength.push(eta);
                u_m.push(ordinate_m);
                fit_m.push(curve.map(|curve| curve.at(eta)));
            }
            flag.extend(spectrum.flags.iter().map(|&flag| flag_word(flag)));
            lower.extend_from_slice(spectrum.lower_tail_share);
            upper.extend_from_slice(spectrum.upper_tail_share);
        }
        let years = vec![self.spectra.years; site.len()];
        vec![
            Column::new("site".into(), site),
            Column::new("im".into(), im),
            Column::new("poe".into(), poe),
            Column::new("years".into(), years),
            Column::new("strength".into(), strength),
            Column::new("u_m".into(), u_m),
            Column::new("fit_m".into(), fit_m),
            Column::new("flag".into(), flag),
            Column::new("lower_tail_share".into(), lower),
            Column::new("upper_tail_share".into(), upper),
        ]
    }

    /// Everything as one JSON object; what is not finite is null.
    pub fn json(&self) -> serde_json::Value {
        let spectra: Vec<serde_json::Value> = self
            .spectra
            .rows()
            .map(|Spectrum { site, measure, poe, u_m, fit, flags, lower_tail_share, upper_tail_share }| {
                json!({
                    "site": site,
                    "im": measure.label(),
                    "poe": poe,
                    "u_m": u_m.iter().copied().map(finite).collect::<Vec<_>>(),
                    "flag": flags.iter().map(|&flag| flag_word(flag)).collect::<Vec<_>>(),
                    "lower_tail_share": lower_tail_share,
                    "upper_tail_share": upper_tail_share,
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
            "record_set": self.head.record_set,
            "years": self.spectra.years,
            "strength": self.spectra.strengths,
            "spectra": spectra,
            "alarms": self.alarms,
        })
    }

    /// A MATLAB file: `u_pgv_m` is strength × probability × site, the coefficients are probability × site.
    ///
    /// # Errors
    /// A result that is too large for the format.
    pub fn matlab(&self) -> Result<Vec<u8>, UpliftError> {
        let StoredSpectra { strengths, poes, years, sites, measures } = &self.spectra;
        let mut file = MatFile::new(&self.provenance);
        file.text("provenance", &self.provenance);
        file.numbers("strength", &Shape::column(strengths.len()), strengths);
        file.numbers("poe", &Shape::column(poes.len()), poes);
        file.numbers("years", &Shape::column(1), &[*years]);
        file.texts("site", &sites.iter().map(String::as_str).collect::<Vec<_>>());
        for spectra in measures {
            let key = spectra.measure.key();
            // spectra come site by site, in each probability by probability: the order of MATLAB's columns
            let shape = Shape(vec![strengths.len(), poes.len(), sites.len()]);
            file.numbers(&format!("u_{key}_m"), &shape, spectra.u_m.values());
            let flags = spectra.flags.map(|&flag| f64::from(flag_number(flag)));
            file.numbers(&format!("flag_{key}"), &shape, flags.values());
            file.numbers(&format!("lower_tail_share_{key}"), &shape, spectra.lower_tail_share.values());
            file.numbers(&format!("upper_tail_share_{key}"), &shape, spectra.upper_tail_share.values());
            let columns: [(&str, Value); 4] = [
                ("c0_{}_m", |fit| fit.c0_m),
                ("c1_{}", |fit| fit.c1),
                ("c2_{}_m", |fit| fit.c2_m),
                ("rmse_{}_m", |fit| fit.rmse_m),
            ];
            for (name, value) in columns {
                let values = spectra.fits.map(value);
                file.numbers(&name.replace("{}", key), &Shape(vec![poes.len(), sites.len()]), values.values());
            }
        }
        file.finish().map_err(UpliftError::input)
    }
}
