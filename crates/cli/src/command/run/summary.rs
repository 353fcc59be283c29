//! What a run tells when it is done.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::json;

use super::work::rate;
use crate::command::Terminal;
use uplift::UpliftError;
use uplift::uniform_risk::{Outcome};
use uplift::text::{metres, nearest, per_cent, table};

/// Warnings printed; all of them are in the result file.
const WARNINGS_SHOWN: usize = 12;

/// Tell what was found, for people or for programs.
pub(in crate::command) fn print_outcome(
    json: bool,
    session: &Terminal,
    outcome: &Outcome<'_>,
    files: &[PathBuf],
    seconds: f64,
) -> Result<(), UpliftError> {
    let mut out = std::io::stdout().lock();
    if json {
        writeln!(out, "{:#}", summary(outcome, files, seconds))?;
    } else if !session.is_quiet() {
        print_summary(&mut out, outcome, files, seconds)?;
    }
    Ok(())
}

fn print_summary(
    out: &mut impl Write,
    outcome: &Outcome<'_>,
    files: &[PathBuf],
    seconds: f64,
) -> Result<(), UpliftError> {
    let study = outcome.study;
    let shown = nearest(&study.strengths, &[0.1, 0.2, 0.4]);
    let at: Vec<String> = shown.iter().map(|&index| format!("{:.3}", study.strengths[index])).collect();
    for spectra in outcome.spectra.iter().filter(|spectra| spectra.shape[0] > 0) {
        let label = spectra.measure.label();
        writeln!(
            out,
            "\nUniform risk spectra by {label}: displacement in m at strength {}{}",
            at.join(", "),
            if outcome.records.synthetic { " (synthetic records)" } else { "" }
        )?;
        let mut header = vec!["site".to_owned()];
        for poe in &study.risk.poe {
            header.push(format!("{} in {} yr", per_cent(*poe), study.risk.years));
            header.extend(std::iter::repeat_n(String::new(), shown.len() - 1));
        }
        let rows: Vec<Vec<String>> = (0..spectra.shape[0])
            .map(|site| {
                let mut row = vec![study.sites[site].name.clone()];
                for poe in 0..spectra.shape[1] {
                    row.extend(shown.iter().map(|&index| metres(spectra.spectrum(site, poe)[index].displacement_m)));
                }
                row
            })
            .collect();
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        writeln!(out, "{}", table(&header, &rows))?;
    }
    print_branches(out, outcome, &shown)?;
    print_end(out, outcome.warnings, files, seconds)?;
    if outcome.spectra.iter().any(|spectra| spectra.shape[0] > 0) {
        writeln!(out, "Coefficients (Table 4.2): uplift table {}", shown_path(&files[0]).display())?;
    }
    Ok(())
}

/// What every run ends with: warnings, files, time.
pub(in crate::command) fn print_end(
    out: &mut impl Write,
    warnings: &[String],
    files: &[PathBuf],
    seconds: f64,
) -> Result<(), UpliftError> {
    if !warnings.is_empty() {
        writeln!(out, "\nBefore you use these numbers:")?;
        for warning in warnings.iter().take(WARNINGS_SHOWN) {
            writeln!(out, "  - {warning}")?;
        }
        if warnings.len() > WARNINGS_SHOWN {
            writeln!(
                out,
                "  - {} more in the attribute `warnings` of the result file",
                warnings.len() - WARNINGS_SHOWN
            )?;
        }
    }
    writeln!(out, "\nDone in {seconds:.1} s. Results:")?;
    for file in files {
        writeln!(out, "  {}", shown_path(file).display())?;
    }
    Ok(())
}

/// The spread of the spectra over weighted hazard curves, where a site has some.
fn print_branches(out: &mut impl Write, outcome: &Outcome<'_>, shown: &[usize]) -> Result<(), UpliftError> {
    let study = outcome.study;
    let mut rows = Vec::new();
    for spectra in outcome.spectra {
        for branches in &spectra.branches {
            for (poe, &probability) in study.risk.poe.iter().enumerate() {
                for &strength in shown {
                    let cell = poe * study.strengths.len() + strength;
                    let [low, .., high] = &branches.fractiles_m;
                    rows.push(vec![
                        study.sites[branches.site].name.clone(),
                        spectra.measure.label().to_owned(),
                        per_cent(probability),
                        format!("{:.3}", study.strengths[strength]),
                        metres(low[cell]),
                        metres(branches.mean_m[cell]),
                        metres(high[cell]),
                    ]);
                }
            }
        }
    }
    if !rows.is_empty() {
        writeln!(out, "\nSpread over the weighted hazard curves: displacement in m, 5 and 95 % fractile and mean")?;
        writeln!(out, "{}", table(&["site", "im", "probability", "strength", "5 %", "mean", "95 %"], &rows))?;
    }
    Ok(())
}

/// A path as short as the user would type it.
pub(in crate::command) fn shown_path(path: &Path) -> &Path {
    std::env::current_dir().ok().and_then(|folder| path.strip_prefix(folder).ok()).unwrap_or(path)
}

fn summary(outcome: &Outcome<'_>, files: &[PathBuf], seconds: f64) -> serde_json::Value {
    let study = outcome.study;
    let poes = study.risk.poe.len();
    let coefficients: Vec<serde_json::Value> = outcome
        .coefficients
        .iter()
        .flat_map(|coefficients| {
            coefficients.fits.iter().enumerate().map(move |(row, fit)| {
                let fit = fit.as_ref().ok();
                json!({
                    "site": study.sites[row / poes].name,
                    "im": coefficients.measure.label(),
                    "poe": study.risk.poe[row % poes],
                    "c0": fit.map(|fit| fit.c0),
                    "c1": fit.map(|fit| fit.c1),
                    "c2": fit.map(|fit| fit.c2),
                    "rmse": fit.map(|fit| fit.rmse),
                    "bound_active": fit.map(|fit| fit.bound_active),
                })
            })
        })
        .collect();
    let measures: Vec<serde_json::Value> = outcome
        .stripes
        .iter()
        .map(|stripes| {
            json!({
                "im": stripes.measure.label(),
                "analyses": stripes.analyses,
                "analyses_computed": stripes.computed,
                "seconds": stripes.seconds,
                "analyses_per_second": rate(stripes),
            })
        })
        .collect();
    json!({
        "program": "uplift",
        "version": uplift::VERSION,
        "commit": uplift::COMMIT,
        "study": outcome.provenance.study_file,
        "title": study.title,
        "record_set": outcome.records.description,
        "synthetic": outcome.records.synthetic,
        "files": files,
        "measures": measures,
        "coefficients": coefficients,
        "warnings": outcome.warnings,
        "seconds": seconds,
    })
}
