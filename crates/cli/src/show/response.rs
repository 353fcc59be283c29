//! What became of one oscillator, or one rigid block, under one record.

use std::io::Write;
use std::path::Path;

use uplift::response::{BlockResponseReport, ResponseReport, ShakingRecord};
use uplift::text::three_digits;

use super::alarms::print_warnings;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The response, and the files of its history, unless the terminal is quiet.
pub(crate) fn print_response(
    report: &ResponseReport,
    figure: Option<&Path>,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    let ResponseReport { strength, uplift_displacement_m, restitution, .. } = report;
    print_record(&report.shaken_by)?;
    let mut out = output();
    writeln!(out, "system    strength {strength}, uplift at {uplift_displacement_m} m, restitution {restitution}")?;
    if let Some(time_s) = report.time_of_overturning_s {
        writeln!(out, "response  overturned, after {time_s:.3} s and {} impacts", report.impacts)?;
    } else {
        writeln!(
            out,
            "response  peak displacement {} m at {:.4} s, {} uplifts, {} impacts",
            three_digits(report.peak_displacement_m),
            report.time_of_peak_s.unwrap_or_default(),
            report.uplifts,
            report.impacts
        )?;
    }
    print_warnings(&mut out, &report.alarms, None, terminal)?;
    print_files(report.history_file.as_deref(), figure, terminal)
}

/// The same of a block.
pub(crate) fn print_block_response(
    report: &BlockResponseReport,
    figure: Option<&Path>,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    print_record(&report.shaken_by)?;
    let mut out = output();
    let BlockResponseReport { slenderness_rad, impacts, .. } = report;
    writeln!(
        out,
        "block     {:.4} m wide, {:.4} m high: R {:.4} m, slenderness {slenderness_rad:.4} rad, p {:.4} rad/s, \
         restitution {:.4}{}; uplifts beyond {:.4} g",
        report.width_m,
        report.height_m,
        report.size_m,
        report.frequency_parameter_rad_s,
        report.restitution,
        if report.restitution_is_housners { " (Housner)" } else { "" },
        report.uplift_acceleration_g
    )?;
    if let Some(time_s) = report.time_of_overturning_s {
        writeln!(out, "response  overturned, after {time_s:.3} s and {impacts} impacts")?;
    } else if let (Some(uplift_s), Some(peak_s)) = (report.time_of_uplift_s, report.time_of_peak_s) {
        writeln!(
            out,
            "response  peak rotation {} rad, {:.1} % of the slenderness, at {peak_s:.4} s; the top moves {} m; \
             first uplift at {uplift_s:.4} s, {impacts} impacts",
            three_digits(report.peak_rotation_rad),
            100.0 * report.peak_rotation_rad / slenderness_rad,
            three_digits(report.peak_displacement_m)
        )?;
    } else {
        writeln!(out, "response  never uplifts: the ground does not exceed {:.4} g", report.uplift_acceleration_g)?;
    }
    if report.chatter_was_cut {
        terminal.say("note: a nearly elastic block rebounded 100,000 times in a sample interval, and was put to rest");
    }
    print_warnings(&mut out, &report.alarms, None, terminal)?;
    print_files(report.history_file.as_deref(), figure, terminal)
}

pub(super) fn print_record(shaken_by: &ShakingRecord) -> Result<(), CommandError> {
    let mut out = output();
    let ShakingRecord { samples, dt_s, scale, pga_g, pgv_cm_s, pgd_m, .. } = shaken_by;
    let record = shaken_by.record.display();
    writeln!(out, "record    {record}: {samples} samples every {dt_s} s, scaled by {scale}")?;
    Ok(writeln!(out, "          PGA {pga_g:.4} g, PGV {pgv_cm_s:.3} cm/s, PGD {pgd_m:.5} m")?)
}

pub(super) fn print_files(
    history: Option<&Path>,
    figure: Option<&Path>,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    if !terminal.is_quiet() {
        for (name, file) in [("history", history), ("figure", figure)] {
            if let Some(file) = file {
                writeln!(output(), "{name:<9} {}", file.display())?;
            }
        }
    }
    Ok(())
}
