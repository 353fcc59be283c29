//! What became of one oscillator under one record.

use std::io::Write;
use std::path::Path;

use uplift::response::ResponseReport;

use crate::error::CommandError;
use crate::terminal::output;

/// The response, and the files of its history.
pub(crate) fn print_response(report: &ResponseReport, figure: Option<&Path>) -> Result<(), CommandError> {
    let mut out = output();
    let ResponseReport { pga_g, pgv_cm_s, pgd_m, strength, uplift_displacement_m, .. } = report;
    writeln!(
        out,
        "record    {}: {} samples every {} s, scaled by {}",
        report.record.display(),
        report.samples,
        report.dt_s,
        report.scale
    )?;
    writeln!(out, "          PGA {pga_g:.4} g, PGV {pgv_cm_s:.3} cm/s, PGD {pgd_m:.5} m")?;
    writeln!(out, "system    strength {strength}, uplift at {uplift_displacement_m} m")?;
    if let Some(time_s) = report.time_of_overturning_s {
        writeln!(out, "response  overturned, after {time_s:.3} s and {} impacts", report.impacts)?;
    } else {
        writeln!(
            out,
            "response  peak displacement {:.6} m at {:.4} s, {} uplifts, {} impacts",
            report.peak_displacement_m,
            report.time_of_peak_s.unwrap_or_default(),
            report.uplifts,
            report.impacts
        )?;
    }
    for (name, file) in [("history", report.history_file.as_deref()), ("figure", figure)] {
        if let Some(file) = file {
            writeln!(out, "{name:<9} {}", file.display())?;
        }
    }
    Ok(())
}
