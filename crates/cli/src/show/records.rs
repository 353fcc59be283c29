//! Records of a set: listed, looked at, chosen.

use std::io::Write;

use uplift::records::{AtLevelReport, ComponentReport, ListReport, RecordReport, SelectReport, ShowReport};
use uplift::text::{Table, counted};

use crate::error::CommandError;
use crate::terminal::{Terminal, output};

pub(crate) fn print_records(report: &ListReport) -> Result<(), CommandError> {
    let table = Table::from_rows(&report.records)
        .left("record", |record| &record.record)
        .right("event", |record| record.event.as_deref().unwrap_or("-"))
        .right("M", |record| record.magnitude.as_deref().unwrap_or("-"))
        .right("R [km]", |record| record.distance_km.as_deref().unwrap_or("-"))
        .right("Vs30 [m/s]", |record| record.vs30.as_deref().unwrap_or("-"))
        .right("PGA [g]", |record| format!("{:.3}", record.pga_g))
        .right("PGV [cm/s]", |record| format!("{:.2}", record.pgv_cm_s))
        .right("D5-75 [s]", |record| format!("{:.1}", record.d5_75_s))
        .right("pulse", |record| record.pulse_like.as_deref().unwrap_or("-"));
    let (mut out, shown) = (output(), report.records.len());
    writeln!(out, "{table}")?;
    writeln!(out, "\n{} of {} records; PGA and PGV: {}", shown, report.count, report.intensity.long_name())?;
    Ok(())
}

/// The lines of a study that choose the records, and where they are listed.
pub(crate) fn print_selection(report: &SelectReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    let chosen = report.records.len();
    write!(out, "# {chosen} of {} records; for a study:\n{}", report.count, report.study_lines)?;
    if let Some(manifest) = &report.manifest {
        terminal.say(&format!("{}: {}", counted(chosen, "record"), manifest.display()));
    }
    Ok(())
}

/// The lines of a study that runs records at their levels, and what the table has.
pub(crate) fn print_at_level(report: &AtLevelReport, terminal: &Terminal) -> Result<(), CommandError> {
    let AtLevelReport { measure, unit, records, levels, .. } = report;
    write!(
        output(),
        "# {} at {} of {measure}; for a study:\n{}",
        counted(*records, "record"),
        counted(levels.len(), "level"),
        report.study_lines
    )?;
    for set in levels {
        let records = counted(set.records, "record");
        terminal.say(&format!("{} {unit}: {records}, {} by {}", set.level, set.file.display(), set.tool));
    }
    for note in &report.notes {
        terminal.say(note);
    }
    terminal.say(&format!("the table: {}", report.table.display()));
    Ok(())
}

/// One record, or what a file holds.
pub(crate) fn print_record(report: &ShowReport) -> Result<(), CommandError> {
    let mut out = output();
    match report {
        ShowReport::File(file) => {
            let components = counted(file.components.len(), "component");
            writeln!(out, "{}: {} format, {components}", file.file.display(), file.format)?;
            for (index, component) in file.components.iter().enumerate() {
                writeln!(out, "\ncomponent {}", index + 1)?;
                print_component(&mut out, component)?;
            }
            print_warnings(&mut out, &file.warnings)
        }
        ShowReport::Record(record) => print_pair(&mut out, record),
    }
}

fn print_pair(out: &mut impl Write, record: &RecordReport) -> Result<(), CommandError> {
    writeln!(out, "record {}", record.record)?;
    for (key, value) in &record.metadata {
        writeln!(out, "  {key:<24}{value}")?;
    }
    for (name, (component, file)) in ["h1", "h2"].into_iter().zip(record.components.iter().zip(&record.files)) {
        writeln!(out, "\n{name}: {}", file.display())?;
        print_component(out, component)?;
    }
    writeln!(out, "\nboth")?;
    for peaks in &record.peaks {
        writeln!(out, "  {:<24}PGA {:.4} g, PGV {:.3} cm/s", peaks.combination, peaks.pga_g, peaks.pgv_cm_s)?;
    }
    if let Some(pulse) = &record.pulse {
        let word = if pulse.is_pulse_like { format!("yes, {:.2} s", pulse.period_s) } else { "no".to_owned() };
        writeln!(out, "  {:<24}{word} (indicator {:.2})", "velocity pulse", pulse.indicator)?;
    } else if record.pulse_like == Some(false) {
        writeln!(out, "  {:<24}no (too weak for one)", "velocity pulse")?;
    }
    print_warnings(out, &record.warnings)
}

fn print_warnings(out: &mut impl Write, warnings: &[String]) -> Result<(), CommandError> {
    for warning in warnings {
        writeln!(out, "warning: {warning}")?;
    }
    Ok(())
}

fn print_component(out: &mut impl Write, component: &ComponentReport) -> Result<(), CommandError> {
    let lines = [
        ("samples", format!("{} at {} s, {:.3} s", component.samples, component.dt_s, component.duration_s)),
        ("PGA", format!("{:.5} g", component.pga_g)),
        ("PGV", format!("{:.4} cm/s", component.pgv_cm_s)),
        ("PGD", format!("{:.4} cm", component.pgd_cm)),
        ("Arias intensity", format!("{:.4} m/s", component.arias_m_s)),
        ("CAV", format!("{:.4} m/s", component.cav_m_s)),
        ("D5-75, D5-95", format!("{:.2} s, {:.2} s", component.d5_75_s, component.d5_95_s)),
        ("velocity at the end", format!("{:.4} cm/s", component.residual_velocity_cm_s)),
    ];
    for (key, value) in component.said.iter().chain(&lines) {
        writeln!(out, "  {key:<24}{value}")?;
    }
    Ok(())
}
