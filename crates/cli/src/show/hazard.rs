//! Hazard curves: taken from exports, and looked at.

use std::io::Write;

use uplift::hazard_curves::{HazardImportReport, HazardReport, ShownCurve};
use uplift::text::{per_cent, table};

use crate::error::CommandError;
use crate::terminal::output;

/// Curves shown of a file with many.
const SHOWN: usize = 20;

/// The lines of a study that use the curves.
pub(crate) fn print_hazard_import(report: &HazardImportReport) -> Result<(), CommandError> {
    let files: Vec<&str> = report.curves.iter().map(|curve| curve.file.as_str()).collect();
    write!(
        output(),
        "# {} curve(s) in {}: {}\n{}",
        files.len(),
        report.folder.display(),
        files.join(", "),
        report.study_lines
    )?;
    Ok(())
}

/// The curves of a file.
pub(crate) fn print_curves(report: &HazardReport) -> Result<(), CommandError> {
    let HazardReport { probabilities, years, curves } = report;
    let mut out = output();
    let row = |curve: &ShownCurve| {
        let mut row = vec![curve.name.clone(), format!("{} [{}]", curve.measure, curve.unit)];
        let level = |level: &Option<f64>| level.map_or_else(|| "-".to_owned(), |level| format!("{level:.4}"));
        row.extend(curve.levels.iter().map(level));
        row.push(format!("{:.3e} - {:.3e}", curve.lowest, curve.highest));
        row
    };
    let rows: Vec<Vec<String>> = curves.iter().take(SHOWN).map(row).collect();
    let probabilities: Vec<String> = probabilities.iter().map(|&probability| per_cent(probability)).collect();
    let mut header = vec!["curve", "measure"];
    header.extend(probabilities.iter().map(String::as_str));
    header.push("levels");
    writeln!(out, "{}", table(&header, &rows))?;
    writeln!(
        out,
        "\nLevels exceeded with the stated probability in {years} years; a dash where the curve does not reach."
    )?;
    if curves.len() > SHOWN {
        writeln!(out, "{} curves, the first {SHOWN} shown: --name or --near LON,LAT picks a site", curves.len())?;
    }
    if let [curve] = curves.as_slice() {
        let component = curve.component.as_deref().unwrap_or("not said");
        writeln!(out, "Horizontal components: {component}\n{} levels, source:", curve.points)?;
        for line in curve.source.lines() {
            writeln!(out, "  {line}")?;
        }
    }
    Ok(())
}
