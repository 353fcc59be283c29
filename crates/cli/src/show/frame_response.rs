//! What became of a frame under the components of a record.

use std::io::Write;
use std::path::Path;

use uplift::response::{FrameResponseReport, FrameRun};
use uplift::text::{counted, three_digits};
use uplift_frame::Model;

use super::alarms::print_warnings;
use super::response::{print_files, print_record};
use super::structure::BLOCK;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The response of a frame, and the files of its history, unless the terminal is quiet.
pub(crate) fn print_frame_response(
    report: &FrameResponseReport,
    figure: Option<&Path>,
    terminal: &Terminal,
) -> Result<(), CommandError> {
    for component in &report.components {
        print_record(&component.shaken_by)?;
    }
    let mut out = output();
    let model = match report.model {
        Model::Planar => "planar, in the plane of each component",
        Model::Wobbling => "wobbling, under all components",
    };
    let (what, height_m) = (&report.name, report.height_m);
    let system = if report.kind == BLOCK {
        format!("block     {what}: {height_m} m high")
    } else {
        format!("frame     {what}: {}, 2h {height_m} m", counted(report.columns as usize, "column"))
    };
    writeln!(
        out,
        "{system}, slenderness {:.4} rad; {model}; restitution {:.4} ({}); uplifts beyond {:.4} g",
        report.slenderness_rad, report.restitution, report.restitution_from, report.uplift_acceleration_g
    )?;
    for run in &report.runs {
        print_run(&mut out, report, run)?;
    }
    for note in &report.notes {
        writeln!(out, "note      {note}")?;
    }
    print_warnings(&mut out, &report.alarms, None, terminal)?;
    print_files(report.history_file.as_deref(), figure, terminal)
}

fn print_run(out: &mut impl Write, report: &FrameResponseReport, run: &FrameRun) -> Result<(), CommandError> {
    let under = run.under;
    let is_block = report.kind == BLOCK;
    let moves = if is_block { "top" } else { "deck" };
    if let Some(time_s) = run.time_of_overturning_s {
        writeln!(out, "response  under {under}: overturned, after {time_s:.3} s")?;
    } else if let (Some(uplift_s), Some(peak_s)) = (run.time_of_uplift_s, run.time_of_peak_s) {
        writeln!(
            out,
            "response  under {under}: the {moves} moves {} m, a drift of {} %, at {peak_s:.4} s; rotation {} \
             rad; first uplift at {uplift_s:.4} s",
            three_digits(run.peak_displacement_m),
            three_digits(100.0 * run.peak_drift),
            three_digits(run.peak_rotation_rad)
        )?;
        if report.model == Model::Wobbling {
            writeln!(
                out,
                "          {} m along h1, {} m along h2",
                three_digits(run.peak_displacement_x_m),
                three_digits(run.peak_displacement_y_m)
            )?;
        }
    } else {
        writeln!(
            out,
            "response  under {under}: never uplifts: the ground does not exceed {:.4} g",
            report.uplift_acceleration_g
        )?;
    }
    let [shear_kn, reaction_kn] = [run.peak_base_shear_n, run.peak_base_reaction_n].map(|force_n| 1e-3 * force_n);
    let mut forces = vec![format!("{moves} {:.3} m/s2", run.peak_deck_acceleration_m_s2)];
    if is_block {
        forces.push(format!("base shear {reaction_kn:.3} kN"));
    } else {
        forces.push(format!("base shear {shear_kn:.3} kN by the deck, {reaction_kn:.3} kN by deck and columns"));
    }
    if let Some(tendon_n) = run.peak_tendon_n.filter(|tendon_n| tendon_n.is_finite()) {
        forces.push(format!("tendon {:.3} kN", 1e-3 * tendon_n));
    }
    if let Some(spring_m) = run.peak_spring_m.filter(|spring_m| spring_m.is_finite()) {
        forces.push(format!("springs {:.3} mm", 1e3 * spring_m));
    }
    writeln!(out, "          {}", forces.join(", "))?;
    for event in &run.events {
        writeln!(out, "          {:.4} s  {}", event.time_s, event.event.words())?;
    }
    if run.chatter_was_cut {
        writeln!(out, "          it bounced 100,000 times between two samples, and was put to rest")?;
    }
    Ok(())
}
