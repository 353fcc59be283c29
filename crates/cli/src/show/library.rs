//! A library of rocking response in a table: at which intensity half of the motions overturn each system.

use std::io::Write;

use uplift::library::{LibraryReport, Normalised, SystemReport};
use uplift::text::{Table, thousands};

use super::alarms::{DETAILS, print_warnings};
use super::shown_path;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Systems shown without `--details`.
const SHOWN: usize = 6;

/// A row a system; in detail all of them.
pub(crate) fn print_library(report: &LibraryReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    let shown = if terminal.shows_details() { report.systems.len() } else { report.systems.len().min(SHOWN) };
    writeln!(out, "Median intensity of overturning (dispersion; largest error of the fitted share)")?;
    let columns = Normalised::ALL;
    let table = Table::from_rows(&report.systems[..shown])
        .left("system", SystemReport::name)
        .each(columns, |table, measure| table.right(measure.label(), move |system| cell(system, measure)));
    writeln!(out, "{table}")?;
    if shown < report.systems.len() {
        writeln!(out, "{} more systems: {DETAILS}, or fits.csv", report.systems.len() - shown)?;
    }
    writeln!(out, "{}; {} analyses", report.record_set, thousands(report.analyses))?;
    print_warnings(&mut out, &report.alarms, None, terminal)?;
    if let (false, Some(folder)) = (terminal.is_quiet(), report.files.first().and_then(|file| file.parent())) {
        let name = |file: &std::path::PathBuf| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let names: Vec<String> = report.files.iter().map(name).collect();
        writeln!(out, "Files  {}: {}", shown_path(folder).display(), names.join(", "))?;
    }
    Ok(())
}

/// Median, dispersion and largest error; a dash where there is no fit.
fn cell(system: &SystemReport, measure: Normalised) -> String {
    let of = system.measures.iter().find(|of| of.measure == measure);
    let fit = of.and_then(|of| of.fits.iter().find(|fit| fit.of == "overturning"));
    match fit.map(|fit| (fit.median, fit.dispersion, fit.largest_error)) {
        Some((Some(median), Some(dispersion), Some(error))) => format!("{median:.2} ({dispersion:.2}; {error:.2})"),
        _ => "-".to_owned(),
    }
}
