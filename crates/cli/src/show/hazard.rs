//! Hazard curves: taken from exports, and looked at.

use std::io::Write;

use uplift::hazard_curves::{HazardImportReport, HazardReport, ShownCurve};
use uplift::text::{Table, counted, per_cent, rounded};

use super::alarms::print_lines;
use crate::error::CommandError;
use crate::terminal::output;

/// Curves shown of a file with many.
const SHOWN: usize = 20;

/// The lines of a study that use the curves.
pub(crate) fn print_hazard_import(report: &HazardImportReport) -> Result<(), CommandError> {
    let files: Vec<&str> = report.curves.iter().map(|curve| curve.file.as_str()).collect();
    write!(
        output(),
        "# {} in {}: {}\n{}",
        counted(files.len(), "curve"),
        report.folder.display(),
        files.join(", "),
        report.study_lines
    )?;
    Ok(())
}

pub(crate) fn print_curves(report: &HazardReport) -> Result<(), CommandError> {
    let HazardReport { probabilities, years, curves, mistakes: _ } = report;
    let mut out = output();
    let level = |level: Option<f64>| level.map_or_else(|| "-".to_owned(), |level| format!("{level:.4}"));
    let table = Table::from_rows(curves.iter().take(SHOWN))
        .left("curve", |curve| &curve.name)
        .right("measure", |curve| format!("{} [{}]", curve.measure, curve.unit))
        .each(probabilities.iter().enumerate(), |table, (at, &probability)| {
            table.right(per_cent(probability), |curve| level(curve.levels[at]))
        })
        .right("levels", |curve| format!("{} to {}", rounded(curve.lowest, 4), rounded(curve.highest, 4)));
    writeln!(out, "{table}")?;
    writeln!(out, "\nLevels exceeded with each probability in {years} years (- outside the curve).")?;
    if curves.len() > SHOWN {
        writeln!(out, "{} curves, the first {SHOWN} shown: --name or --near LON,LAT picks a site", curves.len())?;
    }
    if let [curve] = curves.as_slice() {
        let component = curve.component.as_deref().unwrap_or("not given");
        let read_as = curve.read_as.as_ref().map_or_else(String::new, |read_as| format!(", read as {read_as}"));
        writeln!(out, "Horizontal components: {component}\n{} levels{read_as}, source:", curve.points)?;
        for line in curve.source.lines() {
            writeln!(out, "  {line}")?;
        }
    }
    let warning = |curve: &ShownCurve| Some(format!("mistake? {}: {}", curve.name, curve.warning.as_ref()?));
    let warnings: Vec<String> = curves.iter().filter_map(warning).collect();
    print_lines(&mut out, &warnings, false)?;
    Ok(())
}
