//! What rocking spectra under wavelets say in a few numbers.

use std::io::Write;

use uplift::pulses::{PulseReport, Summary};
use uplift::text::{Table, thousands};

use super::shown_path;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// A column for each wavelet; then the files, unless the terminal is quiet.
pub(crate) fn print_pulses(report: &PulseReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    let summaries = &report.wavelets;
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value}"));
    let row = |name: &str, cell: &dyn Fn(&Summary) -> String| {
        std::iter::once(name.to_owned()).chain(summaries.iter().map(cell)).collect::<Vec<String>>()
    };
    let header = std::iter::once("Ricker wavelet").chain(summaries.iter().map(|of| of.wavelet));
    let rows = [
        row("motions over ω_p/p", &|of| thousands(of.points as u64)),
        row("overturn without impact", &|of| thousands(of.overturned_without_impact as u64)),
        row("overturn after impact", &|of| thousands(of.overturned_after_impact as u64)),
        row("overturn from a_p/(g tan α)", &|of| number(of.smallest_overturning_acceleration)),
        row("overturn up to ω_p/p", &|of| number(of.largest_overturning_frequency)),
        row("overturn up to a base 2b ω_p²/a_p", &|of| {
            let beyond = if of.larger_bases_may_overturn { " or more" } else { "" };
            format!("{}{beyond}", number(of.largest_overturning_base))
        }),
    ];
    writeln!(out, "{}", Table::new(header, rows))?;
    if !terminal.is_quiet() {
        writeln!(out)?;
        for file in &report.files {
            writeln!(out, "{}", shown_path(file).display())?;
        }
    }
    Ok(())
}
